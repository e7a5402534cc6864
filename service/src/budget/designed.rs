//! What tolerances come to at one observable, as a designer asked.

use model_core::SymbolId;

use crate::tolerance::{After, Allocation, Sensitivity, Simulation, Spread, Tolerance};

/// What the tolerances come to at one observable.
pub struct Designed {
    /// The columns over the poses.
    pub sensitivity: Sensitivity,
    /// What is allowed of each error.
    pub tolerances: Vec<Tolerance>,
    /// What to expect.
    pub now: Spread,
    /// The most that any combination does, by pose.
    pub worst: Vec<f64>,
    /// What was drawn.
    pub drawn: Option<Simulation>,
    /// What is wanted, rad or m, with the sizes for it.
    pub wanted: Option<(f64, Allocation)>,
    /// What remains after a campaign.
    pub remaining: Option<Remaining>,
    /// Whether a registration took out what moves everything.
    pub registered: bool,
}

/// What remains after a campaign.
pub struct Remaining {
    /// By how much.
    pub after: After,
    /// What was drawn of it.
    pub drawn: Option<Simulation>,
    /// The poses that are measured.
    pub poses: usize,
    /// The noise of each component, rad or m.
    pub sigma: f64,
}

impl Designed {
    /// The errors by their share in what is expected, the largest first.
    pub fn by_share<'a>(&self, shares: &'a [f64]) -> Vec<(SymbolId, &'a f64)> {
        let mut order: Vec<(SymbolId, &f64)> =
            self.tolerances.iter().map(|tolerance| tolerance.error).zip(shares).collect();
        order.sort_by(|a, b| b.1.total_cmp(a.1));
        order
    }
}
