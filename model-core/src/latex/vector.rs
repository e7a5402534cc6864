//! Printed vectors: components in brackets or as rows of a matrix, with or without the mark of transposition.

use std::ops::Range;

use super::Unreadable;
use super::parser::Parser;
use super::token::Kind;
use crate::expr::Expr;

/// Reads a whole text as a vector.
pub(super) fn read(parser: &mut Parser<'_>) -> Result<Vec<Expr<Range<usize>>>, Unreadable> {
    let mut closers = Vec::new();
    while let Some(token) = parser.peek() {
        let closer = match &token.kind {
            Kind::Mark('[') => Kind::Mark(']'),
            Kind::Mark('(') => Kind::Mark(')'),
            Kind::OpenBrace => Kind::CloseBrace,
            Kind::Begin(name) => Kind::End(name.clone()),
            _ => break,
        };
        // A parenthesis opens the vector only if its partner closes the text; else it is part of a component.
        if !parser.is_wrapped_by(&closer) {
            break;
        }
        parser.advance();
        closers.push(closer);
    }
    let mut components = Vec::new();
    loop {
        components.push(parser.formula()?);
        if !parser.take_separator() || closers.last().is_some_and(|closer| parser.is_at(closer)) {
            break;
        }
    }
    while let Some(closer) = closers.pop() {
        parser.expect_closer(&closer)?;
    }
    parser.skip_transposition();
    parser.expect_end()?;
    Ok(components)
}
