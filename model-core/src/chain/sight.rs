//! What acts between an instrument and its target: the angle between an observed direction and up, and a bending of the
//! direction towards up.
//!
//! The angle follows from joints and constants, errors at zero. To the algebra it is one more free angle, with sin² + cos² = 1. Its
//! cosine is known beside that: wherever a cosine of it stands, the polynomial in joints takes its place, and one over it
//! too where that polynomial can be divided by (a mount whose joint counts from the horizon). What follows: two formulas that
//! differ by another relation between the angle and the joints have different canonical forms.

use super::reading::SignedAxis;
use super::{Axis, BodyId, Chain, Factor, ObservableId, ObservableKind, Role, TransformKind};
use crate::algebra::{AlgebraError, AngleSum, Poly, Rational, Term, Wave};
use crate::symbol::{Quantity, Symbol, SymbolId, SymbolKind};

/// Vectors of more terms than this are followed no further.
const MOST_TERMS: usize = 64;
/// Cosines of higher multiples of an angle stay as they are: written in the cosine of the angle they would fill pages.
const HIGHEST_MULTIPLE: u32 = 6;

/// The angle between an observed direction and up; up is against gravity.
#[derive(Debug, Clone, PartialEq)]
pub struct SightAngle {
    /// The symbol that stands for it in amounts; in radians, from 0 to π.
    pub symbol: SymbolId,
    /// The direction.
    pub observable: ObservableId,
    /// Along which axis of its body the direction points.
    axis: SignedAxis,
    /// Its cosine, errors at zero.
    pub cosine: Poly,
    /// Up along the two axes across the direction, in the cyclic order x, y, z; the sum of their squares is the square of its sine.
    pub across: [Poly; 2],
}

/// A bending of a direction towards up.
#[derive(Debug, Clone, PartialEq)]
pub struct Bend {
    /// By how much, in radians; it vanishes with the errors.
    pub amount: Poly,
    /// The small turns that do it, behind the factors of the body.
    pub factors: Vec<Factor>,
}

/// Why there is no angle between an observable and up.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SightError {
    /// A point or an orientation.
    #[error("`{0}` is no direction")]
    NotADirection(String),
    /// A direction with more than one component, or with one that is no number.
    #[error("the direction `{0}` is not along an axis of its body")]
    NotAlongAnAxis(String),
    /// A direction of gravity whose length is not known.
    #[error("the direction of gravity has no length that is known to be one")]
    Gravity,
    /// A rotation that is by no whole multiple of angles.
    #[error("the body `{0}` turns by an angle whose sine has no closed form")]
    Turn(String),
    /// A direction that takes pages.
    #[error("up, as the body of `{0}` sees it, is too long a formula")]
    TooLong(String),
}

impl SightAngle {
    /// Its value where the symbols have these values, by [`SymbolId`], SI: radians.
    #[must_use]
    pub fn value(&self, values: &[f64]) -> f64 {
        let [a, b] = self.across.each_ref().map(|part| part.eval(values));
        a.hypot(b).atan2(self.cosine.eval(values))
    }

    /// The symbols that its value depends on.
    pub fn depends_on(&self) -> impl Iterator<Item = SymbolId> {
        self.across.iter().chain([&self.cosine]).flat_map(Poly::symbols)
    }

    /// The small turns about two axes of the body that bend its direction up by `amount`, to first order in the amount; one that is
    /// zero is left out.
    ///
    /// With d the direction and u up, the turn is by the amount about d × u, whose length is the sine of the angle.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`].
    pub fn turns(&self, amount: &Poly) -> Result<Vec<(Axis, Poly)>, AlgebraError> {
        let sine = Poly::sin(&AngleSum::symbol(self.symbol));
        let over = sine.recip().unwrap_or_else(|| unreachable!("one over the sine of a symbol exists"));
        let over_sine = self.with_cosine(&(amount * &over))?;
        let over_sine = if self.axis.is_negative { -&over_sine } else { over_sine };
        let [a, b] = cyclic(self.axis.axis);
        let turns = [(a, -&(&self.across[1] * &over_sine)), (b, &self.across[0] * &over_sine)];
        Ok(turns.into_iter().filter(|(_, turn)| !turn.is_zero()).collect())
    }

