//! The catalogue of effects: what a declaration may lack.
//!
//! An effect is a place in the chain, a degree of freedom there, and functions of joints and inputs, one new error
//! to each. All of them follow from the chain: a family (one file each, one line in [`FAMILIES`]) says which
//! functions make physical sense where. Columns for a search come from the algebra ([`crate::columns`]),
//! never from formulas typed in.

mod assembly;
mod coupling;
mod encoder;
mod gravity;
mod joint_motion;
mod motion_direction;
mod optics;
mod side_quantity;
mod smooth;

use model_core::algebra::{AngleSum, Poly, Rational};
use model_core::{Axis, BodyId, Chain, Factor, Motion, ObservableId, ObservableKind, Quantity, Role};
use model_core::{Symbol, SymbolId, SymbolKind, print};

pub use assembly::assembly_name;
pub use smooth::smooth;

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
    /// Names that other fields have for members of it.
    pub aliases: &'static [Alias],
    /// Its members for one chain.
    pub effects: fn(&Setting<'_>) -> Vec<Effect>,
}

/// A name from another field, and what it means here.
pub struct Alias {
    /// `TPOINT HECE`
    pub name: &'static str,
    /// `harmonic 1 about its own axis`
    pub meaning: &'static str,
}

/// Every family, in the order in which members of one class lend it their name.
pub const FAMILIES: &[Family] = &[
    assembly::FAMILY,
    encoder::FAMILY,
    gravity::FAMILY,
    joint_motion::FAMILY,
    motion_direction::FAMILY,
    side_quantity::FAMILY,
    optics::FAMILY,
    coupling::FAMILY,
];

/// What the catalogue is made for.
#[derive(Debug, Clone, Copy)]
pub struct Setting<'a> {
    /// The chain as declared, with every side quantity as an input.
    pub chain: &'a Chain,
    /// What was observed.
    pub observables: &'a [ObservableId],
    /// Side quantities that effects may use.
    pub inputs: &'a [SymbolId],
    /// The highest harmonic of an encoder.
    pub harmonics: u32,
}

/// A rotation about an axis, or a shift along one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Freedom {
    /// Rotation or shift.
    pub motion: Motion,
    /// The axis.
    pub axis: Axis,
}

impl Freedom {
    /// All six, rotations first.
    pub const ALL: [Self; 6] = [
        Self { motion: Motion::Rotation, axis: Axis::X },
        Self { motion: Motion::Rotation, axis: Axis::Y },
        Self { motion: Motion::Rotation, axis: Axis::Z },
        Self { motion: Motion::Translation, axis: Axis::X },
        Self { motion: Motion::Translation, axis: Axis::Y },
        Self { motion: Motion::Translation, axis: Axis::Z },
    ];

    /// As declarations write it: `Rx`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match (self.motion, self.axis) {
            (Motion::Rotation, Axis::X) => "Rx",
            (Motion::Rotation, Axis::Y) => "Ry",
            (Motion::Rotation, Axis::Z) => "Rz",
            (Motion::Translation, Axis::X) => "Tx",
            (Motion::Translation, Axis::Y) => "Ty",
            (Motion::Translation, Axis::Z) => "Tz",
        }
    }

    /// `about x`, `along x`.
    #[must_use]
    pub fn words(self) -> String {
        let preposition = if self.motion == Motion::Rotation { "about" } else { "along" };
        format!("{preposition} {}", self.axis_name())
    }

    /// `x`, `y` or `z`.
    #[must_use]
    pub fn axis_name(self) -> &'static str {
        ["x", "y", "z"][self.axis.index()]
    }

    /// What an amount of it measures.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        match self.motion {
            Motion::Rotation => Quantity::Angle,
            Motion::Translation => Quantity::Length,
        }
    }
}

/// Where a factor goes: after the last one of a role in a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The body.
    pub body: BodyId,
    /// [`Role::PositionError`] (before the joint moves it) or [`Role::MotionError`] (after).
    pub role: Role,
    /// What it moves there.
    pub freedom: Freedom,
}

/// One function of joints and inputs in an effect, with the new error that multiplies it.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// The function.
    pub amount: Poly,
    /// Stem of the new error's name: `ecc_cos_beta`.
    pub stem: String,
}

