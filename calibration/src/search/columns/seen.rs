//! Which effects the rows let one use: what parts of the rows show of it, added up.

use faer::Mat;
use model_core::TransformKind;

use super::UNSEEN;
use effects::candidate::{Effect, Place};

/// Values of a function more than this many times its RMS make the column hang on a single observation.
const TOO_STEEP: f64 = 1e3;

/// Functions of joints alone that stay this small are not what an instrument shows: gravity seen across a base that is
/// all but level.
const TOO_FLAT: f64 = 1e-2;

/// What a part of the rows shows of probes and functions.
#[derive(Debug, Clone)]
pub struct Seen {
    places: Vec<Place>,
    /// Sum of squares of each probe's column.
    squares: Vec<f64>,
    /// Of each effect, its functions' extents.
    pub(super) effects: Vec<Vec<Extent>>,
}

/// How large a function gets.
#[derive(Debug, Clone)]
pub(super) struct Extent {
    /// Whether it hangs on joints alone.
    pub of_joints: bool,
    /// Whether it has a finite value in every row.
    finite: bool,
    rows: usize,
    squares: f64,
    largest: f64,
}

impl Extent {
    /// Of the values of a function, zero put in place of those that are not finite; `None` if a reading is missing.
    pub fn of(values: Option<&mut [f64]>, of_joints: bool) -> Self {
        let mut extent = Self { of_joints, finite: values.is_some(), rows: 0, squares: 0.0, largest: 0.0 };
        for value in values.unwrap_or_default() {
            if !value.is_finite() {
                extent.finite = false;
                *value = 0.0;
            }
            extent.rows += 1;
            extent.squares += *value * *value;
            extent.largest = extent.largest.max(value.abs());
        }
        extent
    }

    fn merge(&mut self, other: &Self) {
        self.finite &= other.finite;
        self.rows += other.rows;
        self.squares += other.squares;
        self.largest = self.largest.max(other.largest);
    }

    /// Whether it has a value everywhere, and is a function that an instrument shows.
    fn is_steady(&self) -> bool {
        let rms = (self.squares / self.rows as f64).sqrt();
        let flat = self.of_joints && rms < TOO_FLAT;
        self.finite && !flat && self.largest <= TOO_STEEP * rms
    }
}

impl Seen {
    pub(super) fn of_probes(places: &[Place], probes: &Mat<f64>) -> Self {
        let squares = probes.col_iter().map(|probe| probe.squared_norm_l2()).collect();
        Self { places: places.to_vec(), squares, effects: Vec::new() }
    }

    /// The same with what others show of probes.
    pub(crate) fn with_probes(self, others: Self) -> Self {
        Self { effects: self.effects, ..others }
    }

    /// Adds what another part shows, of the same effects at the same places.
    pub fn merge(&mut self, other: &Self) {
        self.squares.iter_mut().zip(&other.squares).for_each(|(own, other)| *own += other);
        for (own, other) in self.effects.iter_mut().zip(&other.effects) {
            own.iter_mut().zip(other).for_each(|(own, other)| own.merge(other));
        }
    }

    /// Per effect whether its columns count: one of its places moves the observations, and its functions have values
    /// that do not hang on a single row.
    #[must_use]
    pub fn usable(&self, effects: &[Effect]) -> Vec<bool> {
        let strongest = |motion| {
            let own = self.places.iter().zip(&self.squares).filter(|(p, _)| p.freedom.kind == motion);
            own.map(|(_, squares)| squares.sqrt()).fold(0.0, f64::max)
        };
        let (turn, shift) = (strongest(TransformKind::Rotation), strongest(TransformKind::Translation));
        let strength = |place: &Place| {
            let at = self.places.iter().position(|known| known == place)?;
            let most = if place.freedom.kind == TransformKind::Rotation { turn } else { shift };
            Some((self.squares[at].sqrt(), most))
        };
        effects
            .iter()
            .zip(&self.effects)
            .map(|(effect, extents)| {
                let places: Option<Vec<(f64, f64)>> = effect.places().iter().map(strength).collect();
                let moved = places.is_some_and(|all| all.iter().any(|&(own, most)| own >= UNSEEN * most));
                moved && extents.iter().all(Extent::is_steady)
            })
            .collect()
    }
}
