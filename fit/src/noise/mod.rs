//! The noise of the observations: how large in each component, how it varies with the joints, and how it
//! remembers the observation before or hangs together with those of its group.
//!
//! `σ²` of a component = floor² of its kind · exp(variance model of the joints); in order of acquisition the values
//! so scaled follow ARMA(1,1). Each part is taken up only if the data bear it out.

mod brought;
mod estimate;
mod layout;
mod mute;
mod pool;
pub mod serial;
pub(super) mod session;
pub mod space;
pub(super) mod trend;
mod variance;

use std::borrow::Cow;

use model_core::SymbolId;

use crate::robust::median;
use observe::{NoiseOf, Observations};

pub use estimate::{Followed, estimate, from_medians, of_floors, resolution};
pub(super) use estimate::{each, ln_scale, stated};
pub use layout::{Layout, Run};
pub use mute::Mute;
pub use pool::Pools;
pub use session::Offsets;
pub use space::Filter;

/// What is known of the noise, and what to find out about it.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseOptions {
    /// The standard deviation of every residual component, rad or m, whatever the residuals say; estimated if `None`.
    pub sigma: Option<f64>,
    /// The standard deviation that is stated for every residual component, rad or m: what is known of the noise as long as
    /// residuals do not contradict, while they weigh the rows.
    pub stated: Option<f64>,
    /// Whether to look for a variance that depends on the joints.
    pub variance: bool,
    /// Whether to look for serial correlation: in order of acquisition, or where none is declared in that of the file.
    pub serial: bool,
    /// Whether rows beside unknown objects that are found to be off alike count as stretches.
    pub stretches: bool,
    /// Whether what smooth functions of the readings follow as well is taken for effects that the chain lacks, not for memory.
    pub beside_effects: bool,
}

impl NoiseOptions {
    /// The standard deviation that is stated for all components.
    pub(crate) fn known(&self) -> Option<f64> {
        self.sigma.filter(|sigma| *sigma > 0.0)
    }

    /// The same where weights go by what the residuals are, and what is known of them only states what they should be: while
    /// something is missing, residuals are larger than the noise.
    #[must_use]
    pub fn by_residuals(&self) -> Self {
        Self { sigma: None, stated: self.stated.or(self.sigma), ..self.clone() }
    }
}

impl Default for NoiseOptions {
    fn default() -> Self {
        Self {
            sigma: None,
            stated: None,
            variance: true,
            serial: true,
            stretches: true,
            beside_effects: true,
        }
    }
}

/// The noise that a fit assumed and found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Noise {
    /// Standard deviation of each kind of component (series by series, component by component): rad or m, or a
    /// factor on the standard uncertainties that the data state.
    pub floor: Vec<f64>,
    /// How many times as uncertain readings were found to be as the data state; 1 where nothing tells.
    pub of_readings: f64,
    /// The dependence of the variance on the joints: of angles, of lengths and across a beam, where one was found.
    pub variance: Vec<VarianceModel>,
    /// The serial correlation, if one was found.
    pub serial: Option<Serial>,
    /// What whitens by it, where rows remember in axes that stand still in space, and not across and along a beam that turns.
    pub in_space: Option<Filter>,
    /// Whether rows were found to remember those before in the order of the file, though none is declared; without
    /// [serial](Self::serial) where that may as well be an effect that the chain lacks.
    pub undeclared_order: bool,
    /// What the rows of a declared group share, if they share anything.
    pub offsets: Option<Offsets>,
    /// Per residual component the standard deviation that whitening divides by, rad or m, length n. With serial
    /// correlation, that of what the value before does not explain.
    pub sigma: Vec<f64>,
    /// Components that follow each other in order of acquisition.
    pub runs: Vec<Run>,
}

/// log variance = Σ coefficient · function of joints and ranges, above the floor.
#[derive(Debug, Clone, PartialEq)]
pub struct VarianceModel {
    /// The components whose variance it is.
    pub of: NoiseOf,
    /// Functions with their coefficients.
    pub terms: Vec<(VarianceTerm, f64)>,
}

/// A function in the variance model, less its mean over the rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VarianceTerm {
    /// Cosine of a multiple of a joint.
    Cos(SymbolId, u8),
    /// Sine of a multiple of a joint.
    Sin(SymbolId, u8),
    /// The logarithm of an input of length: a measured range.
    LogRange(SymbolId),
}

