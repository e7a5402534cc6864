//! Smooth functions of the readings in each kind of component, as a missing effect could look. Memory and
//! offsets of groups are looked for beside them, so that a missing effect is not taken for noise and whitened away.

use faer::Mat;
use model_core::{Chain, Quantity, SymbolKind};

use super::Layout;
use super::serial::MANY;
use observe::Observations;

/// Columns at most at a first look and at a thorough one, and components for each.
pub const MOST: [usize; 2] = [60, 240];
const COMPONENTS: usize = 6;

/// Columns shorter than this are of what the data do not determine.
const UNDETERMINED: f64 = 1e-3;

/// The highest harmonic of a joint.
const HARMONICS: u32 = 4;

/// A column that keeps less than this share of its length beside those before it is one of them.
const NEW: f64 = 1e-4;

/// An orthonormal basis that begins with `q` (n × k, orthonormal but for weights) and goes on with smooth functions of the
/// readings, each divided by the standard deviation of its component, `most` columns in all; rows that count for nothing are
/// zero. And whether there was room for all of them.
///
/// Of more than [`MANY`] components the basis has those of every so-manieth row alone: what reads it asks only how many columns
/// it has.
#[must_use]
pub fn beside(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    sigma: &[f64],
    weight: &[f64],
    q: &Mat<f64>,
    most: usize,
) -> (Mat<f64>, bool) {
    let all = layout.components();
    let most = most.min(all / COMPONENTS);
    let step = all.div_ceil(MANY).max(1);
    let looked_at = layout.row_of_each().enumerate().filter(|(_, row)| row.is_multiple_of(step));
    let looked_at: Vec<usize> = looked_at.map(|(at, _)| at).collect();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut take = |mut column: Vec<f64>| {
        let before = norm(&column);
        // Twice is enough for columns that are nearly among the others.
        for known in basis.iter().chain(basis.iter()) {
            let share: f64 = known.iter().zip(&column).map(|(a, b)| a * b).sum();
            column.iter_mut().zip(known).for_each(|(value, known)| *value -= share * known);
        }
        let length = norm(&column);
        if length > NEW * before && length > 0.0 {
            column.iter_mut().for_each(|value| *value /= length);
            basis.push(column);
        }
        basis.len()
    };
    let own = |j: usize| looked_at.iter().map(|&at| q[(at, j)]).collect::<Vec<f64>>();
    kept(q).into_iter().map(own).for_each(|own| {
        take(own);
    });
    let readings: Vec<(bool, &[f64])> = observations
        .poses
        .columns
        .iter()
        .map(|(id, values)| {
            let symbol = chain.symbol(*id);
            let turns = symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle;
            (turns, values.as_slice())
        })
        .collect();
    let mut functions: Vec<Box<dyn Fn(usize) -> f64 + '_>> = vec![Box::new(|_| 1.0)];
    for harmonic in 1..=HARMONICS {
        for &(turns, values) in &readings {
            let multiple = f64::from(harmonic);
            if turns {
                functions.push(Box::new(move |row| (multiple * values[row]).cos()));
                functions.push(Box::new(move |row| (multiple * values[row]).sin()));
            } else if harmonic == 1 {
                functions.push(Box::new(move |row| values[row]));
            }
        }
    }
    let mut complete = true;
    'all: for function in &functions {
        for kind in 0..layout.kinds {
            let at = |at: usize| {
                let row = layout.row(at);
                let own = layout.kind(at) == kind && weight[row] > 0.0;
                if own { function(row) / sigma[at] } else { 0.0 }
            };
            if take(looked_at.iter().copied().map(at).collect()) >= most.max(q.ncols()) {
                complete = false;
                break 'all;
            }
        }
    }
    (Mat::from_fn(looked_at.len(), basis.len(), |row, column| basis[column][row]), complete)
}

/// The columns of what the data determine: the others are as good as zero, and no likelihood can do with them.
#[must_use]
pub fn determined(q: &Mat<f64>) -> Mat<f64> {
    let kept = kept(q);
    Mat::from_fn(q.nrows(), kept.len(), |row, column| q[(row, kept[column])])
}

fn kept(q: &Mat<f64>) -> Vec<usize> {
    (0..q.ncols()).filter(|&j| norm(q.col_as_slice(j)) > UNDETERMINED).collect()
}

fn norm(column: &[f64]) -> f64 {
    column.iter().map(|value| value * value).sum::<f64>().sqrt()
}
