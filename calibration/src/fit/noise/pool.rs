//! Kinds of component that share one standard deviation, because each alone has too few degrees of freedom.

use super::Layout;
use crate::data::{Observations, SiUnit};

/// A standard deviation of its own needs so many degrees of freedom.
const ENOUGH: f64 = 30.0;

/// The pool of each kind of component, numbered from 0: its own; that of its series where a kind of it has few degrees of
/// freedom; that of all series in its unit where a whole series has few. `used` independent numbers were estimated.
#[must_use]
pub fn pools(observations: &Observations, layout: &Layout, used: f64) -> Vec<usize> {
    let left = (1.0 - used / (layout.components() as f64).max(1.0)).max(0.0);
    let scarce = |components: usize| (components as f64) * left < ENOUGH;
    let mut pools: Vec<usize> = Vec::with_capacity(layout.kinds);
    // Of each unit the pool that its scarce series share.
    let mut shared: Vec<(SiUnit, usize)> = Vec::new();
    let mut next = 0;
    for series in &observations.poses.series {
        let (rows, kinds, unit) = (series.rows.len(), series.measure.components(), series.measure.unit());
        if scarce(rows * kinds) {
            let known = shared.iter().find(|(known, _)| *known == unit).map(|(_, pool)| *pool);
            let pool = known.unwrap_or_else(|| {
                shared.push((unit, next));
                next += 1;
                next - 1
            });
            pools.extend(std::iter::repeat_n(pool, kinds));
        } else if scarce(rows) {
            pools.extend(std::iter::repeat_n(next, kinds));
            next += 1;
        } else {
            pools.extend(next..next + kinds);
            next += kinds;
        }
    }
    pools
}
