//! `[reference]`: how uncertain that is which rows are compared with.

use model_core::Quantity;
use toml::Spanned;

use super::amount::{si, si_with_unit};
use super::mistakes::{Outcome, every, mistake};
use super::plan::SourcePlan;
use super::written::Study;
use fit::Reference;
use observe::SiUnit;
use observe::kinds::{BaseShown, Kind};
use tables::units::Amount;

/// A standard uncertainty as large as this, as a share, in rad or in m, is no small error.
const LARGEST: f64 = 0.1;

/// A key of the table.
struct Key<'a> {
    name: &'static str,
    written: &'a Option<Spanned<Amount>>,
    quantity: Quantity,
    /// What it is said of.
    of: fn(&Kind) -> bool,
    without: &'static str,
}

fn is_point(kind: &Kind) -> bool {
    kind.base == BaseShown::Pose
}

fn is_length(kind: &Kind) -> bool {
    kind.unit == SiUnit::METRE
}

fn turns(kind: &Kind) -> bool {
    is_point(kind) || kind.unit == SiUnit::RAD
}

impl Study {
    /// The columns that name targets.
    pub(super) fn target_columns(&self) -> Vec<String> {
        let named = self.reference.iter().flat_map(|own| &own.get_ref().target);
        named.flat_map(|columns| columns.get_ref().0.clone()).collect()
    }

    /// What the study states of the reference; nothing where it states nothing.
    pub(super) fn reference(&self, sources: &[SourcePlan]) -> Outcome<Option<Reference>> {
        let Some(written) = &self.reference else { return Ok(None) };
        let table = written.get_ref();
        if sources.iter().any(|source| source.measure.observes_object()) {
            return Err(mistake(
                written.span(),
                "these rows observe unknown objects, and `[reference]` is for known ones",
                "write `sigma` under `[objects]` and `[stations]`, and leave out `[reference]`",
            ));
        }
        let key = |name, written, quantity, of: fn(&Kind) -> bool, without| Key {
            name,
            written,
            quantity,
            of,
            without,
        };
        let keys = [
            key("scale", &table.scale, Quantity::Number, is_length, "no point and no range is observed"),
            key("targets", &table.targets, Quantity::Length, is_point, "no point is observed"),
            key("rotation", &table.rotation, Quantity::Angle, turns, "nothing that rotates is observed"),
            key("shift", &table.shift, Quantity::Length, is_point, "no point is observed"),
        ];
        if let (Some(target), None) = (&table.target, &table.targets) {
            return Err(mistake(
                target.span(),
                "`target` names the column of the targets, and no uncertainty of them is stated",
                "write `targets = \"0.05 mm\"` too, or leave out `target`",
            ));
        }
        if keys.iter().all(|key| key.written.is_none()) {
            return Err(mistake(
                written.span(),
                "`[reference]` states no uncertainty",
                "write `scale`, `targets`, `rotation` or `shift`, or leave out `[reference]`",
            ));
        }
        let values = every(keys.into_iter().map(|key| key.value(sources)))?;
        let &[scale, targets_m, rotation_rad, shift_m] = values.as_slice() else {
            unreachable!("four were read")
        };
        Ok(Some(Reference { scale, targets_m, rotation_rad, shift_m }))
    }
}

impl Key<'_> {
    /// In SI, zero where nothing is stated.
    fn value(&self, sources: &[SourcePlan]) -> Outcome<f64> {
        let Some(amount) = self.written else { return Ok(0.0) };
        let (name, place) = (self.name, amount.span());
        if !sources.iter().any(|source| (self.of)(source.measure.kind())) {
            return Err(mistake(place, self.without, format!("leave out `{name}`")));
        }
        let value = match self.quantity {
            Quantity::Number => si(amount.get_ref(), self.quantity, &place)?,
            quantity => si_with_unit(name, amount.get_ref(), quantity, &place)?,
        };
        if value > 0.0 && value <= LARGEST {
            return Ok(value);
        }
        let (what, act) = match value > LARGEST {
            true => (
                "this standard uncertainty is no small error",
                "write what the certificate states, as one standard deviation",
            ),
            false => ("a standard uncertainty is positive", "leave out what is exact"),
        };
        Err(mistake(place, what, format!("{act} (`{name}`)")))
    }
}
