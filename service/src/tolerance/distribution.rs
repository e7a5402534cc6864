//! How an error is spread over its size: evenly, normally, or as a table says.

use model_core::names;
use rand::{Rng, RngExt as _};
use rand_distr::StandardNormal;

/// A distribution in units of an error's size.
#[derive(Debug, Clone, PartialEq)]
pub enum Distribution {
    /// Even from minus the size to the size.
    Uniform,
    /// Normal about zero.
    Normal {
        /// How many standard deviations the size is.
        deviations: f64,
    },
    /// What a table says.
    Table(Shape),
}

/// Why a text or a table is no distribution.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum DistributionError {
    /// No such name.
    #[error("there is no distribution `{name}`; {instead}")]
    Name {
        /// As written.
        name: String,
        /// What to write.
        instead: String,
    },
    /// A normal distribution without its width.
    #[error("`normal` does not say how wide it is; write `normal 2` for a size of two standard deviations")]
    NoWidth,
    /// A width that is none.
    #[error("`{0}` is no number of standard deviations; write one above zero, as in `normal 2`")]
    Width(String),
    /// A table without a file.
    #[error("`table` does not say which; write `table FILE.csv`")]
    NoTable,
    /// Something behind a name that takes nothing.
    #[error("`uniform` takes nothing behind it, and `{0}` stands there")]
    Surplus(String),
    /// Too short a table.
    #[error("a table needs two rows at least, of a value and how often it comes")]
    FewRows,
    /// A value beyond the size.
    #[error(
        "row {row}: the value {value} is beyond the size; values are fractions of the size, from -1 to 1"
    )]
    Beyond {
        /// Counted from 1.
        row: usize,
        /// As written.
        value: String,
    },
    /// Values out of order.
    #[error("row {row}: the value does not rise; sort the table by its values, each once")]
    Order {
        /// Counted from 1.
        row: usize,
    },
    /// A frequency that cannot be one.
    #[error("row {row}: {frequency} cannot say how often the value comes; write a number from 0 on")]
    Frequency {
        /// Counted from 1.
        row: usize,
        /// As written.
        frequency: String,
    },
    /// Nothing ever comes.
    #[error("every value comes with frequency 0, so that nothing is left to draw")]
    Empty,
}

/// What a text says of a distribution before any table is read.
#[derive(Debug, Clone, PartialEq)]
pub enum Written {
    /// All of it.
    Whole(Distribution),
    /// The file that holds it.
    InFile(String),
}

impl Distribution {
    /// Reads `uniform`, `normal 2` or `table FILE`.
    ///
    /// # Errors
    /// See [`DistributionError`].
    pub fn parse(text: &str) -> Result<Written, DistributionError> {
        let text = text.trim();
        let (name, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
        let rest = rest.trim();
        match name {
            "uniform" if rest.is_empty() => Ok(Written::Whole(Self::Uniform)),
            "uniform" => Err(DistributionError::Surplus(rest.to_owned())),
            "normal" if rest.is_empty() => Err(DistributionError::NoWidth),
            "normal" => match rest.parse::<f64>() {
                Ok(deviations) if deviations.is_finite() && deviations > 0.0 => {
                    Ok(Written::Whole(Self::Normal { deviations }))
                }
                _ => Err(DistributionError::Width(rest.to_owned())),
            },
            "table" if rest.is_empty() => Err(DistributionError::NoTable),
            "table" => Ok(Written::InFile(rest.to_owned())),
            _ => {
                let instead = match names::nearest(name, ["uniform", "normal", "table"]) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => "write `uniform`, `normal 2` or `table FILE.csv`".to_owned(),
                };
                Err(DistributionError::Name { name: name.to_owned(), instead })
            }
        }
    }

    /// The mean in units of the size.
    #[must_use]
    pub fn mean(&self) -> f64 {
        match self {
            Self::Uniform | Self::Normal { .. } => 0.0,
            Self::Table(shape) => shape.mean,
        }
    }

