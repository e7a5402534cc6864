//! Slides: what a joint that shifts does beside its travel, as it varies along that travel.

use model_core::algebra::Poly;

use crate::candidate::{Dependence, Effect, Family, Freedom, Function, JointAxis, Setting};

pub(crate) const FAMILY: Family = Family {
    name: "slide",
    what: "A slide is not straight, rolls or tilts as it travels, or its scale changes along the way. With their squarenesses, \
           three slides have 21 errors.",
    causes: "Guides that are bent or worn, a bed that sags between its feet, a carriage that reaches over the end of its guide, a scale \
             or screw that is stretched where it is mounted.",
    looks: "A bow or an S over the reading of one slide. A shift is the same for all that the slide carries. A roll or tilt moves \
            what is far from the slide further.",
    check: "Run the carriage along a straightedge with an indicator, and with a level or an autocollimator on it. ISO 230-1 \
            writes EYX for the straightness of X along Y, EAX for its roll, EBX and ECX for its tilts, EXX for its positioning.",
    effects,
};

/// The highest power of the travel.
///
/// Source: ISO 230-1:2012, 3.4, has each of the 21 errors as a function of travel; bows and S shapes are what guides bend to.
const HIGHEST: u32 = 3;

fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let slides = setting.joints().into_iter().filter(|joint| !joint.turns());
    slides
        .flat_map(|joint| Freedom::ALL.into_iter().flat_map(move |freedom| along(setting, &joint, freedom)))
        .collect()
}

/// One degree of freedom along the travel. What grows in proportion to it is a scale along the slide, and squareness across it: both
/// have names of their own.
fn along(setting: &Setting<'_>, joint: &JointAxis, freedom: Freedom) -> Vec<Effect> {
    let name = setting.name(joint.symbol);
    let own = freedom.axis == joint.freedom.axis;
    let turns = Freedom::about(freedom.axis) == freedom;
    let what = match (turns, own) {
        (false, true) => format!("positioning of {name}"),
        (false, false) => format!("straightness of {name} {}", freedom.words()),
        (true, true) => format!("roll of {name}"),
        (true, false) => format!("tilt of {name} {}", freedom.words()),
    };
    let lowest = if turns { 1 } else { 2 };
    (lowest..=HIGHEST)
        .filter_map(|power| {
            let shape = ["in proportion to travel", "quadratic", "cubic"][power as usize - 1];
            let amount = Poly::symbol(joint.symbol).pow(power).ok()?;
            Some(Effect {
                bends: None,
                family: FAMILY.name,
                name: format!("{what}, {shape}"),
                place: joint.place().with(freedom),
                functions: vec![Function::new(
                    amount,
                    format!("slide_{name}_{}{power}", freedom.word().to_lowercase()),
                )],
                driver: name.to_owned(),
                form: if power == 1 { Dependence::Linear } else { shape.into() },
            })
        })
        .collect()
}
