//! Formulas of what is there, not of its error: where a point is, how a body stands, a Jacobian, an image point. Each entry is
//! compared with the one that the chain implies.

use super::formula::valued;
use super::written::in_text;
use super::{CheckError, Checker, Order, PrintedVector, TextPlace, algebraic, series};
use crate::latex::PrintedMatrix;
use model_core::algebra::{AlgebraError, Fraction, Poly, Rational};
use model_core::chain::reading::{COMPONENTS, Reading};
use model_core::chain::{Axis, BodyId, Chain, Observable, ObservableId, ObservableKind};
use model_core::forms;
use model_core::mistake::Mistake;
use model_core::symbol::{SymbolId, SymbolKind};

/// That entries have these formulas.
#[derive(Debug, Clone)]
pub struct Entries {
    /// Of what.
    pub of: EntriesOf,
    /// How many errors a product may have; none at order 0.
    pub order: Order,
    /// The errors that are not zero, in order.
    pub kept: Vec<SymbolId>,
    /// The one number of what is shown that is claimed, or the one row of a Jacobian; `None` where all are.
    pub only: Option<Axis>,
    /// What each entry is called.
    pub labels: Vec<String>,
    /// The formulas as printed, each as the first component.
    pub printed: Vec<PrintedVector>,
}

/// What a print gives the entries of.
#[derive(Debug, Clone)]
pub enum EntriesOf {
    /// The numbers that an observable shows, its errors included.
    Shown(ObservableId),
    /// The matrix of how a body stands in a frame: three rows and columns, or four with the place of its origin.
    Frame {
        /// The body.
        body: BodyId,
        /// The body in whose frame it is seen; `None` is the ground.
        frame: Option<BodyId>,
        /// Whether the place of the origin is printed, too.
        is_homogeneous: bool,
    },
    /// The derivatives of what observables show, a row for each number, by joints or errors, a column each.
    Jacobian {
        /// Of which observables.
        observables: Vec<ObservableId>,
        /// By which symbols.
        by: Vec<SymbolId>,
    },
    /// Where a camera shows a point.
    Image(Box<Camera>),
}

/// A pinhole camera that sees a point, given in the camera's frame.
#[derive(Debug, Clone)]
pub struct Camera {
    /// The point.
    pub point: ObservableId,
    /// The axes of u, of v and of sight.
    pub axes: [Axis; 3],
    /// The focal lengths of u and v.
    pub focal: [Poly; 2],
    /// The principal point.
    pub center: [Poly; 2],
    /// The factors of r², r⁴, … of radial distortion.
    pub radial: Vec<Poly>,
    /// Whether the claim is of what errors add.
    pub is_change: bool,
}

/// What is said of entries. The claim holds if none differs.
#[derive(Debug, Clone, PartialEq)]
pub struct EntriesVerdict {
    /// How many entries are claimed.
    pub entries: usize,
    /// The entries that differ.
    pub differences: Vec<EntryDifference>,
}

/// An entry that differs.
#[derive(Debug, Clone, PartialEq)]
pub struct EntryDifference {
    /// What it is called.
    pub label: String,
    /// As printed.
    pub printed: Fraction,
    /// As the chain implies it.
    pub derived: Fraction,
}

impl Entries {
    /// Says what printed entries mean, as far as the order goes.
    ///
    /// # Errors
    /// What cannot be read, with its place.
    pub fn read(
        chain: &Chain,
        matrix: PrintedMatrix,
        order: Order,
    ) -> Result<Vec<PrintedVector>, Vec<Mistake<TextPlace>>> {
        let (mut printed, mut mistakes) = (Vec::new(), Vec::new());
        for entry in matrix.entries {
            let read = valued(chain, &entry, matrix.notes, order).and_then(|value| {
                PrintedVector::of_one(chain, &entry, value)
                    .map_err(|error| Mistake::new(entry.place.clone(), error.to_string()))
            });
            match read {
                Ok(vector) => printed.push(vector.noting(matrix.notes)),
                Err(mistake) => mistakes.push(in_text(0, mistake)),
            }
        }
        if mistakes.is_empty() { Ok(printed) } else { Err(mistakes) }
    }
}

