//! What one row makes of what is unknown: its residual, and how that moves with the chain, the object and the station.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::data::unknowns::{OF_OBJECT, Object, Pose, Unknowns, WIDTH, own_numbers, right_jacobian, tilted};
use crate::data::{Measure, Measured, tangent_frame};
use crate::fit::residual;

/// Per component the derivatives of what is predicted by the numbers of the object, then by those of the station.
pub(crate) type Columns = [[f64; WIDTH]; 3];

/// Residual components of a row, the gradient of each predicted component by the chain's x, y, z, and the derivatives by
/// what is unknown.
pub(crate) type Seen = ([(f64, Vector3<f64>); 3], Columns);

/// What a row shows of its object from its station, the chain saying `predicted`; `None` if it observes nothing unknown.
///
/// `state` holds all numbers that are estimated, `first` where those of each station and of each object begin; `beam` points
/// the way in which a target was seen, of any length; that of a sight from a point of the chain goes from there to `predicted`.
#[allow(clippy::too_many_arguments)]
pub(crate) fn seen(
    unknowns: &Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
    measure: Measure,
    measured: &Measured,
    predicted: &Vector3<f64>,
    beam: &Vector3<f64>,
    turns_by: TurnsBy,
) -> Option<Seen> {
    let (object, own) = object_of(unknowns, first, state, row)?;
    let (pose, by) = pose_of(unknowns, first, state, row)?;
    let frame = Frame {
        by: turns_by,
        pose,
        jacobian: right_jacobian(&Vector3::new(by[3], by[4], by[5])).transpose(),
    };
    let shown = |predicted: &Vector3<f64>, beam: &Vector3<f64>| {
        Some(match (measure, measured) {
            (Measure::Plane, _) => frame.plane(object, own, predicted),
            (Measure::Target, _) => frame.target(object, own, predicted, beam),
            (Measure::Fixed, _) => frame.fixed(object, own, predicted),
            // A distance is a wire's length that lacks nothing: an object that is a point has no fourth number.
            (Measure::Wire | Measure::Distance, Measured::Length { length_m }) => {
                frame.wire(object, own, *length_m, predicted)
            }
            (Measure::Sight, _) => frame.sight(object, own, predicted),
            (Measure::Beam, _) => frame.beam(object, own, predicted, beam),
            _ => return None,
        })
    };
    let seen = shown(predicted, beam)?;
    if turns_by == TurnsBy::Adjusted { adjusted(seen, predicted, beam, shown) } else { Some(seen) }
}

/// How far the point that a row observes is from `origin`, which is in the chain's frame, m.
pub(crate) fn distance(
    unknowns: &Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
    origin: &Vector3<f64>,
) -> Option<f64> {
    let (object, own) = object_of(unknowns, first, state, row)?;
    let (pose, _) = pose_of(unknowns, first, state, row)?;
    Some((pose.back(&(object.place + Vector3::new(own[0], own[1], own[2]))) - origin).norm())
}

/// What a row observes, and its numbers.
fn object_of<'a>(
    unknowns: &'a Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
) -> Option<(&'a Object, [f64; OF_OBJECT])> {
    let at = (*unknowns.object.get(row)?)? as usize;
    let object = unknowns.objects.get(at)?;
    Some((object, own_numbers(state, first[1][at], object.numbers())))
}

/// Where a row was observed from, and the numbers of that station.
fn pose_of(
    unknowns: &Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
) -> Option<(Pose, [f64; 6])> {
    let at = *unknowns.station.get(row)? as usize;
    let station = unknowns.stations.get(at)?;
    let by = own_numbers(state, first[0][at], station.numbers());
    Some((station.pose.moved(&by), by))
}

/// The way that a point has to go for a residual to be none, by its gradient.
fn to_no_residual((residual, gradient): &(f64, Vector3<f64>)) -> Vector3<f64> {
    let square = gradient.norm_squared();
    if square > 0.0 { gradient * (*residual / square) } else { Vector3::zeros() }
}

