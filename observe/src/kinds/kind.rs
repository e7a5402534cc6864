//! What a kind of observation is: the properties by which everybody else asks.

use serde::Serialize;

use super::Measure;
use super::compare::{Compared, Mismatch, Rows};
use super::measured::Measured;
use super::written::Written;
use crate::SiUnit;
use crate::unknowns::Shape;

/// The most components of any kind.
pub const MOST: usize = 3;

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
    /// Places in an image.
    Pixels,
}

/// What a chain predicts for one observation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Predicted {
    /// The vector of the observable.
    Vector,
    /// The directions of the three axes of the body that carries it.
    Axes,
    /// Where the camera sees the point: u and v in pixels, and how far in front of it the point is, m.
    Image,
}

impl Predicted {
    /// How many vectors that are.
    #[must_use]
    pub fn vectors(self) -> usize {
        match self {
            Self::Vector | Self::Image => 1,
            Self::Axes => 3,
        }
    }
}

/// What plays a part of the beam on which the observed point moves as the range grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamUse {
    /// Nothing.
    Nothing,
    /// Its direction.
    Direction,
    /// All of it, from where it begins: nobody measures the range.
    Whole,
}

/// What observations say at once of a base that nobody measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BaseShown {
    /// Nothing in closed form.
    Nothing,
    /// Where it stands and how it is turned: points that were measured lie over those that are predicted.
    Pose,
    /// How it is turned.
    Turn,
}

/// What an observation says of the place of the point that it observes, to start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaceShown {
    /// Nothing by itself.
    Nothing,
    /// Where it is, as seen from the station.
    There,
    /// How far away it is.
    Distance,
    /// On which beam it lies.
    Beam,
}

/// Whether observations hold the scale of a set-up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// They do, or show a length.
    Held,
    /// They show no length at all.
    Unseen,
    /// All of their residuals vanish where every length does.
    Free,
}

/// What makes residuals larger or smaller as a whole, beside the noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GrowsWith {
    /// Nothing.
    Nothing,
    /// The arm that turns readings into places, where no range does.
    Arm,
    /// The scale of ranges; the arm where there is no range.
    RangeOrArm,
}

/// Which ranges along a beam are no mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ranges {
    /// Any.
    Any,
    /// Positive ones; those of a sensor that reads to either side of its zero, or to the other alone.
    OfSensor,
    /// Positive ones; those of a sensor that reads to either side of its zero.
    BothWays,
}

/// What an instrument is aimed at to observe an object.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AimedAt {
    /// The place of the object.
    Point,
    /// The way there, however far it is.
    Way,
    /// Some place on a board.
    Board,
    /// Places on a circle about it.
    Circle,
    /// Places on a sphere about it.
    Sphere,
}

/// Lengths that are measured beside the readings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MeasuredLengths {
    /// Radii of circles.
    Radii,
    /// Distances of two points, radii of spheres among them.
    Distances,
    /// What is wound off of wires.
    Wires,
}

