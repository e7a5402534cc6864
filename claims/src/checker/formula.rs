//! A printed vector as the checker holds it: texts, expressions with places, canonical forms.

use std::ops::Range;

use super::algebraic;
use super::lowering::{self, Sines};
use crate::latex::{self, PrintedSymbols};
use model_core::algebra::{AlgebraError, Fraction, Poly, Rational};
use model_core::chain::reading::Reading;
use model_core::chain::{Axis, Chain, Observable};
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolId;
use model_core::syntax;

/// The three components of a printed formula.
#[derive(Debug, Clone)]
pub struct PrintedVector {
    /// x, y and z.
    pub components: [PrintedComponent; 3],
    /// Angles of which halves are printed, each with the symbol of its half; everything is said in halves of these.
    pub(super) halves: Vec<(SymbolId, SymbolId)>,
    /// Whether roots of numbers are printed: then constants that are multiples of 15° are the numbers that they are.
    pub(super) has_roots: bool,
}

/// One component of a printed formula.
#[derive(Debug, Clone)]
pub struct PrintedComponent {
    /// Which of the texts that were read it stands in.
    pub text_index: usize,
    /// As written; places are byte ranges of that text.
    pub expression: Expr<Range<usize>>,
    /// What it says.
    pub value: Fraction,
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
    /// is read as LaTeX. Roots and half angles need the symbols of an [`extended`](super::extended) chain.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(
        chain: &Chain,
        symbols: &PrintedSymbols,
        texts: &[&str],
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        Self::read_with(chain, symbols, &[Some(0), Some(1), Some(2)], texts, Sines::OfAngles)
    }

    /// The same for what an observable shows: as many formulas as it shows numbers. In an exact form sines and cosines of
    /// errors stand.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read_shown(
        chain: &Chain,
        symbols: &PrintedSymbols,
        observable: &Observable,
        texts: &[&str],
        is_exact: bool,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let axes: Vec<Option<usize>> =
            observable.shown.iter().map(|reading| reading.component().map(Axis::index)).collect();
        Self::read_with(chain, symbols, &axes, texts, Sines::of_form(is_exact))
    }

    /// Reads the formula of one of the numbers that an observable shows; the others are not claimed.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read_one(
        chain: &Chain,
        symbols: &PrintedSymbols,
        text: &str,
        observable: &Observable,
        place: Axis,
        is_exact: bool,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let axis = observable.shown.get(place.index()).and_then(Reading::component);
        let written = written(symbols, 0, text, axis.map(Axis::index))?;
        let sines = Sines::of_form(is_exact);
        let value =
            lowering::fraction(chain, &written.1, sines).map_err(|mistake| vec![in_text(0, mistake)])?;
        let mut read = Self::of_one(chain, &written.1, value)
            .map_err(|error| vec![in_text(0, Mistake::new(0..text.len(), error.to_string()))])?;
        read.components.swap(0, place.index());
        Ok(read)
    }

    /// Reads two formulas that name no component, as x and y, so that both are said in the same terms.
    pub(super) fn read_pair(
        chain: &Chain,
        symbols: &PrintedSymbols,
        texts: [&str; 2],
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let mut components = Vec::with_capacity(3);
        let mut mistakes = Vec::new();
        for (index, text) in texts.into_iter().enumerate() {
            let read = written(symbols, index, text, None).and_then(|(text_index, expression)| {
                match lowering::fraction(chain, &expression, Sines::OfErrors) {
                    Ok(value) => Ok(PrintedComponent { text_index, expression, value }),
                    Err(mistake) => Err(vec![in_text(text_index, mistake)]),
                }
            });
            match read {
                Ok(component) => components.push(component),
                Err(found) => mistakes.extend(found),
            }
        }
        let Ok([first, second]) = <[PrintedComponent; 2]>::try_from(components) else {
            return Err(mistakes);
        };
        let whole = 0..texts[0].len();
        let zero = Expr { node: Node::Number(Rational::ZERO), place: whole.clone() };
        let nothing =
            PrintedComponent { text_index: 0, expression: zero, value: Fraction::whole(Poly::zero()) };
        Self { components: [first, second, nothing], halves: Vec::new(), has_roots: false }
            .normalised(chain)
            .map_err(|error| vec![in_text(0, Mistake::new(whole, error.to_string()))])
    }

    fn read_with(
        chain: &Chain,
        symbols: &PrintedSymbols,
        axes: &[Option<usize>],
        texts: &[&str],
        sines: Sines,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let expressions = expressions(symbols, axes, texts)?;
        let end = texts.len().saturating_sub(1);
        let at_end = || TextPlace { text_index: end, bytes: 0..texts.get(end).map_or(0, |text| text.len()) };
        let count = expressions.len();
        let mut values = Vec::new();
        let mut mistakes = Vec::new();
        for (text_index, expression) in &expressions {
            match lowering::fraction(chain, expression, sines) {
                Ok(value) => values.push(value),
                Err(mistake) => mistakes.push(in_text(*text_index, mistake)),
            }
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let has_fourth = count == 4 && axes.len() == 3;
        if count != axes.len() && !has_fourth {
            let (wanted, help) = match axes.len() {
                3 => (
                    "a vector has three".to_owned(),
                    "give x, y and z, and if you like the homogeneous 0 behind them",
                ),
                1 => ("the observable shows one number".to_owned(), "give one formula"),
                n => (format!("the observable shows {n} numbers"), "give one formula for each"),
            };
            let message = format!("{count} components, where {wanted}");
            return Err(vec![Mistake::new(at_end(), message).with_help(help)]);
        }
        if has_fourth && values.pop().is_some_and(|fourth| !fourth.is_zero()) {
            let (text_index, fourth) = &expressions[3];
            let place = TextPlace { text_index: *text_index, bytes: fourth.place.clone() };
            return Err(vec![Mistake::new(place, "the fourth component of an error is always 0")]);
        }
        let mut components: Vec<PrintedComponent> = expressions
            .into_iter()
            .zip(values)
            .map(|((text_index, expression), value)| PrintedComponent { text_index, expression, value })
            .collect();
        // Behind what is shown nothing is claimed.
        let nothing = components
            .first()
            .cloned()
            .map(|first| PrintedComponent { value: Fraction::whole(Poly::zero()), ..first });
        components.extend(std::iter::repeat_n(nothing, 3_usize.saturating_sub(count)).flatten());
        let Ok(components) = <[PrintedComponent; 3]>::try_from(components) else {
            return Err(vec![Mistake::new(at_end(), "a vector has three components")]);
        };
        Self { components, halves: Vec::new(), has_roots: false }
            .normalised(chain)
            .map_err(|error| vec![Mistake::new(at_end(), error.to_string())])
    }

    /// Three formulas that were read from one text.
    pub(super) fn of_expressions(
        chain: &Chain,
        expressions: [Expr<Range<usize>>; 3],
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let (mut components, mut mistakes) = (Vec::new(), Vec::new());
        let [x, y, z] = expressions.each_ref().map(|expression| expression.place.clone());
        let whole = x.start.min(y.start).min(z.start)..x.end.max(y.end).max(z.end);
        for expression in expressions {
            match lowering::fraction(chain, &expression, Sines::OfAngles) {
                Ok(value) => components.push(PrintedComponent { text_index: 0, expression, value }),
                Err(mistake) => mistakes.push(in_text(0, mistake)),
            }
        }
        let Ok(components) = <[PrintedComponent; 3]>::try_from(components) else { return Err(mistakes) };
        Self { components, halves: Vec::new(), has_roots: false }
            .normalised(chain)
            .map_err(|error| vec![in_text(0, Mistake::new(whole, error.to_string()))])
    }

    /// One amount as a vector, to be said in the same terms as the derived one.
    pub(super) fn of_one(
        chain: &Chain,
        expression: &Expr<Range<usize>>,
        value: Fraction,
    ) -> Result<Self, AlgebraError> {
        let component = |value| PrintedComponent { text_index: 0, expression: expression.clone(), value };
        let nothing = || component(Fraction::whole(Poly::zero()));
        Self { components: [component(value), nothing(), nothing()], halves: Vec::new(), has_roots: false }
            .normalised(chain)
    }

    /// Says everything in halves of the angles of which halves are printed.
    fn normalised(mut self, chain: &Chain) -> Result<Self, AlgebraError> {
        let parts =
            || self.components.iter().flat_map(|component| [&component.value.above, &component.value.below]);
        let mut halves: Vec<_> = parts().flat_map(|poly| algebraic::halved(chain, poly)).collect();
        halves.sort_unstable();
        halves.dedup();
        self.has_roots = parts().any(|poly| algebraic::has_roots(poly, chain));
        self.halves = halves;
        for component in 0..3 {
            let value = &self.components[component].value;
            let [above, below] = [&value.above, &value.below].map(|poly| {
                let poly = algebraic::in_halves(poly, &self.halves)?;
                Ok(if self.has_roots { algebraic::with_special_constants(&poly, chain) } else { poly })
            });
            let value = algebraic::reduced_fraction(Fraction { above: above?, below: below? }, chain);
            self.components[component].value = value;
        }
        Ok(self)
    }

    /// A derived amount in the same terms as the printed ones.
    pub(super) fn translate(&self, chain: &Chain, derived: &Poly) -> Result<Poly, AlgebraError> {
        let derived = algebraic::in_halves(derived, &self.halves)?;
        Ok(if self.has_roots {
            algebraic::reduced(&algebraic::with_special_constants(&derived, chain), chain)
        } else {
            derived
        })
    }
}

