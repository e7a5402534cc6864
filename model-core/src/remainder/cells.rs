//! The largest value of a bound over a box, which is divided where the bound is worst.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A box with the bound in it.
struct Cell {
    ranges: Vec<[f64; 2]>,
    value: f64,
    depth: u32,
}

impl Ord for Cell {
    /// By the bound; of two equal ones the smaller box, so that a place without any bound is found soon.
    fn cmp(&self, other: &Self) -> Ordering {
        self.value.total_cmp(&other.value).then(self.depth.cmp(&other.depth))
    }
}

impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Cell {}

/// Boxes after which a bound is as good as it gets.
const CELLS: usize = 3000;
/// What a bound may be above its value at some place before the boxes get no smaller.
const SHARP: f64 = 1.02;

/// The largest value of a bound in a box: `bound` gives for any box inside a number that is not exceeded there, infinite where
/// it knows none.
///
/// # Errors
/// A place in or near which there is no bound.
pub(crate) fn largest(start: &[[f64; 2]], bound: impl Fn(&[[f64; 2]]) -> f64) -> Result<f64, Vec<f64>> {
    let mut cells = BinaryHeap::from([Cell { ranges: start.to_vec(), value: bound(start), depth: 0 }]);
    let mut reached: f64 = 0.0;
    for count in 1.. {
        let Some(worst) = cells.pop() else { return Ok(0.0) };
        let centre: Vec<f64> = worst.ranges.iter().map(|[low, high]| low + (high - low) / 2.0).collect();
        let point: Vec<[f64; 2]> = centre.iter().map(|&at| [at, at]).collect();
        let there = bound(&point);
        if there == f64::INFINITY {
            return Err(centre);
        }
        reached = reached.max(there);
        let widest = widest(&worst.ranges, start).filter(|_| count < CELLS);
        if worst.value <= SHARP * reached || (widest.is_none() && worst.value < f64::INFINITY) {
            return Ok(worst.value);
        }
        let Some(widest) = widest else { return Err(centre) };
        let [low, high] = worst.ranges[widest];
        for half in [[low, centre[widest]], [centre[widest], high]] {
            let mut ranges = worst.ranges.clone();
            ranges[widest] = half;
            let value = bound(&ranges);
            cells.push(Cell { ranges, value, depth: worst.depth + 1 });
        }
    }
    unreachable!("the boxes are counted up to a limit")
}

/// The range that is widest, measured by what it was; none if no range can be halved.
fn widest(ranges: &[[f64; 2]], start: &[[f64; 2]]) -> Option<usize> {
    let share = |index: usize| {
        let ([low, high], [first, last]) = (ranges[index], start[index]);
        let middle = low + (high - low) / 2.0;
        if low < middle && middle < high { (high - low) / (last - first) } else { 0.0 }
    };
    let (index, share) = (0..ranges.len()).map(|index| (index, share(index))).max_by(|a, b| {
        // Of equal ones the first.
        a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))
    })?;
    (share > 0.0).then_some(index)
}
