//! NumPy arrays as slices, without copies: only what lies in memory as Rust's slices do, and the words for what does not.

use numpy::{PyArray1, PyArrayMethods as _, PyReadonlyArray1, PyUntypedArrayMethods as _};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Fetches all of NumPy that arrays need: where that is left to the first call, a signal that arrives in it is a panic.
pub fn loaded(py: Python<'_>) -> PyResult<()> {
    py.import("numpy")?;
    let array = PyArray1::from_vec(py, vec![0.0_f64]);
    array.try_readwrite().map(drop).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// A column of numbers as somebody gave it.
pub fn column<'py>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let wrong = |what: String, instead: String| {
        Err(PyTypeError::new_err(format!("`{name}`: {what}; write {instead}")))
    };
    let Ok(array) = given.cast::<PyArray1<f64>>() else {
        let Ok(untyped) = given.cast::<numpy::PyUntypedArray>() else {
            let found = given.get_type().name()?;
            return wrong(
                format!("a NumPy array of float64 is needed, this is a {found}"),
                format!("numpy.asarray({name}, dtype=numpy.float64)"),
            );
        };
        if untyped.ndim() != 1 {
            let dimensions = untyped.ndim();
            return wrong(
                format!("an array of one dimension is needed, this has {dimensions}"),
                format!("{name}.ravel(), or one column of it"),
            );
        }
        return wrong(
            format!("an array of float64 is needed, this holds {}", untyped.dtype().str()?),
            format!("{name}.astype(numpy.float64)"),
        );
    };
    if !array.is_contiguous() {
        return wrong(
            "the array is not contiguous in memory".to_owned(),
            format!("numpy.ascontiguousarray({name})"),
        );
    }
    if !array.getattr("flags")?.getattr("aligned")?.extract::<bool>()? {
        return wrong("the array is not aligned in memory".to_owned(), format!("{name}.copy()"));
    }
    // Of a masked array the values under the mask are no readings.
    if let Ok(mask) = given.getattr("mask")
        && mask.call_method0("any")?.extract::<bool>()?
    {
        return wrong(
            "some of its rows are masked".to_owned(),
            format!("{name}.filled(numpy.nan), or leave these rows out"),
        );
    }
    array.try_readonly().map_err(|error| PyValueError::new_err(format!("`{name}`: {error}")))
}
