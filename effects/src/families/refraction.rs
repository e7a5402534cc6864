//! Refraction: the air bends the line of sight up, by an angle that grows as the tangent of the zenith distance.

use model_core::ObservableId;
use model_core::algebra::{AngleSum, Poly};
use model_core::sight::SightAngle;

use crate::candidate::{Bends, Effect, Family, Freedom, Function, JointAxis, Place, Setting, seen};

pub(super) const FAMILY: Family = Family {
    name: "refraction",
    what: "Light is bent on its way through the air, towards the zenith, by an angle that grows as the tangent of the zenith \
           distance. Near the horizon its cube is added. For a joint that counts from the horizon it is the cotangent of the joint. \
           Other mounts need `gravity` in the declaration, so that up is known.",
    causes: "Refraction left over after a model of the air: wrong pressure, temperature or wavelength.",
    looks: "A shift along the vertical, at every azimuth, that grows without bound towards the horizon.",
    check: "Compare pressure and temperature given to the refraction model. Measure on a day with other weather.",
    effects,
};

/// The powers of the tangent: the first term, and what the curvature of the air adds to it.
///
/// Source: W. M. Smart, "Textbook on Spherical Astronomy", chapter III: R = A tan z + B tan³ z.
const POWERS: [u32; 2] = [1, 3];

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    setting.observables.iter().flat_map(|&id| of_sight(setting, id)).collect()
}

/// Of one line of sight that is seen from the ground.
fn of_sight(setting: &Setting<'_>, id: ObservableId) -> Vec<Effect> {
    let mut chain = setting.chain.clone();
    if chain.sight_angle_of(id).is_none() && chain.add_sight_angle("zenith", id).is_err() {
        return Vec::new();
    }
    let Some(angle) = chain.sight_angle_of(id) else { return Vec::new() };
    let of_joint = setting.turning().into_iter().find_map(|joint| {
        let word = counts(setting, &joint, &angle.cosine)?;
        Some((joint, word))
    });
    let is_named = setting.chain.sight_angle_of(id).is_some();
    match of_joint {
        Some((joint, word)) => {
            POWERS.into_iter().filter_map(|power| of_axis(setting, &joint, word, power)).collect()
        }
        None if is_named => POWERS.into_iter().filter_map(|power| of_angle(setting, angle, power)).collect(),
        // Without a symbol for it, no amount can have this angle.
        None => Vec::new(),
    }
}

/// How a level joint counts, if the cosine of the zenith distance follows from it alone: `tan` from the zenith, `cot` from the
/// horizon.
fn counts(setting: &Setting<'_>, joint: &JointAxis, cosine: &Poly) -> Option<&'static str> {
    let gravity = seen::from_ground(setting, &setting.chain.gravity, joint.place())?;
    if !gravity[joint.freedom.axis.index()].is_zero() {
        return None;
    }
    let angle = AngleSum::symbol(joint.symbol);
    let is = |wave: &Poly| cosine == wave || cosine == &-wave;
    if is(&Poly::cos(&angle)) {
        Some("tan")
    } else if is(&Poly::sin(&angle)) {
        Some("cot")
    } else {
        None
    }
}

/// About the axis of a joint that is an altitude or a zenith distance.
fn of_axis(setting: &Setting<'_>, joint: &JointAxis, word: &'static str, power: u32) -> Option<Effect> {
    let name = setting.name(joint.symbol);
    let angle = AngleSum::symbol(joint.symbol);
    let (cosine, sine) = (Poly::cos(&angle), Poly::sin(&angle));
    let tangent = if word == "tan" { &sine * &cosine.recip()? } else { &cosine * &sine.recip()? };
    let (cubed, stem) = if power == 1 { ("", "") } else { ("cube of ", "cubed_") };
    Some(Effect {
        bends: None,
        family: FAMILY.name,
        name: format!("refraction, {cubed}{word} of {name}"),
        place: joint.place(),
        functions: vec![Function::new(tangent.pow(power).ok()?, format!("refraction_{stem}{word}_{name}"))],
        driver: name.to_owned(),
        form: if power == 1 { word.into() } else { format!("{word}, cubed").into() },
    })
}

/// About the horizontal across a line of sight that several joints turn.
fn of_angle(setting: &Setting<'_>, angle: &SightAngle, power: u32) -> Option<Effect> {
    let chain = setting.chain;
    let observable = chain.observable(angle.observable);
    let zenith = AngleSum::symbol(angle.symbol);
    let amount = (&Poly::sin(&zenith) * &Poly::cos(&zenith).recip()?).pow(power).ok()?;
    let mut turns = angle.turns(&amount).ok()?.into_iter().map(|(axis, turn)| {
        let place = Place {
            body: observable.body,
            role: model_core::Role::MotionError,
            freedom: Freedom::about(axis),
        };
        (place, turn)
    });
    let (place, first) = turns.next()?;
    // What stands behind the place would turn the bending, too.
    if seen::observed(setting, angle.observable, place)? != observable.components {
        return None;
    }
    let several = setting.observables.len() > 1;
    let of = if several { format!(" of {}", observable.name) } else { String::new() };
    let (cubed, stem) = if power == 1 { ("", "refraction") } else { ("cube of the ", "refraction_cubed") };
    let stem = if several { format!("{stem}_{}", observable.name) } else { stem.to_owned() };
    Some(Effect {
        bends: Some(Bends { observable: angle.observable, amounts: vec![amount] }),
        family: FAMILY.name,
        name: format!("refraction, {cubed}tangent of the zenith distance{of}"),
        place,
        functions: vec![Function { amount: first, elsewhere: turns.collect(), stem }],
        driver: "zenith distance".to_owned(),
        form: format!("the {cubed}tangent of the zenith distance").into(),
    })
}
