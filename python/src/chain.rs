//! A declared chain: its symbols, its forms as numbers over arrays, and what follows from it exactly.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use codegen::{Form, Program, build};
use model_core::{Mistakes, ObservableId, ObservableKind, SymbolId, SymbolKind, names};
use numpy::PyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use trueaxis_cli::library::{self, Computed, Exactness, Failure, Held, Quantity, Source, Told};

use crate::compiled::{FORMS, Loadable};
use crate::errors;
use crate::evaluating::{self, Evaluation, Readings};
use crate::formula::ClosedForm;
use crate::tables::{Given, Table};

/// Names of columns and the columns, as Python gets them.
pub type Columns = Vec<(String, Py<PyArray<f64, numpy::ndarray::Ix1>>)>;

/// A text with the name that mistakes in it are shown with: `(name, text)`.
pub type Text = (String, String);

/// The text as the library reads it.
pub fn source((name, text): Text) -> Source {
    Source::of_text(name, &text)
}

/// Numbers as NumPy holds them.
pub fn as_arrays(py: Python<'_>, columns: Vec<(String, Vec<f64>)>) -> Columns {
    columns.into_iter().map(|(name, column)| (name, PyArray::from_vec(py, column).unbind())).collect()
}

/// An answer for reading and, as JSON, for programs.
pub fn told(told: Told) -> (String, String) {
    (told.text, told.json.to_string())
}

/// Programs by observable, form and the symbols that they have derivatives by.
type Programs = BTreeMap<(ObservableId, Form, Vec<SymbolId>), Arc<Program>>;

/// A number that an observable shows: its word and its unit.
type Shown = (&'static str, &'static str);

/// A declared chain.
#[pyclass(frozen, module = "trueaxis._native")]
pub struct Chain {
    source: Source,
    chain: model_core::Chain,
    /// Why it has no numbers: constants without a value.
    open: Option<Mistakes>,
    programs: Mutex<Programs>,
    /// The errors of the last call, with what was read from them.
    last: Mutex<Option<(Text, Vec<f64>)>>,
}

impl Chain {
    fn new(py: Python<'_>, read: impl FnOnce() -> Result<Source, Failure> + Send) -> PyResult<Self> {
        let (source, chain, open) = errors::run(py, || {
            let source = read()?;
            let chain = library::symbolic_chain(&source)?;
            let open = model_core::Chain::from_text(&source.text).err();
            Ok((source, chain, open))
        })?;
        Ok(Self { source, chain, open, programs: Mutex::default(), last: Mutex::default() })
    }

    /// The chain for what calculates with numbers.
    pub fn with_numbers(&self) -> Result<&model_core::Chain, Failure> {
        match &self.open {
            Some(mistakes) => Err(self.source.mistakes(mistakes).into()),
            None => Ok(&self.chain),
        }
    }

    /// The text that it was read from.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The program of a form, built once.
    fn program(
        &self,
        py: Python<'_>,
        observable: ObservableId,
        form: Form,
        wrt: &[SymbolId],
    ) -> PyResult<Arc<Program>> {
        let key = (observable, form, wrt.to_vec());
        // A thread that panicked while it held the lock left whole entries.
        let programs = || self.programs.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(program) = programs().get(&key) {
            return Ok(Arc::clone(program));
        }
        // Built without the lock: two threads may build the same, and keep one.
        let (chain, wrt) = (self.chain.clone(), wrt.to_vec());
        let built = move || Ok(build(&chain, &[observable], form, &wrt));
        let program = Arc::new(errors::run_interruptible(py, built)?);
        Ok(Arc::clone(programs().entry(key).or_insert(program)))
    }

    /// The values that a text of errors sets. The same text is read once, as long as there is nothing to warn of: many calls
    /// with one set of errors are the usual case, and reading takes longer than some thousand rows.
    fn values(&self, py: Python<'_>, errors: Text) -> PyResult<Vec<f64>> {
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((text, values)) = &*last()
            && *text == errors
        {
            return Ok(values.clone());
        }
        let text = source(errors.clone());
        let (values, is_doubtful) = errors::run_and_tell(py, || library::values(&text, &self.chain))?;
        if !is_doubtful {
            *last() = Some((errors, values.clone()));
        }
        Ok(values)
    }

    /// A symbol of some kinds by its name.
    fn symbol(&self, name: &str, kinds: &[SymbolKind], what: &str) -> Result<SymbolId, Failure> {
        let declared = || kinds.iter().flat_map(|&kind| self.chain.symbols_of(kind));
        if let Some(id) = declared().find(|&id| self.chain.symbol(id).name == name) {
            return Ok(id);
        }
        let declared = || declared().map(|id| self.chain.symbol(id).name.as_str());
        let instead = match names::nearest(name, declared()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => {
                let all: Vec<String> = declared().map(|name| format!("`{name}`")).collect();
                format!("it has {}", all.join(", "))
            }
        };
        Err(Failure::Input(format!("chain {} has no {what} `{name}`; {instead}", self.chain.name)))
    }