/// The residual of a row with derivatives at the point that it would have without one. The chain's are turned and stretched by what
/// takes its point there, and its beam with it.
fn adjusted(
    (mut components, _): Seen,
    predicted: &Vector3<f64>,
    beam: &Vector3<f64>,
    shown: impl Fn(&Vector3<f64>, &Vector3<f64>) -> Option<Seen>,
) -> Option<Seen> {
    let there = components.iter().fold(*predicted, |point, step| point + to_no_residual(step));
    let turn = Rotation3::rotation_between(predicted, &there).unwrap_or_else(Rotation3::identity);
    let stretch = Some(there.norm() / predicted.norm()).filter(|stretch| stretch.is_finite()).unwrap_or(1.0);
    let (at_object, columns) = shown(&there, &(turn * beam * stretch))?;
    for ((_, gradient), (_, there)) in components.iter_mut().zip(at_object) {
        *gradient = turn.inverse() * there * stretch;
    }
    Some((components, columns))
}

/// What turns with a station when the derivative of a target or a sight is taken.
///
/// The two differ by the residual. Steps go by the object: a frame that nothing holds, with all in it, then changes no row. What
/// the data determine is asked by the prediction, which the chain's own turns move: by the object every row would tell the two
/// apart by its residual, and thousands of rows would determine what none of them shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TurnsBy {
    /// The object as the station's numbers have it.
    Object,
    /// What the chain predicts.
    Prediction,
    /// The object, where the row would hit it. Where everything could be larger the rows' noise would tell how much: a search would find a
    /// scale, and as surely as the noise is there.
    Adjusted,
}

/// Where the station stands, and what its turn does when its numbers change.
struct Frame {
    pose: Pose,
    by: TurnsBy,
    /// Transpose of the right Jacobian of the turn.
    jacobian: Matrix3<f64>,
}

impl Frame {
    /// The derivatives of one component by object and station: by the numbers of the object, by the station's shift, and
    /// by a small turn about the axes of the chain's frame.
    fn row(&self, object: [f64; OF_OBJECT], shift: Vector3<f64>, turn: Vector3<f64>) -> [f64; WIDTH] {
        let turn = self.jacobian * turn;
        let [a, b, c, d] = object;
        [a, b, c, d, shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]
    }

    /// n·(R p + t) − d against zero.
    fn plane(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>) -> Seen {
        let (n, by_tilt) = tilted(&object.normal, [own[0], own[1]]);
        let from = self.pose.apply(p) - object.place;
        let gradient = self.pose.turn.inverse() * n;
        let object = [by_tilt[0].dot(&from), by_tilt[1].dot(&from), -1.0, 0.0];
        let row = self.row(object, n, p.cross(&gradient));
        one((own[2] - n.dot(&from), gradient), row)
    }

    /// Rᵀ(X − t) − p across, up and along the beam.
    fn target(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>, beam: &Vector3<f64>) -> Seen {
        let there = self.pose.back(&(object.place + Vector3::new(own[0], own[1], own[2])));
        let beam = beam.normalize();
        let [across, up] = tangent_frame(&beam);
        let difference = there - p;
        let component = |axis: Vector3<f64>| {
            let outside = self.pose.turn * axis;
            let arm = if self.by == TurnsBy::Prediction { *p } else { there };
            let row = self.row([-outside.x, -outside.y, -outside.z, 0.0], outside, arm.cross(&axis));
            ((difference.dot(&axis), axis), row)
        };
        let [a, b, c] = [across, up, beam].map(component);
        ([a.0, b.0, c.0], [a.1, b.1, c.1])
    }

    /// c − (R p + t) along x, y, z of the objects' frame.
    fn fixed(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>) -> Seen {
        let difference = object.place + Vector3::new(own[0], own[1], own[2]) - self.pose.apply(p);
        let component = |axis: Vector3<f64>| {
            let gradient = self.pose.turn.inverse() * axis;
            let row = self.row([-axis.x, -axis.y, -axis.z, 0.0], axis, p.cross(&gradient));
            ((difference.dot(&axis), gradient), row)
        };
        let [a, b, c] = [Vector3::x(), Vector3::y(), Vector3::z()].map(component);
        ([a.0, b.0, c.0], [a.1, b.1, c.1])
    }

