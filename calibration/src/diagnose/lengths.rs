//! Lengths that were measured from another zero than they are told from: a bar whose ends are not where its scale begins.

use faer::Mat;
use serde::Serialize;

use super::rivals::{Winner, contest};
use crate::search::context::Context;
use crate::search::round::Round;
use observe::Measure;
use observe::kinds::MeasuredLengths;

/// A zero of the lengths that explains the data better than what was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LengthsOff {
    /// What the lengths have too much, m.
    pub by_m: f64,
    /// What was found, and would not be.
    pub instead_of: Vec<String>,
}

/// That of all lengths between two points, where there is one.
pub(super) fn lengths_off(whole: &Context<'_>, last: &Round<'_>) -> Option<LengthsOff> {
    let rows = &last.search.rows;
    let measures: Vec<Measure> = rows.observations.poses.measures().collect();
    let of_points = Some(MeasuredLengths::Distances);
    let is_length = |&row: &u32| f64::from(u8::from(measures[row as usize].kind().lengths == of_points));
    let column: Vec<f64> = rows.columns.row.iter().map(is_length).collect();
    if column.iter().all(|value| *value == 0.0) {
        return None;
    }
    let white = rows.whiten(&column);
    let rival = Mat::from_fn(white.len(), 1, |i, _| white[i]);
    let Winner { coefficients, instead_of, .. } = contest(whole, last, &[rival])?;
    Some(LengthsOff { by_m: *coefficients.first()?, instead_of })
}
