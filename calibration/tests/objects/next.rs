//! Where to put a station or a target next: what is promised is what comes of it, and more than another place gives.

use calibration::calibrate::{Request, calibrate};
use calibration::design::{Addition, Criterion, Place, PlaceProposal, Pointing};
use fit::fit;
use nalgebra::{DMatrix, Matrix3, Vector3};

use super::{read, text_of};
use testkit::{Stand, Xorshift, rotation};

/// Noise along a beam and across it, whatever the range.
const ALONG_M: f64 = 0.5e-3;
const ACROSS_M: f64 = 0.4e-3;

fn targets() -> Vec<Vector3<f64>> {
    let mut random = Xorshift(7);
    let mut within = |low: f64, high: f64| low + (high - low) * random.even();
    // A corner of the room alone.
    (0..16).map(|_| Vector3::new(within(2.0, 8.0), within(-5.0, 7.0), within(0.0, 3.0))).collect()
}

fn stands() -> Vec<Stand> {
    vec![
        Stand::new([0.0, 0.0, 1.6], 0.0),
        Stand::new([1.5, -1.1, 1.5], 1.3),
        Stand::new([1.0, 2.9, 1.7], -2.2),
    ]
}

/// A row to simulate: from which stand at which target, and in which face.
type Aimed = (usize, usize, usize);

/// Every target in two faces from every stand.
fn every(stands: usize, targets: usize) -> Vec<Aimed> {
    let at =
        move |stand: usize| (0..targets).flat_map(move |target| [0, 1].map(|face| (stand, target, face)));
    (0..stands).flat_map(at).collect()
}

fn table(stands: &[Stand], targets: &[Vector3<f64>], rows: &[Aimed], random: &mut Xorshift) -> String {
    let mut text = "station,object,azimuth [rad],elevation [rad],range [m]\n".to_owned();
    for &(stand, target, face) in rows {
        let [azimuth, elevation, range] = stands[stand].read(&targets[target], face);
        let noisy = [
            azimuth + ACROSS_M / (range * elevation.cos()) * random.normal(),
            elevation + ACROSS_M / range * random.normal(),
            range + ALONG_M * random.normal(),
        ];
        text += &format!("S{stand},T{target},{:.9},{:.9},{:.7}\n", noisy[0], noisy[1], noisy[2]);
    }
    text
}

/// The rows of a proposal, whose stands or targets are those behind the others.
fn aimed(proposal: &PlaceProposal, stands: usize, targets: usize) -> Vec<Aimed> {
    let number = |label: &str, new: usize| label.get(1..).map_or(new, |number| number.parse().unwrap());
    let of_place = |(at, place): (usize, &Place)| {
        let aimed = |pointing: &Pointing| {
            let face = usize::from(pointing.readings[1] > std::f64::consts::FRAC_PI_2);
            (number(&pointing.station, stands + at), number(&pointing.object, targets + at), face)
        };
        place.pointings.iter().map(aimed).collect::<Vec<_>>()
    };
    proposal.places.iter().enumerate().flat_map(of_place).collect()
}

const STUDY: &str = "chain = \"c\"\ndata = \"d\"\n[observed]\nkind = \"target\"\nobject = \"object\"\nstation = \"station\"\n\
                     [noise]\nvariance = false\n[search]\neffects = [\"range scale\"]\n";

const ERRORS: [&str; 6] = ["axes_apart", "trunnion", "index", "beam_aside", "collimation", "range_zero"];

/// The standard uncertainties of a table's fit.
fn sigma(data: &str) -> [f64; 6] {
    let (plan, loaded) = read(&text_of("examples/objects/scanner.chain"), STUDY, data).unwrap();
    let found = fit(&plan.chain, &loaded.observations, &plan.fit).unwrap();
    ERRORS.map(|name| found.standard_uncertainty(plan.chain.find_symbol(name).unwrap()).unwrap())
}

/// At the median of some draws of the noise.
fn usual_sigma(stands: &[Stand], targets: &[Vector3<f64>], rows: &[Aimed]) -> [f64; 6] {
    let all: Vec<[f64; 6]> =
        (0..15).map(|draw| sigma(&table(stands, targets, rows, &mut Xorshift(1000 + 77 * draw)))).collect();
    std::array::from_fn(|at| {
        let mut own: Vec<f64> = all.iter().map(|one| one[at]).collect();
        own.sort_by(f64::total_cmp);
        own[7]
    })
}