impl Checker<'_> {
    /// The verdict on entries.
    ///
    /// # Errors
    /// The chain has no closed form of them, or it has too many terms.
    pub fn entries(&self, claim: &Entries) -> Result<EntriesVerdict, CheckError> {
        let width = if let EntriesOf::Jacobian { by, .. } = &claim.of { by.len() } else { 1 };
        let derived = self.entries_of(claim)?.into_iter();
        let (skipped, taken) = match claim.only {
            Some(axis) => (axis.index() * width, width),
            None => (0, derived.len()),
        };
        let chain = self.chain;
        let mut differences = Vec::new();
        let claimed = claim.labels.iter().zip(&claim.printed);
        for ((label, printed), derived) in claimed.zip(derived.skip(skipped).take(taken)) {
            let derived = self.without_neglected(&derived, &claim.kept)?;
            let above = printed.translate(chain, &derived.above)?;
            let below = printed.translate(chain, &derived.below)?;
            let value = &printed.components[0].value;
            let difference = &value.above.checked_mul(&below)? - &above.checked_mul(&value.below)?;
            if algebraic::reduced(&difference, chain).is_zero() {
                continue;
            }
            let shown = |above: &Poly, below: &Poly| {
                let quotient =
                    Fraction::new(algebraic::in_wholes(above, chain), algebraic::in_wholes(below, chain));
                quotient.unwrap_or_else(|| unreachable!("no formula stands over zero"))
            };
            differences.push(EntryDifference {
                label: label.clone(),
                printed: shown(&value.above, &value.below),
                derived: shown(&above, &below),
            });
        }
        Ok(EntriesVerdict { entries: claim.printed.len(), differences })
    }

    fn without_neglected(&self, value: &Fraction, kept: &[SymbolId]) -> Result<Fraction, AlgebraError> {
        let is_error = |id: &SymbolId| self.chain.symbol(*id).kind == SymbolKind::Error;
        let neglected: Vec<SymbolId> = value
            .symbols()
            .into_iter()
            .filter(|id| is_error(id) && kept.binary_search(id).is_err())
            .collect();
        series::at_zero(value, &neglected)
    }

    fn entries_of(&self, claim: &Entries) -> Result<Vec<Fraction>, CheckError> {
        match &claim.of {
            EntriesOf::Shown(observable) => shown(self.chain, *observable, claim.order),
            EntriesOf::Frame { body, frame, is_homogeneous } => {
                let mut columns = frame_of(self.chain, *body, *frame, claim.order)?;
                if !is_homogeneous {
                    columns.pop();
                }
                let width = columns.len();
                let mut entries: Vec<Fraction> =
                    (0..3).flat_map(|row| columns.iter().map(move |column| column[row].clone())).collect();
                if *is_homogeneous {
                    entries.extend((0..width).map(|column| {
                        Fraction::whole(if column + 1 == width { Poly::one() } else { Poly::zero() })
                    }));
                }
                Ok(entries)
            }
            EntriesOf::Jacobian { observables, by } => {
                let mut rows = Vec::new();
                for &observable in observables {
                    rows.extend(self.jacobian(observable, by)?);
                }
                Ok(rows)
            }
            EntriesOf::Image(camera) => self.image(camera, claim.order),
        }
    }

    /// The derivatives of what an observable shows, row after row.
    fn jacobian(&self, observable: ObservableId, by: &[SymbolId]) -> Result<Vec<Fraction>, CheckError> {
        let chain = self.chain;
        let is_error = |id: SymbolId| chain.symbol(id).kind == SymbolKind::Error;
        let seen = chain.observable(observable);
        let mut columns = Vec::with_capacity(by.len());
        let form = forms::derive(chain, observable, 1)?;
        let errors: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
        for &symbol in by {
            let column: Vec<Fraction> = if is_error(symbol) {
                let derived = form
                    .components
                    .iter()
                    .map(|part| series::at_zero(&series::derivative(part, symbol)?, &errors));
                derived.collect::<Result<_, _>>()?
            } else if seen.is_orientation() {
                turning(chain, seen, symbol)?
            } else {
                let value = shown(chain, observable, Order::UpTo(0))?;
                value.iter().map(|part| series::derivative(part, symbol)).collect::<Result<_, _>>()?
            };
            columns.push(column);
        }
        let rows = seen.shown.len();
        Ok((0..rows).flat_map(|row| columns.iter().map(move |column| column[row].clone())).collect())
    }

    /// u and v.
    fn image(&self, camera: &Camera, order: Order) -> Result<Vec<Fraction>, CheckError> {
        let chain = self.chain;
        // The point is taken to the order before it is divided; what the quotient adds beyond is dropped behind.
        let point = shown(chain, camera.point, order)?;
        let [right, down, ahead] = camera.axes.map(|axis| point[axis.index()].clone());
        let ahead = ahead.inverse().ok_or(AlgebraError::NotDivisible)?;
        let flat = [right.product(&ahead)?, down.product(&ahead)?];
        let square = flat[0].product(&flat[0])?.sum(&flat[1].product(&flat[1])?)?;
        let mut stretch = Fraction::whole(Poly::one());
        let mut power = Fraction::whole(Poly::one());
        for factor in &camera.radial {
            power = power.product(&square)?;
            stretch = stretch.sum(&power.product(&Fraction::whole(factor.clone()))?)?;
        }
        let errors: Vec<SymbolId> = chain.symbols_of(SymbolKind::Error).collect();
        let mut image = Vec::with_capacity(2);
        for ((flat, focal), center) in flat.iter().zip(&camera.focal).zip(&camera.center) {
            let seen = flat.product(&stretch)?.product(&Fraction::whole(focal.clone()))?;
            let mut seen = seen.sum(&Fraction::whole(center.clone()))?;
            if let Order::UpTo(order) = order {
                seen = series::truncated(chain, &seen, order)?;
            }
            if camera.is_change {
                seen = seen.sum(&series::at_zero(&seen, &errors)?.negated())?;
            }
            image.push(seen);
        }
        Ok(image)
    }
}

