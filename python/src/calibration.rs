//! Studies and calibrations.

use std::path::PathBuf;
use std::sync::Mutex;

use pyo3::prelude::*;
use trueaxis_cli::library::{self, Calibrated, Cells, Source, Stage, Studied};

use crate::chain::{Chain, Columns, as_arrays};
use crate::errors;
use crate::tables::{Sent, Table, received};

/// A study with the declaration that it is of, every name resolved.
#[pyclass(frozen, module = "trueaxis._native")]
pub struct Study {
    /// Taken by the calibration.
    studied: Mutex<Option<Studied>>,
    tables: Vec<String>,
}

#[pymethods]
impl Study {
    /// Resolves a study from a file or, where there is a text, from that text beside where the file would be; with the
    /// declaration that it names, or with another.
    #[new]
    fn new(py: Python<'_>, path: PathBuf, text: Option<&str>, chain: Option<&Chain>) -> PyResult<Self> {
        let chain = chain.map(|chain| chain.source().clone());
        let studied = errors::run(py, || {
            let study = match text {
                Some(text) => Source::of_text(path, text),
                None => library::read(&path)?,
            };
            match chain {
                Some(chain) => library::studied(study, chain),
                None => library::read_study(study),
            }
        })?;
        let tables = studied.tables().map(str::to_owned).collect();
        Ok(Self { studied: Mutex::new(Some(studied)), tables })
    }

    /// The tables that it names.
    #[getter]
    fn tables(&self) -> Vec<String> {
        self.tables.clone()
    }
}

/// What came of a study.
#[pyclass(module = "trueaxis._native")]
pub struct Calibration(pub(crate) Calibrated);

/// Calibrates; takes the study up. `progress` is called with what is being done.
#[pyfunction]
pub fn calibrate(
    py: Python<'_>,
    study: &Study,
    tables: Vec<(String, Sent)>,
    command: String,
    progress: Option<Py<PyAny>>,
) -> PyResult<Calibration> {
    let studied = study.studied.lock().ok().and_then(|mut studied| studied.take());
    let Some(studied) = studied else {
        return Err(pyo3::exceptions::PyValueError::new_err("this study has been calibrated already"));
    };
    let hear = |py: Python<'_>, text: String| match &progress {
        Some(progress) => progress.call1(py, (text,)).map(|_| ()),
        None => Ok(()),
    };
    let calibrated = errors::run_watched(py, &hear, move |listener| {
        Python::attach(|py| {
            let tables = tables
                .into_iter()
                .map(|(name, columns)| Ok((name, Table::of(received(py, columns))?)))
                .collect::<PyResult<Vec<_>>>()?;
            let columns = tables
                .iter()
                .map(|(name, table)| Ok((name.as_str(), table.columns()?)))
                .collect::<PyResult<Vec<_>>>()?;
            let tell = |stage: Stage| listener.tell(stage.to_string());
            errors::collected(py, || library::calibrated(studied, &columns, command, &tell))
        })
    })?;
    Ok(Calibration(calibrated))
}

#[pymethods]
impl Calibration {
    /// The summary, as the command prints it.
    fn text(&self, py: Python<'_>, is_verbose: bool) -> PyResult<String> {
        errors::run(py, || Ok(library::text(&self.0, is_verbose)))
    }

    /// `report.json`.
    fn report(&self, py: Python<'_>) -> PyResult<String> {
        errors::run(py, || library::report_json(&self.0))
    }

    /// `report.html`, or its first screen and its pictures.
    fn html(&self, py: Python<'_>, is_whole: bool) -> PyResult<String> {
        errors::run(py, || Ok(library::report_html(&self.0, is_whole)))
    }

    /// The amended declaration, if a usable model came out.
    #[getter]
    fn amended(&self) -> Option<&str> {
        self.0.calibration.amended.as_deref()
    }

    /// `errors.toml`, if a usable model came out.
    #[getter]
    fn errors_toml(&self) -> Option<String> {
        library::errors_toml(&self.0)
    }

    /// `instrument.toml`, if a usable model came out.
    #[getter]
    fn instrument_toml(&self) -> Option<String> {
        library::instrument_toml(&self.0)
    }

    /// The values of every error of the amended chain, and of constants that were fitted, each with its unit.
    #[getter]
    fn values(&self) -> Option<Vec<(String, f64, &'static str)>> {
        library::estimates(&self.0)
    }

    /// The ranges of joints and inputs that it was found over: `(name, smallest, largest)`.
    #[getter]
    fn found_over(&self) -> Option<Vec<(String, f64, f64)>> {
        library::found_over(&self.0)
    }

    /// `residuals.csv` of every row as columns; NaN where a row has no such component.
    fn residuals(&self, py: Python<'_>) -> PyResult<Columns> {
        let columns = errors::run(py, || {
            Ok(library::residuals(&self.0, |columns| {
                let numbers = |cells: Cells<'_>| match cells {
                    Cells::Rows(rows) => Some(rows.into_iter().map(|row| row as f64).collect()),
                    Cells::Numbers(numbers) => Some(numbers.into_owned()),
                    Cells::Residuals(some) => Some(some.into_iter().map(|r| r.unwrap_or(f64::NAN)).collect()),
                    // An array holds numbers; the files and names of rows are those of the caller's own table.
                    Cells::Texts(_) => None,
                };
                let numbers = |(name, cells)| Some((name, numbers(cells)?));
                columns.into_iter().filter_map(numbers).collect::<Vec<_>>()
            }))
        })?;
        Ok(as_arrays(py, columns))
    }

    /// Writes every file of the calibration into a folder.
    fn write(&self, py: Python<'_>, folder: PathBuf, all_residuals: bool) -> PyResult<()> {
        errors::run(py, || library::write(&self.0, &folder, all_residuals))
    }
}
