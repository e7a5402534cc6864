//! A printed vector as the checker holds it: texts, expressions with places, canonical forms.

use std::ops::Range;

use crate::algebra::{LowerError, Poly};
use crate::chain::Chain;
use crate::expr::Expr;
use crate::latex::{self, PrintedSymbols};
use crate::mistake::Mistake;
use crate::names;
use crate::symbol::SymbolKind;
use crate::syntax;

/// The three components of a printed formula.
#[derive(Debug, Clone)]
pub struct PrintedVector {
    /// x, y and z.
    pub components: [PrintedComponent; 3],
}

/// One component of a printed formula.
#[derive(Debug, Clone)]
pub struct PrintedComponent {
    /// Which of the texts that were read it stands in.
    pub text_index: usize,
    /// As written; places are byte ranges of that text.
    pub expression: Expr<Range<usize>>,
    /// What it says.
    pub value: Poly,
}

/// Where a printed vector cannot be read: in which text, and where in it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextPlace {
    /// Which of the texts.
    pub text_index: usize,
    /// Byte range in it.
    pub bytes: Range<usize>,
}

impl PrintedVector {
    /// Reads components, each a text, or a whole vector in one text. A fourth, homogeneous component has to be 0.
    ///
    /// LaTeX is told from the plain syntax of amounts by its backslashes, braces and Greek letters; a vector in one text
    /// is read as LaTeX.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(
        chain: &Chain,
        symbols: &PrintedSymbols,
        texts: &[&str],
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let expressions = expressions(symbols, texts)?;
        let end = texts.len().saturating_sub(1);
        let at_end = || TextPlace { text_index: end, bytes: 0..texts.get(end).map_or(0, |text| text.len()) };
        let count = expressions.len();
        let mut values = Vec::new();
        let mut mistakes = Vec::new();
        for (text_index, expression) in &expressions {
            match lower(chain, expression) {
                Ok(value) => values.push(value),
                Err(mistake) => mistakes.push(in_text(*text_index, mistake)),
            }
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        if !(3..=4).contains(&count) {
            let message = format!("{count} components, where a vector has three");
            return Err(vec![
                Mistake::new(at_end(), message)
                    .with_help("give x, y and z, and if you like the homogeneous 0 behind them"),
            ]);
        }
        if values.len() == 4 && values.pop().is_some_and(|fourth| !fourth.is_zero()) {
            let (text_index, fourth) = &expressions[3];
            let place = TextPlace { text_index: *text_index, bytes: fourth.place.clone() };
            return Err(vec![Mistake::new(place, "the fourth component of an error is always 0")]);
        }
        let components: Vec<PrintedComponent> = expressions
            .into_iter()
            .zip(values)
            .map(|((text_index, expression), value)| PrintedComponent { text_index, expression, value })
            .collect();
        match <[PrintedComponent; 3]>::try_from(components) {
            Ok(components) => Ok(Self { components }),
            Err(_) => Err(vec![Mistake::new(at_end(), "a vector has three components")]),
        }
    }
}

/// A component as written, and which of the texts it stands in.
type Written = (usize, Expr<Range<usize>>);

/// The components as written.
fn expressions(symbols: &PrintedSymbols, texts: &[&str]) -> Result<Vec<Written>, Vec<Mistake<TextPlace>>> {
    if let [text] = texts {
        let components = latex::read_vector(text, symbols).map_err(|mistake| vec![in_text(0, mistake)])?;
        return Ok(components.into_iter().map(|component| (0, component)).collect());
    }
    let mut expressions = Vec::new();
    let mut mistakes = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        if is_latex(text) {
            match latex::read_formula(text, symbols) {
                Ok(expression) => expressions.push((index, expression)),
                Err(mistake) => mistakes.push(in_text(index, mistake)),
            }
        } else {
            match syntax::parse_amount(text) {
                Ok(expression) => expressions.push((index, expression)),
                Err(found) => mistakes.extend(found.iter().map(|mistake| Mistake {
                    place: TextPlace { text_index: index, bytes: mistake.place.bytes.clone() },
                    message: mistake.message.clone(),
                    help: mistake.help.clone(),
                })),
            }
        }
    }
    if mistakes.is_empty() { Ok(expressions) } else { Err(mistakes) }
}

fn is_latex(text: &str) -> bool {
    text.chars().any(|c| matches!(c, '\\' | '{' | '}') || (c.is_alphabetic() && !c.is_ascii()))
}

fn in_text(text_index: usize, mistake: Mistake<Range<usize>>) -> Mistake<TextPlace> {
    Mistake {
        place: TextPlace { text_index, bytes: mistake.place },
        message: mistake.message,
        help: mistake.help,
    }
}

/// The canonical form of an expression over the symbols of a chain.
///
/// # Errors
/// A name that the chain does not have, with the nearest one, or what the algebra refuses.
pub fn lower(chain: &Chain, expression: &Expr<Range<usize>>) -> Result<Poly, Mistake<Range<usize>>> {
    chain.amount(expression).map_err(|error| {
        let mistake = Mistake::new(error.place().clone(), error.to_string());
        match &error {
            LowerError::UnknownSymbol { name, .. } => {
                match names::nearest(name, chain.symbols.iter().map(|symbol| symbol.name.as_str())) {
                    Some(near) => mistake.with_help(format!("did you mean `{near}`?")),
                    None => mistake,
                }
            }
            LowerError::SineOf { name, .. }
                if chain.find_symbol(name).is_some_and(|id| chain.symbol(id).kind == SymbolKind::Error) =>
            {
                mistake.with_help("in a form of order 1 the sine of an error is the error, its cosine 1")
            }
            _ => mistake,
        }
    })
}