/// ARMA(1,1): x_t = autoregressive · x_{t−1} + e_t + moving_average · e_{t−1}.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Serial {
    /// Coefficient of the value before.
    pub autoregressive: f64,
    /// Coefficient of the innovation before.
    pub moving_average: f64,
}

impl Serial {
    /// Standard deviation of the values in units of that of the innovations.
    ///
    /// Source: G. E. P. Box, G. M. Jenkins, Time Series Analysis, section 3.4.3.
    #[must_use]
    pub fn gain(self) -> f64 {
        let (phi, theta) = (self.autoregressive, self.moving_average);
        ((1.0 + 2.0 * phi * theta + theta * theta) / (1.0 - phi * phi)).sqrt()
    }

    /// Turns values into innovations in place; the first value of the run, which nothing precedes, is scaled to the
    /// same variance.
    pub fn whiten(self, column: &mut [f64], run: Run) {
        let gain = self.gain();
        for component in 0..run.stride {
            let (mut x_before, mut e_before) = (0.0, 0.0);
            for at in (run.start + component..run.end).step_by(run.stride) {
                let Some(value) = column.get_mut(at) else { return };
                let x = *value;
                if at == run.start + component {
                    // Nothing precedes the first value: it is scaled, and tells this much of its innovation.
                    *value = x / gain;
                    e_before = x / (gain * gain);
                } else {
                    e_before = x - self.autoregressive * x_before - self.moving_average * e_before;
                    *value = e_before;
                }
                x_before = x;
            }
        }
    }
}

impl Serial {
    /// Multiplies a piece of a run, `stride` components a row, by the transpose of what turns innovations into values of variance one, in
    /// place. A run is taken piece by piece, its last first: `after` is what the piece behind left, and becomes what this one leaves;
    /// `begins` says that it is the first of the run.
    pub(super) fn colour(self, piece: &mut [f64], stride: usize, after: &mut Carried, begins: bool) {
        let gain = self.gain();
        for (component, [sum, carried]) in after.iter_mut().enumerate().take(stride) {
            // Backwards through x_t = φ x_{t−1} + e_t + θ e_{t−1}: what each innovation has part in.
            for at in (component..piece.len()).step_by(stride).rev() {
                let value = &mut piece[at];
                *sum = *value + self.autoregressive * *sum;
                let remembered = self.moving_average * *carried;
                let first = begins && at == component;
                *value = if first { *sum + remembered / (gain * gain) } else { (*sum + remembered) / gain };
                *carried = *sum;
            }
        }
    }
}

/// What the rows behind a piece of a run leave to it, for each of at most three components a row.
pub(super) type Carried = [[f64; 2]; 3];

impl Noise {
    /// Whether [whitening](Self::whiten) makes of a component more than a multiple of itself.
    #[must_use]
    pub fn mixes_rows(&self) -> bool {
        self.serial.is_some() || self.offsets.as_ref().is_some_and(|offsets| offsets.crossed)
    }

    /// Whether rows were found to remember those before, or may.
    #[must_use]
    pub fn remembers(&self) -> bool {
        self.serial.is_some() || self.undeclared_order
    }

    /// The same noise as if no observation remembered the one before.
    #[must_use]
    pub fn without_memory(&self) -> Self {
        Self {
            floor: self.floor.clone(),
            of_readings: self.of_readings,
            variance: self.variance.clone(),
            serial: None,
            in_space: None,
            undeclared_order: self.undeclared_order,
            offsets: None,
            sigma: self.sigma_without_memory().into_owned(),
            runs: self.runs.clone(),
        }
    }

