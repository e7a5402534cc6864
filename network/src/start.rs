//! Where a fit starts: stations laid over each other by the targets that they share, objects where their rows say they are.
//!
//! Everything is in closed form from the readings and the declaration without errors. Where no station and no object is
//! known, the station that sees most is the frame of all others.

use model_core::Chain;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::remark::{Remark, remarks};
use super::rows::{Row, rows, sighted, tells};
use super::solved::{FLAT, circle, flattest, is_in_a_line, middle, spread, trilaterated};
use super::upright::{are_above_each_other, upright};
use fit::{align_robustly, robust};
use observe::kinds::PlaceShown;
use observe::unknowns::{Freedom, Known, Object, Pose, Shape, Station, Unknowns};
use observe::{Observations, Poses};

/// A rough pose is nowhere near where targets come to lie off by more than this share of their distance, while by those of others
/// they lie off by less than that share of it.
const FAR: f64 = 0.5;
const NEARER: f64 = 0.1;

/// Stations that a message names.
const NAMED: usize = 6;

/// Why there is nowhere to start from.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StartError {
    /// Nothing says where a station stood.
    #[error(
        "nothing says where station `{station}` stood: it shares {shared} of the targets that say where they are with stations and objects \
         that are known, and three that are not in a line are needed, or two of a levelled station (walls and directions do not say it); observe more of the \
         others' targets from it, or write roughly where {unstated} stood{}: [stations] {station} = {{ x = \"1.2 m\", y = \"0 m\", \
         z = \"0.3 m\", heading = \"30 deg\", rough = true }}",
        if unstated.contains('`') { ", all in one frame" } else { "" }
    )]
    NotConnected {
        /// Its label.
        station: String,
        /// Targets that it shares with those that are placed.
        shared: usize,
        /// The stations of which the study does not say where they stood: one frame holds all or none.
        unstated: String,
    },
    /// An object's rows do not say where it is.
    #[error("the {rows} rows of `{object}` do not say where it is: {help}")]
    NotPlaced {
        /// Its label.
        object: String,
        /// Its rows.
        rows: usize,
        /// What to do about it.
        help: &'static str,
    },
    /// Every length that is estimated can shrink to nothing, and all residuals with it.
    #[error(
        "nothing holds the scale: `{lengths}` could shrink the whole chain to a point, and every residual with it; leave one of \
         them out ([fit] fix = {{ {first} = 0 }}), or add a length that is known: rows of kind \"distance\", or where two targets \
         ([objects]) or two stations ([stations]) are"
    )]
    NoScale {
        /// The lengths that are estimated.
        lengths: String,
        /// The first of them.
        first: String,
    },
    /// Something is said of a station or an object that no row names.
    #[error(
        "no row has to do with `{label}`, of which the study says where it is; check its name against the data file"
    )]
    NoRows {
        /// The label.
        label: String,
    },
}

/// Checks that rows have to do with what the study says of places: these labels of stations and of objects. A list of control points
/// may be longer than what was observed; what is not is returned.
///
/// # Errors
/// None of the stations, or none of the objects, has rows.
pub fn check_named<'a>(
    unknowns: &Unknowns,
    stations: impl Iterator<Item = &'a str>,
    objects: impl Iterator<Item = &'a str>,
) -> Result<Option<Remark>, StartError> {
    let mut unseen: Vec<String> = Vec::new();
    let seen_stations: Vec<&str> = unknowns.stations.iter().map(|station| station.label.as_str()).collect();
    let seen_objects: Vec<&str> = unknowns.objects.iter().map(|object| object.label.as_str()).collect();
    for (stated, seen) in [(stations.collect::<Vec<_>>(), seen_stations), (objects.collect(), seen_objects)] {
        let lost: Vec<&str> = stated.iter().copied().filter(|label| !seen.contains(label)).collect();
        match lost.first() {
            Some(first) if lost.len() == stated.len() => {
                return Err(StartError::NoRows { label: (*first).to_owned() });
            }
            _ => unseen.extend(lost.into_iter().map(str::to_owned)),
        }
    }
    Ok(unseen.first().cloned().map(|label| Remark::Unseen { label, labels: unseen.len() }))
}

