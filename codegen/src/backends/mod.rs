//! Writers of programs, one for each language: a file or folder each, and a line in [`LANGUAGES`] and [`generate`].
//!
//! A writer formats the tree of `crate::lower` and decides nothing. `unit` says what is in a file, `names` what things
//! are called, `notation` how expressions are put into text, `comments` how the declaration's words stay in comments.

mod c;
mod comments;
mod error;
mod javascript;
mod latex;
mod names;
mod notation;
mod numpy;
pub mod rust;
mod unit;

use std::collections::BTreeSet;

use model_core::readings::Measures;
use model_core::{Chain, SymbolId, SymbolKind};

pub use error::GenerateError;
pub use names::snake_case;
pub use unit::{Precision, Unit, form_name};

use crate::program::Op;
use unit::Shared;

/// The languages that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Language {
    /// Rust that needs nothing but `core`.
    Rust,
    /// C99, a source and a header.
    C,
    /// Equations, to be included in a document.
    Latex,
    /// Python with NumPy.
    Numpy,
    /// A JavaScript module.
    Javascript,
}

/// Every language with its name.
pub const LANGUAGES: [(&str, Language); 5] = [
    ("rust", Language::Rust),
    ("c", Language::C),
    ("latex", Language::Latex),
    ("numpy", Language::Numpy),
    ("javascript", Language::Javascript),
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
    let file = |extension, text| File { extension, text };
    Ok(match language {
        Language::Rust => vec![file("rs", rust::write(&shared))],
        Language::C => {
            let (header, source) = c::write(&shared, file_name);
            vec![file("c", source), file("h", header)]
        }
        Language::Latex => vec![file("tex", latex::write(&shared))],
        Language::Numpy => vec![file("py", numpy::write(&shared))],
        Language::Javascript => vec![file("js", javascript::write(&shared))],
    })
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
    if unit.precision == Precision::Single && !matches!(language, Language::Rust | Language::C) {
        return Err(GenerateError::SinglePrecision);
    }
    for &id in unit.observables {
        let observable = unit.chain.observable(id);
        let name = || observable.name.clone();
        if unit.precision == Precision::Single && !observable.has_components_only() {
            return Err(GenerateError::SingleReading { name: name() });
        }
        let is_off_axis = observable.shown.iter().any(|reading| reading.measures == Measures::OffAxis);
        if let Some(&form) = unit.forms.iter().find(|form| is_off_axis && form.is_jacobian()) {
            return Err(GenerateError::NoDerivative { name: name(), form });
        }
    }
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
    if language == Language::C && !file_name.chars().all(is_safe) {
        return Err(GenerateError::FileName { name: file_name.to_owned() });
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