    /// The bending of the direction up by an amount. Half of the first turn stands on either side of the second, so that together
    /// they are one turn about the horizontal across the direction, but for the third power of the amount.
    ///
    /// # Errors
    /// [`AlgebraError::TooLarge`].
    pub fn bending(&self, amount: &Poly, documentation: &str) -> Result<Bend, AlgebraError> {
        let factor = |axis: Axis, amount: Poly| Factor {
            role: Role::MotionError,
            kind: TransformKind::Rotation,
            axis,
            amount,
            documentation: documentation.to_owned(),
        };
        let half = Rational::half();
        let factors = match self.turns(amount)?.as_slice() {
            [(a, first), (b, second)] => vec![
                factor(*a, first.scale(&half)),
                factor(*b, second.clone()),
                factor(*a, first.scale(&half)),
            ],
            turns => turns.iter().map(|(axis, turn)| factor(*axis, turn.clone())).collect(),
        };
        Ok(Bend { amount: amount.clone(), factors })
    }

    /// The same amount with the polynomial in joints in place of the cosine of the angle, and of one over it where that exists.
    fn with_cosine(&self, amount: &Poly) -> Result<Poly, AlgebraError> {
        let over = self.cosine.recip();
        let terms: Vec<Poly> =
            amount.terms().map(|term| self.term(&term, over.as_ref())).collect::<Result<_, _>>()?;
        Ok(Poly::sum(&terms))
    }

    fn term(&self, term: &Term, over: Option<&Poly>) -> Result<Poly, AlgebraError> {
        let mut product = Poly::constant(term.coefficient.clone());
        for &(symbol, power) in &term.powers {
            product = &product * &Poly::symbol(symbol).pow(power)?;
        }
        let over_own_sine = term.poles.iter().any(|pole| pole.symbol == self.symbol && pole.sin_power > 0);
        for wave in &term.waves {
            let is_own = wave.symbol == self.symbol && wave.wave == Wave::Cos;
            let factor = if is_own && !over_own_sine && wave.harmonic <= HIGHEST_MULTIPLE {
                multiple(&self.cosine, wave.harmonic)
            } else {
                let angle = AngleSum::symbol(wave.symbol).times(wave.harmonic)?;
                if wave.wave == Wave::Cos { Poly::cos(&angle) } else { Poly::sin(&angle) }
            };
            product = &product * &factor;
        }
        for pole in &term.poles {
            let angle = AngleSum::symbol(pole.symbol);
            let reciprocal = |of: Poly| of.recip().unwrap_or_else(|| unreachable!("a symbol's wave has one"));
            let (below, power) = match over {
                Some(over) if pole.symbol == self.symbol && pole.cos_power > 0 => {
                    (over.clone(), pole.cos_power)
                }
                _ if pole.cos_power > 0 => (reciprocal(Poly::cos(&angle)), pole.cos_power),
                _ => (reciprocal(Poly::sin(&angle)), pole.sin_power),
            };
            product = &product * &below.pow(power)?;
        }
        Ok(product)
    }
}

/// The cosine of a multiple of an angle, by the cosine of the angle.
fn multiple(cosine: &Poly, times: u32) -> Poly {
    let (mut last, mut now) = (Poly::one(), cosine.clone());
    for _ in 1..times {
        let next = &(&(cosine * &now) + &(cosine * &now)) - &last;
        (last, now) = (now, next);
    }
    now
}

/// The two axes that follow an axis in the cyclic order x, y, z.
fn cyclic(axis: Axis) -> [Axis; 2] {
    match axis {
        Axis::X => [Axis::Y, Axis::Z],
        Axis::Y => [Axis::Z, Axis::X],
        Axis::Z => [Axis::X, Axis::Y],
    }
}

impl Chain {
    /// The angle between a direction and up that a symbol stands for.
    #[must_use]
    pub fn sight_angle(&self, symbol: SymbolId) -> Option<&SightAngle> {
        self.sight_angles.iter().find(|angle| angle.symbol == symbol)
    }

    /// The angle between an observable and up, if the chain has a name for it.
    #[must_use]
    pub fn sight_angle_of(&self, observable: ObservableId) -> Option<&SightAngle> {
        self.sight_angles.iter().find(|angle| angle.observable == observable)
    }

