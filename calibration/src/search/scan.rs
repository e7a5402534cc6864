//! Scans: many blocks of columns that are no candidates of the catalogue, tested against what an accepted model leaves.
//!
//! The columns come sheet by sheet and are forgotten again; of each sheet only its inner products are kept, with the
//! declared columns, with the accepted effects and with the residual, and its scores under the sign flips.

use std::ops::Range;

use faer::{Mat, MatRef};

use super::flips::Chance;
use super::problem::{Problem, VISIBLE};
use super::signs::Signs;
use super::standardised::{Standardised, is_needed};
use super::sweep::Sweep;
use super::tail::Tails;

/// Columns to scan, and which of them belong together.
pub struct Sheet {
    /// Whitened, one row for each row of the problem.
    pub columns: Mat<f64>,
    /// The blocks under test.
    pub blocks: Vec<Range<usize>>,
}

impl Sheet {
    /// All columns as one block.
    #[must_use]
    pub fn of(columns: Mat<f64>) -> Self {
        let blocks = std::iter::once(0..columns.ncols()).collect();
        Self { columns, blocks }
    }
}

/// What the accepted model leaves, ready to be scanned.
pub struct Left<'a> {
    /// Columns of the problem's declared part.
    pub declared: usize,
    /// The columns of each accepted effect, as `known` numbers them.
    pub accepted: Vec<Vec<usize>>,
    /// Thresholds of each that the data chose, beside its coefficients.
    pub thresholds: Vec<usize>,
    /// Declared and accepted columns, the residual last.
    pub known: Mat<f64>,
    /// Their Gram matrix.
    known_gram: Mat<f64>,
    /// Their scores in each bucket.
    known_scores: Mat<f64>,
    /// The residual after the known columns.
    pub residual: Vec<f64>,
    /// Orthonormal columns that span the known ones.
    pub basis: Mat<f64>,
    /// What is flipped: the residual with each row's leverage undone, or as it is where each flip has its own variance.
    flipped: Vec<f64>,
    signs: &'a Signs,
    /// What the known columns leave of the sum of squares of each flip.
    rss: Vec<f64>,
}

/// What the scan of one sheet found.
struct Scanned {
    /// ln p and rank of each block.
    found: Vec<(f64, usize)>,
    chance: Chance,
    /// How many of the known columns have a rank of their own.
    known: usize,
}

/// What a scan found.
pub struct Scan {
    /// For each sheet and block: ln p, and the columns that count.
    pub found: Vec<Vec<(f64, usize)>>,
    /// The smallest ln p of all.
    pub best: f64,
    /// The smallest ln p of each flip.
    pub chance: Vec<f64>,
}

impl Scan {
    /// The sheet that holds the smallest p.
    #[must_use]
    pub fn most_conspicuous(&self) -> Option<usize> {
        let each = self.found.iter().map(|found| found.iter().map(|&(ln_p, _)| ln_p).fold(0.0, f64::min));
        each.enumerate().min_by(|a, b| a.1.total_cmp(&b.1)).map(|(sheet, _)| sheet)
    }
}

