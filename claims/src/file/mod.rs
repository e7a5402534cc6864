//! Claims files: TOML → the claims of [`crate::checker`], every mistake with its place.
//!
//! [`File`] is the file as serde sees it, `read` what it means, `strings` where a byte of a text stands in the file. What is
//! written at the edge of the house, quantities with their units say, an [`Edge`] reads.

mod dh;
mod free;
mod read;
mod strings;
mod table;

use std::ops::Range;

use model_core::budget::{JointRange, Path};
use model_core::print::Hand;
use model_core::{Chain, Mistake, Quantity};

use crate::checker::{CheckError, Checker, Claim, Verdict};

pub use dh::declaration as declaration_of_dh;
pub use free::declaration as declaration_of_formulas;
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
    /// The claims in the order of the file, as far as they can be read.
    pub claims: Vec<NamedClaim>,
    /// The claims that cannot be read.
    pub unread: Vec<Unread>,
    /// What is wrong outside of claims: in the table of symbols say.
    pub mistakes: Vec<Mistake<Range<usize>>>,
}

/// A claim without a verdict.
#[derive(Debug, Clone)]
pub struct Unread {
    /// What the file calls it.
    pub name: String,
    /// Where the name stands.
    pub place: Range<usize>,
    /// Why.
    pub mistakes: Vec<Mistake<Range<usize>>>,
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
    /// The same in another convention that the print leaves open, if it leaves one open.
    pub otherwise: Option<Claim>,
    /// What the print does not define, where it was read as it usually is: a formula that holds so says what it means, any other
    /// is not judged.
    pub doubt: Option<Mistake<Range<usize>>>,
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
    /// Reads the claims of a file about a declaration; `text` is the file's. What cannot be read is kept with its mistakes, and
    /// voids nothing else.
    #[must_use]
    pub fn read(text: &str, file: &File, chain: &Chain, edge: &dyn Edge) -> Self {
        read::claims(text, file, chain, edge)
    }

    /// Every mistake of the file.
    #[must_use]
    pub fn mistakes(&self) -> Vec<Mistake<Range<usize>>> {
        let mut found: Vec<Mistake<Range<usize>>> = Vec::new();
        for mistake in self.mistakes.iter().chain(self.unread.iter().flat_map(|unread| &unread.mistakes)) {
            // A symbol that is unknown in one formula is unknown in all.
            let known = |earlier: &Mistake<Range<usize>>| earlier.message == mistake.message;
            if !(mistake.message.starts_with("unknown ") && found.iter().any(known)) {
                found.push(mistake.clone());
            }
        }
        found
    }

    /// Every claim that was read, with its verdict; and those that have none.
    #[must_use]
    pub fn check(&self) -> (Vec<Checked<'_>>, Vec<Unread>) {
        let mut checker = Checker::new(&self.chain);
        let (mut checked, mut undecided) = (Vec::with_capacity(self.claims.len()), Vec::new());
        for claim in &self.claims {
            match claim.verdict(&mut checker) {
                Ok(verdict) => match claim.doubt.clone().filter(|_| !verdict.holds()) {
                    Some(doubt) => undecided.push(claim.without_verdict(doubt)),
                    None => checked.push(Checked { claim, verdict }),
                },
                Err(error) => {
                    let mistake = Mistake::new(claim.place.clone(), error.to_string());
                    undecided.push(claim.without_verdict(mistake));
                }
            }
        }
        (checked, undecided)
    }
}

impl NamedClaim {
    fn without_verdict(&self, why: Mistake<Range<usize>>) -> Unread {
        Unread { name: self.name.clone(), place: self.place.clone(), mistakes: vec![why] }
    }

    /// What is said of the claim.
    ///
    /// # Errors
    /// It cannot be decided, or the print can be read in two ways that have different verdicts.
    pub fn verdict(&self, checker: &mut Checker<'_>) -> Result<Verdict, CheckError> {
        let verdict = checker.check(&self.claim)?;
        if !verdict.holds()
            && let Some(otherwise) = &self.otherwise
            && checker.check(otherwise).is_ok_and(|verdict| verdict.holds())
        {
            return Err(CheckError::TwoReadings("R_z(…)".to_owned()));
        }
        Ok(verdict)
    }
}
