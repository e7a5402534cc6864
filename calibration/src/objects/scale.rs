//! Whether anything holds the scale: where every length of a chain is estimated and nothing measured is one, the chain can
//! shrink to a point, and its residuals with it.
//!
//! A point is linear in the lengths of its chain. If it is a sum of the columns of those that are estimated at every pose, not
//! at the measured ones alone, they can take it to nothing.

use model_core::{Chain, Quantity, SymbolId, SymbolKind, exact};
use nalgebra::{DMatrix, DVector};

use super::start::StartError;
use crate::data::unknowns::{Freedom, Unknowns};
use crate::data::{Measure, Observations, Series};
use crate::fit::FitOptions;

/// A part of the points this small is rounding.
const ROUNDING: f64 = 1e-9;

/// Refuses a fit in which everything could shrink to nothing.
///
/// # Errors
/// The lengths that could.
pub fn check_scale(chain: &Chain, observations: &Observations, fit: &FitOptions) -> Result<(), StartError> {
    let Some(unknowns) = &observations.unknowns else { return Ok(()) };
    let of_points =
        |series: &&Series| matches!(series.measure, Measure::Plane | Measure::Target | Measure::Fixed);
    let shows_none = |series: &Series| of_points(&series) || series.measure.bare() == Measure::Direction;
    let mut points = observations.poses.series.iter().filter(of_points).peekable();
    if points.peek().is_none()
        || !observations.poses.series.iter().all(shows_none)
        || known_places(unknowns) >= 2
    {
        return Ok(());
    }
    let is_length = |id: &&SymbolId| {
        let symbol = chain.symbol(**id);
        symbol.quantity == Quantity::Length && matches!(symbol.kind, SymbolKind::Error | SymbolKind::Constant)
    };
    let lengths: Vec<SymbolId> = fit.estimate.iter().filter(is_length).copied().collect();
    let shrinks = points.all(|series| is_sum_of(chain, observations, series, &lengths, &fit.start));
    let names: Vec<&str> = lengths.iter().map(|id| chain.symbol(*id).name.as_str()).collect();
    match names.first() {
        Some(first) if shrinks => {
            Err(StartError::NoScale { lengths: names.join("`, `"), first: (*first).to_owned() })
        }
        _ => Ok(()),
    }
}

/// How many stations and objects are where the study says, to within something.
fn known_places(unknowns: &Unknowns) -> usize {
    let stations = unknowns.stations.iter().enumerate().filter(|(number, station)| {
        station.freedom != Freedom::Free && unknowns.station.iter().any(|&own| own as usize == *number)
    });
    let objects = unknowns.objects.iter().filter(|object| object.freedom != Freedom::Free);
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
    let Ok(solved) = matrix.clone().svd(true, true).solve(&points, ROUNDING) else { return false };
    // Points that are all one are shifted to nothing, and have no size.
    let left = (&matrix * solved - &points).norm();
    whole > 0.0 && left <= 1e3 * ROUNDING * whole
}
