//! Places that rows come back to: readings that lie together in bunches, far from all others.
//!
//! Whoever observes the same targets in several rounds, or reads a pose more than once, has bunches: rows of one lie nearer to
//! each other than to any other row, by far. Rows of a path or of a cloud have none, however dense they lie.

use model_core::{Chain, Quantity, SymbolKind};

use super::Poses;

/// How much further the rows of other places are than those of one are from each other, at least.
const APART: f64 = 2.5;

/// How far apart places are tried to be, as shares of the ranges that the readings cover: from here to there, doubled each time.
const NEAREST: f64 = 1e-9;
const FURTHEST: f64 = 0.1;

/// A chain of rows that is wider than a place is long where it holds more than one of so many rows.
const LONG: usize = 10;

/// Pairs of rows that are compared at most, for each row: where there are more, rows lie dense, and not in bunches.
const COMPARED: usize = 500;

/// The place of each row, numbered from 0 in the order of the rows; `None` where less than half of the rows share theirs.
///
/// A place is told by joints, and by inputs that are lengths or angles: not by the temperature, the time or the side from which
/// it was approached.
#[must_use]
pub fn places(chain: &Chain, poses: &Poses) -> Option<Vec<u32>> {
    let readings = scaled(chain, poses);
    let first = readings.first()?;
    let rows = first.len();
    let mut order: Vec<usize> = (0..rows).collect();
    order.sort_by(|&a, &b| first[a].total_cmp(&first[b]));
    let mut best: Option<(usize, Vec<u32>)> = None;
    let mut apart = NEAREST;
    while apart <= FURTHEST {
        let linked = Linked::within(&readings, &order, apart)?;
        let (shared, of_row) = linked.bunches(&readings, apart / APART);
        if 2 * shared >= rows && best.as_ref().is_none_or(|(most, _)| shared > *most) {
            best = Some((shared, of_row));
        }
        apart *= 2.0;
    }
    best.map(|(_, of_row)| of_row)
}

/// The readings that tell a place, each over the range that it covers; the one that takes most values first.
fn scaled(chain: &Chain, poses: &Poses) -> Vec<Vec<f64>> {
    let tells = |kind: SymbolKind, quantity: Quantity| match kind {
        SymbolKind::Joint => true,
        SymbolKind::Input => quantity != Quantity::Number,
        _ => false,
    };
    let mut readings: Vec<(usize, Vec<f64>)> = Vec::new();
    for (id, values) in &poses.columns {
        let symbol = chain.symbol(*id);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range = high - low;
        if tells(symbol.kind, symbol.quantity) && range > 0.0 && range.is_finite() {
            let mut sorted = values.clone();
            sorted.sort_by(f64::total_cmp);
            sorted.dedup();
            readings.push((sorted.len(), values.iter().map(|value| value / range).collect()));
        }
    }
    readings.sort_by_key(|(values, _)| std::cmp::Reverse(*values));
    readings.into_iter().map(|(_, values)| values).collect()
}

/// Rows in chains, link by link no further than some distance from the next.
struct Linked {
    /// Of each row another one of its chain, or itself.
    parent: Vec<usize>,
}

impl Linked {
    /// Links all rows that lie within a distance in every reading; `order` sorts them by the first. `None` where they lie too dense.
    fn within(readings: &[Vec<f64>], order: &[usize], distance: f64) -> Option<Self> {
        let mut linked = Self { parent: (0..order.len()).collect() };
        let mut left = COMPARED * order.len();
        for (at, &row) in order.iter().enumerate() {
            for &other in &order[at + 1..] {
                if readings[0][other] - readings[0][row] > distance {
                    break;
                }
                left = left.checked_sub(1)?;
                if readings.iter().all(|values| (values[other] - values[row]).abs() <= distance) {
                    linked.join(row, other);
                }
            }
        }
        Some(linked)
    }

    fn root(&mut self, mut row: usize) -> usize {
        while self.parent[row] != row {
            self.parent[row] = self.parent[self.parent[row]];
            row = self.parent[row];
        }
        row
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        let (first, last) = (a.min(b), a.max(b));
        self.parent[last] = first;
    }

    /// How many rows share a place with others, a chain that is no wider than this; and the place of each row. Places too near to each
    /// other to be told apart count as one; the rows of a long chain have one each.
    fn bunches(mut self, readings: &[Vec<f64>], widest: f64) -> (usize, Vec<u32>) {
        let rows = self.parent.len();
        let roots: Vec<usize> = (0..rows).map(|row| self.root(row)).collect();
        let mut size = vec![0_usize; rows];
        roots.iter().for_each(|&root| size[root] += 1);
        let mut narrow = vec![true; rows];
        for values in readings {
            let mut ends = vec![[f64::INFINITY, f64::NEG_INFINITY]; rows];
            for (value, &root) in values.iter().zip(&roots) {
                let [low, high] = ends[root];
                ends[root] = [low.min(*value), high.max(*value)];
            }
            narrow.iter_mut().zip(ends).for_each(|(narrow, [low, high])| *narrow &= high - low <= widest);
        }
        let is_place = |root: usize| size[root] > 1 && narrow[root];
        let is_long = |root: usize| !narrow[root] && LONG * size[root] > rows;
        let mut number: Vec<Option<u32>> = vec![None; rows];
        let mut next = 0;
        let mut shared = 0;
        let mut of_row = Vec::with_capacity(rows);
        for (row, &root) in roots.iter().enumerate() {
            let key = if is_long(root) { row } else { root };
            shared += usize::from(is_place(root));
            let place = *number[key].get_or_insert_with(|| {
                next += 1;
                next - 1
            });
            of_row.push(place);
        }
        (shared, of_row)
    }
}
