//! The forms of the error of an observable: truncated at an order in the errors, or untruncated.
//!
//! Nothing is typed in: every form follows from the product of the chain's factors, by the grading in the errors.

mod exact_symbolic;
mod graded;
mod reading;
mod steps;
mod table;

use crate::algebra::{AlgebraError, Fraction, Poly};
use crate::chain::reading::Reading;
use crate::chain::{Axis, Chain, ObservableId};
use crate::symbol::{SymbolId, SymbolKind};
use reading::NoSeries;

pub use exact_symbolic::exact_symbolic;
pub use reading::ReadSeries;
pub use steps::{Elementary, Group, Steps, steps};
pub use table::{Table, TableError, table};

/// What the errors add to what an observable shows, up to an order in the errors. Components of a direction have no unit,
/// those of a point and ranges are in metres, angles in radians.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    /// Of which observable.
    pub observable: ObservableId,
    /// Products of more than this many errors are dropped.
    pub order: u32,
    /// One for each number that is shown. A quotient only where the algebra cannot carry the division out, with what does not
    /// depend on the errors below; its first-order columns are then those of what stands above.
    pub components: Vec<Fraction>,
    /// For each number that is shown, what has to be positive for its form to be right: with `cos E` for the distance from an
    /// axis, an elevation has its sign only where `cos E > 0`.
    pub positive: Vec<Vec<Poly>>,
}

/// What to do about a chain that is too long to be multiplied out.
fn instead(error: &AlgebraError) -> &'static str {
    match error {
        AlgebraError::TooLarge => {
            "; the chain is too long for a closed form, which `bound`, `eval`, `generate` and `calibrate` do not need; or observe a \
             body further down"
        }
        _ => "",
    }
}

/// Terms that a form may have on its way; far beyond what anybody reads, and still in memory.
const TERMS_LIMIT: usize = 1_000_000;

/// What has no closed form.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FormError {
    /// A factor of the chain.
    #[error("R{axis} of body `{body}`: {error}{}", instead(error))]
    Factor {
        /// The body whose factor it is.
        body: String,
        /// The axis of the rotation.
        axis: Axis,
        /// What the algebra says.
        error: AlgebraError,
    },
    /// A reading that divides by a root which is no canonical form.
    #[error(
        "the {reading} of `{observable}` has no closed form: a length stands in it whose square has no root; \
         observe components, which have one: `x, y, z of …`"
    )]
    Root {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
    },
    /// A reading that is no smooth function of the errors where they are zero.
    #[error(
        "the {reading} of `{observable}` has no closed form: where there are no errors it is no smooth function of them; \
         observe components, which have one: `x, y, z of …`"
    )]
    NotSmooth {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
    },
    /// An image point.
    #[error(
        "the {reading} of `{observable}` has no closed form yet: image points are computed, and their formulas are not written; \
         use `eval`, `generate`, `budget` and `calibrate`, or derive the point in the frame of the camera: `point(…) of target in camera`"
    )]
    Image {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
    },
    /// A reading without truncation.
    #[error(
        "the {reading} of `{observable}` has no exact form without an arc tangent or a root; claim it to an order, or components: \
         `x, y, z of …`"
    )]
    NotExact {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
    },
}

impl FormError {
    /// Whether it says that a reading has no closed form, while the chain it is of is as it should be.
    #[must_use]
    pub fn is_of_no_closed_form(&self) -> bool {
        matches!(self, Self::Root { .. } | Self::NotSmooth { .. } | Self::Image { .. })
    }

    pub(crate) fn new(body: &str, axis: Axis, error: AlgebraError) -> Self {
        Self::Factor { body: body.to_owned(), axis, error }
    }

    fn of_reading(chain: &Chain, observable: ObservableId, reading: &Reading, why: NoSeries) -> Self {
        let (observable, reading) = (chain.observable(observable).name.clone(), reading.words());
        match why {
            NoSeries::Root => Self::Root { observable, reading },
            NoSeries::NotSmooth => Self::NotSmooth { observable, reading },
            NoSeries::Image => Self::Image { observable, reading },
        }
    }
}

