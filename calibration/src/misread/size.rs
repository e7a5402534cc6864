//! How large things are that rows observe without anybody knowing where they are.

use model_core::Chain;
use nalgebra::{Matrix3, Vector3};

use fit::{range_of, robust};
use network::{Row, rows};
use observe::Observations;

/// Narrower is nothing, m.
const SMALLEST_M: f64 = 1e-9;

/// How far what is observed usually lies from the middle of all, as the chain has it, m, or how long ranges are where they are shorter. One
/// coordinate that is read as too large makes the whole room large. `None` where rows observe nothing unknown.
pub(super) fn of_objects_m(chain: &Chain, observations: &Observations, values: &[f64]) -> Option<f64> {
    let points = rows(chain, observations, observations.unknowns.as_ref()?, values);
    let middle = points.iter().map(|row| row.point).sum::<Vector3<f64>>() / points.len() as f64;
    let spread = robust::median(points.iter().map(|row| (row.point - middle).norm()).collect());
    let ranges = observations.poses.series.iter().filter_map(|series| range_of(chain, series.observable));
    let readings = ranges.filter_map(|range| observations.poses.column(range));
    let usual = readings.map(|own| robust::median(own.to_vec()).abs());
    let size = usual.fold(spread, f64::min);
    (size > 0.0).then_some(size)
}

/// How wide what is observed lies across its longest direction, m, and no more than it is large: nothing where a reading draws everything
/// to one line, in which every plane fits. `None` as above.
pub(super) fn across_m(chain: &Chain, observations: &Observations, values: &[f64]) -> Option<f64> {
    let size_m = of_objects_m(chain, observations, values)?;
    let points = rows(chain, observations, observations.unknowns.as_ref()?, values);
    let count = points.len() as f64;
    let middle = points.iter().map(|row| row.point).sum::<Vector3<f64>>() / count;
    let square = |row: &Row| (row.point - middle) * (row.point - middle).transpose();
    let spread: Matrix3<f64> = points.iter().map(square).sum::<Matrix3<f64>>() / count;
    if spread.iter().any(|own| !own.is_finite()) {
        return Some(size_m);
    }
    let mut extents: Vec<f64> =
        spread.symmetric_eigenvalues().iter().map(|own| own.max(0.0).sqrt()).collect();
    extents.sort_by(f64::total_cmp);
    Some(extents[1].max(SMALLEST_M).min(size_m))
}
