//! Reading statements. A statement that cannot be read is reported and skipped, so that the ones behind it
//! are read all the same.

use proc_macro2::{Delimiter, Ident, Span, TokenTree};

use super::amount;
use super::declaration::{
    AxisTerm, BentTerm, BetweenTerm, BodyStatement, ConstantStatement, Declaration, GravityStatement,
    InputStatement, ObserveStatement, ReadingTerm, Statement, SymbolStatement,
};
use super::documentation::{documentation, string_value};
use super::factors::factor_group;
use super::image::{IMAGE, image};
use super::tokens::Reader;
use crate::algebra::Rational;
use crate::expr::{Expr, Node};
use crate::mistake::Mistake;
use crate::names::nearest;

/// The kind of observable that shows how a body is turned, and has no components.
pub const ORIENTATION: &str = "orientation";
/// The words that begin a statement of a chain.
const STATEMENT_WORDS: [&str; 6] = ["body", "const", "input", "symbol", "observe", "gravity"];

const CHAIN_HELP: &str = "write `chain Name { … }`";
const BODY_HELP: &str = "write `body name on ground { … }`, or the lower body's name in place of `ground`";
const CONSTANT_HELP: &str = "write `const name: length = 0.25;` or `const name: angle = pi/6;`";
const INPUT_HELP: &str =
    "write `input name;`, or say what it is: `input name: temperature;`, `input name: direction of joint;`";
const BETWEEN_HELP: &str =
    "write `input zenith: angle = between(sky, up);`, with the name of an observed direction for `sky`";
const BENT_HELP: &str = "write `observe sky: direction(0, 0, 1) of tube, bent up by refraction*tan(zenith);`";
const SYMBOL_HELP: &str = r#"write `symbol name = r"\delta_1";`"#;
const OBSERVE_HELP: &str =
    "write `observe name: direction(0, 0, 1) of body;` or `observe name: point(0, 0, 0) of body;`";
const READING_HELP: &str = "write `observe name: azimuth, elevation of direction(0, 0, 1) of body;`";
const AXES_HELP: &str = "write axes, as `azimuth(x, -y)` or `elevation(z)`";
const FRAME_HELP: &str =
    "write `in body`, or leave it out: what is observed is then seen in the ground frame";
const GRAVITY_HELP: &str = "write `gravity: (0, 0, -1);`";

type Read<T> = Result<T, Mistake<Span>>;

/// A whole declaration; `None` if not even its outline could be read.
pub fn declaration(reader: &mut Reader<'_, '_>) -> Option<Declaration> {
    let declaration = match outline(reader) {
        Ok(declaration) => Some(declaration),
        Err(mistake) => {
            reader.mistakes.push(mistake);
            None
        }
    };
    if declaration.is_some() && !reader.is_at_end() {
        let mistake = Mistake::new(reader.here(), format!("{} after the end of the chain", reader.found()))
            .with_help("write one chain in a file, or in one `chain!`");
        reader.mistakes.push(mistake);
    }
    declaration
}

fn outline(reader: &mut Reader<'_, '_>) -> Read<Declaration> {
    if reader.is_at_end() {
        return Err(Mistake::new(reader.here(), "no chain is declared here").with_help(CHAIN_HELP));
    }
    let documentation = documentation(reader)?;
    reader.keyword("chain", CHAIN_HELP)?;
    let name = reader.name("the name of the chain").map_err(|m| m.with_help(CHAIN_HELP))?;
    let Some((inside, braces)) = reader.group(Delimiter::Brace) else {
        return Err(reader.expected("`{`").with_help(CHAIN_HELP));
    };
    let statements = reader.inside(inside, braces.close, |reader| {
        let mut statements = Vec::new();
        while !reader.is_at_end() {
            match statement(reader) {
                Ok(statement) => statements.push(statement),
                Err(mistake) => {
                    reader.mistakes.push(mistake);
                    reader.skip_statement();
                }
            }
        }
        statements
    });
    Ok(Declaration { documentation, name, statements, braces })
}

