//! Reading numbers exactly: `0.25`, `3`, `1e-6`.

use proc_macro2::{Literal, Span};

use crate::algebra::Rational;
use crate::expr::{Expr, Node};
use crate::mistake::Mistake;
use crate::unit::Unit;

/// A number, from its token.
pub fn read(literal: &Literal) -> Result<Expr<Span>, Mistake<Span>> {
    let place = literal.span();
    let text = literal.to_string();
    let (number, rest) = split(&text);
    if number.is_empty() {
        return Err(Mistake::new(place, "a quoted text cannot stand in an amount")
            .with_help("write a number, a name, `pi`, or `sin(…)` and so on"));
    }
    if !rest.is_empty() {
        let help = match Unit::find(rest) {
            Some(_) => format!("write `{number} {rest}` for a number with its unit"),
            None => format!("write `{number}*{rest}` for a product"),
        };
        return Err(Mistake::new(place, "a number directly followed by letters").with_help(help));
    }
    match Rational::parse_decimal(number) {
        Ok(value) => Ok(Expr { node: Node::Number(value), place }),
        Err(error) => {
            Err(Mistake::new(place, error.to_string()).with_help("write it as `0.25`, `3` or `1e-6`"))
        }
    }
}

/// The longest beginning that reads as a decimal number, and what follows it.
fn split(text: &str) -> (&str, &str) {
    let digits = |from: usize| {
        from + text[from..].bytes().take_while(|byte| byte.is_ascii_digit() || *byte == b'_').count()
    };
    let mut end = digits(0);
    if end == 0 {
        return ("", text);
    }
    if text[end..].starts_with('.') {
        end = digits(end + 1);
    }
    if text[end..].starts_with(['e', 'E']) {
        let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
        let last = digits(end + 1 + sign);
        if last > end + 1 + sign {
            end = last;
        }
    }
    text.split_at(end)
}
