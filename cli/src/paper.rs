//! A paper's source on the disk: its chain, and the claims file that is drawn up of it.

use std::fs;
use std::path::{Path, PathBuf};

use claims::paper::{self, Draft, Kind, MARK};
use service::Source;
use service::claims_file::ClaimsFile;

use crate::failure::Failure;
use crate::{output, source, terminal};

/// Equations without a claim: line, equation, reason.
pub type Unread = Vec<(usize, String, String)>;

/// What a file is the source of, by the end of its name.
#[must_use]
pub fn kind_of(path: &Path) -> Option<Kind> {
    match path.extension()?.to_str()? {
        "tex" | "ltx" | "latex" => Some(Kind::Tex),
        "md" | "markdown" => Some(Kind::Markdown),
        _ => None,
    }
}

/// Draws up the claims of a paper, writes them, and reads them as any other claims file.
///
/// # Errors
/// A file that cannot be read or written, a chain that nobody names.
pub fn read(
    paper: &Path,
    kind: Kind,
    chain: Option<&Path>,
    claims_file: Option<&Path>,
) -> Result<(ClaimsFile, Unread), Failure> {
    let source = source::read(paper)?;
    let declaration = match chain {
        Some(path) => source::read(path)?,
        None => match Draft::chain_named(&source.text) {
            Some(named) => source::read_beside(&source, Path::new(&named))?,
            None => source::read(&only_chain_beside(paper)?)?,
        },
    };
    let written = claims_file.map_or_else(|| paper.with_extension("claims.toml"), Path::to_owned);
    let draft = paper::draft(
        &source.text,
        kind,
        &declaration.symbolic_chain(&terminal::warn)?,
        &paper.display().to_string(),
        &from(&written, &declaration.path),
    );
    if let Ok(there) = fs::read_to_string(&written)
        && !there.starts_with(MARK)
    {
        return Err(Failure::Input(format!(
            "`{}` is there and was not drawn up by this command; give another name by --claims-file",
            written.display()
        )));
    }
    output::write_text(&written, &draft.text)?;
    terminal::note(format_args!("{} claims written to {}", draft.claims, written.display()));
    let source = Source::of_text(written, &draft.text);
    if draft.claims == 0 {
        let why = format!("`{}` states nothing about the chain that was recognised", paper.display());
        let told = draft.unread.iter().take(20);
        let below = told.map(|(line, _, reason)| format!("line {line}: {reason}")).collect();
        return Err(Failure::Listed { why, below });
    }
    Ok((ClaimsFile::of_source(source, declaration, &terminal::warn)?, draft.unread))
}

/// The only declaration in the folder of a paper.
fn only_chain_beside(paper: &Path) -> Result<PathBuf, Failure> {
    let folder = match paper.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let entries = fs::read_dir(folder).map_err(|error| Failure::read(folder, &error))?;
    let mut found: Vec<PathBuf> = entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "chain"))
        .collect();
    found.sort();
    match found.as_slice() {
        [only] => Ok(only.clone()),
        [] => Err(Failure::Input("no declaration stands beside the paper; name it by --chain".to_owned())),
        many => Err(Failure::Input(format!(
            "{} declarations stand beside the paper; name one by --chain",
            many.len()
        ))),
    }
}

/// A path as a file beside another one would name it.
fn from(file: &Path, target: &Path) -> String {
    let same = file.parent().unwrap_or(Path::new("")) == target.parent().unwrap_or(Path::new(""));
    match target.file_name().filter(|_| same) {
        Some(name) => name.to_string_lossy().into_owned(),
        None => fs::canonicalize(target).unwrap_or_else(|_| target.to_owned()).display().to_string(),
    }
}
