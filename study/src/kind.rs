//! What the numbers of an observation are, as a study writes it.

use serde::Deserialize;

use observe::Measure;

/// What the numbers of an observation are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    Direction,
    Spherical,
    Offset,
    Point,
    Range,
    Plane,
    Target,
    Fixed,
    Circle,
    Sphere,
    Wire,
    Distance,
    Sight,
    Orientation,
}

impl Kind {
    /// As it is written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direction => "direction",
            Self::Spherical => "spherical",
            Self::Offset => "offset",
            Self::Point => "point",
            Self::Range => "range",
            Self::Plane => "plane",
            Self::Target => "target",
            Self::Fixed => "fixed",
            Self::Circle => "circle",
            Self::Sphere => "sphere",
            Self::Wire => "wire",
            Self::Distance => "distance",
            Self::Sight => "sight",
            Self::Orientation => "orientation",
        }
    }

    /// What is measured of an object, its radius being known or not; `None` where none is observed.
    pub fn of_object(self, has_radius: bool) -> Option<Measure> {
        match self {
            Self::Plane => Some(Measure::Plane),
            Self::Target => Some(Measure::Target),
            Self::Fixed => Some(Measure::Fixed),
            Self::Circle if has_radius => Some(Measure::Ring),
            Self::Circle => Some(Measure::Circle),
            // A sphere is a distance from its centre; of an unknown radius, a wire of which nothing is read.
            Self::Sphere if has_radius => Some(Measure::Distance),
            Self::Sphere | Self::Wire => Some(Measure::Wire),
            Self::Distance => Some(Measure::Distance),
            Self::Sight => Some(Measure::Sight),
            Self::Direction
            | Self::Spherical
            | Self::Offset
            | Self::Point
            | Self::Range
            | Self::Orientation => None,
        }
    }
}
