//! Claims files on the disk, with the declarations that they name.

use std::ops::Range;
use std::path::Path;

use claims::file::{Claims, Edge, File};
use claims::show::Paint;
use model_core::budget::{self, JointRange};
use model_core::{Chain, Mistake, Quantity};
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
        let source = source::read(path)?;
        let file: File = source.toml()?;
        let chain_path = file.chain.get_ref();
        let declaration =
            source::read_beside(&source, Path::new(chain_path)).map_err(|failure| match failure {
                Failure::Read { why, .. } => {
                    let path = source.beside(Path::new(chain_path));
                    let message = format!("cannot read `{}`: {why}", path.display());
                    source
                        .mistake(
                            Mistake::new(file.chain.span(), message)
                                .with_help("name a declaration, relative to this file"),
                        )
                        .into()
                }
                other => other,
            })?;
        let chain = declaration.symbolic_chain(&terminal::warn)?;
        let said = Claims::read(&source.text, &file, &chain, &Units);
        let said = said.map_err(|mistakes| source.mistakes(&mistakes))?;
        Ok(Self { source, declaration, said })
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
