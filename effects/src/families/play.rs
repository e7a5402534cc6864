//! Play: a bearing that leans over with the direction of motion.

use model_core::algebra::Poly;

use crate::candidate::Kind;
use crate::candidate::{Effect, Family, Freedom, Function, Setting};

pub(super) const FAMILY: Family = Family {
    name: "play",
    what: "What a joint carries tilts or shifts at right angles to the joint's axis by a fixed amount that changes sign with the \
           direction of motion.",
    causes: "Clearance of a bearing or of a slide: the drive pushes what it moves against one flank, then the other.",
    looks: "Two branches, one for each direction of motion, at right angles to the joint's own.",
    check: "Approach one pose from both sides and push by hand: a preload takes it away.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.joints() {
        let Some(input) = Kind::Direction(joint.symbol).input(setting) else { continue };
        let name = setting.name(joint.symbol);
        for freedom in Freedom::ALL.into_iter().filter(|&freedom| freedom != joint.freedom) {
            let stem = format!("play_{}_{name}", freedom.word().to_lowercase());
            effects.push(Effect {
                bends: None,
                family: FAMILY.name,
                name: format!("play of {name} {}", freedom.words()),
                place: joint.place().with(freedom),
                functions: vec![Function::new(Poly::symbol(input), stem)],
                driver: setting.name(input).to_owned(),
                form: "sign".into(),
            });
        }
    }
    effects
}
