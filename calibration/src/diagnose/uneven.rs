//! Objects and stations whose rows scatter more than the others': a wall that is not flat, a target or a station that moved,
//! labels that are wrong.

use std::collections::BTreeMap;

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor, Normal};

use fit::FitResult;
use fit::noise::Layout;
use observe::Observations;
use observe::unknowns::{Shape, Unknowns};

/// What chance explains less often than this, over all objects and stations, is told.
const UNLIKELY: f64 = 0.001;

/// It is worth a word from so many times the others' scatter.
const LARGER: f64 = 1.5;

/// Degrees of freedom of the others from which on their scatter is known.
const KNOWN: f64 = 20.0;

/// Mean squares of a row beyond this, in units of the noise, count as this much: how far off an outlier is says nothing of how many
/// there are.
const CLIP: f64 = 9.0;

/// So many are named at most.
const MOST: usize = 5;

/// What scatters.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Uneven {
    /// A target, a socket, a mark.
    Point,
    /// A plane.
    Plane,
    /// A circle.
    Circle,
    /// A wire, or a sphere.
    Wire,
    /// Where the instrument stood.
    Station,
}

impl Uneven {
    /// What an object of a shape is.
    pub(super) fn of(shape: Shape) -> Self {
        match shape {
            Shape::Plane => Self::Plane,
            Shape::Point => Self::Point,
            Shape::Circle | Shape::Ring => Self::Circle,
            Shape::Wire => Self::Wire,
        }
    }
}

/// Something whose rows scatter more than the others'.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scatter {
    pub what: Uneven,
    pub label: String,
    /// Root mean square of its residuals, in units of the others'.
    pub times: f64,
}

/// What the residuals of some rows come to: their squares in units of the noise, and how many components those are.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    squares: f64,
    components: f64,
    largest: (f64, f64),
    /// The same of the rows that are no outliers.
    kept: (f64, f64),
    /// How many rows there are, and the sums of their clipped mean squares and of the squares of these.
    clipped: [f64; 3],
}

impl Sum {
    fn add(&mut self, row: &Row) {
        self.squares += row.squares;
        self.components += row.components;
        if row.squares > self.largest.0 {
            self.largest = (row.squares, row.components);
        }
        if row.is_kept {
            self.kept = (self.kept.0 + row.squares, self.kept.1 + row.components);
        }
        let own = clipped(row.squares, row.components);
        self.clipped = [self.clipped[0] + 1.0, self.clipped[1] + own, self.clipped[2] + own * own];
    }

    /// The chance of rows, but the one that is furthest off, to be off so much more than the others as `all` with them scatter: whatever
    /// the noise is like, heavy tails and outliers included.
    fn chance_among(&self, all: &Self) -> f64 {
        let [count, sum, _] = self.clipped;
        let (count, sum) = (count - 1.0, sum - clipped(self.largest.0, self.largest.1));
        let [others, of_others, squares] = std::array::from_fn(|at| all.clipped[at] - self.clipped[at]);
        let mean = of_others / others;
        let variance = squares / others - mean * mean;
        let further = (sum / count - mean) / (variance * (1.0 / count + 1.0 / others)).sqrt();
        if further.is_nan() { 1.0 } else { Normal::standard().sf(further) }
    }

    /// Without the row that is furthest off: a single one is an outlier, and says nothing of the others.
    fn without_largest(self) -> (f64, f64) {
        (self.squares - self.largest.0, self.components - self.largest.1)
    }
}

/// A row that counts.
struct Row {
    object: usize,
    station: usize,
    squares: f64,
    components: f64,
    is_kept: bool,
}

/// The mean square of a row, clipped.
fn clipped(squares: f64, components: f64) -> f64 {
    (squares / components).min(CLIP)
}

/// Those whose rows scatter more than the others', the most unlikely first; each is judged without the rows of those before it.
pub(super) fn uneven(observations: &Observations, fit: &FitResult) -> Vec<Scatter> {
    let Some(unknowns) = &observations.unknowns else { return Vec::new() };
    let mut rows = rows(observations, unknowns, fit);
    let components: f64 = rows.iter().map(|row| row.components).sum();
    // What objects, stations and errors take of each component, on average.
    let left = (components - (unknowns.numbers() + fit.rank) as f64) / components;
    let mut found = Vec::new();
    while found.len() < MOST {
        let Some((group, times)) = most_unlikely(&rows, unknowns, left) else { break };
        let (what, label) = match group {
            Group::Object(at) => {
                let object = &unknowns.objects[at];
                let what = Uneven::of(object.shape);
                (what, object.label.clone())
            }
            Group::Station(at) => (Uneven::Station, unknowns.stations[at].label.clone()),
        };
        found.push(Scatter { what, label, times });
        rows.retain(|row| !group.has(row));
    }
    found
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Object(usize),
    Station(usize),
}

impl Group {
    fn has(self, row: &Row) -> bool {
        match self {
            Self::Object(at) => row.object == at,
            Self::Station(at) => row.station == at,
        }
    }

    /// How many numbers of its own it has.
    fn numbers(self, unknowns: &Unknowns) -> usize {
        match self {
            Self::Object(at) => unknowns.objects[at].numbers(),
            Self::Station(at) => unknowns.stations[at].numbers(),
        }
    }
}

fn rows(observations: &Observations, unknowns: &Unknowns, fit: &FitResult) -> Vec<Row> {
    let mut white = fit.residuals.raw.clone();
    fit.noise.without_memory().whiten(&mut white);
    let layout = Layout::of(observations);
    let each = layout.by_row(&white).zip(&fit.residuals.weight).enumerate();
    each.filter_map(|(row, (own, weight))| {
        let squares: f64 = own.iter().map(|value| value * value).sum();
        let object = unknowns.object[row]? as usize;
        let (station, components) = (unknowns.station[row] as usize, own.len() as f64);
        let row = Row { object, station, squares, components, is_kept: *weight > 0.0 };
        squares.is_finite().then_some(row)
    })
    .collect()
}

/// The group whose scatter is the most unlikely one, and how much larger it is; `None` if chance explains each, or it is hardly larger.
fn most_unlikely(rows: &[Row], unknowns: &Unknowns, left: f64) -> Option<(Group, f64)> {
    let mut groups: BTreeMap<Group, Sum> = BTreeMap::new();
    let mut all = Sum::default();
    for row in rows {
        for group in [Group::Object(row.object), Group::Station(row.station)] {
            groups.entry(group).or_default().add(row);
        }
        all.add(row);
    }
    let tests = groups.len() as f64;
    let judged = groups.iter().filter_map(|(&group, sum)| {
        let (rest, of_rest) = (all.kept.0 - sum.kept.0, (all.kept.1 - sum.kept.1) * left);
        let (squares, components) = sum.without_largest();
        let freedom = components - group.numbers(unknowns) as f64;
        if freedom < 1.0 || of_rest < KNOWN {
            return None;
        }
        let ratio = squares / freedom / (rest / of_rest);
        let of_normal = FisherSnedecor::new(freedom, of_rest).ok()?.sf(ratio);
        let chance = of_normal.max(sum.chance_among(&all)) * tests;
        (ratio.sqrt() > LARGER && chance < UNLIKELY).then_some((chance, group, ratio.sqrt()))
    });
    judged
        .min_by(|a, b| a.0.total_cmp(&b.0).then(b.2.total_cmp(&a.2)))
        .map(|(_, group, times)| (group, times))
}