    /// The length read against |R p + t − a| − z.
    fn wire(&self, object: &Object, own: [f64; OF_OBJECT], length_m: f64, p: &Vector3<f64>) -> Seen {
        let from = self.pose.apply(p) - object.place - Vector3::new(own[0], own[1], own[2]);
        let distance = from.norm();
        let u = from / distance;
        let gradient = self.pose.turn.inverse() * u;
        let row = self.row([-u.x, -u.y, -u.z, -1.0], u, p.cross(&gradient));
        one((length_m + object.offset + own[3] - distance, gradient), row)
    }

    /// The direction of the object from where the beam begins against the beam, which ends as far away, on the tangent plane of the
    /// first.
    fn beam(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>, beam: &Vector3<f64>) -> Seen {
        let there = self.pose.back(&(object.place + Vector3::new(own[0], own[1], own[2])));
        let from = there - (p - beam);
        let distance = from.norm();
        let direction = from / distance;
        let axes = tangent_frame(&direction);
        let components = residual::on_tangent_plane(&direction, beam);
        let arm = if self.by == TurnsBy::Prediction { *p } else { there };
        let row = |axis: Vector3<f64>| {
            let outside = self.pose.turn * axis / distance;
            self.row([-outside.x, -outside.y, -outside.z, 0.0], outside, arm.cross(&axis) / distance)
        };
        (components, [row(axes[0]), row(axes[1]), [0.0; WIDTH]])
    }

    /// The direction of the object from the station against the beam, on the tangent plane of the first.
    fn sight(&self, object: &Object, own: [f64; OF_OBJECT], beam: &Vector3<f64>) -> Seen {
        let there = self.pose.back(&(object.place + Vector3::new(own[0], own[1], own[2])));
        let distance = there.norm();
        let direction = there / distance;
        let axes = tangent_frame(&direction);
        let components = residual::on_tangent_plane(&direction, beam);
        let arm = if self.by == TurnsBy::Prediction { beam.normalize() } else { direction };
        let row = |axis: Vector3<f64>| {
            let outside = self.pose.turn * axis / distance;
            self.row([-outside.x, -outside.y, -outside.z, 0.0], outside, arm.cross(&axis))
        };
        (components, [row(axes[0]), row(axes[1]), [0.0; WIDTH]])
    }
}

