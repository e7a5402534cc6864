//! Links of Denavit and Hartenberg between the axes of joints.

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::export::links::Links;

/// Axes are nearly parallel where the sine of their angle is below this: that of 5°, where an uncertainty across them grows elevenfold in d.
const PARALLEL: f64 = 0.087;
/// Below this the sine is rounding: the axes are parallel.
const EXACTLY_PARALLEL: f64 = 1e-12;
/// Parallel axes closer than this are one line, m.
const ONE_LINE_M: f64 = 1e-9;

/// The sizes of a link: Rz(theta) Tz(d) Tx(a) Rx(alpha), and Ry(beta) where the next axis is nearly parallel. rad, m
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Link {
    /// About the axis of the joint, beside its reading.
    pub theta: f64,
    /// Along it.
    pub d: f64,
    /// Along the common normal.
    pub a: f64,
    /// About it.
    pub alpha: f64,
    /// About y; only of nearly parallel axes.
    pub beta: Option<f64>,
}

/// A chain of links, with the frames of each joint turned so that z is its axis.
pub struct Aligned {
    /// From the ground to the frame of the first joint.
    pub base: Isometry3<f64>,
    /// Behind each joint but the last a link; behind the last one that goes nowhere.
    pub between: Vec<Link>,
    /// From the frame of the last joint to what observes.
    pub tool: Isometry3<f64>,
}

impl Link {
    /// A link that goes nowhere.
    pub const NONE: Self = Self { theta: 0.0, d: 0.0, a: 0.0, alpha: 0.0, beta: None };

    /// Its sizes by their names.
    pub fn parameters(&self) -> impl Iterator<Item = (&'static str, f64)> {
        let own = [("theta", self.theta), ("d", self.d), ("a", self.a), ("alpha", self.alpha)];
        own.into_iter().chain(self.beta.map(|beta| ("beta", beta)))
    }

    /// What it does.
    pub fn transform(&self) -> Isometry3<f64> {
        let about = |axis, angle| {
            Isometry3::from_parts(Translation3::identity(), UnitQuaternion::from_axis_angle(&axis, angle))
        };
        about(Vector3::z_axis(), self.theta)
            * Translation3::new(self.a, 0.0, self.d)
            * about(Vector3::x_axis(), self.alpha)
            * about(Vector3::y_axis(), self.beta.unwrap_or(0.0))
    }

    /// The links of a chain as it was declared.
    ///
    /// # Errors
    /// The joint whose axis lies in one line with the next one.
    pub fn nominal(links: &Links) -> Result<Vec<Self>, usize> {
        let mut known = Vec::new();
        let mut carried = Isometry3::identity();
        for (at, place) in between(links).iter().enumerate() {
            let place = carried * place;
            let (axis, shift) = (place.rotation * Vector3::z(), place.translation.vector);
            let start = if axis.xy().norm() < PARALLEL {
                if shift.xy().norm() < ONE_LINE_M {
                    return Err(at);
                }
                Self { d: shift.z, beta: Some(0.0), ..Self::NONE }
            } else {
                Self::NONE
            };
            let link = start.towards(&place);
            carried = link.transform().inverse() * place;
            known.push(link);
        }
        known.push(Self::NONE);
        Ok(known)
    }

    /// The link that goes to an axis from a link near it: its x the same way round, and where it has a turn about y its d.
    fn towards(&self, place: &Isometry3<f64>) -> Self {
        let (axis, shift) = (place.rotation * Vector3::z(), place.translation.vector);
        let usual = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.theta) * Vector3::x();
        let nearest = |x: Vector3<f64>| if x.dot(&usual) < 0.0 { -x } else { x };
        if self.beta.is_some() {
            // Where the axis goes through the plane across at d.
            let through = shift + axis * ((self.d - shift.z) / axis.z);
            let x = nearest(Vector3::new(through.x, through.y, 0.0).normalize());
            let theta = x.y.atan2(x.x);
            let seen = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -theta) * axis;
            let beta = Some(seen.x.clamp(-1.0, 1.0).asin());
            return Self { theta, a: through.dot(&x), alpha: (-seen.y).atan2(seen.z), beta, ..*self };
        }
        let across = Vector3::z().cross(&axis);
        if across.norm() < EXACTLY_PARALLEL {
            let x = nearest(Vector3::new(shift.x, shift.y, 0.0).try_normalize(ONE_LINE_M).unwrap_or(usual));
            return Self { theta: x.y.atan2(x.x), a: shift.dot(&x), ..*self };
        }
        let x = nearest(across.normalize());
        let a = shift.dot(&x);
        let d = (shift - x * a).cross(&axis).dot(&across) / across.norm_squared();
        Self { theta: x.y.atan2(x.x), d, a, alpha: across.dot(&x).atan2(axis.z), beta: None }
    }
}

/// What lies between the axes of joints, each seen with z along the axis before it and its own.
fn between(links: &Links) -> Vec<Isometry3<f64>> {
    let turned: Vec<UnitQuaternion<f64>> = links.joints.iter().map(|joint| z_to(&joint.axis)).collect();
    let inner = links.fixed.iter().skip(1).zip(turned.windows(2));
    inner.map(|(fixed, pair)| pair[0].inverse() * fixed * pair[1]).collect()
}

impl Aligned {
    /// The links of a chain, each near the nominal one.
    pub fn of(links: &Links, nominal: &[Link]) -> Self {
        let turned: Vec<UnitQuaternion<f64>> = links.joints.iter().map(|joint| z_to(&joint.axis)).collect();
        let ends = (links.fixed.first(), links.fixed.last(), turned.first(), turned.last());
        let (Some(first), Some(last), Some(turn), Some(back)) = ends else {
            unreachable!("links have a joint, and a transform on both sides of it")
        };
        let (mut own, mut carried) = (Vec::new(), Isometry3::identity());
        for (place, near) in between(links).iter().zip(nominal) {
            let place = carried * place;
            let link = near.towards(&place);
            // A turn about the axis of the next joint and a shift along it, which its motion does not change.
            carried = link.transform().inverse() * place;
            own.push(link);
        }
        own.push(Link::NONE);
        Self { base: first * turn, between: own, tool: carried * (back.inverse() * last) }
    }
}

/// A turn of z to an axis.
fn z_to(axis: &Unit<Vector3<f64>>) -> UnitQuaternion<f64> {
    let back = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), axis).unwrap_or_else(back)
}
