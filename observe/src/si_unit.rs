//! The SI unit of a number as a type: powers of the radian, the metre, the kelvin, the second and the pixel.

use std::fmt;

use model_core::Quantity;
use serde::{Serialize, Serializer};

/// A product of powers of the base units that coefficients are made of; `1` for a plain number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct SiUnit {
    rad: i8,
    metre: i8,
    kelvin: i8,
    second: i8,
    pixel: i8,
}

impl SiUnit {
    /// A plain number.
    pub const ONE: Self = Self { rad: 0, metre: 0, kelvin: 0, second: 0, pixel: 0 };
    /// The radian.
    pub const RAD: Self = Self { rad: 1, ..Self::ONE };
    /// The metre.
    pub const METRE: Self = Self { metre: 1, ..Self::ONE };
    /// The kelvin.
    pub const KELVIN: Self = Self { kelvin: 1, ..Self::ONE };
    /// The second.
    pub const SECOND: Self = Self { second: 1, ..Self::ONE };
    /// The pixel of a camera.
    pub const PIXEL: Self = Self { pixel: 1, ..Self::ONE };

    /// The unit of a product.
    #[must_use]
    pub const fn times(self, other: Self) -> Self {
        Self {
            rad: self.rad.saturating_add(other.rad),
            metre: self.metre.saturating_add(other.metre),
            kelvin: self.kelvin.saturating_add(other.kelvin),
            second: self.second.saturating_add(other.second),
            pixel: self.pixel.saturating_add(other.pixel),
        }
    }

    /// The unit of a quotient.
    #[must_use]
    pub const fn per(self, other: Self) -> Self {
        self.times(other.power(-1))
    }

    /// The unit of a power.
    #[must_use]
    pub const fn power(self, power: i8) -> Self {
        Self {
            rad: self.rad.saturating_mul(power),
            metre: self.metre.saturating_mul(power),
            kelvin: self.kelvin.saturating_mul(power),
            second: self.second.saturating_mul(power),
            pixel: self.pixel.saturating_mul(power),
        }
    }

    /// The unit of this one's multiples that is neither angle, length nor pixel: `rad/K` is `rad` and `/K`.
    #[must_use]
    pub const fn split(self) -> (Self, Self) {
        match self {
            Self { rad: 1, metre, .. } if metre <= 0 => (Self::RAD, self.per(Self::RAD)),
            Self { metre: 1, rad, .. } if rad <= 0 => (Self::METRE, self.per(Self::METRE)),
            Self { pixel: 1, rad, metre, .. } if rad <= 0 && metre <= 0 => {
                (Self::PIXEL, self.per(Self::PIXEL))
            }
            _ => (Self::ONE, self),
        }
    }
}

impl From<Quantity> for SiUnit {
    fn from(quantity: Quantity) -> Self {
        match quantity {
            Quantity::Angle => Self::RAD,
            Quantity::Length => Self::METRE,
            Quantity::Number => Self::ONE,
        }
    }
}

impl fmt::Display for SiUnit {
    /// `rad`, `m`, `1`, `rad/K`, `m/rad`, `1/m`, `rad/m^2`.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.rad, "rad"),
            (self.metre, "m"),
            (self.kelvin, "K"),
            (self.second, "s"),
            (self.pixel, "px"),
        ];
        let written = |name: &str, power: i8| match power {
            1 => name.to_owned(),
            power => format!("{name}^{power}"),
        };
        let above: Vec<String> =
            parts.iter().filter(|(p, _)| *p > 0).map(|&(p, name)| written(name, p)).collect();
        out.write_str(&if above.is_empty() { "1".to_owned() } else { above.join("*") })?;
        for (power, name) in parts.into_iter().filter(|&(power, _)| power < 0) {
            write!(out, "/{}", written(name, power.saturating_neg()))?;
        }
        Ok(())
    }
}

impl Serialize for SiUnit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::SiUnit;

    #[test]
    fn units_are_written_out() {
        let per = |a: SiUnit, b| a.per(b).to_string();
        assert_eq!(per(SiUnit::RAD, SiUnit::KELVIN), "rad/K");
        assert_eq!(per(SiUnit::METRE, SiUnit::RAD), "m/rad");
        assert_eq!(per(SiUnit::RAD, SiUnit::RAD), "1");
        assert_eq!(per(SiUnit::ONE, SiUnit::METRE.power(2)), "1/m^2");
        assert_eq!(SiUnit::RAD.times(SiUnit::SECOND).to_string(), "rad*s");
        assert_eq!(SiUnit::RAD.per(SiUnit::KELVIN).split().1.to_string(), "1/K");
    }
}