impl<'a> Left<'a> {
    /// After the accepted blocks of a problem.
    #[must_use]
    pub fn new(problem: &Problem, accepted: &[Vec<usize>], signs: &'a Signs) -> Self {
        let rows = problem.rows();
        let own: Vec<usize> = (0..problem.declared())
            .chain(accepted.iter().flatten().copied())
            .chain([problem.residual()])
            .collect();
        let known = Mat::from_fn(rows.nrows(), own.len(), |i, j| rows[(i, own[j])]);
        let basis = orthonormal(problem, accepted, &known);
        let last = rows.col(problem.residual());
        let mut residual: Vec<f64> = last.iter().copied().collect();
        let mut leverage = vec![0.0; residual.len()];
        for column in basis.col_iter() {
            let share: f64 = column.iter().zip(last.iter()).map(|(u, r)| u * r).sum();
            for ((r, h), u) in residual.iter_mut().zip(&mut leverage).zip(column.iter()) {
                *r -= share * u;
                *h += u * u;
            }
        }
        let is_standardised = is_needed(signs.with_sign(), basis.ncols());
        let flipped = match is_standardised {
            true => signs.flipped_as_is(&residual, &leverage),
            false => signs.flipped(&residual, &leverage),
        };
        let known_gram = known.transpose() * &known;
        let (known_scores, rss) = (Mat::zeros(0, 0), Vec::new());
        let declared = problem.declared();
        let mut start = declared;
        let accepted = accepted
            .iter()
            .map(|block| {
                start += block.len();
                (start - block.len()..start).collect()
            })
            .collect::<Vec<_>>();
        let mut left = Self {
            declared,
            thresholds: vec![0; accepted.len()],
            accepted,
            known,
            known_gram,
            known_scores,
            residual,
            basis,
            flipped,
            signs,
            rss,
        };
        left.known_scores = signs.scores(left.known.as_ref(), &left.flipped);
        let total: f64 = left.flipped.iter().map(|e| e * e).sum();
        left.rss = vec![total; signs.flips()];
        if is_standardised {
            return left;
        }
        let sums = signs.flip(signs.scores(left.basis.as_ref(), &left.flipped).as_ref());
        for column in sums.col_iter() {
            left.rss.iter_mut().zip(column.iter()).for_each(|(r, s)| *r -= s * s);
        }
        left
    }

    /// The Gram matrix of the known columns, others, and the residual, in this order.
    #[must_use]
    pub fn gram(&self, columns: MatRef<'_, f64>) -> Mat<f64> {
        self.gram_of_blocks(columns, std::slice::from_ref(&(0..columns.ncols())))
    }

    /// The same without the products of columns of different blocks, which are left zero.
    fn gram_of_blocks(&self, columns: MatRef<'_, f64>, blocks: &[Range<usize>]) -> Mat<f64> {
        let (k, q) = (columns.ncols(), self.known.ncols() - 1);
        let cross = self.known.transpose() * columns;
        let mut own = Mat::zeros(k, k);
        for block in blocks {
            let (start, count) = (block.start, block.len());
            let part = columns.subcols(start, count);
            own.submatrix_mut(start, start, count, count).copy_from(part.transpose() * part);
        }
        let known = &self.known_gram;
        // The residual comes last in both numberings.
        let place = |at: usize| match at {
            _ if at < q => (true, at),
            _ if at < q + k => (false, at - q),
            _ => (true, q),
        };
        Mat::from_fn(q + k + 1, q + k + 1, |i, j| match (place(i), place(j)) {
            ((true, a), (true, b)) => known[(a, b)],
            ((true, a), (false, b)) | ((false, b), (true, a)) => cross[(a, b)],
            ((false, a), (false, b)) => own[(a, b)],
        })
    }

    /// The sum of squares that the declared columns leave, with some of the accepted effects.
    #[must_use]
    pub fn rss_beside(&self, kept: &[usize]) -> f64 {
        let mut sweep = Sweep::new(self.known_gram.clone());
        let residual = self.known.ncols() - 1;
        (0..self.declared).chain(kept.iter().flat_map(|&at| self.accepted[at].clone())).for_each(|column| {
            sweep.add(column);
        });
        sweep.entry(residual, residual)
    }

    /// A sheet's columns without those of which the declared ones, which are orthonormal, leave less than that length: they show nothing.
    /// What accepted effects take of them they may as well take of those effects.
    #[must_use]
    pub fn shown(&self, mut columns: Mat<f64>, least: f64) -> Mat<f64> {
        if least > 0.0 {
            let declared = self.known.subcols(0, self.declared);
            let left = &columns - declared * (declared.transpose() * &columns);
            let unseen = (0..columns.ncols()).filter(|&j| left.col(j).norm_l2() < least);
            unseen.for_each(|j| columns.col_as_slice_mut(j).fill(0.0));
        }
        columns
    }

