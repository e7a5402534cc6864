//! Guards against effects that cancel each other: asked before one is accepted, and before one takes another's place.
//!
//! Two effects that nearly coincide over the data can follow any small residual by large opposite amounts; the likelihood
//! likes that, the instrument at other poses does not.

use faer::Mat;

use super::confounded::{SetColumns, SetId};
use super::reach::Reach;
use super::sweep::Sweep;

/// G1: what one effect does alone, over what all do together, at most.
const ALONE: f64 = 1.5;

/// G2: what all effects do at poses further out, over what they do at those of the data, at most.
const FURTHER_OUT: f64 = 5.0;

/// Joint regressions of some confounded sets on what the declared columns leave.
pub(super) struct Guards<'a> {
    /// The Gram matrix with the declared columns swept, and nothing else.
    pub projected: Sweep,
    /// The columns of each set.
    pub blocks: &'a SetColumns,
    /// How many columns are declared.
    pub declared: usize,
    /// The column that holds the residual.
    pub residual: usize,
    /// What columns do at the data's poses and further out; where nobody knows, G1 holds alone.
    pub reach: Option<&'a Reach>,
}

impl Guards<'_> {
    /// Whether these sets, fitted together, neither cancel each other nor grow beyond the data.
    pub fn hold(&self, sets: &[SetId]) -> bool {
        let own: Vec<usize> = sets.iter().flat_map(|&set| &self.blocks[set]).copied().collect();
        let (coefficients, gram) = self.fitted(&own);
        let square = |within: &dyn Fn(usize) -> bool| -> f64 {
            let inside: Vec<usize> = (0..own.len()).filter(|&i| within(i)).collect();
            let pairs = inside.iter().flat_map(|&i| inside.iter().map(move |&j| (i, j)));
            pairs.map(|(i, j)| coefficients[i] * gram[(i, j)] * coefficients[j]).sum::<f64>().max(0.0)
        };
        let together = square(&|_| true);
        let mut start = 0;
        for &set in sets {
            let end = start + self.blocks[set].len();
            if square(&|i| (start..end).contains(&i)) > ALONE * ALONE * together {
                return false;
            }
            start = end;
        }
        self.reach.is_none_or(|reach| {
            let of = self.of_candidates(&own, &coefficients);
            reach.outside(&of) <= FURTHER_OUT * reach.inside(&of)
        })
    }

    /// What these sets, fitted together, do at poses further out, root mean square; `None` where nobody knows.
    pub fn further_out(&self, sets: &[SetId]) -> Option<f64> {
        let own: Vec<usize> = sets.iter().flat_map(|&set| &self.blocks[set]).copied().collect();
        let (coefficients, _) = self.fitted(&own);
        self.reach.map(|reach| reach.outside(&self.of_candidates(&own, &coefficients)))
    }

    /// Coefficients of columns, numbered from the first candidate's.
    fn of_candidates(&self, columns: &[usize], coefficients: &[f64]) -> Vec<(usize, f64)> {
        columns.iter().zip(coefficients).map(|(column, &a)| (column - self.declared, a)).collect()
    }

    /// The coefficients of some columns fitted together (zero for those that the others leave nothing of), and their Gram
    /// matrix.
    fn fitted(&self, columns: &[usize]) -> (Vec<f64>, Mat<f64>) {
        let all: Vec<usize> = columns.iter().copied().chain([self.residual]).collect();
        let gram = Mat::from_fn(all.len(), all.len(), |i, j| self.projected.entry(all[i], all[j]));
        let mut sweep = Sweep::new(gram.clone());
        let last = columns.len();
        let swept: Vec<bool> = (0..last).map(|column| sweep.add(column)).collect();
        let coefficient = |column: usize| if swept[column] { sweep.entry(column, last) } else { 0.0 };
        ((0..last).map(coefficient).collect(), gram)
    }
}
