//! Where a camera sees a point: the pinhole model with radial and tangential distortion.
//!
//! With X, Y, Z the point in the frame of the camera, which looks along z, x = X/Z, y = Y/Z and r² = x² + y²:
//!
//! - x′ = x (1 + k1 r² + k2 r⁴) + 2 p1 x y + p2 (r² + 2 x²)
//! - y′ = y (1 + k1 r² + k2 r⁴) + p1 (r² + 2 y²) + 2 p2 x y
//! - u = fx x′ + cx, v = fy y′ + cy, in pixels.
//!
//! Source: D. C. Brown, Close-range camera calibration, Photogrammetric Engineering 37 (1971), 855–866, with the signs and the order
//! of the numbers that OpenCV documents for `cv::calibrateCamera`.

use crate::algebra::Poly;

/// How many numbers a camera has.
pub const INTRINSICS: usize = 8;

/// What they are called, in their order.
pub const NAMES: [&str; INTRINSICS] = ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"];

/// The camera of an observed image point. The point's components are in the frame of [`Observable::frame`](super::Observable::frame),
/// which is what it is fixed to, and the camera is [`Observable::body`](super::Observable::body).
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Focal lengths and principal point in pixels, then the distortion; made of constants, inputs and errors.
    pub intrinsics: [Poly; INTRINSICS],
}

/// Which of the two numbers of an image point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageAxis {
    /// Along the rows of pixels, growing with x of the camera.
    U,
    /// Along the columns of pixels, growing with y of the camera.
    V,
}

impl ImageAxis {
    /// 0 or 1.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }
}

/// Numbers that can be added, multiplied and divided: how image points are computed, whatever with them.
pub trait Field: Copy {
    /// What makes them.
    type With<'a>;
    /// The sum.
    #[must_use]
    fn plus(self, other: Self, with: &mut Self::With<'_>) -> Self;
    /// The product.
    #[must_use]
    fn times(self, other: Self, with: &mut Self::With<'_>) -> Self;
    /// The quotient.
    #[must_use]
    fn over(self, other: Self, with: &mut Self::With<'_>) -> Self;
}

/// Where the camera of these numbers sees the point X, Y, Z of its frame: u and v.
pub fn project<F: Field>([x, y, z]: [F; 3], intrinsics: &[F; INTRINSICS], with: &mut F::With<'_>) -> [F; 2] {
    let [fx, fy, cx, cy, k1, k2, p1, p2] = *intrinsics;
    let (x, y) = (x.over(z, with), y.over(z, with));
    let (xx, yy, xy) = (x.times(x, with), y.times(y, with), x.times(y, with));
    let square = xx.plus(yy, with);
    // r² (k1 + k2 r²)
    let radial = k2.times(square, with).plus(k1, with).times(square, with);
    let twice = xy.plus(xy, with);
    let (by_x, by_y) = (square.plus(xx, with).plus(xx, with), square.plus(yy, with).plus(yy, with));
    let of_x = p1.times(twice, with).plus(p2.times(by_x, with), with);
    let of_y = p1.times(by_y, with).plus(p2.times(twice, with), with);
    let x = x.plus(x.times(radial, with), with).plus(of_x, with);
    let y = y.plus(y.times(radial, with), with).plus(of_y, with);
    [fx.times(x, with).plus(cx, with), fy.times(y, with).plus(cy, with)]
}
