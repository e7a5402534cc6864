//! What is doubtful of rows: that they repeat others; and of those that observe objects, that they say nothing, that they see a
//! plane head-on alone, that their labels are likely swapped.

use std::collections::BTreeMap;
use std::fmt;

use nalgebra::Vector3;

use super::rows::{Row, tells};
use fit::robust;
use observe::Observations;
use observe::unknowns::{Freedom, Object, Shape, Unknowns};

/// A plane that no beam meets at more than this from its normal shows ranges alone, rad.
const HEAD_ON_RAD: f64 = 0.15;

/// A row lies astray that is so many times as far from its object's others as rows usually are.
const ASTRAY: f64 = 8.0;

/// It lies where another object is when it is this much nearer to that.
const NEARER: f64 = 0.2;

/// Rows of one object lie as far from each other as objects do from this share of the distance between objects on, of which there are
/// so many at least.
const AS_FAR: f64 = 0.3;
const FEWEST: usize = 3;

/// Something that a user should look at.
#[derive(Debug, Clone, PartialEq)]
pub enum Remark {
    /// Objects whose rows do not say where they are, and were left out.
    LeftOut {
        /// The first of them.
        object: String,
        /// How many there are.
        objects: usize,
        /// How many rows they have.
        rows: usize,
        /// What to do about the first.
        help: &'static str,
    },
    /// Places that the study states and no row has to do with.
    Unseen {
        /// The first of them.
        label: String,
        /// How many there are.
        labels: usize,
    },
    /// Objects whose rows do no more than say where they are.
    SaysNothing {
        /// The first of them.
        object: String,
        /// How many there are.
        objects: usize,
    },
    /// A plane that beams meet at nearly a right angle alone.
    HeadOn {
        /// Its label.
        plane: String,
        /// How far from the normal a beam meets it at most, degrees.
        most_deg: f64,
    },
    /// Rows that repeat others number by number, and were left out.
    Repeated {
        /// How many.
        rows: usize,
        /// The first of them, counted from 1 without the header.
        first: u64,
        /// The row that it repeats.
        of: u64,
    },
    /// Rows of one object lie as far from each other as objects do.
    FarApart {
        /// How far a row lies from the others of its object, in the middle of all, m.
        usual_m: f64,
        /// Whether rows name stations.
        has_stations: bool,
    },
    /// Rows of one object that lie where another is.
    Swapped {
        /// The label that they bear.
        one: String,
        /// The object that is there.
        other: String,
        /// How many rows, and how many of the other lie where this one is.
        rows: [usize; 2],
        /// The first of them, counted from 1 without the header.
        first: u64,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LeftOut { object, objects: 1, rows: 1, help } => {
                write!(f, "the one row of `{object}` does not say where it is and was left out: {help}")
            }
            Self::LeftOut { object, objects: 1, rows, help } => {
                write!(f, "the {rows} rows of `{object}` do not say where it is and were left out: {help}")
            }
            Self::LeftOut { object, objects, rows, help } => write!(
                f,
                "{rows} rows of {objects} objects do not say where these are and were left out; of `{object}`, the first: {help}"
            ),
            Self::Unseen { label, labels: 1 } => {
                write!(
                    f,
                    "no row has to do with `{label}`, of which the study says where it is: is its name right?"
                )
            }
            Self::Unseen { label, labels } => write!(
                f,
                "no row has to do with {labels} of the places that the study states (`{label}` is the first): are their names right?"
            ),
            Self::SaysNothing { object, objects: 1 } => write!(
                f,
                "the rows of `{object}` say where it is and nothing of the errors: observe it from more places or poses"
            ),
            Self::SaysNothing { object, objects } => write!(
                f,
                "the rows of {objects} objects (`{object}` is the first) say where they are and nothing of the errors: observe \
                 them from more places or poses"
            ),
            Self::HeadOn { plane, most_deg } => write!(
                f,
                "the plane `{plane}` was seen head-on alone (at most {most_deg:.1} deg from its normal): it shows ranges and \
                 hardly any angle; aim at it obliquely too"
            ),
            Self::Repeated { rows: 1, first, of } => {
                write!(f, "row {first} repeats row {of} number by number: it was left out")
            }
            Self::Repeated { rows, first, of } => write!(
                f,
                "{rows} rows repeat others number by number, the first of them row {first}, which is row {of} again: they were left \
                 out; was the file written twice?"
            ),
            Self::FarApart { usual_m, has_stations } => write!(
                f,
                "rows of one object lie {usual_m:.2} m from each other, as far as objects do: {}",
                if *has_stations {
                    "do `object` and `station` name the right columns, and are units and signs right?"
                } else {
                    "were they seen from several places? Then name the column that says from where, station = \"…\" under [observed]"
                }
            ),
            Self::Swapped { one, other, rows: [there, 0], first } => write!(
                f,
                "{there} rows labelled `{one}` lie where `{other}` is, the first of them row {first}: are their labels right?"
            ),
            Self::Swapped { one, other, rows: [there, back], first } => write!(
                f,
                "the labels `{one}` and `{other}` are likely swapped: {there} rows of the first lie where the second is, and \
                 {back} the other way round; the first of them is row {first}"
            ),
        }
    }
}

