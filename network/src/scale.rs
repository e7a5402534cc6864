//! Whether anything holds the scale: where every length of a chain is estimated and nothing measured is one, the chain can
//! shrink to a point, and its residuals with it.
//!
//! A point is linear in the lengths of its chain. If it is a sum of the columns of those that are estimated at every pose, not
//! at the measured ones alone, they can take it to nothing.

use model_core::{Chain, Quantity, Symbol, SymbolId, SymbolKind, exact};
use nalgebra::{DMatrix, DVector};

use super::rows::sighted;
use super::start::StartError;
use fit::FitOptions;
use observe::kinds::Scale;
use observe::unknowns::{Freedom, Object, Shape, Unknowns};
use observe::{Observations, Series};

/// A part of the points this small is rounding.
const ROUNDING: f64 = 1e-9;

/// Refuses a fit in which everything could shrink to nothing by its lengths.
///
/// # Errors
/// The lengths that could.
pub fn check_scale(chain: &Chain, observations: &Observations, fit: &FitOptions) -> Result<(), StartError> {
    refused(chain, &could_shrink(chain, observations, fit, is_length, is_length))
}

/// Refuses a fit in which everything could shrink to nothing by a scale of measured lengths, as of ranges. What noise tells
/// of such a scale, or of a column that shrinks with it, is no number of the instrument.
///
/// # Errors
/// The scales that could.
pub fn check_scale_of_ranges(
    chain: &Chain,
    observations: &Observations,
    fit: &FitOptions,
) -> Result<(), StartError> {
    refused(chain, &unheld_scales(chain, observations, fit))
}

/// The scales of measured lengths that nothing holds.
pub(super) fn unheld_scales(chain: &Chain, observations: &Observations, fit: &FitOptions) -> Vec<SymbolId> {
    could_shrink(chain, observations, fit, |symbol| is_length(symbol) || is_factor(symbol), is_factor)
}

fn refused(chain: &Chain, unheld: &[SymbolId]) -> Result<(), StartError> {
    let names: Vec<&str> = unheld.iter().map(|id| chain.symbol(*id).name.as_str()).collect();
    match names.first() {
        None => Ok(()),
        Some(first) => Err(StartError::NoScale { lengths: names.join("`, `"), first: (*first).to_owned() }),
    }
}

fn is_length(symbol: &Symbol) -> bool {
    symbol.quantity == Quantity::Length && matches!(symbol.kind, SymbolKind::Error | SymbolKind::Constant)
}

/// Whether a symbol is an error that multiplies something measured.
fn is_factor(symbol: &Symbol) -> bool {
    symbol.quantity == Quantity::Number && symbol.kind == SymbolKind::Error
}

/// What is estimated that could take every point to nothing; of it those that are `named`.
fn could_shrink(
    chain: &Chain,
    observations: &Observations,
    fit: &FitOptions,
    may_shrink: impl Fn(&Symbol) -> bool,
    named: impl Fn(&Symbol) -> bool,
) -> Vec<SymbolId> {
    let Some(unknowns) = &observations.unknowns else { return Vec::new() };
    let scale = |series: &Series| (series.measure.kind().scale)(&observations.measured[series.rows.clone()]);
    let series = || observations.poses.series.iter();
    let mut points = series().filter(|series| scale(series) == Scale::Free).peekable();
    if points.peek().is_none()
        || series().any(|series| scale(series) == Scale::Held)
        || known_places(unknowns) >= 2
    {
        return Vec::new();
    }
    let lengths: Vec<SymbolId> =
        fit.estimate.iter().filter(|id| may_shrink(chain.symbol(**id))).copied().collect();
    let unheld: Vec<SymbolId> = lengths.iter().copied().filter(|id| named(chain.symbol(*id))).collect();
    let is_free = !unheld.is_empty()
        && points.all(|series| is_sum_of(chain, observations, series, &lengths, &fit.start));
    if is_free { unheld } else { Vec::new() }
}

/// How many stations and objects are where the study says, to within something.
fn known_places(unknowns: &Unknowns) -> usize {
    let stations = unknowns.stations.iter().enumerate().filter(|(number, station)| {
        station.freedom != Freedom::Free && unknowns.station.iter().any(|&own| own as usize == *number)
    });
    // A place says nothing of a plane.
    let is_known = |object: &&Object| object.freedom != Freedom::Free && object.shape != Shape::Plane;
    let objects = unknowns.objects.iter().filter(is_known);
    stations.count() + objects.count()
}

/// Whether the point of a series is at every pose the same sum of the lengths' columns, but for a shift.
fn is_sum_of(
    chain: &Chain,
    observations: &Observations,
    series: &Series,
    lengths: &[SymbolId],
    start: &[f64],
) -> bool {
    let path = exact::Path::new(chain, series.observable);
    let sighted = sighted(chain, series);
    let poses = 2 * lengths.len() + 20;
    let mut values = start.to_vec();
    values.truncate(chain.symbols.len());
    let mut matrix = DMatrix::zeros(3 * poses, lengths.len() + 3);
    let mut points = DVector::zeros(3 * poses);
    for pose in 0..poses {
        for (at, (id, readings)) in observations.poses.columns.iter().enumerate() {
            // Each joint from another row: poses at which nothing was fixed.
            let row = series.rows.start + (pose * (2 * at + 1) + 7 * at) % series.rows.len().max(1);
            values[id.index()] = readings[row];
        }
        // Of a sight where it begins: its range is as long as it takes.
        if let Some(range) = sighted {
            values[range.index()] = 0.0;
        }
        let point = path.value(&values);
        for axis in 0..3 {
            points[3 * pose + axis] = point[axis];
            matrix[(3 * pose + axis, lengths.len() + axis)] = 1.0;
        }
        for (column, id) in lengths.iter().enumerate() {
            let mut longer = values.clone();
            longer[id.index()] += 1.0;
            let change = path.value(&longer) - point;
            (0..3).for_each(|axis| matrix[(3 * pose + axis, column)] = change[axis]);
        }
    }
    let whole = points.norm();
    if sighted.is_some() && whole == 0.0 {
        // Beams that all begin at one point but for lengths that are estimated: those grow with the room.
        return (0..lengths.len()).any(|column| {
            let own = matrix.column(column);
            (3..own.len()).any(|at| (own[at] - own[at % 3]).abs() > ROUNDING)
        });
    }
    let Ok(solved) = matrix.clone().svd(true, true).solve(&points, ROUNDING) else { return false };
    // Points that are all one are shifted to nothing, and have no size.
    let left = (&matrix * solved - &points).norm();
    whole > 0.0 && left <= 1e3 * ROUNDING * whole
}
