//! A claims file with the declaration that it is about, both texts.

use std::ops::Range;

use claims::file::{Checked, Claims, Edge, File};
use model_core::budget::{self, JointRange};
use model_core::{Chain, Mistake, Quantity};
use tables::units;

use crate::poses;
use crate::ranges::{self, RangeArgument};
use crate::refusal::Refusal;
use crate::source::Source;
use crate::warn::Warn;

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
    /// The claims of a text about a declaration; warns of what is doubtful of either.
    ///
    /// # Errors
    /// The text is no claims file, or the declaration is none.
    pub fn of_source(source: Source, declaration: Source, warn: Warn<'_>) -> Result<Self, Refusal> {
        let file: File = source.toml()?;
        Self::of_file(source, declaration, &file, warn)
    }

    /// The same of a text that was parsed.
    ///
    /// # Errors
    /// The declaration is none.
    pub fn of_file(
        source: Source,
        declaration: Source,
        file: &File,
        warn: Warn<'_>,
    ) -> Result<Self, Refusal> {
        let chain = declaration.symbolic_chain(warn)?;
        let said = Claims::read(&source.text, file, &chain, &Units(warn));
        Ok(Self { source, declaration, said })
    }

    /// Every claim with its verdict.
    ///
    /// # Errors
    /// A claim that has no verdict, with its place.
    pub fn checked(&self) -> Result<Vec<Checked<'_>>, Refusal> {
        let (checked, undecided) = self.said.check();
        match undecided.into_iter().flat_map(|unread| unread.mistakes).next() {
            None => Ok(checked),
            Some(mistake) => Err(self.source.mistake(mistake)),
        }
    }
}

/// What is written with units, as in every file of an instrument.
struct Units<'w>(Warn<'w>);

impl Edge for Units<'_> {
    fn quantity(&self, text: &str, quantity: Quantity) -> Result<f64, String> {
        units::parse(text, quantity).map_err(|error| error.to_string())
    }

    fn example(&self, quantity: Quantity) -> String {
        units::example(quantity).to_owned()
    }

    fn path(&self, chain: &Chain, text: &str) -> Result<budget::Path, Mistake<Range<usize>>> {
        poses::path(chain, text, self.0)
    }

    fn range(&self, chain: &Chain, text: &str) -> Result<JointRange, String> {
        let argument = text.parse::<RangeArgument>().map_err(str::to_owned)?;
        let ranges::Range { symbol, low, high } = ranges::read(chain, &argument, self.0)?;
        Ok(JointRange { symbol, low, high })
    }
}
