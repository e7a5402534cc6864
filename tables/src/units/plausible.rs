//! Bare numbers that are hardly in SI: degrees taken for radians, millimetres for metres.

use std::fmt;

use model_core::chain::TransformKind;
use model_core::{Chain, ObservableId, ObservableKind, Quantity, Role, SymbolId, SymbolKind};

use super::Amount;

/// Readings of a joint beyond a turn and a bit were hardly meant in radians.
const FARTHEST_READING_RAD: f64 = 6.5;
/// A small angle (an error) above this was hardly meant in radians.
const LARGEST_ERROR_RAD: f64 = 0.2;
/// A standard deviation above this was hardly meant in radians.
const LARGEST_NOISE_RAD: f64 = 0.01;
/// A standard deviation above this was hardly meant in metres, where the chain says no length to compare with.
const LARGEST_NOISE_M: f64 = 0.1;
/// A standard deviation above this share of the largest length of its chain was hardly meant in metres.
const NOISE_OF_SIZE: f64 = 0.1;
/// How many times the largest length of its chain a joint hardly travels.
const FARTHEST_TRAVEL: f64 = 100.0;

/// How large bare numbers may be before they are hardly in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plausible {
    largest_angle_rad: f64,
    /// None where the chain says no length to compare with.
    largest_length_m: Option<f64>,
    /// The unit of angles that is meant most often where a bare number is too large for radians.
    likely_angle: &'static str,
}

impl Plausible {
    /// The readings of a joint or input. A measured length need not have anything to do with the chain's.
    #[must_use]
    pub fn readings(chain: &Chain, symbol: SymbolId) -> Self {
        let is_joint = chain.symbol(symbol).kind == SymbolKind::Joint;
        Self::far(travel_m(chain).filter(|_| is_joint))
    }

    /// What is measured of an observable. How far the target of a measured range is says nothing of the size of the
    /// instrument.
    #[must_use]
    pub fn measured(chain: &Chain, observable: ObservableId) -> Self {
        let components = &chain.observable(observable).components;
        let moves = |id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input);
        let is_fixed = !components.iter().flat_map(|amount| chain.symbols_in(amount)).any(moves);
        Self::far(travel_m(chain).filter(|_| is_fixed))
    }

    fn far(largest_length_m: Option<f64>) -> Self {
        Self { largest_angle_rad: FARTHEST_READING_RAD, largest_length_m, likely_angle: "deg" }
    }

    /// Errors of a chain.
    #[must_use]
    pub fn errors(chain: &Chain) -> Self {
        let largest_length_m = largest_length_m(chain);
        Self { largest_angle_rad: LARGEST_ERROR_RAD, largest_length_m, likely_angle: "arcsec" }
    }

    /// Standard deviations of what a chain shows.
    #[must_use]
    pub fn noise(chain: &Chain) -> Self {
        let largest = largest_length_m(chain).map_or(LARGEST_NOISE_M, |size| NOISE_OF_SIZE * size);
        Self { largest_angle_rad: LARGEST_NOISE_RAD, largest_length_m: Some(largest), likely_angle: "arcsec" }
    }

    /// Whether a bare number, taken as SI, is hardly in SI.
    #[must_use]
    pub fn refuses(&self, quantity: Quantity, number: f64) -> bool {
        match quantity {
            Quantity::Angle => number.abs() > self.largest_angle_rad,
            Quantity::Length => self.largest_length_m.is_some_and(|largest| number.abs() > largest),
            Quantity::Number => false,
        }
    }

    /// The unit that is meant most often where a bare number is too large for the SI unit.
    fn likely(&self, quantity: Quantity) -> &'static str {
        match quantity {
            Quantity::Angle => self.likely_angle,
            Quantity::Length => "mm",
            Quantity::Number => "1",
        }
    }

    /// A remark if one of some amounts is a bare number that is hardly in SI: `written` is what stands there, and `meant` what
    /// to write with the unit that is likely.
    #[must_use]
    pub fn doubt(
        &self,
        quantity: Quantity,
        amounts: &[Amount],
        written: &str,
        meant: impl FnOnce(&str) -> String,
    ) -> Option<Doubt> {
        let bare = |amount: &Amount| amount.unit.is_none() && self.refuses(quantity, amount.number);
        amounts.iter().any(bare).then(|| Doubt {
            written: written.to_owned(),
            taken: match amounts {
                [one] => format!("{} {}", one.number, quantity.unit()),
                _ => quantity.unit().to_owned(),
            },
            meant: meant(self.likely(quantity)),
        })
    }
}

/// A bare number that somebody wrote and that is hardly in SI.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Doubt {
    written: String,
    taken: String,
    meant: String,
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { written, taken, meant } = self;
        write!(f, "{written} has no unit and is taken as {taken}; did you mean {meant}?")
    }
}

