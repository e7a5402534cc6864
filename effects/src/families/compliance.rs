//! Compliance: a joint gives way under the weight of what hangs on it, by a lever that changes with the joints behind it.

use model_core::algebra::Poly;
use model_core::{BodyId, Chain, SymbolKind};

use crate::candidate::{Effect, Family, Function, JointAxis, Setting, seen};

pub(super) const FAMILY: Family = Family {
    name: "compliance",
    what: "A joint winds up in proportion to the torque that the weight of one body behind it exerts about its axis. The lever \
           follows from the chain: how far the body is from the joint, at right angles to the plumb line. A second arm that the joint \
           carries counts too, where the study reads its joints.",
    causes: "Gears, belts, shafts and torque sensors of an arm are elastic: what the motor's encoder reads is not where the \
             link is.",
    looks: "Sag that is largest with the arm stretched out level, and changes sign on the other side. One number for all poses, unlike \
            a sine of the joint.",
    check: "Attach a known mass to the hand. The effect of the last body grows in proportion.",
    effects,
};

/// Torques of more terms than this are no formula that a declaration should hold.
const MOST_TERMS: usize = 64;

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let upright = upright(setting.chain);
    let setting = &Setting { chain: &upright, ..*setting };
    let mut effects: Vec<Effect> = Vec::new();
    for joint in setting.turning() {
        for torque in torques(setting, &joint) {
            // Bodies whose origins coincide pull alike.
            if effects.iter().all(|other| {
                other.place != torque.place || other.functions[0].amount != torque.functions[0].amount
            }) {
                effects.push(torque);
            }
        }
    }
    effects
}

/// The chain without the constants that are declared to be zero: they stand for what only the data tell, such as where a base
/// stands and how far it is from upright.
fn upright(chain: &Chain) -> Chain {
    let nothing = |id| {
        let symbol = chain.symbol(id);
        symbol.kind == SymbolKind::Constant && symbol.value == Some(0.0)
    };
    let mut upright = chain.clone();
    for factor in upright.bodies.iter_mut().flat_map(|body| &mut body.factors) {
        factor.amount = factor.amount.graded_part(nothing, 0);
    }
    upright
}

/// The torque about a joint's axis by a unit weight at the origin of each body behind it: the component along the axis of the
/// cross product of the origin's position and gravity, per metre.
fn torques(setting: &Setting<'_>, joint: &JointAxis) -> Vec<Effect> {
    let place = joint.place();
    let name = setting.name(joint.symbol);
    let Some(gravity) = seen::from_ground(setting, &setting.chain.gravity, place) else { return Vec::new() };
    let (a, b) = seen::others(joint.freedom.axis);
    let (a, b) = (a.index(), b.index());
    // Whatever the joint carries, whether it is on the way to what is observed or beside it.
    let bodies = (0_u16..).take(setting.chain.bodies.len()).map(BodyId);
    let behind = bodies.filter(|&body| setting.chain.path(body).contains(&joint.body));
    behind
        .filter_map(|body| {
            let origin = seen::origin(setting, body, place)?;
            let torque: Poly = &(&origin[a] * &gravity[b]) - &(&origin[b] * &gravity[a]);
            if torque.as_constant().is_some() || torque.len() > MOST_TERMS {
                return None;
            }
            let of = setting.body_name(body);
            Some(Effect {
                bends: None,
                family: FAMILY.name,
                name: format!("compliance of {name} under the weight of {of}"),
                place,
                functions: vec![Function::new(torque, format!("compliance_{name}_{of}"))],
                driver: "gravity".to_owned(),
                form: "torque of a weight".into(),
            })
        })
        .collect()
}
