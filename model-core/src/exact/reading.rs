//! Readings in numbers. Their errors are angles between the vector without errors and the one with them, from a cross and
//! a dot product, so that an error of 1e-12 rad keeps all its digits; never a difference of two angles.

use nalgebra::Vector3;

use crate::chain::reading::{Measures, Reading, SignedAxis};

impl Reading {
    /// What is shown of the vector with errors; `nominal` is the one without, `error` what the errors add to it.
    ///
    /// Readings that are errors by themselves ([`Measures::CrossElevation`], [`Measures::OffAxis`]) show their error.
    #[must_use]
    pub fn value(&self, nominal: &Vector3<f64>, error: &Vector3<f64>) -> f64 {
        let vector = nominal + error;
        match self.measures {
            Measures::Component(axis) => vector[axis.index()],
            Measures::Azimuth { zero, through } => through.of(&vector).atan2(zero.of(&vector)),
            Measures::Elevation { up } => {
                let plane = Plane::across(up, &vector, &Vector3::zeros());
                up.of(&vector).atan2(plane.length)
            }
            Measures::ZenithDistance { up } => {
                let plane = Plane::across(up, &vector, &Vector3::zeros());
                plane.length.atan2(up.of(&vector))
            }
            Measures::Range => vector.norm(),
            Measures::CrossElevation { .. }
            | Measures::OffAxis
            | Measures::Rotation(_)
            | Measures::Image(_) => self.error(nominal, error),
        }
    }

    /// What the errors add to what is shown, with full relative precision; an angle lies in (−π, π].
    #[must_use]
    pub fn error(&self, nominal: &Vector3<f64>, error: &Vector3<f64>) -> f64 {
        match self.measures {
            Measures::Component(axis) => error[axis.index()],
            Measures::Azimuth { zero, through } => {
                let (a, b) = (zero.of(nominal), through.of(nominal));
                let (da, db) = (zero.of(error), through.of(error));
                (a * db - b * da).atan2(a * (a + da) + b * (b + db))
            }
            Measures::CrossElevation { zero, through } => {
                let azimuth = Self { measures: Measures::Azimuth { zero, through }, ..*self };
                let length = zero.of(nominal).hypot(through.of(nominal));
                azimuth.error(nominal, error) * (length / nominal.norm())
            }
            Measures::Elevation { up } => {
                let plane = Plane::across(up, nominal, error);
                let (height, rise) = (up.of(nominal), up.of(error));
                let (length, growth) = (plane.length, plane.growth);
                (length * rise - height * growth).atan2(length * (length + growth) + height * (height + rise))
            }
            Measures::ZenithDistance { up } => {
                -Self { measures: Measures::Elevation { up }, ..*self }.error(nominal, error)
            }
            Measures::Range => growth(nominal, error),
            Measures::OffAxis => nominal.cross(error).norm().atan2(nominal.dot(&(nominal + error))),
            // No single vector says how a body is turned, or what a camera makes of it.
            Measures::Rotation(_) | Measures::Image(_) => f64::NAN,
        }
    }
}

impl Reading {
    /// What an error adds to what is shown to first order in it: the derivative of the reading along it. Where the reading has
    /// none, it is no number.
    pub(super) fn slope(&self, nominal: &Vector3<f64>, error: &Vector3<f64>) -> f64 {
        match self.measures {
            Measures::Component(axis) => error[axis.index()],
            Measures::Azimuth { zero, through } => {
                let (a, b) = (zero.of(nominal), through.of(nominal));
                (a * through.of(error) - b * zero.of(error)) / (a * a + b * b)
            }
            Measures::CrossElevation { zero, through } => {
                let (a, b) = (zero.of(nominal), through.of(nominal));
                (a * through.of(error) - b * zero.of(error)) / (a.hypot(b) * nominal.norm())
            }
            Measures::Elevation { up } => {
                let plane = Plane::across(up, nominal, &Vector3::zeros());
                let (height, rise) = (up.of(nominal), up.of(error));
                let outward = (nominal.dot(error) - height * rise) / plane.length;
                (plane.length * rise - height * outward) / nominal.norm_squared()
            }
            Measures::ZenithDistance { up } => {
                -Self { measures: Measures::Elevation { up }, ..*self }.slope(nominal, error)
            }
            Measures::Range => nominal.dot(error) / nominal.norm(),
            Measures::OffAxis | Measures::Rotation(_) | Measures::Image(_) => f64::NAN,
        }
    }
}

/// The small rotation vector to first order, from the axes of a body without errors and what they gain in first order.
pub(super) fn rotation_to_first_order(axes: &[(Vector3<f64>, Vector3<f64>); 3]) -> Vector3<f64> {
    axes.iter().map(|(nominal, first)| nominal.cross(first)).sum::<Vector3<f64>>() / 2.0
}

/// The small rotation vector from the axes of a body without errors and what the errors add to each; with full relative
/// precision, for turns of less than a half.
///
/// Source: with R = R₀ + D, ½ Σ n × d over the columns n of R₀ and d of D is the axis times sin θ, and 1 + ½ Σ n · d is
/// cos θ.
pub(super) fn rotation_vector(axes: &[(Vector3<f64>, Vector3<f64>); 3]) -> Vector3<f64> {
    /// Far below the square of any turn, it keeps θ/sin θ a number where there is none.
    const NOTHING: f64 = 1e-36;
    let sine = rotation_to_first_order(axes);
    let cosine = 1.0 + axes.iter().map(|(nominal, error)| nominal.dot(error)).sum::<f64>() / 2.0;
    let length = (sine.norm_squared() + NOTHING).sqrt();
    sine * (length.atan2(cosine) / length)
}

/// How long a vector is across an axis, and how much errors add to that.
struct Plane {
    length: f64,
    growth: f64,
}

impl Plane {
    fn across(up: SignedAxis, nominal: &Vector3<f64>, error: &Vector3<f64>) -> Self {
        let across = |vector: &Vector3<f64>| {
            let mut across = *vector;
            across[up.axis.index()] = 0.0;
            across
        };
        let (nominal, error) = (across(nominal), across(error));
        Self { length: nominal.norm(), growth: growth(&nominal, &error) }
    }
}

/// |v + δ| − |v| = δ·(2v + δ) / (|v + δ| + |v|), which loses no digits however small δ is.
fn growth(nominal: &Vector3<f64>, error: &Vector3<f64>) -> f64 {
    let above = error.dot(&(2.0 * nominal + error));
    if above == 0.0 { 0.0 } else { above / ((nominal + error).norm() + nominal.norm()) }
}
