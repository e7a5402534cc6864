//! Writers of programs, one for each language: a file or folder each, and a line in [`LANGUAGES`] and [`generate`].
//!
//! A writer formats the tree of `crate::lower` and decides nothing. `unit` says what is in a file, `names` what things
//! are called, `notation` how expressions are put into text, `comments` how the declaration's words stay in comments.

mod c;
mod cpp;
mod error;
mod javascript;
mod jax;
mod latex;
mod matlab;
mod names;
mod notation;
mod numpy;
pub mod rust;
mod unit;

use std::collections::BTreeSet;

use model_core::readings::Measures;
use model_core::{Chain, Observable, Passed, SymbolId, SymbolKind};

pub use error::GenerateError;
pub use names::snake_case;
pub use unit::{Calibrated, Precision, Unit, form_name};

use crate::program::{Form, Op};
use unit::Shared;

/// The languages that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Language {
    /// Rust that needs nothing but `core`.
    Rust,
    /// C99, a source and a header.
    C,
    /// C++17: the source of C, with headers.
    Cpp,
    /// Equations, to be included in a document.
    Latex,
    /// Python with NumPy.
    Numpy,
    /// A JavaScript module.
    Javascript,
    /// A function file of MATLAB and Octave.
    Matlab,
    /// Python with JAX.
    Jax,
}

/// Every language with its name.
pub const LANGUAGES: [(&str, Language); 8] = [
    ("rust", Language::Rust),
    ("c", Language::C),
    ("cpp", Language::Cpp),
    ("latex", Language::Latex),
    ("numpy", Language::Numpy),
    ("javascript", Language::Javascript),
    ("matlab", Language::Matlab),
    ("jax", Language::Jax),
];

/// A generated file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct File {
    /// The usual ending of its name, without dot.
    pub extension: &'static str,
    /// What is in it.
    pub text: String,
}

/// Writes a unit in a language: the file itself first, then what belongs beside it under the same name with
/// another ending. `file_name` is that name without ending: C's source includes its header by it.
///
/// # Errors
/// What is asked for has no code: see [`GenerateError`].
///
/// # Example
///
/// ```
/// use codegen::{Form, Language, Unit, generate};
/// use model_core::{Chain, ObservableId};
///
/// let declaration = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
///                    observe edge: direction(1, 0, 0) of top; }";
/// let chain = Chain::from_text(declaration)?;
/// let unit = Unit::new(&chain, declaration, &[ObservableId(0)], &[Form::FirstOrderError]);
/// let files = generate(&unit, Language::Rust, "table")?;
/// assert!(files[0].text.contains("pub fn first_order_error(errors: &Errors, joints: &Joints)"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn generate(unit: &Unit<'_>, language: Language, file_name: &str) -> Result<Vec<File>, GenerateError> {
    let shared = checked(unit, language, file_name)?;
    Ok(match language {
        Language::Rust => vec![file("rs", rust::write(&shared))],
        Language::C => {
            let (header, source) = c::write(&shared, file_name);
            vec![file("c", source), file("h", header)]
        }
        Language::Cpp => cpp::write(&shared, file_name),
        Language::Latex => vec![file("tex", latex::write(&shared))],
        Language::Numpy => vec![file("py", numpy::write(&shared))],
        Language::Javascript => vec![file("js", javascript::write(&shared))],
        Language::Matlab => vec![file("m", matlab::write(&shared, file_name))],
        Language::Jax => vec![file("py", jax::write(&shared))],
    })
}

/// C for a program that compiles it and loads it while it runs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loadable {
    /// The file to compile, which includes the others, by their endings; then the others.
    pub files: Vec<File>,
    /// The joints and inputs whose columns an entry takes, in order. Errors are all of the chain's, in order.
    pub pose: Vec<SymbolId>,
    /// The name of each form's entry:
    ///
    /// ```c
    /// void entry(const double *errors, const double *const *pose, const size_t *steps, size_t rows, size_t start, size_t end,
    ///            const size_t *columns, size_t count, double *out);
    /// ```
    ///
    /// It does the rows from `start` to before `end` of all `rows`; `start` is a multiple of 64, so that no bit depends on how
    /// rows are shared out. Column `i` is read at `pose[i][steps[i] * row]`: steps are 1, or 0 for a number that holds for all rows
    /// and stands [`Loadable::REPEATED`] times at `pose[i]`. `out` holds all rows of the first number that comes out, then
    /// of the next. A Jacobian puts out the `count` errors with the numbers `columns`, component by component.
    pub entries: Vec<(Form, String)>,
}

impl Loadable {
    /// How many times a number that holds for all rows must stand in memory.
    pub const REPEATED: usize = c::REPEATED;
}

/// Writes a unit in C, with an entry for each form that takes errors, columns and results by their places. No error may have
/// a value in the unit: there would be no place for it.
///
/// # Errors
/// As [`generate`].
pub fn generate_loadable(unit: &Unit<'_>, file_name: &str) -> Result<Loadable, GenerateError> {
    let shared = checked(unit, Language::C, file_name)?;
    let (header, source, entries) = c::write_with_entries(&shared, file_name);
    Ok(Loadable {
        files: vec![file("entries.c", entries.source), file("c", source), file("h", header)],
        pose: shared.pose_symbols().collect(),
        entries: entries.called,
    })
}

fn file(extension: &'static str, text: String) -> File {
    File { extension, text }
}

