//! The first-order form as a table: a column for each error, in named common parts.
//!
//! With R the rotation from the frame where an error acts to the first frame that moves or errs, and p the way from there to
//! what is observed, a small turn about an axis u adds R (u × p), and a shift along u adds R u. Entries of R and p that are
//! longer than one product get a name, and are defined by those of the frame before, or behind.

use super::{FormError, error_table};
use crate::algebra::{AngleSum, Poly};
use crate::chain::{Chain, ObservableId, ObservableKind, Passed, TransformKind};
use crate::symbol::{Quantity, Symbol, SymbolId, SymbolKind};

type Vector = [Poly; 3];

/// Columns in named common parts.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Of which observable.
    pub observable: ObservableId,
    /// The chain with the named parts as symbols.
    pub chain: Chain,
    /// The constant rotation from the frame of the columns to the one that the observable is seen in, row by row; `None` if
    /// these are the same.
    pub placement: Option<[Vector; 3]>,
    /// The named parts, each made of those before it and of the chain's own symbols.
    pub parts: Vec<(SymbolId, Poly)>,
    /// For every frame that errors act in: its number, and the transforms that lead to it, by the bodies' names.
    pub frames: Vec<(usize, String)>,
    /// For every error that acts on the way, what a unit of it adds in each direction.
    pub columns: Vec<(SymbolId, Vector)>,
}

/// Why there is no table.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TableError {
    /// It shows single readings.
    #[error(
        "tables and steps are of the three components of a vector, and `{0}` shows readings: derive it without them"
    )]
    Readings(String),
    /// A rotation is by no sum of angles.
    #[error(transparent)]
    Form(#[from] FormError),
    /// The names would be too many.
    #[error("a table of this chain would name more parts than a chain can have symbols")]
    TooMany,
}

/// Where an error acts.
struct Use {
    error: SymbolId,
    coefficient: Poly,
    kind: TransformKind,
    axis: usize,
    /// The rotation to the first frame.
    rotation: [Vector; 3],
    /// The place of the factor on the way.
    place: usize,
    frame: usize,
}

/// The table of an observable. Entries that are short, as whoever prints it says, get no name.
///
/// # Errors
/// See [`TableError`].
pub fn table(chain: &Chain, id: ObservableId, is_short: fn(&Poly) -> bool) -> Result<Table, TableError> {
    let observable = chain.observable(id);
    if !observable.is_vector() && !observable.is_orientation() {
        return Err(TableError::Readings(observable.name.clone()));
    }
    let is_error = error_table(chain);
    let is_error = |symbol: SymbolId| is_error[symbol.index()];
    let mut builder = Builder { table: Table::empty(chain, id), letters: letters(chain), is_short };
    let way = chain.way(id);
    let is_fixed = |passed: &&Passed| {
        let symbols = passed.factor.amount.symbols();
        symbols.iter().all(|id| matches!(chain.symbol(*id).kind, SymbolKind::Pi | SymbolKind::Constant))
    };
    let fixed = way.iter().take_while(is_fixed).count();
    let mut rotation = identity();
    for passed in &way[..fixed] {
        turn_columns(&mut rotation, passed, &passed.factor.amount)?;
    }
    builder.table.placement = (rotation != identity()).then_some(rotation);
    let uses = uses(chain, &way[fixed..], is_error, &mut builder)?;
    // From the device back to the ground: the way from each place to what is observed.
    let mut lever = observable.components.each_ref().map(|part| part.graded_part(is_error, 0));
    let mut columns: Vec<(SymbolId, Vector)> = Vec::new();
    let mut add =
        |error: SymbolId, column: Vector| match columns.iter_mut().find(|(known, _)| *known == error) {
            Some((_, sum)) => {
                for (sum, part) in sum.iter_mut().zip(&column) {
                    *sum = &*sum + part;
                }
            }
            None => columns.push((error, column)),
        };
    let mut named = None;
    let mut left = uses.iter().rev().peekable();
    let is_point = observable.kind == ObservableKind::Point;
    for (place, passed) in way[fixed..].iter().enumerate().rev() {
        let factor = &passed.factor;
        while let Some(one) = left.next_if(|one| one.place == place) {
            let axis: Vector =
                std::array::from_fn(|i| if i == one.axis { Poly::one() } else { Poly::zero() });
            let moved = match one.kind {
                TransformKind::Translation => axis,
                TransformKind::Rotation if observable.is_orientation() => axis,
                TransformKind::Rotation => {
                    if named != Some(one.frame) {
                        builder.name_lever(&mut lever, one.frame)?;
                        named = Some(one.frame);
                    }
                    cross(&axis, &lever)
                }
            };
            let column = applied(&one.rotation, &moved);
            add(one.error, column.map(|part| &part * &one.coefficient));
        }
        let nominal = factor.amount.graded_part(is_error, 0);
        match factor.kind {
            TransformKind::Rotation => {
                let angle = angle(chain, passed, &nominal)?;
                if !angle.is_zero() {
                    let (cosine, sine) = angle.cos_sin();
                    super::graded::rotate(&mut lever, factor.axis, &cosine, &sine);
                }
            }
            TransformKind::Translation if is_point => {
                let part = &mut lever[factor.axis.index()];
                *part = &*part + &nominal;
            }
            TransformKind::Translation => {}
        }
    }
    columns.sort_by_key(|(error, _)| *error);
    builder.table.columns = columns;
    Ok(builder.table)
}

