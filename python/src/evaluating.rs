//! Forms as numbers over arrays: what a call asks, once it is checked, and the two ways to compute it.

use std::fmt::Display;

use codegen::{Form, Program, ShapeError};
use model_core::{Chain, ObservableId, SymbolId};
use numpy::{
    PyArray, PyArrayMethods as _, PyReadonlyArray1, PyReadwriteArray, PyUntypedArrayMethods as _,
    ndarray::IxDyn,
};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use trueaxis_cli::library::{self, Failure};

use crate::compiled::{Asked, Call, Loadable};
use crate::interrupting::Ears;
use crate::tables::Given;
use crate::{arrays, errors, forked, rows};

/// Readings by symbol: a column with a number a row, or one number for all rows.
pub struct Readings<'py> {
    columns: Vec<(SymbolId, PyReadonlyArray1<'py, f64>)>,
    numbers: Vec<(SymbolId, f64)>,
}

impl<'py> Readings<'py> {
    /// Columns of one length as somebody gave them, each with its symbol by `named`.
    pub fn columns(
        py: Python<'py>,
        given: &Given<'py>,
        named: impl Fn(&str) -> Result<SymbolId, Failure>,
    ) -> PyResult<Self> {
        let read = |(name, column): &(String, Bound<'py, PyAny>)| {
            let id = named(name).map_err(|failure| errors::exception(py, &failure))?;
            Ok((id, arrays::column(name, column)?))
        };
        let columns: Vec<_> = given.iter().map(read).collect::<PyResult<_>>()?;
        let readings = Self { columns, numbers: Vec::new() };
        let (rows, mut all) = (readings.rows(), readings.columns.iter().zip(given));
        if let Some(((_, column), (name, _))) = all.find(|((_, column), _)| column.len() != rows) {
            let (found, (first, _)) = (column.len(), &given[0]);
            return Err(PyValueError::new_err(format!("`{name}` has {found} rows, `{first}` has {rows}")));
        }
        Ok(readings)
    }

    /// With a number that holds for all rows.
    pub fn with_number(mut self, id: SymbolId, number: f64) -> Self {
        self.numbers.push((id, number));
        self
    }

    /// How many rows there are: one where every reading is a number.
    fn rows(&self) -> usize {
        self.columns.first().map_or(1, |(_, column)| column.len())
    }

    fn has(&self, id: SymbolId) -> bool {
        let columns = self.columns.iter().map(|(id, _)| *id);
        columns.chain(self.numbers.iter().map(|(id, _)| *id)).any(|given| given == id)
    }
}

/// What a call asks: which form of which observable, over what.
pub struct Evaluation<'py> {
    pub form: Form,
    pub observable: ObservableId,
    /// Columns of the readings that the observable needs.
    columns: Vec<(SymbolId, PyReadonlyArray1<'py, f64>)>,
    /// Values of all symbols; of readings, those that are one number for all rows.
    values: Vec<f64>,
    /// The symbols that derivatives are taken by.
    pub wrt: Vec<SymbolId>,
    rows: usize,
    threads: Option<usize>,
}

impl<'py> Evaluation<'py> {
    /// Over some readings, beside the values of errors and constants.
    ///
    /// # Errors
    /// A reading that the observable needs is not there.
    pub fn new(
        chain: &Chain,
        (form, observable): (Form, ObservableId),
        readings: Readings<'py>,
        mut values: Vec<f64>,
        (wrt, threads): (Vec<SymbolId>, Option<usize>),
    ) -> Result<Self, Failure> {
        let needed = library::readings_of(chain, observable);
        if let Some(&missing) = needed.iter().find(|&&id| !readings.has(id)) {
            let (shown, missing) = (&chain.observable(observable).name, &chain.symbol(missing).name);
            return Err(Failure::Input(format!("`{shown}` needs readings of `{missing}`: give them")));
        }
        let rows = readings.rows();
        readings.numbers.iter().for_each(|&(id, number)| values[id.index()] = number);
        let columns = readings.columns.into_iter().filter(|(id, _)| needed.contains(id)).collect();
        Ok(Self { form, observable, columns, values, wrt, rows, threads })
    }

    /// The shape of the result: what is shown, what derivatives are taken by, rows.
    pub fn shape(&self, chain: &Chain) -> Vec<usize> {
        let shown = chain.observable(self.observable).shown.len();
        if self.form.is_jacobian() { vec![shown, self.wrt.len(), self.rows] } else { vec![shown, self.rows] }
    }

