//! Claims files on the disk, with the declarations that they name.

use std::ops::Range;
use std::path::Path;

use claims::file::{Claims, Edge, File, declaration_of_dh, declaration_of_formulas};
use claims::show::Paint;
use model_core::budget::{self, JointRange};
use model_core::{Chain, Mistake, Mistakes, Quantity};
use report::style::{BAD, GOOD, HEADING};
use service::Source;
use tables::units;

use crate::failure::Failure;
use crate::poses;
use crate::ranges::{self, RangeArgument};
use crate::{source, terminal};

/// A claims file that was read.
#[derive(Debug)]
pub struct ClaimsFile {
    /// The file itself.
    pub source: Source,
    /// The declaration that the claims are about.
    pub declaration: Source,
    /// What it says.
    pub said: Claims,
}

impl ClaimsFile {
    /// Reads a claims file and the chain that it names.
    ///
    /// # Errors
    /// Every mistake of the claims, each with its place; or what stands in the way of reading either file.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let file = Self::read_all(path)?;
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
    pub fn read_all(path: &Path) -> Result<Self, Failure> {
        let source = source::read(path)?;
        let file: File = source.toml()?;
        let declaration = Self::declaration(&source, &file)?;
        Self::of_file(source, declaration, &file)
    }

    /// The claims of a text about a declaration.
    ///
    /// # Errors
    /// The text is no claims file, or the declaration is none.
    pub fn of_source(source: Source, declaration: Source) -> Result<Self, Failure> {
        let file: File = source.toml()?;
        Self::of_file(source, declaration, &file)
    }

    fn of_file(source: Source, declaration: Source, file: &File) -> Result<Self, Failure> {
        let chain = declaration.symbolic_chain(&terminal::warn)?;
        let said = Claims::read(&source.text, file, &chain, &Units);
        Ok(Self { source, declaration, said })
    }

    /// The declaration that a file names, or the one that it writes as a table, or that of its formulas alone.
    fn declaration(source: &Source, file: &File) -> Result<Source, Failure> {
        match (&file.chain, &file.dh) {
            (Some(_), Some(table)) => Err(source
                .mistake(
                    Mistake::new(table.span(), "`chain` and `dh` are both given").with_help("leave one out"),
                )
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
                .mistake(
                    Mistake::new(0..0, "this file names no chain").with_help("chain = \"instrument.chain\""),
                )
                .into()),
        }
    }
}

/// The colours of verdicts.
#[must_use]
pub fn paint() -> Paint {
    let [good, bad, heading] = [GOOD, BAD, HEADING].map(|style| [format!("{style}"), format!("{style:#}")]);
    Paint { good, bad, heading }
}

/// What is written with units, as in every file and argument of the command.
struct Units;

impl Edge for Units {
    fn quantity(&self, text: &str, quantity: Quantity) -> Result<f64, String> {
        units::parse(text, quantity).map_err(|error| error.to_string())
    }

    fn example(&self, quantity: Quantity) -> String {
        units::example(quantity).to_owned()
    }

    fn path(&self, chain: &Chain, text: &str) -> Result<budget::Path, Mistake<Range<usize>>> {
        poses::path(chain, text)
    }

    fn range(&self, chain: &Chain, text: &str) -> Result<JointRange, String> {
        let argument = text.parse::<RangeArgument>().map_err(str::to_owned)?;
        let ranges::Range { symbol, low, high } = ranges::read(chain, &argument)?;
        Ok(JointRange { symbol, low, high })
    }
}