/// How far a joint of a chain may travel.
fn travel_m(chain: &Chain) -> Option<f64> {
    largest_length_m(chain).map(|size| FARTHEST_TRAVEL * size)
}

/// The largest length that a chain says: of a constant, of a fixed shift, of a point.
fn largest_length_m(chain: &Chain) -> Option<f64> {
    let constants = chain
        .symbols_of(SymbolKind::Constant)
        .map(|id| chain.symbol(id))
        .filter(|constant| constant.quantity == Quantity::Length)
        .filter_map(|constant| constant.value);
    let fixed = chain
        .bodies
        .iter()
        .flat_map(|body| &body.factors)
        .filter(|factor| factor.role == Role::Position && factor.kind == TransformKind::Translation);
    let points = chain.observables.iter().filter(|shown| shown.kind == ObservableKind::Point);
    let written = fixed.map(|factor| &factor.amount).chain(points.flat_map(|shown| &shown.components));
    let written = written.filter_map(|amount| amount.as_constant()).map(|amount| amount.to_f64());
    let largest = constants.chain(written).map(f64::abs).fold(0.0, f64::max);
    (largest > 0.0).then_some(largest)
}

/// A column of numbers whose unit nothing says, and how far they reach.
#[derive(Debug, Clone, PartialEq)]
pub struct BareColumn {
    file: String,
    column: String,
    quantity: Quantity,
    plausible: Plausible,
    farthest_si: f64,
}

impl BareColumn {
    /// A column of numbers, taken as SI; no number seen yet.
    #[must_use]
    pub fn new(plausible: Plausible, quantity: Quantity, column: &str, file: &str) -> Self {
        Self { file: file.to_owned(), column: column.to_owned(), quantity, plausible, farthest_si: 0.0 }
    }

    /// Takes note of numbers of the column.
    pub fn see(&mut self, numbers: &[f64]) {
        let farther =
            |farthest: f64, number: &f64| if number.abs() > farthest.abs() { *number } else { farthest };
        self.farthest_si = numbers.iter().fold(self.farthest_si, farther);
    }

    /// Whether its numbers are hardly in SI.
    #[must_use]
    pub fn is_doubtful(&self) -> bool {
        self.plausible.refuses(self.quantity, self.farthest_si)
    }
}

impl fmt::Display for BareColumn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, column, farthest_si: farthest, .. } = self;
        let (si, likely) = (self.quantity.unit(), self.plausible.likely(self.quantity));
        write!(
            f,
            "{file}: column `{column}` reaches {farthest} and has no unit; it is taken as {si}: if it is in {likely}, write \
             `{column} [{likely}]` in the header, and `{column} [{si}]` if not"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GANTRY: &str = "chain Gantry {
        const arm: length = 0.25;
        input range: length;
        body carriage on ground { motion: Tx(u); motion_error: Tx(du); }
        body head on carriage { position: Tz(arm); motion: Rz(turn); motion_error: Rz(dt); }
        observe tip: point(0, 0.1, range) of head;
    }";

    #[test]
    fn degrees_and_millimetres_are_doubted_and_radians_and_metres_are_not() {
        let chain = Chain::from_text(GANTRY).ok();
        let doubted = |name: &str, number: f64| {
            let chain = chain.as_ref()?;
            let symbol = chain.find_symbol(name)?;
            let (plausible, quantity) = (Plausible::readings(chain, symbol), chain.symbol(symbol).quantity);
            let mut column = BareColumn::new(plausible, quantity, name, "f.csv");
            column.see(&[0.1, number, -0.2]);
            Some(column.is_doubtful())
        };
        for (name, number, expected) in [
            ("turn", 44.0, true),
            ("turn", -270.0, true),
            ("turn", 6.4, false),
            ("turn", -3.2, false),
            ("u", 250.0, true),
            ("u", -900.0, true),
            ("u", 4.0, false),
            // How far a target is says nothing of the size of the instrument.
            ("range", 3000.0, false),
        ] {
            assert_eq!(doubted(name, number), Some(expected), "{name} {number}");
        }
    }

    #[test]
    fn errors_are_small() {
        let errors = Chain::from_text(GANTRY).map(|chain| Plausible::errors(&chain));
        let refuses = |quantity, number| errors.as_ref().map(|errors| errors.refuses(quantity, number)).ok();
        assert_eq!(refuses(Quantity::Angle, 2.0), Some(true));
        assert_eq!(refuses(Quantity::Angle, 1e-3), Some(false));
        assert_eq!(refuses(Quantity::Length, -0.5), Some(true));
        assert_eq!(refuses(Quantity::Length, 1e-3), Some(false));
        assert_eq!(refuses(Quantity::Number, 1e9), Some(false));
    }
}
