//! What one row makes of what is unknown, held to differences and to what it must not show; and the table as a whole.

#![allow(clippy::unwrap_used)]

use nalgebra::Vector3;

use super::residual::Part;
use super::seeing::to_no_residual;
use super::*;
use crate::unknowns::{Known, OF_OBJECT, Object, Pose, State, Station, Unknowns, WIDTH};

/// The components of a row that observes an object, and their derivatives by what is unknown.
type Seen = (Vec<Part>, Vec<[f64; WIDTH]>);

/// One row compared.
fn seen(
    unknowns: &Unknowns,
    numbers: &[f64],
    measure: Measure,
    measured: &Measured,
    p: &Vector3<f64>,
    beam: &Vector3<f64>,
    turns_by: TurnsBy,
) -> Result<Seen, Mismatch> {
    let m = measure.components();
    let state = State::new(unknowns, numbers);
    let rows = Rows {
        count: 1,
        predicted: p.as_slice(),
        measured: Some(std::slice::from_ref(measured)),
        unknown: Some(Unknown { state: &state, start: 0, turns_by }),
        beams: Some(beam.as_slice()),
    };
    let (mut residual, mut gradient) = (vec![f64::NAN; m], vec![f64::NAN; 3 * m]);
    let (mut defined, mut unknown) = (Vec::new(), Vec::new());
    let (of_residual, of_gradient) = (&mut residual[..], &mut gradient[..]);
    let mut to = Compared {
        residual: of_residual,
        defined: &mut defined,
        gradient: of_gradient,
        unknown: &mut unknown,
    };
    (measure.kind().compare)(&rows, &mut to)?;
    assert_eq!((defined, unknown.len()), (vec![true], m), "{measure:?}");
    let gradients = gradient.chunks_exact(3).map(Vector3::from_column_slice);
    Ok((residual.into_iter().zip(gradients).collect(), unknown))
}

/// Every kind says as much as its components need, and no two are written alike.
#[test]
fn the_table_is_whole() {
    assert_eq!(Measure::ALL.len(), KINDS.len());
    for (at, measure) in Measure::ALL.iter().enumerate() {
        let kind = measure.kind();
        assert_eq!(*measure as usize, at);
        assert!((1..=MOST).contains(&kind.components.len()), "{measure:?}");
        assert_eq!(kind.bare.bare(), kind.bare, "{measure:?}");
        assert!(!kind.bare.observes_object(), "{measure:?}");
        assert_eq!((kind.thing)(true).is_some(), measure.observes_object(), "{measure:?}");
        assert!(!kind.written.is_empty(), "{measure:?}");
        if let Some(map) = kind.map {
            assert!(kind.components.len() > 1 && (map.place)(&Measured::Readings).is_none(), "{measure:?}");
        }
    }
    let expected = [
        "direction",
        "spherical",
        "offset",
        "point",
        "range",
        "plane",
        "target",
        "fixed",
        "circle",
        "sphere",
        "wire",
        "distance",
        "sight",
        "orientation",
        "pixel",
    ];
    assert_eq!(*NAMES, expected);
    assert_eq!((headers("azimuth").first(), headers("radius").first()), (Some(&"azimuth"), None));
    for names in [&[][..], &["radius"], &["azimuth"], &["ha"], &["azimuth", "elevation"], &["length"]] {
        for shows_two in [false, true] {
            for of in [Observes::Direction, Observes::Point, Observes::Orientation] {
                let asked = Asked { names: &|key| names.contains(&key), shows_two };
                let meant = ways().filter(|(_, way)| way.of == of && (way.is_meant)(&asked));
                let mut meant: Vec<&str> = meant.map(|(_, way)| way.name).collect();
                let known: Vec<&&str> = NAMES
                    .iter()
                    .filter(|name| ways().any(|(_, way)| way.of == of && way.name == **name))
                    .collect();
                meant.sort_unstable();
                let count = meant.len();
                meant.dedup();
                assert_eq!((meant.len(), count), (known.len(), known.len()), "{names:?} {of:?}: {meant:?}");
            }
        }
    }
}