/// Says where the numbers of all objects and stations count from, and leaves out the rows of objects of which they do not say that.
///
/// `values` are those of all symbols; joints and inputs come from the rows. What is doubtful of the rows is returned.
///
/// # Errors
/// A station that nothing places, or no object that anything places.
pub fn place(
    chain: &Chain,
    observations: &mut Observations,
    values: &[f64],
) -> Result<Vec<Remark>, StartError> {
    let Some(mut unknowns) = observations.unknowns.take() else { return Ok(Vec::new()) };
    let mut rows = rows(chain, observations, &unknowns, values);
    let placed = place_all(&mut unknowns, &rows);
    end_sights(chain, observations, &unknowns, &rows);
    observations.unknowns = Some(unknowns);
    let lost = placed?;
    let Some(unknowns) = &observations.unknowns else { unreachable!("they were put back") };
    rows.retain(|row| lost.iter().all(|own| own.object != row.object));
    let mut all = remarks(observations, unknowns, &rows);
    if let Some(first) = lost.first() {
        let count =
            |own: &Lost| unknowns.object.iter().flatten().filter(|at| **at as usize == own.object).count();
        let (object, help) = (unknowns.objects[first.object].label.clone(), first.help);
        all.insert(
            0,
            Remark::LeftOut { object, objects: lost.len(), rows: lost.iter().map(count).sum(), help },
        );
        *observations = observations.without_objects(|object| lost.iter().any(|own| own.object == object));
    }
    Ok(all)
}

/// An object whose rows do not say where it is.
struct Lost {
    object: usize,
    rows: usize,
    /// What to do about it.
    help: &'static str,
}

/// Sights end where their objects are.
fn end_sights(chain: &Chain, observations: &mut Observations, unknowns: &Unknowns, rows: &[Row]) {
    let Poses { series, columns } = &mut observations.poses;
    for row in rows {
        let Some(range) = sighted(chain, &series[row.series]) else { continue };
        let there = unknowns.stations[row.station].pose.back(&unknowns.objects[row.object].place);
        let own = columns.iter_mut().filter(|(id, _)| *id == range);
        own.for_each(|(_, ranges)| ranges[row.number] = (there - row.from).norm());
    }
}

/// Places what can be placed; the objects that cannot are returned.
fn place_all(unknowns: &mut Unknowns, rows: &[Row]) -> Result<Vec<Lost>, StartError> {
    place_stations(unknowns, rows)?;
    let mut of_object: Vec<Vec<&Row>> = vec![Vec::new(); unknowns.objects.len()];
    rows.iter().for_each(|row| of_object[row.object].push(row));
    let mut lost = Vec::new();
    for (object, own) in of_object.iter().enumerate() {
        // Rows without a value say nothing of an object: the fit sets them aside, and says so.
        if unknowns.objects[object].known == Known::Yes || own.is_empty() {
            continue;
        }
        let poses: Vec<Pose> = own.iter().map(|row| unknowns.stations[row.station].pose).collect();
        if let Err(help) = place_object(&mut unknowns.objects[object], own, &poses) {
            lost.push(Lost { object, rows: own.len(), help });
        }
    }
    let label = |object: usize| unknowns.objects[object].label.clone();
    match lost.first() {
        Some(&Lost { object, rows, help }) if unknowns.objects.iter().all(|own| own.known == Known::No) => {
            Err(StartError::NotPlaced { object: label(object), rows, help })
        }
        _ => Ok(lost),
    }
}

