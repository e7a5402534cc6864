//! Sub-divisional errors: an encoder's interpolation within one line of its graduation.

use crate::candidate::{Dependence, Effect, Family, Setting, harmonic};

/// Periods a line: offset and crosstalk of the two signals (once), their gains and phase (twice), distortion (4).
const PER_LINE: [u32; 3] = [1, 2, 4];

pub(super) const FAMILY: Family = Family {
    name: "sub-divisional error",
    what: "The reading is interpolated wrongly within each line of the graduation, the same way in every line.",
    causes: "The sine and cosine signals of the reading head have offsets (once a line), unequal gains or a phase that is \
             not a quarter period (twice), or are no pure sines (4 times).",
    looks: "Hundreds or thousands of periods a turn: looks like noise unless residuals are plotted against the fraction \
            of a line.",
    check: "Turn slowly over a few lines and plot the two signals against each other: the figure should be a circle \
            around the origin.",
    effects,
};

/// For joints whose lines a turn the study gives.
fn effects(setting: &Setting<'_>) -> Vec<Effect> {
    let joints = setting.turning();
    let mut effects = Vec::new();
    for &(symbol, lines) in setting.lines {
        let Some(joint) = joints.iter().find(|joint| joint.symbol == symbol) else { continue };
        let name = setting.name(symbol);
        for times in PER_LINE {
            let Some(order) = lines.checked_mul(times) else { continue };
            let often = if times == 1 { "once a line".to_owned() } else { format!("{times} per line") };
            effects.push(Effect {
                bends: None,
                family: FAMILY.name,
                name: format!("sub-divisional error of {name}, {often}"),
                place: joint.place(),
                functions: harmonic(symbol, name, order, "line"),
                driver: name.to_owned(),
                form: Dependence::Harmonic { order },
            });
        }
    }
    effects
}