    /// The symbols that derivatives are taken by: those named, or every error.
    fn derived_by(&self, names: Option<Vec<String>>) -> Result<Vec<SymbolId>, Failure> {
        let Some(names) = names else { return Ok(self.chain.symbols_of(SymbolKind::Error).collect()) };
        let named = |name: &String| self.symbol(name, &[SymbolKind::Error, SymbolKind::Constant], "error");
        names.iter().map(named).collect()
    }
}

/// Which form is evaluated, by its name.
fn form_of(name: &str) -> PyResult<Form> {
    let form = FORMS.into_iter().find(|&(known, _)| known == name).map(|(_, form)| form);
    form.ok_or_else(|| PyValueError::new_err(format!("there is no form `{name}`")))
}

#[pymethods]
impl Chain {
    /// Reads a declaration from a text.
    #[staticmethod]
    fn from_text(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        let source = Source::of_text(name, text);
        Self::new(py, || Ok(source))
    }

    /// Reads a declaration from a file.
    #[staticmethod]
    fn from_file(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Self::new(py, || library::read(&path))
    }

    /// The chain's name.
    #[getter]
    fn name(&self) -> &str {
        &self.chain.name
    }

    /// The declaration as written.
    #[getter]
    fn text(&self) -> &str {
        &self.source.text
    }

    /// Where the declaration came from.
    #[getter]
    fn origin(&self) -> String {
        self.source.path.display().to_string()
    }

    /// `(name, kind, unit)` of every declared symbol, in order.
    #[getter]
    fn symbols(&self) -> Vec<(&str, &'static str, &'static str)> {
        let kinds = [
            (SymbolKind::Joint, "joint"),
            (SymbolKind::Input, "input"),
            (SymbolKind::Error, "error"),
            (SymbolKind::Constant, "constant"),
        ];
        kinds
            .into_iter()
            .flat_map(|(kind, word)| self.chain.symbols_of(kind).map(move |id| (id, word)))
            .map(|(id, word)| {
                let symbol = self.chain.symbol(id);
                (symbol.name.as_str(), word, symbol.quantity.unit())
            })
            .collect()
    }

    /// `(name, kind, readings that it needs, what it shows with its unit)` of every observable, in order.
    #[getter]
    fn observables(&self) -> Vec<(&str, &'static str, Vec<&str>, Vec<Shown>)> {
        (0u16..)
            .map(ObservableId)
            .zip(&self.chain.observables)
            .map(|(id, observable)| {
                let kind = match observable.kind {
                    ObservableKind::Direction if observable.is_orientation() => "orientation",
                    ObservableKind::Direction => "direction",
                    ObservableKind::Point if observable.is_image() => "image",
                    ObservableKind::Point => "point",
                };
                let readings = library::readings_of(&self.chain, id);
                let readings = readings.into_iter().map(|id| self.chain.symbol(id).name.as_str()).collect();
                let shown = observable.shown.iter().map(|one| (one.word, one.unit(observable.kind)));
                (observable.name.as_str(), kind, readings, shown.collect())
            })
            .collect()
    }

    /// Which columns of these names have readings of joints and inputs.
    fn are_readings(&self, columns: Vec<String>) -> Vec<bool> {
        library::are_readings(&self.chain, &columns)
    }

    /// Generated files: `(ending, text)`.
    fn generate(
        &self,
        py: Python<'_>,
        language: &str,
        observables: Vec<String>,
    ) -> PyResult<Vec<(&'static str, String)>> {
        errors::run(py, || library::generated(&self.source, self.with_numbers()?, language, &observables))
    }

    /// The C of an observable, to be compiled and loaded.
    fn loadable(&self, py: Python<'_>, observable: Option<&str>) -> PyResult<Loadable> {
        errors::run(py, || {
            let chain = self.with_numbers()?;
            let observable = library::observable(chain, observable)?;
            let c = library::loadable(&self.source, chain, observable)?;
            Ok(Loadable::new(chain, observable, c))
        })
    }

    /// Evaluates a form over columns of readings; the result has the shape `(shown, rows)`, or `(shown, wrt, rows)`. `compiled`
    /// is the C of the observable and a function that calls an entry of it, `call(form, what)`.
    #[pyo3(signature = (form, observable, readings, constants, errors, wrt, out, threads, compiled))]
    #[expect(clippy::too_many_arguments, reason = "the Python package names them all")]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        form: &str,
        observable: Option<&str>,
        readings: Given<'py>,
        constants: Vec<(String, f64)>,
        errors: Text,
        wrt: Option<Vec<String>>,
        out: Option<Bound<'py, PyAny>>,
        threads: Option<usize>,
        compiled: Option<(PyRef<'py, Loadable>, Bound<'py, PyAny>)>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let fails = |failure: Failure| errors::exception(py, &failure);
        let (form_name, form) = (form, form_of(form)?);
        let chain = self.with_numbers().map_err(fails)?;
        let observable = match &compiled {
            Some((loadable, _)) => loadable.only(chain, observable),
            None => library::observable(chain, observable),
        };
        let observable = observable.map_err(fails)?;
        library::derivable(chain, observable, form).map_err(fails)?;

