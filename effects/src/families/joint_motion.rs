//! Error motion of a joint's axis: tilts and shifts that repeat as the joint turns.

use model_core::SymbolId;
use model_core::algebra::{AngleSum, Poly};

use crate::candidate::{
    Dependence, Effect, Family, Freedom, Function, JointAxis, Place, Setting, harmonic, per_turn, seen, whole,
};

/// The highest harmonic of the turn in the catalogue.
const HARMONICS: u32 = 8;

/// Tilts about one axis of the turning frame alone: a shaft clamped askew, an oval race.
const ONE_SIDED: u32 = 2;

pub(crate) const FAMILY: Family = Family {
    name: "joint motion",
    what: "The axis of a joint tilts or shifts as the joint turns, in step with the turn. Its tip moves on a circle, \
           forward with the turn or backward against it (a whirl); two circles of one order make an ellipse or a line.",
    causes: "Bearing races and balls that are not round, a track that is not flat, a shaft bent or clamped \
             askew.",
    looks: "Harmonics of the joint at right angles to its own axis (tilt, radial) or along it (axial). Seen from the \
            ground a forward whirl of order n in the turning frame has order n + 1, a backward one n − 1. The backward one \
            of order 1 is fixed, and is perpendicularity.",
    check: "Watch an inclinometer on the turning frame, or a sphere and dial gauges on the axis, through one turn (the \
            tilt, radial and axial error motion of ISO 230-7).",
    effects,
};

/// How a circle is run through: `order` times for each turn of an angle.
pub(super) struct Turn<'a> {
    pub angle: SymbolId,
    pub name: &'a str,
    pub order: u32,
    /// With the angle rather than against it.
    pub forward: bool,
}

/// A vector that turns about the axis before a place's own in the cyclic order: the place's axis and the next one carry
/// its two components, (a + ib)·exp(±inq).
pub(super) fn whirl(place: Place, turn: &Turn<'_>, stem: &str) -> Vec<Function> {
    let Ok(angle) = AngleSum::symbol(turn.angle).times(turn.order) else { return Vec::new() };
    let (next, _) = seen::others(place.freedom.axis);
    let across = place.with(Freedom { axis: next, ..place.freedom });
    let cosine = Poly::cos(&angle);
    let sine = &Poly::sin(&angle) * &whole(if turn.forward { 1 } else { -1 });
    let name = |part: &str| format!("{stem}{}_{part}_{}", turn.order, turn.name);
    vec![
        Function { amount: cosine.clone(), elsewhere: vec![(across, sine.clone())], stem: name("cos") },
        Function { amount: -&sine, elsewhere: vec![(across, cosine)], stem: name("sin") },
    ]
}

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let mut effects = Vec::new();
    for joint in setting.turning() {
        let (first, second) = seen::others(joint.freedom.axis);
        let about = [Freedom::about(first), Freedom::about(second)];
        let seen = about.map(|freedom| setting.moves(joint.place().with(freedom)));
        match seen {
            [true, true] => {
                effects.extend(circles(setting, &joint, about[0], ("tilt", "tilt")));
                for freedom in about {
                    effects.extend((1..=ONE_SIDED).map(|order| tilt(setting, &joint, freedom, order)));
                }
            }
            // The other component moves nothing: forward and backward are one.
            [one, other] => {
                for freedom in [one.then_some(about[0]), other.then_some(about[1])].into_iter().flatten() {
                    effects.extend((1..=HARMONICS).map(|order| tilt(setting, &joint, freedom, order)));
                }
            }
        }
        effects.extend(circles(setting, &joint, Freedom::along(first), ("radial motion", "radial")));
        effects.extend((1..=HARMONICS).map(|order| axial(setting, &joint, order)));
    }
    effects
}

/// Whirls of every order in both senses, `forward` being that of the motion.
fn circles(
    setting: &Setting<'_>,
    joint: &JointAxis,
    freedom: Freedom,
    (word, stem): (&str, &str),
) -> Vec<Effect> {
    let name = setting.name(joint.symbol);
    let place = joint.place().with(freedom);
    let circle = |order, forward: bool| {
        let (sense, short) = if forward { ("forward", "fwd") } else { ("backward", "bwd") };
        // With the motion is against the reading where the body turns against it.
        let turn = Turn { angle: joint.symbol, name, order, forward: forward != joint.reversed };
        Effect {
            bends: None,
            family: FAMILY.name,
            name: format!("{word} of the {name} axis, {} {sense}", per_turn(order)),
            place,
            functions: whirl(place, &turn, &format!("{stem}_{short}")),
            driver: name.to_owned(),
            form: Dependence::Harmonic { order },
        }
    };
    (1..=HARMONICS).flat_map(|order| [circle(order, true), circle(order, false)]).collect()
}

/// A tilt about one axis of the turning frame.
fn tilt(setting: &Setting<'_>, joint: &JointAxis, freedom: Freedom, order: u32) -> Effect {
    let (name, about) = (setting.name(joint.symbol), freedom.axis_name());
    Effect {
        bends: None,
        family: FAMILY.name,
        name: format!("tilt about {about} of the {name} axis, {}", per_turn(order)),
        place: joint.place().with(freedom),
        functions: harmonic(joint.symbol, name, order, &format!("tilt_{about}")),
        driver: name.to_owned(),
        form: Dependence::Harmonic { order },
    }
}

/// A shift along the joint's own axis.
fn axial(setting: &Setting<'_>, joint: &JointAxis, order: u32) -> Effect {
    let name = setting.name(joint.symbol);
    Effect {
        bends: None,
        family: FAMILY.name,
        name: format!("axial motion of the {name} axis, {}", per_turn(order)),
        place: joint.place().with(Freedom::along(joint.freedom.axis)),
        functions: harmonic(joint.symbol, name, order, "axial"),
        driver: name.to_owned(),
        form: Dependence::Harmonic { order },
    }
}