    /// The same noise, so many times as large.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let larger = |values: &[f64]| values.iter().map(|value| factor * value).collect();
        Self { floor: larger(&self.floor), sigma: larger(&self.sigma), ..self.clone() }
    }

    /// The noise of some runs of components, put one after another: the first component of each remembers none.
    #[must_use]
    pub fn of_runs(&self, runs: &[Run]) -> Self {
        let sigma = runs.iter().flat_map(|run| &self.sigma[run.start..run.end]);
        let mut start = 0;
        let own = runs.iter().map(|&run| {
            let own = Run { start, end: start + (run.end - run.start), stride: run.stride };
            start = own.end;
            own
        });
        let own: Vec<Run> = own.collect();
        let parts = runs.iter().map(|run| run.start..run.end);
        Self {
            floor: self.floor.clone(),
            of_readings: self.of_readings,
            variance: self.variance.clone(),
            serial: self.serial,
            in_space: self.in_space.as_ref().and_then(|filter| filter.of_runs(runs, &own)),
            undeclared_order: self.undeclared_order,
            offsets: self.offsets.as_ref().map(|offsets| offsets.of_parts(parts)),
            sigma: sigma.copied().collect(),
            runs: own,
        }
    }

    /// For each component of the first series the median of its standard deviations: what one more observation is to be
    /// expected to have, rad or m.
    #[must_use]
    pub fn expected(&self, observations: &Observations) -> Vec<f64> {
        let Some(first) = observations.poses.series.first() else { return vec![1.0] };
        let (components, sigma) = (first.measure.components(), self.sigma_without_memory());
        let own = &sigma[..first.rows.len() * components];
        (0..components)
            .map(|component| median(own.iter().skip(component).step_by(components).copied().collect()))
            .map(|sigma| sigma.max(f64::MIN_POSITIVE))
            .collect()
    }

    /// Per residual component its standard deviation, whatever the component before or the others of its group say of it.
    #[must_use]
    pub fn sigma_without_memory(&self) -> Cow<'_, [f64]> {
        match (self.serial, &self.offsets) {
            (None, None) => Cow::Borrowed(&self.sigma),
            (Some(serial), _) => self.sigma.iter().map(|sigma| sigma * serial.gain()).collect(),
            (None, Some(offsets)) => {
                let gains = (0..self.sigma.len()).map(|at| offsets.gain(at));
                self.sigma.iter().zip(gains).map(|(sigma, gain)| sigma * gain).collect()
            }
        }
    }

    /// Whitens a column of residual components (length n, SI) in place: divides by the standard deviations and
    /// takes out what the observation before it explains. Robust weights are not part of it.
    pub fn whiten(&self, column: &mut [f64]) {
        for (value, sigma) in column.iter_mut().zip(&self.sigma) {
            *value /= sigma;
        }
        if let Some(offsets) = self.offsets.as_ref().filter(|offsets| offsets.crossed) {
            offsets.whiten(column);
        }
        if let Some(filter) = &self.in_space {
            self.runs.iter().for_each(|&run| filter.whiten(column, run));
        } else if let Some(serial) = self.serial {
            self.runs.iter().for_each(|&run| serial.whiten(column, run));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Colouring multiplies by a root of the correlation matrix, so the coloured columns of a basis have the
    /// correlations of the process as their products, once its start is forgotten.
    #[test]
    fn colouring_gives_the_correlations_of_the_process() {
        let serial = Serial { autoregressive: 0.8, moving_average: -0.3 };
        let run = Run { start: 0, end: 200, stride: 2 };
        let unit = |at: usize| {
            let mut column = vec![0.0; 200];
            column[at] = 1.0;
            let mut after = Carried::default();
            // In two pieces, the last first.
            let (first, last) = column.split_at_mut(90);
            serial.colour(last, run.stride, &mut after, false);
            serial.colour(first, run.stride, &mut after, true);
            column
        };
        let product = |a: usize, b: usize| unit(a).iter().zip(unit(b)).map(|(x, y)| x * y).sum::<f64>();
        // Source: Box and Jenkins, Time Series Analysis, equation (3.4.7).
        let first = (1.0 + 0.8 * -0.3) * (0.8 - 0.3) / (1.0 + 2.0 * 0.8 * -0.3 + 0.09);
        assert_relative_eq!(product(0, 0), 1.0, epsilon = 1e-12);
        assert_relative_eq!(product(180, 180), 1.0, epsilon = 1e-12);
        assert_relative_eq!(product(180, 182), first, epsilon = 1e-12);
        assert_relative_eq!(product(180, 186), first * 0.8 * 0.8, epsilon = 1e-12);
        assert_relative_eq!(product(180, 183), 0.0, epsilon = 1e-12);
    }

    #[test]
    fn whitening_undoes_colour() {
        let serial = Serial { autoregressive: 0.9, moving_average: 0.4 };
        let run = Run { start: 0, end: 5, stride: 1 };
        let innovations = [1.0, -0.5, 0.25, 2.0, -1.0];
        let mut values = vec![serial.gain() * innovations[0]];
        for at in 1..5 {
            let before = if at == 1 { innovations[0] / serial.gain() } else { innovations[at - 1] };
            values.push(0.9 * values[at - 1] + innovations[at] + 0.4 * before);
        }
        serial.whiten(&mut values, run);
        for (value, innovation) in values.iter().zip(innovations) {
            assert_relative_eq!(*value, innovation, epsilon = 1e-12);
        }
    }
}
