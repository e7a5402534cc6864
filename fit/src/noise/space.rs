//! A memory in axes that stand still. What is read across and along a beam turns with the beam; a drift of the ground does not.
//! In space each axis has AR(1) with white noise on top, of which a direction shows what lies across it.
//!
//! Source: A. C. Harvey, Forecasting, Structural Time Series Models and the Kalman Filter (1989), section 3.2: the innovations
//! of the filter are independent, and say everything.

use super::{Carried, Run, Serial};
use observe::Observations;
use observe::kinds::SpaceAxes;

/// A vector of space.
type Vector = [f64; 3];

/// Per component of the residuals the unit vector along which it is measured; `None` where residuals stand still anyway, or
/// are no components of a vector.
#[must_use]
pub fn axes(observations: &Observations) -> Option<Vec<Vector>> {
    let of_series = observations.poses.series.iter().map(|series| series.measure.kind().space_axes);
    let of_series: Vec<SpaceAxes> = of_series.collect::<Option<_>>()?;
    if !of_series.iter().any(|axes| axes.turn) {
        return None;
    }
    let series = observations.poses.series.iter().zip(of_series);
    let each = series.flat_map(|(series, axes)| {
        let rows = observations.measured[series.rows.clone()].iter();
        rows.flat_map(move |measured| (axes.of)(measured).into_iter().take(series.measure.components()))
    });
    Some(each.collect())
}

/// What makes innovations of values that remember in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Filter {
    serial: Serial,
    axes: Vec<Vector>,
    /// How far the three numbers that are remembered follow the innovation of each component.
    gain: Vec<Vector>,
    /// One over the standard deviation of each innovation.
    scale: Vec<f64>,
}

impl Filter {
    /// A filter along runs of components; `None` for a memory that no sum of AR(1) and white noise has.
    #[must_use]
    pub fn new(serial: Serial, axes: &[Vector], runs: &[Run]) -> Option<Self> {
        let Parts { remembered, white } = Parts::of(serial)?;
        let mut gain = vec![Vector::default(); axes.len()];
        let mut scale = vec![1.0; axes.len()];
        let keep = serial.autoregressive;
        for run in runs {
            let mut covariance = diagonal(remembered);
            for row in (run.start..run.end).step_by(run.stride) {
                if row > run.start {
                    for (i, line) in covariance.iter_mut().enumerate() {
                        line.iter_mut().for_each(|value| *value *= keep * keep);
                        line[i] += remembered * (1.0 - keep * keep);
                    }
                }
                for at in row..(row + run.stride).min(run.end) {
                    let seen = covariance.map(|line| dot(&line, &axes[at]));
                    let variance = dot(&seen, &axes[at]) + white;
                    gain[at] = seen.map(|value| value / variance);
                    scale[at] = 1.0 / variance.sqrt();
                    for (line, gain) in covariance.iter_mut().zip(gain[at]) {
                        line.iter_mut().zip(seen).for_each(|(value, seen)| *value -= gain * seen);
                    }
                }
            }
        }
        Some(Self { serial, axes: axes.to_vec(), gain, scale })
    }

    /// The same for some of the runs, put one after another as `own` says.
    #[must_use]
    pub fn of_runs(&self, runs: &[Run], own: &[Run]) -> Option<Self> {
        let axes: Vec<Vector> =
            runs.iter().flat_map(|run| self.axes[run.start..run.end].iter().copied()).collect();
        Self::new(self.serial, &axes, own)
    }

    /// Turns values into innovations in place, each in units of its own standard deviation.
    pub fn whiten(&self, column: &mut [f64], run: Run) {
        let mut remembered = Vector::default();
        for row in (run.start..run.end).step_by(run.stride) {
            remembered.iter_mut().for_each(|value| *value *= self.serial.autoregressive);
            for at in row..(row + run.stride).min(run.end) {
                let Some(value) = column.get_mut(at) else { return };
                let innovation = *value - dot(&remembered, &self.axes[at]);
                remembered
                    .iter_mut()
                    .zip(self.gain[at])
                    .for_each(|(value, gain)| *value += gain * innovation);
                *value = innovation * self.scale[at];
            }
        }
    }

