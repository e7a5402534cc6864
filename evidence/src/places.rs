//! Places whose columns are one: the first stands for all.

use crate::policy::Policy;
use crate::problem::{Frame, Freedom, Problem};

/// The places that differ, and which one stands for each that was given.
#[derive(Debug, Clone, PartialEq)]
pub struct Places {
    /// The places that differ, in the order given.
    pub distinct: Vec<Distinct>,
    /// For each place given the number in `distinct`; none where the place moves nothing.
    pub stands_for: Vec<Option<usize>>,
    /// By what the column of the place that stands for it is to be multiplied to get its own.
    pub factor: Vec<f64>,
    /// The frames whose pairs of places both move something.
    pub frames: Vec<PlacedFrame>,
}

/// A place that stands for all with its column.
#[derive(Debug, Clone, PartialEq)]
pub struct Distinct {
    /// Its number in [`Problem::places`].
    pub place: usize,
    /// Numbers of the places that it stands for, itself among them.
    pub members: Vec<usize>,
    /// The joints that move exactly it.
    pub own: Vec<usize>,
    /// The joints beside it.
    pub beside: Vec<usize>,
    /// Whether it turns.
    pub turns: bool,
    /// Whether it is the measured range.
    pub is_range: bool,
    /// Whether it stands in the first frame from the ground.
    pub at_base: bool,
}

/// A frame with its places by their number among those that differ.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedFrame {
    /// Its number in [`Problem::frames`].
    pub frame: usize,
    /// The places that tilt it.
    pub tilts: Option<[usize; 2]>,
    /// The joint below and the places across its axis.
    pub whirl: Option<(usize, [usize; 2])>,
}

impl Places {
    /// Merges the places of a problem.
    #[must_use]
    pub fn of(problem: &Problem, policy: &Policy) -> Self {
        let norm = |column: &[f64]| column.iter().map(|value| value * value).sum::<f64>().sqrt();
        let norms: Vec<f64> = problem.places.iter().map(|place| norm(place.compared())).collect();
        // A rotation is compared with rotations, a shift with shifts: their columns have other units.
        let largest = |index: usize| {
            let turns = matches!(problem.places[index].freedom, Freedom::Rotation(_));
            let alike = problem.places.iter().zip(&norms);
            alike
                .filter(|(place, _)| matches!(place.freedom, Freedom::Rotation(_)) == turns)
                .fold(0.0, |largest: f64, (_, &norm)| largest.max(norm))
        };
        let mut distinct: Vec<Distinct> = Vec::new();
        let mut stands_for = Vec::with_capacity(problem.places.len());
        let mut factor = Vec::with_capacity(problem.places.len());
        for (index, place) in problem.places.iter().enumerate() {
            if norms[index] <= policy.same_place * largest(index) || norms[index] == 0.0 {
                stands_for.push(None);
                factor.push(0.0);
                continue;
            }
            let same = distinct.iter().enumerate().find_map(|(number, other)| {
                let (a, b) = (place.compared(), problem.places[other.place].compared());
                let scale = a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / norms[other.place].powi(2);
                let apart: f64 = a.iter().zip(b).map(|(a, b)| (a - scale * b).powi(2)).sum();
                (apart.sqrt() <= policy.same_place * norms[index]).then_some((number, scale))
            });
            let (number, scale) = same.unwrap_or_else(|| {
                distinct.push(Distinct {
                    place: index,
                    members: Vec::new(),
                    own: Vec::new(),
                    beside: Vec::new(),
                    turns: matches!(place.freedom, Freedom::Rotation(_)),
                    is_range: place.freedom == Freedom::Range,
                    at_base: place.frame == 0,
                });
                (distinct.len() - 1, 1.0)
            });
            let merged = &mut distinct[number];
            merged.members.push(index);
            add_new(&mut merged.own, place.own.as_slice());
            add_new(&mut merged.beside, &place.beside);
            stands_for.push(Some(number));
            factor.push(scale);
        }
        let pair =
            |pair: [usize; 2]| Some([stands_for[pair[0]]?, stands_for[pair[1]]?]).filter(|[a, b]| a != b);
        let placed = |(frame, given): (usize, &Frame)| PlacedFrame {
            frame,
            tilts: given.tilts.and_then(pair),
            whirl: given.whirl.and_then(|(joint, places)| Some((joint, pair(places)?))),
        };
        let frames = problem.frames.iter().enumerate().map(placed).collect();
        Self { distinct, stands_for, factor, frames }
    }
}

fn add_new(list: &mut Vec<usize>, more: &[usize]) {
    for &item in more {
        if !list.contains(&item) {
            list.push(item);
        }
    }
}
