//! The catalogue of effects: what a declaration may lack.
//!
//! An effect is a place in the chain, a degree of freedom there, and functions of joints and inputs, one new error
//! to each. All of them follow from the chain: a family (one file each, one line in [`FAMILIES`]) says which
//! functions make physical sense where. Columns for a search come from the algebra ([`crate::columns`]),
//! never from formulas typed in.

mod assembly;
mod backlash;
mod chosen;
mod coupling;
mod drift;
mod driven;
mod effect;
mod encoder;
mod flop;
mod gravity;
mod index_step;
mod joint_motion;
mod kind;
mod latency;
mod mirror;
mod names;
mod own;
mod parallax;
mod play;
mod products;
mod range;
mod refraction;
mod rotator;
mod seen;
mod session;
mod setting;
mod side_quantity;
mod smooth;
mod sub_division;
mod tensor;
mod thermal;
mod wind_up;

use model_core::SymbolId;
use model_core::algebra::{AngleSum, Poly, Rational};

pub use assembly::assembly_name;
pub use chosen::chosen;
pub use effect::{Effect, Freedom, Function, Place};
pub(crate) use effect::{add_error, insert};
pub use names::{Name, Published, known_names, published};
pub use own::{OwnError, own};
pub use setting::{JointAxis, Setting};
pub use smooth::{SmoothPlace, smooth};
pub use tensor::tensor;

/// One family of the catalogue: its name, what an observer should know of it, and how it follows from a chain.
pub struct Family {
    /// `encoder`
    pub name: &'static str,
    /// What it is, in a sentence or two.
    pub what: &'static str,
    /// Physical causes.
    pub causes: &'static str,
    /// What it looks like in residuals.
    pub looks: &'static str,
    /// What to check on the instrument.
    pub check: &'static str,
    /// Its members for one chain.
    pub effects: fn(&Setting<'_>) -> Vec<Effect>,
}

/// Every family, in the order in which members of one class lend it their name.
pub const FAMILIES: &[Family] = &[
    own::FAMILY,
    assembly::FAMILY,
    encoder::FAMILY,
    sub_division::FAMILY,
    index_step::FAMILY,
    gravity::FAMILY,
    wind_up::FAMILY,
    joint_motion::FAMILY,
    backlash::FAMILY,
    play::FAMILY,
    latency::FAMILY,
    thermal::FAMILY,
    drift::FAMILY,
    session::FAMILY,
    flop::FAMILY,
    rotator::FAMILY,
    side_quantity::FAMILY,
    refraction::FAMILY,
    mirror::FAMILY,
    range::FAMILY,
    parallax::FAMILY,
    coupling::FAMILY,
    products::FAMILY,
];

/// The whole catalogue for one chain, family after family, without repetitions and without what can move nothing that
/// is observed.
#[must_use]
pub fn catalogue(setting: &Setting<'_>) -> Vec<Effect> {
    let mut all: Vec<Effect> = Vec::new();
    let mut moved: Vec<(Place, bool)> = Vec::new();
    for effect in FAMILIES.iter().flat_map(|family| (family.effects)(setting)) {
        let repeated = all.iter().any(|other| {
            (other.place, other.family) == (effect.place, effect.family)
                && other.functions.len() == effect.functions.len()
                && other
                    .functions
                    .iter()
                    .zip(&effect.functions)
                    .all(|(a, b)| (&a.amount, &a.elsewhere) == (&b.amount, &b.elsewhere))
        });
        let moves = effect.places().into_iter().any(|place| {
            if let Some(&(_, known)) = moved.iter().find(|(known, _)| *known == place) {
                return known;
            }
            let moves = setting.moves(place);
            moved.push((place, moves));
            moves
        });
        if !repeated && moves && !effect.functions.is_empty() {
            all.push(effect);
        }
    }
    let reversed: Vec<Effect> = setting
        .inputs
        .iter()
        .filter(|&&input| setting.reverses(input))
        .flat_map(|&input| all.iter().filter_map(move |effect| reversed(effect, input, setting)))
        .collect();
    all.extend(reversed);
    all
}

/// The same effect times an input, for families of the instrument's own geometry and low orders: on the far side of the
/// pier, what is fixed to the instrument acts the other way round.
fn reversed(effect: &Effect, input: SymbolId, setting: &Setting<'_>) -> Option<Effect> {
    let geometric = [gravity::FAMILY.name, encoder::FAMILY.name, joint_motion::FAMILY.name];
    let low = ["harmonic 1", "harmonic 2"].contains(&effect.form.as_str());
    if !geometric.contains(&effect.family) || !(low || effect.family == gravity::FAMILY.name) {
        return None;
    }
    let name = setting.name(input);
    let times = |function: &Function| {
        function.map(format!("{}_{name}", function.stem), |amount| &Poly::symbol(input) * amount)
    };
    Some(Effect {
        name: format!("{}, times {name}", effect.name),
        functions: effect.functions.iter().map(times).collect(),
        driver: format!("{}, {name}", effect.driver),
        ..effect.clone()
    })
}

/// cos nq and sin nq, with error names `stem_cos…`, `stem_sin…`.
#[must_use]
pub fn harmonic(joint: SymbolId, name: &str, order: u32, stem: &str) -> Vec<Function> {
    let Ok(angle) = AngleSum::symbol(joint).times(order) else { return Vec::new() };
    let number = if order == 1 { String::new() } else { order.to_string() };
    vec![
        Function::new(Poly::cos(&angle), format!("{stem}_cos{number}_{name}")),
        Function::new(Poly::sin(&angle), format!("{stem}_sin{number}_{name}")),
    ]
}

/// `once a turn`, `3 per turn`.
fn per_turn(order: u32) -> String {
    if order == 1 { "once a turn".to_owned() } else { format!("{order} per turn") }
}

/// A whole number as an amount.
pub(crate) fn whole(value: i64) -> Poly {
    Poly::constant(Rational::from(value))
}
