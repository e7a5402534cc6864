//! Refraction and what else grows towards a pole: the tangent or cotangent of a joint.

use model_core::algebra::{AngleSum, Poly};

use crate::candidate::{Effect, Family, Function, JointAxis, Setting, seen};

pub(super) const FAMILY: Family = Family {
    name: "refraction",
    what: "Light is bent on its way through the air, by an angle that grows as the tangent of the zenith distance: for a \
           joint that counts from the horizon, the cotangent of the joint.",
    causes: "Refraction left over after a model of the air: wrong pressure, temperature or wavelength.",
    looks: "Tangent or cotangent of a joint, growing without bound towards the horizon or a pole.",
    check: "Compare pressure and temperature given to the refraction model. Measure on a day with other weather.",
    effects,
};

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    let aiming = setting
        .turning()
        .into_iter()
        .filter(|joint| setting.aims() && counts_from_the_horizon(setting, joint));
    for joint in aiming {
        let name = setting.name(joint.symbol);
        let angle = AngleSum::symbol(joint.symbol);
        let (cosine, sine) = (Poly::cos(&angle), Poly::sin(&angle));
        for (word, above, below) in [("tan", &sine, &cosine), ("cot", &cosine, &sine)] {
            let Some(reciprocal) = below.recip() else { continue };
            effects.push(Effect {
                family: FAMILY.name,
                name: format!("refraction, {word} of {name}"),
                place: joint.place(),
                functions: vec![Function::new(above * &reciprocal, format!("refraction_{word}_{name}"))],
                driver: name.to_owned(),
                form: word.into(),
            });
        }
    }
    effects
}

/// Whether a joint turns about a level axis at all poses: only then is it an altitude or a zenith distance. Where the algebra
/// cannot say, it is not.
fn counts_from_the_horizon(setting: &Setting<'_>, joint: &JointAxis) -> bool {
    seen::from_ground(setting, &setting.chain.gravity, joint.place())
        .is_some_and(|gravity| gravity[joint.freedom.axis.index()].is_zero())
}
