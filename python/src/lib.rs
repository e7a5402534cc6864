//! The native part of the Python package: chains, arrays and calibrations. What Python says better is in `trueaxis/`.

mod applying;
mod arrays;
mod calibration;
mod chain;
mod compiled;
mod errors;
mod evaluating;
mod forked;
mod formula;
mod instrument;
mod interrupting;
mod rows;
mod streaming;
mod tables;

use pyo3::prelude::*;

/// What `trueaxis` is made of; use `trueaxis` itself.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::applying::{apply, read_text, warn_of_outside};
    #[pymodule_export]
    use super::calibration::{Calibration, Study, calibrate};
    #[pymodule_export]
    use super::chain::{Chain, check};
    #[pymodule_export]
    use super::compiled::{Call, Loadable};
    #[pymodule_export]
    use super::formula::ClosedForm;
    #[pymodule_export]
    use super::instrument::{Instrument, compare};
    #[pymodule_export]
    use super::streaming::{Fitting, accumulate, stretches, validate};

    use super::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        forked::loaded();
        arrays::loaded(module.py())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
