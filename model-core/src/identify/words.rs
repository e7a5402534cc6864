//! Identifiability in words.

use std::fmt::Write;

use super::{Holds, Identifiability, Mistaken, Ratio, Verdict};
use crate::algebra::Poly;
use crate::chain::{Chain, ObservableId};
use crate::print;
use crate::symbol::SymbolId;

/// What can be told apart, as lines of text.
#[must_use]
pub fn text(found: &Identifiability, chain: &Chain) -> String {
    let name = |id: &SymbolId| chain.symbol(*id).name.clone();
    let mut lines = format!(
        "{}: of {} errors, data can determine {} combinations (first order)\n",
        observables(&found.observables, chain),
        found.declared,
        found.estimable.len()
    );
    if let Holds::AtDeclaredValues { poses } = found.holds {
        lines.push_str("  at the declared values of the constants: formulas for all values are too large\n");
        let _ = writeln!(
            lines,
            "  exact arithmetic at {poses} random poses decides; factors are rounded to six digits"
        );
    }
    if !found.invisible.is_empty() {
        let names: Vec<String> = found.invisible.iter().map(name).collect();
        let _ = writeln!(lines, "  without influence: {}", names.join(", "));
    }
    for group in &found.alike {
        let names: Vec<String> = group
            .iter()
            .map(|member| match scaled("", &member.ratio, chain) {
                one if one.is_empty() => name(&member.error),
                ratio => format!("{} ({ratio} times the first)", name(&member.error)),
            })
            .collect();
        let _ = writeln!(lines, "  one and the same: {}", names.join(", "));
    }
    for dependence in &found.combinations {
        let parts: Vec<String> =
            dependence.others.iter().map(|(id, ratio)| scaled(&name(id), ratio, chain)).collect();
        let _ = writeln!(lines, "  {} acts as {} together", name(&dependence.error), parts.join(" and "));
    }
    lines.push_str("  can be estimated:\n");
    for combination in &found.estimable {
        let sum = combination
            .iter()
            .fold(Poly::zero(), |sum, (error, factor)| &sum + &(&Poly::symbol(*error) * factor));
        let _ = writeln!(lines, "    {}", print::text(&sum, chain));
    }
    lines
}

/// What a candidate would be mistaken for, as lines of text.
#[must_use]
pub fn mistaken_text(mistaken: &Mistaken) -> String {
    let chain = &mistaken.chain;
    let name = |id: &SymbolId| chain.symbol(*id).name.clone();
    let mut lines = String::new();
    for (unknown, verdict) in &mistaken.unknowns {
        let words = match verdict {
            Verdict::Invisible => "has no influence (first order)".to_owned(),
            Verdict::Separable => "can be told apart from every declared error".to_owned(),
            Verdict::MistakenFor(others) => {
                let parts: Vec<String> = others
                    .iter()
                    .map(|group| {
                        let names: Vec<String> = group.errors.iter().map(name).collect();
                        let (first, rest) =
                            names.split_first().map_or(("", &[][..]), |(first, rest)| (first, rest));
                        let first = scaled(first, &group.ratio, chain);
                        if rest.is_empty() { first } else { format!("{first} (or {})", rest.join(", ")) }
                    })
                    .collect();
                format!("would be mistaken for {}", parts.join(" together with "))
            }
        };
        let _ = writeln!(lines, "{}: {words}", name(unknown));
    }
    lines
}

fn observables(ids: &[ObservableId], chain: &Chain) -> String {
    let names: Vec<&str> = ids.iter().map(|id| chain.observable(*id).name.as_str()).collect();
    names.join(" and ")
}

/// A name times a ratio; a ratio of one is left out.
fn scaled(name: &str, ratio: &Ratio, chain: &Chain) -> String {
    let Ratio { numerator, denominator } = ratio;
    let part = |poly: &Poly| {
        let text = print::text(poly, chain);
        if poly.len() > 1 { format!("({text})") } else { text }
    };
    let factor = match (numerator == &Poly::one(), denominator == &Poly::one()) {
        (true, true) => return name.to_owned(),
        (_, true) => part(numerator),
        _ => format!("{}/{}", part(numerator), part(denominator)),
    };
    if name.is_empty() { factor } else { format!("{factor}*{name}") }
}