/// The errors on the way, from the ground, each with the rotation to the first frame.
fn uses(
    chain: &Chain,
    way: &[Passed<'_>],
    is_error: impl Fn(SymbolId) -> bool + Copy,
    builder: &mut Builder,
) -> Result<Vec<Use>, TableError> {
    let is_point = chain.observable(builder.table.observable).kind == ObservableKind::Point;
    let mut rotation = identity();
    let (mut frame, mut is_new, mut passed_by) = (0, false, Vec::<String>::new());
    let mut uses = Vec::new();
    for (place, passed) in way.iter().enumerate() {
        let factor = &passed.factor;
        let nominal = factor.amount.graded_part(is_error, 0);
        if factor.kind == TransformKind::Rotation && !nominal.is_zero() {
            turn_columns(&mut rotation, passed, &nominal)?;
            is_new = true;
            let name = &chain.body(passed.body).name;
            if passed_by.last() != Some(name) {
                passed_by.push(name.clone());
            }
        }
        if factor.kind == TransformKind::Translation && !is_point {
            continue;
        }
        let linear = factor.amount.graded_part(is_error, 1).collect_by(is_error);
        for (monomial, coefficient) in linear {
            let [(error, 1)] = monomial.as_slice() else { continue };
            if is_new {
                frame += 1;
                builder.table.frames.push((frame, passed_by.join(" ")));
                builder.name_rotation(&mut rotation, frame)?;
                is_new = false;
            }
            uses.push(Use {
                error: *error,
                coefficient,
                kind: factor.kind,
                axis: factor.axis.index(),
                rotation: rotation.clone(),
                place,
                frame,
            });
        }
    }
    Ok(uses)
}

/// Gives names to parts.
struct Builder {
    table: Table,
    /// Of rotations and of levers.
    letters: [String; 2],
    is_short: fn(&Poly) -> bool,
}

impl Builder {
    fn name_rotation(&mut self, rotation: &mut [Vector; 3], frame: usize) -> Result<(), TableError> {
        let letter = self.letters[0].clone();
        for (row, entries) in rotation.iter_mut().enumerate() {
            for (column, entry) in entries.iter_mut().enumerate() {
                let (row, column) = (row + 1, column + 1);
                let (name, latex) = (
                    format!("{letter}{frame}_{row}{column}"),
                    format!("{letter}_{{{row}{column}}}^{{({frame})}}"),
                );
                self.name(entry, (name, latex), Quantity::Number)?;
            }
        }
        Ok(())
    }

    fn name_lever(&mut self, lever: &mut Vector, frame: usize) -> Result<(), TableError> {
        let letter = self.letters[1].clone();
        for (axis, entry) in ["x", "y", "z"].into_iter().zip(lever) {
            let (name, latex) =
                (format!("{letter}{frame}_{axis}"), format!("{letter}_{{{axis}}}^{{({frame})}}"));
            self.name(entry, (name, latex), Quantity::Length)?;
        }
        Ok(())
    }

    /// Puts a name in place of an entry, unless it is short.
    fn name(
        &mut self,
        entry: &mut Poly,
        (name, latex): (String, String),
        quantity: Quantity,
    ) -> Result<(), TableError> {
        if (self.is_short)(entry) {
            return Ok(());
        }
        let symbols = &mut self.table.chain.symbols;
        let id = u16::try_from(symbols.len()).map(SymbolId).map_err(|_| TableError::TooMany)?;
        symbols.push(Symbol {
            name,
            latex,
            kind: SymbolKind::Constant,
            quantity,
            meaning: None,
            of: None,
            documentation: String::new(),
            value: None,
        });
        self.table.parts.push((id, std::mem::replace(entry, Poly::symbol(id))));
        Ok(())
    }
}

impl Table {
    fn empty(chain: &Chain, observable: ObservableId) -> Self {
        Self {
            observable,
            chain: chain.clone(),
            placement: None,
            parts: Vec::new(),
            frames: Vec::new(),
            columns: Vec::new(),
        }
    }
}

/// A letter for rotations and one for levers that no name of the chain begins with.
fn letters(chain: &Chain) -> [String; 2] {
    let free = |letters: [&str; 3]| {
        let is_free = |letter: &&str| {
            chain
                .symbols
                .iter()
                .all(|symbol| !symbol.name.starts_with(*letter) && !symbol.latex.starts_with(*letter))
        };
        letters.into_iter().find(is_free).unwrap_or(letters[2]).to_owned()
    };
    [free(["r", "R", "\\rho"]), free(["p", "P", "\\ell"])].map(|letter| letter.replace('\\', ""))
}

fn angle(chain: &Chain, passed: &Passed<'_>, nominal: &Poly) -> Result<AngleSum, FormError> {
    AngleSum::from_poly(nominal)
        .map_err(|error| FormError::new(&chain.body(passed.body).name, passed.factor.axis, error))
}

fn identity() -> [Vector; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { Poly::one() } else { Poly::zero() }))
}

/// A matrix times a nominal rotation; shifts leave it alone.
fn turn_columns(rotation: &mut [Vector; 3], passed: &Passed<'_>, nominal: &Poly) -> Result<(), FormError> {
    let factor = &passed.factor;
    if factor.kind == TransformKind::Translation {
        return Ok(());
    }
    let angle = AngleSum::from_poly(nominal).map_err(|error| FormError::new("", factor.axis, error))?;
    let (cosine, sine) = angle.cos_sin();
    for row in rotation {
        // A row times R is the transpose of R, which turns the other way, times the row.
        super::graded::rotate(row, factor.axis, &cosine, &-&sine);
    }
    Ok(())
}

fn applied(rotation: &[Vector; 3], vector: &Vector) -> Vector {
    rotation
        .each_ref()
        .map(|row| row.iter().zip(vector).fold(Poly::zero(), |sum, (entry, part)| &sum + &(entry * part)))
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        &(&a[j] * &b[k]) - &(&a[k] * &b[j])
    })
}
