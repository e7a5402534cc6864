//! Uncertain readings: where they stand as far as the residuals say.
//!
//! A reading that is off moves its row's residual, and every function of the reading alike: noise looks like a function of the very
//! readings that it is in, as a line through noisy abscissas is too flat. So effects are judged at readings without what the residual
//! says of their noise, its conditional expectation: what is left of the noise there has no part in the residual.
//!
//! Source: W. A. Fuller, Measurement Error Models (1987), sections 1.2 and 2.2.

mod still;

use model_core::{Chain, SymbolId};
use nalgebra::{Matrix3, Vector3};

use self::still::still;
use fit::noise::Layout;
use fit::{FitError, FitResult, Model, correlated, pulls};
use observe::Observations;

/// Of each joint and input its readings.
pub(crate) type ByReading = Vec<(SymbolId, Vec<f64>)>;

/// Of a component's variance the share that is its own at least.
const LEAST: f64 = 1e-6;

/// The readings of all rows at a fit, those that are uncertain without what the residuals say of their noise; where none is stated to be,
/// those of joints that [stood still](still). `None` where all are as they were read.
pub(super) fn adjusted(
    chain: &Chain,
    observations: &Observations,
    layout: &Layout,
    fit: &FitResult,
) -> Result<Option<ByReading>, FitError> {
    if observations.reading_sigma.is_empty() {
        return still(chain, observations, layout, fit);
    }
    let model = Model::without_columns(chain, &observations.poses);
    let factor = fit.noise.of_readings;
    let pulls = pulls(&model, observations, &fit.values, factor)?;
    let correlated = correlated(observations, &pulls);
    let sigma = fit.noise.sigma_without_memory();
    let mut columns = observations.poses.columns.clone();
    for row in 0..observations.rows() {
        let own = layout.of_rows(row..row + 1);
        let vector = |values: &[f64]| Vector3::from_iterator(values.iter().copied().chain([0.0; 3]).take(3));
        let brought: Vec<Vector3<f64>> = pulls.iter().map(|pull| vector(&pull.pulled[own.clone()])).collect();
        // What a reading brings together with those that are off with it.
        let mut together = brought.clone();
        for &(one, other, correlation) in &correlated {
            together[one] += brought[other] * correlation[row];
            together[other] += brought[one] * correlation[row];
        }
        let of_readings: Matrix3<f64> =
            brought.iter().zip(&together).map(|(pull, together)| pull * together.transpose()).sum();
        let mut covariance = Matrix3::identity();
        for (at, component) in own.clone().enumerate() {
            // Beside what readings bring the row has noise of its own, as little as it may be.
            let variance = sigma[component] * sigma[component];
            covariance[(at, at)] = (variance - of_readings[(at, at)]).max(LEAST * variance);
        }
        covariance += of_readings;
        let Some(inverse) = covariance.try_inverse() else { continue };
        let said = inverse * vector(&fit.residuals.raw[own]) * fit.residuals.weight[row];
        for (pull, together) in pulls.iter().zip(&together) {
            columns[pull.column].1[row] -= factor * pull.sigma[row] * together.dot(&said);
        }
    }
    Ok(Some(columns))
}
