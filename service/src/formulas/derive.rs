//! Closed forms of the errors of observables, and how they are headed.

use model_core::algebra::Poly;
use model_core::forms::{self, Form};
use model_core::{Chain, ObservableKind, print};

use crate::refusal::Refusal;
use crate::source::observables;
use crate::warn::Warn;

/// The closed forms of the named observables, or of all, to an order in the errors. Warns of observables that nobody named and that
/// have none.
///
/// # Errors
/// A name that the chain does not declare, or an observable without a closed form.
pub fn closed_forms(
    chain: &Chain,
    names: &[String],
    order: u32,
    warn: Warn<'_>,
) -> Result<Vec<Form>, Refusal> {
    let chosen = observables(chain, names)?;
    let mut forms = Vec::new();
    for &observable in &chosen {
        match forms::derive(chain, observable, order) {
            Ok(form) => forms.push(form),
            // Nobody asked for this observable in particular; the others still have an answer.
            Err(error) if error.is_of_no_closed_form() && names.is_empty() && chosen.len() > 1 => {
                warn(format!("{} is left out: {error}", chain.observable(observable).name));
            }
            Err(error) => return Err(Refusal::of(error)),
        }
    }
    if forms.is_empty() {
        return Err(Refusal::Input("no observable of this chain has a closed form".to_owned()));
    }
    Ok(forms)
}

/// `pointing: error of the direction of device, to first order in the errors`
#[must_use]
pub fn title_of(chain: &Chain, form: &Form) -> String {
    let observable = chain.observable(form.observable);
    let kind = match observable.kind {
        ObservableKind::Direction if observable.is_orientation() => "orientation",
        ObservableKind::Direction => "direction",
        ObservableKind::Point if observable.is_image() => "image",
        ObservableKind::Point => "point",
    };
    let mut units: Vec<&str> = observable.shown.iter().map(|reading| reading.unit(observable.kind)).collect();
    units.dedup();
    let unit = match units.as_slice() {
        ["1"] => String::new(),
        units => format!(", in {}", units.join(" and ")),
    };
    let read = if observable.is_vector() {
        String::new()
    } else {
        let readings: Vec<String> = observable.shown.iter().map(|reading| reading.describe()).collect();
        format!("{} of the ", readings.join(", "))
    };
    let the = if observable.is_vector() { "the " } else { "" };
    let frame = observable
        .frame
        .map_or(String::new(), |frame| format!(" in the frame of {}", chain.body(frame).name));
    let roots: Vec<String> =
        unique_roots(form).map(|root| format!("{} > 0", print::text(root, chain))).collect();
    let place = if roots.is_empty() { String::new() } else { format!(", where {}", roots.join(" and ")) };
    let order = ["first", "second", "third"].get(form.order as usize - 1).copied().unwrap_or("higher");
    let body = &chain.body(observable.body).name;
    format!(
        "{}: error of {the}{read}{kind} of {body}{frame}, to {order} order in the errors{unit}{place}",
        observable.name
    )
}

/// What has to be positive for a form to be right, each once.
pub fn unique_roots(form: &Form) -> impl Iterator<Item = &Poly> {
    let roots: Vec<&Poly> = form.positive.iter().flatten().collect();
    roots
        .clone()
        .into_iter()
        .enumerate()
        .filter(move |(at, root)| !roots[..*at].contains(root))
        .map(|(_, root)| root)
}
