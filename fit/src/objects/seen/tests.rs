//! What one row makes of what is unknown, held to differences and to what it must not show.

#![allow(clippy::unwrap_used)]

use observe::unknowns::{Known, Shape, Station};

use super::*;

const KINDS: [Measure; 9] = [
    Measure::Plane,
    Measure::Target,
    Measure::Fixed,
    Measure::Wire,
    Measure::Distance,
    Measure::Sight,
    Measure::Beam,
    Measure::Circle,
    Measure::Ring,
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
            offset: if matches!(measure, Measure::Wire | Measure::Circle) { 0.2 } else { 0.0 },
            known: Known::Yes,
            ..Object::unknown("A".to_owned(), shape)
        };
        let station = Station {
            pose: Pose::new(Vector3::new(0.4, -0.7, 0.2), 0.02, 0.3, -0.9),
            known: Known::Yes,
            ..Station::unknown("S".to_owned())
        };
        let unknowns = of_one_row(object, station);
        let first = [unknowns.first_of_stations(), unknowns.first_of_objects()];
        let mut state = vec![0.02, -0.01, 0.03, 0.2, -0.1, 0.3, 0.01, -0.02, 0.03, 0.01, -0.02, 0.04];
        state.truncate(unknowns.numbers());
        let there = unknowns.stations[0].pose.back(&unknowns.objects[0].place);
        let eye = Vector3::new(0.6, -0.4, 0.3);
        // Where the row hits what it observes, but for little: derivatives leave out what is as small as the residual.
        let p = match measure {
            Measure::Sight => there.normalize() + Vector3::new(1e-7, 2e-7, -1e-7),
            // Off the centre, where a circle has no way out.
            Measure::Circle | Measure::Ring => there + Vector3::new(0.2, -0.1, 0.1),
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
                let change = at(&state, &(p - step)).0[component].0 - at(&state, &(p + step)).0[component].0;
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
            // What a row determines is asked by the beam, of a sight by the object.
            let most = if by == TurnsBy::Prediction { 1e-4 } else { 1e-8 };
            let apart = (by_sight - by_beam * there.norm()).norm();
            assert!(apart < most, "{by:?}: {by_sight} {by_beam}");
            for (one, other) in of_sight[component].iter().zip(of_beam[component]) {
                assert!((one - other).abs() < most, "{by:?}: {of_sight:?} {of_beam:?}");
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
    assert!(change(TurnsBy::Prediction) < 1e-15, "{}", change(TurnsBy::Prediction));
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