fn statement(reader: &mut Reader<'_, '_>) -> Read<Statement> {
    let documentation = documentation(reader)?;
    let word = reader.peek_word().map(|word| word.to_string()).unwrap_or_default();
    match word.as_str() {
        "body" => body(reader, documentation).map(Statement::Body),
        "const" => constant(reader, documentation).map(Statement::Constant),
        "input" => input(reader, documentation).map(Statement::Input),
        "symbol" => symbol(reader, documentation).map(Statement::Symbol),
        "observe" => observe(reader, documentation).map(Statement::Observe),
        "gravity" => gravity(reader).map(Statement::Gravity),
        other => Err(reader.expected("a statement").with_help(match nearest(other, STATEMENT_WORDS) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "a statement begins with `body`, `const`, `input`, `symbol`, `observe` or `gravity`"
                .to_owned(),
        })),
    }
}

fn body(reader: &mut Reader<'_, '_>, documentation: String) -> Read<BodyStatement> {
    reader.keyword("body", BODY_HELP)?;
    let name = reader.name("the name of the body").map_err(|m| m.with_help(BODY_HELP))?;
    if let Err(mistake) = reader.keyword("on", BODY_HELP) {
        reader.mistakes.push(mistake);
    }
    let lower = reader.name("the name of the lower body").map_err(|m| m.with_help(BODY_HELP))?;
    let Some((inside, braces)) = reader.group(Delimiter::Brace) else {
        return Err(reader.expected("`{`").with_help(BODY_HELP));
    };
    let groups = reader.inside(inside, braces.close, |reader| {
        let mut groups = Vec::new();
        while !reader.is_at_end() {
            match factor_group(reader) {
                Ok(group) => groups.push(group),
                Err(mistake) => {
                    reader.mistakes.push(mistake);
                    reader.skip_statement();
                }
            }
        }
        groups
    });
    Ok(BodyStatement { documentation, name, lower, groups, braces })
}

fn constant(reader: &mut Reader<'_, '_>, documentation: String) -> Read<ConstantStatement> {
    reader.keyword("const", CONSTANT_HELP)?;
    let name = reader.name("the name of the constant").map_err(|m| m.with_help(CONSTANT_HELP))?;
    let mut constant = ConstantStatement { documentation, name, quantity: None, value: None, is_open: false };
    // The name is declared, whatever is wrong with the rest.
    match constant_value(reader, &mut constant) {
        Err(mistake) => {
            reader.mistakes.push(mistake);
            reader.skip_statement();
        }
        Ok(()) if constant.value.is_none() && !constant.is_open => reader.skip_statement(),
        Ok(()) => {
            reader.end_of_statement()?;
        }
    }
    Ok(constant)
}

fn constant_value(reader: &mut Reader<'_, '_>, constant: &mut ConstantStatement) -> Read<()> {
    constant.quantity = stated(reader, "`angle` or `length`", CONSTANT_HELP)?;
    if reader.is_mark(';') {
        constant.is_open = true;
        return Ok(());
    }
    reader.expect_mark('=', CONSTANT_HELP)?;
    constant.value = amount::part(reader);
    Ok(())
}

fn input(reader: &mut Reader<'_, '_>, documentation: String) -> Read<InputStatement> {
    reader.keyword("input", INPUT_HELP)?;
    let name = reader.name("the name of the input").map_err(|m| m.with_help(INPUT_HELP))?;
    let meaning = stated(reader, "`length`, `temperature` and so on", INPUT_HELP)?;
    let of = match reader.peek_word() {
        Some(word) if meaning.is_some() && word == "of" => {
            reader.keyword("of", INPUT_HELP)?;
            Some(reader.name("a joint or a length").map_err(|m| m.with_help(INPUT_HELP))?)
        }
        _ => None,
    };
    let between = if reader.mark('=').is_some() { Some(between(reader)?) } else { None };
    reader.end_of_statement()?;
    Ok(InputStatement { documentation, name, meaning, of, between })
}

