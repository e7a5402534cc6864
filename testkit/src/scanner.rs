//! A scanner in a room.

use nalgebra::{Matrix3, Vector3};

use crate::rotation;

/// The scanner of `examples/objects/scanner.chain` without errors, where it stands: written out here, so that nothing of the
/// project says where a beam ends.
#[derive(Debug, Clone)]
pub struct Stand {
    /// From the scanner to the room.
    pub turn: Matrix3<f64>,
    /// Where it stands, m.
    pub shift: Vector3<f64>,
}

impl Stand {
    /// At a place, m, turned about the vertical, rad.
    #[must_use]
    pub fn new(shift: [f64; 3], heading: f64) -> Self {
        Self { turn: rotation(2, heading), shift: Vector3::from(shift) }
    }

    /// Azimuth, elevation, rad, and range, m, of a point in either face.
    #[must_use]
    pub fn read(&self, point: &Vector3<f64>, face: usize) -> [f64; 3] {
        let local = self.turn.transpose() * (point - self.shift);
        let (azimuth, elevation) = (local.x.atan2(local.y), (local.z / local.norm()).asin());
        let pi = std::f64::consts::PI;
        match face {
            0 => [azimuth, elevation, local.norm()],
            _ => [azimuth + if azimuth > 0.0 { -pi } else { pi }, pi - elevation, local.norm()],
        }
    }
}
