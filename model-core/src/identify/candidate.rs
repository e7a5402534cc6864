//! Candidate effects: what an undeclared effect would be mistaken for.

use std::ops::Range;

use super::at_values::AtValues;
use super::elimination::Echelon;
use super::pair::Pair;
use super::{Column, IdentifyError, OutOfReach, Quotient, Ratio, equations};
use crate::algebra::Poly;
use crate::chain::{Axis, BodyId, Chain, Factor, ObservableId, Role, TransformKind};
use crate::expr::{Expr, Node};
use crate::mistake::{Mistake, Mistakes};
use crate::symbol::{Quantity, Symbol, SymbolId, SymbolKind};
use crate::syntax;

/// An effect that a declaration lacks: one more factor at a place in the chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The chain with the factor in it.
    chain: Chain,
    /// The symbols that the factor brings with it.
    unknowns: Vec<SymbolId>,
}

/// What became of a candidate.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistaken {
    /// The chain with the candidate in it, for the names of its unknowns.
    pub chain: Chain,
    /// For every unknown of the candidate, in order.
    pub unknowns: Vec<(SymbolId, Verdict)>,
}

/// What one unknown of a candidate would be mistaken for.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// It has no influence to first order.
    Invisible,
    /// Its influence is no combination of those of the declared errors.
    Separable,
    /// Its influence is exactly this combination.
    MistakenFor(Vec<Lookalike>),
}

/// Errors that are alike, one of which is part of the combination that a candidate is mistaken for.
#[derive(Debug, Clone, PartialEq)]
pub struct Lookalike {
    /// The errors, the one that the ratio belongs to first.
    pub errors: Vec<SymbolId>,
    /// The influence of the candidate over that of the first.
    pub ratio: Ratio,
}

impl Candidate {
    /// Reads a candidate such as `Rx(x*cos(beta))`, for a body and a role; names that the chain does not know are its
    /// unknowns.
    ///
    /// # Errors
    /// The mistakes in the text.
    pub fn parse(chain: &Chain, body: BodyId, role: Role, text: &str) -> Result<Self, Mistakes> {
        let fail = |mistake: Mistake<Range<usize>>| Mistakes::locate(text, [mistake]);
        let (kind, axis, amount_text, offset) = head(text).ok_or_else(|| {
            fail(
                Mistake::new(0..text.len(), "no elementary transform")
                    .with_help("write Rx, Ry, Rz, Tx, Ty or Tz and an amount: `Rx(x*cos(beta))`"),
            )
        })?;
        let shift = |place: &Range<usize>| place.start + offset..place.end + offset;
        let amount = syntax::parse_amount(amount_text).map_err(|mistakes| {
            Mistakes::locate(
                text,
                mistakes.iter().map(|mistake| Mistake {
                    place: shift(&mistake.place.bytes),
                    message: mistake.message.clone(),
                    help: mistake.help.clone(),
                }),
            )
        })?;
        let mut extended = chain.clone();
        let mut names = Vec::new();
        collect_names(&amount, &mut names);
        names.retain(|name| chain.find_symbol(name).is_none());
        let mut unknowns = Vec::new();
        for name in names {
            let id = u16::try_from(extended.symbols.len())
                .map(SymbolId)
                .map_err(|_| fail(Mistake::new(0..text.len(), "too many symbols")))?;
            unknowns.push(id);
            extended.symbols.push(Symbol {
                latex: name.clone(),
                name,
                kind: SymbolKind::Error,
                quantity: Quantity::Number,
                meaning: None,
                of: None,
                documentation: String::new(),
                value: None,
            });
        }
        extended.add_ramps_of(&amount);
        let amount = Poly::from_expr_with_ramps(
            &amount,
            |name| extended.find_symbol(name),
            |symbol| !matches!(extended.symbol(symbol).kind, SymbolKind::Error | SymbolKind::Ramp),
            |of, from, to| extended.find_ramp(of, from, to),
        )
        .map_err(|error| fail(Mistake::new(shift(error.place()), error.to_string())))?;
        let factors = &mut extended.bodies[usize::from(body.0)].factors;
        let place = factors.partition_point(|factor| factor.role <= role);
        factors.insert(place, Factor { role, kind, axis, amount, documentation: String::new() });
        Ok(Self { chain: extended, unknowns })
    }
}

/// What a candidate would be mistaken for in the data of some observables.
///
/// # Errors
/// See [`IdentifyError`].
pub fn mistaken_for(candidate: &Candidate, observables: &[ObservableId]) -> Result<Mistaken, IdentifyError> {
    let chain = &candidate.chain;
    let is_unknown = |id: &SymbolId| candidate.unknowns.contains(id);
    let declared: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).filter(|id| !is_unknown(id)).collect();
    let verdicts = match formulas(candidate, observables, &declared) {
        Err(OutOfReach::ForFormulas) => at_values(candidate, observables, &declared)?,
        Err(OutOfReach::For(error)) => return Err(error.into()),
        Ok(verdicts) => verdicts,
    };
    let unknowns = candidate.unknowns.iter().copied().zip(verdicts).collect();
    Ok(Mistaken { chain: chain.clone(), unknowns })
}

