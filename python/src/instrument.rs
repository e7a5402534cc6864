//! Instrument files: a calibrated instrument as one text.

use pyo3::prelude::*;
use trueaxis_cli::library;

use crate::chain::{Text, source, told};
use crate::errors;
use crate::tables::{Given, Table};

/// A calibrated instrument.
#[pyclass(frozen, module = "trueaxis._native")]
pub struct Instrument(library::Instrument);

#[pymethods]
impl Instrument {
    /// Reads the text of an instrument file.
    #[staticmethod]
    fn from_text(py: Python<'_>, text: String, name: String) -> PyResult<Self> {
        errors::run(py, || library::instrument(&source((name, text)))).map(Self)
    }

    /// The declaration, with the name that mistakes in it are shown with.
    #[getter]
    fn declaration(&self) -> Text {
        let declaration = &self.0.declaration;
        (declaration.path.display().to_string(), declaration.text.clone())
    }

    /// The values of its errors and of constants that were fitted: `(name, value, unit)`.
    #[getter]
    fn values(&self) -> Vec<(String, f64, &'static str)> {
        library::values_of(&self.0)
    }

    /// The ranges of joints and inputs that it was found over: `(name, smallest, largest)`.
    #[getter]
    fn found_over(&self) -> Vec<(String, f64, f64)> {
        library::ranges_of(&self.0)
    }

    /// The day of the calibration.
    #[getter]
    fn made(&self) -> Option<String> {
        self.0.made.clone()
    }

    /// The last day on which it counts.
    #[getter]
    fn valid_until(&self) -> Option<String> {
        self.0.valid_until.clone()
    }

    /// Whether it is still valid by a table of new rows: the answer as the command prints it, and as JSON.
    fn verify(
        &self,
        py: Python<'_>,
        table: (String, Given<'_>),
        goal: Option<String>,
        false_alarm: Option<f64>,
    ) -> PyResult<(String, String)> {
        let (name, columns) = table;
        let table = Table::of(columns)?;
        let columns = table.columns()?;
        let verified = || library::verified(&self.0, (&name, &columns), goal.as_deref(), false_alarm);
        Ok(told(errors::run(py, verified)?))
    }
}

/// What changed from the first of some instruments to the last, each with its name.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    instruments: Vec<(String, PyRef<'_, Instrument>)>,
) -> PyResult<(String, String)> {
    let instruments: Vec<(String, library::Instrument)> =
        instruments.into_iter().map(|(name, instrument)| (name, instrument.0.clone())).collect();
    let compared = || {
        let named: Vec<(String, &library::Instrument)> =
            instruments.iter().map(|(name, instrument)| (name.clone(), instrument)).collect();
        library::compared(&named)
    };
    Ok(told(errors::run(py, compared)?))
}
