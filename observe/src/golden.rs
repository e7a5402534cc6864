//! Steps of the golden section: numbers spread evenly over a range, however many there are, that meet no period of what lies in it.

/// The golden section: of all numbers the one that fractions come least near to.
pub(crate) const SECTION: f64 = 0.618_033_988_749_894_9;

/// How far along a range a number comes to lie, as a share of it.
pub fn share(number: usize) -> f64 {
    (number as f64 * SECTION).fract()
}