    /// Gives the angle between an observable and up to a symbol of the chain.
    ///
    /// # Errors
    /// [`SightError`], where there is no such angle.
    pub fn set_sight_angle(&mut self, symbol: SymbolId, observable: ObservableId) -> Result<(), SightError> {
        let axis = axis_of(self, observable)?;
        let name = || self.observable(observable).name.clone();
        let up = seen_from(self, self.observable(observable).body, up(self)?)?;
        if up.iter().any(|part| part.len() > MOST_TERMS) {
            return Err(SightError::TooLong(name()));
        }
        let along = &up[axis.axis.index()];
        let cosine = if axis.is_negative { -along } else { along.clone() };
        let across = cyclic(axis.axis).map(|axis| up[axis.index()].clone());
        self.sight_angles.push(SightAngle { symbol, observable, axis, cosine, across });
        Ok(())
    }

    /// A new name for the angle between an observable and up.
    ///
    /// # Errors
    /// [`SightError`], where there is no such angle, or the chain can have no more symbols.
    pub fn add_sight_angle(&mut self, name: &str, observable: ObservableId) -> Result<SymbolId, SightError> {
        let too_many = |_| SightError::TooLong(self.observable(observable).name.clone());
        let symbol = SymbolId(u16::try_from(self.symbols.len()).map_err(too_many)?);
        self.set_sight_angle(symbol, observable)?;
        self.symbols.push(Symbol {
            name: name.to_owned(),
            kind: SymbolKind::SightAngle,
            quantity: Quantity::Angle,
            meaning: None,
            of: None,
            documentation: format!("The angle between `{}` and up.", self.observable(observable).name),
            latex: format!("\\mathrm{{{}}}", name.replace('_', "\\_")),
            value: None,
        });
        Ok(symbol)
    }
}

/// The axis of its body that a direction is along.
fn axis_of(chain: &Chain, id: ObservableId) -> Result<SignedAxis, SightError> {
    let observable = chain.observable(id);
    if observable.kind != ObservableKind::Direction || observable.is_orientation() {
        return Err(SightError::NotADirection(observable.name.clone()));
    }
    let mut along = [Axis::X, Axis::Y, Axis::Z]
        .into_iter()
        .zip(&observable.components)
        .filter(|(_, part)| !part.is_zero());
    match (along.next().map(|(axis, part)| (axis, part.as_constant())), along.next()) {
        (Some((axis, Some(size))), None) => Ok(SignedAxis { axis, is_negative: size.is_negative() }),
        _ => Err(SightError::NotAlongAnAxis(observable.name.clone())),
    }
}

/// Up in the ground frame, of length one.
fn up(chain: &Chain) -> Result<[Poly; 3], SightError> {
    let square = chain.gravity.iter().fold(Poly::zero(), |sum, part| &sum + &(part * part));
    let length = square.as_constant().and_then(|square| square.square_root()).ok_or(SightError::Gravity)?;
    let over = length.recip().ok_or(SightError::Gravity)?;
    Ok(chain.gravity.each_ref().map(|part| -&part.scale(&over)))
}

/// A vector of the ground frame as a body sees it, errors at zero.
fn seen_from(chain: &Chain, body: BodyId, vector: [Poly; 3]) -> Result<[Poly; 3], SightError> {
    let is_error = |symbol| chain.symbol(symbol).kind == SymbolKind::Error;
    let mut seen = vector;
    for id in chain.path(body) {
        let body = chain.body(id);
        for factor in body.factors.iter().filter(|factor| factor.kind == TransformKind::Rotation) {
            let nominal = factor.amount.graded_part(is_error, 0);
            if nominal.is_zero() {
                continue;
            }
            let angle = AngleSum::from_poly(&nominal).map_err(|_| SightError::Turn(body.name.clone()))?;
            let (cosine, sine) = angle.cos_sin();
            let [a, b] = cyclic(factor.axis).map(Axis::index);
            let turned =
                [&(&cosine * &seen[a]) + &(&sine * &seen[b]), &(&cosine * &seen[b]) - &(&sine * &seen[a])];
            [seen[a], seen[b]] = turned;
            if seen.iter().any(|part| part.len() > MOST_TERMS) {
                return Err(SightError::TooLong(body.name.clone()));
            }
        }
    }
    Ok(seen)
}