    /// Refuses an array for the result that would write over readings: two arrays of one memory know nothing of each other.
    pub fn require_apart(&self, out: &Bound<'py, PyArray<f64, IxDyn>>) -> PyResult<()> {
        let lies = |start: *mut f64, numbers: usize| start.addr()..start.addr() + numbers * size_of::<f64>();
        let into = lies(out.data(), out.len());
        let is_met = |column: &PyReadonlyArray1<'py, f64>| {
            let read = lies(column.data(), column.len());
            read.start < into.end && into.start < read.end
        };
        if !into.is_empty() && self.columns.iter().any(|(_, column)| is_met(column)) {
            return Err(unwritable("it lies where readings lie"));
        }
        Ok(())
    }

    /// By the interpreter, without the interpreter's lock of Python; a signal ends it.
    pub fn interpreted(&self, py: Python<'py>, program: &Program, into: &mut [f64]) -> PyResult<()> {
        let slices = self.columns.iter().map(|(id, column)| Ok((*id, column.as_slice()?)));
        let slices = slices.collect::<PyResult<Vec<(SymbolId, &[f64])>>>()?;
        let (values, rows, threads) = (&self.values, self.rows, self.threads);
        let mut ears = Ears::default();
        let done = py.detach(|| {
            forked::with_threads(|| {
                rows::evaluate(program, &slices, values, into, (rows, threads), || {
                    ears.listen().map_err(Ended::Signal)
                })
            })
        })?;
        done.map_err(|ended| match ended {
            Ended::Signal(raised) => raised,
            Ended::Shape(error) => PyValueError::new_err(error.to_string()),
        })
    }

    /// What a call of compiled code takes to write the result: to an address, in what is held meanwhile.
    pub fn call(&self, chain: &Chain, loadable: &Loadable, out: (usize, Py<PyAny>)) -> Result<Call, Failure> {
        let columns: Vec<_> = self.columns.iter().map(|(id, column)| (*id, (**column).clone())).collect();
        let (values, wrt, rows, threads) = (&self.values, &self.wrt, self.rows, self.threads);
        Call::new(loadable, chain, Asked { columns: &columns, values, wrt, out, rows, threads })
    }
}

/// Why an evaluation ended early.
enum Ended {
    /// What a signal raised.
    Signal(PyErr),
    Shape(ShapeError),
}

impl From<ShapeError> for Ended {
    fn from(error: ShapeError) -> Self {
        Self::Shape(error)
    }
}

/// The array for a result: the one that somebody gave, or a new one. Where every reading is one number, nobody sees the axis of rows.
pub fn result<'py>(
    py: Python<'py>,
    given: Option<&Bound<'py, PyAny>>,
    shape: &[usize],
    is_one: bool,
) -> PyResult<Bound<'py, PyArray<f64, IxDyn>>> {
    match given {
        Some(given) => taken(given, shape, is_one),
        // Every number of it is written. NumPy asks for large pages here, and for zeros does not.
        None => taken(&py.import("numpy")?.call_method1("empty", (shape.to_vec(),))?, shape, is_one),
    }
}

/// The array that somebody gave for the result.
fn taken<'py>(
    given: &Bound<'py, PyAny>,
    shape: &[usize],
    is_one: bool,
) -> PyResult<Bound<'py, PyArray<f64, IxDyn>>> {
    let array = given
        .cast::<PyArray<f64, IxDyn>>()
        .ok()
        .filter(|array| array.shape() == shape && array.is_c_contiguous());
    let Some(array) = array else {
        let seen = &shape[..shape.len() - usize::from(is_one)];
        let seen = match seen {
            [only] => format!("({only},)"),
            several => format!("({})", several.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")),
        };
        return Err(PyTypeError::new_err(format!(
            "`out`: a contiguous NumPy array of float64 with the shape {seen} is needed; write \
             numpy.empty({seen})"
        )));
    };
    Ok(array.clone())
}

/// The numbers of a result, to be written.
pub fn writable<'py>(array: &Bound<'py, PyArray<f64, IxDyn>>) -> PyResult<PyReadwriteArray<'py, f64, IxDyn>> {
    array.try_readwrite().map_err(unwritable)
}

fn unwritable(why: impl Display) -> PyErr {
    PyValueError::new_err(format!("`out`: {why}: it must be writable, and none of the readings"))
}
