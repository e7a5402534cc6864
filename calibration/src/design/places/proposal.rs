//! Additions to a set-up, as they are proposed.

use serde::{Serialize, Serializer};

use crate::design::Criterion;
use network::Remedy;
use observe::Measure;
use observe::kinds::Thing;

/// What is added.
#[derive(Debug, Clone, Copy)]
pub enum Addition {
    /// A place to stand.
    Station,
    /// Something to observe.
    Object(&'static Thing),
}

impl Addition {
    /// An object by how it is observed, and whether a length is read with it; `None` if no object is.
    #[must_use]
    pub fn of(measure: Measure, reads_length: bool) -> Option<Self> {
        (measure.kind().thing)(reads_length).map(Self::Object)
    }

    /// As a study calls it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Station => "station",
            Self::Object(thing) => thing.name,
        }
    }
}

impl PartialEq for Addition {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Serialize for Addition {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// Additions of one kind to a set-up, and what they promise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlaceProposal {
    /// What is added.
    pub adds: Addition,
    /// What that makes small.
    pub criterion: Criterion,
    /// The joints and ranges, in the order of the pointings' readings.
    pub readings: Vec<String>,
    /// The additions, the most telling first.
    pub places: Vec<Place>,
    /// Per error: name, its standard uncertainty now, and with all of these measured, SI.
    pub uncertainties: Vec<(String, f64, f64)>,
    /// Of each combination of several errors that is determined, in the order of the fit's: its standard uncertainty now, and with
    /// all of these measured, SI.
    pub combinations: Vec<(f64, f64)>,
    /// Errors that are not shown, nor would be.
    pub never: Vec<String>,
    /// What would show some of those.
    pub remedies: Vec<(Remedy, Vec<String>)>,
}

/// One addition.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Place {
    /// Where in the frame of the stations and objects, m.
    pub place_m: [f64; 3],
    /// Of a station: where its frame is turned about the vertical, rad.
    pub heading_rad: Option<f64>,
    /// Of a plane its normal, of a circle its axis.
    pub normal: Option<[f64; 3]>,
    /// How far from there all that is observed has to be, m; `None` where that may be any distance.
    pub radius_m: Option<f64>,
    /// What to measure.
    pub pointings: Vec<Pointing>,
}

/// One row to measure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Pointing {
    /// From where: the label of a station, empty for the new one and where there is none.
    pub station: String,
    /// At what: the label of an object, empty for the new one.
    pub object: String,
    /// About the readings of the joints and ranges, SI.
    pub readings: Vec<f64>,
}
