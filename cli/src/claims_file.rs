//! Claims files on the disk, with the declarations that they name.

use std::path::Path;

use claims::file::{File, declaration_of_dh, declaration_of_formulas};
use claims::show::Paint;
use model_core::{Mistake, Mistakes};
use report::style::{BAD, GOOD, HEADING};
use service::Source;
use service::claims_file::ClaimsFile;

use crate::failure::Failure;
use crate::{source, terminal};

/// Reads a claims file and the chain that it names.
///
/// # Errors
/// Every mistake of the claims, each with its place; or what stands in the way of reading either file.
pub fn read(path: &Path) -> Result<ClaimsFile, Failure> {
    let file = read_all(path)?;
    let mistakes = file.said.mistakes();
    if mistakes.is_empty() {
        Ok(file)
    } else {
        Err(file.source.mistakes(&Mistakes::locate(&file.source.text, mistakes)).into())
    }
}

/// The same where what cannot be read voids nothing but its own claim.
///
/// # Errors
/// What stands in the way of reading either file.
pub fn read_all(path: &Path) -> Result<ClaimsFile, Failure> {
    let source = source::read(path)?;
    let file: File = source.toml()?;
    let declaration = declaration(&source, &file)?;
    Ok(ClaimsFile::of_file(source, declaration, &file, &terminal::warn)?)
}

/// The declaration that a file names, or the one that it writes as a table, or that of its formulas alone.
fn declaration(source: &Source, file: &File) -> Result<Source, Failure> {
    match (&file.chain, &file.dh) {
        (Some(_), Some(table)) => Err(source
            .mistake(Mistake::new(table.span(), "`chain` and `dh` are both given").with_help("leave one out"))
            .into()),
        (Some(chain), None) => {
            source::read_beside(source, Path::new(chain.get_ref())).map_err(|failure| match failure {
                Failure::Read { why, .. } => {
                    let path = source.beside(Path::new(chain.get_ref()));
                    let message = format!("cannot read `{}`: {why}", path.display());
                    source
                        .mistake(
                            Mistake::new(chain.span(), message)
                                .with_help("name a declaration, relative to this file"),
                        )
                        .into()
                }
                other => other,
            })
        }
        (None, Some(table)) => {
            let text = declaration_of_dh(table.get_ref()).map_err(|mistake| source.mistake(mistake))?;
            Ok(Source::of_text("the Denavit-Hartenberg table", &text))
        }
        (None, None) if file.has_equalities_only() => {
            Ok(Source::of_text("the symbols of the formulas", &declaration_of_formulas(file)))
        }
        (None, None) => Err(source
            .mistake(Mistake::new(0..0, "this file names no chain").with_help("chain = \"instrument.chain\""))
            .into()),
    }
}

/// The colours of verdicts.
#[must_use]
pub fn paint() -> Paint {
    let [good, bad, heading] = [GOOD, BAD, HEADING].map(|style| [format!("{style}"), format!("{style:#}")]);
    Paint { good, bad, heading }
}
