//! Compiled C in place of the interpreter: what is to be compiled, and a call of it with the addresses that C wants.
//!
//! Nothing of C is called here. Python loads the library and calls its entries with what a [`Call`] says.

use codegen::Form;
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::prelude::*;
use trueaxis_cli::library::{self, Failure};

use crate::rows;

/// Every form by its name.
pub const FORMS: [(&str, Form); 5] = [
    ("exact error", Form::ExactError),
    ("exact value", Form::ExactValue),
    ("first-order error", Form::FirstOrderError),
    ("exact jacobian", Form::ExactJacobian),
    ("first-order jacobian", Form::FirstOrderJacobian),
];

/// The C of one observable.
#[pyclass(frozen, module = "trueaxis._native")]
pub struct Loadable {
    observable: ObservableId,
    name: String,
    c: library::Loadable,
}

impl Loadable {
    pub fn new(chain: &Chain, observable: ObservableId, c: library::Loadable) -> Self {
        Self { observable, name: chain.observable(observable).name.clone(), c }
    }

    /// The observable, if it is the one that is named or none is.
    ///
    /// # Errors
    /// Another name.
    pub fn only(&self, chain: &Chain, name: Option<&str>) -> Result<ObservableId, Failure> {
        if let Some(name) = name
            && library::observable(chain, Some(name))? != self.observable
        {
            return Err(Failure::Input(format!(
                "this is compiled for `{}`: compile `{name}` too",
                self.name
            )));
        }
        Ok(self.observable)
    }
}

#[pymethods]
impl Loadable {
    /// The observable.
    #[getter]
    fn observable(&self) -> &str {
        &self.name
    }

    /// `(name, text)` of every file; the first is the one to compile.
    #[getter]
    fn files(&self) -> Vec<(String, &str)> {
        self.c.files.iter().map(|file| (format!("chain.{}", file.extension), file.text.as_str())).collect()
    }

    /// `(form, function)` of every form that the observable has.
    #[getter]
    fn entries(&self) -> Vec<(&'static str, &str)> {
        let name_of = |form| FORMS.into_iter().find(|&(_, known)| known == form).map(|(name, _)| name);
        let entries = self.c.entries.iter();
        entries.filter_map(|(form, entry)| Some((name_of(*form)?, entry.as_str()))).collect()
    }
}

/// What one call of an entry takes. It owns what the addresses point to, or holds on to who does: a thread that still works when
/// its caller was interrupted needs no more than this.
#[pyclass(frozen, module = "trueaxis._native")]
pub struct Call {
    errors: Vec<f64>,
    pose: Vec<usize>,
    steps: Vec<usize>,
    columns: Vec<usize>,
    out: usize,
    rows: usize,
    threads: Option<usize>,
    _numbers: Vec<Vec<f64>>,
    _arrays: Vec<Py<PyAny>>,
}

/// Addresses of errors, columns and their steps, and the number of all rows.
type Before = (usize, usize, usize, usize);

/// The address of the derivatives that are wanted, their number, and the address where the result goes.
type Behind = (usize, usize, usize);

#[pymethods]
impl Call {
    /// `(start, end)` of the rows of each thread.
    #[getter]
    fn shares(&self) -> Vec<(usize, usize)> {
        let shares = rows::shares(self.rows, self.threads);
        shares.into_iter().map(|share| (share.start, share.end)).collect()
    }

    /// The arguments before `start` and `end`, and those behind.
    #[getter]
    fn arguments(&self) -> (Before, Behind) {
        let address = |numbers: &[usize]| numbers.as_ptr().expose_provenance();
        let errors = self.errors.as_ptr().expose_provenance();
        (
            (errors, address(&self.pose), address(&self.steps), self.rows),
            (address(&self.columns), self.columns.len(), self.out),
        )
    }
}

/// What is asked of compiled code, checked as for the interpreter.
pub struct Asked<'a, 'py> {
    pub columns: &'a [(SymbolId, Bound<'py, PyArray1<f64>>)],
    /// Values of all symbols; of readings, those that are one number for all rows.
    pub values: &'a [f64],
    pub wrt: &'a [SymbolId],
    /// Where the result goes.
    pub out: (usize, Py<PyAny>),
    pub rows: usize,
    pub threads: Option<usize>,
}

impl Call {
    /// The call for what is asked.
    ///
    /// # Errors
    /// A constant with another value than the one compiled in, or a derivative by a constant.
    pub fn new(loadable: &Loadable, chain: &Chain, asked: Asked<'_, '_>) -> Result<Self, Failure> {
        let nominal = chain.nominal_values();
        for id in chain.symbols_of(SymbolKind::Constant) {
            let (declared, given) = (nominal[id.index()], asked.values[id.index()]);
            if declared != given {
                return Err(Failure::Input(format!(
                    "the constant `{}` is compiled in as {declared}, and the errors set it to {given}: declare that value and compile \
                     again, or ask the chain itself",
                    chain.symbol(id).name
                )));
            }
        }
        let place = |&id: &SymbolId| {
            let found = chain.symbols_of(SymbolKind::Error).position(|error| error == id);
            found.ok_or_else(|| {
                Failure::Input(format!(
                    "`{}` is a constant, which is compiled in as a number: ask the chain itself for derivatives by it",
                    chain.symbol(id).name
                ))
            })
        };
        let columns = asked.wrt.iter().map(place).collect::<Result<_, _>>()?;
        let mut numbers = Vec::new();
        let (pose, steps) = loadable
            .c
            .pose
            .iter()
            .map(|id| match asked.columns.iter().find(|(given, _)| given == id) {
                Some((_, column)) => (column.data().expose_provenance(), 1),
                None => {
                    // One number for all rows; of a reading that the observable does not need, any.
                    let repeated = vec![asked.values[id.index()]; library::Loadable::REPEATED];
                    let address = repeated.as_ptr().expose_provenance();
                    numbers.push(repeated);
                    (address, 0)
                }
            })
            .unzip();
        let (out, array) = asked.out;
        let mut arrays: Vec<Py<PyAny>> =
            asked.columns.iter().map(|(_, column)| column.clone().into_any().unbind()).collect();
        arrays.push(array);
        Ok(Self {
            errors: chain.symbols_of(SymbolKind::Error).map(|id| asked.values[id.index()]).collect(),
            pose,
            steps,
            columns,
            out,
            rows: asked.rows,
            threads: asked.threads,
            _numbers: numbers,
            _arrays: arrays,
        })
    }
}