/// The stations, one after the other: next that which shares most with what is placed.
fn place_stations(unknowns: &mut Unknowns, rows: &[Row]) -> Result<(), StartError> {
    let (stations, objects) = (unknowns.stations.len(), unknowns.objects.len());
    // What each station sees of each target, in its own frame.
    let mut sights = vec![vec![Vec::new(); objects]; stations];
    let unstated = unstated(unknowns);
    for row in rows.iter().filter(|row| tells(row)) {
        sights[row.station][row.object].push(row.point);
    }
    let sights: Vec<Vec<Option<Vector3<f64>>>> =
        sights.iter().map(|own| own.iter().map(|points| middle(points)).collect()).collect();
    let seen = |station: usize, object: usize| sights[station][object];
    let mut there: Vec<Option<Vector3<f64>>> =
        unknowns.objects.iter().map(|object| (object.known == Known::Yes).then_some(object.place)).collect();
    let stated = |unknowns: &Unknowns, rough: bool| {
        let own = unknowns.stations.iter().enumerate();
        let own = own.filter(|(_, own)| own.known == Known::Yes && (own.freedom == Freedom::Free) == rough);
        own.map(|(station, _)| station).collect::<Vec<usize>>()
    };
    for station in stated(unknowns, false) {
        take_over(unknowns, &mut there, &seen, station);
    }
    for station in stated(unknowns, true) {
        let pairs = (0..objects).filter_map(|at| Some((seen(station, at)?, there[at]?)));
        if let Some(pose) = far_from_rough(&unknowns.stations[station], &pairs.collect::<Vec<_>>()) {
            unknowns.stations[station].pose = pose;
        }
        take_over(unknowns, &mut there, &seen, station);
    }
    let laid_on_known = |station: usize| {
        let known = (0..objects).filter(|&at| there[at].is_some());
        let known: Vec<_> = known.filter_map(|at| seen(station, at)).collect();
        !leave_open(&unknowns.stations[station], &known)
    };
    let nothing_known = rows.iter().all(|row| unknowns.stations[row.station].known == Known::No)
        && !(0..stations).any(laid_on_known);
    if nothing_known && stations > 0 {
        // Objects that are known, but too few to place a station by, say where all of them are in the end.
        let known = std::mem::replace(&mut there, vec![None; objects]);
        let watched = |station: &usize| {
            let targets = sights[*station].iter().flatten().count();
            let own = rows.iter().filter(|row| row.station == *station).count();
            // One that was levelled says where up is.
            let is_levelled = unknowns.stations[*station].level_rad.is_some();
            (is_levelled, targets, own, std::cmp::Reverse(*station))
        };
        let most = (0..stations).max_by_key(watched).unwrap_or(0);
        unknowns.stations[most].known = Known::Yes;
        take_over(unknowns, &mut there, &seen, most);
        place_by_shared(unknowns, &mut there, &seen, &unstated)?;
        let (from, to): (Vec<_>, Vec<_>) =
            there.iter().zip(&known).filter_map(|(from, to)| Some(((*from)?, (*to)?))).unzip();
        let is_upright = unknowns.stations[most].level_rad.is_some();
        let moved = if is_upright { upright_onto(&from, &to) } else { onto(&from, &to) };
        for station in unknowns.stations.iter_mut() {
            station.pose = moved.after(&station.pose);
        }
        return Ok(());
    }
    place_by_shared(unknowns, &mut there, &seen, &unstated)
}

