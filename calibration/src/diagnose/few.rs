//! Few numbers: where what is estimated uses them up, nothing says how good it is.

use super::caution::Caution;
use fit::FitResult;
use fit::noise::Layout;
use observe::Observations;

/// Numbers that are to be left over for the noise to be known within a third.
const LEFT_OVER: f64 = 4.0;

/// Numbers that should be left over, where somebody measures more.
pub const WANTED: usize = 6;

/// Whether a fit leaves hardly anything over.
pub(super) fn hardly_more(observations: &Observations, fit: &FitResult) -> Option<Caution> {
    let layout = Layout::of(observations);
    let numbers = layout.row_of_each().filter(|&row| fit.residuals.weight[row] > 0.0).count();
    let unknowns = (numbers as f64 - fit.degrees_of_freedom).round();
    (fit.outcome.is_usable() && fit.degrees_of_freedom < LEFT_OVER)
        .then(|| Caution::HardlyMoreNumbers { numbers, unknowns: unknowns.max(0.0) as usize })
}
