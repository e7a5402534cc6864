//! Declared and new errors with their estimates, and the combinations of them that these data determine.

use model_core::SymbolId;
use serde::Serialize;

use super::by_cause::ByCause;
use super::units::unit_of;
use crate::search::context::Context;
use crate::search::fitted::Fitted;
use observe::SiUnit;

/// An error (or freed constant) and its estimate.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorFound {
    /// The declared name.
    pub name: String,
    /// The estimate, SI.
    pub value: f64,
    /// Its standard uncertainty, SI; absent where these data do not determine it by itself.
    pub standard_uncertainty: Option<f64>,
    /// Degrees of freedom behind the uncertainty, for Student's t; absent with it, and where the noise is known.
    pub degrees_of_freedom: Option<f64>,
    /// How far it would move, at most down and up, if another cause that these data fit were the true one, SI; absent where that is
    /// within its uncertainty.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moves_by_cause: Option<[f64; 2]>,
    /// Its SI unit: `rad`, `m`, `1`, `rad/K`, …
    pub unit: SiUnit,
    /// RMS of what it moves the observations, in units of their noise.
    pub over_noise: f64,
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
    /// How far it would move, at most down and up, if another cause that these data fit were the true one, SI; absent where that is
    /// within its uncertainty.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub moves_by_cause: Option<[f64; 2]>,
    /// Its SI unit, that of the first error.
    pub unit: SiUnit,
    /// RMS of what it moves the observations, in units of their noise.
    pub over_noise: f64,
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

/// Every estimated error or constant: first those that the study wants, then in the order of the fit.
pub(super) fn errors(whole: &Context<'_>, fitted: &Fitted, by_cause: &ByCause) -> Vec<ErrorFound> {
    let fit = &fitted.fit;
    let wanted = &whole.request.plan.asked.wanted;
    let mut errors: Vec<(usize, ErrorFound)> = fit
        .parameters
        .iter()
        .zip(&fit.separable)
        .enumerate()
        .map(|(at, (&id, &separable))| {
            let standard_uncertainty = fit.standard_uncertainty(id).filter(|_| separable);
            let freedom = fit.parameter_degrees_of_freedom[at];
            let place = wanted.iter().position(|own| *own == id).unwrap_or(wanted.len());
            let found = ErrorFound {
                name: fitted.chain.symbol(id).name.clone(),
                value: fit.values[id.index()],
                over_noise: over_noise(fit, at, fit.values[id.index()]),
                degrees_of_freedom: standard_uncertainty.map(|_| freedom).filter(|known| known.is_finite()),
                standard_uncertainty,
                moves_by_cause: standard_uncertainty.and_then(|own| by_cause.range(&[(id, 1.0)], own)),
                unit: unit_of(&whole.setting, &fitted.chain, id),
                separable,
                shown: fit.shown[at],
            };
            (place, found)
        })
        .collect();
    errors.sort_by_key(|(place, _)| *place);
    errors.into_iter().map(|(_, found)| found).collect()
}

/// RMS over the rows that count of what a value of a parameter moves them, in units of their noise.
fn over_noise(fit: &fit::FitResult, at: usize, value: f64) -> f64 {
    let rows: f64 = fit.residuals.weight.iter().sum();
    let moved = value.abs() * fit.factor.length(at) / rows.max(1.0).sqrt();
    if moved.is_finite() { moved } else { 0.0 }
}

/// Every combination of several errors that these data determine, in the order of their first errors.
pub(super) fn estimable(whole: &Context<'_>, fitted: &Fitted, by_cause: &ByCause) -> Vec<Estimable> {
    let several = fitted.fit.estimable.iter().filter(|one| one.combination.len() > 1);
    let of = |one: &fit::Estimable| {
        let part = |&(id, factor): &(SymbolId, f64)| Part {
            error: fitted.chain.symbol(id).name.clone(),
            ratio: fraction(factor),
        };
        let (first, _) = one.combination.first()?;
        let at = fitted.fit.parameters.iter().position(|own| own == first)?;
        let standard_uncertainty = one.standard_uncertainty?;
        Some(Estimable {
            combination: one.combination.iter().map(part).collect(),
            value: one.value,
            standard_uncertainty,
            moves_by_cause: by_cause.range(&one.combination, standard_uncertainty),
            unit: unit_of(&whole.setting, &fitted.chain, *first),
            over_noise: over_noise(&fitted.fit, at, one.value),
            degrees_of_freedom: one.degrees_of_freedom,
        })
    };
    several.filter_map(of).collect()
}

/// A factor as a fraction with a small denominator, or else in decimals.
fn fraction(factor: f64) -> String {
    for denominator in [1_u8, 2, 3, 4, 6, 12] {
        let numerator = factor * f64::from(denominator);
        if numerator.round() != 0.0 && (numerator - numerator.round()).abs() < 1e-9 {
            let over = if denominator == 1 { String::new() } else { format!("/{denominator}") };
            return format!("{:.0}{over}", numerator.round());
        }
    }
    format!("{factor:.6}")
}

#[cfg(test)]
mod tests {
    use super::fraction;

    #[test]
    fn simple_factors_are_fractions() {
        let of = [1.0, -1.0, 0.5, -2.0 / 3.0, 7.0 / 12.0, 3.0, 0.083_2].map(fraction);
        assert_eq!(of, ["1", "-1", "1/2", "-2/3", "7/12", "3", "0.083200"]);
    }
}
