//! Claims files: TOML → the claims of [`model_core::checker`], every mistake with its place.
//!
//! [`table`] is the file as serde sees it, [`read`] what it means, [`strings`] where a byte of a text stands in the file;
//! [`show`] and [`json`] are the verdicts as people and programs read them.

mod json;
mod read;
mod show;
mod strings;
mod table;

use std::ops::Range;
use std::path::Path;

use model_core::checker::Claim;
use model_core::print::Hand;
use model_core::{Chain, Mistake};

use crate::failure::Failure;
use crate::source::Source;

pub use json::as_json;
pub use show::{Checked, as_text};
pub use strings::place_in_string;

/// A claims file that was read.
#[derive(Debug)]
pub struct ClaimsFile {
    /// The file itself.
    pub source: Source,
    /// The declaration that the claims are about.
    pub declaration: Source,
    /// What it means.
    pub chain: Chain,
    /// The same chain with the printed forms of the file's table, for output in the paper's own symbols.
    pub printed: Chain,
    /// What the file abbreviates.
    pub hand: Hand,
    /// The claims in the order of the file.
    pub claims: Vec<NamedClaim>,
}

/// One claim of a file.
#[derive(Debug)]
pub struct NamedClaim {
    /// What the file calls it.
    pub name: String,
    /// Where the name stands.
    pub place: Range<usize>,
    /// The claim.
    pub claim: Claim,
    /// The printed texts of a closed form, as the file has them; empty for other claims.
    pub texts: Vec<String>,
    /// Whether all of them are in the plain syntax of amounts.
    pub is_plain: bool,
}

impl ClaimsFile {
    /// Reads a claims file and the chain that it names.
    ///
    /// # Errors
    /// Every mistake of the claims, each with its place; or what stands in the way of reading either file.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let source = Source::read(path)?;
        let file: table::File = source.toml()?;
        let chain_path = file.chain.get_ref();
        let declaration = source.read_beside(Path::new(chain_path)).map_err(|failure| match failure {
            Failure::Read { why, .. } => {
                let path = source.beside(Path::new(chain_path));
                let message = format!("cannot read `{}`: {why}", path.display());
                source.mistake(
                    Mistake::new(file.chain.span(), message)
                        .with_help("name a declaration, relative to this file"),
                )
            }
            other => other,
        })?;
        read::claims(source, declaration, &file)
    }
}
