//! A residual component, and what it hangs on.

use nalgebra::Vector3;

use crate::unknowns::WIDTH;

/// Measured minus predicted, and the gradient of what is predicted by the observable's x, y, z.
pub(super) type Part = (f64, Vector3<f64>);

/// A component of a row that observes an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Component {
    pub part: Part,
    /// The derivatives of what is predicted by the numbers of the object, then by those of the station.
    pub unknown: [f64; WIDTH],
}