/// A row of one component.
fn one(component: (f64, Vector3<f64>), row: [f64; WIDTH]) -> Seen {
    let none = (0.0, Vector3::zeros());
    ([component, none, none], [row, [0.0; WIDTH], [0.0; WIDTH]])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use crate::data::unknowns::{Freedom, Known, Shape, Station};

    use super::*;

    const KINDS: [Measure; 7] = [
        Measure::Plane,
        Measure::Target,
        Measure::Fixed,
        Measure::Wire,
        Measure::Distance,
        Measure::Sight,
        Measure::Beam,
    ];

    /// One row, which observes this object from this station.
    fn of_one_row(object: Object, station: Station) -> Unknowns {
        Unknowns { objects: vec![object], stations: vec![station], object: vec![Some(0)], station: vec![0] }
    }

    /// Every derivative against differences of the residual.
    #[test]
    fn derivatives_are_those_of_the_residual() {
        for measure in KINDS {
            let shape = Shape::of(measure).unwrap();
            let object = Object {
                place: Vector3::new(4.0, 7.0, 1.0),
                normal: Vector3::new(0.6, 0.8, 0.0),
                offset: if measure == Measure::Wire { 0.2 } else { 0.0 },
                known: Known::Yes,
                ..Object::unknown("A".to_owned(), shape)
            };
            let station = Station {
                pose: Pose::new(Vector3::new(0.4, -0.7, 0.2), 0.02, 0.3, -0.9),
                known: Known::Yes,
                freedom: Freedom::Free,
                label: "S".to_owned(),
            };
            let unknowns = of_one_row(object, station);
            let first = [unknowns.first_of_stations(), unknowns.first_of_objects()];
            let mut state = vec![0.02, -0.01, 0.03, 0.2, -0.1, 0.3, 0.01, -0.02, 0.03, 0.01];
            state.truncate(unknowns.numbers());
            let there = unknowns.stations[0].pose.back(&unknowns.objects[0].place);
            let eye = Vector3::new(0.6, -0.4, 0.3);
            // Where the row hits what it observes, but for little: derivatives leave out what is as small as the residual.
            let p = match measure {
                Measure::Sight => there.normalize() + Vector3::new(1e-7, 2e-7, -1e-7),
                _ => there,
            };
            let at = |state: &[f64], p: &Vector3<f64>| {
                let length = Measured::Length { length_m: 0.3 };
                let beam = if measure == Measure::Beam { p - eye } else { *p };
                seen(&unknowns, &first, state, 0, measure, &length, p, &beam, TurnsBy::Object).unwrap()
            };
            // The point that the row would have at no residual.
            let p = (0..20).fold(p, |p, _| {
                let (components, _) = at(&state, &p);
                components.iter().fold(p, |p, step| p + to_no_residual(step))
            });
            let p = if measure == Measure::Sight { p.normalize() } else { p };
            let (components, columns) = at(&state, &p);
            let of_station = 6;
            for component in 0..measure.components() {
                for axis in 0..3 {
                    let mut step = Vector3::zeros();
                    step[axis] = 1e-6;
                    let change =
                        at(&state, &(p - step)).0[component].0 - at(&state, &(p + step)).0[component].0;
                    let tangent = components[component].1[axis];
                    assert!((change / 2e-6 - tangent).abs() < 1e-5, "{measure:?} {component} by {axis}");
                }
                for number in 0..state.len() {
                    let moved = |by: f64| {
                        let mut state = state.clone();
                        state[number] += by;
                        at(&state, &p).0[component].0
                    };
                    let change = (moved(-1e-6) - moved(1e-6)) / 2e-6;
                    let column = if number < of_station { OF_OBJECT + number } else { number - of_station };
                    let own = columns[component][column];
                    assert!((change - own).abs() < 1e-5, "{measure:?} {component} {number}: {change} {own}");
                }
            }
        }
    }

    /// A beam that begins at the station is a sight, but for the length of what the chain says.
    #[test]
    fn a_beam_from_the_station_is_a_sight() {
        let object = Object {
            place: Vector3::new(4.0, 7.0, 1.0),
            known: Known::Yes,
            ..Object::unknown("A".to_owned(), Shape::Point)
        };
        let pose = Pose::new(Vector3::new(0.4, -0.7, 0.2), 0.02, 0.3, -0.9);
        let station = Station { pose, known: Known::Yes, ..Station::unknown("S".to_owned()) };
        let there = pose.back(&object.place);
        let unknowns = of_one_row(object, station);
        let first = [unknowns.first_of_stations(), unknowns.first_of_objects()];
        let state = vec![0.0; unknowns.numbers()];
        let sight = (there.normalize() + Vector3::new(2e-5, -3e-5, 1e-5)).normalize();
        let beam = sight * there.norm();
        for by in [TurnsBy::Object, TurnsBy::Prediction, TurnsBy::Adjusted] {
            let at = |measure, p| seen(&unknowns, &first, &state, 0, measure, &Measured::Readings, p, p, by);
            let (sights, of_sight) = at(Measure::Sight, &sight).unwrap();
            let (beams, of_beam) = at(Measure::Beam, &beam).unwrap();
            for component in 0..2 {
                let [(one, by_sight), (other, by_beam)] = [sights[component], beams[component]];
                assert!((one - other).abs() < 1e-15, "{by:?}: {one} {other}");
                let apart = (by_sight - by_beam * there.norm()).norm();
                assert!(apart < 1e-8, "{by:?}: {by_sight} {by_beam}");
                for (one, other) in of_sight[component].iter().zip(of_beam[component]) {
                    assert!((one - other).abs() < 1e-8, "{by:?}: {of_sight:?} {of_beam:?}");
                }
            }
        }
    }

    /// A range takes the point along the beam, past the object or not: nobody measures it, and the residual does not tell of it.
    #[test]
    fn noise_shows_no_range_of_a_sight() {
        let (eye, place) = (Vector3::new(0.6, -0.4, 0.3), Vector3::new(4.0, 7.0, 1.0));
        let label = "A".to_owned();
        let object = Object { place, known: Known::Yes, ..Object::unknown(label, Shape::Point) };
        let pose = Pose::new(Vector3::new(0.4, -0.7, 0.2), 0.02, 0.3, -0.9);
        let station = Station { pose, known: Known::Yes, ..Station::unknown("S".to_owned()) };
        let unknowns = of_one_row(object, station);
        let first = [unknowns.first_of_stations(), unknowns.first_of_objects()];
        let state = vec![0.0; unknowns.numbers()];
        let to = pose.back(&place) - eye;
        let beam = (to.normalize() + Vector3::new(2e-4, -3e-4, 1e-4)).normalize() * to.norm();
        let change = |by| {
            let (measure, measured) = (Measure::Beam, Measured::Readings);
            let of = seen(&unknowns, &first, &state, 0, measure, &measured, &(eye + beam), &beam, by);
            of.unwrap().0.iter().map(|(_, gradient)| gradient.dot(&beam).abs()).fold(0.0, f64::max)
        };
        assert!(change(TurnsBy::Object) > 1e-5, "{}", change(TurnsBy::Object));
        assert!(change(TurnsBy::Adjusted) < 1e-6, "{}", change(TurnsBy::Adjusted));
    }

    /// Where a chain could be larger with all that it observes, derivatives at the object change no row by it, however far off the row
    /// is: those at the prediction do, by as much as the residual.
    #[test]
    fn noise_shows_no_scale() {
        let pose = Pose::new(Vector3::new(0.4, -0.7, 0.2), 0.02, 0.3, -0.9);
        for (measure, normal) in [
            (Measure::Target, Vector3::zeros()),
            (Measure::Fixed, Vector3::zeros()),
            (Measure::Plane, Vector3::y()),
        ] {
            let place = Vector3::new(4.0, 7.0, 1.0);
            let label = "A".to_owned();
            let object = Object {
                place,
                normal,
                known: Known::Yes,
                ..Object::unknown(label, Shape::of(measure).unwrap())
            };
            let station = Station { pose, known: Known::Yes, ..Station::unknown("S".to_owned()) };
            let unknowns = of_one_row(object, station);
            let first = [unknowns.first_of_stations(), unknowns.first_of_objects()];
            let state = vec![0.0; unknowns.numbers()];
            // A row that is off by more than a little, and what its chain would do if all its lengths grew.
            let p = pose.back(&place) + Vector3::new(0.3, -0.2, 0.1);
            let change = |by: TurnsBy| {
                let (components, columns) =
                    seen(&unknowns, &first, &state, 0, measure, &Measured::Readings, &p, &p, by).unwrap();
                let of_object = match measure {
                    // Of a plane its distance grows.
                    Measure::Plane => vec![0.0, 0.0, normal.dot(&place)],
                    _ => place.as_slice().to_vec(),
                };
                let component = |at: usize| {
                    let own: f64 = of_object.iter().zip(&columns[at]).map(|(by, column)| by * column).sum();
                    let of_station: f64 =
                        (0..3).map(|axis| pose.shift[axis] * columns[at][OF_OBJECT + axis]).sum();
                    components[at].1.dot(&p) + own + of_station
                };
                (0..measure.components()).map(|at| component(at).abs()).fold(0.0, f64::max)
            };
            assert!(change(TurnsBy::Object) > 0.1, "{measure:?}: {}", change(TurnsBy::Object));
            assert!(change(TurnsBy::Adjusted) < 1e-12, "{measure:?}: {}", change(TurnsBy::Adjusted));
        }
    }
}
