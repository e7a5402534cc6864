//! Writers of programs, one for each language: a file each, and a line in [`LANGUAGES`] and [`generate`].
//!
//! `listing` decides what gets a name, `unit` what a file says about itself; a writer says how its language
//! writes names, statements and types.

mod c;
mod c_block;
mod c_rows;
mod javascript;
mod latex;
mod listing;
mod numpy;
mod rust;
mod rust_block;
mod rust_rows;
mod unit;

pub use unit::Unit;

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
/// # Example
///
/// ```
/// use codegen::{Form, Language, Unit, generate};
/// use model_core::{Chain, ObservableId};
///
/// let declaration = "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
///                    observe edge: direction(1, 0, 0) of top; }";
/// let chain = Chain::from_text(declaration)?;
/// let unit = Unit {
///     chain: &chain,
///     declaration,
///     observables: &[ObservableId(0)],
///     forms: &[Form::FirstOrderError],
///     remainders: &[],
/// };
/// let files = generate(&unit, Language::Rust, "table");
/// assert!(files[0].text.contains("pub fn first_order_error(errors: &Errors, joints: &Joints)"));
/// # Ok::<(), model_core::Mistakes>(())
/// ```
#[must_use]
pub fn generate(unit: &Unit<'_>, language: Language, file_name: &str) -> Vec<File> {
    let file = |extension, text| File { extension, text };
    match language {
        Language::Rust => vec![file("rs", rust::write(unit))],
        Language::C => {
            let (header, source) = c::write(unit, file_name);
            vec![file("c", source), file("h", header)]
        }
        Language::Latex => vec![file("tex", latex::write(unit))],
        Language::Numpy => vec![file("py", numpy::write(unit))],
        Language::Javascript => vec![file("js", javascript::write(unit))],
    }
}
