//! Lines of programs, of NumPy, MATLAB or C, as formulas: the same tokens that LaTeX gives, with names for symbols.
//!
//! What means one thing in one language and another in the next (`^`, `1/2`, `*` between matrices) is refused where the
//! language is not clear from the line, or where it is not what a formula would mean.

mod lexer;
mod lists;

use std::collections::BTreeMap;
use std::ops::Range;

use super::layout::Row;
use super::parser::{Notes, Parser, Value};
use super::token::{Kind, Token};
use super::{NameOf, PrintedMatrix, PrintedSymbols, Unreadable, naming};
use model_core::expr::Expr;
use model_core::mistake::Mistake;

pub use lexer::is_line_of_program;

type Formula = Expr<Range<usize>>;

/// Reads one line, the formula of one component.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_component(
    text: &str,
    symbols: &PrintedSymbols,
    name_of: NameOf,
) -> Result<(Formula, Notes), Unreadable> {
    let rows = rows(text, symbols)?;
    let [row] = rows.as_slice() else {
        return Err(Mistake::new(
            0..text.len(),
            format!("{} formulas, where one component stands", rows.len()),
        ));
    };
    naming::check(text, row, name_of)?;
    let (value, notes) = value(text, row, symbols)?;
    Ok((value.scalar()?, notes))
}

/// Reads lines, each a component, or one line with a list of components. Names that a line gives to what a later one uses are
/// put in there.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_vector(
    text: &str,
    symbols: &PrintedSymbols,
    names: &[NameOf],
) -> Result<(Vec<Formula>, Notes), Unreadable> {
    let rows = rows(text, symbols)?;
    let alone = rows.len() == 1;
    let (mut components, mut notes) = (Vec::new(), Notes::default());
    for (at, row) in rows.iter().enumerate() {
        naming::check(text, row, NameOf::in_row(names, at, alone))?;
        let (value, own) = value(text, row, symbols)?;
        notes.join(&own);
        match value {
            Value::Matrix(matrix) if alone && matrix.is_vector() => components.extend(matrix.entries),
            value => components.push(value.scalar()?),
        }
    }
    Ok((components, notes))
}

/// Reads a list, a list of lists, or an amount, as a matrix.
///
/// # Errors
/// The first thing that cannot be read, with its place.
pub fn read_matrix(text: &str, symbols: &PrintedSymbols) -> Result<PrintedMatrix, Unreadable> {
    let rows = rows(text, symbols)?;
    let [row] = rows.as_slice() else {
        return Err(Mistake::new(0..text.len(), "one matrix is wanted"));
    };
    let (value, notes) = value(text, row, symbols)?;
    PrintedMatrix::of(value, notes)
}

fn value(text: &str, row: &Row, symbols: &PrintedSymbols) -> Result<(Value, Notes), Unreadable> {
    let mut parser = Parser::new(text, &row.formula, row.end.clone(), symbols);
    let value = parser.formula()?;
    parser.expect_end()?;
    Ok((value, parser.notes))
}

/// The formulas of a text, with what they call by a name of their own put in.
fn rows(text: &str, symbols: &PrintedSymbols) -> Result<Vec<Row>, Unreadable> {
    let tokens = lists::marked(lexer::tokens(text, |name| symbols.declares(name))?)?;
    let mut given: BTreeMap<String, Vec<Token>> = BTreeMap::new();
    let (mut used, mut shadowed): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let mut rows: Vec<(Option<String>, Row)> = Vec::new();
    let mut depth = 0;
    let ends = |token: &Token| {
        match token.kind {
            Kind::Begin(_) => depth += 1,
            Kind::End(_) => depth -= 1,
            _ => {}
        }
        depth == 0 && token.kind == Kind::Row
    };
    for line in tokens.split(ends).filter(|line| !line.is_empty()) {
        let equals: Vec<usize> = (0..line.len()).filter(|&at| line[at].kind == Kind::Mark('=')).collect();
        let (name, formula) = match equals.as_slice() {
            [] => (&line[..0], line),
            [at] => (&line[..*at], &line[at + 1..]),
            [_, second, ..] => {
                return Err(Mistake::new(line[*second].place.clone(), "a second `=` in one line"));
            }
        };
        let mut expanded = Vec::with_capacity(formula.len());
        for token in formula {
            match &token.kind {
                Kind::Name(own) if shadowed.contains(own) => {
                    let message = format!("is `{own}` here the declared one, or what a line above calls so?");
                    return Err(Mistake::new(token.place.clone(), message)
                        .with_help("give the value of that line a name that is not declared"));
                }
                Kind::Name(own) if given.contains_key(own) => {
                    used.push(own.clone());
                    let mark = |mark| Token { kind: Kind::Mark(mark), ..token.clone() };
                    expanded.push(mark('('));
                    expanded.extend(given[own].iter().cloned());
                    expanded.push(mark(')'));
                }
                _ => expanded.push(token.clone()),
            }
        }
        let own = match name {
            [Token { kind: Kind::Name(own), .. }] => Some(own.clone()),
            _ => None,
        };
        match &own {
            Some(own) if symbols.declares(own) => shadowed.push(own.clone()),
            Some(own) => {
                given.insert(own.clone(), expanded.clone());
            }
            None => {}
        }
        let end = formula.last().map_or(text.len(), |token| token.place.end);
        rows.push((own, Row { name: name.to_vec(), formula: expanded, end: end..end }));
    }
    rows.retain(|(own, _)| own.as_ref().is_none_or(|own| !used.contains(own)));
    if rows.is_empty() {
        return Err(Mistake::new(0..text.len(), "a formula is missing"));
    }
    in_order(&mut rows)?;
    Ok(rows.into_iter().map(|(_, row)| row).collect())
}

/// Puts components that lines give by number, `p[0] = …`, into the order of their numbers; none may be missing.
fn in_order(rows: &mut [(Option<String>, Row)]) -> Result<(), Unreadable> {
    let numbers: Option<Vec<(&str, usize)>> =
        rows.iter().map(|(own, _)| naming::numbered(own.as_deref()?)).collect();
    let Some(mut numbers) = numbers.filter(|numbers| numbers.len() > 1) else { return Ok(()) };
    numbers.sort_unstable();
    // MATLAB counts from one.
    let first = if numbers[0].0.ends_with('(') { numbers[0].1.min(1) } else { 0 };
    if numbers.iter().zip(first..).any(|((name, number), at)| *name != numbers[0].0 || *number != at) {
        let place = rows[0].1.name.first().map_or(0..0, |token| token.place.clone());
        return Err(Mistake::new(place, "these numbers of components do not follow one another")
            .with_help("write one line for each component of one vector"));
    }
    rows.sort_by_key(|(own, _)| own.as_deref().and_then(naming::numbered).map(|(_, number)| number));
    Ok(())
}