/// A component as written, and which of the texts it stands in.
type Written = (usize, Expr<Range<usize>>);

/// The components as written.
fn expressions(
    symbols: &PrintedSymbols,
    axes: &[Option<usize>],
    texts: &[&str],
) -> Result<Vec<Written>, Vec<Mistake<TextPlace>>> {
    if let ([text], [_, _, ..]) = (texts, axes) {
        let components = latex::read_vector(text, symbols).map_err(|mistake| vec![in_text(0, mistake)])?;
        return Ok(components.into_iter().map(|component| (0, component)).collect());
    }
    let mut expressions = Vec::new();
    let mut mistakes = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        // A fourth component stands behind z.
        match written(symbols, index, text, axes.get(index).copied().unwrap_or(Some(index))) {
            Ok(component) => expressions.push(component),
            Err(found) => mistakes.extend(found),
        }
    }
    if mistakes.is_empty() { Ok(expressions) } else { Err(mistakes) }
}

/// One component, in LaTeX or in the plain syntax.
fn written(
    symbols: &PrintedSymbols,
    text_index: usize,
    text: &str,
    axis: Option<usize>,
) -> Result<Written, Vec<Mistake<TextPlace>>> {
    let as_latex = || match axis {
        Some(axis) => latex::read_component(text, symbols, axis),
        None => latex::read_formula(text, symbols),
    };
    if is_latex(text) {
        return as_latex()
            .map(|expression| (text_index, expression))
            .map_err(|mistake| vec![in_text(text_index, mistake)]);
    }
    let (name_length, amount) = bare(text);
    let moved = |place: &Range<usize>| place.start + name_length..place.end + name_length;
    let plain = syntax::parse_amount(amount);
    // `-x_3` and `R x_2` are LaTeX too, where these are printed symbols.
    let is_plain = plain.is_ok() && words(amount).all(|word| symbols.declares(word) || !symbols.prints(word));
    if !is_plain
        && words(amount).next().is_some()
        && words(amount).all(|word| symbols.prints(word))
        && let Ok(expression) = as_latex()
    {
        return Ok((text_index, expression));
    }
    match plain {
        Ok(expression) => Ok((text_index, expression.map_place(&moved))),
        Err(found) => Err(found
            .iter()
            .map(|mistake| Mistake {
                place: TextPlace { text_index, bytes: moved(&mistake.place.bytes) },
                message: mistake.message.clone(),
                help: mistake.help.clone(),
            })
            .collect()),
    }
}

/// A plain amount without the name before `=` and the punctuation behind it, and where it begins.
fn bare(text: &str) -> (usize, &str) {
    let start = match text.split_once('=') {
        Some((name, rest)) if !rest.contains('=') && is_name(name.trim()) => name.len() + 1,
        _ => 0,
    };
    (start, text[start..].trim_end().trim_end_matches(['.', ',', ';']))
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Letters with digits and underscores behind them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()))
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
