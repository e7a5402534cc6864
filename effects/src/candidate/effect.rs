//! An effect: places in the chain, functions of joints and inputs there, and one new error to each function.

use std::collections::BTreeSet;

use model_core::algebra::Poly;
use model_core::{
    Axis, BodyId, Chain, Factor, ObservableId, Quantity, Role, Symbol, SymbolId, SymbolKind, TransformKind,
    print, validate,
};

use super::Dependence;

/// A rotation about an axis, or a shift along one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Freedom {
    /// Rotation or shift.
    pub kind: TransformKind,
    /// The axis.
    pub axis: Axis,
}

impl Freedom {
    /// All six, rotations first.
    pub const ALL: [Self; 6] = [
        Self::about(Axis::X),
        Self::about(Axis::Y),
        Self::about(Axis::Z),
        Self::along(Axis::X),
        Self::along(Axis::Y),
        Self::along(Axis::Z),
    ];

    /// A rotation.
    #[must_use]
    pub const fn about(axis: Axis) -> Self {
        Self { kind: TransformKind::Rotation, axis }
    }

    /// A shift.
    #[must_use]
    pub const fn along(axis: Axis) -> Self {
        Self { kind: TransformKind::Translation, axis }
    }

    /// The three rotations.
    pub fn rotations() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|freedom| freedom.kind == TransformKind::Rotation)
    }

    /// As declarations write it: `Rx`.
    #[must_use]
    pub fn word(self) -> &'static str {
        match (self.kind, self.axis) {
            (TransformKind::Rotation, Axis::X) => "Rx",
            (TransformKind::Rotation, Axis::Y) => "Ry",
            (TransformKind::Rotation, Axis::Z) => "Rz",
            (TransformKind::Translation, Axis::X) => "Tx",
            (TransformKind::Translation, Axis::Y) => "Ty",
            (TransformKind::Translation, Axis::Z) => "Tz",
        }
    }

    /// `about x`, `along x`.
    #[must_use]
    pub fn words(self) -> String {
        let preposition = if self.kind == TransformKind::Rotation { "about" } else { "along" };
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
        match self.kind {
            TransformKind::Rotation => Quantity::Angle,
            TransformKind::Translation => Quantity::Length,
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

impl Place {
    /// The same spot, moving something else.
    #[must_use]
    pub fn with(self, freedom: Freedom) -> Self {
        Self { freedom, ..self }
    }

    /// Where in the body's list of factors a new one goes.
    pub(super) fn position(self, chain: &Chain) -> usize {
        let factors = chain.bodies.get(usize::from(self.body.0)).map_or(&[][..], |body| &body.factors);
        let last = |role: Role| factors.iter().rposition(|factor| factor.role == role);
        match self.role {
            Role::MotionError => {
                last(Role::MotionError).or_else(|| last(Role::Motion)).map_or(factors.len(), |i| i + 1)
            }
            _ => last(Role::PositionError).or_else(|| last(Role::Position)).map_or(0, |i| i + 1),
        }
    }
}

/// What one new error multiplies.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// At the effect's own place.
    pub amount: Poly,
    /// At other places, where one cause moves more than one degree of freedom.
    pub elsewhere: Vec<(Place, Poly)>,
    /// Stem of the new error's name: `ecc_cos_beta`.
    pub stem: String,
}

impl Function {
    /// A function at the effect's own place alone.
    #[must_use]
    pub fn new(amount: Poly, stem: impl Into<String>) -> Self {
        Self { amount, elsewhere: Vec::new(), stem: stem.into() }
    }

    /// The same with every amount changed.
    #[must_use]
    pub fn map(&self, stem: String, change: impl Fn(&Poly) -> Poly) -> Self {
        let elsewhere = self.elsewhere.iter().map(|(place, amount)| (*place, change(amount))).collect();
        Self { amount: change(&self.amount), elsewhere, stem }
    }

    /// What it does at its own place, then elsewhere.
    pub fn amounts(&self) -> impl Iterator<Item = &Poly> {
        std::iter::once(&self.amount).chain(self.elsewhere.iter().map(|(_, amount)| amount))
    }

    /// Every symbol that it reads, in order.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        self.amounts().flat_map(Poly::symbols).collect::<BTreeSet<_>>().into_iter().collect()
    }
}

/// A candidate for something the declaration lacks.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// Name of its family in [`crate::families::FAMILIES`].
    pub family: &'static str,
    /// `encoder eccentricity of beta`
    pub name: String,
    /// Where and what it moves; the first such place, where there are more.
    pub place: Place,
    /// By which functions.
    pub functions: Vec<Function>,
    /// The joint or input behind it: `beta`.
    pub driver: String,
    /// How it follows that.
    pub form: Dependence,
    /// The line of sight that it bends up, where it is none of the bodies that move: then the declaration says so, and what
    /// stands at its places is what that comes to, to first order.
    pub bends: Option<Bends>,
}

/// A bending of a line of sight.
#[derive(Debug, Clone, PartialEq)]
pub struct Bends {
    /// The direction.
    pub observable: ObservableId,
    /// By how much each error bends it up, in the order of the functions.
    pub amounts: Vec<Poly>,
}

/// Where a line of a declaration goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spot {
    /// A factor of a role in a body.
    Factor(BodyId, Role),
    /// The bending of a line of sight.
    Sight(ObservableId),
}

impl Effect {
    /// Every place that it moves, its own first, each once.
    #[must_use]
    pub fn places(&self) -> Vec<Place> {
        let mut places = vec![self.place];
        for (place, _) in self.functions.iter().flat_map(|function| &function.elsewhere) {
            if !places.contains(place) {
                places.push(*place);
            }
        }
        places
    }

