//! `[reference]`: how uncertain that is which rows are compared with.

use model_core::Quantity;
use toml::Spanned;

use super::amount::si_with_unit;
use super::mistakes::{Outcome, every, mistake};
use super::plan::SourcePlan;
use super::written::Study;
use fit::Reference;
use observe::SiUnit;
use tables::units::Amount;

impl Study {
    /// What the study states of the reference; nothing where it states nothing.
    pub(super) fn reference(&self, sources: &[SourcePlan]) -> Outcome<Option<Reference>> {
        let Some(written) = &self.reference else { return Ok(None) };
        let table = written.get_ref();
        if sources.iter().any(|source| source.measure.observes_object()) {
            return Err(mistake(
                written.span(),
                "rows observe objects or stations, and their uncertainties are stated with them",
                "write `sigma` under [objects] and [stations]",
            ));
        }
        let lengths = |source: &SourcePlan| source.measure.unit() == SiUnit::METRE;
        let points =
            |source: &SourcePlan| source.measure.unit() == SiUnit::METRE && source.measure.components() == 3;
        let turns =
            |source: &SourcePlan| source.measure.unit() == SiUnit::RAD || source.measure.components() == 3;
        type Has = fn(&SourcePlan) -> bool;
        let stated: [(&str, &Option<Spanned<Amount>>, Quantity, Has, &str); 4] = [
            (
                "scale",
                &table.scale,
                Quantity::Number,
                lengths,
                "no point or range is observed that has a scale",
            ),
            (
                "targets",
                &table.targets,
                Quantity::Length,
                points,
                "no point is observed that could be a target's",
            ),
            ("rotation", &table.frame.rotation, Quantity::Angle, turns, "ranges alone know of no rotation"),
            (
                "shift",
                &table.frame.shift,
                Quantity::Length,
                points,
                "no point is observed that a shift would move",
            ),
        ];
        let values = every(stated.into_iter().map(|(name, amount, quantity, has, without)| {
            let Some(amount) = amount else { return Ok(0.0) };
            let place = amount.span();
            if !sources.iter().any(has) {
                return Err(mistake(place, without, format!("leave `{name}` out")));
            }
            let value = match quantity {
                Quantity::Number => super::amount::si(amount.get_ref(), quantity, &place)?,
                _ => si_with_unit(name, amount.get_ref(), quantity, &place)?,
            };
            match value > 0.0 && value.is_finite() {
                true => Ok(value),
                false => Err(mistake(
                    place,
                    "a standard uncertainty is positive",
                    format!("leave `{name}` out of what is exact"),
                )),
            }
        }))?;
        let &[scale, targets_m, rotation_rad, shift_m] = values.as_slice() else {
            unreachable!("four were read")
        };
        Ok(Some(Reference { scale, targets_m, rotation_rad, shift_m }))
    }
}
