//! What one observation measured, and what the numbers of a series are.

use nalgebra::{UnitQuaternion, Vector3};
use serde::Serialize;

use super::SiUnit;

/// What the numbers of one observation are, and with that how many residual components it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Measure {
    /// A unit vector; two residual components on the tangent plane, rad: across (towards growing azimuth) and
    /// along (towards growing elevation).
    Direction,
    /// A point; three residual components x, y, z, in metres.
    Point,
    /// The distance of a point from the origin of the ground frame; one residual component, in metres.
    Range,
    /// An azimuth alone, from y through x; one residual component, rad.
    Azimuth,
    /// How a body is turned; three residual components, rad: the vector about which, and by the length of which, the body would
    /// have to be turned further, along the axes of the frame that it is seen in.
    Orientation,
    /// A point on an unknown plane; one residual component, in metres: how far off the plane.
    Plane,
    /// A point that is an unknown target's, seen from a station; three residual components across, up and along the beam,
    /// in metres.
    Target,
    /// A point that stays where it is, however it is reached; three residual components x, y, z, in metres.
    Fixed,
    /// The length of a wire from an unknown anchor to the point; one residual component, in metres.
    Wire,
    /// A point on an unknown circle; two residual components, in metres: how far off its plane, and how far outside of it.
    Circle,
    /// The same where the radius is known.
    Ring,
    /// The distance of the point from another, which other rows observe, or which is known or not; one residual component, in
    /// metres.
    Distance,
    /// A direction that is an unknown point's from a station; two residual components across and along, rad.
    Sight,
    /// The same from a point of the chain that is not the station's own: the beam on which the observed point moves as the range
    /// grows goes through the unknown point; two residual components across and along, rad.
    Beam,
}

/// What the noise of a component is of: that of one varies with the pose in its own way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum NoiseOf {
    /// Angles.
    Angles,
    /// Lengths.
    Lengths,
    /// Places across a beam, which is as far off as an angle makes it at the range.
    Across,
}

impl Measure {
    /// The number of residual components of one observation.
    #[must_use]
    pub fn components(self) -> usize {
        match self {
            Self::Direction | Self::Sight | Self::Beam | Self::Circle | Self::Ring => 2,
            Self::Point | Self::Target | Self::Fixed | Self::Orientation => 3,
            Self::Range | Self::Azimuth | Self::Plane | Self::Wire | Self::Distance => 1,
        }
    }

    /// The SI unit of a residual.
    #[must_use]
    pub fn unit(self) -> SiUnit {
        match self {
            Self::Direction | Self::Azimuth | Self::Sight | Self::Beam | Self::Orientation => SiUnit::RAD,
            Self::Point
            | Self::Range
            | Self::Plane
            | Self::Target
            | Self::Fixed
            | Self::Circle
            | Self::Ring
            | Self::Wire
            | Self::Distance => SiUnit::METRE,
        }
    }

    /// What the residual components are called.
    #[must_use]
    pub fn component_names(self) -> &'static [&'static str] {
        match self {
            Self::Direction | Self::Sight | Self::Beam => &["across", "along"],
            Self::Point | Self::Fixed => &["x", "y", "z"],
            Self::Range => &["range"],
            Self::Azimuth => &["azimuth"],
            Self::Orientation => &["rotation_x", "rotation_y", "rotation_z"],
            Self::Plane => &["off_plane"],
            Self::Circle | Self::Ring => &["off_plane", "off_circle"],
            Self::Target => &["across", "up", "along"],
            Self::Wire | Self::Distance => &["length"],
        }
    }

    /// What the noise of a residual component is of.
    #[must_use]
    pub fn noise_of(self, component: usize) -> NoiseOf {
        match self {
            Self::Target if component < 2 => NoiseOf::Across,
            _ if self.unit() == SiUnit::RAD => NoiseOf::Angles,
            _ => NoiseOf::Lengths,
        }
    }

    /// What the same poses show where nothing stands that was observed: the point or the direction itself.
    #[must_use]
    pub fn bare(self) -> Self {
        match self {
            Self::Plane
            | Self::Target
            | Self::Fixed
            | Self::Circle
            | Self::Ring
            | Self::Wire
            | Self::Distance
            | Self::Beam => Self::Point,
            Self::Sight => Self::Direction,
            Self::Direction | Self::Point | Self::Range | Self::Azimuth | Self::Orientation => self,
        }
    }
}

/// What one observation measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Measured {
    /// A unit vector.
    Direction(Vector3<f64>),
    /// A point, in metres.
    Point(Vector3<f64>),
    /// The distance of a point from the origin of the ground frame, in metres.
    Range {
        /// In metres.
        range_m: f64,
    },
    /// An azimuth, from y through x.
    Azimuth {
        /// In radians.
        azimuth_rad: f64,
    },
    /// What takes vectors of the body into the frame that it is seen in.
    Orientation(UnitQuaternion<f64>),
    /// The length of a wire, or the distance of two points.
    Length {
        /// In metres.
        length_m: f64,
    },
    /// Nothing but the readings of joints and inputs: what stands there is an object's to say.
    Readings,
}

impl Measured {
    /// The length that is read, m; none where what is measured is no such length.
    pub fn length_m(&self) -> Option<f64> {
        if let Self::Length { length_m } = self { Some(*length_m) } else { None }
    }

    /// What would be measured where the chain is right: residuals are zero.
    ///
    /// `measure` is one that [`Measure::bare`] gives.
    pub fn exactly(measure: Measure, predicted: &Vector3<f64>) -> Self {
        match measure {
            Measure::Direction => Self::Direction(predicted.normalize()),
            Measure::Point => Self::Point(*predicted),
            Measure::Range => Self::Range { range_m: predicted.norm() },
            Measure::Azimuth => Self::Azimuth { azimuth_rad: predicted.x.atan2(predicted.y) },
            Measure::Orientation => unreachable!("no single vector says how a body is turned"),
            Measure::Plane
            | Measure::Target
            | Measure::Fixed
            | Measure::Circle
            | Measure::Ring
            | Measure::Wire
            | Measure::Distance
            | Measure::Sight
            | Measure::Beam => {
                unreachable!("poses without observations are bare")
            }
        }
    }

    /// The x, y, z of a direction or a point.
    #[must_use]
    pub fn vector(&self) -> Option<&Vector3<f64>> {
        match self {
            Self::Direction(vector) | Self::Point(vector) => Some(vector),
            Self::Range { .. }
            | Self::Azimuth { .. }
            | Self::Orientation(_)
            | Self::Length { .. }
            | Self::Readings => None,
        }
    }

    /// The largest number in it, in rad or m, or of a unit vector.
    pub fn largest(&self) -> f64 {
        match *self {
            Self::Direction(vector) | Self::Point(vector) => vector.amax(),
            Self::Range { range_m: number }
            | Self::Azimuth { azimuth_rad: number }
            | Self::Length { length_m: number } => number.abs(),
            Self::Orientation(_) => 1.0,
            Self::Readings => 0.0,
        }
    }
}
