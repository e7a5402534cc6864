//! Formulas as a paper prints them: collected by error, in the symbols of the chain.
//!
//! [`text`] is the plain syntax of amounts, and reads back; [`latex`] uses each symbol's printed form;
//! [`markdown`] is the same between dollars. [`form`] prints what a form has for each number that is shown. Of a few exact ways to write
//! the functions of angles the shortest is taken (`pieces`); a [`Hand`] says which ways a paper has itself.

mod collect;
mod fraction;
mod notation;
mod pieces;
mod steps;
mod table;

use crate::algebra::{Poly, Rational};
use crate::chain::Chain;
use crate::forms::Form;
use crate::symbol::SymbolId;
use collect::groups;
use notation::{Latex, Notation, Text};
use pieces::Piece;

pub use pieces::Hand;
pub use steps::steps;
pub use table::table;

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
    write_sum(poly, chain, &Text, &Hand::default())
}

/// A formula in LaTeX, without delimiters.
#[must_use]
pub fn latex(poly: &Poly, chain: &Chain) -> String {
    write_sum(poly, chain, &Latex, &Hand::default())
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

/// A formula in a style and in the way of a paper; its abbreviations stand in LaTeX alone.
#[must_use]
pub fn by_hand(poly: &Poly, chain: &Chain, style: Style, hand: &Hand) -> String {
    match style {
        Style::Text => text(poly, chain),
        Style::Latex => write_sum(poly, chain, &Latex, hand),
        Style::Markdown => format!("${}$", write_sum(poly, chain, &Latex, hand)),
    }
}

/// Whether a formula is written in one product, or as zero.
#[must_use]
pub fn is_short(poly: &Poly) -> bool {
    let groups = groups(poly);
    let functions = |angular: &Poly| pieces::shortest(angular, &Hand::default()).len();
    groups.iter().map(|group| group.monomials.len() * functions(&group.angular)).sum::<usize>() <= 1
}

/// The components of a form, one a line, each with its name; in LaTeX as an `aligned` block, in Markdown as a list.
#[must_use]
pub fn form(form: &Form, chain: &Chain, style: Style) -> String {
    let observable = chain.observable(form.observable);
    let name = &observable.name;
    let rows = form.components.iter().zip(observable.labels());
    match style {
        Style::Text => rows
            .map(|(component, label)| format!("{name}_{label} = {}\n", component.show(chain, style)))
            .collect(),
        Style::Latex => {
            let rows: Vec<String> = rows
                .map(|(component, label)| {
                    let name = name.replace('_', "\\_");
                    format!("  \\text{{{name}}}_{} &= {}", subscript(label), component.show(chain, style))
                })
                .collect();
            format!("\\begin{{aligned}}\n{}\n\\end{{aligned}}\n", rows.join(" \\\\\n"))
        }
        Style::Markdown => rows
            .map(|(component, label)| format!("- {name}, {label}: {}\n", component.show(chain, style)))
            .collect(),
    }
}

/// The name of what is shown as a subscript: one letter as it is.
fn subscript(label: &str) -> String {
    if label.len() == 1 { label.to_owned() } else { format!("{{\\text{{{}}}}}", label.replace('_', " ")) }
}

/// The symbols of a monomial and their powers.
type Monomial = Vec<(SymbolId, u32)>;

/// One printed addend: whether it is subtracted, and its absolute value.
struct Addend {
    negative: bool,
    body: String,
}

fn write_sum(poly: &Poly, chain: &Chain, notation: &dyn Notation, hand: &Hand) -> String {
    let writer = Writer { chain, notation, hand };
    let mut addends = Vec::new();
    for group in groups(poly) {
        // Monomials that no function of the angles stands beside need no parentheses.
        if group.angular == Poly::one() {
            addends.extend(group.monomials.iter().map(|pair| writer.monomial(pair, false)));
        } else {
            addends.push(writer.group(group.monomials, pieces::shortest(&group.angular, hand)));
        }
    }
    join(&addends)
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

/// A monomial with its number.
type Numbered = (Rational, Monomial);

struct Writer<'a> {
    chain: &'a Chain,
    notation: &'a dyn Notation,
    hand: &'a Hand,
}

impl Writer<'_> {
    /// `(sum of monomials) · shared functions · (sum of functions of angles)`, with what is one taken out.
    fn group(&self, mut monomials: Vec<Numbered>, mut pieces: Vec<Piece>) -> Addend {
        if let ([(coefficient, monomial)], [piece]) = (monomials.as_slice(), pieces.as_slice()) {
            return self.product(&(coefficient * &piece.coefficient), monomial, Some(piece));
        }
        take_number(&mut monomials, &mut pieces);
        let sum = |addends: Vec<Addend>| join(&addends);
        let negative = monomials.first().is_some_and(|(coefficient, _)| coefficient.is_negative());
        let written = match monomials.as_slice() {
            [(coefficient, monomial)] if monomial.is_empty() && coefficient.abs().is_one() => None,
            [only] => Some(self.monomial(only, negative).body),
            several => {
                let addends = several.iter().map(|pair| self.monomial(pair, negative)).collect();
                Some(self.notation.parentheses(&sum(addends)))
            }
        };
        let shared = take_shared(&mut pieces).map(|piece| self.piece(&piece).body);
        let angular = match pieces.as_slice() {
            [only] if only.coefficient.is_one() && only.functions.is_empty() && only.poles.is_empty() => None,
            [only] => Some(self.piece(only).body),
            several => {
                let addends: Vec<Addend> = several.iter().map(|piece| self.piece(piece)).collect();
                if written.is_none() && shared.is_none() && !negative {
                    return Addend { negative, body: sum(addends) };
                }
                Some(self.notation.parentheses(&sum(addends)))
            }
        };
        let factors: Vec<String> = written.into_iter().chain(shared).chain(angular).collect();
        Addend { negative, body: self.notation.product(&factors) }
    }

    fn monomial(&self, (coefficient, monomial): &Numbered, turned: bool) -> Addend {
        let coefficient = if turned { -coefficient } else { coefficient.clone() };
        self.product(&coefficient, monomial, None)
    }

    fn piece(&self, piece: &Piece) -> Addend {
        self.product(&piece.coefficient, &Vec::new(), Some(piece))
    }

    fn product(&self, coefficient: &Rational, powers: &Monomial, piece: Option<&Piece>) -> Addend {
        let mut factors = Vec::new();
        let magnitude = coefficient.abs();
        let bare = powers.is_empty()
            && piece.is_none_or(|piece| piece.functions.is_empty() && piece.poles.is_empty());
        if bare || !magnitude.is_one() {
            factors.push(self.notation.number(&magnitude));
        }
        for &(symbol, power) in powers {
            factors.push(self.notation.power(self.chain.symbol(symbol), power));
        }
        for function in piece.iter().flat_map(|piece| &piece.functions) {
            factors.push(match self.hand.abbreviation(function) {
                Some(printed) => self.notation.abbreviated(printed, function.power),
                None => self.notation.function(self.chain, function),
            });
        }
        for (pole, over) in piece.iter().flat_map(|piece| &piece.poles) {
            factors.push(self.notation.pole(self.chain.symbol(pole.symbol), pole, *over));
        }
        Addend { negative: coefficient.is_negative(), body: self.notation.product(&factors) }
    }
}