/// The map on which residuals of two components are drawn.
#[derive(Debug, Clone, Copy)]
pub struct Map {
    /// What it shows.
    pub title: &'static str,
    /// What its axes are, with their units.
    pub labels: [&'static str; 2],
    /// Where on it what was measured lies, in those units; `None` for what this kind does not measure.
    pub place: fn(&Measured) -> Option<(f64, f64)>,
}

/// What one puts up to have it observed.
#[derive(Debug)]
pub struct Thing {
    /// As a study calls it.
    pub name: &'static str,
    /// In a sentence.
    pub told: &'static str,
    /// What is written before and behind its radius in mm.
    pub radius: [&'static str; 2],
    /// What the direction is called by which it is turned.
    pub turned_by: &'static str,
}

impl Thing {
    /// A thing whose radius and normal are called so.
    pub(super) const fn new(name: &'static str, told: &'static str) -> Self {
        Self { name, told, radius: [" of radius ", " mm"], turned_by: "normal" }
    }
}

/// Along which axes of space the components lie.
#[derive(Debug, Clone, Copy)]
pub struct SpaceAxes {
    /// Whether they turn with what is observed.
    pub turn: bool,
    /// The axes where this was measured; those behind the last component mean nothing.
    pub of: fn(&Measured) -> [[f64; 3]; 3],
}

/// All that is particular to one kind of observation.
#[derive(Debug)]
pub struct Kind {
    /// What the residual components are called; a row has as many degrees of freedom.
    pub components: &'static [&'static str],
    /// The SI unit of a residual.
    pub unit: SiUnit,
    /// What the noise of each component is of; what stands behind the last component means nothing.
    pub noise: [NoiseOf; MOST],
    /// What the same poses show where nothing stands that was observed: the point or the direction itself.
    pub bare: Measure,
    /// What rows observe without anybody knowing where it is; `None` where that is known row by row.
    pub shape: Option<Shape>,
    /// The ways to write it in a study.
    pub written: &'static [Written],
    /// What the chain predicts.
    pub predicted: Predicted,
    /// What the beam plays a part of.
    pub beam: BeamUse,
    /// Residuals and derivatives of rows, one beside the other: chosen once for many.
    pub compare: fn(&Rows<'_>, &mut Compared<'_>) -> Result<(), Mismatch>,
    /// What it says of a base that nobody measured.
    pub base: BaseShown,
    /// What it says of the place of its point.
    pub place: PlaceShown,
    /// Whether these rows hold the scale.
    pub scale: fn(&[Measured]) -> Scale,
    /// What makes its residuals larger.
    pub grows_with: GrowsWith,
    /// Whether the size of residuals says by itself that a fit is far off, be it of what it may.
    pub tells_far_off: bool,
    /// The axes along which a memory in space is read; `None` where there are none to read.
    pub space_axes: Option<SpaceAxes>,
    /// Which ranges are no mistake.
    pub ranges: Ranges,
    /// How far away is what was measured, m; `None` where nobody knows.
    pub distance_m: fn(&Measured) -> Option<f64>,
    /// The lengths that are measured beside the readings.
    pub lengths: Option<MeasuredLengths>,
    /// What an instrument is aimed at.
    pub aim: AimedAt,
    /// What one puts up to have it observed, by whether a length is read then; `None` where what is observed is no object.
    pub thing: fn(bool) -> Option<&'static Thing>,
    /// Where residuals are drawn; `None` where no map shows them.
    pub map: Option<Map>,
}

impl Kind {
    /// What rows could measure, where how long it would be read plays no part.
    #[must_use]
    pub fn anything_of_object(&self) -> Measured {
        self.lengths.map_or(Measured::Readings, |_| Measured::Length { length_m: 1.0 })
    }

    /// One that is known row by row and of which nothing else is remarkable.
    pub(super) const fn new(
        components: &'static [&'static str],
        (unit, noise): (SiUnit, [NoiseOf; MOST]),
        bare: Measure,
        written: &'static [Written],
        compare: fn(&Rows<'_>, &mut Compared<'_>) -> Result<(), Mismatch>,
    ) -> Self {
        Self {
            components,
            unit,
            noise,
            bare,
            shape: None,
            written,
            predicted: Predicted::Vector,
            beam: BeamUse::Nothing,
            compare,
            base: BaseShown::Nothing,
            place: PlaceShown::Nothing,
            scale: |_| Scale::Held,
            grows_with: GrowsWith::Nothing,
            tells_far_off: false,
            space_axes: None,
            ranges: Ranges::Any,
            distance_m: |_| None,
            lengths: None,
            aim: AimedAt::Point,
            thing: |_| None,
            map: None,
        }
    }
}

/// Residuals of angles: the unit, and what the noise of each component is of.
pub(super) const ANGLES: (SiUnit, [NoiseOf; MOST]) = (SiUnit::RAD, [NoiseOf::Angles; MOST]);

/// Residuals of lengths.
pub(super) const LENGTHS: (SiUnit, [NoiseOf; MOST]) = (SiUnit::METRE, [NoiseOf::Lengths; MOST]);
