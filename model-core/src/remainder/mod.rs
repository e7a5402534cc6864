//! The remainder: a proven bound on |exact − first order| over a box of errors, and a search for the largest one.
//!
//! The error of an observable is a power series in the errors that converges everywhere. Its part of degree two is
//! bounded cluster by cluster (`cluster`), all higher parts together by a majorant series (`majorant`); every
//! number on the way is rounded up (`upper`). [`search`] looks for a large remainder, to show how sharp the bound is.
//! The derivation is in the book, page "Remainder".

mod angles;
mod cells;
mod cluster;
mod domain;
mod enclose;
mod interval;
mod isometry;
mod majorant;
mod parameter;
mod poles;
mod quadratic;
mod reach;
mod search;
mod shares;
mod sight;
mod sums;
mod turned;
mod upper;
mod vector;
mod words;

use crate::chain::reading::{Measures, Reading};
use crate::chain::{Chain, ObservableId};
use crate::forms::FormError;
use crate::symbol::SymbolId;
use sight::Sight;
use upper::Upper;

pub(crate) use parameter::Parameter;
pub(crate) use poles::{along_path, keep_away};

pub use domain::{Domain, DomainError};
pub use search::{Found, search};
pub use words::{text, unit};

/// A bound on the length of the remainder, exact minus first order.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Of which observable.
    pub observable: ObservableId,
    /// The bound: never exceeded in the domain. No unit for a direction, metres for a point and for ranges, radians for
    /// angles; of several readings, the root of the sum of their squares.
    pub value: f64,
    /// What it is made of.
    pub parts: Parts,
}

/// What a bound is made of.
#[derive(Debug, Clone, PartialEq)]
pub enum Parts {
    /// Of components, of which the whole vector is bounded: the two numbers add up to the bound, rounded up, unless the
    /// errors are so large that less than their sum is possible.
    Vector {
        /// For products of two errors.
        second_order: f64,
        /// For products of three errors and more.
        tail: f64,
        /// Whether the bound is their sum. If not, it is what turns and shifts by such errors can do at all.
        is_sum: bool,
        /// What share each pair of errors has in the products of two errors, as their lengths add up, largest first. All pairs
        /// together have a share of one; of
        /// more than 500 errors the pairs of the 500 largest are listed.
        shares: Vec<PairShare>,
    },
    /// The bound of each reading, in order.
    Readings(Vec<f64>),
}

/// The share of a pair of errors in a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairShare {
    /// One error.
    pub one: SymbolId,
    /// The other, or the same again.
    pub other: SymbolId,
    /// Between 0 and 1.
    pub share: f64,
}

/// Bounds |exact − first order| of an observable over a domain.
///
/// Joints without a range turn freely; the bound then holds at all of their angles.
///
/// # Errors
/// [`DomainError`] if a joint or input without a range stands outside of sines and cosines, a denominator vanishes, or
/// a reading is lost in the domain or is the angle off the axis. The bound of some components is that of the whole vector.
///
/// # Example
///
/// ```
/// use model_core::{Chain, remainder::{Domain, bound}};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let (edge, index) = (chain.find_observable("edge").ok_or("none")?, chain.find_symbol("index").ok_or("none")?);
/// let mut domain = Domain::new(&chain);
/// domain.set_range(&chain, index, -1e-3, 1e-3)?;
/// let bound = bound(&chain, edge, &domain)?.value;
/// // What the first order leaves out of a turn by ε is ε²/2 to next order.
/// assert!(bound >= 0.5e-6 && bound < 0.51e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bound(chain: &Chain, observable: ObservableId, domain: &Domain) -> Result<Bound, DomainError> {
    let shown = chain.observable(observable);
    has_first_order(chain, observable)?;
    if shown.has_components_only() {
        let clusters = cluster::clusters(chain, observable, domain)?;
        let whole = vector::of_clusters(&clusters);
        let parts = Parts::Vector {
            second_order: whole.second_order.get(),
            tail: whole.tail.get(),
            is_sum: whole.is_by_degree(),
            shares: shares::shares(&clusters),
        };
        return Ok(Bound { observable, value: whole.remainder().get(), parts });
    }
    let readings = if shown.is_orientation() {
        let clusters = cluster::clusters(chain, observable, domain)?;
        let one = turned::bound(&clusters)
            .map_err(|sum_rad| DomainError::Turned { observable: shown.name.clone(), sum_rad })?;
        // The components together are no longer than the vector that they are of.
        return Ok(Bound {
            observable,
            value: one.get(),
            parts: Parts::Readings(vec![one.get(); shown.shown.len()]),
        });
    } else {
        let sight = Sight::new(chain, observable, domain)?;
        shown.shown.iter().map(|reading| sight.bound(reading, domain)).collect::<Result<Vec<f64>, _>>()?
    };
    let squares: Upper = readings.iter().map(|&one| Upper::exact(one) * Upper::exact(one)).sum();
    Ok(Bound { observable, value: squares.root().get(), parts: Parts::Readings(readings) })
}

/// Whether what is shown has a first order, and one unit.
fn has_first_order(chain: &Chain, id: ObservableId) -> Result<(), DomainError> {
    let observable = chain.observable(id);
    let name = || observable.name.clone();
    if let Some(other) = observable.of_other_unit() {
        return Err(DomainError::Units { observable: name(), one: observable.label(0), other: other.word });
    }
    if let Some(reading) = observable.shown.iter().find(|reading| reading.image().is_some()) {
        return Err(FormError::Image { observable: name(), reading: reading.words() }.into());
    }
    let is_rough = |reading: &&Reading| reading.measures == Measures::OffAxis;
    match observable.shown.iter().find(is_rough) {
        Some(reading) => Err(DomainError::NoProof { observable: name(), reading: reading.words() }),
        None => Ok(()),
    }
}