/// The functions of a unit that can be written.
fn checked<'a>(unit: &'a Unit<'a>, language: Language, file_name: &str) -> Result<Shared<'a>, GenerateError> {
    check(unit, language, file_name)?;
    let shared = Shared::new(unit);
    if shared.functions.is_empty() {
        return Err(GenerateError::NoForm);
    }
    for function in &shared.functions {
        let is_finite = |op: &Op| match op {
            Op::Constant(literal) => is_within(literal.value(), unit.precision),
            _ => true,
        };
        if !function.program.nodes().iter().all(is_finite) {
            return Err(GenerateError::NotFinite { form: function.form });
        }
    }
    Ok(shared)
}

/// Whether a number can be written.
fn is_within(value: f64, precision: Precision) -> bool {
    match precision {
        Precision::Double => value.is_finite(),
        Precision::Single => (value as f32).is_finite(),
    }
}

/// What can be said before anything is built.
fn check(unit: &Unit<'_>, language: Language, file_name: &str) -> Result<(), GenerateError> {
    if unit.observables.is_empty() {
        return Err(GenerateError::NoObservable);
    }
    let mut seen = BTreeSet::new();
    if let Some(&id) = unit.observables.iter().find(|&&id| !seen.insert(id)) {
        return Err(GenerateError::RepeatedObservable { name: unit.chain.observable(id).name.clone() });
    }
    let mut seen = BTreeSet::new();
    if let Some(&form) = unit.forms.iter().find(|&&form| !seen.insert(form)) {
        return Err(GenerateError::RepeatedForm { form });
    }
    if unit.precision == Precision::Single
        && !matches!(language, Language::Rust | Language::C | Language::Cpp)
    {
        return Err(GenerateError::SinglePrecision);
    }
    for &id in unit.observables {
        let observable = unit.chain.observable(id);
        let name = || observable.name.clone();
        if unit.precision == Precision::Single && !observable.has_components_only() {
            return Err(GenerateError::SingleReading { name: name() });
        }
        let is_of_sight = |passed: &Passed<'_>| {
            passed.factor.amount.symbols().iter().any(|symbol| unit.chain.sight_angle(*symbol).is_some())
        };
        if unit.precision == Precision::Single && unit.chain.way(id).iter().any(is_of_sight) {
            return Err(GenerateError::SingleSight { name: name() });
        }
        unit.forms.iter().try_for_each(|&form| derivable(observable, form))?;
    }
    calibrated(unit)?;
    let mut seen = BTreeSet::new();
    for &(id, value) in unit.values {
        let symbol = unit.chain.symbol(id);
        let has_value = matches!(symbol.kind, SymbolKind::Error | SymbolKind::Constant);
        if !has_value || !value.is_finite() || !seen.insert(id) {
            return Err(GenerateError::Value { name: symbol.name.clone() });
        }
    }
    let declared = unit.chain.symbols.iter().filter(|symbol| symbol.kind == SymbolKind::Constant);
    if let Some(symbol) = declared.clone().find(|symbol| symbol.value.is_none()) {
        return Err(GenerateError::NoValue { name: symbol.name.clone() });
    }
    let is_beyond = |value: Option<f64>| value.is_some_and(|value| !is_within(value, unit.precision));
    if let (Some(&form), true) =
        (unit.forms.first(), declared.into_iter().any(|symbol| is_beyond(symbol.value)))
    {
        return Err(GenerateError::NotFinite { form });
    }
    let is_safe = |c: char| c.is_alphanumeric() || "_-.+ ".contains(c);
    if matches!(language, Language::C | Language::Cpp) && !file_name.chars().all(is_safe) {
        return Err(GenerateError::FileName { name: file_name.to_owned() });
    }
    if language == Language::Matlab && !matlab::is_function_name(file_name) {
        return Err(GenerateError::FunctionName { name: file_name.to_owned() });
    }
    Ok(())
}

/// What a calibration says must be there where it is asked for, and be what it says.
fn calibrated(unit: &Unit<'_>) -> Result<(), GenerateError> {
    let known = unit.calibrated;
    if unit.forms.contains(&Form::Uncertainty) {
        let Some(covariance) = known.covariance else { return Err(GenerateError::NoCovariance) };
        if unit.precision == Precision::Single {
            return Err(GenerateError::SingleUncertainty);
        }
        let count = covariance.of.len();
        let is_whole = covariance.rows.len() == count && covariance.rows.iter().all(|row| row.len() == count);
        let is_finite = || covariance.rows.iter().flatten().all(|entry| entry.is_finite());
        if !is_whole || !is_finite() {
            return Err(GenerateError::Covariance { count });
        }
    }
    let is_date = |date: &str| {
        let is_digit = |(at, letter): (usize, char)| {
            if matches!(at, 4 | 7) { letter == '-' } else { letter.is_ascii_digit() }
        };
        date.len() == 10 && date.chars().enumerate().all(is_digit)
    };
    match known.valid_until {
        Some(date) if !is_date(date) => Err(GenerateError::Date { text: date.to_owned() }),
        _ => Ok(()),
    }
}

/// Whether an observable has a form: no angle off an axis has derivatives where there are no errors.
///
/// # Errors
/// [`GenerateError::NoDerivative`] where it has not.
pub fn derivable(observable: &Observable, form: Form) -> Result<(), GenerateError> {
    let is_off_axis = observable.shown.iter().any(|reading| reading.measures == Measures::OffAxis);
    if is_off_axis && (form.is_jacobian() || form == Form::Uncertainty) {
        return Err(GenerateError::NoDerivative { name: observable.name.clone(), form });
    }
    Ok(())
}

/// The value of a constant, which every chain that was checked gives it.
fn declared(chain: &Chain, id: SymbolId) -> f64 {
    if id == SymbolId::PI {
        return std::f64::consts::PI;
    }
    let symbol = chain.symbol(id);
    match symbol.value {
        Some(value) => value,
        None => unreachable!("the constant {} has a value", symbol.name),
    }
}
