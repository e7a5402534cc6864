//! Reading amounts: `sag*cos(beta)`, `a2*cos(2*alpha) + b2*sin(2*alpha)`, `elevation - pi/2`.
//!
//! Sums and products become balanced trees, so that the depth of a tree grows with the nesting of parentheses,
//! which is limited, and not with the length of the text.

use proc_macro2::{Delimiter, Span};

use super::number;
use super::tokens::{Reader, join};
use crate::expr::{Expr, Function, Node};
use crate::mistake::Mistake;
use crate::names::nearest;
use crate::unit::{Measures, Unit, UnitError};

/// Powers above this are refused: an exact polynomial with them would not fit in memory.
const MAX_POWER: i32 = 32;

/// The functions by name.
pub const FUNCTIONS: [(&str, Function); 6] = [
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("cot", Function::Cot),
    ("sec", Function::Sec),
    ("csc", Function::Csc),
];

/// The function of three arguments.
pub const RAMP: &str = "ramp";
const RAMP_HELP: &str =
    "write `ramp(elevation, 39 deg, 53 deg)`: a joint or input, where it is still 0, and where it becomes 1";

type Amount = Expr<Span>;

/// An amount that fills everything up to the end; mistakes are collected, and then there is no amount.
pub fn whole(reader: &mut Reader<'_, '_>) -> Option<Amount> {
    let amount = part(reader)?;
    if reader.is_at_end() {
        return Some(amount);
    }
    let help = if reader.is_mark(',') {
        "write one amount here"
    } else {
        "write `*` between factors, `+` or `-` between terms"
    };
    let mistake = reader.expected("the end of the amount").with_help(help);
    reader.mistakes.push(mistake);
    None
}

/// An amount that something else may follow; mistakes are collected, and then there is no amount.
pub fn part(reader: &mut Reader<'_, '_>) -> Option<Amount> {
    let before = reader.mistakes.len();
    match sum(reader) {
        Ok(amount) => (reader.mistakes.len() == before).then_some(amount),
        Err(mistake) => {
            reader.mistakes.push(mistake);
            None
        }
    }
}

/// Skips to the next comma, that not included.
pub fn skip_to_comma(reader: &mut Reader<'_, '_>) {
    while !reader.is_mark(',') {
        let Some((tree, rest)) = reader.cursor.token_tree() else {
            return;
        };
        reader.cursor = rest;
        reader.last = tree.span();
    }
}

type Read = Result<Amount, Mistake<Span>>;

fn sum(reader: &mut Reader<'_, '_>) -> Read {
    let mut terms = vec![product(reader)?];
    loop {
        if reader.mark('+').is_some() {
            terms.push(product(reader)?);
        } else if let Some(minus) = reader.mark('-') {
            let term = product(reader)?;
            terms.push(negated(minus, term));
        } else {
            return Ok(balanced(terms, Node::Add));
        }
    }
}

/// Factors and divisors are gathered apart: `a/b*c` is `(a*c)/b`.
fn product(reader: &mut Reader<'_, '_>) -> Read {
    let mut factors = vec![signed(reader)?];
    let mut divisors = Vec::new();
    loop {
        if reader.mark('*').is_some() {
            factors.push(signed(reader)?);
        } else if reader.mark('/').is_some() {
            divisors.push(signed(reader)?);
        } else {
            break;
        }
    }
    let product = balanced(factors, Node::Mul);
    if divisors.is_empty() {
        return Ok(product);
    }
    let divisor = balanced(divisors, Node::Mul);
    let place = join(product.place, divisor.place);
    Ok(Expr { node: Node::Div(Box::new(product), Box::new(divisor)), place })
}

/// `-a`, any number of signs.
fn signed(reader: &mut Reader<'_, '_>) -> Read {
    let mut first_sign = None;
    let mut is_negative = false;
    while let Some(minus) = reader.mark('-') {
        first_sign.get_or_insert(minus);
        is_negative = !is_negative;
    }
    let amount = power(reader)?;
    Ok(match first_sign {
        Some(minus) if is_negative => negated(minus, amount),
        _ => amount,
    })
}

fn power(reader: &mut Reader<'_, '_>) -> Read {
    let base = atom(reader)?;
    if reader.mark('^').is_none() {
        return Ok(base);
    }
    let is_negative = reader.mark('-').is_some();
    let place = reader.here();
    let written = reader.literal().map(|literal| literal.to_string()).unwrap_or_default();
    let exponent = written.parse::<i32>().ok().filter(|exponent| *exponent <= MAX_POWER);
    let Some(exponent) = exponent else {
        return Err(Mistake::new(
            place,
            format!("a power must be a whole number from -{MAX_POWER} to {MAX_POWER}"),
        )
        .with_help("write `a^2`, or a product"));
    };
    let exponent = if is_negative { -exponent } else { exponent };
    let place = join(base.place, place);
    Ok(Expr { node: Node::Pow(Box::new(base), exponent), place })
}

