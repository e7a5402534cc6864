//! Readings: the numbers that an instrument shows of a vector. A direction or point has three components; a paper prints
//! azimuth and elevation, hour angle and declination, circles, a range, one component.
//!
//! Here is what there is, and by which convention; [`WORDS`] is the one table of it. [`crate::exact`] has their values and
//! errors in numbers, [`crate::forms`] their errors by degree in the errors.

use super::image::ImageAxis;
use super::{Axis, Observable, ObservableKind};

/// An axis of the frame that an observable is seen in, forwards or backwards: `x`, `-y`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SignedAxis {
    /// Which axis.
    pub axis: Axis,
    /// Whether its negative half is meant.
    pub is_negative: bool,
}

impl SignedAxis {
    const fn along(axis: Axis) -> Self {
        Self { axis, is_negative: false }
    }

    const fn against(axis: Axis) -> Self {
        Self { axis, is_negative: true }
    }

    /// The component of a vector along it.
    pub(crate) fn of(self, vector: &nalgebra::Vector3<f64>) -> f64 {
        let component = vector[self.axis.index()];
        if self.is_negative { -component } else { component }
    }
}

impl std::fmt::Display for SignedAxis {
    /// `x` or `-x`.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{}", if self.is_negative { "-" } else { "" }, self.axis)
    }
}

/// One number that an observable shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// The word of the declaration, which names it in every output: `hour_angle`.
    pub word: &'static str,
    /// What it measures.
    pub measures: Measures,
}

/// What a reading measures of the vector v of its observable, in the frame that the observable is seen in. Angles are in
/// radians, right for vectors of any length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measures {
    /// One component of v.
    Component(Axis),
    /// The angle about the axis across `zero` and `through`: 0 along `zero`, a quarter turn along `through`.
    /// In (−π, π].
    Azimuth {
        /// Where it is zero.
        zero: SignedAxis,
        /// Where it is a quarter turn.
        through: SignedAxis,
    },
    /// The error of an azimuth times the cosine of the elevation of the perfect instrument: how far the vector has moved
    /// sideways, as an angle on the sky. It is an error by itself; where there are no errors it is zero.
    CrossElevation {
        /// Where the azimuth is zero.
        zero: SignedAxis,
        /// Where the azimuth is a quarter turn.
        through: SignedAxis,
    },
    /// The angle above the plane across `up`, in [−π/2, π/2].
    Elevation {
        /// Where it is a quarter turn.
        up: SignedAxis,
    },
    /// The angle from `up`, in [0, π].
    ZenithDistance {
        /// Where it is zero.
        up: SignedAxis,
    },
    /// The length of v: the distance of a point from the origin of the frame. In metres.
    Range,
    /// The angle between v and the v of the perfect instrument, in [0, π]. It is an error by itself, and never negative.
    OffAxis,
    /// One component of the small rotation vector ω of a body, in the frame that it is seen in: with errors the body is turned
    /// as by design and then about ω by its length, R = exp(ω×) R₀. It is an error by itself, and belongs to no vector.
    Rotation(Axis),
    /// Where a camera sees the point v of its frame, in pixels; the numbers of the camera belong to the observable.
    Image(ImageAxis),
}

const X: SignedAxis = SignedAxis::along(Axis::X);
const Y: SignedAxis = SignedAxis::along(Axis::Y);
const Z: SignedAxis = SignedAxis::along(Axis::Z);
const MINUS_Y: SignedAxis = SignedAxis::against(Axis::Y);

/// Every reading by its word, by the convention that holds where none is written. This is the one place that says where an
/// angle is zero and which way it turns.
pub const WORDS: [Reading; 18] = [
    Reading { word: "x", measures: Measures::Component(Axis::X) },
    Reading { word: "y", measures: Measures::Component(Axis::Y) },
    Reading { word: "z", measures: Measures::Component(Axis::Z) },
    Reading { word: "azimuth", measures: Measures::Azimuth { zero: X, through: Y } },
    Reading { word: "hour_angle", measures: Measures::Azimuth { zero: X, through: MINUS_Y } },
    Reading { word: "horizontal_circle", measures: Measures::Azimuth { zero: X, through: MINUS_Y } },
    Reading { word: "cross_elevation", measures: Measures::CrossElevation { zero: X, through: Y } },
    Reading { word: "elevation", measures: Measures::Elevation { up: Z } },
    Reading { word: "declination", measures: Measures::Elevation { up: Z } },
    Reading { word: "zenith_distance", measures: Measures::ZenithDistance { up: Z } },
    Reading { word: "vertical_circle", measures: Measures::ZenithDistance { up: Z } },
    Reading { word: "range", measures: Measures::Range },
    Reading { word: "off_axis", measures: Measures::OffAxis },
    Reading { word: "rotation_x", measures: Measures::Rotation(Axis::X) },
    Reading { word: "rotation_y", measures: Measures::Rotation(Axis::Y) },
    Reading { word: "rotation_z", measures: Measures::Rotation(Axis::Z) },
    Reading { word: "u", measures: Measures::Image(ImageAxis::U) },
    Reading { word: "v", measures: Measures::Image(ImageAxis::V) },
];

/// The small rotation vector: what an orientation shows that names no readings.
pub const ROTATION: [Reading; 3] = [WORDS[13], WORDS[14], WORDS[15]];

/// Both numbers of an image point: what one shows that names no readings.
pub const IMAGE: [Reading; 2] = [WORDS[16], WORDS[17]];

/// The components of a vector: what an observable shows that names no readings.
pub const COMPONENTS: [Reading; 3] = [WORDS[0], WORDS[1], WORDS[2]];

