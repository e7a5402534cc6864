//! Errors of a measured range: zero, scale, and what repeats with the wavelength of the modulation.

use model_core::algebra::Poly;
use model_core::{ObservableKind, Role};

use crate::candidate::{Dependence, Kind};
use crate::candidate::{Effect, Family, Freedom, Function, Place, Setting, harmonic};

/// Harmonics of the phase of the modulation.
const HARMONICS: std::ops::RangeInclusive<u32> = 1..=2;

pub(super) const FAMILY: Family = Family {
    name: "range",
    what: "The measured range has a zero offset, a scale, or an error that repeats with the wavelength of the modulation.",
    causes: "A reflector's or an instrument's constant (zero), an oscillator off its frequency or a wrong index of the air \
             (scale), crosstalk in the phase meter (cyclic).",
    looks: "A residual along the line of sight: constant, in proportion to the range, or a sine of it.",
    check: "Measure a known baseline in all combinations, and short steps within one wavelength.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let points =
        setting.observables.iter().any(|&id| setting.chain.observable(id).kind == ObservableKind::Point);
    let mut effects = Vec::new();
    for (body, axis, input) in setting.ranges().into_iter().filter(|_| points) {
        let name = setting.name(input);
        let along = |what: String, functions, driver: &str, form: Dependence| Effect {
            bends: None,
            family: FAMILY.name,
            name: what,
            place: Place { body, role: Role::MotionError, freedom: Freedom::along(axis) },
            functions,
            driver: driver.to_owned(),
            form,
        };
        for (what, amount, form) in
            [("zero", Poly::one(), Dependence::Constant), ("scale", Poly::symbol(input), Dependence::Linear)]
        {
            let function = Function::new(amount, format!("{name}_{what}"));
            effects.push(along(format!("{name} {what}"), vec![function], name, form));
        }
        let phase = Kind::Phase(input).input(setting);
        for (phase, order) in phase.into_iter().flat_map(|phase| HARMONICS.map(move |order| (phase, order))) {
            let driver = setting.name(phase);
            let often =
                if order == 1 { "once a wavelength".to_owned() } else { format!("{order} per wavelength") };
            effects.push(along(
                format!("cyclic error of {name}, {often}"),
                harmonic(phase, driver, order, "cyclic"),
                driver,
                Dependence::Harmonic { order },
            ));
        }
    }
    effects
}