/// The verdicts on the unknowns, by formulas over all values of the constants.
fn formulas(
    candidate: &Candidate,
    observables: &[ObservableId],
    declared: &[SymbolId],
) -> Result<Vec<Verdict>, OutOfReach> {
    let chain = &candidate.chain;
    let alone = equations(chain, observables, declared, Echelon::default())?;
    let columns: Vec<Column<Ratio>> = (0..declared.len()).map(|index| Column::new(&alone, index)).collect();
    let verdict = |&unknown: &SymbolId| {
        let with: Vec<SymbolId> = declared.iter().copied().chain([unknown]).collect();
        let echelon = equations(chain, observables, &with, Echelon::with_last(declared.len()))?;
        let column = Column::new(&echelon, declared.len());
        Ok(verdict(&column, echelon.rows().len() > alone.rows().len(), &columns, declared))
    };
    candidate.unknowns.iter().map(verdict).collect()
}

/// The same at their declared values.
fn at_values(
    candidate: &Candidate,
    observables: &[ObservableId],
    declared: &[SymbolId],
) -> Result<Vec<Verdict>, IdentifyError> {
    let chain = &candidate.chain;
    let alone = AtValues::new(chain, observables, declared)?;
    let columns: Vec<Column<Pair>> =
        (0..declared.len()).map(|index| Column::at_values(&alone, index)).collect();
    let verdict = |&unknown: &SymbolId| {
        let with: Vec<SymbolId> = declared.iter().copied().chain([unknown]).collect();
        let found = AtValues::new(chain, observables, &with)?;
        let column = Column::at_values(&found, declared.len());
        Ok(verdict(&column, found.rows.len() > alone.rows.len(), &columns, declared))
    };
    candidate.unknowns.iter().map(verdict).collect()
}

fn verdict<Q: Quotient>(
    column: &Column<Q>,
    is_new: bool,
    columns: &[Column<Q>],
    declared: &[SymbolId],
) -> Verdict {
    if column.is_zero() {
        Verdict::Invisible
    } else if is_new {
        Verdict::Separable
    } else {
        Verdict::MistakenFor(lookalikes(column, columns, declared))
    }
}

/// The parts of a column: alone a declared error that it is a multiple of, or else the pivots; each with those alike.
fn lookalikes<Q: Quotient>(
    column: &Column<Q>,
    columns: &[Column<Q>],
    declared: &[SymbolId],
) -> Vec<Lookalike> {
    let alike = |other: &Column<Q>| -> Vec<SymbolId> {
        let rest = columns.iter().filter(|each| each.index != other.index && each.over(other).is_some());
        std::iter::once(other).chain(rest).map(|each| declared[each.index]).collect()
    };
    let single = columns.iter().find_map(|other| Some((other, column.over(other)?)));
    match single {
        Some((other, ratio)) => vec![Lookalike { errors: alike(other), ratio: ratio.ratio() }],
        None => column
            .parts
            .iter()
            .map(|(pivot, ratio)| Lookalike { errors: alike(&columns[*pivot]), ratio: ratio.ratio() })
            .collect(),
    }
}

/// `Rx(amount)` taken apart: kind, axis, amount, and where that begins.
fn head(text: &str) -> Option<(TransformKind, Axis, &str, usize)> {
    let (name, rest) = text.split_once('(')?;
    let amount = rest.trim_end().strip_suffix(')')?;
    let (kind, axis) = match name.trim() {
        "Rx" => (TransformKind::Rotation, Axis::X),
        "Ry" => (TransformKind::Rotation, Axis::Y),
        "Rz" => (TransformKind::Rotation, Axis::Z),
        "Tx" => (TransformKind::Translation, Axis::X),
        "Ty" => (TransformKind::Translation, Axis::Y),
        "Tz" => (TransformKind::Translation, Axis::Z),
        _ => return None,
    };
    Some((kind, axis, amount, name.len() + 1))
}

/// The names in an expression, each once, from the left.
fn collect_names<S>(expression: &Expr<S>, names: &mut Vec<String>) {
    match &expression.node {
        Node::Symbol(name) if !names.contains(name) => names.push(name.clone()),
        Node::Symbol(_) | Node::Number(_) | Node::Measured(..) | Node::Pi => {}
        Node::Ramp(parts) => parts.iter().for_each(|part| collect_names(part, names)),
        Node::Neg(a) | Node::Pow(a, _) | Node::Call(_, a) => collect_names(a, names),
        Node::Add(a, b) | Node::Mul(a, b) | Node::Div(a, b) => {
            collect_names(a, names);
            collect_names(b, names);
        }
    }
}
