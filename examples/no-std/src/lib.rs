//! The correction of a pan and tilt head, as its controller would compute it: without the standard library, with
//! sines and cosines from `libm`.
//!
//! Built alone (`cargo build -p trueaxis-no-std`), nothing of it links the standard library.
#![no_std]

use pan_tilt::{Errors, Joints, PanTilt};

trueaxis::chain! {
    /// A pan and tilt head.
    chain PanTilt {
        /// What turns about the vertical.
        body pan_head on ground {
            /// Tilt of the pan axis.
            position_error: Rx(lean_x), Ry(lean_y);
            /// Pan by the encoder.
            motion:         Rz(pan);
        }
        /// What carries the camera.
        body camera on pan_head {
            /// The tilt axis against the perpendicular to the pan axis.
            position_error: Rx(skew);
            /// Tilt by the encoder.
            motion:         Ry(tilt);
            /// The camera nods under its weight.
            motion_error:   Ry(sag*cos(tilt));
        }
        /// Where the camera looks.
        observe sight: direction(1, 0, 0) of camera;
    }
}

/// Where the camera really looks: a unit vector in the ground frame, for encoder readings in radians.
#[must_use]
pub fn true_sight(errors: Errors, pan_rad: f64, tilt_rad: f64) -> [f64; 3] {
    PanTilt::new(errors).sight(&Joints { pan: pan_rad, tilt: tilt_rad }).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_perfect_head_looks_where_its_encoders_say() {
        let [x, y, z] = true_sight(Errors::default(), core::f64::consts::FRAC_PI_2, 0.0);
        assert!(x.abs() < 1e-15 && (y - 1.0).abs() < 1e-15 && z.abs() < 1e-15);
    }

    #[test]
    fn a_sagging_camera_looks_down_by_its_sag() {
        let [_, _, z] = true_sight(Errors { sag: 1e-3, ..Errors::default() }, 0.0, 0.0);
        assert!((z + 1e-3_f64).abs() < 1e-9);
    }
}