/// A candidate for something the declaration lacks.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// Name of its family in [`FAMILIES`].
    pub family: &'static str,
    /// `encoder eccentricity of beta`
    pub name: String,
    /// Where and what it moves.
    pub place: Place,
    /// By which functions.
    pub functions: Vec<Function>,
    /// The joint or input behind it: `beta`.
    pub driver: String,
    /// The kind of function: `harmonic 1`.
    pub form: String,
}

/// The whole catalogue for one chain, family after family, without repetitions.
#[must_use]
pub fn catalogue(setting: &Setting<'_>) -> Vec<Effect> {
    let mut all: Vec<Effect> = Vec::new();
    for family in FAMILIES {
        for effect in (family.effects)(setting) {
            let seen = all.iter().any(|other| {
                other.place == effect.place
                    && other.functions.len() == effect.functions.len()
                    && other.functions.iter().zip(&effect.functions).all(|(a, b)| a.amount == b.amount)
            });
            let moves = setting.moved_by(effect.place.freedom);
            if !seen && moves && !effect.functions.is_empty() {
                all.push(effect);
            }
        }
    }
    let reversed: Vec<Effect> = setting
        .inputs
        .iter()
        .filter(|&&input| setting.reverses(input))
        .flat_map(|&input| all.iter().filter_map(move |effect| effect.times(input, setting)))
        .collect();
    all.extend(reversed);
    all
}

impl Setting<'_> {
    /// Bodies on the way to something observed, from the ground up.
    #[must_use]
    pub fn bodies(&self) -> Vec<BodyId> {
        let mut bodies: Vec<BodyId> =
            self.observables.iter().flat_map(|&id| self.chain.path(self.chain.observable(id).body)).collect();
        bodies.sort_unstable();
        bodies.dedup();
        bodies
    }

    /// Whether a degree of freedom can move anything observed: shifts do not move directions.
    fn moved_by(&self, freedom: Freedom) -> bool {
        freedom.motion == Motion::Rotation
            || self.observables.iter().any(|&id| self.chain.observable(id).kind == ObservableKind::Point)
    }

    /// Whether the declaration multiplies errors by an input, as with the side of the pier or the face: then what
    /// else is fixed to that body may change with it too.
    fn reverses(&self, input: SymbolId) -> bool {
        let errors = self.chain.bodies.iter().flat_map(|body| &body.factors);
        errors
            .filter(|factor| matches!(factor.role, Role::PositionError | Role::MotionError))
            .any(|factor| factor.amount.symbols().contains(&input))
    }

    /// Whether something observed is a direction.
    #[must_use]
    pub fn aims(&self) -> bool {
        self.observables.iter().any(|&id| self.chain.observable(id).kind == ObservableKind::Direction)
    }

    /// The joints of the bodies observed, each with the body and the degree of freedom that it moves.
    #[must_use]
    pub fn joints(&self) -> Vec<JointAxis> {
        let mut joints = Vec::new();
        for body in self.bodies() {
            for factor in self.chain.body(body).factors.iter().filter(|f| f.role == Role::Motion) {
                for symbol in factor.amount.symbols() {
                    if self.chain.symbol(symbol).kind == SymbolKind::Joint {
                        let freedom = Freedom { motion: factor.motion, axis: factor.axis };
                        joints.push(JointAxis { symbol, body, freedom });
                    }
                }
            }
        }
        joints
    }

    /// The name of a symbol.
    #[must_use]
    pub fn name(&self, symbol: SymbolId) -> &str {
        &self.chain.symbol(symbol).name
    }

    /// The name of a body.
    #[must_use]
    pub fn body_name(&self, body: BodyId) -> &str {
        &self.chain.body(body).name
    }
}

/// A joint and what it moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct JointAxis {
    /// The joint.
    pub symbol: SymbolId,
    /// The body that it moves.
    pub body: BodyId,
    /// About or along what.
    pub freedom: Freedom,
}

impl JointAxis {
    /// Whether it is an angle.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.freedom.motion == Motion::Rotation
    }
}

/// cos nq and sin nq, with error names `stem_cos…`, `stem_sin…`.
#[must_use]
pub fn harmonic(joint: SymbolId, name: &str, order: u32, stem: &str) -> Vec<Function> {
    let Ok(angle) = AngleSum::symbol(joint).times(order) else { return Vec::new() };
    let number = if order == 1 { String::new() } else { order.to_string() };
    vec![
        Function { amount: Poly::cos(&angle), stem: format!("{stem}_cos{number}_{name}") },
        Function { amount: Poly::sin(&angle), stem: format!("{stem}_sin{number}_{name}") },
    ]
}

