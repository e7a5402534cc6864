//! The fit of many files: passes and sums of them as bytes, which Python carries to whoever has the rows.

use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use trueaxis_cli::library::{self, Foretold, Rows, Source, Streaming, Studied, Validation};

use crate::calibration::Calibration;
use crate::errors;
use crate::tables::{Given, Table};

/// A text with the name that mistakes in it are shown with: `(name, text)`.
type Text = (String, String);

/// A table in memory, or the path of a file: `(name, columns or none)`.
type Sample<'py> = (String, Option<Given<'py>>);

fn source((name, text): Text) -> Source {
    Source::of_text(name, &text)
}

/// Does something with rows that were given, without the interpreter's lock.
fn with_rows<T: Send>(
    py: Python<'_>,
    (name, columns): Sample<'_>,
    work: impl FnOnce(Rows<'_>) -> Result<T, library::Failure> + Send,
) -> PyResult<T> {
    let table = columns.map(Table::of).transpose()?;
    let columns = table.as_ref().map(Table::columns).transpose()?;
    errors::run(py, || {
        work(match &columns {
            Some(columns) => Rows::Table(library::table(&name, columns)?),
            None => Rows::File(&name),
        })
    })
}

/// A fit of many files, between passes.
#[pyclass(frozen, module = "trueaxis._native")]
pub struct Fitting {
    study: Text,
    chain: Text,
    /// None while it is being worked on.
    streaming: Mutex<Option<Streaming>>,
}

/// A study with its declaration, each from its text or its file.
fn studied(py: Python<'_>, study: (PathBuf, Option<String>), chain: Option<Text>) -> PyResult<Studied> {
    let (path, text) = study;
    errors::run(py, || {
        let study = match &text {
            Some(text) => Source::of_text(path, text),
            None => library::read(&path)?,
        };
        match chain {
            Some(chain) => library::studied(study, source(chain)),
            None => library::read_study(study),
        }
    })
}

impl Fitting {
    /// With the texts that its passes are made by; an error where there were no rows.
    fn started(py: Python<'_>, studied: &Studied, streaming: Option<Streaming>) -> PyResult<Self> {
        let as_text = |source: &Source| (source.path.display().to_string(), source.text.clone());
        let (study, chain) = (as_text(&studied.study), as_text(&studied.chain));
        match streaming {
            Some(_) => Ok(Self { study, chain, streaming: Mutex::new(streaming) }),
            None => Err(errors::exception(
                py,
                &library::Failure::Input("there are no rows in any file".to_owned()),
            )),
        }
    }
}

#[pymethods]
impl Fitting {
    /// Starts from some rows. A study without text is read from its file, a declaration that is not given from the file that the
    /// study names.
    #[new]
    fn new(
        py: Python<'_>,
        study: (PathBuf, Option<String>),
        chain: Option<Text>,
        sample: Sample<'_>,
    ) -> PyResult<Self> {
        let studied = studied(py, study, chain)?;
        let own = studied.clone();
        let streaming = with_rows(py, sample, |rows| Streaming::new(own, rows))?;
        Self::started(py, &studied, streaming)
    }

    /// Starts from about so many rows of some files, evenly from all.
    #[staticmethod]
    fn of_files(
        py: Python<'_>,
        study: (PathBuf, Option<String>),
        chain: Option<Text>,
        files: Vec<String>,
        rows: u64,
    ) -> PyResult<Self> {
        let studied = studied(py, study, chain)?;
        let own = studied.clone();
        let streaming = errors::run(py, || Streaming::new(own, Rows::Drawn(&files, rows)))?;
        Self::started(py, &studied, streaming)
    }

    /// The same fit, to be made of other rows.
    fn copy(&self) -> Self {
        let streaming = self.streaming.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Self { study: self.study.clone(), chain: self.chain.clone(), streaming: Mutex::new(streaming) }
    }

    /// The study and the declaration, each with its name.
    #[getter]
    fn texts(&self) -> (Text, Text) {
        (self.study.clone(), self.chain.clone())
    }

    /// The pass to make; none when the fit is done.
    fn step<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyBytes>> {
        let streaming = self.streaming.lock().unwrap_or_else(PoisonError::into_inner);
        streaming.as_ref().and_then(Streaming::pass).map(|bytes| PyBytes::new(py, &bytes))
    }

    /// Takes up what the chunks of all files say in that pass, in their order.
    fn take(&self, py: Python<'_>, files: Vec<Vec<Vec<u8>>>) -> PyResult<()> {
        let mut streaming = self.streaming.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(before) = streaming.take() else {
            return Err(pyo3::exceptions::PyValueError::new_err("this fit has failed"));
        };
        *streaming = Some(errors::run(py, || before.take(&files))?);
        Ok(())
    }

    /// Takes every row into a calibration of some: this fit of all, the same fit of those that it read, and sums over the others.
    fn complete(
        &self,
        py: Python<'_>,
        calibration: &mut Calibration,
        drawn: &Self,
        files: usize,
        sums: Option<(u64, u64, [f64; 2], [f64; 2])>,
    ) -> PyResult<()> {
        let [fit, drawn] =
            [self, drawn].map(|one| one.streaming.lock().unwrap_or_else(PoisonError::into_inner));
        let (Some(fit), Some(drawn)) = (fit.as_ref(), drawn.as_ref()) else {
            return Err(pyo3::exceptions::PyValueError::new_err("this fit has failed"));
        };
        let validation =
            sums.map(|(rows, kept, squares, squares_kept)| Validation { rows, kept, squares, squares_kept });
        errors::run(py, || fit.complete(&mut calibration.0, drawn, files, validation))
    }

    /// What was found, as JSON; none while there are passes to make.
    fn found(&self) -> Option<String> {
        let streaming = self.streaming.lock().unwrap_or_else(PoisonError::into_inner);
        streaming.as_ref().and_then(Streaming::found).map(|found| found.to_string())
    }
}

/// Which rows of files with so many rows to draw for a search: of each file stretches, each from a row to the one behind it.
#[pyfunction]
pub fn stretches(rows: Vec<u64>, wanted: u64, seed: u64) -> Vec<Vec<(u64, u64)>> {
    let drawn = library::stretches(&rows, wanted, seed).into_iter();
    drawn.map(|own| own.into_iter().map(|stretch| (stretch.start, stretch.end)).collect()).collect()
}

/// How two declarations, each with a file of errors, foretell some rows: rows, rows kept, squares of the residuals before and after, and
/// those of the rows kept.
#[pyfunction]
pub fn validate(
    py: Python<'_>,
    study: Text,
    before: (Text, Text),
    after: (Text, Text),
    rows: (String, Given<'_>),
    floor: Vec<f64>,
) -> PyResult<(u64, u64, [f64; 2], [f64; 2])> {
    let (name, columns) = rows;
    let table = Table::of(columns)?;
    let columns = table.columns()?;
    let Validation { rows, kept, squares, squares_kept } = errors::run(py, || {
        let read = |(chain, errors): (Text, Text)| {
            let studied = library::studied(source(study.clone()), source(chain))?;
            Ok::<_, library::Failure>((studied, source(errors)))
        };
        let (before, after) = (read(before)?, read(after)?);
        let foretold = |(studied, errors)| Foretold { studied, errors };
        let rows = || library::table(&name, &columns).map(Rows::Table);
        library::validated(
            foretold((&before.0, &before.1)),
            foretold((&after.0, &after.1)),
            [rows()?, rows()?],
            &floor,
        )
    })?;
    Ok((rows, kept, squares, squares_kept))
}

/// What some rows say in a pass, as bytes; none where there are none.
#[pyfunction]
pub fn accumulate<'py>(
    py: Python<'py>,
    study: Text,
    chain: Text,
    rows: Sample<'py>,
    pass: Vec<u8>,
) -> PyResult<Option<Bound<'py, PyBytes>>> {
    let studied = errors::run(py, || library::studied(source(study), source(chain)))?;
    let bytes = with_rows(py, rows, |rows| library::accumulated(&studied, rows, &pass))?;
    Ok(bytes.map(|bytes| PyBytes::new(py, &bytes)))
}
