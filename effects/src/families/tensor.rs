//! Tensor fall-backs: smooth functions of two joints together at one place, for what no function of one joint explains.

use model_core::algebra::{AngleSum, Poly};

use crate::candidate::{Effect, Freedom, Function, JointAxis, Setting};

/// The order of the series in each joint.
const ORDER: u32 = 2;

/// Every tensor candidate of a chain: each pair of joints drives each rotation of the upper one's body.
#[must_use]
pub fn tensor(setting: &Setting<'_>) -> Vec<Effect> {
    let joints = setting.turning();
    let mut effects = Vec::new();
    for (at, lower) in joints.iter().enumerate() {
        for upper in &joints[at + 1..] {
            let (a, b) = (setting.name(lower.symbol), setting.name(upper.symbol));
            let functions = functions(setting, lower, upper);
            for freedom in Freedom::rotations().filter(|&freedom| setting.moves(upper.place().with(freedom)))
            {
                effects.push(Effect {
                    bends: None,
                    family: "smooth",
                    name: format!("a smooth function of {a} and {b} about {}", freedom.axis_name()),
                    place: upper.place().with(freedom),
                    functions: functions.clone(),
                    driver: format!("{a}, {b}"),
                    form: format!("Fourier series of order {ORDER} by {ORDER}").into(),
                });
            }
        }
    }
    effects
}

/// Products of the harmonics of two joints, without those of one alone.
fn functions(setting: &Setting<'_>, lower: &JointAxis, upper: &JointAxis) -> Vec<Function> {
    let waves = |joint: &JointAxis| {
        let name = setting.name(joint.symbol).to_owned();
        (1..=ORDER)
            .filter_map(|order| Some((order, AngleSum::symbol(joint.symbol).times(order).ok()?)))
            .flat_map(|(order, angle)| {
                [
                    (format!("cos{order}_{name}"), Poly::cos(&angle)),
                    (format!("sin{order}_{name}"), Poly::sin(&angle)),
                ]
            })
            .collect::<Vec<_>>()
    };
    let upper = waves(upper);
    let products = waves(lower).into_iter().flat_map(|(a, f)| {
        upper.iter().map(move |(b, g)| Function::new(&f * g, format!("tensor_{a}_{b}"))).collect::<Vec<_>>()
    });
    products.collect()
}
