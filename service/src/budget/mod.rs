//! The error budget as users get it: what each error does, what its tolerances come to, in text, tables and a page.

pub mod curves;
mod designed;
mod page;
mod tables;
mod text;

use model_core::Chain;
use model_core::budget::{Budget, Curves};
use model_core::unit::Unit;

use claims::file::Checked;

pub use designed::{Designed, Remaining};
pub use page::page;
pub use tables::{as_csv, as_json};
pub use text::as_text;

/// One observable with all that was found of it.
pub struct Measured {
    /// What each error alone does.
    pub budget: Budget,
    /// What tolerances come to, where somebody asked.
    pub designed: Option<Designed>,
    /// The influences along a path, where files are written.
    pub curves: Option<Curves>,
}

/// What a page shows.
pub struct Shown<'a> {
    /// The declaration.
    pub chain: &'a Chain,
    /// The poses in words.
    pub poses: String,
    /// The command line.
    pub command: String,
    /// Every observable.
    pub measured: &'a [Measured],
    /// What somebody stated of the influences in a file of this name, with the verdicts.
    pub claims: Option<(String, &'a [Checked<'a>])>,
}

/// The unit that people read, and how many of it one SI unit makes.
pub fn reading_unit(unit: &'static str) -> (&'static str, f64) {
    let name = match unit {
        "rad" => "arcsec",
        "m" => "mm",
        other => other,
    };
    (name, Unit::find(name).map_or(1.0, |unit| unit.in_si().recip()))
}

/// Five digits; what is below any sense is nothing.
pub fn short(value: f64) -> String {
    match value.abs() {
        size if size < 1e-12 => "0".to_owned(),
        0.01..1e6 => {
            let text = format!("{value:.4}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => format!("{value:.3e}"),
    }
}

/// A size of an error with its unit.
pub fn size(value: f64, unit: &'static str) -> String {
    let (unit, factor) = reading_unit(unit);
    format!("{} {unit}", short(value * factor)).trim_end().to_owned()
}