/// What is measured otherwise than the series says, and what observes no object, is refused; poses alone leave no residual.
#[test]
fn rows_of_another_kind_are_refused_and_poses_leave_nothing() {
    let predicted = [0.3, -0.2, 0.6, 0.1, 0.9, -0.4, 0.2, 0.5, 0.7];
    for &measure in Measure::ALL {
        let kind = measure.kind();
        let vectors = kind.predicted.vectors();
        let m = measure.components();
        let compared = |measured: Option<&[Measured]>| {
            let rows =
                Rows { count: 1, predicted: &predicted[..3 * vectors], measured, unknown: None, beams: None };
            let (mut residual, mut gradient) = (vec![f64::NAN; m], vec![f64::NAN; 3 * vectors * m]);
            let (mut defined, mut unknown) = (Vec::new(), Vec::new());
            let (of_residual, of_gradient) = (&mut residual[..], &mut gradient[..]);
            let mut to = Compared {
                residual: of_residual,
                defined: &mut defined,
                gradient: of_gradient,
                unknown: &mut unknown,
            };
            (kind.compare)(&rows, &mut to)?;
            assert!(gradient.iter().all(|part| part.is_finite()), "{measure:?}");
            Ok(residual)
        };
        assert_eq!(compared(Some(&[Measured::Readings])), Err(Mismatch { row: 0 }), "{measure:?}");
        match compared(None) {
            Err(mismatch) => assert!(measure.observes_object(), "{measure:?}: {mismatch}"),
            Ok(residual) => {
                assert!(residual.iter().all(|own| own.abs() < 1e-15), "{measure:?}: {residual:?}")
            }
        }
    }
}

/// One row, which observes this object from this station.
fn of_one_row(object: Object, station: Station) -> Unknowns {
    Unknowns { objects: vec![object], stations: vec![station], object: vec![Some(0)], station: vec![0] }
}

/// Every derivative against differences of the residual.
#[test]
fn derivatives_are_those_of_the_residual() {
    for measure in Measure::ALL.iter().copied().filter(|own| own.observes_object()) {
        let shape = measure.shape().unwrap();
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
            seen(&unknowns, state, measure, &length, p, &beam, TurnsBy::Object).unwrap()
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
    let state = vec![0.0; unknowns.numbers()];
    let sight = (there.normalize() + Vector3::new(2e-5, -3e-5, 1e-5)).normalize();
    let beam = sight * there.norm();
    for by in [TurnsBy::Object, TurnsBy::Prediction, TurnsBy::Adjusted] {
        let at = |measure, p| seen(&unknowns, &state, measure, &Measured::Readings, p, p, by);
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
    let state = vec![0.0; unknowns.numbers()];
    let to = pose.back(&place) - eye;
    let beam = (to.normalize() + Vector3::new(2e-4, -3e-4, 1e-4)).normalize() * to.norm();
    let change = |by| {
        let (measure, measured) = (Measure::Beam, Measured::Readings);
        let of = seen(&unknowns, &state, measure, &measured, &(eye + beam), &beam, by);
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
        let object =
            Object { place, normal, known: Known::Yes, ..Object::unknown(label, measure.shape().unwrap()) };
        let station = Station { pose, known: Known::Yes, ..Station::unknown("S".to_owned()) };
        let unknowns = of_one_row(object, station);
        let state = vec![0.0; unknowns.numbers()];
        // A row that is off by more than a little, and what its chain would do if all its lengths grew.
        let p = pose.back(&place) + Vector3::new(0.3, -0.2, 0.1);
        let change = |by: TurnsBy| {
            let (components, columns) =
                seen(&unknowns, &state, measure, &Measured::Readings, &p, &p, by).unwrap();
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