impl Effect {
    /// Its factor with new errors: names for them, and the amount once they are symbols of the chain.
    #[must_use]
    pub fn add_to(&self, chain: &Chain) -> Option<(Chain, Vec<SymbolId>)> {
        let mut amended = chain.clone();
        let mut errors = Vec::new();
        let mut amount = Poly::zero();
        for function in &self.functions {
            let name = free_name(&amended, &function.stem);
            let id = add_error(&mut amended, name, self.place.freedom.quantity())?;
            amount = &amount + &(&Poly::symbol(id) * &function.amount);
            errors.push(id);
        }
        insert(&mut amended, self.place, amount, self.name.clone());
        Some((amended, errors))
    }

    /// The same effect times an input, for families of the instrument's own geometry and low orders.
    fn times(&self, input: SymbolId, setting: &Setting<'_>) -> Option<Self> {
        let geometric = [gravity::FAMILY.name, encoder::FAMILY.name, joint_motion::FAMILY.name];
        let low = ["harmonic 1", "harmonic 2"].contains(&self.form.as_str());
        if !geometric.contains(&self.family) || !(low || self.family == gravity::FAMILY.name) {
            return None;
        }
        let name = setting.name(input);
        let times = |function: &Function| Function {
            amount: &Poly::symbol(input) * &function.amount,
            stem: format!("{}_{name}", function.stem),
        };
        Some(Self {
            name: format!("{}, times {name}", self.name),
            functions: self.functions.iter().map(times).collect(),
            driver: format!("{}, {name}", self.driver),
            ..self.clone()
        })
    }

    /// As a declaration would write it in a chain that has its errors: `Rx(a*cos(beta) + b*sin(beta))`.
    #[must_use]
    pub fn text(&self, chain: &Chain, errors: &[SymbolId]) -> String {
        let parts: Vec<String> = errors
            .iter()
            .zip(&self.functions)
            .map(|(&id, function)| {
                let name = &chain.symbol(id).name;
                if function.amount == Poly::one() {
                    return name.clone();
                }
                let product = &Poly::symbol(id) * &function.amount;
                print::text(&product, chain)
            })
            .collect();
        format!("{}({})", self.place.freedom.word(), parts.join(" + ").replace("+ -", "- "))
    }
}

/// The stem itself, or the stem with the first number that makes it new.
fn free_name(chain: &Chain, stem: &str) -> String {
    if chain.find_symbol(stem).is_none() {
        return stem.to_owned();
    }
    let mut number = 2_u32;
    loop {
        let name = format!("{stem}_{number}");
        if chain.find_symbol(&name).is_none() {
            return name;
        }
        number += 1;
    }
}

/// Declares a new error.
pub(crate) fn add_error(chain: &mut Chain, name: String, quantity: Quantity) -> Option<SymbolId> {
    let (kind, documentation) = (SymbolKind::Error, String::new());
    let id = SymbolId(u16::try_from(chain.symbols.len()).ok()?);
    let latex = name.replace('_', r"\_");
    chain.symbols.push(Symbol { name, kind, quantity, documentation, latex, value: None });
    Some(id)
}

/// Inserts a factor after the last one of its role, or where that role belongs.
pub(crate) fn insert(chain: &mut Chain, place: Place, amount: Poly, documentation: String) {
    let Some(body) = chain.bodies.get_mut(usize::from(place.body.0)) else { return };
    let last = |role: Role| body.factors.iter().rposition(|factor| factor.role == role);
    let at = match place.role {
        Role::MotionError => {
            last(Role::MotionError).or_else(|| last(Role::Motion)).map_or(body.factors.len(), |i| i + 1)
        }
        _ => last(Role::PositionError).or_else(|| last(Role::Position)).map_or(0, |i| i + 1),
    };
    let factor = Factor {
        role: place.role,
        motion: place.freedom.motion,
        axis: place.freedom.axis,
        amount,
        documentation,
    };
    body.factors.insert(at, factor);
}

/// A whole number as an amount.
pub(crate) fn whole(value: i64) -> Poly {
    Poly::constant(Rational::from(value))
}
