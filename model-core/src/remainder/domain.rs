//! The domain of a bound: how large errors may be, and where joints, inputs and constants lie.

use dashu_float::{FBig, round::mode};

use super::upper::Upper;
use crate::algebra::{Pole, Term, Wave};
use crate::chain::Chain;
use crate::symbol::{SymbolId, SymbolKind};

/// A box of errors, with ranges of joints and inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Domain {
    /// By [`SymbolId`]; `None` is unlimited.
    ranges: Vec<Option<[f64; 2]>>,
}

/// Why a domain cannot be, or does not do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DomainError {
    /// A size or range that is no range.
    #[error("`{name}` cannot lie between {low} and {high}: a range runs from a finite number up to another")]
    NoRange {
        /// The symbol.
        name: String,
        /// The lower end given.
        low: f64,
        /// The upper end given.
        high: f64,
    },
    /// A symbol without range stands outside of sines and cosines.
    #[error("the form has no bound unless `{name}` has a range; state one, for example `{name} = 0..1`")]
    RangeNeeded {
        /// The symbol.
        name: String,
    },
    /// Something else than components of a vector is shown.
    #[error("no bound is proven for the {reading} of `{observable}`; bound its vector: `x, y, z of …`")]
    NoProof {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
    },
    /// A range in which a denominator vanishes.
    #[error(
        "`{name}` passes a place where the {function} in a denominator is zero; state a range that keeps away"
    )]
    Singular {
        /// The symbol.
        name: String,
        /// `sine` or `cosine`.
        function: &'static str,
    },
}

impl Domain {
    /// No errors at all, constants at their values, joints and inputs anywhere.
    #[must_use]
    pub fn new(chain: &Chain) -> Self {
        let range = |symbol: &crate::Symbol| match symbol.kind {
            // π lies between two neighbouring floats.
            SymbolKind::Pi => Some([std::f64::consts::PI, std::f64::consts::PI.next_up()]),
            SymbolKind::Error => Some([0.0, 0.0]),
            SymbolKind::Constant => symbol.value.map(|value| [value, value]),
            SymbolKind::Ramp => Some([0.0, 1.0]),
            SymbolKind::Joint | SymbolKind::Input => None,
        };
        Self { ranges: chain.symbols.iter().map(range).collect() }
    }

    /// Lets a symbol lie anywhere between two numbers, in SI units.
    ///
    /// # Errors
    /// [`DomainError::NoRange`] if the ends are not finite or the wrong way round.
    pub fn set_range(
        &mut self,
        chain: &Chain,
        symbol: SymbolId,
        low: f64,
        high: f64,
    ) -> Result<(), DomainError> {
        if !(low.is_finite() && high.is_finite() && low <= high) {
            return Err(DomainError::NoRange { name: chain.symbol(symbol).name.clone(), low, high });
        }
        self.ranges[symbol.index()] = Some([low, high]);
        Ok(())
    }

    /// Lets a symbol lie anywhere between −size and size, in SI units.
    ///
    /// # Errors
    /// [`DomainError::NoRange`] if the size is negative or not finite.
    pub fn set_size(&mut self, chain: &Chain, symbol: SymbolId, size: f64) -> Result<(), DomainError> {
        self.set_range(chain, symbol, -size, size)
    }

    /// Between what a symbol lies; `None` if anywhere.
    #[must_use]
    pub fn range(&self, symbol: SymbolId) -> Option<[f64; 2]> {
        self.ranges.get(symbol.index()).copied().flatten()
    }

    /// The largest size of a term.
    pub(super) fn size(&self, chain: &Chain, term: &Term) -> Result<Upper, DomainError> {
        let coefficient = match term.coefficient.to_integer() {
            Some(whole) if whole.unsigned_abs() < 1 << 53 => Upper::exact(whole as f64),
            _ => Upper::rounded(term.coefficient.to_f64()),
        };
        let mut size = coefficient;
        for &(symbol, power) in &term.powers {
            let [low, high] = self
                .range(symbol)
                .ok_or_else(|| DomainError::RangeNeeded { name: chain.symbol(symbol).name.clone() })?;
            size = size * Upper::exact(low).max(Upper::exact(high)).powi(power);
        }
        // Sines and cosines are at most one; over a pole, they go with it.
        for pole in &term.poles {
            let wave = term.waves.iter().find(|wave| wave.symbol == pole.symbol).map(|wave| wave.wave);
            size = size * self.pole(chain, pole, wave)?;
        }
        Ok(size)
    }

    /// The largest size of 1/cosᵏ θ, or of sin θ/cosᵏ θ with a wave; and the same with sine and cosine exchanged.
    fn pole(&self, chain: &Chain, pole: &Pole, wave: Option<Wave>) -> Result<Upper, DomainError> {
        let name = || chain.symbol(pole.symbol).name.clone();
        let of_sine = pole.sin_power > 0;
        let singular =
            || DomainError::Singular { name: name(), function: if of_sine { "sine" } else { "cosine" } };
        let [low, high] = self.range(pole.symbol).ok_or_else(singular)?;
        // Zeros of the denominator are whole turns of π from here.
        let zero_rad = if of_sine { 0.0 } else { std::f64::consts::FRAC_PI_2 };
        let piece = |angle_rad: f64, sign: f64| {
            let halves = (angle_rad - zero_rad) / std::f64::consts::PI;
            (halves + sign * (1e-9 + 1e-12 * halves.abs())).floor()
        };
        if piece(low, -1.0) != piece(high, 1.0) {
            return Err(singular());
        }
        // Between its zeros the denominator is smallest at an end of the range.
        let least =
            [low, high].map(|angle_rad| toward_zero(angle_rad, of_sine)).into_iter().fold(1.0, f64::min);
        if least <= 0.0 {
            return Err(singular());
        }
        let over = Upper::rounded(1.0 / least).powi(pole.sin_power.max(pole.cos_power));
        let above = match wave {
            Some(_) => Upper::rounded((1.0 - (least * least).next_down()).next_up().max(0.0).sqrt()),
            None => Upper::ONE,
        };
        Ok(over * above)
    }
}

/// |sin| or |cos| of an angle, rounded toward zero.
fn toward_zero(angle_rad: f64, sine: bool) -> f64 {
    /// Bits carried; more than the 53 of the result.
    const PRECISION: usize = 80;
    let Ok(angle) = FBig::<mode::Zero, 2>::try_from(angle_rad) else { return 0.0 };
    let angle = angle.with_precision(PRECISION).value();
    let value = if sine { angle.sin() } else { angle.cos() };
    value.to_f64().value().abs()
}