fn atom(reader: &mut Reader<'_, '_>) -> Read {
    if let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) {
        let amount = reader.inside(inside, parentheses.close, enclosed)?;
        return Ok(Expr { node: amount.node, place: join(parentheses.open, parentheses.close) });
    }
    if let Some(name) = reader.word() {
        let place = name.span();
        let name = name.to_string();
        if let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) {
            if name == RAMP {
                let parts = reader.inside(inside, parentheses.close, ramp_parts)?;
                return Ok(Expr { node: Node::Ramp(Box::new(parts)), place: join(place, parentheses.close) });
            }
            let argument = reader.inside(inside, parentheses.close, enclosed)?;
            let function = function(reader, &name, place)?;
            let place = join(place, parentheses.close);
            return Ok(Expr { node: Node::Call(function, Box::new(argument)), place });
        }
        let node = if name == "pi" { Node::Pi } else { Node::Symbol(name) };
        return Ok(Expr { node, place });
    }
    match reader.literal() {
        Some(literal) => {
            let number = number::read(&literal)?;
            measured(reader, number)
        }
        None if reader.mark('+').is_some() => {
            Err(Mistake::new(reader.last, "a `+` without a term before it").with_help("leave the `+` out"))
        }
        None => {
            Err(reader.expected("an amount").with_help("write a number, a name, `pi`, or `sin(…)` and so on"))
        }
    }
}

/// A number with the unit that follows it, if one does.
fn measured(reader: &mut Reader<'_, '_>, number: Amount) -> Read {
    let (Some(word), Node::Number(value)) = (reader.peek_word(), &number.node) else { return Ok(number) };
    let text = word.to_string();
    let refused = |why: String| {
        Mistake::new(word.span(), why)
            .with_help(format!("write a unit of an angle or a length, or `*{text}` for a product"))
    };
    match Unit::read(&text, None) {
        Ok(unit) if matches!(unit.measures(), Measures::Angle | Measures::Length) => {
            let node = Node::Measured(value.clone(), unit);
            reader.word();
            Ok(Expr { node, place: join(number.place, reader.last) })
        }
        Ok(unit) => Err(refused(format!("`{text}` measures {}", unit.measures().noun()))),
        Err(error @ UnitError::TwoMeanings { .. }) => Err(refused(error.to_string())),
        // Whoever reads on misses the mark between them.
        Err(_) => Ok(number),
    }
}

/// The variable and the thresholds of a ramp.
fn ramp_parts(reader: &mut Reader<'_, '_>) -> Result<[Amount; 3], Mistake<Span>> {
    let of = sum(reader)?;
    reader.expect_mark(',', RAMP_HELP)?;
    let from = sum(reader)?;
    reader.expect_mark(',', RAMP_HELP)?;
    let to = sum(reader)?;
    if reader.is_at_end() {
        return Ok([of, from, to]);
    }
    Err(reader.expected("`)`").with_help(RAMP_HELP))
}

/// What stands in parentheses, up to their end.
fn enclosed(reader: &mut Reader<'_, '_>) -> Read {
    let amount = sum(reader)?;
    if reader.is_at_end() {
        return Ok(amount);
    }
    Err(reader.expected("`)`").with_help("write `*` between factors, `+` or `-` between terms"))
}

fn function(reader: &mut Reader<'_, '_>, name: &str, place: Span) -> Result<Function, Mistake<Span>> {
    if let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) {
        return Ok(*function);
    }
    let known = FUNCTIONS.iter().map(|(known, _)| *known).chain([RAMP]);
    let help = match nearest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => {
            "write one of sin, cos, tan, cot, sec, csc, ramp, or `*` before the parenthesis for a product"
                .to_owned()
        }
    };
    // The rest of the amount can still be read.
    reader.mistakes.push(Mistake::new(place, format!("unknown function `{name}`")).with_help(help));
    Ok(Function::Sin)
}

fn negated(minus: Span, amount: Amount) -> Amount {
    let place = join(minus, amount.place);
    Expr { node: Node::Neg(Box::new(amount)), place }
}

/// A tree of logarithmic depth over the parts, in their order; there is at least one.
fn balanced(mut parts: Vec<Amount>, combine: fn(Box<Amount>, Box<Amount>) -> Node<Span>) -> Amount {
    while parts.len() > 1 {
        let mut halves = Vec::with_capacity(parts.len().div_ceil(2));
        let mut rest = parts.into_iter();
        while let Some(first) = rest.next() {
            halves.push(match rest.next() {
                Some(second) => {
                    let place = join(first.place, second.place);
                    Expr { node: combine(Box::new(first), Box::new(second)), place }
                }
                None => first,
            });
        }
        parts = halves;
    }
    parts.remove(0)
}