    /// What it moves, as declarations write it: `Rx`, or `Rx, Ry`.
    #[must_use]
    pub fn freedoms(&self) -> String {
        let mut words: Vec<&str> = Vec::new();
        for place in self.places() {
            if !words.contains(&place.freedom.word()) {
                words.push(place.freedom.word());
            }
        }
        words.join(", ")
    }

    /// The chain with it, and its new errors.
    #[must_use]
    pub fn add_to(&self, chain: &Chain) -> Option<(Chain, Vec<SymbolId>)> {
        let mut amended = chain.clone();
        let mut errors = Vec::new();
        for function in &self.functions {
            let name = free_name(&amended, &function.stem);
            errors.push(add_error(&mut amended, name, self.place.freedom.quantity())?);
        }
        if let Some(bends) = &self.bends {
            let observable = usize::from(bends.observable.0);
            let bent = amended.observables.get(observable)?.bend.as_ref();
            let mut amount = bent.map_or_else(Poly::zero, |bend| bend.amount.clone());
            for (&error, own) in errors.iter().zip(&bends.amounts) {
                amount = &amount + &(&Poly::symbol(error) * own);
            }
            let bend = amended.sight_angle_of(bends.observable)?.bending(&amount, &self.name).ok()?;
            amended.observables[observable].bend = Some(bend);
            return Some((amended, errors));
        }
        for (place, amount) in self.amounts(&errors) {
            insert(&mut amended, place, amount, self.name.clone());
        }
        Some((amended, errors))
    }

    /// At each of its places the sum of what its errors do there.
    fn amounts(&self, errors: &[SymbolId]) -> Vec<(Place, Poly)> {
        let sum = |place: Place| {
            let mut sum = Poly::zero();
            for (&error, function) in errors.iter().zip(&self.functions) {
                for amount in function.at(self.place, place) {
                    sum = &sum + &(&Poly::symbol(error) * amount);
                }
            }
            (place, sum)
        };
        self.places().into_iter().map(sum).collect()
    }

    /// As a declaration would write it in a chain that has its errors, for each body and role that it stands in:
    /// `Rx(a*cos(beta) + b*sin(beta))`; of a bending the amount alone, `a*tan(zenith)`.
    #[must_use]
    pub fn texts(&self, chain: &Chain, errors: &[SymbolId]) -> Vec<(Spot, String)> {
        if let Some(bends) = &self.bends {
            let parts = errors.iter().zip(&bends.amounts);
            let parts: Vec<String> =
                parts.map(|(&error, amount)| print::text(&(&Poly::symbol(error) * amount), chain)).collect();
            return vec![(Spot::Sight(bends.observable), parts.join(" + ").replace("+ -", "- "))];
        }
        let mut texts: Vec<(Spot, String)> = Vec::new();
        for place in self.places() {
            let parts: Vec<String> = errors
                .iter()
                .zip(&self.functions)
                .flat_map(|(&error, function)| {
                    function.at(self.place, place).into_iter().map(move |amount| (error, amount))
                })
                .map(|(error, amount)| print::text(&(&Poly::symbol(error) * amount), chain))
                .collect();
            let factor = format!("{}({})", place.freedom.word(), parts.join(" + ").replace("+ -", "- "));
            let spot = Spot::Factor(place.body, place.role);
            match texts.iter_mut().find(|(known, _)| *known == spot) {
                Some((_, text)) => *text = format!("{text}, {factor}"),
                None => texts.push((spot, factor)),
            }
        }
        texts
    }

    /// All of [`Self::texts`] in one line.
    #[must_use]
    pub fn text(&self, chain: &Chain, errors: &[SymbolId]) -> String {
        let texts = self.texts(chain, errors).into_iter().map(|(spot, text)| match spot {
            Spot::Factor(..) => text,
            Spot::Sight(_) => format!("bent up by {text}"),
        });
        texts.collect::<Vec<_>>().join(", ")
    }
}

impl Function {
    /// What it does at a place, if its effect's own place is `own`.
    pub fn at(&self, own: Place, place: Place) -> Vec<&Poly> {
        let first = (own == place).then_some(&self.amount);
        let others = self.elsewhere.iter().filter(|(other, _)| *other == place).map(|(_, amount)| amount);
        first.into_iter().chain(others).collect()
    }
}

/// The stem itself, or the stem with the first number that makes it a new name.
fn free_name(chain: &Chain, stem: &str) -> String {
    if chain.find_symbol(stem).is_none() && validate::is_name(stem) {
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
pub fn add_error(chain: &mut Chain, name: String, quantity: Quantity) -> Option<SymbolId> {
    let (kind, documentation) = (SymbolKind::Error, String::new());
    let id = SymbolId(u16::try_from(chain.symbols.len()).ok()?);
    let latex = name.replace('_', r"\_");
    chain.symbols.push(Symbol {
        name,
        kind,
        quantity,
        meaning: None,
        of: None,
        documentation,
        latex,
        value: None,
    });
    Some(id)
}

/// Inserts a factor after the last one of its role, or where that role belongs.
pub fn insert(chain: &mut Chain, place: Place, amount: Poly, documentation: String) {
    let at = place.position(chain);
    let Some(body) = chain.bodies.get_mut(usize::from(place.body.0)) else { return };
    let Place { role, freedom: Freedom { kind, axis }, .. } = place;
    body.factors.insert(at, Factor { role, kind, axis, amount, documentation });
}
