//! Texts that the user wrote (declarations, TOML files) with their names, so that a mistake can be shown
//! where it stands.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::ops::Range;
use std::path::{Path, PathBuf};

use model_core::mistake::{Mistake, Mistakes};
use model_core::{Chain, ObservableId, names};
use serde::de::DeserializeOwned;
use study::Study;

use crate::failure::Failure;
use crate::terminal;

/// A text and where it came from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The file as the user named it.
    pub path: PathBuf,
    /// What it says, without a byte-order mark.
    pub text: String,
}

impl Source {
    /// Reads a file; `-` is standard input.
    ///
    /// # Errors
    /// The file cannot be read or is not UTF-8; a name that is not there comes with the nearest that is.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let text = if path == Path::new("-") {
            limited(io::stdin().lock())
        } else {
            File::open(path).and_then(limited)
        };
        match text {
            Ok(text) => Ok(Self::of_text(path, &text)),
            Err(error) => Err(not_readable(path, &error)),
        }
    }

    /// A text that came from elsewhere than a file, under the name that mistakes in it are shown with.
    #[must_use]
    pub fn of_text(name: impl Into<PathBuf>, text: &str) -> Self {
        Self { path: name.into(), text: text.strip_prefix('\u{feff}').unwrap_or(text).to_owned() }
    }

    /// Reads a file that another file names: relative to that one's folder.
    ///
    /// # Errors
    /// As [`Source::read`].
    pub fn read_beside(&self, path: &Path) -> Result<Self, Failure> {
        Self::read(&self.beside(path))
    }

    /// Where a path that stands in this file leads.
    #[must_use]
    pub fn beside(&self, path: &Path) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(path)
    }

    /// The text read as a declaration.
    ///
    /// # Errors
    /// Every mistake of the declaration, each with its place.
    pub fn chain(&self) -> Result<Chain, Failure> {
        self.cautioned(Chain::from_text(&self.text))
    }

    /// The same for formulas alone: constants need no value.
    ///
    /// # Errors
    /// Every other mistake of the declaration, each with its place.
    pub fn symbolic_chain(&self) -> Result<Chain, Failure> {
        self.cautioned(Chain::symbolic_from_text(&self.text))
    }

    fn cautioned(&self, chain: Result<Chain, Mistakes>) -> Result<Chain, Failure> {
        let chain = chain.map_err(|mistakes| match self.declaration_named() {
            Some(named) => Failure::Input(format!(
                "`{}` is no declaration, but names one: give `{}`",
                self.path.display(),
                self.beside(Path::new(&named)).display()
            )),
            None => self.mistakes(&mistakes),
        })?;
        for caution in model_core::caution::cautions(&chain) {
            terminal::warn(format_args!("{}: {caution}", self.path.display()));
        }
        Ok(chain)
    }

    /// The text read as TOML.
    ///
    /// # Errors
    /// The first mistake, with its place.
    pub fn toml<T: DeserializeOwned>(&self) -> Result<T, Failure> {
        toml::from_str(&self.text).map_err(|error| {
            let mistake = Mistake::new(error.span().unwrap_or_default(), error.message());
            self.is_declaration().unwrap_or_else(|| self.mistake(mistake))
        })
    }

    /// The text read as a study.
    ///
    /// # Errors
    /// Every mistake of the study, each with its place.
    pub fn study(&self) -> Result<Study, Failure> {
        Study::from_text(&self.text)
            .map_err(|mistakes| self.is_declaration().unwrap_or_else(|| self.mistakes(&mistakes)))
    }

    /// What to say where a declaration was given for a file that names one.
    fn is_declaration(&self) -> Option<Failure> {
        let opens = |line: &str| {
            let rest = line.trim_start().strip_prefix("chain")?;
            rest.starts_with(char::is_whitespace).then(|| !rest.contains('=') && rest.contains('{'))
        };
        if !self.text.lines().any(|line| opens(line) == Some(true)) {
            return None;
        }
        let file = self.path.display();
        let name = self.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Some(Failure::Input(format!(
            "`{file}` is a declaration; needed here is a file in TOML: a study or claims, which name it by chain = {name:?}, or a \
             file of errors or sizes"
        )))
    }

    /// The declaration that a study or a file of claims names.
    fn declaration_named(&self) -> Option<String> {
        let table: toml::Table = toml::from_str(&self.text).ok()?;
        Some(table.get("chain")?.as_str()?.to_owned())
    }

    /// Mistakes in this text, shown where they stand.
    #[must_use]
    pub fn mistakes(&self, mistakes: &Mistakes) -> Failure {
        Failure::mistakes(&self.path.display().to_string(), &self.text, mistakes)
    }

    /// One mistake in this text, shown where it stands.
    #[must_use]
    pub fn mistake(&self, mistake: Mistake<Range<usize>>) -> Failure {
        self.mistakes(&Mistakes::locate(&self.text, [mistake]))
    }
}

/// The longest declaration, claims, errors or study file, in bytes: beyond any that a person writes.
const LONGEST_TEXT: u64 = 16 << 20;

/// The whole of a text, if it is no longer than texts are.
fn limited(file: impl io::Read) -> io::Result<String> {
    let mut text = String::new();
    file.take(LONGEST_TEXT + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LONGEST_TEXT {
        return Err(io::Error::other("it is longer than 16 MiB; is it the right file?"));
    }
    Ok(text)
}

/// Why a file cannot be read, with the nearest name in its folder if it is not there.
pub fn not_readable(path: &Path, error: &io::Error) -> Failure {
    let mut failure = Failure::read(path, error);
    if let Failure::Read { why, .. } = &mut failure
        && error.kind() == io::ErrorKind::NotFound
        && let Some(near) = nearest_file(path)
    {
        *why = format!("{why}; did you mean `{}`?", near.display());
    }
    failure
}

/// The file in the same folder whose name is nearest to the one asked for.
fn nearest_file(path: &Path) -> Option<PathBuf> {
    let folder = match path.parent()? {
        parent if parent == Path::new("") => Path::new("."),
        parent => parent,
    };
    let mut there: Vec<String> =
        fs::read_dir(folder).ok()?.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    there.sort();
    let near = names::nearest(path.file_name()?.to_str()?, there.iter().map(String::as_str))?;
    Some(path.with_file_name(near))
}

/// The observables that the user asked for by name; all of the chain's if he named none.
///
/// # Errors
/// A name that the chain does not declare.
pub fn observables(chain: &Chain, names: &[String]) -> Result<Vec<ObservableId>, Failure> {
    if names.is_empty() {
        return Ok((0u16..).zip(&chain.observables).map(|(index, _)| ObservableId(index)).collect());
    }
    names.iter().map(|name| observable(chain, name)).collect()
}

/// The observable of a name.
///
/// # Errors
/// A name that the chain does not declare; the message names the nearest, or all.
pub fn observable(chain: &Chain, name: &str) -> Result<ObservableId, Failure> {
    chain.find_observable(name).ok_or_else(|| {
        let declared = || chain.observables.iter().map(|observable| observable.name.as_str());
        let instead = names::nearest(name, declared()).map_or_else(
            || format!("it declares {}", names::listed(declared())),
            |near| format!("did you mean `{near}`?"),
        );
        Failure::Input(format!("chain {} has no observable `{name}`; {instead}", chain.name))
    })
}
