//! Where to put a station or a target next: what is promised is what comes of it, and more than another place gives.

use calibration::calibrate::{Request, calibrate};
use calibration::design::{Addition, Criterion, PlaceProposal};
use calibration::fit::fit;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::{read, text_of};

/// The scanner of `examples/objects/scanner.chain` without errors, where it stands: written out here, so that nothing of the
/// project says where a beam ends.
#[derive(Clone)]
struct Stand {
    turn: Matrix3<f64>,
    shift: Vector3<f64>,
}

impl Stand {
    fn new(shift: [f64; 3], heading: f64) -> Self {
        let (sine, cosine) = heading.sin_cos();
        let turn = Matrix3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0);
        Self { turn, shift: Vector3::from(shift) }
    }

    /// Azimuth, elevation and range of a point in either face.
    fn read(&self, point: &Vector3<f64>, face: usize) -> [f64; 3] {
        let local = self.turn.transpose() * (point - self.shift);
        let (azimuth, elevation) = (local.x.atan2(local.y), (local.z / local.norm()).asin());
        let pi = std::f64::consts::PI;
        match face {
            0 => [azimuth, elevation, local.norm()],
            _ => [azimuth + if azimuth > 0.0 { -pi } else { pi }, pi - elevation, local.norm()],
        }
    }
}

/// Numbers that look random, of variance one.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        // Source: G. Marsaglia, Xorshift RNGs, Journal of Statistical Software 8 (2003).
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

const RANGE_M: f64 = 0.5e-3;
const ANGLE_RAD: f64 = 4e-5;

fn targets() -> Vec<Vector3<f64>> {
    let mut random = Noise(7);
    let mut within = |low: f64, high: f64| low + (high - low) * random.uniform();
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

/// A table of every target in two faces from every stand.
fn table(stands: &[Stand], targets: &[Vector3<f64>], random: &mut Noise) -> String {
    let mut text = "station,object,azimuth [rad],elevation [rad],range [m]\n".to_owned();
    for (from, stand) in stands.iter().enumerate() {
        for (number, target) in targets.iter().enumerate() {
            for face in 0..2 {
                let [azimuth, elevation, range] = stand.read(target, face);
                let noisy = [
                    azimuth + ANGLE_RAD * random.normal(),
                    elevation + ANGLE_RAD * random.normal(),
                    range + RANGE_M * random.normal(),
                ];
                text += &format!("S{from},T{number},{:.9},{:.9},{:.7}\n", noisy[0], noisy[1], noisy[2]);
            }
        }
    }
    text
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
fn usual_sigma(stands: &[Stand], targets: &[Vector3<f64>]) -> [f64; 6] {
    let all: Vec<[f64; 6]> =
        (0..15).map(|draw| sigma(&table(stands, targets, &mut Noise(1000 + 77 * draw)))).collect();
    std::array::from_fn(|at| {
        let mut own: Vec<f64> = all.iter().map(|one| one[at]).collect();
        own.sort_by(f64::total_cmp);
        own[7]
    })
}

fn proposals(next: &str) -> Vec<PlaceProposal> {
    let text = text_of("examples/objects/scanner.chain");
    let data = table(&stands(), &targets(), &mut Noise(1));
    let (plan, loaded) = read(&text, &format!("{STUDY}{next}"), &data).unwrap();
    let request = Request {
        text: &text,
        plan: &plan,
        observations: &loaded.observations,
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

#[test]
fn a_station_gives_what_it_promises_and_more_than_a_second_setting_up_at_an_old_one() {
    let (stands, targets) = (stands(), targets());
    let ranges = "[next]\nstations = 1\nrange = { range = [\"0.5 m\", \"20 m\"] }\nplace = { x = [\"-2 m\", \"9 m\"], y = \
                  [\"-6 m\", \"8 m\"] }\n";
    let now = usual_sigma(&stands, &targets);
    let again = usual_sigma(&[&stands[..], &[stands[1].clone()]].concat(), &targets);
    for proposal in proposals(ranges) {
        assert_eq!(proposal.adds, Addition::Station);
        let [place] = &proposal.places[..] else { panic!("{proposal:#?}") };
        assert_eq!(place.pointings.len(), 32);
        let stand = Stand::new(in_room(place.place_m), place.heading_rad.unwrap());
        let then = usual_sigma(&[&stands[..], std::slice::from_ref(&stand)].concat(), &targets);
        for ((name, [before, after]), (now, then)) in
            ERRORS.iter().zip(promised(&proposal)).zip(now.iter().zip(&then))
        {
            // Standard uncertainties from some 200 residuals scatter by a twentieth.
            assert!((before / now - 1.0).abs() < 0.25, "{name}: {before} said, {now} usual");
            let [said, came] = [after / before, then / now];
            assert!((said / came - 1.0).abs() < 0.1, "{name}: {said} of it said, {came} came");
        }
        if proposal.criterion == Criterion::D {
            assert!(volume(&then) < volume(&again) - 0.1, "{then:?} there, {again:?} at an old place");
        }
        // Where a pointing aims is where the beam ends.
        for pointing in &place.pointings {
            let number: usize = pointing.object[1..].parse().unwrap();
            let [azimuth, elevation, range] = [0, 1, 2].map(|at| pointing.readings[at]);
            let faces = [0, 1].map(|face| stand.read(&targets[number], face));
            let near = |face: &[f64; 3]| {
                let turn = std::f64::consts::TAU;
                let azimuth = (face[0] - azimuth + turn / 2.0).rem_euclid(turn) - turn / 2.0;
                azimuth.abs() < 0.01 && (face[1] - elevation).abs() < 0.01 && (face[2] - range).abs() < 0.02
            };
            assert!(faces.iter().any(near), "{pointing:?}, {faces:?}");
        }
    }
}

#[test]
fn a_target_gives_what_it_promises_and_more_than_one_beside_an_old_one() {
    let (stands, targets) = (stands(), targets());
    let next = "[next]\nobjects = { target = 2 }\nplace = { x = [\"-4 m\", \"9 m\"] }\n\
                range = { range = [\"0.3 m\", \"20 m\"], elevation = [\"-90 deg\", \"270 deg\"] }\n";
    let now = usual_sigma(&stands, &targets);
    let beside = usual_sigma(&stands, &[&targets[..], &targets[..2]].concat());
    for proposal in proposals(next) {
        assert_eq!((proposal.adds, proposal.places.len()), (Addition::Target, 2));
        let new = proposal.places.iter().map(|place| Vector3::from(in_room(place.place_m)));
        let then = usual_sigma(&stands, &targets.iter().copied().chain(new).collect::<Vec<_>>());
        for ((name, [before, after]), (now, then)) in
            ERRORS.iter().zip(promised(&proposal)).zip(now.iter().zip(&then))
        {
            let [said, came] = [after / before, then / now];
            assert!((said / came - 1.0).abs() < 0.1, "{name}: {said} of it said, {came} came");
        }
        if proposal.criterion == Criterion::D {
            assert!(volume(&then) < volume(&beside) - 0.1, "{then:?} there, {beside:?} beside old ones");
        }
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

/// A rotation of the product's own, beside the one that is written out above.
#[test]
fn the_stand_turns_as_a_heading_does() {
    let own = Rotation3::from_euler_angles(0.0, 0.0, 0.7);
    assert!((own.matrix() - Stand::new([0.0; 3], 0.7).turn).norm() < 1e-12);
}
