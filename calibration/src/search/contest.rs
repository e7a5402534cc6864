//! A contest: one function at one place against the effects that the catalogue spelt out.
//!
//! Eight harmonics of one joint can follow any bump; that does not make them eight effects. Each model pays for its
//! columns, and for how many models of its kind there were to choose from.
//!
//! Source: J. Chen and Z. Chen, "Extended Bayesian information criteria for model selection with large model spaces",
//! Biometrika 95 (2008).

use faer::{Mat, MatRef};
use statrs::function::factorial::ln_binomial;

use super::likelihood::Likelihood;
use super::problem::VISIBLE;
use super::scan::Left;
use super::select::held_out_rss;
use super::sweep::Sweep;

/// What a model pays, beside its columns.
#[derive(Debug, Clone, Copy)]
pub struct Price {
    /// Confounded sets that accepted effects were chosen from.
    pub sets: usize,
    /// Functions (places and shapes) that a smooth one was chosen from.
    pub functions: usize,
    /// Parameters of the shape that were fitted beside its columns: centre and width of a bump.
    pub parameters: usize,
}

/// A model with a function in it.
#[derive(Debug, Clone)]
pub struct Contender {
    /// Its penalised log-likelihood.
    pub criterion: f64,
    /// How likely it makes the data, and what it has for that.
    pub likelihood: Likelihood,
    /// The accepted effects that stay beside it, by their number.
    pub kept: Vec<usize>,
    /// How far what it predicts is from what the accepted model does, as a share (RMS) of what the effects do that it
    /// replaces; none where it replaces none.
    pub differs: Option<f64>,
    /// What it leaves of these data over what the accepted model leaves, root mean square.
    pub leaves: f64,
    /// Coefficients of the function's columns; zero for columns that are not seen.
    pub coefficients: Vec<f64>,
    /// Their covariance, row by row.
    pub covariance: Vec<f64>,
}

/// How likely the accepted model makes the data.
#[must_use]
pub fn likelihood(left: &Left<'_>) -> Likelihood {
    let rss = left.residual.iter().map(|r| r * r).sum();
    Likelihood::of(rss, left.residual.len(), left.basis.ncols() + left.thresholds.iter().sum::<usize>())
}

/// Penalised log-likelihood of the accepted model itself.
#[must_use]
pub fn criterion(left: &Left<'_>, price: Price) -> f64 {
    likelihood(left).penalised() - ln_choices(price.sets, left.accepted.len())
}

/// The model with a function's columns in it, without those accepted effects that it makes idle.
#[must_use]
pub fn contender(left: &Left<'_>, columns: MatRef<'_, f64>, price: Price) -> Contender {
    let gram = left.gram(columns);
    let (rows, residual) = (left.residual.len(), gram.ncols() - 1);
    let first = residual - columns.ncols();
    let before: Vec<f64> = (0..=residual).map(|j| gram[(j, j)]).collect();
    let mut sweep = Sweep::new(gram);
    let mut count = (0..left.declared).filter(|&column| sweep.add(column)).count();
    count += (first..residual).filter(|&j| sweep.entry(j, j) > VISIBLE * before[j] && sweep.add(j)).count();
    // What declared columns and function leave of the accepted effects and of the residual: a small matrix, regressed
    // anew for every choice of effects.
    let open: Vec<usize> = left.accepted.iter().flatten().copied().chain([residual]).collect();
    let small = Mat::from_fn(open.len(), open.len(), |i, j| sweep.entry(open[i], open[j]));
    let mut start = 0;
    let mut kept: Vec<(usize, Vec<usize>)> = Vec::new();
    for (number, block) in left.accepted.iter().enumerate() {
        kept.push((number, (start..start + block.len()).collect()));
        start += block.len();
    }
    let own = (price.functions.max(1) as f64).ln();
    let judged = |effects: &[(usize, Vec<usize>)]| {
        let mut sweep = Sweep::scaled(small.clone(), open.iter().map(|&column| before[column]).collect());
        let added = effects.iter().flat_map(|(_, own)| own).filter(|&&column| sweep.add(column)).count();
        let rss = sweep.entry(open.len() - 1, open.len() - 1);
        let thresholds: usize = effects.iter().map(|&(number, _)| left.thresholds[number]).sum();
        Likelihood::of(rss, rows, count + added + thresholds + price.parameters).penalised()
            - own
            - ln_choices(price.sets, effects.len())
    };
    let mut criterion = judged(&kept);
    loop {
        let without = |at: usize| {
            let mut fewer = kept.clone();
            fewer.remove(at);
            (judged(&fewer), at)
        };
        let best = (0..kept.len()).map(without).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((better, at)) = best.filter(|&(better, _)| better > criterion) else { break };
        kept.remove(at);
        criterion = better;
    }
    count += kept.iter().flat_map(|(_, own)| own).filter(|&&column| sweep.add(open[column])).count();
    let rss = sweep.entry(residual, residual);
    let thresholds: usize = kept.iter().map(|&(number, _)| left.thresholds[number]).sum();
    let likelihood = Likelihood::of(rss, rows, count + thresholds + price.parameters);
    let variance = rss / (rows as f64 - count as f64).max(1.0);
    let seen = |j: usize| sweep.contains(j);
    let own: Vec<usize> = (first..residual).collect();
    let coefficients: Vec<f64> =
        own.iter().map(|&j| if seen(j) { sweep.entry(j, residual) } else { 0.0 }).collect();
    let pairs = own.iter().flat_map(|&i| own.iter().map(move |&j| (i, j)));
    let covariance = pairs.map(|(i, j)| if seen(i) && seen(j) { -variance * sweep.entry(i, j) } else { 0.0 });
    let kept: Vec<usize> = kept.into_iter().map(|(number, _)| number).collect();
    let accepted: f64 = left.residual.iter().map(|r| r * r).sum();
    // The accepted model's residual is orthogonal to all that it knows.
    let across = columns.transpose() * faer::ColRef::from_slice(&left.residual);
    let shared: f64 = coefficients.iter().zip(across.iter()).map(|(b, a)| b * a).sum();
    let apart = (rss - accepted + 2.0 * shared).max(0.0);
    let done = left.rss_beside(&kept) - accepted;
    let differs = (kept.len() < left.accepted.len()).then(|| (apart / done.max(f64::MIN_POSITIVE)).sqrt());
    let leaves = (rss / accepted.max(f64::MIN_POSITIVE)).sqrt();
    Contender { criterion, likelihood, kept, differs, leaves, coefficients, covariance: covariance.collect() }
}

