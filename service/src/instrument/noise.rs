//! How uncertain one observation of an instrument is.

use model_core::mistake::Mistake;
use study::Headings;

use super::file;
use crate::refusal::Refusal;
use crate::source::Source;

/// The noise of one source.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    /// Standard deviation of each residual component, rad or m: the root mean square over the rows of the calibration.
    pub sigma: Vec<f64>,
    /// Degrees of freedom that it was estimated with; none where it is known.
    pub degrees_of_freedom: Option<f64>,
}

/// Reads the noise of each source.
pub(super) fn of_sources(
    source: &Source,
    written: &[file::Noise],
    headings: Option<&Headings>,
) -> Result<Vec<Noise>, Refusal> {
    let sources = headings.map_or(&[][..], |headings| &headings.sources);
    let wrong = |place, message: String, help: &str| {
        Err(source.mistake(Mistake::new(place, message).with_help(help)))
    };
    for (at, own) in written.iter().enumerate() {
        let Some(plan) = sources.get(at) else {
            let message =
                format!("the study has {} sources, and this is the noise of another one", sources.len());
            return wrong(own.sigma.span(), message, "write a [[noise]] for each source of the study");
        };
        let (found, expected) = (own.sigma.get_ref().len(), plan.measure.components());
        if found != expected {
            let message = format!("{found} standard deviations for {expected} components");
            return wrong(own.sigma.span(), message, "write one for each component");
        }
        for sigma in own.sigma.get_ref() {
            if !sigma.get_ref().is_finite() || *sigma.get_ref() <= 0.0 {
                let message = "this is no standard deviation".to_owned();
                return wrong(sigma.span(), message, "write a number above zero, in rad or m");
            }
        }
        if let Some(freedom) = &own.degrees_of_freedom
            && (freedom.get_ref().is_nan() || *freedom.get_ref() < 1.0)
        {
            let message = "these are no degrees of freedom".to_owned();
            return wrong(freedom.span(), message, "write a number from 1, or leave the line out");
        }
    }
    let noise = written.iter().map(|own| Noise {
        sigma: own.sigma.get_ref().iter().map(|sigma| *sigma.get_ref()).collect(),
        degrees_of_freedom: own
            .degrees_of_freedom
            .as_ref()
            .map(|own| *own.get_ref())
            .filter(|own| own.is_finite()),
    });
    Ok(noise.collect())
}
