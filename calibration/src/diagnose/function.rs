//! A function of a joint or input at one place: its shape, and the words in which a study takes it up.

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use model_core::{Chain, Quantity};
use serde::Serialize;

use super::basis::Basis;
use crate::search::contest::Contender;
use effects::candidate::{Dependence, Place};
use observe::SiUnit;

/// Points of the shape that is reported.
const POINTS: usize = 61;

/// How well powers must follow a shape, in two standard uncertainties of it.
const FOLLOWED: f64 = 0.25;

/// The highest power.
const HIGHEST: usize = 12;

/// What kind of function.
pub(super) enum Kind {
    /// The first of a series, up to an order.
    Series(Basis, u32),
    /// A bump, by its centre and width.
    Bump(Basis, (f64, f64)),
    /// Of two joints: its form in the catalogue, and its functions in the plain syntax of amounts.
    OfTwo(Dependence, Vec<String>),
}

/// The kind of a function, as the report has it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Form {
    /// Sines and cosines of a joint that turns all around.
    Fourier {
        /// The highest order.
        order: u32,
    },
    /// Cosines over the range of the readings.
    Cosines {
        /// The highest order.
        order: u32,
    },
    /// A bump.
    Bump {
        /// Where it is highest, SI.
        centre: f64,
        /// Its standard width, SI.
        width: f64,
        /// Their unit.
        unit: SiUnit,
    },
    /// Products of harmonics or powers of two joints.
    Product {
        /// As the catalogue has it.
        form: Dependence,
    },
}

/// A function at a place that explains the data better than the catalogue.
pub(super) struct Function {
    pub place: Place,
    pub driver: String,
    pub driver_unit: SiUnit,
    pub kind: Kind,
    pub fitted: Contender,
}

impl Function {
    /// What kind of function it is.
    pub fn form(&self) -> Form {
        match &self.kind {
            Kind::Series(basis, order) if basis.turns() => Form::Fourier { order: *order },
            Kind::Series(_, order) => Form::Cosines { order: *order },
            Kind::Bump(_, (centre, width)) => {
                Form::Bump { centre: *centre, width: *width, unit: self.driver_unit }
            }
            Kind::OfTwo(form, _) => Form::Product { form: form.clone() },
        }
    }

    /// Driver, value and two standard uncertainties over the range of the driver's readings; nothing for two drivers.
    pub fn shape(&self) -> Vec<Vec<f64>> {
        let (basis, at): (Basis, &dyn Fn(f64) -> Vec<f64>) = match &self.kind {
            Kind::Series(basis, _) => (*basis, &|q| basis.series(q)),
            Kind::Bump(basis, bump) => (*basis, &|q| vec![basis.bump(*bump, q)]),
            Kind::OfTwo(..) => return Vec::new(),
        };
        let width = self.fitted.coefficients.len();
        (0..POINTS)
            .map(|point| {
                let q = basis.low + (basis.high - basis.low) * point as f64 / (POINTS - 1) as f64;
                let at = at(q);
                let value: f64 = at.iter().zip(&self.fitted.coefficients).map(|(f, c)| f * c).sum();
                let variance: f64 = (0..width)
                    .map(|i| {
                        let row = &self.fitted.covariance[i * width..(i + 1) * width];
                        at[i] * row.iter().zip(&at).map(|(c, f)| c * f).sum::<f64>()
                    })
                    .sum();
                vec![q, value, 2.0 * variance.max(0.0).sqrt()]
            })
            .collect()
    }

    /// The lines by which a study makes it an effect of its own; `None` for a bump, which no amount can follow.
    pub fn offer(&self, chain: &Chain) -> Option<String> {
        let functions = match &self.kind {
            Kind::Series(basis, _) => self.in_words(chain, *basis)?,
            Kind::Bump(..) => return None,
            Kind::OfTwo(_, functions) => functions.clone(),
        };
        let quoted: Vec<String> = functions.iter().map(|function| format!("    \"{function}\",\n")).collect();
        let body = &chain.body(self.place.body).name;
        let moves = self.place.freedom.word();
        Some(format!(
            "[[effect]]\nname      = \"function of {} at {moves} of {body}\"\nbody      = \"{body}\"\nmoves     = \
             \"{moves}\"\nfunctions = [\n{}]\n",
            self.driver,
            quoted.concat()
        ))
    }

    /// Functions that span a series, in the plain syntax of amounts: the harmonics of an angle; of anything else powers, as
    /// far as it takes to follow the shape.
    fn in_words(&self, chain: &Chain, basis: Basis) -> Option<Vec<String>> {
        let driver = &self.driver;
        let symbol = chain.symbol(chain.find_symbol(driver)?);
        let half = (basis.high - basis.low) / 2.0;
        let base = match symbol.quantity {
            Quantity::Angle => {
                let orders = 1..=self.fitted.coefficients.len().div_ceil(2);
                let angles =
                    orders.map(|order| if order == 1 { driver.clone() } else { format!("{order}*{driver}") });
                return Some(
                    angles.flat_map(|angle| [format!("cos({angle})"), format!("sin({angle})")]).collect(),
                );
            }
            Quantity::Number => {
                let middle = short(basis.low + half);
                let sign = if middle < 0.0 { '+' } else { '-' };
                format!("(({driver} {sign} {})/{})", middle.abs(), short(half))
            }
            Quantity::Length => format!("({driver}/{})", short(half)),
        };
        let power = |power| if power == 1 { base.clone() } else { format!("{base}^{power}") };
        Some((1..=degree(&self.shape())).map(power).collect())
    }
}

/// The lowest degree of a polynomial that follows a shape to a share of its uncertainty.
fn degree(shape: &[Vec<f64>]) -> usize {
    let n = shape.len();
    // Chebyshev's polynomials, on equidistant points between −1 and 1.
    let x = |point: usize| 2.0 * point as f64 / (n as f64 - 1.0) - 1.0;
    let columns = |degree: usize| Mat::from_fn(n, degree + 1, |i, k| (k as f64 * x(i).acos()).cos());
    let values = Mat::from_fn(n, 1, |i, _| shape[i][1]);
    let follows = |degree: &usize| {
        let columns = columns(*degree);
        let left = &values - &columns * columns.qr().solve_lstsq(&values);
        (0..n).all(|i| left[(i, 0)].abs() <= FOLLOWED * shape[i][2])
    };
    (1..HIGHEST).find(follows).unwrap_or(HIGHEST)
}

/// A number to two digits, which is enough to scale by.
fn short(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
