//! A printed vector as the checker holds it: texts, expressions with places, canonical forms.

use std::ops::Range;

use super::algebraic;
use super::lowering::{self, Sines};
use super::order::Order;
use super::series;
use super::written::{Read, TextPlace, Written, component, expressions, in_text};
use crate::latex::{self, NameOf, Notes, PrintedSymbols};
use model_core::algebra::{AlgebraError, Fraction, Poly, Rational};
use model_core::chain::reading::{Measures, Reading};
use model_core::chain::{Axis, Chain, Observable};
use model_core::expr::{Expr, Node};
use model_core::mistake::Mistake;
use model_core::symbol::SymbolId;

/// An expression as it is printed, each part with its place.
type Printed = Expr<Range<usize>>;

/// The three components of a printed formula.
#[derive(Debug, Clone)]
pub struct PrintedVector {
    /// x, y and z.
    pub components: [PrintedComponent; 3],
    /// Angles of which halves are printed, each with the symbol of its half; everything is said in halves of these.
    pub(super) halves: Vec<(SymbolId, SymbolId)>,
    /// Whether roots of numbers are printed: then constants that are multiples of 15° are the numbers that they are.
    pub(super) has_roots: bool,
    /// Whether terms of higher order than the claim's were dropped: a product of matrices that nobody multiplied out, or a print
    /// that says so itself.
    pub truncated: bool,
    /// Whether rotations about named axes were read as the table of symbols says.
    pub turned: bool,
    /// Whether two roots are compared by what stands below them.
    pub(super) of_squares: bool,
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

impl PrintedVector {
    /// Whether everything is in the names of the chain alone, without quotients, and nothing was dropped.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let Self { components, halves, has_roots, truncated, turned, of_squares } = self;
        halves.is_empty()
            && !has_roots
            && !truncated
            && !turned
            && !of_squares
            && components.iter().all(|component| component.value.is_whole())
    }

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
        let symbols = symbols.reading(texts);
        let names = [0, 1, 2].map(NameOf::Component);
        Self::read_with(chain, expressions(&symbols, &names, texts)?, &names, texts, Order::UpTo(1))
    }

    /// The same for what an observable shows: as many formulas as it shows numbers. In an exact form sines and cosines of
    /// errors stand. How a body is turned may be printed as a quaternion, 1 and half of the rotation vector.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read_shown(
        chain: &Chain,
        symbols: &PrintedSymbols,
        observable: &Observable,
        texts: &[&str],
        order: Order,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let symbols = symbols.reading(texts);
        let names: Vec<NameOf> = observable.shown.iter().map(name_of).collect();
        let mut written = expressions(&symbols, &names, texts)?;
        if observable.is_orientation() && order == Order::UpTo(1) {
            written.components = of_quaternion(written.components);
        }
        Self::read_with(chain, written, &names, texts, order)
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
        order: Order,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let symbols = symbols.reading(&[text]);
        let name_of = observable.shown.get(place.index()).map_or(NameOf::Formula, name_of);
        let written = component(&symbols, 0, text, name_of)?;
        let (_, expression) = &written.components[0];
        let value =
            valued(chain, expression, written.notes, order).map_err(|mistake| vec![in_text(0, mistake)])?;
        let mut read = Self::of_one(chain, expression, value)
            .map_err(|error| vec![in_text(0, Mistake::new(0..text.len(), error.to_string()))])?;
        read.components.swap(0, place.index());
        Ok(read.noting(written.notes))
    }

    /// The formulas of texts, each in a text of its own, or all in one; `names` is what each may be the name of.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn texts(
        symbols: &PrintedSymbols,
        names: &[NameOf],
        texts: &[&str],
    ) -> Result<(Vec<Printed>, Notes), Vec<Mistake<TextPlace>>> {
        let read = expressions(symbols, names, texts)?;
        Ok((read.components.into_iter().map(|(_, expression)| expression).collect(), read.notes))
    }

    /// Reads two formulas that name no component, as x and y, so that both are said in the same terms.
    pub(super) fn read_pair(
        chain: &Chain,
        symbols: &PrintedSymbols,
        texts: [&str; 2],
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let symbols = symbols.reading(&texts);
        let mut notes = Notes::default();
        let mut components = Vec::with_capacity(3);
        let mut mistakes = Vec::new();
        // Roots are equal where what stands below them is.
        let below = texts.map(|text| latex::read_total(text, &symbols));
        let are_roots = below.iter().all(Result::is_ok)
            && texts.iter().any(|text| component(&symbols, 0, text, NameOf::Formula).is_err());
        for ((index, text), below) in texts.into_iter().enumerate().zip(below) {
            let read = match below {
                Ok(below) if are_roots => {
                    Ok(Read { components: vec![(index, below)], notes: Notes::default() })
                }
                _ => component(&symbols, index, text, NameOf::Formula),
            };
            let read = read.and_then(|written| {
                notes.join(&written.notes);
                let one = written.components.into_iter().next();
                let (text_index, expression) = one.unwrap_or_else(|| unreachable!("one formula was read"));
                match lowering::fraction(chain, &expression, Sines::Series) {
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
        Self::of_pair(chain, [first, second], are_roots, notes)
    }

    /// Two formulas as x and y.
    pub(super) fn of_pair(
        chain: &Chain,
        [first, second]: [PrintedComponent; 2],
        of_squares: bool,
        notes: Notes,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let whole = first.expression.place.clone();
        let zero = Expr { node: Node::Number(Rational::ZERO), place: whole.clone() };
        let nothing =
            PrintedComponent { text_index: 0, expression: zero, value: Fraction::whole(Poly::zero()) };
        Self { of_squares, ..Self::of_components([first, second, nothing]) }
            .noting(notes)
            .normalised(chain)
            .map_err(|error| vec![in_text(0, Mistake::new(whole, error.to_string()))])
    }

    fn read_with(
        chain: &Chain,
        Read { components: expressions, notes }: Read,
        names: &[NameOf],
        texts: &[&str],
        order: Order,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let end = texts.len().saturating_sub(1);
        let at_end = || TextPlace { text_index: end, bytes: 0..texts.get(end).map_or(0, |text| text.len()) };
        let count = expressions.len();
        let mut values = Vec::new();
        let mut mistakes = Vec::new();
        for (text_index, expression) in &expressions {
            match valued(chain, expression, notes, order) {
                Ok(value) => values.push(value),
                Err(mistake) => mistakes.push(in_text(*text_index, mistake)),
            }
        }
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let has_fourth = count == 4 && names.len() == 3;
        if count != names.len() && !has_fourth {
            let (wanted, help) = match names.len() {
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
        // A product with homogeneous matrices ends with the 1 of a point, whatever its other entries are.
        let is_point = |entry: &Expr<Range<usize>>| {
            texts.len() == 1 && matches!(&entry.node, Node::Number(number) if *number == Rational::ONE)
        };
        if has_fourth && values.pop().is_some_and(|fourth| !fourth.is_zero()) && !is_point(&expressions[3].1)
        {
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
        Self::of_components(components)
            .noting(notes)
            .normalised(chain)
            .map_err(|error| vec![Mistake::new(at_end(), error.to_string())])
    }

    fn of_components(components: [PrintedComponent; 3]) -> Self {
        Self {
            components,
            halves: Vec::new(),
            has_roots: false,
            truncated: false,
            turned: false,
            of_squares: false,
        }
    }

    pub(super) fn noting(self, notes: Notes) -> Self {
        Self { truncated: notes.truncates || notes.dropped.is_some(), turned: notes.turned, ..self }
    }

    /// Three formulas that were read from one text.
    pub(super) fn of_expressions(
        chain: &Chain,
        expressions: [Expr<Range<usize>>; 3],
        notes: Notes,
    ) -> Result<Self, Vec<Mistake<TextPlace>>> {
        let (mut components, mut mistakes) = (Vec::new(), Vec::new());
        let [x, y, z] = expressions.each_ref().map(|expression| expression.place.clone());
        let whole = x.start.min(y.start).min(z.start)..x.end.max(y.end).max(z.end);
        for expression in expressions {
            match valued(chain, &expression, notes, Order::UpTo(1)) {
                Ok(value) => components.push(PrintedComponent { text_index: 0, expression, value }),
                Err(mistake) => mistakes.push(in_text(0, mistake)),
            }
        }
        let Ok(components) = <[PrintedComponent; 3]>::try_from(components) else { return Err(mistakes) };
        Self::of_components(components)
            .noting(notes)
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
        Self::of_components([component(value), nothing(), nothing()]).normalised(chain)
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

/// What the name of a shown number is the name of.
fn name_of(shown: &Reading) -> NameOf {
    match shown.measures {
        Measures::Component(axis) => NameOf::Component(axis.index()),
        Measures::CrossElevation { .. } => NameOf::Sideways,
        _ => NameOf::Formula,
    }
}

/// What an expression says, as far as a claim of this order goes.
pub(super) fn valued(
    chain: &Chain,
    expression: &Expr<Range<usize>>,
    notes: Notes,
    order: Order,
) -> Result<Fraction, Mistake<Range<usize>>> {
    let refuse = |message: String, help: &str| {
        Err(Mistake::new(expression.place.clone(), message).with_help(help.to_owned()))
    };
    match (order, notes.dropped) {
        (Order::Exact, Some(_)) => {
            return refuse(
                "a print that drops terms is not exact".to_owned(),
                "leave out `order = \"exact\"`",
            );
        }
        (Order::UpTo(order), Some(dropped)) if order + 1 != dropped => {
            return refuse(
                format!("the print drops terms of order {dropped}, and the claim is of order {order}"),
                &format!("write `order = {}`", dropped.saturating_sub(1)),
            );
        }
        _ => {}
    }
    let Order::UpTo(order) = order else { return lowering::fraction(chain, expression, Sines::Errors) };
    if !notes.truncates && notes.dropped.is_none() {
        return lowering::fraction(chain, expression, Sines::Angles);
    }
    let value = lowering::fraction(chain, expression, Sines::Series)?;
    let value = series::truncated(chain, &value, order);
    value
        .map(|value| algebraic::reduced_fraction(value, chain))
        .map_err(|error| Mistake::new(expression.place.clone(), error.to_string()))
}

/// Of a quaternion of a small rotation, 1 and half of the rotation vector, that vector.
fn of_quaternion(components: Vec<Written>) -> Vec<Written> {
    let is_one =
        |(_, entry): &Written| matches!(&entry.node, Node::Number(number) if *number == Rational::ONE);
    let rest = match components.as_slice() {
        [first, rest @ ..] if rest.len() == 3 && is_one(first) => rest,
        [rest @ .., last] if rest.len() == 3 && is_one(last) => rest,
        _ => return components,
    };
    let doubled = |(index, entry): &Written| {
        let two = Expr { node: Node::Number(Rational::from(2)), place: entry.place.clone() };
        let place = entry.place.clone();
        (*index, Expr { node: Node::Mul(Box::new(two), Box::new(entry.clone())), place })
    };
    rest.iter().map(doubled).collect()
}
