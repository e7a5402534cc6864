//! The remainder of angles and ranges: what a reading makes of a vector whose error and remainder are bounded.
//!
//! With v the vector without errors, d its error, D a bound on |d| and B one on the remainder of v, each number below is a
//! bound on exact minus first order. The derivations are in the book, page "Remainder".

use super::interval::Interval;
use super::upper::Upper;
use crate::chain::reading::Measures;

/// A vector in a box of joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// |v|² lies here.
    pub(super) square: Interval,
    /// The square of the distance from the axis of an angle lies here.
    pub(super) across: Interval,
    /// The largest size of the component along that axis.
    pub(super) along: Upper,
    /// D
    pub(super) error: Upper,
    /// B
    pub(super) remainder: Upper,
}

impl Seen {
    /// The bound of one reading; infinite where the vector may come as near to the axis as its errors reach.
    pub(super) fn bound(&self, measures: Measures) -> f64 {
        if self.error.is_zero() {
            return 0.0;
        }
        let (error, rest) = (self.error, self.remainder);
        let (length, distance) = (self.square.least_root(), self.across.least_root());
        // A distance less what the errors can take away from it.
        let left = |distance: f64| (distance - error.get()).next_down();
        let bound = match measures {
            Measures::Component(_) => Some(rest),
            // |Im(log(1 + w) − w)| ≤ u²/(2(1 − u)) with u = D/ρ.
            Measures::Azimuth { .. } => rest.over(distance).and_then(|of_rest| {
                let turned = (error * error).half().over(left(distance))?.over(distance)?;
                Some(of_rest + turned)
            }),
            Measures::CrossElevation { .. } => rest.over(length).and_then(|of_rest| {
                let turned = (error * error).half().over(left(distance))?.over(length)?;
                Some(of_rest + turned)
            }),
            Measures::Elevation { .. } | Measures::ZenithDistance { .. } => self.elevation(length, distance),
            Measures::Range => (error * error).half().over(left(length)).map(|longer| rest + longer),
            Measures::OffAxis | Measures::Rotation(_) | Measures::Image(_) => {
                unreachable!("of these no vector says how far they are off")
            }
        };
        bound.map_or(f64::INFINITY, Upper::get)
    }

    /// All of the error along the meridian, or all of it across: the bound is linear between the two.
    fn elevation(&self, length: f64, distance: f64) -> Option<Upper> {
        let (error, rest) = (self.error, self.remainder);
        let left = (distance - error.get()).next_down();
        let square = error * error;
        let turned = square.half().over((length - error.get()).next_down())?.over(length)?;
        // How much the distance from the axis grows by an error across, to the size of that error.
        let grown = error.over(left)?;
        let carried = turned * (grown + (grown * grown).half().half());
        let bent = (square * self.along).half().over(left)?.over(length)?.over(length)?;
        Some(rest.over(length)? + turned.max(carried + bent))
    }
}
