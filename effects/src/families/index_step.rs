//! Index step: counts lost or gained each time a joint passes its index mark.

use model_core::algebra::Poly;

use crate::candidate::Kind;
use crate::candidate::{Effect, Family, Function, Setting};

pub(super) const FAMILY: Family = Family {
    name: "index step",
    what: "The reading jumps by a fixed amount each time the joint passes its index: the error grows with the number of \
           whole turns.",
    causes: "Counts lost at the index pulse, a graduation whose ends do not join, a multi-turn counter with a wrong number \
             of counts a turn.",
    looks: "Plateaus, one for each whole turn, with steps at the index.",
    check: "Turn once round and come back the other way to the same mark: the reading differs by the step.",
    effects,
};

/// Inputs named `beta_turns` count the turns of the joint `beta`.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let steps = setting.joints().into_iter().filter_map(|joint| {
        let input = Kind::Turns(joint.symbol).input(setting)?;
        let name = setting.name(joint.symbol);
        Some(Effect {
            bends: None,
            family: FAMILY.name,
            name: format!("index step of {name}"),
            place: joint.place(),
            functions: vec![Function::new(Poly::symbol(input), format!("step_{name}"))],
            driver: setting.name(input).to_owned(),
            form: "steps".into(),
        })
    });
    steps.collect()
}
