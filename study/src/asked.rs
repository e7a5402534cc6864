//! What a study asks of the answer: how good the instrument is to be (`[goal]`), and which errors stand first (`[report]`).

use model_core::{Chain, Quantity, SymbolId};
use toml::Spanned;

use super::amount::{si, si_with_unit};
use super::estimated::matching;
use super::mistakes::{Gathered, Outcome, Several, mistake};
use super::written::Study;
use fit::FitOptions;
use observe::SiUnit;

/// What is asked of the answer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Asked {
    /// The largest RMS on held-out rows that is good enough, SI, in the unit of the residuals of the first source.
    pub rms: Option<f64>,
    /// The estimated errors that stand first, in their order.
    pub wanted: Vec<SymbolId>,
}

impl Study {
    /// What this one asks; a goal has the unit of the first residuals.
    pub(super) fn asked(
        &self,
        chain: &Chain,
        unit: Option<SiUnit>,
        fit: Option<&FitOptions>,
    ) -> Outcome<Asked> {
        // What is missing has been told.
        let (Some(unit), Some(FitOptions { estimate, .. })) = (unit, fit) else {
            return Ok(Asked::default());
        };
        let mut mistakes = Gathered::default();
        let rms = mistakes.take(self.goal_rms(unit));
        let mut wanted = Vec::new();
        for name in &self.report.wanted {
            let own = mistakes.take(named(chain, name, estimate)).into_iter().flatten();
            own.for_each(|id| {
                if !wanted.contains(&id) {
                    wanted.push(id);
                }
            });
        }
        mistakes.none()?;
        Ok(Asked { rms: rms.flatten(), wanted })
    }

    fn goal_rms(&self, unit: SiUnit) -> Outcome<Option<f64>> {
        let Some(rms) = &self.goal.rms else { return Ok(None) };
        let place = rms.span();
        let with_unit = |quantity| si_with_unit("rms", rms.get_ref(), quantity, &place);
        let (goal, example) = match unit {
            SiUnit::RAD => (with_unit(Quantity::Angle)?, "\"5 arcsec\""),
            SiUnit::METRE => (with_unit(Quantity::Length)?, "\"0.5 mm\""),
            // Pixels are plain numbers.
            _ => (si(rms.get_ref(), Quantity::Number, &place)?, "0.5"),
        };
        if goal > 0.0 && goal.is_finite() {
            return Ok(Some(goal));
        }
        Err(mistake(place, "a goal is larger than zero", format!("write rms = {example}")))
    }
}

/// The estimated errors that a name or a pattern means.
fn named(chain: &Chain, name: &Spanned<String>, estimate: &[SymbolId]) -> Outcome<Vec<SymbolId>> {
    let written = name.get_ref();
    let all = matching(chain, name)?;
    let estimated: Vec<SymbolId> = all.into_iter().filter(|id| estimate.contains(id)).collect();
    if estimated.is_empty() {
        let told: Several = mistake(
            name.span(),
            format!("`{written}` is not estimated: the study holds it at a value"),
            "leave it out of `wanted`, or let `[fit]` estimate it",
        );
        return Err(told);
    }
    Ok(estimated)
}