    /// ln |V| of the values that have innovations of variance about one.
    #[must_use]
    pub fn ln_determinant(&self) -> f64 {
        self.scale.iter().map(|scale| -2.0 * scale.ln()).sum()
    }

    /// The products of a piece of a run with what each value, of variance one, has part in: two roots of the covariance, one after
    /// the other, so that the sum of squares is what the noise makes of the column. Pieces come from the last to the first.
    #[must_use]
    pub fn coloured(&self, column: &[f64], piece: Run, after: &mut Carried, begins: bool) -> Vec<f64> {
        let Some(Parts { remembered, white }) = Parts::of(self.serial) else {
            unreachable!("a filter is made of such parts")
        };
        let total = remembered + white;
        let alone = Serial { moving_average: 0.0, ..self.serial };
        // The column by the axes of space, row by row.
        let mut roots = Vec::new();
        for row in (piece.start..piece.end).step_by(piece.stride) {
            let mut sum = Vector::default();
            let own = row..(row + piece.stride).min(piece.end);
            for (axes, value) in self.axes[own.clone()].iter().zip(&column[own]) {
                sum.iter_mut().zip(axes).for_each(|(sum, axis)| *sum += axis * value);
            }
            roots.extend(sum);
        }
        alone.colour(&mut roots, 3, after, begins);
        roots.iter_mut().for_each(|value| *value *= (remembered / total).sqrt());
        roots.extend(column[piece.start..piece.end].iter().map(|value| value * (white / total).sqrt()));
        roots
    }
}

/// ARMA(1,1) with innovations of variance one as AR(1) and white noise: the variance of either.
///
/// Source: C. W. J. Granger, M. J. Morris, Time series modelling and interpretation, Journal of the Royal Statistical Society A
/// 139 (1976) 246-257.
struct Parts {
    remembered: f64,
    white: f64,
}

impl Parts {
    fn of(serial: Serial) -> Option<Self> {
        let Serial { autoregressive: phi, moving_average: theta } = serial;
        let remembered = (1.0 + phi * theta) * (phi + theta) / (1.0 - phi * phi) / phi;
        let white = serial.gain().powi(2) - remembered;
        let rounding = 1e-12 * serial.gain().powi(2);
        (phi > 0.0 && remembered > 0.0 && white > -rounding)
            .then_some(Self { remembered, white: white.max(0.0) })
    }
}

