//! Numbers for symbols at which linear equations determine what is asked for, by exact elimination.

use super::expanded::Expanded;
use super::witness::{Value, substitute};
use model_core::algebra::Rational;
use model_core::symbol::SymbolId;

/// Poses that are tried for one choice of the constants: 27 errors of six joints need 20 of them.
const POSES: usize = 120;
/// Choices of the constants that are tried.
const CHOICES: usize = 4;

/// A symbol with the values that may be put in.
pub(super) type Choices = (SymbolId, Vec<Value>);

/// Whether everything is defined at some values.
pub(super) type IsDefined<'a> = dyn Fn(&[(SymbolId, Value)]) -> bool + 'a;

/// A coordinate that observables show: what each unknown does to it.
pub(super) type Shown = Vec<Expanded>;

/// What is asked.
pub(super) struct Asked<'a> {
    /// What is shown.
    pub shown: &'a [Shown],
    /// Which of the unknowns have to be determined.
    pub wanted: &'a [usize],
    /// Symbols that stay as they are, each with what may be put in.
    pub constants: &'a [Choices],
    /// Symbols that vary, in the same way.
    pub joints: &'a [Choices],
    /// Whether everything is defined at these values.
    pub is_defined: &'a IsDefined<'a>,
}

/// Values of symbols.
pub(super) type Values = Vec<(SymbolId, Value)>;

/// An equation: at which pose, of which coordinate, and what each unknown is multiplied by.
pub(super) type Equation = (usize, usize, Vec<Rational>);

/// Equations that suffice.
pub(super) struct Minor {
    /// The values of the constants.
    pub constants: Values,
    /// The poses, each a value for every joint.
    pub poses: Vec<Values>,
    /// The equations.
    pub rows: Vec<Equation>,
}

/// Finds equations that determine what is wanted.
pub(super) fn find(asked: &Asked<'_>) -> Option<Minor> {
    (0..CHOICES).find_map(|choice| with_constants(asked, choice))
}

fn with_constants(asked: &Asked<'_>, choice: usize) -> Option<Minor> {
    // From the back: zeros and quarter turns, which come first, are special.
    let pick = |(at, (symbol, values)): (usize, &Choices)| {
        let place = (at + choice) % values.len().max(1);
        Some((*symbol, values.get(values.len().checked_sub(place + 1)?)?.clone()))
    };
    let constants: Values = asked.constants.iter().enumerate().map(pick).collect::<Option<_>>()?;
    let mut found = Minor { constants: constants.clone(), poses: Vec::new(), rows: Vec::new() };
    let mut reduced = Reduced::default();
    for pose in 0..POSES {
        let joints: Values = asked
            .joints
            .iter()
            .enumerate()
            .map(|(at, (symbol, values))| {
                Some((*symbol, values.get(spread(pose, at, values.len()))?.clone()))
            })
            .collect::<Option<_>>()?;
        let all = [constants.as_slice(), &joints].concat();
        if !(asked.is_defined)(&all) {
            continue;
        }
        let mut is_new = false;
        for (coordinate, shown) in asked.shown.iter().enumerate() {
            let Some(row) = row(shown, &all) else { continue };
            if reduced.add(&row) {
                is_new = true;
                found.rows.push((found.poses.len(), coordinate, row));
            }
        }
        if is_new {
            found.poses.push(joints);
        }
        if asked.wanted.iter().all(|unknown| reduced.determines(*unknown)) {
            return Some(found);
        }
    }
    None
}

/// Which of some values a joint has at a pose: every pair of values of two joints comes about.
fn spread(pose: usize, joint: usize, values: usize) -> usize {
    let mixed = (pose as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15).rotate_left(7 * (joint as u32 % 9))
        ^ (joint as u64 + 3).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
    let mixed = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 33;
    // First poses of simple numbers: quarter turns and small whole numbers.
    let most = if pose < POSES / 4 { values.min(4) } else { values };
    (mixed % most.max(1) as u64) as usize
}

/// What each unknown is multiplied by at these values; `None` where that is no rational number.
fn row(shown: &Shown, values: &[(SymbolId, Value)]) -> Option<Vec<Rational>> {
    let there = |formula: &Expanded| {
        let all = values.iter().try_fold(formula.clone(), |formula, (symbol, value)| {
            if formula.0.is_empty() { Some(formula) } else { substitute(&formula, *symbol, value) }
        });
        all?.as_constant()
    };
    shown.iter().map(there).collect()
}

/// Rows in reduced echelon form, each with the place of its one.
#[derive(Default)]
struct Reduced(Vec<(usize, Vec<Rational>)>);

impl Reduced {
    /// Adds a row; whether it says something new.
    fn add(&mut self, row: &[Rational]) -> bool {
        let mut row = row.to_vec();
        for (pivot, other) in &self.0 {
            take_away(&mut row, *pivot, other);
        }
        let Some(pivot) = row.iter().position(|entry| !entry.is_zero()) else { return false };
        let Some(inverse) = row[pivot].recip() else { return false };
        for entry in &mut row {
            *entry = &*entry * &inverse;
        }
        for (_, other) in &mut self.0 {
            take_away(other, pivot, &row);
        }
        self.0.push((pivot, row));
        true
    }

    /// Whether an unknown is zero where all rows are.
    fn determines(&self, unknown: usize) -> bool {
        let alone =
            |row: &[Rational]| row.iter().enumerate().all(|(at, entry)| at == unknown || entry.is_zero());
        self.0.iter().any(|(pivot, row)| *pivot == unknown && alone(row))
    }
}

/// The row less as much of another as makes its entry at the other's pivot zero.
fn take_away(row: &mut [Rational], pivot: usize, other: &[Rational]) {
    let factor = row[pivot].clone();
    if factor.is_zero() {
        return;
    }
    for (entry, other) in row.iter_mut().zip(other) {
        *entry = &*entry - &(&factor * other);
    }
}
