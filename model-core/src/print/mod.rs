//! Formulas as a paper prints them: collected by error, in the symbols of the chain.
//!
//! [`text`] is the plain syntax of amounts, and reads back; [`latex`] uses each symbol's printed form;
//! [`markdown`] is the same between dollars. [`form`] prints the three components of a form.

mod collect;
mod notation;

use crate::algebra::{Poly, Rational, Term, WaveFactor};
use crate::chain::Chain;
use crate::forms::Form;
use crate::symbol::SymbolId;
use collect::{Group, groups};
use notation::{Latex, Notation, Text};

/// How a formula is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// The plain syntax of amounts: `dtheta_y1*cos(beta)`.
    Text,
    /// LaTeX without delimiters: `\Delta\theta_{y1}^0 \cos \beta`.
    Latex,
    /// LaTeX between dollars, for Markdown with mathematics.
    Markdown,
}

/// A formula in the plain syntax of amounts.
#[must_use]
pub fn text(poly: &Poly, chain: &Chain) -> String {
    write_sum(poly, chain, &Text)
}

/// A formula in LaTeX, without delimiters.
#[must_use]
pub fn latex(poly: &Poly, chain: &Chain) -> String {
    write_sum(poly, chain, &Latex)
}

/// A formula in LaTeX between dollars.
#[must_use]
pub fn markdown(poly: &Poly, chain: &Chain) -> String {
    format!("${}$", latex(poly, chain))
}

/// A formula in a style.
#[must_use]
pub fn poly(poly: &Poly, chain: &Chain, style: Style) -> String {
    match style {
        Style::Text => text(poly, chain),
        Style::Latex => latex(poly, chain),
        Style::Markdown => markdown(poly, chain),
    }
}

/// The components of a form, one a line, each with its name; in LaTeX as an `aligned` block, in Markdown as a list.
#[must_use]
pub fn form(form: &Form, chain: &Chain, style: Style) -> String {
    let name = &chain.observable(form.observable).name;
    let rows = form.components.iter().zip(["x", "y", "z"]);
    match style {
        Style::Text => {
            rows.map(|(component, axis)| format!("{name}_{axis} = {}\n", text(component, chain))).collect()
        }
        Style::Latex => {
            let rows: Vec<String> = rows
                .map(|(component, axis)| {
                    let name = name.replace('_', "\\_");
                    format!("  \\text{{{name}}}_{axis} &= {}", latex(component, chain))
                })
                .collect();
            format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}\n", rows.join(" \\\\\n"))
        }
        Style::Markdown => rows
            .map(|(component, axis)| format!("- {name}, {axis}: {}\n", markdown(component, chain)))
            .collect(),
    }
}

/// The symbols of a monomial and their powers.
type Monomial = Vec<(SymbolId, u32)>;

/// One printed addend: whether it is subtracted, and its absolute value.
struct Addend {
    negative: bool,
    body: String,
}

fn write_sum(poly: &Poly, chain: &Chain, notation: &dyn Notation) -> String {
    let write = |group: &Group| {
        // Monomials that no function of the angles stands beside need no parentheses.
        if group.angular == Poly::one() {
            let terms = group.monomials.iter().map(|pair| Group::term(pair, false));
            terms.map(|term| write_term(&term, chain, notation)).collect()
        } else {
            vec![write_group(group, chain, notation)]
        }
    };
    join(&groups(poly).iter().flat_map(write).collect::<Vec<_>>())
}

fn join(addends: &[Addend]) -> String {
    let mut result = String::new();
    for (index, addend) in addends.iter().enumerate() {
        result.push_str(match (index, addend.negative) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        result.push_str(&addend.body);
    }
    if result.is_empty() { "0".to_owned() } else { result }
}

/// `(sum of monomials) · shared sines and cosines · (sum of functions of angles)`, with what is one taken out.
fn write_group(group: &Group, chain: &Chain, notation: &dyn Notation) -> Addend {
    let mut waves: Vec<Term> = group.angular.terms().collect();
    if let ([(coefficient, monomial)], [term]) = (group.monomials.as_slice(), waves.as_slice()) {
        let coefficient = coefficient * &term.coefficient;
        let term = Term { coefficient, powers: monomial.clone(), ..term.clone() };
        return write_term(&term, chain, notation);
    }
    let sum = |terms: Vec<Term>| {
        join(&terms.iter().map(|term| write_term(term, chain, notation)).collect::<Vec<_>>())
    };
    let negative = group.monomials.first().is_some_and(|(coefficient, _)| coefficient.is_negative());
    let monomials: Vec<Term> = group.monomials.iter().map(|pair| Group::term(pair, negative)).collect();
    let monomials = match monomials.as_slice() {
        [only] if only.powers.is_empty() && only.coefficient.is_one() => None,
        [only] => Some(write_term(only, chain, notation).body),
        _ => Some(notation.parentheses(&sum(monomials))),
    };
    let shared = take_shared(&mut waves).map(|term| write_term(&term, chain, notation).body);
    let angular = match waves.as_slice() {
        [only] if only.coefficient.is_one() && only.waves.is_empty() && only.poles.is_empty() => None,
        [only] => Some(write_term(only, chain, notation).body),
        _ if monomials.is_none() && shared.is_none() && !negative => {
            return Addend { negative, body: sum(waves) };
        }
        _ => Some(notation.parentheses(&sum(waves))),
    };
    let body = notation.product(&monomials.into_iter().chain(shared).chain(angular).collect::<Vec<_>>());
    Addend { negative, body }
}

/// Takes the sines and cosines that all of several terms have out of them.
fn take_shared(terms: &mut [Term]) -> Option<Term> {
    let [first, others @ ..] = &*terms else { return None };
    let free = |term: &Term, wave: &WaveFactor| {
        term.waves.contains(wave) && term.poles.iter().all(|pole| pole.symbol != wave.symbol)
    };
    let shared = first.waves.iter().filter(|wave| free(first, wave));
    let shared: Vec<WaveFactor> =
        shared.filter(|wave| others.iter().all(|term| free(term, wave))).copied().collect();
    if others.is_empty() || shared.is_empty() {
        return None;
    }
    for term in &mut *terms {
        term.waves.retain(|wave| !shared.contains(wave));
    }
    Some(Term { coefficient: Rational::ONE, powers: Vec::new(), waves: shared, poles: Vec::new() })
}

fn write_term(term: &Term, chain: &Chain, notation: &dyn Notation) -> Addend {
    let negative = term.coefficient.is_negative();
    let mut factors = Vec::new();
    let magnitude = term.coefficient.abs();
    let bare = term.powers.is_empty() && term.waves.is_empty() && term.poles.is_empty();
    if bare || !magnitude.is_one() {
        factors.push(notation.number(&magnitude));
    }
    for &(symbol, power) in &term.powers {
        factors.push(notation.power(chain.symbol(symbol), power));
    }
    for wave in &term.waves {
        if !term.poles.iter().any(|pole| pole.symbol == wave.symbol) {
            factors.push(notation.wave(chain.symbol(wave.symbol), wave));
        }
    }
    for pole in &term.poles {
        let over = term.waves.iter().any(|wave| wave.symbol == pole.symbol);
        factors.push(notation.pole(chain.symbol(pole.symbol), pole, over));
    }
    Addend { negative, body: notation.product(&factors) }
}
