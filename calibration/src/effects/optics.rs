//! Optics and range: refraction and offsets that grow towards a pole, and errors of a measured range.

use model_core::algebra::{AngleSum, Poly};
use model_core::{Axis, Motion, Role, SymbolKind};

use super::{Alias, Effect, Family, Freedom, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "optics and range",
    what: "Light is bent on its way (refraction), or the measured range has an offset, a scale or a cyclic error.",
    causes: "Residual refraction after a model of the air; a prism constant, an oscillator off its frequency, \
             crosstalk in the phase meter.",
    looks: "Tangent or cotangent of a joint, growing without bound towards the horizon or a pole; a residual \
            along the line of sight.",
    check: "Compare pressure and temperature given to the refraction model; measure a known baseline.",
    aliases: &[
        Alias { name: "TPOINT TX", meaning: "tangent of zenith distance: refraction" },
        Alias {
            name: "scanner additional parameter A0, range zero",
            meaning: "offset along the line of sight",
        },
        Alias { name: "laser tracker x2, x10", meaning: "range offset and scale" },
    ],
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    let aims = setting.aims();
    for joint in setting.joints().into_iter().filter(|joint| aims && joint.turns()) {
        let name = setting.name(joint.symbol);
        let angle = AngleSum::symbol(joint.symbol);
        let (cosine, sine) = (Poly::cos(&angle), Poly::sin(&angle));
        for (word, above, below) in [("tan", &sine, &cosine), ("cot", &cosine, &sine)] {
            let Some(reciprocal) = below.recip() else { continue };
            effects.push(Effect {
                family: FAMILY.name,
                name: format!("refraction, {word} of {name}"),
                place: Place { body: joint.body, role: Role::MotionError, freedom: joint.freedom },
                functions: vec![Function {
                    amount: above * &reciprocal,
                    stem: format!("refraction_{word}_{name}"),
                }],
                driver: name.to_owned(),
                form: word.to_owned(),
            });
        }
    }
    effects.extend(range(setting));
    effects
}

/// Offset and scale of a measured range: shifts of the observing body along its line of sight.
fn range(setting: &Setting<'_>) -> Vec<Effect> {
    let chain = setting.chain;
    let mut effects = Vec::new();
    for &id in setting.observables {
        let observable = chain.observable(id);
        for (i, component) in observable.components.iter().enumerate() {
            let inputs =
                component.symbols().into_iter().filter(|&s| chain.symbol(s).kind == SymbolKind::Input);
            for input in inputs {
                let axis = [Axis::X, Axis::Y, Axis::Z][i];
                let name = setting.name(input);
                let along = Freedom { motion: Motion::Translation, axis };
                for (what, amount) in [("zero", Poly::one()), ("scale", Poly::symbol(input))] {
                    effects.push(Effect {
                        family: FAMILY.name,
                        name: format!("{name} {what}"),
                        place: Place { body: observable.body, role: Role::MotionError, freedom: along },
                        functions: vec![Function { amount, stem: format!("{name}_{what}") }],
                        driver: name.to_owned(),
                        form: if what == "zero" { "constant" } else { "linear" }.to_owned(),
                    });
                }
            }
        }
    }
    effects
}
