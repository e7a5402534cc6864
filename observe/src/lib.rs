//! Observations in memory: what was measured at which joint readings, as a structure of arrays.
//!
//! Files become observations in the crate `study`; nothing here knows a file's format.

pub mod derive;
pub mod golden;
mod joined;
pub mod kinds;
mod numbers;
pub mod orientation;
mod origin;
mod places;
mod poses;
mod sample;
mod si_unit;
mod site;
mod tangent;

pub mod unknowns;
pub mod waves;

pub use derive::{DeriveError, Derived, parse_derived};
pub use kinds::{Measure, Measured, NoiseOf};
pub use numbers::Numbers;
pub use origin::Places;
pub use origin::{Origin, Origins};
pub use places::places;
pub use poses::{Poses, Series};
pub use si_unit::SiUnit;
pub use tangent::{
    direction_from_offset, direction_from_spherical, offset_of_direction, spherical_of_direction,
    tangent_frame,
};

use std::collections::BTreeSet;

use model_core::SymbolId;
use unknowns::Unknowns;

/// What the groups of rows are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Grouping {
    /// What the study says: each row by itself if it says nothing.
    #[default]
    Declared,
    /// Places that rows were found to share something at.
    Places,
    /// Rows that follow each other, so many together: they were found to be off alike.
    Stretches {
        /// Rows of a stretch.
        rows: usize,
    },
}

/// Observations as a structure of arrays; rows are in order of acquisition where [`Self::in_sequence`] says so.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Observations {
    /// At which readings what was observed.
    pub poses: Poses,
    /// What was measured, one value a row.
    pub measured: Vec<Measured>,
    /// Standard uncertainties of the residual components in rad or m, one value a row, `None` where none is stated; empty
    /// where no row states any.
    pub sigma: Vec<Option<[f64; 3]>>,
    /// Standard uncertainties of the readings of joints and inputs, SI, one value a row; those that are none are exact.
    pub reading_sigma: Vec<(SymbolId, Vec<f64>)>,
    /// Correlations of two readings of a row, one value a row; pairs that are none are off independently.
    pub reading_correlation: Vec<([SymbolId; 2], Vec<f64>)>,
    /// Group of each row: rows of one group are not independent and are held out together.
    pub groups: Vec<u32>,
    /// The site of each row, which is held out as a whole and is one unit to the ±, though noise does not hang together there; empty
    /// where groups alone count.
    pub together: Vec<u32>,
    /// The target that each row observes, whose coordinates it shares with others; empty where none is named.
    pub targets: Vec<u32>,
    /// What groups are.
    pub grouping: Grouping,
    /// The groups that somebody declared, where places that cross them count as groups: what their rows share is taken out of the
    /// noise; empty elsewhere.
    pub crossed: Vec<u32>,
    /// Whether the order of the rows is their order of acquisition.
    pub in_sequence: bool,
    /// Joints and inputs of which some file has the readings in another unit than rad or m.
    pub converted: BTreeSet<SymbolId>,
    /// Number of each row in its file, counted from 1 without the header; empty where no file was read.
    pub row_numbers: Numbers,
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

    /// The number of a row as its reader knows it: in its file, or here, counted from 1.
    #[must_use]
    pub fn row_number(&self, row: usize) -> u64 {
        self.row_numbers.get(row).unwrap_or(row as u64 + 1)
    }

    /// Whether the rows of a series state their standard uncertainties.
    #[must_use]
    pub fn states_sigma(&self, series: &Series) -> bool {
        self.sigma.get(series.rows.clone()).is_some_and(|own| own.iter().any(Option::is_some))
    }

    /// What the noise of each kind of component is of, series by series, component by component.
    #[must_use]
    pub fn noise_of_kinds(&self) -> Vec<NoiseOf> {
        let measures = self.poses.series.iter().map(|series| series.measure);
        measures.flat_map(|measure| measure.kind().noise.into_iter().take(measure.components())).collect()
    }

    /// These rows, in the order given, with all that belongs to them. Every series is kept, though it may hold no rows.
    ///
    /// Rows must come series by series, in the order of the series; indices out of range are left out.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        let rows: Vec<usize> = rows.iter().copied().filter(|&row| row < self.rows()).collect();
        let picked = |values: &[f64]| rows.iter().filter_map(|&row| values.get(row).copied()).collect();
        Self {
            poses: self.poses.select(&rows),
            measured: rows.iter().filter_map(|&row| self.measured.get(row).copied()).collect(),
            sigma: rows.iter().filter_map(|&row| self.sigma.get(row).copied()).collect(),
            reading_sigma: self.reading_sigma.iter().map(|(id, own)| (*id, picked(own))).collect(),
            reading_correlation: self
                .reading_correlation
                .iter()
                .map(|(id, own)| (*id, picked(own)))
                .collect(),
            groups: rows.iter().filter_map(|&row| self.groups.get(row).copied()).collect(),
            together: rows.iter().filter_map(|&row| self.together.get(row).copied()).collect(),
            targets: rows.iter().filter_map(|&row| self.targets.get(row).copied()).collect(),
            grouping: self.grouping,
            crossed: rows.iter().filter_map(|&row| self.crossed.get(row).copied()).collect(),
            in_sequence: self.in_sequence,
            converted: self.converted.clone(),
            row_numbers: self.row_numbers.select(&rows),
            origins: self.origins.select(&rows),
            unknowns: self.unknowns.as_ref().map(|unknowns| unknowns.select(&rows)),
        }
    }

    /// The same without some of the objects and their rows.
    #[must_use]
    pub fn without_objects(&self, is_left_out: impl Fn(usize) -> bool) -> Self {
        let Some(unknowns) = &self.unknowns else { return self.clone() };
        let stays = |row: &usize| unknowns.object[*row].is_none_or(|object| !is_left_out(object as usize));
        let rows: Vec<usize> = (0..self.rows()).filter(stays).collect();
        let mut kept = self.select(&rows);
        if let Some(unknowns) = &mut kept.unknowns {
            unknowns.remove_objects(is_left_out);
        }
        kept
    }
}