/// `between(sky, up)`
fn between(reader: &mut Reader<'_, '_>) -> Read<BetweenTerm> {
    reader.keyword("between", BETWEEN_HELP)?;
    let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) else {
        return Err(reader.expected("`(`").with_help(BETWEEN_HELP));
    };
    let parts = reader.inside(inside, parentheses.close, |reader| {
        let sight = reader.name("the name of an observable")?;
        reader.expect_mark(',', BETWEEN_HELP)?;
        let up = reader.name("`up`")?;
        if reader.is_at_end() { Ok(BetweenTerm { sight, up }) } else { Err(reader.expected("`)`")) }
    });
    parts.map_err(|mistake: Mistake<Span>| mistake.with_help(BETWEEN_HELP))
}

/// `, bent up by refraction*tan(zenith)`
fn bent(reader: &mut Reader<'_, '_>) -> Read<Option<Box<BentTerm>>> {
    if reader.mark(',').is_none() {
        return Ok(None);
    }
    let keyword = reader.keyword("bent", BENT_HELP)?;
    reader.keyword("up", BENT_HELP)?;
    reader.keyword("by", BENT_HELP)?;
    Ok(Some(Box::new(BentTerm { keyword, amount: amount::part(reader) })))
}

/// What stands behind a colon, if there is one.
fn stated(reader: &mut Reader<'_, '_>, words: &str, help: &str) -> Read<Option<Ident>> {
    match reader.mark(':') {
        Some(_) => reader.name(words).map(Some).map_err(|m| m.with_help(help)),
        None => Ok(None),
    }
}

fn symbol(reader: &mut Reader<'_, '_>, documentation: String) -> Read<SymbolStatement> {
    reader.keyword("symbol", SYMBOL_HELP)?;
    let name = reader.name("a declared name").map_err(|m| m.with_help(SYMBOL_HELP))?;
    reader.expect_mark('=', SYMBOL_HELP)?;
    let text = reader.cursor.literal().and_then(|(literal, _)| string_value(&TokenTree::Literal(literal)));
    let Some(latex) = text else {
        return Err(reader.expected("the printed form in quotes").with_help(SYMBOL_HELP));
    };
    let place = reader.literal().map_or(reader.last, |literal| literal.span());
    if let Some(fault) = crate::escape::latex_formula(&latex) {
        let message = format!("the printed form has {fault}");
        reader
            .mistakes
            .push(Mistake::new(place, message).with_help("write a formula that can stand within others"));
    }
    reader.end_of_statement()?;
    Ok(SymbolStatement { documentation, name, latex })
}

fn observe(reader: &mut Reader<'_, '_>, documentation: String) -> Read<ObserveStatement> {
    reader.keyword("observe", OBSERVE_HELP)?;
    let name = reader.name("the name of the observable").map_err(|m| m.with_help(OBSERVE_HELP))?;
    reader.expect_mark(':', OBSERVE_HELP)?;
    let mut readings = Vec::new();
    if is_reading(reader) {
        readings.push(reading(reader)?);
        while reader.mark(',').is_some() {
            readings.push(reading(reader)?);
        }
        reader.keyword("of", READING_HELP)?;
    }
    let kind = reader
        .name("`direction`, `point`, `orientation` or `image`")
        .map_err(|m| m.with_help(OBSERVE_HELP))?;
    let mut seen = None;
    let components = if kind == IMAGE {
        let (components, term) = image(reader)?;
        seen = Some(Box::new(term));
        components
    } else if kind == ORIENTATION {
        // It has none; what stands for them is never looked at.
        let number = |value| Some(Expr { node: Node::Number(value), place: kind.span() });
        [number(Rational::ZERO), number(Rational::ZERO), number(Rational::ONE)]
    } else {
        components(reader, OBSERVE_HELP)?
    };
    reader.keyword("of", OBSERVE_HELP)?;
    let body = reader.name("the name of the body").map_err(|m| m.with_help(OBSERVE_HELP))?;
    let frame = match reader.peek_word() {
        Some(word) if word == "in" => {
            reader.word();
            Some(reader.name("the name of a body").map_err(|m| m.with_help(FRAME_HELP))?)
        }
        _ => None,
    };
    let bent = bent(reader)?;
    let last = reader.last;
    reader.end_of_statement()?;
    Ok(ObserveStatement {
        documentation,
        name,
        readings,
        kind,
        components,
        body,
        frame,
        image: seen,
        bent,
        last,
    })
}

