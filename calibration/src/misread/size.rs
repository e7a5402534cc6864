//! How large things are that rows observe without anybody knowing where they are.

use model_core::Chain;
use nalgebra::{Matrix3, Vector3};

use fit::{range_of, robust};
use network::rows;
use observe::Observations;

/// Narrower is nothing, m.
const SMALLEST_M: f64 = 1e-9;

/// How large things are, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// How far what is observed usually lies from the middle of all, as the chain has it, or how long ranges are where they are shorter. One
    /// coordinate that is read as too large makes the whole room large.
    pub usual_m: f64,
    /// How wide it lies across its longest direction, and no more than it is large: nothing where a reading draws everything to one line,
    /// in which every plane fits.
    pub across_m: f64,
}

/// How large what rows observe is; `None` where they observe nothing unknown.
pub(super) fn of_objects(chain: &Chain, observations: &Observations, values: &[f64]) -> Option<Extent> {
    let points = rows(chain, observations, observations.unknowns.as_ref()?, values);
    let count = points.len() as f64;
    let middle = points.iter().map(|row| row.point).sum::<Vector3<f64>>() / count;
    let from_middle: Vec<Vector3<f64>> = points.iter().map(|row| row.point - middle).collect();
    let spread = robust::median(from_middle.iter().map(|away| away.norm()).collect());
    let ranges = observations.poses.series.iter().filter_map(|series| range_of(chain, series.observable));
    let readings = ranges.filter_map(|range| observations.poses.column(range));
    let usual = readings.map(|own| robust::median(own.to_vec()).abs());
    let usual_m = usual.fold(spread, f64::min);
    let squares = from_middle.iter().map(|away| away * away.transpose()).sum::<Matrix3<f64>>() / count;
    let across_m = if squares.iter().all(|own| own.is_finite()) { across(&squares) } else { usual_m };
    (usual_m > 0.0).then_some(Extent { usual_m, across_m: across_m.max(SMALLEST_M).min(usual_m) })
}

/// The second largest of the extents along the principal axes.
fn across(squares: &Matrix3<f64>) -> f64 {
    let mut extents = squares.symmetric_eigenvalues();
    extents.as_mut_slice().sort_by(f64::total_cmp);
    extents[1].max(0.0).sqrt()
}
