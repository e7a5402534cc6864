//! The caller's chain at other estimates: where residual and columns are taken anew.

use crate::error::Error;
use crate::problem::{Place, Problem};

/// What the caller gives at a point: everything that hangs on the estimates.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearisation {
    /// Observed less exact chain with the effects in it: N·m values.
    pub residual: Vec<f64>,
    /// Column of each declared error: N·m values each.
    pub declared: Vec<Vec<f64>>,
    /// Column of each place of the problem: N·m values each.
    pub places: Vec<Vec<f64>>,
}

/// An effect in the exact chain: an amount in each row at a place of the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Amount {
    /// Number of the place in [`Problem::places`].
    pub place: usize,
    /// Its amount in each row, rad or m.
    pub amount: Vec<f64>,
}

/// A chain that can be evaluated at estimates with effects.
pub trait Linearise {
    /// Residual and columns at these estimates of the declared errors, with these effects in the exact chain.
    ///
    /// # Errors
    ///
    /// Where the chain cannot be evaluated there, in words.
    fn at(&self, declared: &[f64], effects: &[Amount]) -> Result<Linearisation, String>;
}

/// Checks what a caller gave.
pub(crate) fn checked(
    problem: &Problem,
    given: Result<Linearisation, String>,
) -> Result<Linearisation, Error> {
    let given = given.map_err(|reason| Error::Linearise { reason })?;
    let values = problem.values();
    let lists = std::iter::once(&given.residual).chain(&given.declared).chain(&given.places);
    for list in lists {
        if list.len() != values {
            return Err(Error::Length { what: "a new column".into(), found: list.len(), wanted: values });
        }
        if let Some((at, &value)) = list.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            return Err(Error::NotFinite { what: "a new column".into(), at, value });
        }
    }
    let (declared, places) = (given.declared.len(), given.places.len());
    if declared != problem.declared.len() || places != problem.places.len() {
        let wanted = problem.declared.len() + problem.places.len();
        return Err(Error::Length { what: "the new columns".into(), found: declared + places, wanted });
    }
    Ok(given)
}

/// The first point: the problem as it was given.
pub(crate) fn as_given(problem: &Problem) -> Linearisation {
    Linearisation {
        residual: problem.residual.clone(),
        declared: problem.declared.iter().map(|error| error.column.clone()).collect(),
        places: problem.places.iter().map(|place: &Place| place.column.clone()).collect(),
    }
}
