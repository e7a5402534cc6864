//! Tables of data frames: named columns, numbers as they lie in memory and texts copied.

use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyList;
use trueaxis_cli::library::Column;

use crate::arrays;

/// One column as Python handed it over.
enum Held<'py> {
    Numbers(PyReadonlyArray1<'py, f64>),
    Texts(Vec<String>),
    Other { labels: Option<PyReadonlyArray1<'py, f64>>, rows: usize, why: String },
}

/// Names of columns and the columns, as Python hands them over.
pub type Given<'py> = Vec<(String, Bound<'py, PyAny>)>;

/// The same, on their way to another thread.
pub type Sent = Vec<(String, Py<PyAny>)>;

/// Columns that came from another thread.
pub fn received(py: Python<'_>, sent: Sent) -> Given<'_> {
    sent.into_iter().map(|(name, column)| (name, column.into_bound(py))).collect()
}

/// A table as Python handed it over: `[(name, array of float64, list of str or (labels or none, rows, why it is neither))]`.
pub struct Table<'py> {
    columns: Vec<(String, Held<'py>)>,
}

impl<'py> Table<'py> {
    /// Takes the columns over.
    pub fn of(given: Given<'py>) -> PyResult<Self> {
        let held = |(name, column): (String, Bound<'py, PyAny>)| {
            if let Ok((labels, rows, why)) = column.extract::<(Option<Bound<'py, PyAny>>, usize, String)>() {
                let labels = labels.map(|labels| arrays::column(&name, &labels)).transpose()?;
                return Ok((name, Held::Other { labels, rows, why }));
            }
            // Of an array, room for as many texts would be made before it is seen that there are none.
            let texts = column.cast::<PyList>().ok().map(|texts| texts.extract()).transpose()?;
            let held = match texts {
                Some(texts) => Held::Texts(texts),
                None => Held::Numbers(arrays::column(&name, &column)?),
            };
            Ok((name, held))
        };
        Ok(Self { columns: given.into_iter().map(held).collect::<PyResult<_>>()? })
    }

    /// The columns as the library reads them.
    pub fn columns(&self) -> PyResult<Vec<(&str, Column<'_>)>> {
        self.columns
            .iter()
            .map(|(name, held)| {
                let column = match held {
                    Held::Numbers(array) => Column::Numbers(array.as_slice()?),
                    Held::Texts(texts) => Column::Texts(texts),
                    Held::Other { labels, rows, why } => {
                        let labels = labels.as_ref().map(|labels| labels.as_slice()).transpose()?;
                        Column::Other { labels, rows: *rows, why }
                    }
                };
                Ok((name.as_str(), column))
            })
            .collect()
    }
}
