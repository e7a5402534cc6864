//! What the commands say is wrong, as Python's exceptions, and what they warn of, as its warnings.

use pyo3::prelude::*;
use pyo3::types::PyType;
use trueaxis_cli::library::{Failure, collecting};

use crate::forked;
use crate::interrupting::{Listener, watched};

/// A class of `trueaxis._errors`.
fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyType>> {
    Ok(py.import("trueaxis._errors")?.getattr(name)?.cast_into()?)
}

/// The exception for a failure, with the same words and places.
pub fn exception(py: Python<'_>, failure: &Failure) -> PyErr {
    let made = || match failure {
        Failure::Mistakes { rendered, mistakes } => {
            let mistakes: Vec<(usize, usize, String, Option<String>)> = mistakes
                .iter()
                .map(|mistake| {
                    let place = &mistake.place;
                    (place.line, place.column, mistake.message.clone(), mistake.help.clone())
                })
                .collect();
            class(py, "MistakeError")?.call1((rendered.trim_end(), mistakes))
        }
        _ => class(py, "TrueaxisError")?.call1((failure.to_string(),)),
    };
    made().map_or_else(|error| error, PyErr::from_value)
}

/// Does some work without holding the interpreter's lock; what it warns of becomes warnings of Python, what fails an
/// exception.
pub fn run<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T, Failure> + Send) -> PyResult<T> {
    run_and_tell(py, work).map(|(done, _)| done)
}

/// The same, with whether it warned of something.
pub fn run_and_tell<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> PyResult<(T, bool)> {
    told(py, collected(py, work)?)
}

/// The same as [`run`] of long work, which `hear` and signals may [end](watched); it [collects](collected) what it warns of.
pub fn run_watched<T: Send + 'static>(
    py: Python<'_>,
    hear: &(impl Fn(Python<'_>, String) -> PyResult<()> + Sync),
    work: impl FnOnce(&Listener) -> PyResult<Collected<T>> + Send + 'static,
) -> PyResult<T> {
    told(py, watched(py, hear, work)??).map(|(done, _)| done)
}

/// The same as [`run`] of work that may be long, which a signal ends for who asked.
pub fn run_interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
) -> PyResult<T> {
    let nobody_hears = |_: Python<'_>, _: String| Ok(());
    run_watched(py, &nobody_hears, |_| Python::attach(|py| collected(py, work)))
}

/// What came of some work, and what it warns of.
pub type Collected<T> = (Result<T, Failure>, Vec<String>);

/// Does some work without holding the interpreter's lock, and collects what it warns of.
pub fn collected<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> PyResult<Collected<T>> {
    py.detach(|| forked::with_threads(|| collecting(work)))
}

/// What was done, once its warnings have become Python's; whether there were any.
fn told<T>(py: Python<'_>, (done, warnings): Collected<T>) -> PyResult<(T, bool)> {
    if !warnings.is_empty() {
        let warn = py.import("trueaxis._errors")?.getattr("warn")?;
        for warning in &warnings {
            warn.call1((warning,))?;
        }
    }
    let done = done.map_err(|failure| exception(py, &failure))?;
    Ok((done, !warnings.is_empty()))
}
