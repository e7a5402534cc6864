//! The domain of a bound: how large errors may be, and where joints, inputs and constants lie.

use super::interval::Interval;
use super::upper::Upper;
use crate::algebra::{Pole, Term, Wave};
use crate::chain::Chain;
use crate::forms::FormError;
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
    /// A reading that is no smooth function of the errors where they are zero.
    #[error(
        "no bound is proven for the {reading} of `{observable}`: where there are no errors it is no smooth function of them; \
         bound its vector: `x, y, z of …`"
    )]
    NoProof {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
    },
    /// A vector that can come to the axis that an angle goes about, or to the origin.
    #[error(
        "the {reading} of `{observable}` is lost near {place}, where its vector may come as close to {lost} as the errors reach; \
         state ranges that keep away, or take its vector: `x, y, z of …`"
    )]
    Lost {
        /// The observable.
        observable: String,
        /// The reading in words.
        reading: String,
        /// Where, in words.
        place: String,
        /// To what it comes.
        lost: &'static str,
    },
    /// Turns that add up to more than the bound of orientations is derived for.
    #[error(
        "no bound is proven for how `{observable}` is turned: the errors on its way add up to {sum_rad:.3} rad, and it is derived \
         up to 1 rad; state smaller sizes"
    )]
    Turned {
        /// The observable.
        observable: String,
        /// What the errors add up to.
        sum_rad: f64,
    },
    /// Angles and lengths have no common length.
    #[error("{observable} shows {one} and {other}, whose errors are not of one unit: observe them apart")]
    Units {
        /// The observable.
        observable: String,
        /// What it shows first.
        one: &'static str,
        /// What has another unit.
        other: &'static str,
    },
    /// The observable has no first-order form.
    #[error(transparent)]
    Form(#[from] FormError),
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
    /// The same of an angle between a line of sight and up.
    #[error(
        "`{name}` follows from the joints and may pass a place where the {function} in a denominator is zero; \
         state ranges of the joints that keep away"
    )]
    SingularSight {
        /// The angle.
        name: String,
        /// `sine` or `cosine`.
        function: &'static str,
    },
}

impl DomainError {
    /// A denominator that vanishes.
    pub(super) fn singular(chain: &Chain, symbol: SymbolId, of_sine: bool) -> Self {
        let name = chain.symbol(symbol).name.clone();
        let function = if of_sine { "sine" } else { "cosine" };
        match chain.symbol(symbol).kind {
            SymbolKind::SightAngle => Self::SingularSight { name, function },
            _ => Self::Singular { name, function },
        }
    }
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
            SymbolKind::SightAngle => Some([0.0, std::f64::consts::PI.next_up()]),
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
        self.follow(chain);
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

    /// Narrows the angles of lines of sight to what the other ranges leave of them.
    fn follow(&mut self, chain: &Chain) {
        /// More than an arc cosine is rounded by.
        const ROUNDING_RAD: f64 = 1e-14;
        for angle in &chain.sight_angles {
            let Ok(cosine) = self.enclose(chain, &angle.cosine) else { continue };
            let [high, low] = [cosine.low, cosine.high].map(|cosine| cosine.clamp(-1.0, 1.0).acos());
            self.ranges[angle.symbol.index()] = Some([(low - ROUNDING_RAD).max(0.0), high + ROUNDING_RAD]);
        }
    }

    /// By the number of each symbol.
    pub(super) fn of_ranges(ranges: Vec<Option<[f64; 2]>>) -> Self {
        Self { ranges }
    }

    /// The same with other ranges of some symbols.
    pub(crate) fn with(&self, symbols: &[SymbolId], ranges: &[[f64; 2]]) -> Self {
        let mut domain = self.clone();
        for (symbol, range) in symbols.iter().zip(ranges) {
            domain.ranges[symbol.index()] = Some(*range);
        }
        domain
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
        // What is left out has no poles either.
        if size.is_zero() {
            return Ok(size);
        }
        // Sines and cosines are at most one, and less in a range; over a pole, they go with it.
        for wave in term.waves.iter().filter(|wave| term.poles.iter().all(|pole| pole.symbol != wave.symbol))
        {
            let Some(range) = self.range(wave.symbol) else { continue };
            let angle = Interval::new(range) * Interval::exact(f64::from(wave.harmonic));
            let value = if wave.wave == Wave::Sin { angle.sin() } else { angle.cos() };
            size = size * Upper::exact(value.magnitude()).min(Upper::ONE);
        }
        for pole in &term.poles {
            let wave = term.waves.iter().find(|wave| wave.symbol == pole.symbol).map(|wave| wave.wave);
            size = size * self.pole(chain, pole, wave)?;
        }
        Ok(size)
    }

    /// The largest size of 1/cosᵏ θ, or of sin θ/cosᵏ θ with a wave; and the same with sine and cosine exchanged.
    fn pole(&self, chain: &Chain, pole: &Pole, wave: Option<Wave>) -> Result<Upper, DomainError> {
        let of_sine = pole.sin_power > 0;
        let singular = || DomainError::singular(chain, pole.symbol, of_sine);
        let range = Interval::new(self.range(pole.symbol).ok_or_else(singular)?);
        let least = if of_sine { range.sin() } else { range.cos() }.least_size();
        let over = Upper::ONE.over(least).ok_or_else(singular)?.powi(pole.sin_power.max(pole.cos_power));
        let above = match wave {
            Some(_) => Upper::rounded((1.0 - (least * least).next_down()).next_up().max(0.0).sqrt()),
            None => Upper::ONE,
        };
        Ok(over * above)
    }
}
