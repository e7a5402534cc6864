//! Reading the factors of a body: `motion_error: Tx(dx1), Rx(da1);`.

use proc_macro2::{Delimiter, Span};

use super::amount;
use super::declaration::{FactorGroup, FactorTerm};
use super::documentation::documentation;
use super::tokens::Reader;
use crate::mistake::Mistake;

const FACTORS_HELP: &str = "write `motion: Rz(alpha);`, and so on";
const FACTOR_HELP: &str = "write a factor as `Rx(amount)`, with Rx, Ry, Rz, Tx, Ty or Tz";

type Read<T> = Result<T, Mistake<Span>>;

/// A role with its factors.
pub fn factor_group(reader: &mut Reader<'_, '_>) -> Read<FactorGroup> {
    let documentation = documentation(reader)?;
    let role = reader.name("a list of factors").map_err(|m| m.with_help(FACTORS_HELP))?;
    reader.expect_mark(':', FACTORS_HELP)?;
    let mut factors = vec![factor(reader)?];
    while next_factor(reader) {
        factors.push(factor(reader)?);
    }
    let semicolon = reader.end_of_statement()?;
    Ok(FactorGroup { documentation, role, factors, semicolon })
}

/// Whether another factor follows; a missing comma in front of it is reported where it is due.
fn next_factor(reader: &mut Reader<'_, '_>) -> bool {
    if reader.mark(',').is_some() {
        return !reader.is_mark(';');
    }
    let is_next = reader.cursor.ident().is_some_and(|(_, rest)| rest.group(Delimiter::Parenthesis).is_some());
    if is_next {
        let mistake = Mistake::new(reader.last, "no `,` after this");
        reader.mistakes.push(mistake.with_help("write `,` between two factors"));
    }
    is_next
}

fn factor(reader: &mut Reader<'_, '_>) -> Read<FactorTerm> {
    let documentation = documentation(reader)?;
    let axis = reader.name("a factor").map_err(|m| m.with_help(FACTOR_HELP))?;
    let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) else {
        return Err(reader.expected("`(`").with_help(FACTOR_HELP));
    };
    let amount = reader.inside(inside, parentheses.close, amount::whole);
    Ok(FactorTerm { documentation, axis, amount, close: parentheses.close })
}