/// Where the beam ends in the scanner's frame; the errors in the order of [`ERRORS`].
fn point(errors: &[f64], [azimuth, elevation, range]: [f64; 3]) -> Vector3<f64> {
    let p = rotation(2, errors[4]) * Vector3::new(0.0, range + errors[5], 0.0)
        + Vector3::new(errors[3], 0.0, 0.0);
    let p =
        rotation(1, errors[1]) * rotation(0, elevation + errors[2]) * p + Vector3::new(0.0, errors[0], 0.0);
    rotation(2, -azimuth) * p
}

/// The standard uncertainties of the errors by one large matrix, the first stand being the frame.
fn by_matrices(stands: &[Stand], targets: &[Vector3<f64>], rows: &[Aimed]) -> [f64; 6] {
    let numbers = 6 + 6 * (stands.len() - 1) + 3 * targets.len();
    let mut matrix = DMatrix::zeros(3 * rows.len(), numbers);
    for (row, &(stand, target, face)) in rows.iter().enumerate() {
        let (own, read) = (&stands[stand], stands[stand].read(&targets[target], face));
        let seen = |numbers: &[f64; 15]| {
            let turn = rotation(0, numbers[9]) * rotation(1, numbers[10]) * rotation(2, numbers[11]);
            let shift = Vector3::from_column_slice(&numbers[6..9]);
            let there = targets[target] + Vector3::from_column_slice(&numbers[12..15]);
            own.turn * turn * point(&numbers[..6], read) + own.shift + shift - there
        };
        let beam = (own.turn * point(&[0.0; 6], read)).normalize();
        let white =
            (Matrix3::identity() - beam * beam.transpose()) / ACROSS_M + beam * beam.transpose() / ALONG_M;
        for number in 0..15 {
            let column = match number {
                0..6 => number,
                6..12 if stand == 0 => continue,
                6..12 => 6 * stand + number - 6,
                _ => 6 * stands.len() + 3 * target + number - 12,
            };
            let [mut less, mut more] = [[0.0; 15]; 2];
            (less[number], more[number]) = (-1e-5, 1e-5);
            let change = white * (seen(&more) - seen(&less)) / 2e-5;
            (0..3).for_each(|axis| matrix[(3 * row + axis, column)] = change[axis]);
        }
    }
    let covariance = (matrix.transpose() * matrix).try_inverse().unwrap();
    std::array::from_fn(|at| covariance[(at, at)].sqrt())
}

fn proposals(next: &str) -> Vec<PlaceProposal> {
    let text = text_of("examples/objects/scanner.chain");
    let (stands, targets) = (stands(), targets());
    let data = table(&stands, &targets, &every(stands.len(), targets.len()), &mut Xorshift(1));
    let (plan, loaded) = read(&text, &format!("{STUDY}{next}"), &data).unwrap();
    let request = Request {
        text: &text,
        plan: &plan,
        observations: &loaded.observations,
        sample: None,
        second: None,
        when: "2026-11-22",
    };
    calibrate(request).unwrap().diagnosis.next_places
}

fn promised(proposal: &PlaceProposal) -> Vec<[f64; 2]> {
    let own = |name: &&str| {
        let found = proposal.uncertainties.iter().find(|(own, ..)| own == name).unwrap();
        [found.1, found.2]
    };
    ERRORS.iter().map(own).collect()
}

/// Sum of the logarithms: what D-optimal additions make small, but for correlations.
fn volume(sigma: &[f64]) -> f64 {
    sigma.iter().map(|sigma| sigma.ln()).sum()
}

/// From the frame of the report to that of the room: the first station is where the frame is.
fn in_room(place: [f64; 3]) -> [f64; 3] {
    let first = &stands()[0];
    (first.turn * Vector3::from(place) + first.shift).into()
}

/// Stands, targets, and which is aimed at from which.
type SetUp = (Vec<Stand>, Vec<Vector3<f64>>, Vec<Aimed>);

