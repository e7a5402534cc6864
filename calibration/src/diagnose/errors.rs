//! Declared and new errors with their estimates, and the combinations of them that these data determine.

use serde::Serialize;

use super::units::unit_of;
use crate::calibrate::Loop;
use crate::calibrate::fitted::Fitted;
use crate::data::SiUnit;

/// An error (or freed constant) and its estimate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorFound {
    /// The declared name.
    pub name: String,
    /// The estimate, SI.
    pub value: f64,
    /// Its standard uncertainty, SI; absent where these data do not determine it by itself.
    pub standard_uncertainty: Option<f64>,
    /// Its SI unit: `rad`, `m`, `1`, `rad/K`, …
    pub unit: SiUnit,
    /// Whether these data determine it by itself.
    pub separable: bool,
    /// Whether these data show it at all, by itself or in a combination.
    pub shown: bool,
}

/// A combination of errors that these data determine, though not each of its errors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimable {
    /// The errors in it, each with its factor.
    pub combination: Vec<Part>,
    /// The estimate of the combination, SI.
    pub value: f64,
    /// Its standard uncertainty, SI.
    pub standard_uncertainty: f64,
    /// Its SI unit, that of the first error.
    pub unit: SiUnit,
    /// Degrees of freedom behind the uncertainty.
    pub degrees_of_freedom: f64,
}

/// An error in a combination.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Part {
    /// The error.
    pub error: String,
    /// Its factor, as a fraction where it is a simple one: `1`, `-1/2`, `0.0832`.
    pub ratio: String,
}

/// Every estimated error or constant, in the order of the fit.
pub(super) fn errors(whole: &Loop<'_>, fitted: &Fitted) -> Vec<ErrorFound> {
    let fit = &fitted.fit;
    let unseen: Vec<usize> = fit
        .subspace
        .linked()
        .into_iter()
        .filter_map(|(members, _)| match members[..] {
            [alone] => Some(alone),
            _ => None,
        })
        .collect();
    fit.parameters
        .iter()
        .zip(&fit.separable)
        .enumerate()
        .map(|(at, (&id, &separable))| ErrorFound {
            name: fitted.chain.symbol(id).name.clone(),
            value: fit.values[id.index()],
            standard_uncertainty: fit.standard_uncertainty(id).filter(|sigma| separable && sigma.is_finite()),
            unit: unit_of(&whole.setting, &fitted.chain, id),
            separable,
            shown: separable || !unseen.contains(&at),
        })
        .collect()
}