    /// The standard deviation in units of the size.
    #[must_use]
    pub fn standard_deviation(&self) -> f64 {
        match self {
            Self::Uniform => 1.0 / 3.0_f64.sqrt(),
            Self::Normal { deviations } => 1.0 / deviations,
            Self::Table(shape) => shape.standard_deviation,
        }
    }

    /// One value in units of the size.
    pub(super) fn draw(&self, chance: &mut impl Rng) -> f64 {
        match self {
            Self::Uniform => 2.0 * chance.random::<f64>() - 1.0,
            Self::Normal { deviations } => chance.sample::<f64, _>(StandardNormal) / deviations,
            Self::Table(shape) => shape.at(chance.random()),
        }
    }
}

/// A density that is linear between the rows of a table, zero outside them.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    values: Vec<f64>,
    density: Vec<f64>,
    /// The chance of a value up to each row.
    cumulative: Vec<f64>,
    mean: f64,
    standard_deviation: f64,
}

impl Shape {
    /// From rows of a value, in units of the size, and how often it comes, on any scale.
    ///
    /// # Errors
    /// See [`DistributionError`].
    pub fn new(rows: &[(f64, f64)]) -> Result<Self, DistributionError> {
        if rows.len() < 2 {
            return Err(DistributionError::FewRows);
        }
        for (at, &(value, frequency)) in rows.iter().enumerate() {
            let row = at + 1;
            if !(-1.0..=1.0).contains(&value) {
                return Err(DistributionError::Beyond { row, value: value.to_string() });
            }
            if at > 0 && value <= rows[at - 1].0 {
                return Err(DistributionError::Order { row });
            }
            if !frequency.is_finite() || frequency < 0.0 {
                return Err(DistributionError::Frequency { row, frequency: frequency.to_string() });
            }
        }
        let most = rows.iter().map(|row| row.1).fold(0.0, f64::max);
        if most == 0.0 {
            return Err(DistributionError::Empty);
        }
        // Moments about zero of a trapezium: a linear density times powers of the value, by Simpson's rule, which is exact
        // up to cubes.
        let (mut sums, mut cumulative) = ([0.0; 3], vec![0.0]);
        for pair in rows.windows(2) {
            let ((a, p), (b, q)) = ((pair[0].0, pair[0].1 / most), (pair[1].0, pair[1].1 / most));
            let (middle, m) = (f64::midpoint(a, b), f64::midpoint(p, q));
            for (power, sum) in (0..).zip(&mut sums) {
                *sum +=
                    (b - a) / 6.0 * (p * a.powi(power) + 4.0 * m * middle.powi(power) + q * b.powi(power));
            }
            cumulative.push(sums[0]);
        }
        let [whole, first, second] = sums;
        let mean = first / whole;
        cumulative.iter_mut().for_each(|part| *part /= whole);
        Ok(Self {
            values: rows.iter().map(|row| row.0).collect(),
            density: rows.iter().map(|row| row.1 / most / whole).collect(),
            cumulative,
            mean,
            standard_deviation: (second / whole - mean * mean).max(0.0).sqrt(),
        })
    }

    /// The value up to which the chance is `part`, from 0 to 1.
    fn at(&self, part: f64) -> f64 {
        let last = self.values.len() - 1;
        let row = self.cumulative.partition_point(|&up_to| up_to <= part).clamp(1, last);
        let (from, to) = (self.values[row - 1], self.values[row]);
        let (p, q) = (self.density[row - 1], self.density[row]);
        let rest = part - self.cumulative[row - 1];
        // rest = p x + (q − p) x² / 2w, solved for x without cancellation.
        let slope = (q - p) / (to - from);
        let root = (p * p + 2.0 * slope * rest).max(0.0).sqrt();
        let along = if p + root > 0.0 { 2.0 * rest / (p + root) } else { 0.0 };
        (from + along).clamp(from, to)
    }
}