/// What an observable shows of its vector, its errors included up to an order.
fn shown(chain: &Chain, observable: ObservableId, order: Order) -> Result<Vec<Fraction>, CheckError> {
    let added: Vec<Fraction> = match order {
        Order::UpTo(0) => vec![Fraction::whole(Poly::zero()); chain.observable(observable).shown.len()],
        Order::UpTo(order) => forms::derive(chain, observable, order)?.components,
        Order::Exact => forms::exact_symbolic(chain, observable)?.into_iter().map(Fraction::whole).collect(),
    };
    let nominal = forms::nominal(chain, observable)?;
    let readings = &chain.observable(observable).shown;
    let mut found = Vec::with_capacity(readings.len());
    for (reading, added) in readings.iter().zip(added) {
        let Some(axis) = reading.component() else {
            unreachable!("a claim of entries is read for components only")
        };
        found.push(Fraction::whole(nominal[axis.index()].clone()).sum(&added)?);
    }
    Ok(found)
}

/// The columns of the matrix of a frame: x, y and z, and the origin.
fn frame_of(
    chain: &Chain,
    body: BodyId,
    frame: Option<BodyId>,
    order: Order,
) -> Result<Vec<Vec<Fraction>>, CheckError> {
    let mut seen = chain.clone();
    let first = seen.observables.len();
    let vectors = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]];
    for (at, vector) in vectors.into_iter().enumerate() {
        seen.observables.push(Observable {
            name: format!("column {at}"),
            documentation: String::new(),
            kind: if at == 3 { ObservableKind::Point } else { ObservableKind::Direction },
            components: vector.map(|value| Poly::constant(Rational::from(value))),
            body,
            frame,
            shown: COMPONENTS.to_vec(),
            image: None,
            bend: None,
        });
    }
    (first..first + 4)
        .map(|at| {
            let id = u16::try_from(at).map(ObservableId);
            shown(&seen, id.unwrap_or(ObservableId(0)), order)
        })
        .collect()
}

/// How a body turns with a joint: the rotation vector of dR/dq Rᵀ.
fn turning(chain: &Chain, seen: &Observable, joint: SymbolId) -> Result<Vec<Fraction>, CheckError> {
    let columns = frame_of(chain, seen.body, seen.frame, Order::UpTo(0))?;
    let entry = |row: usize, column: usize| -> Result<Fraction, AlgebraError> {
        let mut sum = Fraction::whole(Poly::zero());
        for axis in &columns[..3] {
            let turned = series::derivative(&axis[row], joint)?;
            sum = sum.sum(&turned.product(&axis[column])?)?;
        }
        Ok(sum)
    };
    let vector = [entry(2, 1)?, entry(0, 2)?, entry(1, 0)?];
    let axes = seen.shown.iter().filter_map(Reading::rotation);
    Ok(axes.map(|axis| vector[axis.index()].clone()).collect())
}
