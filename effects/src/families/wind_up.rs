//! Wind-up: a joint gives way under the torque of gravity about its own axis.

use super::gravity::changing;
use crate::candidate::{Effect, Family, Function, Setting};

pub(super) const FAMILY: Family = Family {
    name: "wind-up",
    what: "A joint winds up in proportion to the torque of gravity about its axis, behind the encoder's back.",
    causes: "What the joint carries is out of balance; shaft, coupling, gear or brake between encoder and load twist.",
    looks: "One period a turn about the joint's own axis, fixed in phase to the plumb line, zero where the centre of mass \
            is above or below the axis.",
    check: "Balance the joint, or attach a known mass to a known arm. Wind-up follows the torque, the eccentricity of an encoder does not.",
    effects,
};

/// The torque about an axis is a combination of the components of gravity across it: where the centre of mass sits is
/// what the two errors tell.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.turning() {
        let name = setting.name(joint.symbol);
        let own = joint.freedom.axis.index();
        let functions: Vec<Function> = changing(setting, joint.place())
            .into_iter()
            .filter(|&(i, _)| i != own)
            .map(|(i, g)| Function::new(g, format!("torque_{}_{name}", ["x", "y", "z"][i])))
            .collect();
        if !functions.is_empty() {
            effects.push(Effect {
                bends: None,
                family: FAMILY.name,
                name: format!("wind-up of {name} under gravity"),
                place: joint.place(),
                functions,
                driver: "gravity".to_owned(),
                form: "torque of gravity".into(),
            });
        }
    }
    effects
}
