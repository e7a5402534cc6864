//! What rows that nobody fitted say of a calibration.

use super::caution::Caution;
use super::rms::{BeforeAfter, Worse, worse};

/// Rows out of reach make a figure over every row grow by up to so much by chance, whatever an effect does to the others.
const FAR_ROWS: f64 = 1.02;

/// Rows that nobody fitted are foretold badly where they are so many times as far off as those that were. Two unknowns of three numbers
/// make three times of it by themselves.
const BADLY: f64 = 5.0;

/// What effects do to rows that no stage saw: to those within reach, and to every row where it is more than what chance makes of rows
/// far out.
pub(super) fn of_rms(rms: &[BeforeAfter]) -> impl Iterator<Item = Caution> {
    let clearly = |worse: &Worse| worse.after > FAR_ROWS * worse.before;
    let held_out = worse(rms, |rms| rms.held_out_rms_kept)
        .or_else(|| worse(rms, |rms| rms.held_out_rms).filter(clearly));
    let elsewhere = worse(rms, |rms| rms.elsewhere_rms_kept)
        .or_else(|| worse(rms, |rms| rms.elsewhere_rms).filter(clearly));
    held_out
        .map(|Worse { before, after, unit }| Caution::WorseHeldOut { before, after, unit })
        .into_iter()
        .chain(elsewhere.map(|Worse { before, after, unit }| Caution::WorseElsewhere { before, after, unit }))
}

/// Whether the amended model foretells rows that no stage saw far worse than those that it was fitted to.
pub(super) fn badly(rms: &[BeforeAfter]) -> Option<Caution> {
    let figures = rms.iter().filter_map(|own| Some((own, own.after.rms?, own.after.held_out_rms?)));
    let far = figures.filter(|&(own, fitted, held_out)| held_out > BADLY * fitted.max(own.expected));
    let worst = far.max_by(|one, other| (one.2 / one.1).total_cmp(&(other.2 / other.1)));
    worst.map(|(own, fitted, held_out)| Caution::ForetoldBadly { fitted, held_out, unit: own.unit })
}