    /// Scans sheets, made one after another by `sheet`.
    pub fn scan(&self, sheets: usize, sheet: impl Fn(usize) -> Sheet + Sync) -> Scan {
        let rows = self.residual.len();
        let standardised = is_needed(self.signs.with_sign(), self.basis.ncols())
            .then(|| Standardised::new(self.signs, self.basis.as_ref(), &self.flipped));
        let each: Vec<Scanned> = parallel::each(sheets, |number| {
            let sheet = sheet(number);
            let q = self.known.ncols() - 1;
            let gram = self.gram_of_blocks(sheet.columns.as_ref(), &sheet.blocks);
            let before: Vec<f64> = (0..gram.ncols()).map(|j| gram[(j, j)]).collect();
            let mut sweep = Sweep::new(gram);
            let base: Vec<usize> = (0..q).filter(|&column| sweep.add(column)).collect();
            let (residual, df) = (q + sheet.columns.ncols(), (rows - base.len()) as f64);
            let tails = Tails::new(sheet.blocks.iter().map(ExactSizeIterator::len), df);
            let scores = self.signs.scores(sheet.columns.as_ref(), &self.flipped);
            let known = &self.known_scores;
            let own = self.known.subcols(0, q);
            let mut chance = Chance::new(self.signs.flips());
            let mut found = Vec::new();
            for block in &sheet.blocks {
                let seen: Vec<usize> = block
                    .clone()
                    .map(|j| q + j)
                    .filter(|&j| sweep.entry(j, j) > VISIBLE * before[j])
                    .collect();
                let whitener = sweep.whitener(&seen);
                let coefficients = Mat::from_fn(base.len(), seen.len(), |i, j| sweep.entry(base[i], seen[j]));
                if let Some(standardised) = &standardised {
                    let mut columns = Mat::from_fn(rows, seen.len(), |i, j| sheet.columns[(i, seen[j] - q)]);
                    let taken = Mat::from_fn(q, seen.len(), |i, j| {
                        if base.contains(&i) { sweep.entry(i, seen[j]) } else { 0.0 }
                    });
                    columns -= own * taken;
                    let orthonormal = columns * &whitener;
                    chance.add_gains(orthonormal.ncols(), &standardised.gains(orthonormal.as_ref()));
                } else {
                    let scores = Mat::from_fn(scores.nrows(), seen.len(), |g, j| scores[(g, seen[j] - q)]);
                    let base_scores = Mat::from_fn(known.nrows(), base.len(), |g, j| known[(g, base[j])]);
                    let effective = (scores - base_scores * coefficients) * &whitener;
                    chance.add(self.signs.flip(effective.as_ref()).as_ref());
                }
                let (gain, rank) = sweep.gain(&seen, residual);
                found.push((tails.ln_p(rank, gain, sweep.entry(residual, residual)), rank));
            }
            Scanned { found, chance, known: base.len() }
        });
        let most = each.iter().flat_map(|sheet| &sheet.found).map(|&(_, rank)| rank).max().unwrap_or(0);
        let df = (rows - each.first().map_or(0, |sheet| sheet.known)) as f64;
        let best = each.iter().flat_map(|sheet| &sheet.found).map(|&(ln_p, _)| ln_p).fold(0.0, f64::min);
        let (mut all, mut chance) = (Vec::new(), Chance::new(self.signs.flips()));
        for sheet in each {
            all.push(sheet.found);
            chance = chance.merge(sheet.chance);
        }
        Scan { found: all, best, chance: chance.smallest(&self.rss, &Tails::new(1..=most, df)) }
    }
}

/// Orthonormal columns that span the declared and the accepted ones.
fn orthonormal(problem: &Problem, accepted: &[Vec<usize>], known: &Mat<f64>) -> Mat<f64> {
    let all: Vec<usize> = accepted.iter().flatten().copied().collect();
    let sweep = Sweep::new(problem.gram(|_| true).0);
    let whitener = sweep.whitener(&all);
    let u = problem.declared();
    let effects = known.subcols(u, all.len()) * &whitener;
    let mut basis = Mat::zeros(known.nrows(), u + effects.ncols());
    basis.subcols_mut(0, u).copy_from(known.subcols(0, u));
    basis.subcols_mut(u, effects.ncols()).copy_from(&effects);
    basis
}
