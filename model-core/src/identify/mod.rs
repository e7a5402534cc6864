//! Structural identifiability: what no data can tell apart, before any data exist.
//!
//! The columns of the first-order form are functions of joints and inputs. An observable shows the sum of errors times
//! columns, and functions are told apart by their coefficients in the basis of the canonical form; so each basis
//! function gives one exact linear equation between the errors and what is seen. Elimination then says which
//! combinations of errors are determined. Constants do not vary while data are taken, so they are coefficients here, not
//! functions: a shift and a tilt at the end of a constant arm are one. A constant declared as zero counts as zero, an angle
//! declared as so many quarter turns as these, any other as a size that no special relation holds for. Where formulas over all
//! values of the constants are too large, the answer is that at their declared values (`at_values`).

mod at_values;
mod cancel;
mod candidate;
mod columns;
mod elimination;
mod image;
mod modular;
mod pair;
mod place;
mod words;

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use crate::algebra::{AlgebraError, BasisFunction, Poly, Rational};
use crate::chain::{Chain, Factor, ObservableId};
use crate::forms::{self, FormError};
use crate::symbol::{Quantity, SymbolId, SymbolKind};
use at_values::AtValues;
use cancel::{cancelled, cancelled_row};
use elimination::{Echelon, TooLarge, entry};
use modular::Row;
use pair::Pair;

pub use candidate::{Candidate, Mistaken, Verdict, mistaken_for};
pub use words::{mistaken_text, text};

/// What a value is off its own number of quarter turns at most, as a share of it, where only rounding is between them.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// Terms that a form may have on its way to equations; with more, their ratios are beyond use.
const FORM_LIMIT: usize = 60_000;

/// Quarter turns at most that count as such: beyond, any number is near some.
const MOST_QUARTERS: f64 = 16.0;

/// What can be told apart from an observable, or from several together, to first order.
#[derive(Debug, Clone, PartialEq)]
pub struct Identifiability {
    /// Seen together.
    pub observables: Vec<ObservableId>,
    /// For which constants this holds.
    pub holds: Holds,
    /// How many errors are declared.
    pub declared: usize,
    /// Errors without any influence.
    pub invisible: Vec<SymbolId>,
    /// Errors whose influence is the same function up to a factor that does not vary: at least two in each group.
    pub alike: Vec<Vec<Alike>>,
    /// Errors whose influence is a combination of that of several others.
    pub combinations: Vec<Dependence>,
    /// The combinations of errors that data determine; as many as there are independent columns.
    pub estimable: Vec<Vec<(SymbolId, Poly)>>,
}

/// For which values of the constants an answer holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// For all but special ones; decided by formulas.
    Everywhere,
    /// For the declared ones; decided by exact arithmetic at so many random poses, with ratios rounded to six digits.
    AtDeclaredValues {
        /// At how many.
        poses: usize,
    },
}

/// A member of a group of errors that are alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Alike {
    /// The error.
    pub error: SymbolId,
    /// Its influence over that of the first of the group: `numerator / denominator` in constants.
    pub ratio: Ratio,
}

/// A quotient of two polynomials in constants.
#[derive(Debug, Clone, PartialEq)]
pub struct Ratio {
    /// Above.
    pub numerator: Poly,
    /// Below, never zero.
    pub denominator: Poly,
}

/// An error whose influence is `Σ ratio · influence`.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependence {
    /// The error.
    pub error: SymbolId,
    /// The others, with their ratios.
    pub others: Vec<(SymbolId, Ratio)>,
}

/// Why it cannot be said what data tell apart.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum IdentifyError {
    /// An observable has no first-order form.
    #[error(transparent)]
    Form(#[from] FormError),
    /// There is a pole at the declared values of the constants.
    #[error(
        "an amount has no value at any pose, because a sine or cosine of a constant in a denominator is zero; \
         declare the constant with another value"
    )]
    Poles,
}

/// Computes what can be told apart from observables of a chain, seen together.
///
/// # Errors
/// See [`IdentifyError`].
///
/// # Example
///
/// Two turns about the same axis are one to all data:
///
/// ```
/// use model_core::{Chain, identify::identify};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index), Rx(wobble); } \
///      body mark on top { position_error: Rz(offset); } observe edge: direction(1, 0, 0) of mark; }",
/// )?;
/// let edge = chain.find_observable("edge").ok_or("no such observable")?;
/// let found = identify(&chain, &[edge])?;
/// let name = |id| chain.symbol(id).name.as_str();
/// assert_eq!(found.alike[0].iter().map(|one| name(one.error)).collect::<Vec<_>>(), ["index", "offset"]);
/// // The edge lies along x: nothing shows a turn about it.
/// assert_eq!(found.invisible.iter().map(|&id| name(id)).collect::<Vec<_>>(), ["wobble"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn identify(chain: &Chain, observables: &[ObservableId]) -> Result<Identifiability, IdentifyError> {
    let errors: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
    let found = match equations(chain, observables, &errors, Echelon::default()) {
        Ok(echelon) => {
            let columns: Vec<Column<Ratio>> =
                (0..errors.len()).map(|index| Column::new(&echelon, index)).collect();
            let row = |(pivot, row): &(usize, Row)| {
                let row = cancelled_row(row, *pivot);
                row.into_iter().map(|(column, value)| (errors[column], value)).collect()
            };
            let estimable = echelon.rows().iter().map(row).collect();
            answer(&errors, &columns, estimable, Holds::Everywhere)
        }
        Err(OutOfReach::ForFormulas) => {
            let found = AtValues::new(chain, observables, &errors)?;
            let columns: Vec<Column<Pair>> =
                (0..errors.len()).map(|index| Column::at_values(&found, index)).collect();
            let row = |(_, row): &(usize, Vec<Pair>)| {
                let parts = errors.iter().zip(row).filter(|(_, value)| !value.is_zero());
                parts.map(|(error, value)| (*error, value.ratio().numerator)).collect()
            };
            let estimable = found.rows.iter().map(row).collect();
            answer(&errors, &columns, estimable, Holds::AtDeclaredValues { poses: found.poses })
        }
        Err(OutOfReach::For(error)) => return Err(error.into()),
    };
    Ok(Identifiability { observables: observables.to_vec(), ..found })
}