/// Where a station stood by the targets that it shares with those before it, if that is nowhere near the rough pose that was written:
/// the fit would find no way back.
fn far_from_rough(station: &Station, pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Option<Pose> {
    let (from, to): (Vec<_>, Vec<_>) = pairs.iter().copied().unzip();
    if is_in_a_line(&from) {
        return None;
    }
    let (pose, rough) = (laid(station, &from, &to)?, &station.pose);
    let away =
        |pose: &Pose| robust::median(pairs.iter().map(|(from, to)| (pose.apply(from) - to).norm()).collect());
    let usual = robust::median(from.iter().map(|point| point.norm()).collect());
    (away(rough) > FAR * usual && away(&pose) < NEARER * away(rough)).then_some(pose)
}

/// Whether points leave the pose of a station open.
fn leave_open(station: &Station, points: &[Vector3<f64>]) -> bool {
    if station.level_rad.is_some() { are_above_each_other(points) } else { is_in_a_line(points) }
}

/// The pose by which a station sees points where they are; none where they leave it open.
fn laid(station: &Station, from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Option<Pose> {
    if leave_open(station, from) {
        return None;
    }
    if station.level_rad.is_some() {
        return upright(from, to);
    }
    let (turn, shift) = align_robustly(from, to)?;
    Some(Pose { turn: Rotation3::from_matrix_unchecked(turn), shift })
}

/// As [`onto`], about the vertical alone.
fn upright_onto(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Pose {
    let shifts = || from.iter().zip(to).map(|(from, to)| to - from).sum::<Vector3<f64>>();
    let by_shift = || Pose { shift: shifts() / from.len().max(1) as f64, ..Pose::default() };
    upright(from, to).unwrap_or_else(by_shift)
}

/// The motion that brings points, of which there are few or which lie in a line, onto others: no further turned than it takes.
fn onto(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Pose {
    let centre = |points: &[Vector3<f64>]| points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64;
    let (start, end) = (centre(from), centre(to));
    let furthest = |points: &[Vector3<f64>]| {
        (0..points.len()).max_by(|&a, &b| (points[a] - start).norm().total_cmp(&(points[b] - start).norm()))
    };
    let turn = furthest(from)
        .and_then(|at| Rotation3::rotation_between(&(from[at] - start), &(to[at] - end)))
        .unwrap_or_else(Rotation3::identity);
    Pose { turn, shift: end - turn * start }
}

/// Stations by the targets that they share with those that are placed.
fn place_by_shared(
    unknowns: &mut Unknowns,
    there: &mut [Option<Vector3<f64>>],
    seen: &impl Fn(usize, usize) -> Option<Vector3<f64>>,
    unstated: &str,
) -> Result<(), StartError> {
    let (stations, objects) = (unknowns.stations.len(), there.len());
    let is_placed = |unknowns: &Unknowns, at: usize| unknowns.stations[at].known == Known::Yes;
    while let Some((shared, station)) = (0..stations)
        .filter(|&station| !is_placed(unknowns, station))
        .map(|station| {
            let shared = (0..objects).filter(|&at| there[at].is_some() && seen(station, at).is_some());
            (shared.count(), std::cmp::Reverse(station))
        })
        .max()
        .map(|(shared, station)| (shared, station.0))
    {
        let pairs: Vec<(Vector3<f64>, Vector3<f64>)> =
            (0..objects).filter_map(|at| Some((seen(station, at)?, there[at]?))).collect();
        let (from, to): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
        let own = &mut unknowns.stations[station];
        let Some(pose) = laid(own, &from, &to) else {
            let (station, unstated) = (own.label.clone(), unstated.to_owned());
            return Err(StartError::NotConnected { station, shared, unstated });
        };
        own.pose = pose;
        own.known = Known::Yes;
        take_over(unknowns, there, seen, station);
    }
    Ok(())
}

/// The stations of which a study says nothing, the first of many.
fn unstated(unknowns: &Unknowns) -> String {
    let own = unknowns.stations.iter().filter(|own| !own.label.is_empty() && !own.is_written());
    let labels: Vec<String> = own.map(|station| format!("`{}`", station.label)).collect();
    match labels.as_slice() {
        [_] | [] => "it".to_owned(),
        few if few.len() <= NAMED => few.join(", "),
        many => format!("{} and {} more", many[..NAMED].join(", "), many.len() - NAMED),
    }
}

/// Objects that nothing placed yet are where a station that is placed sees them.
fn take_over(
    unknowns: &Unknowns,
    there: &mut [Option<Vector3<f64>>],
    seen: &impl Fn(usize, usize) -> Option<Vector3<f64>>,
    station: usize,
) {
    for (object, place) in there.iter_mut().enumerate() {
        if let (None, Some(point)) = (&place, seen(station, object)) {
            *place = Some(unknowns.stations[station].pose.apply(&point));
        }
    }
}

/// An object from its rows, the stations being where they are; where they do not say that, what to do about it.
fn place_object(object: &mut Object, rows: &[&Row], poses: &[Pose]) -> Result<(), &'static str> {
    let points = rows.iter().zip(poses).map(|(row, pose)| pose.apply(&row.point));
    let Some((centre, squares)) = spread(points.clone()) else { return Ok(()) };
    match object.shape {
        Shape::Plane => {
            object.normal = flattest(squares)
                .filter(|_| rows.len() >= 3)
                .ok_or("observe it at three places at least that are not in a line")?;
            object.place = centre;
        }
        Shape::Point if rows.iter().any(|row| tells(row)) => {
            let telling = rows.iter().zip(points).filter(|(row, _)| tells(row)).map(|(_, point)| point);
            object.place = middle(&telling.collect::<Vec<_>>()).unwrap_or(centre);
        }
        Shape::Point if rows.iter().all(|row| row.measure.kind().place == PlaceShown::Distance) => {
            object.place = Vector3::from(trilaterated::<3>(rows, poses).ok_or(
                "observe its distance from four places at least that are not in a plane, or write where it is",
            )?);
        }
        Shape::Point => {
            // Where the beams come nearest to each other.
            let sights = rows.iter().zip(poses);
            let sights = sights.filter(|(row, _)| row.measure.kind().place == PlaceShown::Beam);
            let beams = sights
                .map(|(row, pose)| (pose.turn * (row.point - row.from).normalize(), pose.apply(&row.from)));
            let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
            for (beam, from) in beams {
                let across = Matrix3::identity() - beam * beam.transpose();
                normal += across;
                right += across * from;
            }
            let values = normal.symmetric_eigenvalues();
            let flat = values.min() <= FLAT * values.max();
            let solved = if flat { None } else { normal.cholesky().map(|factor| factor.solve(&right)) };
            object.place = solved
                .ok_or("its beams do not cross: sight it from another station, or write where it is")?;
        }
        Shape::Circle | Shape::Ring => {
            let (axis, place, radius) = circle(&points.collect::<Vec<_>>(), &centre, squares)
                .ok_or("observe it at three places at least, spread along the circle")?;
            (object.normal, object.place) = (axis, place);
            object.offset = if object.shape == Shape::Circle { radius } else { 0.0 };
        }
        Shape::Wire => {
            let [x, y, z, offset] = trilaterated::<4>(rows, poses)
                .ok_or("a wire or a sphere takes five rows at least, at points that are not in a plane")?;
            object.place = Vector3::new(x, y, z);
            object.offset = offset;
        }
    }
    object.known = Known::Yes;
    Ok(())
}
