//! The study's own reading with one joint's scale off: the effect that is most easily taken for a misread column.

use super::policy::MOST_SCALE;
use super::trial::Trial;

/// Scales that are tried, as shares of the largest one; between the best and its neighbours follow so many thirds.
const TRIED: [f64; 8] = [-1.0, -0.5, -0.25, -0.1, 0.1, 0.25, 0.5, 1.0];
const THIRDS: usize = 12;

/// The best score with the scale of one joint as another number to be estimated, its price counted; `None` without joints, and where rows
/// observe unknown objects.
pub(super) fn total(trial: &Trial<'_>) -> Option<f64> {
    if trial.own.unknowns.is_some() {
        return None;
    }
    let joints = trial.joints();
    let price = 0.5 * (trial.own.rows() as f64).ln() + (joints.len().max(1) as f64).ln();
    let of_joint = |joint: &usize| {
        let total =
            |share: f64| trial.total_scaled(*joint, 1.0 + MOST_SCALE * share).unwrap_or(f64::NEG_INFINITY);
        let totals = TRIED.map(total);
        let best = (0..TRIED.len()).max_by(|one, other| totals[*one].total_cmp(&totals[*other]))?;
        let (mut low, mut high) = (TRIED[best.saturating_sub(1)], TRIED[(best + 1).min(TRIED.len() - 1)]);
        for _ in 0..THIRDS {
            let third = (high - low) / 3.0;
            if total(low + third) < total(high - third) { low += third } else { high -= third }
        }
        Some(total(0.5 * (low + high)).max(totals[best]))
    };
    joints.iter().filter_map(of_joint).max_by(|one, other| one.total_cmp(other)).map(|total| total - price)
}
