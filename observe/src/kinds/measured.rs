//! What one observation measured.

use nalgebra::{UnitQuaternion, Vector3};

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
    /// Where a point is in the image of a camera.
    Pixel {
        /// Along the rows of pixels, and along the columns.
        uv_px: [f64; 2],
    },
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

    /// The x, y, z of a direction or a point.
    #[must_use]
    pub fn vector(&self) -> Option<&Vector3<f64>> {
        match self {
            Self::Direction(vector) | Self::Point(vector) => Some(vector),
            Self::Range { .. }
            | Self::Azimuth { .. }
            | Self::Orientation(_)
            | Self::Pixel { .. }
            | Self::Length { .. }
            | Self::Readings => None,
        }
    }

    /// The unit vector, where a direction was measured.
    #[must_use]
    pub fn direction(&self) -> Option<&Vector3<f64>> {
        if let Self::Direction(direction) = self { Some(direction) } else { None }
    }

    /// The point, m, where one was measured.
    #[must_use]
    pub fn point_m(&self) -> Option<&Vector3<f64>> {
        if let Self::Point(point) = self { Some(point) } else { None }
    }

    /// The range, m, where one was measured alone.
    #[must_use]
    pub fn range_m(&self) -> Option<f64> {
        if let Self::Range { range_m } = self { Some(*range_m) } else { None }
    }

    /// The orientation, where one was measured.
    #[must_use]
    pub fn orientation(&self) -> Option<&UnitQuaternion<f64>> {
        if let Self::Orientation(turn) = self { Some(turn) } else { None }
    }

    /// The numbers that it is made of.
    #[must_use]
    pub fn numbers(&self) -> &[f64] {
        match self {
            Self::Direction(vector) | Self::Point(vector) => vector.as_slice(),
            Self::Orientation(turn) => turn.coords.as_slice(),
            Self::Range { range_m: value }
            | Self::Azimuth { azimuth_rad: value }
            | Self::Length { length_m: value } => std::slice::from_ref(value),
            Self::Pixel { uv_px } => uv_px,
            Self::Readings => &[],
        }
    }

    /// Multiplies the length that is read; what is measured otherwise stays.
    pub fn stretch_length(&mut self, factor: f64) {
        if let Self::Length { length_m } = self {
            *length_m *= factor;
        }
    }

    /// The same where every length is so many times as long.
    #[must_use]
    pub fn stretched(&self, factor: f64) -> Self {
        match *self {
            Self::Point(point) => Self::Point(point * factor),
            Self::Range { range_m } => Self::Range { range_m: range_m * factor },
            Self::Length { length_m } => Self::Length { length_m: length_m * factor },
            other => other,
        }
    }

    /// The same in a frame that is turned the other way; an azimuth as if it were that of the horizon.
    #[must_use]
    pub fn turned(&self, turn: &UnitQuaternion<f64>) -> Self {
        match *self {
            Self::Direction(direction) => Self::Direction(turn * direction),
            Self::Point(point) => Self::Point(turn * point),
            Self::Orientation(own) => Self::Orientation(turn * own),
            Self::Azimuth { azimuth_rad } => {
                let turned = turn * Vector3::new(azimuth_rad.sin(), azimuth_rad.cos(), 0.0);
                let by = (turned.x.atan2(turned.y) - azimuth_rad).rem_euclid(std::f64::consts::TAU);
                let by = if by > std::f64::consts::PI { by - std::f64::consts::TAU } else { by };
                Self::Azimuth { azimuth_rad: azimuth_rad + by }
            }
            other => other,
        }
    }

    /// The same in a frame whose origin is moved the other way.
    #[must_use]
    pub fn shifted(&self, by: &Vector3<f64>) -> Self {
        match *self {
            Self::Point(point) => Self::Point(point + by),
            other => other,
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
            Self::Pixel { uv_px: [u, v] } => u.abs().max(v.abs()),
            Self::Readings => 0.0,
        }
    }
}