/// Whether a reading stands here and not the vector itself: a word, perhaps with axes, before `,` or before `of` and a
/// vector.
fn is_reading(reader: &Reader<'_, '_>) -> bool {
    let Some((_, rest)) = reader.cursor.ident() else { return false };
    let group = rest.group(Delimiter::Parenthesis);
    let rest = group.map_or(rest, |(_, _, behind)| behind);
    if rest.punct().is_some_and(|(mark, _)| mark.as_char() == ',') {
        return true;
    }
    if reader.peek_word().is_some_and(|word| word == ORIENTATION) {
        return false;
    }
    let Some((_, behind_of)) = rest.ident().filter(|(word, _)| word == "of") else { return false };
    let is_vector = behind_of
        .ident()
        .is_some_and(|(kind, behind)| kind == ORIENTATION || behind.group(Delimiter::Parenthesis).is_some());
    group.is_none() || is_vector
}

fn reading(reader: &mut Reader<'_, '_>) -> Read<ReadingTerm> {
    let word = reader.name("what is read, as `azimuth`").map_err(|m| m.with_help(READING_HELP))?;
    let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) else {
        return Ok(ReadingTerm { word, axes: None });
    };
    let axes = reader.inside(inside, parentheses.close, |reader| {
        let mut axes = Vec::new();
        while !reader.is_at_end() {
            let is_negative = reader.mark('-').is_some();
            axes.push(AxisTerm { is_negative, axis: reader.name("an axis")? });
            if !reader.is_at_end() {
                reader.expect_mark(',', AXES_HELP)?;
            }
        }
        Ok(axes)
    });
    Ok(ReadingTerm { word, axes: Some(axes.map_err(|mistake: Mistake<Span>| mistake.with_help(AXES_HELP))?) })
}

fn gravity(reader: &mut Reader<'_, '_>) -> Read<GravityStatement> {
    let keyword = reader.keyword("gravity", GRAVITY_HELP)?;
    reader.expect_mark(':', GRAVITY_HELP)?;
    let components = components(reader, GRAVITY_HELP)?;
    reader.end_of_statement()?;
    Ok(GravityStatement { keyword, components })
}

/// Three amounts in parentheses.
fn components(reader: &mut Reader<'_, '_>, help: &str) -> Read<[Option<Expr<Span>>; 3]> {
    let Some((inside, parentheses)) = reader.group(Delimiter::Parenthesis) else {
        return Err(reader.expected("three components in parentheses").with_help(help));
    };
    let components = reader.inside(inside, parentheses.close, |reader| {
        let mut components = Vec::new();
        while !reader.is_at_end() {
            components.push(amount::part(reader));
            if components.last().is_some_and(Option::is_none) {
                amount::skip_to_comma(reader);
            }
            if !reader.is_at_end() && reader.mark(',').is_none() {
                let mistake = reader.expected("`,`").with_help(help);
                reader.mistakes.push(mistake);
                amount::skip_to_comma(reader);
                reader.mark(',');
            }
        }
        components
    });
    let count = components.len();
    <[_; 3]>::try_from(components).map_err(|_| {
        Mistake::new(parentheses.open, format!("three components are needed, and here are {count}"))
            .with_help(help)
    })
}
