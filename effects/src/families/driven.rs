//! Degrees of freedom in proportion to side quantities: what several families share.

use model_core::algebra::Poly;
use model_core::{Role, SymbolId};

use crate::candidate::{Dependence, Effect, Freedom, Function, Place, Setting};

/// Every degree of freedom of every body, and of the axis that it turns about, in proportion to an input. `stem` and
/// `name` start the names of the errors and of the effects.
pub(super) fn driven(
    setting: &Setting<'_>,
    family: &'static str,
    (stem, name): (&str, &str),
    inputs: &[SymbolId],
    form: &Dependence,
) -> Vec<Effect> {
    let mut effects = Vec::new();
    for body in setting.bodies() {
        let body_name = setting.body_name(body);
        for freedom in Freedom::ALL {
            for role in [Role::MotionError, Role::PositionError] {
                if role == Role::PositionError && !setting.is_moved(body) {
                    continue;
                }
                let (tag, frame) = if role == Role::MotionError { ("", "") } else { ("axis_", " axis") };
                let function = |&input: &SymbolId| {
                    let driver = if inputs.len() == 1 { stem } else { setting.name(input) };
                    let stem = format!("{driver}_{tag}{body_name}_{}", freedom.word().to_lowercase());
                    Function::new(Poly::symbol(input), stem)
                };
                effects.push(Effect {
                    bends: None,
                    family,
                    name: format!("{name} in {body_name}{frame} {}", freedom.words()),
                    place: Place { body, role, freedom },
                    functions: inputs.iter().map(function).collect(),
                    driver: inputs.iter().map(|&i| setting.name(i)).collect::<Vec<_>>().join(", "),
                    form: form.clone(),
                });
            }
        }
    }
    effects
}

/// [`driven`] by each input alone, under its own name.
pub(super) fn each(
    setting: &Setting<'_>,
    family: &'static str,
    inputs: &[SymbolId],
    form: &Dependence,
) -> Vec<Effect> {
    let by = |&input: &SymbolId| {
        let name = setting.name(input);
        driven(setting, family, (name, name), &[input], form)
    };
    inputs.iter().flat_map(by).collect()
}