/// What the errors add to what an observable shows, up to `order` in the errors, derived from the exact product by
/// truncating while multiplying.
///
/// # Errors
/// [`FormError`] if a rotation by a nominal amount is no [`AngleSum`](crate::algebra::AngleSum) (a chain from
/// [`validate`](crate::validate) has none such), if the form would have more than a million terms, or if a reading has no closed
/// form.
pub fn derive(chain: &Chain, observable: ObservableId, order: u32) -> Result<Form, FormError> {
    derive_within(chain, observable, order, TERMS_LIMIT)
}

/// The same for those who have no use for a form that has more than so many terms on its way.
pub(crate) fn derive_within(
    chain: &Chain,
    observable: ObservableId,
    order: u32,
    terms: usize,
) -> Result<Form, FormError> {
    if chain.observable(observable).is_orientation() {
        let turned = reading::rotation(&graded::axes_up_to(chain, observable, order, terms)?);
        let axes = chain.observable(observable).shown.iter().filter_map(Reading::rotation);
        let components: Vec<Fraction> =
            axes.map(|axis| Fraction::whole(turned[axis.index()].clone())).collect();
        let positive = vec![Vec::new(); components.len()];
        return Ok(Form { observable, order, components, positive });
    }
    let parts = graded::parts_up_to(chain, observable, order, terms)?;
    let (mut components, mut positive) = (Vec::new(), Vec::new());
    for reading in &chain.observable(observable).shown {
        let read = reading::read(reading, &parts);
        let ReadSeries { value, positive: roots } =
            read.map_err(|why| FormError::of_reading(chain, observable, reading, why))?;
        components.push(value);
        positive.push(roots);
    }
    Ok(Form { observable, order, components, positive })
}

/// The vector of an observable without errors, in the frame that it is seen in.
///
/// # Errors
/// The chain has no closed form.
pub fn nominal(chain: &Chain, observable: ObservableId) -> Result<[Poly; 3], FormError> {
    let parts = graded::parts_up_to(chain, observable, 0, TERMS_LIMIT)?;
    match parts.into_iter().next() {
        Some(nominal) => Ok(nominal),
        None => unreachable!("the part of degree zero is always there"),
    }
}

/// What the errors add to the vector of an observable, whatever it shows of it; refused if it has more than so many terms on
/// its way.
pub(crate) fn derive_vector_within(
    chain: &Chain,
    observable: ObservableId,
    order: u32,
    terms: usize,
) -> Result<Form, FormError> {
    let parts = graded::parts_up_to(chain, observable, order, terms)?;
    let component = |axis: usize| {
        let added = parts.iter().skip(1).map(|part| &part[axis]);
        Fraction::whole(added.fold(Poly::zero(), |sum, part| &sum + part))
    };
    let components = (0..3).map(component).collect();
    Ok(Form { observable, order, components, positive: vec![Vec::new(); 3] })
}

/// What the errors would add to another reading of the same vector.
///
/// # Errors
/// The reading has no such form.
pub fn derive_reading(
    chain: &Chain,
    observable: ObservableId,
    order: u32,
    reading: &Reading,
) -> Result<ReadSeries, FormError> {
    let parts = graded::parts_up_to(chain, observable, order, TERMS_LIMIT)?;
    reading::read(reading, &parts).map_err(|why| FormError::of_reading(chain, observable, reading, why))
}

impl Form {
    /// The first-order columns: for every error of the chain, in order, what multiplies it in each component, above the
    /// stroke if that is a quotient. Errors and numbers that are not shown have zeros.
    #[must_use]
    pub fn columns(&self, chain: &Chain) -> Vec<(SymbolId, [Poly; 3])> {
        let is_error = error_table(chain);
        let mut columns: Vec<(SymbolId, [Poly; 3])> =
            chain.symbols_of(SymbolKind::Error).map(|error| (error, Default::default())).collect();
        for (place, component) in self.components.iter().enumerate() {
            let parts = component.above.collect_by(|symbol| is_error[symbol.index()]);
            for (monomial, coefficient) in parts {
                if let [(error, 1)] = monomial.as_slice()
                    && let Ok(index) = columns.binary_search_by_key(error, |(symbol, _)| *symbol)
                {
                    columns[index].1[place] = coefficient;
                }
            }
        }
        columns
    }

    /// Whether no component is a quotient.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.components.iter().all(Fraction::is_whole)
    }
}

/// Which symbols are errors, by [`SymbolId`].
pub(crate) fn error_table(chain: &Chain) -> Vec<bool> {
    chain.symbols.iter().map(|symbol| symbol.kind == SymbolKind::Error).collect()
}
