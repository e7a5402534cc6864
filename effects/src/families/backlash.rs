//! Backlash: a joint that lags behind by a fixed amount, whichever way it came.

use model_core::algebra::Poly;

use crate::candidate::Kind;
use crate::candidate::{Effect, Family, Function, Setting};

pub(super) const FAMILY: Family = Family {
    name: "backlash",
    what: "A joint is off by a fixed amount that changes sign with the direction of motion.",
    causes: "Play between the teeth of a gear, a loose coupling, friction that winds up a shaft between encoder and load.",
    looks: "Two branches, one for each direction of motion.",
    check: "Approach one pose from both sides.",
    effects,
};

/// By inputs that are the direction of motion of a joint.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let all = setting.joints().into_iter().filter_map(|joint| {
        let input = Kind::Direction(joint.symbol).input(setting)?;
        let name = setting.name(joint.symbol);
        Some(Effect {
            bends: None,
            family: FAMILY.name,
            name: format!("backlash of {name}"),
            place: joint.place(),
            functions: vec![Function::new(Poly::symbol(input), format!("backlash_{name}"))],
            driver: setting.name(input).to_owned(),
            form: "sign".into(),
        })
    });
    all.collect()
}
