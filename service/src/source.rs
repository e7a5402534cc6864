//! Texts that the user wrote (declarations, TOML files) with their names, so that a mistake can be shown
//! where it stands. Who reads a file gives its text.

use std::ops::Range;
use std::path::{Path, PathBuf};

use model_core::mistake::{Mistake, Mistakes};
use model_core::{Chain, ObservableId, names};
use serde::de::DeserializeOwned;
use study::{Study, toml_mistakes};

use crate::refusal::Refusal;
use crate::warn::Warn;

/// The first key of an instrument file.
pub const INSTRUMENT: &str = "instrument";

/// A text and where it came from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The name that mistakes in it are shown with: the file as the user named it.
    pub path: PathBuf,
    /// What it says, without a byte-order mark.
    pub text: String,
}

impl Source {
    /// A text that came from elsewhere than a file, under the name that mistakes in it are shown with.
    #[must_use]
    pub fn of_text(name: impl Into<PathBuf>, text: &str) -> Self {
        Self { path: name.into(), text: text.strip_prefix('\u{feff}').unwrap_or(text).to_owned() }
    }

    /// Where a path that stands in this file leads.
    #[must_use]
    pub fn beside(&self, path: &Path) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(path)
    }

    /// The text read as a declaration; warns of what is doubtful of it.
    ///
    /// # Errors
    /// Every mistake of the declaration, each with its place.
    pub fn chain(&self, warn: Warn<'_>) -> Result<Chain, Refusal> {
        self.cautioned(Chain::from_text(&self.text), warn)
    }

    /// The same for formulas alone: constants need no value.
    ///
    /// # Errors
    /// Every other mistake of the declaration, each with its place.
    pub fn symbolic_chain(&self, warn: Warn<'_>) -> Result<Chain, Refusal> {
        self.cautioned(Chain::symbolic_from_text(&self.text), warn)
    }

    fn cautioned(&self, chain: Result<Chain, Mistakes>, warn: Warn<'_>) -> Result<Chain, Refusal> {
        if self.is_instrument() {
            return Err(Refusal::Input(format!(
                "`{}` is an instrument file; needed here is a declaration: give `amended.chain`, which `calibrate` writes beside it",
                self.path.display()
            )));
        }
        let chain = chain.map_err(|mistakes| match self.declaration_named() {
            Some(named) => Refusal::Input(format!(
                "`{}` is no declaration, but names one: give `{}`",
                self.path.display(),
                self.beside(Path::new(&named)).display()
            )),
            None => {
                let other = self.is_table().or_else(|| self.is_json());
                other.unwrap_or_else(|| self.mistakes(&mistakes))
            }
        })?;
        for caution in model_core::caution::cautions(&chain) {
            warn(format!("{}: {caution}", self.path.display()));
        }
        Ok(chain)
    }

    /// The text read as TOML.
    ///
    /// # Errors
    /// The first mistake, with its place.
    pub fn toml<T: DeserializeOwned>(&self) -> Result<T, Refusal> {
        toml::from_str(&self.text).map_err(|error| {
            let mistake = toml_mistakes::mistake(&error);
            self.is_another().or_else(|| self.is_study()).unwrap_or_else(|| self.mistake(mistake))
        })
    }

    /// The text read as a study.
    ///
    /// # Errors
    /// Every mistake of the study, each with its place.
    pub fn study(&self) -> Result<Study, Refusal> {
        if toml::from_str(&self.text).is_ok_and(|table: toml::Table| table.is_empty()) {
            return Err(Refusal::Input(format!(
                "`{}` is empty: `trueaxis init TABLE.csv` writes a declaration and a study for a table of data",
                self.path.display()
            )));
        }
        Study::from_text(&self.text)
            .map_err(|mistakes| self.is_another().unwrap_or_else(|| self.mistakes(&mistakes)))
    }

    /// Whether it is an instrument file: it says so with its first key, damaged or not; where it is whole, with any key.
    #[must_use]
    pub fn is_instrument(&self) -> bool {
        let mut lines = self.text.lines().map(str::trim_start);
        let first = lines.find(|line| !line.is_empty() && !line.starts_with('#'));
        let behind = first.and_then(|line| line.strip_prefix(INSTRUMENT));
        let has_key =
            || toml::from_str(&self.text).is_ok_and(|table: toml::Table| table.contains_key(INSTRUMENT));
        behind.is_some_and(|behind| behind.trim_start().starts_with('=')) || has_key()
    }

    /// What to say where a file of another kind was given for one in TOML.
    fn is_another(&self) -> Option<Refusal> {
        self.is_declaration().or_else(|| self.is_table())
    }

    /// What to say where a study was given for another file in TOML.
    fn is_study(&self) -> Option<Refusal> {
        let table: toml::Table = toml::from_str(&self.text).ok()?;
        let is_study = !self.is_instrument() && table.contains_key("chain") && table.contains_key("data");
        let file = self.path.display();
        is_study.then(|| {
            Refusal::Input(format!(
                "`{file}` is a study: give it to `trueaxis calibrate`, and claims or errors here"
            ))
        })
    }

    /// What to say where a table of data was given for a text: a row of numbers, and no key or declaration above it.
    fn is_table(&self) -> Option<Refusal> {
        let is_number = |cell: &str| cell.trim().replace(',', ".").parse::<f64>().is_ok();
        let is_row = |line: &&str| {
            [',', ';', '\t'].iter().any(|mark| line.contains(*mark) && line.split(*mark).all(is_number))
        };
        let above = self.text.lines().take_while(|line| !line.contains(['=', '{']));
        above.skip(1).find(is_row)?;
        let file = self.path.display();
        Some(Refusal::Input(format!(
            "`{file}` is a table of data: begin with `trueaxis init {}`, which writes a declaration and a study for it",
            report::shell_word(&file.to_string())
        )))
    }

    /// What to say where a report's data were given for a declaration.
    fn is_json(&self) -> Option<Refusal> {
        let file = self.path.display();
        self.text.trim_start().starts_with('{').then(|| {
            Refusal::Input(format!(
                "`{file}` is JSON, as reports are; needed here is a declaration or an instrument: give `instrument.toml`, which \
                 `calibrate` writes beside its report"
            ))
        })
    }

    /// What to say where a declaration was given for a file that names one.
    fn is_declaration(&self) -> Option<Refusal> {
        let opens = |line: &str| {
            let rest = line.trim_start().strip_prefix("chain")?;
            rest.starts_with(char::is_whitespace).then(|| !rest.contains('=') && rest.contains('{'))
        };
        if self.is_instrument() || !self.text.lines().any(|line| opens(line) == Some(true)) {
            return None;
        }
        let file = self.path.display();
        let name = self.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Some(Refusal::Input(format!(
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
    pub fn mistakes(&self, mistakes: &Mistakes) -> Refusal {
        let rendered = mistakes.render(&self.path.display().to_string(), &self.text);
        Refusal::Mistakes { rendered, mistakes: mistakes.clone() }
    }

    /// One mistake in this text, shown where it stands.
    #[must_use]
    pub fn mistake(&self, mistake: Mistake<Range<usize>>) -> Refusal {
        self.mistakes(&Mistakes::locate(&self.text, [mistake]))
    }
}

/// The observables that the user asked for by name; all of the chain's if he named none.
///
/// # Errors
/// A name that the chain does not declare.
pub fn observables(chain: &Chain, names: &[String]) -> Result<Vec<ObservableId>, Refusal> {
    if names.is_empty() {
        return Ok((0u16..).zip(&chain.observables).map(|(index, _)| ObservableId(index)).collect());
    }
    names.iter().map(|name| observable(chain, name)).collect()
}

/// The observable of a name.
///
/// # Errors
/// A name that the chain does not declare; the message names the nearest, or all.
pub fn observable(chain: &Chain, name: &str) -> Result<ObservableId, Refusal> {
    chain.find_observable(name).ok_or_else(|| {
        let declared = || chain.observables.iter().map(|observable| observable.name.as_str());
        let instead = names::nearest(name, declared()).map_or_else(
            || format!("it declares {}", names::listed(declared())),
            |near| format!("did you mean `{near}`?"),
        );
        Refusal::Input(format!("chain {} has no observable `{name}`; {instead}", chain.name))
    })
}
