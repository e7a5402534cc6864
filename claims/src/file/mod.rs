//! Claims files: TOML → the claims of [`crate::checker`], every mistake with its place.
//!
//! [`File`] is the file as serde sees it, `read` what it means, `strings` where a byte of a text stands in the file. What is
//! written at the edge of the house, quantities with their units say, an [`Edge`] reads.

mod read;
mod strings;
mod table;

use std::ops::Range;

use model_core::budget::{JointRange, Path};
use model_core::print::Hand;
use model_core::{Chain, Mistake, Mistakes, Quantity};

use crate::checker::{Claim, Verdict};

pub use table::File;

/// Reads what people write with units.
pub trait Edge {
    /// A quantity with its unit, in SI.
    ///
    /// # Errors
    /// What is wrong, in words.
    fn quantity(&self, text: &str, quantity: Quantity) -> Result<f64, String>;

    /// A quantity as somebody may write it.
    fn example(&self, quantity: Quantity) -> String;

    /// Poses along a path: `alpha=t, range=10 m`.
    ///
    /// # Errors
    /// What is wrong, with its place in the text.
    fn path(&self, chain: &Chain, text: &str) -> Result<Path, Mistake<Range<usize>>>;

    /// The range of a joint or input: `elevation=10 deg..80 deg`.
    ///
    /// # Errors
    /// What is wrong, in words.
    fn range(&self, chain: &Chain, text: &str) -> Result<JointRange, String>;
}

/// What a claims file says.
#[derive(Debug)]
pub struct Claims {
    /// The declaration that the claims are about.
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

/// A claim and what is said of it.
#[derive(Debug)]
pub struct Checked<'a> {
    /// The claim.
    pub claim: &'a NamedClaim,
    /// What is said of it.
    pub verdict: Verdict,
}

impl Claims {
    /// Reads the claims of a file about a declaration; `text` is the file's.
    ///
    /// # Errors
    /// Every mistake, each with its place.
    pub fn read(text: &str, file: &File, chain: &Chain, edge: &dyn Edge) -> Result<Self, Mistakes> {
        read::claims(text, file, chain, edge)
    }
}