/// What comes of a proposal against what it promised, by one large matrix and by fits, and against as many rows elsewhere.
fn holds(proposal: &PlaceProposal, now: &SetUp, then: &SetUp, elsewhere: &SetUp) {
    let [is_now, is_then, is_elsewhere] =
        [now, then, elsewhere].map(|(stands, targets, rows)| by_matrices(stands, targets, rows));
    let all = promised(proposal);
    for (at, [before, after]) in all.iter().enumerate() {
        let (said, came) = (after / before, is_then[at] / is_now[at]);
        // The noise of the study is estimated, along as across to a twentieth.
        assert!((said / came - 1.0).abs() < 0.07, "{}: {said} of it said, {came} came", ERRORS[at]);
    }
    let said: f64 = all.iter().map(|[before, after]| (after / before).ln()).sum();
    let of_fits = |(stands, targets, rows): &SetUp| volume(&usual_sigma(stands, targets, rows));
    let came = of_fits(then) - of_fits(now);
    // Of six errors, each from residuals of its own.
    assert!((said - came).abs() < 6.0 * 0.1, "{said} said, {came} came of fits");
    if proposal.criterion == Criterion::D {
        let [there, elsewhere] = [is_then, is_elsewhere].map(|own| volume(&own) - volume(&is_now));
        assert!(there < 1.2 * elsewhere && elsewhere < 0.0, "{there} there, {elsewhere} elsewhere");
    }
}

#[test]
fn a_station_gives_what_it_promises_and_more_than_a_second_setting_up_at_an_old_one() {
    let (stands, targets) = (stands(), targets());
    let next = "[next]\nstations = 1\nrange = { range = [\"0.5 m\", \"20 m\"] }\nplace = { x = [\"-2 m\", \"9 m\"], y = \
                [\"-6 m\", \"8 m\"] }\n";
    let rows = every(stands.len(), targets.len());
    let now = (stands.clone(), targets.clone(), rows.clone());
    let again = [&stands[..], &[stands[1].clone()]].concat();
    let elsewhere = (again.clone(), targets.clone(), every(again.len(), targets.len()));
    let proposals = proposals(next);
    assert_eq!(proposals.len(), 2);
    for proposal in proposals {
        assert_eq!(proposal.adds, Addition::Station);
        let [place] = &proposal.places[..] else { panic!("{proposal:#?}") };
        let stand = Stand::new(in_room(place.place_m), place.heading_rad.unwrap());
        let more = aimed(&proposal, stands.len(), targets.len());
        let then = [&stands[..], std::slice::from_ref(&stand)].concat();
        holds(&proposal, &now, &(then, targets.clone(), [&rows[..], &more].concat()), &elsewhere);
        // Where a pointing aims is where the beam ends.
        for (pointing, (_, target, face)) in place.pointings.iter().zip(more) {
            let read = stand.read(&targets[target], face);
            let away = [0, 1, 2].map(|at| read[at] - pointing.readings[at]);
            let turn = std::f64::consts::TAU;
            let azimuth = (away[0] + turn / 2.0).rem_euclid(turn) - turn / 2.0;
            assert!(
                azimuth.abs() < 0.01 && away[1].abs() < 0.01 && away[2].abs() < 0.02,
                "{pointing:?}, {read:?}"
            );
        }
    }
}

#[test]
fn a_target_gives_what_it_promises_and_more_than_one_beside_an_old_one() {
    let (stands, targets) = (stands(), targets());
    let next = "[next]\nobjects = { target = 2 }\nplace = { x = [\"-4 m\", \"9 m\"] }\n\
                range = { range = [\"0.3 m\", \"20 m\"], elevation = [\"-90 deg\", \"270 deg\"] }\n";
    let rows = every(stands.len(), targets.len());
    let now = (stands.clone(), targets.clone(), rows.clone());
    let again = [&targets[..], &targets[..2]].concat();
    let elsewhere = (stands.clone(), again.clone(), every(stands.len(), again.len()));
    let proposals = proposals(next);
    assert_eq!(proposals.len(), 2);
    for proposal in proposals {
        assert_eq!((proposal.adds.name(), proposal.places.len()), ("target", 2));
        let new = proposal.places.iter().map(|place| Vector3::from(in_room(place.place_m)));
        let then: Vec<_> = targets.iter().copied().chain(new).collect();
        let more = aimed(&proposal, stands.len(), targets.len());
        holds(&proposal, &now, &(stands.clone(), then, [&rows[..], &more].concat()), &elsewhere);
    }
}

/// One pointing says where a target is, and nothing else.
#[test]
fn a_target_that_is_seen_once_gives_nothing() {
    for proposal in proposals("[next]\nposes = 1\nobjects = { target = 1 }\n") {
        for ([before, after], name) in promised(&proposal).into_iter().zip(ERRORS) {
            assert!((after / before - 1.0).abs() < 1e-3, "{name}: {before}, {after}");
        }
    }
}