/// Moves the number that all pieces share, with the sign of the first, to the monomials.
fn take_number(monomials: &mut [Numbered], pieces: &mut [Piece]) {
    let measure = pieces
        .iter()
        .map(|piece| piece.coefficient.clone())
        .reduce(|a, b| a.common_measure(&b))
        .unwrap_or_default();
    let negative = pieces.first().is_some_and(|piece| piece.coefficient.is_negative());
    let measure = if negative { -&measure.abs() } else { measure.abs() };
    let Some(inverse) = measure.recip() else { return };
    for piece in pieces {
        piece.coefficient = &piece.coefficient * &inverse;
    }
    for (coefficient, _) in monomials {
        *coefficient = &*coefficient * &measure;
    }
}

/// Takes the functions that all of several pieces have out of them.
fn take_shared(pieces: &mut [Piece]) -> Option<Piece> {
    let [first, others @ ..] = &*pieces else { return None };
    let has = |piece: &Piece, function| piece.functions.contains(function);
    let shared: Vec<pieces::Function> = first
        .functions
        .iter()
        .filter(|function| others.iter().all(|piece| has(piece, function)))
        .cloned()
        .collect();
    if others.is_empty() || shared.is_empty() {
        return None;
    }
    for piece in &mut *pieces {
        piece.functions.retain(|function| !shared.contains(function));
    }
    Some(Piece { coefficient: Rational::ONE, functions: shared, poles: Vec::new() })
}
