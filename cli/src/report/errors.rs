//! Estimates as an errors file, which `apply`, `eval` and `calibrate` read again.

use std::fmt::Write as _;

use calibration::diagnose::{Diagnosis, ErrorFound};
use calibration::report::numbers;
use model_core::{Chain, Quantity, SymbolKind};

/// Every value of a calibrated model that differs from what its declaration says, each with a remark for people.
#[must_use]
pub fn errors_toml(diagnosis: &Diagnosis, chain: &Chain, values: &[f64], date: &str) -> String {
    let mut text = format!(
        "# Errors of {}, calibrated on {date}; for `trueaxis eval`, `trueaxis apply` and amended.chain.\n",
        chain.name
    );
    let found = &diagnosis.errors;
    let width = found.iter().map(|error| error.name.len()).max().unwrap_or_default();
    for error in found {
        // The unit is that of the language's quantity, which is what reads the file again.
        let quantity =
            chain.find_symbol(&error.name).map_or(Quantity::Number, |id| chain.symbol(id).quantity);
        let _ = writeln!(
            text,
            "{:width$} = {:32} # {}",
            error.name,
            written(error.value, quantity),
            remark(error)
        );
    }
    // Errors that were held at a value belong to the model as much as those that were estimated.
    for (symbol, &value) in chain.symbols.iter().zip(values) {
        let estimated = found.iter().any(|error| error.name == symbol.name);
        if symbol.kind == SymbolKind::Error && value != 0.0 && !estimated {
            let _ = writeln!(
                text,
                "{:width$} = {:32} # held at this value",
                symbol.name,
                written(value, symbol.quantity)
            );
        }
    }
    text
}

/// A value as TOML has it: a number, or a string with a unit.
fn written(value: f64, quantity: Quantity) -> String {
    match quantity {
        Quantity::Number => format!("{value:?}"),
        quantity => format!("\"{value:?} {}\"", quantity.unit()),
    }
}

fn remark(error: &ErrorFound) -> String {
    match (error.standard_uncertainty, error.shown) {
        (Some(sigma), _) => numbers::estimate(error.value, sigma, error.unit),
        (None, true) => {
            format!("{}, determined only together with others", numbers::told(error.value, error.unit))
        }
        (None, false) => "not shown by the data".to_owned(),
    }
}
