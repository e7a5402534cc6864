//! Parallax: a line of sight that misses the axes by a shift looks tilted by the shift over the range.

use model_core::algebra::Poly;
use model_core::{ObservableKind, Role};

use crate::candidate::Kind;
use crate::candidate::{Effect, Family, Freedom, Function, Place, Setting};

pub(super) const FAMILY: Family = Family {
    name: "parallax",
    what: "A direction is off in proportion to one over the range: the line of sight starts beside where the directions \
           are counted from.",
    causes: "The beam or the reticle sits beside the axes; axes that do not meet.",
    looks: "Residuals of directions that are large at short range and vanish at long range.",
    check: "Aim at one target from near and from far, in two faces.",
    effects,
};

/// By inputs that are one over a range, for observed directions; of points the shift itself is in the catalogue.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    let inputs: Vec<_> = setting
        .inputs
        .iter()
        .filter(|&&input| matches!(Kind::of(setting, input), Kind::Inverse(_)))
        .collect();
    for &id in setting.observables {
        let observable = setting.chain.observable(id);
        if observable.kind != ObservableKind::Direction || observable.is_orientation() {
            continue;
        }
        for &&input in &inputs {
            for freedom in Freedom::rotations() {
                let name = setting.body_name(observable.body);
                let stem = format!("parallax_{name}_{}", freedom.word().to_lowercase());
                effects.push(Effect {
                    bends: None,
                    family: FAMILY.name,
                    name: format!("parallax of {name} {}", freedom.words()),
                    place: Place { body: observable.body, role: Role::MotionError, freedom },
                    functions: vec![Function::new(Poly::symbol(input), stem)],
                    driver: setting.name(input).to_owned(),
                    form: "one over the range".into(),
                });
            }
        }
    }
    effects
}