/// What columns and combinations say; the observables are still to be named.
fn answer<Q: Quotient>(
    errors: &[SymbolId],
    columns: &[Column<Q>],
    estimable: Vec<Vec<(SymbolId, Poly)>>,
    holds: Holds,
) -> Identifiability {
    let invisible =
        columns.iter().filter(|column| column.is_zero()).map(|column| errors[column.index]).collect();
    let mut groups: Vec<Vec<(usize, Q)>> = Vec::new();
    for column in columns.iter().filter(|column| !column.is_zero()) {
        let found = groups.iter_mut().find_map(|group| {
            let ratio = column.over(&columns[group[0].0])?;
            Some((group, ratio))
        });
        match found {
            Some((group, ratio)) => group.push((column.index, ratio)),
            None => groups.push(vec![(column.index, Q::one())]),
        }
    }
    // A group that is no multiple of one pivot is a combination of several.
    let combinations = groups
        .iter()
        .map(|group| &columns[group[0].0])
        .filter(|column| column.parts.len() > 1)
        .map(|column| Dependence {
            error: errors[column.index],
            others: column.parts.iter().map(|(pivot, ratio)| (errors[*pivot], ratio.ratio())).collect(),
        })
        .collect();
    let member = |(index, ratio): (usize, Q)| Alike { error: errors[index], ratio: ratio.ratio() };
    let alike = groups
        .into_iter()
        .filter(|group| group.len() > 1)
        .map(|group| group.into_iter().map(member).collect())
        .collect();
    Identifiability {
        observables: Vec::new(),
        holds,
        declared: errors.len(),
        invisible,
        alike,
        combinations,
        estimable,
    }
}

/// Why there are no formulas over all values of the constants.
#[derive(Debug)]
enum OutOfReach {
    /// They are too large, or what is shown has none.
    ForFormulas,
    /// Nothing can be said at all.
    For(FormError),
}

impl From<TooLarge> for OutOfReach {
    fn from(_: TooLarge) -> Self {
        Self::ForFormulas
    }
}

impl From<FormError> for OutOfReach {
    fn from(error: FormError) -> Self {
        match error {
            FormError::Root { .. }
            | FormError::Image { .. }
            | FormError::Factor { error: AlgebraError::TooLarge, .. } => Self::ForFormulas,
            FormError::Factor { .. } | FormError::NotSmooth { .. } | FormError::NotExact { .. } => {
                Self::For(error)
            }
        }
    }
}

/// One equation for each observable, axis and basis function, added to an echelon. Columns are indices into `errors`.
fn equations(
    chain: &Chain,
    observables: &[ObservableId],
    errors: &[SymbolId],
    mut echelon: Echelon,
) -> Result<Echelon, OutOfReach> {
    let mut equations: Vec<Row> = Vec::new();
    let special = special(chain);
    let varies = |symbol: SymbolId| {
        matches!(
            chain.symbol(symbol).kind,
            SymbolKind::Joint | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle
        )
    };
    for &observable in observables {
        let form = forms::derive_within(&without_placement(chain, observable), observable, 1, FORM_LIMIT)?;
        let columns = form.columns(chain);
        for axis in 0..3 {
            let mut rows: BTreeMap<BasisFunction, Row> = BTreeMap::new();
            for (index, error) in errors.iter().enumerate() {
                let Ok(column) = columns.binary_search_by_key(error, |(symbol, _)| *symbol) else { continue };
                let components = &columns[column].1;
                for (function, coefficient) in
                    put_in_where_possible(&components[axis], &special).split_by(varies)
                {
                    rows.entry(function).or_default().push((index, coefficient));
                }
            }
            equations.extend(rows.into_values());
        }
    }
    echelon.insert_all(&equations, errors.len())?;
    Ok(echelon)
}

