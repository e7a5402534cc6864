//! A calibration anew with the simplest model of the ladder, where it predicts held-out rows clearly better than all declared errors: the
//! errors that this model does without stand at their nominal values, as if the study fixed them there.

use model_core::SymbolId;

use super::Calibration;
use crate::diagnose::{Caution, Diagnosis, Ladder, Rung, RungName};
use study::Plan;

/// The study of that model; none where the declared errors stay. What the study lists as its model or wants to see is estimated, whatever
/// held-out rows say; and an instrument as delivered has nothing to estimate.
pub(super) fn plan(plan: &Plan, diagnosis: &Diagnosis) -> Option<Plan> {
    let ladder = diagnosis.ladder.as_ref()?;
    let [simplest, _] = ladder.simpler()?;
    if plan.frozen.is_some() || simplest.name == RungName::AsDelivered {
        return None;
    }
    let spared = ladder.above(simplest.name).into_iter().map(|name| plan.chain.find_symbol(name));
    let spared: Vec<SymbolId> = spared.collect::<Option<_>>()?;
    let is_wanted = plan.asked.wanted.iter().any(|id| spared.contains(id));
    (!is_wanted).then(|| plan.holding(&spared))
}

/// What both come to: the simpler one with the ladder of all declared errors, or these where the simpler one came to nothing.
pub(super) fn told(declared: Calibration, mut simpler: Calibration) -> Calibration {
    let own = &mut simpler.diagnosis;
    let (Some(all), Some(few), true) =
        (&declared.diagnosis.ladder, own.ladder.take(), own.verdict.is_usable())
    else {
        return declared;
    };
    let is_simpler = |caution: &Caution| matches!(caution, Caution::SimplerPredictsBetter { .. });
    own.cautions.retain(|caution| !is_simpler(caution));
    let caution = declared.diagnosis.cautions.iter().find(|caution| is_simpler(caution)).cloned();
    own.cautions.splice(0..0, caution.map(Caution::of_what_is_written));
    own.ladder = Some(joined(all, few));
    simpler
}

/// The ladder of all declared errors, with the model that is written and its effects as their own calibration has them.
fn joined(all: &Ladder, few: Ladder) -> Ladder {
    let written = all.simplest;
    let (of_effects, of_errors): (Vec<Rung>, Vec<Rung>) =
        few.rungs.into_iter().partition(|rung| rung.name == RungName::Effects);
    let own = of_errors.into_iter().find(|rung| rung.name == RungName::Geometry);
    let mut rungs = all.rungs.clone();
    rungs.retain(|rung| rung.name != RungName::Effects);
    if let (Some(own), Some(place)) = (own, rungs.iter_mut().find(|rung| rung.name == written)) {
        *place = Rung { name: written, adds: place.adds.clone(), ..own };
    }
    rungs.extend(of_effects);
    let is_of_effects = |name: RungName| name == RungName::Effects;
    let left_out = all.left_out.iter().filter(|own| !is_of_effects(own.name));
    let left_out =
        left_out.chain(few.left_out.iter().filter(|own| is_of_effects(own.name))).copied().collect();
    let simplest = if is_of_effects(few.simplest) { RungName::Effects } else { written };
    Ladder { unit: all.unit, rungs, left_out, simplest, written }
}
