//! How far readings may be off, and which of them together.

use model_core::{Chain, SymbolId};

use super::correlated::{Correlated, correlated};
use super::mistakes::{Gathered, Outcome};
use super::uncertain::{Uncertain, sigma};
use super::written::{Column, Table};

/// What a table of columns says of the readings of joints and inputs.
#[derive(Debug, Clone)]
pub(super) struct UncertainReadings {
    /// Of those that are not exact, how uncertain they are.
    pub sigma: Vec<(SymbolId, Uncertain)>,
    /// Which of them are off together.
    pub correlated: Vec<Correlated>,
}

/// What a table of columns says of the readings of joints and inputs.
pub(super) fn uncertain(chain: &Chain, columns: &Table<Column>) -> Outcome<UncertainReadings> {
    let mut mistakes = Gathered::default();
    let sigma = mistakes.take(sigma(chain, columns));
    let correlated = mistakes.take(correlated(chain, columns));
    mistakes.none()?;
    let (Some(sigma), Some(correlated)) = (sigma, correlated) else {
        unreachable!("what is missing comes with a mistake")
    };
    Ok(UncertainReadings { sigma, correlated })
}
