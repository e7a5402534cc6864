//! Observations in memory: what was measured at which joint readings, as a structure of arrays.
//!
//! Files become observations in [`crate::study`]; nothing here knows a file's format.

pub mod derive;
mod origin;
mod si_unit;
mod tangent;
pub mod units;
pub mod unknowns;

pub use derive::{DeriveError, Derived, parse_derived};
pub use origin::{Origin, Origins};
pub use si_unit::SiUnit;
pub use tangent::{direction_from_offset, direction_from_spherical, tangent_frame};

use std::ops::Range;

use model_core::{ObservableId, SymbolId};

use unknowns::Unknowns;

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
    /// A point on an unknown plane; one residual component, in metres: how far off the plane.
    Plane,
    /// A point that is an unknown target's, seen from a station; three residual components across, up and along the beam,
    /// in metres.
    Target,
    /// A point that stays where it is, however it is reached; three residual components x, y, z, in metres.
    Fixed,
    /// The length of a wire from an unknown anchor to the point; one residual component, in metres.
    Wire,
    /// The distance of the point from another, which other rows observe, or which is known or not; one residual component, in
    /// metres.
    Distance,
    /// A direction that is an unknown point's from a station; two residual components across and along, rad.
    Sight,
}

impl Measure {
    /// The number of residual components of one observation.
    #[must_use]
    pub fn components(self) -> usize {
        match self {
            Self::Direction | Self::Sight => 2,
            Self::Point | Self::Target | Self::Fixed => 3,
            Self::Range | Self::Azimuth | Self::Plane | Self::Wire | Self::Distance => 1,
        }
    }

    /// The SI unit of a residual.
    #[must_use]
    pub fn unit(self) -> SiUnit {
        match self {
            Self::Direction | Self::Azimuth | Self::Sight => SiUnit::RAD,
            Self::Point
            | Self::Range
            | Self::Plane
            | Self::Target
            | Self::Fixed
            | Self::Wire
            | Self::Distance => SiUnit::METRE,
        }
    }

    /// What the residual components are called.
    #[must_use]
    pub fn component_names(self) -> &'static [&'static str] {
        match self {
            Self::Direction | Self::Sight => &["across", "along"],
            Self::Point | Self::Fixed => &["x", "y", "z"],
            Self::Range => &["range"],
            Self::Azimuth => &["azimuth"],
            Self::Plane => &["off_plane"],
            Self::Target => &["across", "up", "along"],
            Self::Wire | Self::Distance => &["length"],
        }
    }

    /// What the same poses show where nothing stands that was observed: the point or the direction itself.
    #[must_use]
    pub fn bare(self) -> Self {
        match self {
            Self::Plane | Self::Target | Self::Fixed | Self::Wire | Self::Distance => Self::Point,
            Self::Sight => Self::Direction,
            Self::Direction | Self::Point | Self::Range | Self::Azimuth => self,
        }
    }
}

/// Consecutive rows that observe one thing in one way: one file of a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Series {
    /// What was observed.
    pub observable: ObservableId,
    /// What its numbers are.
    pub measure: Measure,
    /// Which rows.
    pub rows: Range<usize>,
    /// Name of the file or stream, for messages.
    pub source: String,
}

/// What stands for the standard uncertainties of a row that states none.
pub const UNSTATED: [f64; 3] = [1.0; 3];

/// Observations as a structure of arrays; rows are in order of acquisition where [`Self::in_sequence`] says so.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Observations {
    /// Blocks of rows, consecutive and covering every row.
    pub series: Vec<Series>,
    /// Readings of joints and inputs in SI, one value a row, sorted by symbol.
    pub columns: Vec<(SymbolId, Vec<f64>)>,
    /// What was measured: a unit vector, a point in m, `[range_m, 0, 0]`, `[azimuth_rad, 0, 0]`, `[length_m, 0, 0]`; zeros where
    /// a row has readings alone.
    pub measured: Vec<[f64; 3]>,
    /// Stated standard uncertainties of the residual components in rad or m; empty if none were stated, [`UNSTATED`] in
    /// the rows of a series that states none.
    pub sigma: Vec<[f64; 3]>,
    /// Group of each row: rows of one group are not independent and are held out together.
    pub groups: Vec<u32>,
    /// Whether the order of the rows is their order of acquisition.
    pub in_sequence: bool,
    /// Number of each row in its file, counted from 1 without the header.
    pub row_numbers: Vec<u64>,
    /// Where each row stands.
    pub origins: Origins,
    /// The objects and stations that nobody knows, if rows observe any.
    pub unknowns: Option<Unknowns>,
}

impl Observations {
    /// The number of observations.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.measured.len()
    }

    /// Whether the rows of a series state their standard uncertainties.
    #[must_use]
    pub fn states_sigma(&self, series: &Series) -> bool {
        self.sigma.get(series.rows.clone()).is_some_and(|own| own.iter().any(|sigma| *sigma != UNSTATED))
    }

    /// The readings of a joint or input, one value a row.
    #[must_use]
    pub fn column(&self, symbol: SymbolId) -> Option<&[f64]> {
        let at = self.columns.binary_search_by_key(&symbol, |(id, _)| *id).ok()?;
        self.columns.get(at).map(|(_, values)| values.as_slice())
    }

    /// The same poses with nothing that stands anywhere: the points and directions themselves.
    #[must_use]
    pub fn bare(&self) -> Self {
        let series = self.series.iter().map(|own| Series { measure: own.measure.bare(), ..own.clone() });
        Self { series: series.collect(), unknowns: None, ..self.clone() }
    }

    /// The number of residual components of all observations together.
    #[must_use]
    pub fn components(&self) -> usize {
        self.series.iter().map(|series| series.rows.len() * series.measure.components()).sum()
    }

    /// The measure of each row.
    pub fn measures(&self) -> impl Iterator<Item = Measure> + '_ {
        self.series.iter().flat_map(|series| std::iter::repeat_n(series.measure, series.rows.len()))
    }

    /// These rows, in the order given, with all that belongs to them. Every series is kept, though it may hold no rows.
    ///
    /// Rows must come series by series, in the order of the series; indices out of range are left out.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let rows: Vec<usize> = rows.iter().copied().filter(|&row| row < self.rows()).collect();
        let pick = |values: &[f64]| rows.iter().filter_map(|&row| values.get(row).copied()).collect();
        let mut start = 0;
        let series = self.series.iter().map(|from| {
            let own = rows[start..].iter().take_while(|&&row| from.rows.contains(&row)).count();
            start += own;
            Series { rows: start - own..start, ..from.clone() }
        });
        let series = series.collect();
        Self {
            series,
            columns: self.columns.iter().map(|(id, values)| (*id, pick(values))).collect(),
            measured: rows.iter().filter_map(|&row| self.measured.get(row).copied()).collect(),
            sigma: rows.iter().filter_map(|&row| self.sigma.get(row).copied()).collect(),
            groups: rows.iter().filter_map(|&row| self.groups.get(row).copied()).collect(),
            in_sequence: self.in_sequence,
            row_numbers: rows.iter().filter_map(|&row| self.row_numbers.get(row).copied()).collect(),
            origins: self.origins.select(&rows),
            unknowns: self.unknowns.as_ref().map(|unknowns| unknowns.select(&rows)),
        }
    }
}
