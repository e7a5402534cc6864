//! The first-order form: small rotations and translations between two motions of the design add up to one of each, and
//! what they do to the observable is carried down to the ground.
//!
//! A small turn ε acts as `ε × v`. It may be taken where it sits or carried up the chain first, through the
//! motions, to where `v` is simpler. Everything below the *meeting place* is carried up to it, everything above
//! is taken where it sits; [`super::build`] tries every meeting place and keeps the cheapest program.

use model_core::algebra::Poly;
use model_core::{Axis, Chain, ObservableKind, TransformKind};

use super::amount::{lower, turn};
use super::exact::components;
use super::path::{Path, is_error};
use super::vectors::{NOTHING, Turn, Vector, add, along, cross};
use crate::builder::{Builder, Value};

/// A motion of the design.
enum Move {
    Turn(Axis, Turn),
    Shift(Axis, Value),
}

/// The small rotations and translations between two motions of the design, by axis.
#[derive(Clone, Default)]
struct Level {
    rotations: [Poly; 3],
    translations: [Poly; 3],
}

/// The part of the error that is linear in the errors, with every small turn below the motion number `meeting`,
/// counted from the ground, carried up to there.
pub(super) fn error(b: &mut Builder, chain: &Chain, path: &Path, meeting: usize) -> Vector {
    let (levels, moves) = levels(b, chain, path);
    let mut rotations: Vec<Vector> = Vec::with_capacity(levels.len());
    let mut translations: Vec<Vector> = Vec::with_capacity(levels.len());
    for level in &levels {
        rotations.push(std::array::from_fn(|i| lower(b, &level.rotations[i])));
        translations.push(std::array::from_fn(|i| lower(b, &level.translations[i])));
    }
    for (below, motion) in moves.iter().enumerate().take(meeting) {
        let small = std::mem::replace(&mut rotations[below], NOTHING);
        let carried = match motion {
            Move::Turn(axis, turn) => turn.back().apply(b, *axis, &small),
            Move::Shift(axis, amount) => {
                if path.kind == ObservableKind::Point {
                    let lever = cross(b, &small, &along(*axis, *amount));
                    translations[below] = add(b, &translations[below], &lever);
                }
                small
            }
        };
        rotations[below + 1] = add(b, &rotations[below + 1], &carried);
    }

    let mut nominal = components(b, path);
    let mut difference = std::array::from_fn(|i| lower(b, &linear(chain, &path.components[i].error)));
    for at in (0..levels.len()).rev() {
        let turned = cross(b, &rotations[at], &nominal);
        difference = add(b, &difference, &turned);
        if path.kind == ObservableKind::Point {
            difference = add(b, &difference, &translations[at]);
        }
        match at.checked_sub(1).map(|motion| &moves[motion]) {
            Some(Move::Turn(axis, turn)) => {
                nominal = turn.apply(b, *axis, &nominal);
                difference = turn.apply(b, *axis, &difference);
            }
            Some(Move::Shift(axis, amount)) => nominal = add(b, &nominal, &along(*axis, *amount)),
            None => {}
        }
    }
    difference
}

/// The part of an amount that is linear in the errors.
pub(super) fn linear(chain: &Chain, amount: &Poly) -> Poly {
    amount.graded_part(|symbol| is_error(chain, symbol), 1)
}

/// How many motions of the design a path has.
pub(super) fn motions(path: &Path) -> usize {
    path.steps.iter().filter(|step| !step.amount.nominal.is_zero()).count()
}

/// The levels of small rotations and translations, one more than there are motions between them. What commutes with
/// the motion above it is put above it.
fn levels(b: &mut Builder, chain: &Chain, path: &Path) -> (Vec<Level>, Vec<Move>) {
    let mut levels = Vec::new();
    let mut moves = Vec::new();
    let mut level = Level::default();
    for step in &path.steps {
        if !step.amount.nominal.is_zero() {
            let above = commuting(&mut level, step.kind, step.axis);
            levels.push(std::mem::replace(&mut level, above));
            moves.push(match step.kind {
                TransformKind::Rotation => Move::Turn(step.axis, turn(b, &step.amount.nominal)),
                TransformKind::Translation => Move::Shift(step.axis, lower(b, &step.amount.nominal)),
            });
        }
        let sums = match step.kind {
            TransformKind::Rotation => &mut level.rotations,
            TransformKind::Translation => &mut level.translations,
        };
        sums[step.axis.index()] = &sums[step.axis.index()] + &linear(chain, &step.amount.error);
    }
    levels.push(level);
    (levels, moves)
}

/// Takes out of a level what commutes with the motion above it.
fn commuting(level: &mut Level, kind: TransformKind, axis: Axis) -> Level {
    let mut above = Level::default();
    let i = axis.index();
    above.rotations[i] = std::mem::take(&mut level.rotations[i]);
    match kind {
        TransformKind::Rotation => above.translations[i] = std::mem::take(&mut level.translations[i]),
        TransformKind::Translation => above.translations = std::mem::take(&mut level.translations),
    }
    above
}
