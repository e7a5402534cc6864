//! Latency: encoders read earlier or later than the observation.

use model_core::TransformKind;
use model_core::algebra::Poly;

use crate::candidate::{Dependence, Kind};
use crate::candidate::{Effect, Family, Function, Setting};

pub(super) const FAMILY: Family = Family {
    name: "latency",
    what: "A joint is off in proportion to its rate: its encoder was read earlier or later than the observation. One \
           encoder may be late, or all of them by the same time.",
    causes: "Filters and buses between encoder and computer, an exposure stamped at its start, clocks that differ.",
    looks: "Residuals along the motion in proportion to the rate; with a common latency, the same time in every joint.",
    check: "Observe one pose at rest and in motion, at two rates and in both directions.",
    effects,
};

/// Inputs named `beta_rate` belong to the joint `beta`.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let late: Vec<_> = setting
        .joints()
        .into_iter()
        .filter_map(|joint| Some((joint, Kind::Rate(joint.symbol).input(setting)?)))
        .collect();
    // In the sense of the reading.
    let rate = |reversed: bool, input| if reversed { -&Poly::symbol(input) } else { Poly::symbol(input) };
    let effect = |name: String, functions, driver: String, place| Effect {
        bends: None,
        family: FAMILY.name,
        name,
        place,
        functions,
        driver,
        form: Dependence::Linear,
    };
    let mut effects: Vec<Effect> = late
        .iter()
        .map(|&(joint, input)| {
            let name = setting.name(joint.symbol);
            let function = Function::new(rate(joint.reversed, input), format!("latency_{name}"));
            effect(
                format!("latency of {name}"),
                vec![function],
                setting.name(input).to_owned(),
                joint.place(),
            )
        })
        .collect();
    // One time for all that turn; a time in rad and one in m would be different errors.
    let turning: Vec<_> =
        late.into_iter().filter(|(joint, _)| joint.freedom.kind == TransformKind::Rotation).collect();
    if let [(first, input), others @ ..] = turning.as_slice()
        && !others.is_empty()
    {
        let elsewhere = others.iter().map(|&(joint, input)| (joint.place(), rate(joint.reversed, input)));
        let function = Function {
            amount: rate(first.reversed, *input),
            elsewhere: elsewhere.collect(),
            stem: "latency_common".to_owned(),
        };
        let drivers: Vec<&str> = turning.iter().map(|&(_, input)| setting.name(input)).collect();
        effects.push(effect(
            "latency common to all encoders".to_owned(),
            vec![function],
            drivers.join(", "),
            first.place(),
        ));
    }
    effects
}
