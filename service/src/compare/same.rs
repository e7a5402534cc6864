//! Whether two declarations are of one instrument: the same but for names of the chain, documentation, and errors that one of them has alone.

use model_core::algebra::Poly;
use model_core::{Chain, SymbolId, SymbolKind, print};

use crate::refusal::Refusal;

/// Refuses two declarations that are not of one instrument; says what differs.
///
/// # Errors
/// Bodies, joints, inputs, observables, or the place of an error that both have, differ.
pub fn require_same(names: [&str; 2], chains: [&Chain; 2]) -> Result<(), Refusal> {
    match difference(chains) {
        None => Ok(()),
        Some(difference) => Err(Refusal::Input(format!(
            "`{}` and `{}` are of different instruments: {difference}; compare calibrations of one declaration",
            names[0], names[1]
        ))),
    }
}

/// What a chain has, in words.
type Listed = fn(&Chain) -> Vec<String>;

/// The first difference that matters.
fn difference(chains: [&Chain; 2]) -> Option<String> {
    let lists: [(&str, Listed); 4] = [
        ("joints and inputs", readings),
        ("bodies", bodies),
        ("observables", observables),
        ("gravity", gravity),
    ];
    for (what, of) in lists {
        let [one, other] = chains.map(of);
        let alone = |list: &[String], than: &[String]| list.iter().find(|own| !than.contains(own)).cloned();
        match (alone(&one, &other), alone(&other, &one)) {
            (Some(one), Some(other)) => {
                return Some(format!("`{one}` in the first is `{other}` in the second"));
            }
            (Some(one), None) => return Some(format!("the second has no `{one}`")),
            (None, Some(other)) => return Some(format!("the first has no `{other}`")),
            (None, None) if one != other => return Some(format!("the {what} come in another order")),
            (None, None) => {}
        }
    }
    chains[0].bodies.iter().enumerate().find_map(|(at, body)| {
        let [one, other] = [0, 1].map(|chain| factors(chains[chain], chains[1 - chain], at));
        let first = one.iter().zip(&other).find(|(one, other)| one != other);
        let told = |one: &str, other: &str| {
            format!("body `{}` has `{one}` in the first and `{other}` in the second", body.name)
        };
        match first {
            Some((one, other)) => Some(told(one, other)),
            None if one.len() > other.len() => Some(told(&one[other.len()], "nothing")),
            None if one.len() < other.len() => Some(told("nothing", &other[one.len()])),
            None => None,
        }
    })
}

fn readings(chain: &Chain) -> Vec<String> {
    let ids = chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input));
    let mut all: Vec<String> = ids
        .map(|id| {
            let symbol = chain.symbol(id);
            let kind = if symbol.kind == SymbolKind::Joint { "joint" } else { "input" };
            format!("{kind} {} in {}", symbol.name, symbol.quantity.unit())
        })
        .collect();
    all.sort_unstable();
    all
}

fn bodies(chain: &Chain) -> Vec<String> {
    let lower =
        |body: &model_core::Body| body.lower.map_or("ground", |id| chain.body(id).name.as_str()).to_owned();
    chain.bodies.iter().map(|body| format!("body {} on {}", body.name, lower(body))).collect()
}

fn observables(chain: &Chain) -> Vec<String> {
    let camera = |observable: &model_core::Observable| -> String {
        let numbers = observable.image.iter().flat_map(|image| &image.intrinsics);
        numbers.map(|number| format!(" {}", print::text(number, chain))).collect()
    };
    let one = |observable: &model_core::Observable| {
        let components =
            observable.components.iter().map(|part| print::text(part, chain)).collect::<Vec<_>>();
        let labels: Vec<String> = observable.labels().map(|label| label.to_string()).collect();
        let frame = observable.frame.map_or("ground", |id| chain.body(id).name.as_str());
        format!(
            "observe {}: {:?}({}) of {}, {} in {frame}",
            observable.name,
            observable.kind,
            components.join(", "),
            chain.body(observable.body).name,
            labels.join(", "),
        )
        .to_lowercase()
            + &camera(observable)
    };
    chain.observables.iter().map(one).collect()
}

fn gravity(chain: &Chain) -> Vec<String> {
    vec![format!(
        "gravity ({})",
        chain.gravity.iter().map(|part| print::text(part, chain)).collect::<Vec<_>>().join(", ")
    )]
}

/// The factors of a body without the errors that the other declaration does not have.
fn factors(chain: &Chain, other: &Chain, body: usize) -> Vec<String> {
    let is_alone = |id: SymbolId| {
        let symbol = chain.symbol(id);
        let is_there = other.find_symbol(&symbol.name).is_some_and(|id| other.symbol(id).kind == symbol.kind);
        symbol.kind == SymbolKind::Error && !is_there
    };
    let factors = chain.bodies.get(body).into_iter().flat_map(|body| &body.factors);
    factors
        .map(|factor| (factor, factor.amount.graded_part(is_alone, 0)))
        .filter(|(_, amount): &(_, Poly)| !amount.is_zero())
        .map(|(factor, amount)| {
            let letter = if factor.kind == model_core::TransformKind::Rotation { 'R' } else { 'T' };
            format!("{letter}{}({})", factor.axis, print::text(&amount, chain))
        })
        .collect()
}
