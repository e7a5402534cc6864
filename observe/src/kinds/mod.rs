//! Kinds of observation: one file each, one line in the table below.
//!
//! A kind's file says all that is particular to it: residual and derivatives, unit and noise, what it says of places, how a study
//! writes it, its picture and its words. Everybody else asks a [`Kind`] for what they need to know, and lists none.

mod azimuth;
mod beam;
mod circle;
mod direction;
mod distance;
mod fixed;
mod orientation;
mod pixel;
mod plane;
mod point;
mod range;
mod ring;
mod sight;
mod target;
mod wire;

mod compare;
mod kind;
mod measured;
mod residual;
mod seeing;
mod tangent_plane;
mod written;

use model_core::{Observable, ObservableKind};

use crate::SiUnit;
use crate::unknowns::Shape;

pub use compare::{Compared, Mismatch, Rows, Unknown};
pub use kind::{
    AimedAt, BaseShown, BeamUse, GrowsWith, Kind, MOST, Map, MeasuredLengths, NoiseOf, PlaceShown, Predicted,
    Ranges, Scale, SpaceAxes, Thing,
};
pub use measured::Measured;
pub use seeing::TurnsBy;
pub use written::{
    Asked, Cells, Filled, Key, NAMES, Observes, OfReadings, Shows, UNIT_TOLERANCE, Written, headers, ways,
};

macro_rules! table {
    ($($(#[$what:meta])* $measure:ident = $file:ident;)*) => {
        /// What the numbers of one observation are, and with that how many residual components it has.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Measure {
            $($(#[$what])* $measure,)*
        }

        impl Measure {
            /// Every one, in the order of the table.
            pub const ALL: &'static [Self] = &[$(Self::$measure),*];
        }

        static KINDS: [Kind; Measure::ALL.len()] = [$($file::KIND),*];
    };
}

table! {
    /// A unit vector; two residual components on the tangent plane, rad: across (towards growing azimuth) and
    /// along (towards growing elevation).
    Direction = direction;
    /// A point; three residual components x, y, z, in metres.
    Point = point;
    /// The distance of a point from the origin of the ground frame; one residual component, in metres.
    Range = range;
    /// An azimuth alone, from y through x; one residual component, rad.
    Azimuth = azimuth;
    /// A point on an unknown plane; one residual component, in metres: how far off the plane.
    Plane = plane;
    /// A point that is an unknown target's, seen from a station; three residual components across, up and along the beam,
    /// in metres.
    Target = target;
    /// A point that stays where it is, however it is reached; three residual components x, y, z, in metres.
    Fixed = fixed;
    /// A point on an unknown circle; two residual components, in metres: how far off its plane, and how far outside of it.
    Circle = circle;
    /// The same where the radius is known.
    Ring = ring;
    /// The length of a wire from an unknown anchor to the point; one residual component, in metres.
    Wire = wire;
    /// The distance of the point from another, which other rows observe, or which is known or not; one residual component, in
    /// metres.
    Distance = distance;
    /// A direction that is an unknown point's from a station; two residual components across and along, rad.
    Sight = sight;
    /// The same from a point of the chain that is not the station's own: the beam on which the observed point moves as the range
    /// grows goes through the unknown point; two residual components across and along, rad.
    Beam = beam;
    /// How a body is turned; three residual components, rad: the vector about which, and by the length of which, the body would
    /// have to be turned further, along the axes of the frame that it is seen in.
    Orientation = orientation;
    /// Where a camera sees a point; two residual components u and v, in pixels.
    Pixel = pixel;
}

impl Measure {
    /// What is measured of an observable where nobody says it: a whole direction, point or orientation. None of single readings.
    #[must_use]
    pub fn whole(observable: &Observable) -> Option<Self> {
        match observable.kind {
            _ if observable.is_orientation() => Some(Self::Orientation),
            _ if !observable.is_vector() => None,
            ObservableKind::Direction => Some(Self::Direction),
            ObservableKind::Point => Some(Self::Point),
        }
    }

    /// All that is particular to it.
    #[must_use]
    pub fn kind(self) -> &'static Kind {
        &KINDS[self as usize]
    }

    /// The number of residual components of one observation.
    #[must_use]
    pub fn components(self) -> usize {
        self.kind().components.len()
    }

    /// The SI unit of a residual.
    #[must_use]
    pub fn unit(self) -> SiUnit {
        self.kind().unit
    }

    /// What the residual components are called.
    #[must_use]
    pub fn component_names(self) -> &'static [&'static str] {
        self.kind().components
    }

    /// What the same poses show where nothing stands that was observed: the point or the direction itself.
    #[must_use]
    pub fn bare(self) -> Self {
        self.kind().bare
    }

    /// What the observed thing is; `None` if nothing unknown is.
    #[must_use]
    pub fn shape(self) -> Option<Shape> {
        self.kind().shape
    }

    /// Whether rows observe something of which nobody knows where it is.
    #[must_use]
    pub fn observes_object(self) -> bool {
        self.kind().shape.is_some()
    }
}

#[cfg(test)]
mod tests;