impl Reading {
    /// The reading of a word, by the convention of [`WORDS`].
    #[must_use]
    pub fn of_word(word: &str) -> Option<Self> {
        WORDS.into_iter().find(|reading| reading.word == word)
    }

    /// How many axes may be written behind the word to change its convention.
    #[must_use]
    pub fn axes(&self) -> usize {
        match self.measures {
            Measures::Azimuth { .. } | Measures::CrossElevation { .. } => 2,
            Measures::Elevation { .. } | Measures::ZenithDistance { .. } => 1,
            Measures::Component(_)
            | Measures::Range
            | Measures::OffAxis
            | Measures::Rotation(_)
            | Measures::Image(_) => 0,
        }
    }

    /// The same reading by another convention; `None` if these are not as many axes as it has, or one axis twice.
    #[must_use]
    pub fn with_axes(&self, axes: &[SignedAxis]) -> Option<Self> {
        let measures = match (self.measures, axes) {
            (Measures::Azimuth { .. }, &[zero, through]) if zero.axis != through.axis => {
                Measures::Azimuth { zero, through }
            }
            (Measures::CrossElevation { .. }, &[zero, through]) if zero.axis != through.axis => {
                Measures::CrossElevation { zero, through }
            }
            (Measures::Elevation { .. }, &[up]) => Measures::Elevation { up },
            (Measures::ZenithDistance { .. }, &[up]) => Measures::ZenithDistance { up },
            _ => return None,
        };
        Some(Self { measures, ..*self })
    }

    /// The component of the small rotation vector that it is, if it is one.
    #[must_use]
    pub fn rotation(&self) -> Option<Axis> {
        match self.measures {
            Measures::Rotation(axis) => Some(axis),
            _ => None,
        }
    }

    /// The number of an image point that it is, if it is one.
    #[must_use]
    pub fn image(&self) -> Option<ImageAxis> {
        match self.measures {
            Measures::Image(axis) => Some(axis),
            _ => None,
        }
    }

    /// The component that it is, if it is one.
    #[must_use]
    pub fn component(&self) -> Option<Axis> {
        match self.measures {
            Measures::Component(axis) => Some(axis),
            _ => None,
        }
    }

    /// Whether it is an angle, in radians.
    #[must_use]
    pub fn is_angle(&self) -> bool {
        !matches!(self.measures, Measures::Component(_) | Measures::Range | Measures::Image(_))
    }

    /// Its unit for an observable of a kind: `rad`, `m`, `px`, or `1` for components of directions.
    #[must_use]
    pub fn unit(&self, kind: ObservableKind) -> &'static str {
        if self.image().is_some() {
            return "px";
        }
        match (self.is_angle(), kind) {
            (true, _) => "rad",
            (false, ObservableKind::Point) => "m",
            (false, ObservableKind::Direction) => "1",
        }
    }

    /// What it is in words, with its convention: `azimuth from x through y`.
    #[must_use]
    pub fn describe(&self) -> String {
        match self.measures {
            Measures::Component(axis) => format!("component {axis}"),
            Measures::Azimuth { zero, through } | Measures::CrossElevation { zero, through } => {
                format!("{} from {zero} through {through}", self.words())
            }
            Measures::Elevation { up } => format!("{} towards {up}", self.words()),
            Measures::ZenithDistance { up } => format!("{} from {up}", self.words()),
            Measures::Range => "range".to_owned(),
            Measures::OffAxis => "angle off the axis".to_owned(),
            Measures::Rotation(axis) => format!("component {axis} of the small rotation vector"),
            Measures::Image(_) => format!("{} of the image point", self.word),
        }
    }

    /// Its word as people write it: `hour angle`.
    #[must_use]
    pub fn words(&self) -> String {
        self.word.replace('_', " ")
    }

    /// The word with the axes of its convention, as a declaration writes it: `azimuth(x, -y)`, and `azimuth` alone by the
    /// convention of [`WORDS`].
    #[must_use]
    pub fn written(&self) -> String {
        if Self::of_word(self.word) == Some(*self) {
            return self.word.to_owned();
        }
        match self.measures {
            Measures::Azimuth { zero, through } | Measures::CrossElevation { zero, through } => {
                format!("{}({zero}, {through})", self.word)
            }
            Measures::Elevation { up } | Measures::ZenithDistance { up } => format!("{}({up})", self.word),
            Measures::Component(_)
            | Measures::Range
            | Measures::OffAxis
            | Measures::Rotation(_)
            | Measures::Image(_) => self.word.to_owned(),
        }
    }
}

impl Observable {
    /// Whether it shows its vector, component by component.
    #[must_use]
    pub fn is_vector(&self) -> bool {
        self.shown == COMPONENTS
    }

    /// The first of its numbers whose unit is not that of the first one.
    #[must_use]
    pub fn of_other_unit(&self) -> Option<&Reading> {
        let unit = self.shown.first()?.unit(self.kind);
        self.shown.iter().find(|reading| reading.unit(self.kind) != unit)
    }

    /// Whether it shows how a body is turned, and no vector.
    #[must_use]
    pub fn is_orientation(&self) -> bool {
        self.shown.iter().any(|reading| reading.rotation().is_some())
    }

    /// Whether it shows nothing but components of its vector.
    #[must_use]
    pub fn has_components_only(&self) -> bool {
        self.shown.iter().all(|reading| reading.component().is_some())
    }

    /// The names of what it shows: `x`, `y`, `z`, or `azimuth`, `elevation`.
    pub fn labels(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.shown.iter().map(|reading| reading.word)
    }

    /// The name of one of its numbers by its place; of no number where it shows fewer.
    #[must_use]
    pub fn label(&self, place: usize) -> &'static str {
        self.shown.get(place).map_or("", |reading| reading.word)
    }
}
