//! How large things are that rows observe without anybody knowing where they are.

use model_core::Chain;
use nalgebra::Vector3;

use fit::{range_of, robust};
use network::rows;
use observe::Observations;

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
