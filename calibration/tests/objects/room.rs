//! A scanner in a room.

use nalgebra::{Matrix3, Vector3};

/// The scanner of `examples/objects/scanner.chain` without errors, where it stands: written out here, so that nothing of the
/// project says where a beam ends.
#[derive(Clone)]
pub struct Stand {
    pub turn: Matrix3<f64>,
    pub shift: Vector3<f64>,
}

impl Stand {
    pub fn new(shift: [f64; 3], heading: f64) -> Self {
        let (sine, cosine) = heading.sin_cos();
        let turn = Matrix3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0);
        Self { turn, shift: Vector3::from(shift) }
    }

    /// Azimuth, elevation and range of a point in either face.
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

/// Numbers that look random, of variance one.
pub struct Noise(pub u64);

impl Noise {
    pub fn uniform(&mut self) -> f64 {
        // Source: G. Marsaglia, Xorshift RNGs, Journal of Statistical Software 8 (2003).
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}