/// The chain without the constant transforms between the ground and the first thing that moves or errs on the way to an
/// observable: they turn what is seen as a whole, which takes nothing from it and adds nothing. Where no whole vector is
/// shown, or not in the ground frame, they stay.
fn without_placement(chain: &Chain, observable: ObservableId) -> Chain {
    let mut chain = chain.clone();
    if !chain.observable(observable).is_vector() || chain.observable(observable).frame.is_some() {
        return chain;
    }
    for body in chain.path(chain.observable(observable).body) {
        let is_fixed = |factor: &Factor| {
            let symbols = factor.amount.symbols();
            symbols.iter().all(|id| matches!(chain.symbol(*id).kind, SymbolKind::Pi | SymbolKind::Constant))
        };
        let factors = &chain.bodies[usize::from(body.0)].factors;
        let fixed = factors.iter().take_while(|factor| is_fixed(factor)).count();
        let is_all = fixed == factors.len();
        chain.bodies[usize::from(body.0)].factors.drain(..fixed);
        if !is_all {
            break;
        }
    }
    chain
}

/// The constants for whose declared values special relations hold, with what they are: zero, and of angles quarter turns, as a
/// body is turned onto the next axis.
#[must_use]
pub fn special(chain: &Chain) -> Vec<(SymbolId, Poly)> {
    let value = |id: SymbolId| {
        let symbol = chain.symbol(id);
        let value = symbol.value?;
        if value == 0.0 {
            return Some(Poly::zero());
        }
        if symbol.quantity != Quantity::Angle {
            return None;
        }
        let quarters = (value / FRAC_PI_2).round();
        let is_quarters = (value - quarters * FRAC_PI_2).abs() <= ROUNDED * value.abs();
        let count =
            if is_quarters && quarters.abs() <= MOST_QUARTERS { quarters as i64 } else { return None };
        Some(Poly::symbol(SymbolId::PI).scale(&Rational::new(count, 2)?))
    };
    chain.symbols_of(SymbolKind::Constant).filter_map(|id| Some((id, value(id)?))).collect()
}

/// A formula with values put in for constants.
///
/// # Errors
/// They make a divisor zero.
pub fn put_in(formula: &Poly, values: &[(SymbolId, Poly)]) -> Result<Poly, AlgebraError> {
    values.iter().try_fold(formula.clone(), |formula, (symbol, value)| formula.substitute(*symbol, value))
}

/// The same with those values that the algebra can put in.
fn put_in_where_possible(formula: &Poly, values: &[(SymbolId, Poly)]) -> Poly {
    values.iter().fold(formula.clone(), |formula, (symbol, value)| {
        formula.substitute(*symbol, value).unwrap_or(formula)
    })
}

/// Quotients of what errors do, as columns are compared by them.
trait Quotient: Clone {
    fn one() -> Self;
    fn over(&self, other: &Self) -> Self;
    fn equals(&self, other: &Self) -> bool;
    /// As a formula of the constants.
    fn ratio(&self) -> Ratio;
}

/// The influence of an error as a combination of the pivots' influences.
struct Column<Q> {
    index: usize,
    parts: Vec<(usize, Q)>,
}

impl Column<Ratio> {
    fn new(echelon: &Echelon, index: usize) -> Self {
        let part = |(pivot, row): &(usize, Row)| {
            let (numerator, denominator) = (entry(row, index)?.clone(), entry(row, *pivot)?.clone());
            Some((*pivot, Ratio::new(numerator, denominator)))
        };
        Self { index, parts: echelon.rows().iter().filter_map(part).collect() }
    }
}

impl Column<Pair> {
    fn at_values(found: &AtValues, index: usize) -> Self {
        let part = |(pivot, row): &(usize, Vec<Pair>)| {
            let value = row[index];
            (!value.is_zero()).then_some((*pivot, value))
        };
        Self { index, parts: found.rows.iter().filter_map(part).collect() }
    }
}

impl<Q: Quotient> Column<Q> {
    fn is_zero(&self) -> bool {
        self.parts.is_empty()
    }

    /// This over another column, if it is a multiple of it.
    fn over(&self, other: &Self) -> Option<Q> {
        let ((pivot, first), (other_pivot, other_first)) = (self.parts.first()?, other.parts.first()?);
        let ratio = first.over(other_first);
        let same = pivot == other_pivot
            && self.parts.len() == other.parts.len()
            && self
                .parts
                .iter()
                .zip(&other.parts)
                .all(|((p, value), (q, other))| p == q && value.over(other).equals(&ratio));
        same.then_some(ratio)
    }
}

impl Ratio {
    fn new(numerator: Poly, denominator: Poly) -> Self {
        if numerator == denominator {
            return Self::one();
        }
        match denominator.recip() {
            Some(inverse) => Self { numerator: &numerator * &inverse, denominator: Poly::one() },
            None => Self { numerator, denominator },
        }
    }
}

impl Quotient for Ratio {
    fn one() -> Self {
        Self { numerator: Poly::one(), denominator: Poly::one() }
    }

    fn over(&self, other: &Self) -> Self {
        Self::new(&self.numerator * &other.denominator, &self.denominator * &other.numerator)
    }

    fn equals(&self, other: &Self) -> bool {
        &self.numerator * &other.denominator == &other.numerator * &self.denominator
    }

    fn ratio(&self) -> Ratio {
        cancelled(self)
    }
}
