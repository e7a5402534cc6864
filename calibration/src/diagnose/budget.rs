//! The uncertainty budget of each error, as the GUM writes it: what each input has part in.

use model_core::Chain;
use serde::Serialize;

use super::ErrorFound;
use fit::{FitResult, Input};
use observe::SiUnit;

/// The confidence of the expanded uncertainty: that of two standard deviations of the normal distribution.
const CONFIDENCE: f64 = 0.954_5;

/// The budget of one error.
///
/// Source: JCGM 100:2008 (GUM), annex G.4 for the effective degrees of freedom.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Budget {
    /// The error.
    pub error: String,
    /// Its SI unit.
    pub unit: SiUnit,
    /// What has part in it, the noise first.
    pub parts: Vec<BudgetPart>,
    /// All together, SI.
    pub standard_uncertainty: f64,
    /// Absent where they are infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub effective_degrees_of_freedom: Option<f64>,
    /// The coverage factor for 95.45 %, by those.
    pub coverage: f64,
    /// The standard uncertainty times that, SI.
    pub expanded_uncertainty: f64,
}

/// What an input has part in.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BudgetPart {
    /// Which.
    pub input: &'static str,
    /// `A`, from the scatter of these rows, or `B`, stated.
    pub kind: &'static str,
    /// Its standard uncertainty, where it is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated: Option<f64>,
    /// The unit of that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated_unit: Option<SiUnit>,
    /// What it adds over what is stated; of several axes or targets the root of the sum of squares.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensitivity: Option<f64>,
    /// What it adds to the error, SI.
    pub contribution: f64,
    /// Absent where they are infinite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub degrees_of_freedom: Option<f64>,
}

/// The budget of each error that these data determine; none where nothing is stated of the reference.
pub(super) fn budgets(chain: &Chain, fit: &FitResult, errors: &[ErrorFound]) -> Vec<Budget> {
    if fit.from_reference.is_empty() {
        return Vec::new();
    }
    let of = |(at, id): (usize, &model_core::SymbolId)| {
        let name = &chain.symbol(*id).name;
        let error = errors.iter().find(|error| error.name == *name)?;
        let standard = error.standard_uncertainty?;
        let expanded = fit.half_width(*id, CONFIDENCE)?;
        let stated: f64 = fit.from_reference.iter().map(|own| own.covariance[(at, at)]).sum();
        let noise = (standard * standard - stated).max(0.0);
        let effective = fit.parameter_degrees_of_freedom[at];
        // Only the noise has degrees of freedom that end.
        let own = effective * (noise / (standard * standard)).powi(2);
        let finite = |freedom: f64| Some(freedom).filter(|freedom| freedom.is_finite());
        let mut parts = vec![BudgetPart {
            input: "noise of the rows",
            kind: "A",
            stated: None,
            stated_unit: None,
            sensitivity: None,
            contribution: noise.sqrt(),
            degrees_of_freedom: finite(own),
        }];
        parts.extend(fit.from_reference.iter().map(|own| {
            let (input, unit) = match own.input {
                Input::Scale => ("scale of the reference", SiUnit::ONE),
                Input::Targets => ("coordinates of targets", SiUnit::METRE),
                Input::Rotation => ("rotation of the reference frame", SiUnit::RAD),
                Input::Shift => ("origin of the reference frame", SiUnit::METRE),
            };
            let contribution = own.covariance[(at, at)].max(0.0).sqrt();
            BudgetPart {
                input,
                kind: "B",
                stated: Some(own.sigma),
                stated_unit: Some(unit),
                sensitivity: Some(contribution / own.sigma),
                contribution,
                degrees_of_freedom: None,
            }
        }));
        Some(Budget {
            error: name.clone(),
            unit: error.unit,
            parts,
            standard_uncertainty: standard,
            effective_degrees_of_freedom: finite(effective),
            coverage: expanded / standard,
            expanded_uncertainty: expanded,
        })
    };
    fit.parameters.iter().enumerate().filter_map(of).collect()
}
