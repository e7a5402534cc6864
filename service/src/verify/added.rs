//! Which rows would make a check conclusive: the best of poses over the measured region, one after the other.

use nalgebra::DMatrix;
use observe::Poses;

use super::agreement::{information, rank};
use super::chance::Squares;
use super::policy::{CANDIDATES, MOST_ADDED, POWER};
use super::rows::Rows;
use crate::errors_file::FoundOver;
use crate::refusal::Refusal;
use crate::sensitivity::derivatives;

/// Rows to add.
#[derive(Debug, Clone, PartialEq)]
pub struct Added {
    /// The names of joints and inputs.
    pub names: Vec<String>,
    /// Their readings, SI, row by row.
    pub poses: Vec<Vec<f64>>,
    /// Whether all rows together would show a change as large as the goal.
    pub is_enough: bool,
}

/// Chooses rows by which the error that shows least gains most, until each would show a change of the goal.
///
/// Source: greedy choice of a monotone submodular gain is within 1 − 1/e of the best: G. L. Nemhauser, L. A. Wolsey, M. L. Fisher, Mathematical
/// Programming 14 (1978) 265–294.
///
/// # Errors
/// A reading that the observable depends on is not there.
pub fn added(rows: &Rows, found: &[FoundOver], goal: f64, level: f64) -> Result<Option<Added>, Refusal> {
    let Some(poses) = rows.watched.poses(&rows.chain, found, CANDIDATES) else { return Ok(None) };
    let symbols: Vec<_> = rows.errors.iter().map(|(symbol, _)| *symbol).collect();
    let raw = derivatives(&rows.chain, &poses, &rows.values, &symbols)?;
    let scaled = DMatrix::from_fn(raw.nrows(), raw.ncols(), |row, at| raw[(row, at)] * rows.errors[at].1);
    let columns = rows.whitened(&scaled);
    let all = rows.whitened(&rows.columns);
    let needed = Squares::new(rank(&columns).max(1), rows.noise).needed(level, POWER);
    let m = rows.sigma.len();
    let of_pose = |pose: usize| {
        let own = columns.rows(pose * m, m);
        own.tr_mul(&own)
    };
    let shares = |matrix: &DMatrix<f64>| {
        let information = information(matrix, &rows.covariance);
        let share = |at: usize| (goal * goal * information[(at, at)] / needed).min(1.0);
        (0..symbols.len()).map(share).collect::<Vec<f64>>()
    };
    let mut matrix = all.tr_mul(&all);
    let mut chosen: Vec<usize> = Vec::new();
    let is_enough = |matrix: &DMatrix<f64>| shares(matrix).iter().all(|share| *share >= 1.0);
    while chosen.len() < MOST_ADDED && !is_enough(&matrix) {
        let gained = |pose: &usize| shares(&(&matrix + of_pose(*pose))).iter().sum::<f64>();
        let left = (0..poses.rows()).filter(|pose| !chosen.contains(pose));
        let best = left.map(|pose| (gained(&pose), pose)).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, pose)) = best else { break };
        matrix += of_pose(pose);
        chosen.push(pose);
    }
    Ok(Some(told(rows, &poses, &chosen, is_enough(&matrix))))
}

fn told(rows: &Rows, poses: &Poses, chosen: &[usize], is_enough: bool) -> Added {
    let names = poses.columns.iter().map(|(id, _)| rows.chain.symbol(*id).name.clone());
    let readings = |pose: &usize| poses.columns.iter().map(|(_, column)| column[*pose]).collect();
    Added { names: names.collect(), poses: chosen.iter().map(readings).collect(), is_enough }
}
