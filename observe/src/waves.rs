//! Sines and cosines of whole columns of angles at once.

use codegen::vector::{self, Arithmetic, ROWS, Waves, sin_cos_rows, whole};

/// The sine and the cosine of a multiple of each angle, rad.
pub fn waves(angles: &[f64], multiple: f64) -> [Vec<f64>; 2] {
    let mut sine: Vec<f64> = angles.iter().map(|angle| multiple * angle).collect();
    let mut cosine = vec![0.0; sine.len()];
    vector::run(vector::path(), Column { sine: &mut sine, cosine: &mut cosine });
    [sine, cosine]
}

/// Angles that become their sines, and room for their cosines.
struct Column<'a> {
    sine: &'a mut [f64],
    cosine: &'a mut [f64],
}

impl vector::Work for Column<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, arithmetic: A) {
        for (sine, cosine) in self.sine.chunks_mut(ROWS).zip(self.cosine.chunks_mut(ROWS)) {
            let (mut waves, mut space) = (Waves::NEW, None);
            let (s, c) = sin_cos_rows(arithmetic, whole(sine, &mut space), &mut waves);
            let count = sine.len();
            cosine.copy_from_slice(&c[..count]);
            sine.copy_from_slice(&s[..count]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_any_length_have_the_waves_of_their_angles() {
        for count in [0, 1, 63, 64, 65, 200] {
            let angles: Vec<f64> = (0..count).map(|at| f64::from(at) * 0.37 - 20.0).collect();
            let [sine, cosine] = waves(&angles, 3.0);
            assert_eq!((sine.len(), cosine.len()), (angles.len(), angles.len()));
            for ((sine, cosine), angle) in sine.iter().zip(&cosine).zip(&angles) {
                let (s, c) = (3.0 * angle).sin_cos();
                assert!((sine - s).abs() < 1e-15 && (cosine - c).abs() < 1e-15, "{angle}");
            }
        }
        assert!(waves(&[f64::NAN, f64::INFINITY], 1.0).iter().flatten().all(|value| value.is_nan()));
    }
}
