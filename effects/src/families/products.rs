//! Products: two joints that act together on a third degree of freedom.

use model_core::algebra::{AngleSum, Poly};

use crate::candidate::{Effect, Family, Function, JointAxis, Setting};

pub(super) const FAMILY: Family = Family {
    name: "products",
    what: "Two joints act together about the axis of one of them: neither alone shows it.",
    causes: "A load whose lever depends on one joint and whose direction depends on the other; gravity through two \
             joints.",
    looks: "Products of first harmonics of two joints.",
    check: "Turn one joint through at several settings of the other and compare the curves.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let joints = setting.turning();
    let mut effects = Vec::new();
    for (at, first) in joints.iter().enumerate() {
        for second in &joints[at + 1..] {
            effects.extend([first, second].map(|own| product(setting, first, second, own)));
        }
    }
    effects
}

/// Products of the first harmonics of two joints, about the axis of one of them.
fn product(setting: &Setting<'_>, first: &JointAxis, second: &JointAxis, own: &JointAxis) -> Effect {
    let (a, b) = (setting.name(first.symbol), setting.name(second.symbol));
    let name = setting.body_name(own.body);
    let waves = |joint: &JointAxis| {
        let angle = AngleSum::symbol(joint.symbol);
        [("cos", Poly::cos(&angle)), ("sin", Poly::sin(&angle))]
    };
    let mut functions = Vec::new();
    for (word_a, wave_a) in waves(first) {
        for (word_b, wave_b) in waves(second) {
            let stem = format!("pair_{name}_{word_a}_{a}_{word_b}_{b}");
            functions.push(Function::new(&wave_a * &wave_b, stem));
        }
    }
    Effect {
        bends: None,
        family: FAMILY.name,
        name: format!("{a} and {b} together in {name} {}", own.freedom.words()),
        place: own.place(),
        functions,
        driver: format!("{a}, {b}"),
        form: "product of first harmonics".into(),
    }
}