/// Whether a model with a function's columns, beside the accepted effects that it keeps, predicts held-out folds (rows of each) better than
/// the accepted model does. A likelihood takes every row for one of its own; where rows come in groups, only folds of whole groups
/// tell a function from what the groups happen to share.
#[must_use]
pub fn predicts(left: &Left<'_>, columns: MatRef<'_, f64>, kept: &[usize], folds: &[Vec<usize>]) -> bool {
    if folds.len() < 2 {
        return true;
    }
    let (known, own) = (left.known.ncols() - 1, columns.ncols());
    let grams: Vec<Mat<f64>> = folds
        .iter()
        .map(|rows| {
            let all = Mat::from_fn(rows.len(), known + own + 1, |i, j| match j.checked_sub(known) {
                None => left.known[(rows[i], j)],
                Some(at) if at < own => columns[(rows[i], at)],
                Some(_) => left.known[(rows[i], known)],
            });
            all.transpose() * &all
        })
        .collect();
    let held_out = |picked: &[usize]| -> f64 {
        let of =
            |gram: &Mat<f64>| Mat::from_fn(picked.len(), picked.len(), |i, j| gram[(picked[i], picked[j])]);
        let parts: Vec<Mat<f64>> = grams.iter().map(of).collect();
        let mut total = Mat::<f64>::zeros(picked.len(), picked.len());
        parts.iter().for_each(|part| total += part);
        parts.iter().map(|part| held_out_rss(&total, part)).sum()
    };
    let residual = known + own;
    let before: Vec<usize> = (0..known).chain([residual]).collect();
    let effects = kept.iter().flat_map(|&at| left.accepted[at].iter().copied());
    let after: Vec<usize> = (0..left.declared).chain(effects).chain(known..=residual).collect();
    held_out(&after) < held_out(&before)
}

/// Of many single columns those that explain most: of what the declared columns leave, and of what the accepted
/// effects leave too.
#[must_use]
pub fn most_telling(left: &Left<'_>, columns: MatRef<'_, f64>) -> Vec<usize> {
    let residual = left.known.ncols() - 1;
    let declared = left.known.subcols(0, left.declared);
    let best = |basis: MatRef<'_, f64>, target: MatRef<'_, f64>| {
        let (absorbed, scores): (Mat<f64>, Mat<f64>) =
            (basis.transpose() * columns, columns.transpose() * target);
        let gain = |j: usize| {
            let whole = columns.col(j).squared_norm_l2();
            let visible = whole - absorbed.col(j).squared_norm_l2();
            if visible > VISIBLE * whole { scores[(j, 0)] * scores[(j, 0)] / visible } else { 0.0 }
        };
        (0..columns.ncols()).map(|j| (j, gain(j))).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(j, _)| j)
    };
    let after = faer::ColRef::from_slice(&left.residual).as_mat();
    let mut found: Vec<usize> =
        [best(declared, left.known.subcols(residual, 1)), best(left.basis.as_ref(), after)]
            .into_iter()
            .flatten()
            .collect();
    found.dedup();
    found
}

/// The log of how many ways there are to choose so many of so many.
#[must_use]
pub fn ln_choices(of: usize, count: usize) -> f64 {
    if count > of { 0.0 } else { ln_binomial(of as u64, count as u64) }
}