        let named = |name: &str| self.symbol(name, &[SymbolKind::Joint, SymbolKind::Input], "joint or input");
        let readings_are_numbers = readings.is_empty();
        let columns = Readings::columns(py, &readings, named)?;
        let values = self.values(py, errors)?;
        let with = |readings: Readings<'py>, (name, value): (String, f64)| {
            Ok(readings.with_number(named(&name)?, value))
        };
        let readings = constants.into_iter().try_fold(columns, with).map_err(fails)?;
        let wrt = self.derived_by(wrt).map_err(fails)?;
        let asked = Evaluation::new(chain, (form, observable), readings, values, (wrt, threads));
        let asked = asked.map_err(fails)?;

        let array = evaluating::result(py, out.as_ref(), &asked.shape(chain), readings_are_numbers)?;
        asked.require_apart(&array)?;
        let mut writable = evaluating::writable(&array)?;
        let into = writable.as_slice_mut()?;
        match compiled {
            None => {
                let program = self.program(py, observable, form, &asked.wrt)?;
                asked.interpreted(py, &program, into)?;
            }
            Some((loadable, call)) => {
                let out = (into.as_mut_ptr().expose_provenance(), array.clone().into_any().unbind());
                let what = asked.call(chain, &loadable, out).map_err(fails)?;
                // What has no numbers may have no entry either: Jacobians of a chain without errors.
                if !into.is_empty() {
                    call.call1((form_name, what))?;
                }
            }
        }
        drop(writable);
        Ok(array.into_any())
    }

    /// The closed form of an observable's error.
    fn closed_form(&self, py: Python<'_>, observable: Option<&str>, order: u32) -> PyResult<ClosedForm> {
        let (chain, observable) = (self.chain.clone(), observable.map(str::to_owned));
        errors::run_interruptible(py, move || {
            let observable = library::observable(&chain, observable.as_deref())?;
            library::closed_form(&chain, observable, order).map(ClosedForm::from)
        })
    }

    /// What no data can tell apart.
    fn identify(
        &self,
        py: Python<'_>,
        observables: Vec<String>,
        candidate: Option<String>,
    ) -> PyResult<(String, String)> {
        let chain = self.chain.clone();
        let identified = move || library::identified(&chain, &observables, candidate.as_deref());
        errors::run_interruptible(py, identified).map(told)
    }

    /// Proven bounds on what the first order leaves out.
    fn bound(
        &self,
        py: Python<'_>,
        sizes: Text,
        observables: Vec<String>,
        ranges: Vec<(String, String)>,
        seed: u64,
    ) -> PyResult<(String, String)> {
        let chain = self.with_numbers().cloned();
        errors::run_interruptible(py, move || {
            let chain = chain?;
            let ranges = library::ranges(&chain, &ranges)?;
            library::bounded(&chain, &source(sizes), &observables, &ranges, seed)
        })
        .map(told)
    }

    /// What each error does.
    fn budget(
        &self,
        py: Python<'_>,
        sizes: Text,
        observables: Vec<String>,
        path: Option<String>,
        ranges: Vec<(String, String)>,
    ) -> PyResult<(String, String)> {
        let chain = self.with_numbers().cloned();
        errors::run_interruptible(py, move || {
            let chain = chain?;
            let ranges = library::ranges(&chain, &ranges)?;
            library::budgeted(&chain, &source(sizes), &observables, path.as_deref(), &ranges)
        })
        .map(told)
    }

    /// Measured data that are made up.
    #[expect(clippy::too_many_arguments, reason = "the Python package names them all")]
    fn simulate(
        &self,
        py: Python<'_>,
        values: Text,
        poses: u32,
        noise: Vec<String>,
        seed: u64,
        ranges: Vec<(String, String)>,
        observables: Vec<String>,
    ) -> PyResult<Columns> {
        let columns = errors::run(py, || {
            let chain = self.with_numbers()?;
            let ranges = library::ranges(chain, &ranges)?;
            let size = (poses as usize, seed);
            library::simulated(chain, &source(values), &noise, &observables, &ranges, size)
        })?;
        Ok(as_arrays(py, columns))
    }

    /// Observables over a table of readings, and the table's own columns that they replace.
    fn over_table(
        &self,
        py: Python<'_>,
        table: (String, Given<'_>),
        values: Text,
        observables: Vec<String>,
        is_exact: bool,
        is_value: bool,
    ) -> PyResult<(Columns, Vec<String>)> {
        let (name, columns) = table;
        let table = Table::of(columns)?;
        let columns = table.columns()?;
        let form = if is_exact { Exactness::Exact } else { Exactness::FirstOrder };
        let quantity = if is_value { Quantity::Value } else { Quantity::Error };
        let Computed { added, replaced } = errors::run(py, || {
            let (chain, table) = (self.with_numbers()?, Held::new(&name, &columns)?);
            library::evaluated(chain, &source(values), table, &observables, (form, quantity))
        })?;
        Ok((as_arrays(py, added), replaced))
    }
}

/// The verdicts on the claims of a file.
#[pyfunction]
pub fn check(py: Python<'_>, claims: PathBuf) -> PyResult<(String, String)> {
    errors::run_interruptible(py, move || library::checked(&claims)).map(told)
}