/// What is doubtful of these rows, the objects and stations being where they start.
pub(super) fn remarks(observations: &Observations, unknowns: &Unknowns, rows: &[Row]) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let mut components = vec![0; unknowns.objects.len()];
    rows.iter().for_each(|row| components[row.object] += row.measure.components());
    let says_nothing = |(object, components): &(&Object, &usize)| {
        object.freedom == Freedom::Free && **components > 0 && **components <= object.numbers()
    };
    let idle: Vec<&Object> =
        unknowns.objects.iter().zip(&components).filter(says_nothing).map(|(object, _)| object).collect();
    if let Some(first) = idle.first() {
        remarks.push(Remark::SaysNothing { object: first.label.clone(), objects: idle.len() });
    }
    let mut most: Vec<Option<f64>> = vec![None; unknowns.objects.len()];
    for row in rows.iter().filter(|row| unknowns.objects[row.object].shape == Shape::Plane) {
        let beam = unknowns.stations[row.station].pose.turn * row.point.normalize();
        let from_normal = beam.dot(&unknowns.objects[row.object].normal).abs().min(1.0).acos();
        most[row.object] = Some(most[row.object].map_or(from_normal, |most| most.max(from_normal)));
    }
    for (plane, most) in unknowns.objects.iter().zip(most) {
        if let Some(most) = most.filter(|most| *most < HEAD_ON_RAD) {
            remarks.push(Remark::HeadOn { plane: plane.label.clone(), most_deg: most.to_degrees() });
        }
    }
    match far_apart(unknowns, rows) {
        Some(far) => remarks.push(far),
        None => remarks.extend(swapped(observations, unknowns, rows)),
    }
    remarks
}

/// Whether rows of one object lie as far from each other as objects do: they are not of one object, or from one place.
fn far_apart(unknowns: &Unknowns, rows: &[Row]) -> Option<Remark> {
    let rows: Vec<&Row> = rows.iter().filter(|row| tells(row)).collect();
    let there = |row: &Row| unknowns.stations[row.station].pose.apply(&row.point);
    let mut places: Vec<Sum> = vec![(Vector3::zeros(), 0.0); unknowns.objects.len()];
    for row in &rows {
        places[row.object].0 += there(row);
        places[row.object].1 += 1.0;
    }
    let centres: Vec<Vector3<f64>> =
        places.iter().filter(|(_, count)| *count > 0.0).map(|(sum, count)| sum / *count).collect();
    let away = rows
        .iter()
        .filter_map(|row| Some((there(row) - without(places[row.object], (there(row), 1.0))?).norm()));
    let away: Vec<f64> = away.collect();
    if centres.len() < FEWEST || away.is_empty() {
        return None;
    }
    let middle = centres.iter().sum::<Vector3<f64>>() / centres.len() as f64;
    let apart = robust::median(centres.iter().map(|centre| (centre - middle).norm()).collect());
    let usual_m = robust::median(away);
    let has_stations = unknowns.stations.iter().any(|station| !station.label.is_empty());
    (usual_m > AS_FAR * apart).then_some(Remark::FarApart { usual_m, has_stations })
}

/// A sum of points and how many they are.
type Sum = (Vector3<f64>, f64);

fn without(all: Sum, part: Sum) -> Option<Vector3<f64>> {
    (all.1 > part.1).then(|| (all.0 - part.0) / (all.1 - part.1))
}

/// Rows that lie where another object is.
fn swapped(observations: &Observations, unknowns: &Unknowns, rows: &[Row]) -> Vec<Remark> {
    let rows: Vec<&Row> = rows.iter().filter(|row| tells(row)).collect();
    let there = |row: &Row| unknowns.stations[row.station].pose.apply(&row.point);
    let mut whole: Vec<Sum> = vec![(Vector3::zeros(), 0.0); unknowns.objects.len()];
    let mut from: BTreeMap<(usize, usize), Sum> = BTreeMap::new();
    for row in &rows {
        let own = from.entry((row.object, row.station)).or_insert((Vector3::zeros(), 0.0));
        for sum in [own, &mut whole[row.object]] {
            sum.0 += there(row);
            sum.1 += 1.0;
        }
    }
    // Where an object is as other stations say, or where there are none its other rows.
    let others = |row: &Row| {
        let all = whole[row.object];
        let own = from.get(&(row.object, row.station)).copied().unwrap_or((Vector3::zeros(), 0.0));
        without(all, own).or_else(|| without(all, (there(row), 1.0)))
    };
    let away: Vec<Option<f64>> =
        rows.iter().map(|row| others(row).map(|place| (there(row) - place).norm())).collect();
    let mut sorted: Vec<f64> = away.iter().flatten().copied().collect();
    if sorted.is_empty() {
        return Vec::new();
    }
    sorted.sort_by(f64::total_cmp);
    let usual = sorted[sorted.len() / 2];
    let mut found: BTreeMap<(usize, usize), (usize, usize)> = BTreeMap::new();
    for (row, away) in rows.iter().zip(away) {
        let Some(away) = away.filter(|away| *away > ASTRAY * usual && *away > 0.0) else { continue };
        let nearest = (0..whole.len()).filter(|&other| other != row.object).filter_map(|other| {
            let own = from.get(&(other, row.station)).copied().unwrap_or((Vector3::zeros(), 0.0));
            let place =
                without(whole[other], own).or_else(|| without(whole[other], (Vector3::zeros(), 0.0)))?;
            Some(((there(row) - place).norm(), other))
        });
        let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, other)) = nearest.filter(|(distance, _)| *distance < NEARER * away) {
            let known = found.entry((row.object, other)).or_insert((0, row.number));
            known.0 += 1;
            known.1 = known.1.min(row.number);
        }
    }
    let label = |object: usize| unknowns.objects[object].label.clone();
    let count = |one: usize, other: usize| found.get(&(one, other)).map_or(0, |found| found.0);
    let pairs = found.iter().filter(|((one, other), _)| count(*other, *one) == 0 || one < other);
    pairs
        .map(|(&(one, other), &(rows, first))| Remark::Swapped {
            one: label(one),
            other: label(other),
            rows: [rows, count(other, one)],
            first: observations.row_number(first),
        })
        .collect()
}
