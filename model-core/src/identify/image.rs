//! What each error adds to an image point at a place, to first order.

use super::pair::{Pair, Vector};
use super::place::Place;
use crate::algebra::Poly;
use crate::chain::image::{Field, INTRINSICS, project};
use crate::chain::reading::Reading;

/// The numbers of a camera without errors, and what multiplies each error in them.
pub(super) type Camera = [(Poly, Vec<(usize, Poly)>); INTRINSICS];

/// A number and how fast it goes with an error; none where a denominator vanishes.
#[derive(Clone, Copy)]
struct Rate(Option<[Pair; 2]>);

impl Rate {
    fn with(self, other: Self, of: impl Fn([Pair; 2], [Pair; 2]) -> Option<[Pair; 2]>) -> Self {
        Self(self.0.zip(other.0).and_then(|(a, b)| of(a, b)))
    }
}

impl Field for Rate {
    type With<'a> = ();

    fn plus(self, other: Self, (): &mut ()) -> Self {
        self.with(other, |[a, da], [b, db]| Some([a.plus(b), da.plus(db)]))
    }

    fn times(self, other: Self, (): &mut ()) -> Self {
        self.with(other, |[a, da], [b, db]| Some([a.times(b), da.times(b).plus(a.times(db))]))
    }

    fn over(self, other: Self, (): &mut ()) -> Self {
        self.with(other, |[a, da], [b, db]| {
            let inverse = b.inverse()?;
            let quotient = a.times(inverse);
            Some([quotient, da.minus(quotient.times(db)).times(inverse)])
        })
    }
}

/// A row for each number that is shown; `None` where a denominator vanishes.
pub(super) fn rows(
    camera: &Camera,
    shown: &[Reading],
    nominal: Vector,
    added: &[Vector],
    place: &Place,
) -> Option<Vec<Vec<Pair>>> {
    let mut rows = vec![Vec::with_capacity(added.len()); shown.len()];
    for (error, moved) in added.iter().enumerate() {
        let mut intrinsics = [Rate(None); INTRINSICS];
        for (number, (value, linear)) in intrinsics.iter_mut().zip(camera) {
            let slope = linear.iter().find(|(own, _)| *own == error);
            let slope = slope.map_or(Some(Pair::ZERO), |(_, slope)| place.value(slope))?;
            *number = Rate(Some([place.value(value)?, slope]));
        }
        let point = [0, 1, 2].map(|axis| Rate(Some([nominal[axis], moved[axis]])));
        let seen = project(point, &intrinsics, &mut ());
        for (row, reading) in rows.iter_mut().zip(shown) {
            let component = || reading.component().map(|axis| moved[axis.index()]);
            let image = reading.image().map(|axis| seen[axis.index()].0.map(|[_, rate]| rate));
            row.push(image.unwrap_or_else(component)?);
        }
    }
    Some(rows)
}
