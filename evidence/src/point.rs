//! A point of linearisation in scaled numbers: residual, estimable combinations of declared errors, columns of places.

use faer::{Mat, Side};

use crate::error::Error;
use crate::linearise::Linearisation;
use crate::places::Places;
use crate::policy::Policy;
use crate::problem::Problem;

/// What is fixed for a whole contest: units and the combinations of declared errors that the data determine.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scaling {
    /// RMS of the first residual: everything is in this unit.
    pub unit: f64,
    /// One over the stated uncertainty, relative to its geometric mean; ones where none is stated.
    pub stated: Vec<f64>,
    /// Declared errors (rows) of each estimable combination (columns).
    pub combinations: Mat<f64>,
    /// Whether each declared error is determined by itself.
    pub determined: Vec<bool>,
    /// Measured values less estimable combinations.
    pub freedom: f64,
}

/// Residual and columns at one point, in the contest's units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    /// Estimates of the declared errors here.
    pub estimates: Vec<f64>,
    /// Coefficients of effects in the exact chain here, by column of the dictionary.
    pub inside: Vec<(usize, f64)>,
    /// Residual with the linear part of the effects inside added back.
    pub residual: Vec<f64>,
    /// Columns of the estimable combinations.
    pub declared: Vec<Vec<f64>>,
    /// Columns of the distinct places.
    pub places: Vec<Vec<f64>>,
}

impl Scaling {
    /// The scaling of a problem.
    pub fn of(problem: &Problem, policy: &Policy) -> Result<Self, Error> {
        let values = problem.values();
        let stated = match &problem.sigma {
            Some(sigma) => {
                let mean = sigma.iter().map(|value| value.ln()).sum::<f64>() / values as f64;
                sigma.iter().map(|value| mean.exp() / value).collect()
            }
            None => vec![1.0; values],
        };
        let unit = (problem.residual.iter().map(|value| value * value).sum::<f64>() / values as f64).sqrt();
        if unit == 0.0 {
            return Err(Error::NoNoise);
        }
        let combinations = combinations(problem, policy);
        let rank = combinations.ncols();
        if values <= rank {
            return Err(Error::NoFreedom { values, rank });
        }
        let determined = determined(problem, &combinations);
        Ok(Self { unit, stated, combinations, determined, freedom: (values - rank) as f64 })
    }

    /// A point in these units.
    pub fn point(&self, places: &Places, given: &Linearisation, estimates: Vec<f64>) -> Point {
        let weigh = |column: &[f64], unit: f64| -> Vec<f64> {
            column.iter().zip(&self.stated).map(|(value, weight)| value * weight / unit).collect()
        };
        let combine = |combination: usize| {
            let mut column = vec![0.0; given.residual.len()];
            for (error, own) in given.declared.iter().enumerate() {
                let part = self.combinations[(error, combination)];
                for (sum, value) in column.iter_mut().zip(own) {
                    *sum += part * value;
                }
            }
            weigh(&column, 1.0)
        };
        Point {
            estimates,
            inside: Vec::new(),
            residual: weigh(&given.residual, self.unit),
            declared: (0..self.combinations.ncols()).map(combine).collect(),
            places: places.distinct.iter().map(|place| weigh(&given.places[place.place], 1.0)).collect(),
        }
    }
}

/// Directions of the declared errors whose columns are orthonormal over the data; what is not estimable is left out.
fn combinations(problem: &Problem, policy: &Policy) -> Mat<f64> {
    let count = problem.declared.len();
    let columns: Vec<&[f64]> = problem.declared.iter().map(|error| error.column.as_slice()).collect();
    let lengths: Vec<f64> = columns.iter().map(|column| crate::algebra::dot(column, column).sqrt()).collect();
    let scale = |at: usize| if lengths[at] > 0.0 { lengths[at] } else { 1.0 };
    let scaled = Mat::from_fn(problem.values(), count, |row, at| columns[at][row] / scale(at));
    let Ok(svd) = scaled.thin_svd() else { return Mat::zeros(count, 0) };
    let values = svd.S().column_vector();
    let kept =
        (0..values.nrows()).filter(|&at| values[at] > policy.rank * values[0] && values[at] > 0.0).count();
    Mat::from_fn(count, kept, |error, at| svd.V()[(error, at)] / values[at] / scale(error))
}

/// Whether an error's unit vector lies in the span of what is estimable.
fn determined(problem: &Problem, combinations: &Mat<f64>) -> Vec<bool> {
    let count = problem.declared.len();
    let lengths: Vec<f64> = problem
        .declared
        .iter()
        .map(|error| crate::algebra::dot(&error.column, &error.column).sqrt())
        .collect();
    let span = Mat::from_fn(count, combinations.ncols(), |row, at| combinations[(row, at)] * lengths[row]);
    let gram = span.transpose() * &span;
    let Ok(factor) = gram.llt(Side::Lower) else { return vec![false; count] };
    use faer::linalg::solvers::Solve;
    let projector = &span * factor.solve(span.transpose());
    (0..count).map(|at| lengths[at] > 0.0 && (projector[(at, at)] - 1.0).abs() < 1e-6).collect()
}
