//! The checker as an assertion, for the tests of a crate that declares a chain.

use std::fmt::Write as _;

use super::{Checker, ClosedForm, Order, PrintedVector, errors_named, extended};
use crate::latex::PrintedSymbols;
use model_core::chain::Chain;
use model_core::print::Style;

/// Asserts that the error of an observable has this closed form, in LaTeX with the chain's printed symbols or in the
/// plain syntax of amounts: one formula for each number that it shows. `kept` names the errors that are not zero, by name or pattern.
///
/// # Panics
/// The formula cannot be read, or differs from what the chain implies; the message says where and what belongs there.
#[track_caller]
pub fn assert_closed_form<const N: usize>(
    chain: &Chain,
    observable: &str,
    order: u32,
    kept: &[&str],
    components: [&str; N],
) {
    if let Err(message) = closed_form(chain, observable, order, kept, &components) {
        panic!("{message}");
    }
}

/// The assertion's message, if it fails.
pub(super) fn closed_form(
    chain: &Chain,
    observable: &str,
    order: u32,
    kept: &[&str],
    components: &[&str],
) -> Result<(), String> {
    let chain = &extended(chain);
    let id = chain
        .find_observable(observable)
        .ok_or_else(|| format!("chain {} has no observable `{observable}`", chain.name))?;
    let mut errors = Vec::new();
    for pattern in kept {
        errors.extend(errors_named(chain, pattern).map_err(|mistake| mistake.message)?);
    }
    errors.sort_unstable();
    errors.dedup();
    let symbols = PrintedSymbols::of_chain(chain);
    let shown = chain.observable(id);
    let printed = PrintedVector::read_shown(chain, &symbols, shown, components, Order::UpTo(order)).map_err(
        |mistakes| {
            let mut said = String::new();
            for mistake in mistakes {
                let text = components.get(mistake.place.text_index).copied().unwrap_or_default();
                let place = text.get(mistake.place.bytes.clone()).unwrap_or_default();
                let _ = writeln!(said, "`{text}`, at `{place}`: {}", mistake.message);
            }
            said
        },
    )?;
    let order = Order::UpTo(order);
    let claim = ClosedForm { observable: id, order, only: None, faces: None, kept: errors, printed };
    let verdict = Checker::new(chain).closed_form(&claim).map_err(|error| error.to_string())?;
    if verdict.differences.is_empty() {
        return Ok(());
    }
    let mut said = format!("the formula for {observable} is not what {} implies\n", chain.name);
    for difference in &verdict.differences {
        let error = difference.error_name(chain);
        let [printed, derived] =
            [&difference.printed, &difference.derived].map(|value| value.show(chain, Style::Text));
        let label = chain.observable(id).label(difference.component.index());
        let _ = writeln!(said, "  {label}, {error}: printed {printed}, derived {derived}");
    }
    Err(said)
}