fn diagonal(value: f64) -> [Vector; 3] {
    [[value, 0.0, 0.0], [0.0, value, 0.0], [0.0, 0.0, value]]
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use approx::assert_relative_eq;
    use faer::{Mat, Side};

    use super::*;

    /// A beam that turns by a fifth of a radian a row, and the axes across and along it.
    fn turning(rows: usize) -> Vec<Vector> {
        let of = |row: usize| {
            let (a, e) = (0.2 * row as f64, 0.7 * (0.13 * row as f64).sin());
            let [across, along] = observe::tangent_frame(&observe::direction_from_spherical(a, e));
            [across.into(), along.into()]
        };
        (0..rows).flat_map(of).collect()
    }

    /// The covariance of the values, written down from its meaning.
    fn covariance(serial: Serial, axes: &[Vector]) -> Mat<f64> {
        let (phi, theta) = (serial.autoregressive, serial.moving_average);
        Mat::from_fn(axes.len(), axes.len(), |i, j| {
            let lag = (i / 2).abs_diff(j / 2);
            let own = if lag == 0 {
                (1.0 + 2.0 * phi * theta + theta * theta) / (1.0 - phi * phi)
            } else {
                (1.0 + phi * theta) * (phi + theta) / (1.0 - phi * phi) * phi.powi(lag as i32 - 1)
            };
            own * dot(&axes[i], &axes[j])
        })
    }

    #[test]
    fn innovations_have_the_likelihood_of_the_values() {
        for serial in [
            Serial { autoregressive: 0.9, moving_average: -0.5 },
            Serial { autoregressive: 0.6, moving_average: 0.0 },
        ] {
            let axes = turning(30);
            let run = Run { start: 0, end: 60, stride: 2 };
            let filter = Filter::new(serial, &axes, &[run]).unwrap();
            let values: Vec<f64> = (0..60).map(|i| (f64::from(i) * 0.754_877_666).fract() - 0.5).collect();
            let mut white = values.clone();
            filter.whiten(&mut white, run);
            let factor = covariance(serial, &axes).llt(Side::Lower).unwrap();
            // Forward substitution through the Cholesky factor.
            let mut expected: Vec<f64> = Vec::new();
            for (i, value) in values.iter().enumerate() {
                let before: f64 =
                    expected.iter().enumerate().map(|(j, known)| factor.L()[(i, j)] * known).sum();
                expected.push((value - before) / factor.L()[(i, i)]);
            }
            for (found, expected) in white.iter().zip(&expected) {
                assert_relative_eq!(found, expected, epsilon = 1e-9);
            }
            let ln: f64 = (0..60).map(|i| 2.0 * factor.L()[(i, i)].ln()).sum();
            assert_relative_eq!(filter.ln_determinant(), ln, epsilon = 1e-9);
        }
    }

    #[test]
    fn colouring_gives_the_covariance() {
        let serial = Serial { autoregressive: 0.8, moving_average: -0.3 };
        let axes = turning(200);
        let runs = [Run { start: 0, end: 400, stride: 2 }];
        let filter = Filter::new(serial, &axes, &runs).unwrap();
        let column: Vec<f64> = (0..400).map(|i| (f64::from(i) * 0.07).cos()).collect();
        let mut after = Carried::default();
        let squares = [(200..400, false), (0..200, true)].map(|(own, begins)| {
            let piece = Run { start: own.start, end: own.end, stride: 2 };
            let coloured = filter.coloured(&column, piece, &mut after, begins);
            coloured.iter().map(|value| value * value).sum::<f64>()
        });
        let square: f64 = squares.iter().sum();
        let covariance = covariance(serial, &axes);
        let pairs = column.iter().enumerate().flat_map(|a| column.iter().enumerate().map(move |b| (a, b)));
        let expected: f64 = pairs.map(|((i, a), (j, b))| a * covariance[(i, j)] * b).sum();
        assert_relative_eq!(square * serial.gain().powi(2), expected, max_relative = 1e-9);
    }

    /// What is remembered across a beam that does not turn is what each of its two axes remembers.
    #[test]
    fn a_beam_that_stands_still_remembers_by_component() {
        let serial = Serial { autoregressive: 0.8, moving_average: -0.3 };
        let run = Run { start: 0, end: 80, stride: 2 };
        let axes: Vec<Vector> = (0..40).flat_map(|_| [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]]).collect();
        let filter = Filter::new(serial, &axes, &[run]).unwrap();
        let values: Vec<f64> = (0..80).map(|i| (f64::from(i) * 0.754_877_666).fract() - 0.5).collect();
        let (mut here, mut there) = (values.clone(), values);
        filter.whiten(&mut here, run);
        serial.whiten(&mut there, run);
        // Once the beginning is forgotten.
        for at in 60..80 {
            assert_relative_eq!(here[at], there[at], epsilon = 1e-6);
        }
    }

    #[test]
    fn no_sum_of_the_two_has_a_positive_moving_average() {
        let serial = Serial { autoregressive: 0.5, moving_average: 0.4 };
        assert!(Filter::new(serial, &turning(4), &[Run { start: 0, end: 8, stride: 2 }]).is_none());
    }
}
