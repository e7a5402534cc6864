//! What the numbers of an observation are, as a study writes it.

use serde::Deserialize;

use crate::data::Measure;

/// What the numbers of an observation are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Kind {
    Direction,
    Spherical,
    Offset,
    Point,
    Range,
    Plane,
    Target,
    Fixed,
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
            Self::Wire => "wire",
            Self::Distance => "distance",
            Self::Sight => "sight",
            Self::Orientation => "orientation",
        }
    }

    /// What is measured of an object; `None` where none is observed.
    pub fn of_object(self) -> Option<Measure> {
        match self {
            Self::Plane => Some(Measure::Plane),
            Self::Target => Some(Measure::Target),
            Self::Fixed => Some(Measure::Fixed),
            Self::Wire => Some(Measure::Wire),
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
