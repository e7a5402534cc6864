//! A row of a table as a kind of observation reads it.

use model_core::{SymbolId, exact};
use nalgebra::{UnitQuaternion, Vector3};

use super::orientation::Form;
use super::shown::Convention;
use observe::direction_from_spherical;
use observe::kinds::Cells;
use observe::orientation::Turned;

/// The rows of a source, and the one that is read.
pub(super) struct RowCells<'a> {
    pub row: usize,
    /// The columns of `[observed]`, in order.
    pub observed: &'a [&'a [f64]],
    pub readings: &'a [(SymbolId, Vec<f64>)],
    /// What two angles mean, where the declaration says so.
    pub convention: Option<Convention>,
    /// The vector of the observable.
    pub path: exact::Path,
    /// How an orientation is written, and that of the body by design.
    pub turned: Option<(Form, Turned)>,
    /// Of all symbols, without errors; room for the readings of a row.
    pub values: Vec<f64>,
}

impl RowCells<'_> {
    /// Takes the readings of the row.
    fn read(&mut self) {
        for (id, readings) in self.readings {
            self.values[id.index()] = readings[self.row];
        }
    }
}

impl Cells for RowCells<'_> {
    fn at(&self, column: usize) -> f64 {
        self.observed.get(column).map_or(0.0, |values| values[self.row])
    }

    fn direction(&self, azimuth_rad: f64, second_rad: f64) -> (Vector3<f64>, f64) {
        match &self.convention {
            Some(convention) => convention.direction(azimuth_rad, second_rad),
            None => (direction_from_spherical(azimuth_rad, second_rad), second_rad),
        }
    }

    fn nominal(&mut self) -> Vector3<f64> {
        self.read();
        self.path.value(&self.values)
    }

    fn orientation(&mut self) -> Result<UnitQuaternion<f64>, String> {
        self.read();
        let Some((form, turned)) = &self.turned else { unreachable!("an orientation has a form") };
        form.read(|column| self.at(column), || turned.at(&self.values))
    }
}
