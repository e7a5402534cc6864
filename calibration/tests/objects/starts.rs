//! What a fit determines is told where it ended, with the noise that is left there: not where it began, and not by rows that it set
//! aside.

use std::fmt::Write as _;

use fit::{FitResult, fit};
use model_core::Chain;
use nalgebra::Vector3;
use study::{Plan, Study};

use super::text_of;
use testkit::{Stand, Xorshift};

const ERRORS: [&str; 6] = ["axes_apart", "trunnion", "index", "beam_aside", "collimation", "range_zero"];
const RANGE_M: f64 = 0.4e-3;
const ANGLE_RAD: f64 = 2e-5;
const HEADER: &str = "station,object,azimuth [rad],elevation [rad],range [m]\n";

/// Where the stations stand: x, y, z and the heading.
const STANDS: [[f64; 4]; 4] =
    [[0.2, 0.1, 1.6, 0.4], [2.9, -1.1, 1.5, -2.0], [1.0, 2.4, 1.7, 1.1], [-2.1, 1.7, 1.2, 2.6]];

/// The walls of a room, its floor and its ceiling: n·x = d.
const WALLS: [([f64; 3], f64); 6] = [
    ([1.0, 0.0, 0.0], 6.0),
    ([-1.0, 0.02, 0.0], 5.0),
    ([0.0, 1.0, 0.03], 6.5),
    ([0.05, -1.0, 0.0], 5.5),
    ([0.0, 0.0, -1.0], 0.0),
    ([0.02, 0.0, 1.0], 3.5),
];

/// The rows of one station before walls, in either face.
fn walls(random: &mut Xorshift, number: usize, rows: usize) -> String {
    let [x, y, z, heading] = STANDS[number];
    let stand = Stand::new([x, y, z], heading);
    let mut text = String::new();
    for row in 0..rows {
        let wall = row % WALLS.len();
        let (normal, distance) = WALLS[wall];
        let normal = Vector3::from(normal);
        // Towards the wall, and up to a right angle aside.
        let aside = Vector3::new(random.normal(), random.normal(), random.normal()) * 0.5;
        let beam = normal.normalize() + aside;
        let beam = if beam.dot(&normal) > 0.2 { beam } else { normal };
        let along = (distance - normal.dot(&stand.shift)) / normal.dot(&beam);
        let read = stand.read(&(stand.shift + beam * along), row % 2);
        let [azimuth, elevation] = [0, 1].map(|at| read[at] + ANGLE_RAD * random.normal());
        let range = read[2] + RANGE_M * random.normal();
        writeln!(text, "S{number},W{wall},{azimuth:.9},{elevation:.9},{range:.7}").unwrap();
    }
    text
}

/// The rows of all stations before twelve targets, in both faces, the first row that of the first target from the first station.
fn targets(random: &mut Xorshift) -> (String, Vec<Vector3<f64>>) {
    let mut within = |low: f64, high: f64| low + (high - low) * random.even();
    let places: Vec<Vector3<f64>> =
        (0..12).map(|_| Vector3::new(within(-20.0, 22.0), within(-25.0, 20.0), within(-2.0, 9.0))).collect();
    let mut text = String::new();
    for (number, [x, y, z, heading]) in STANDS.into_iter().enumerate() {
        let stand = Stand::new([x, y, z], heading);
        for (label, place) in places.iter().enumerate() {
            for face in 0..2 {
                let read = stand.read(place, face);
                let [azimuth, elevation] = [0, 1].map(|at| read[at] + ANGLE_RAD * random.normal());
                let range = read[2] + RANGE_M * random.normal();
                writeln!(text, "S{number},T{label},{azimuth:.9},{elevation:.9},{range:.7}").unwrap();
            }
        }
    }
    (text, places)
}

fn study(kind: &str, more: &str) -> String {
    format!(
        "chain = \"c\"\ndata = \"d\"\n[observed]\nkind = \"{kind}\"\nobject = \"object\"\nstation = \"station\"\n{more}"
    )
}

fn fitted(study: &str, chain: &str, data: &str, lengths: &str) -> (Plan, FitResult) {
    let plan = Study::from_text(study).unwrap().plan(&Chain::from_text(chain).unwrap()).unwrap();
    let mut open = |name: &str| {
        let text = if name == "lengths" { lengths } else { data };
        Ok(text.as_bytes().to_vec().into())
    };
    let loaded = plan.load(&mut open).unwrap();
    let found = fit(&plan.chain, &loaded.observations, &plan.fit).unwrap();
    assert!(found.outcome.is_usable(), "{:?}", found.outcome);
    (plan, found)
}

/// Estimate and ± of the errors.
fn estimates(plan: &Plan, found: &FitResult, errors: &[&str]) -> Vec<[f64; 2]> {
    let of = |name: &&str| {
        let id = plan.chain.find_symbol(name).unwrap();
        let uncertainty =
            found.standard_uncertainty(id).unwrap_or_else(|| panic!("{name} is without its uncertainty"));
        [found.values[id.index()], uncertainty]
    };
    errors.iter().map(of).collect()
}

/// Stations up to half a metre and five degrees from where they are said to stand: at the start all rows are off by that, and beside a
/// noise of that size nothing is determined.
#[test]
fn rough_starts_determine_what_good_ones_do() {
    let chain = text_of("examples/objects/scanner.chain");
    for run in 0..4 {
        let random = &mut Xorshift(9000 + 77 * run);
        let data: String = HEADER.to_owned() + &(0..4).map(|at| walls(random, at, 60)).collect::<String>();
        let mut stations = |off_m: f64, off_rad: f64| {
            let mut text = "[stations]\n".to_owned();
            for (number, [x, y, z, heading]) in STANDS.into_iter().enumerate() {
                let mut off = |size: f64| size * (2.0 * random.even() - 1.0);
                let [x, y, z] = [x, y, z].map(|value| value + off(off_m));
                let heading = heading + off(off_rad);
                writeln!(
                    text,
                    "S{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\", rough = true }}"
                )
                .unwrap();
            }
            text
        };
        let (good, rough) = (stations(0.01, 0.001), stations(0.5, 0.09));
        let [good, rough] = [good, rough].map(|stations| {
            let (plan, found) = fitted(&study("plane", &stations), &chain, &data, "");
            assert_eq!(found.rank, ERRORS.len(), "run {run}: {:?}", found.values);
            estimates(&plan, &found, &ERRORS)
        });
        for (name, ([good, sure], [rough, _])) in ERRORS.iter().zip(good.iter().zip(&rough)) {
            // Robust weights have bottoms near each other; none is further off than a part of the ±.
            assert!((good - rough).abs() < 0.1 * sure, "run {run}, {name}: {good} and {rough} ± {sure}");
            assert!(good.abs() < 4.5 * sure, "run {run}, {name}: {good} ± {sure}");
        }
    }
}

/// A single known length tells the scale of the ranges. Its own noise nobody can tell from one row: it is not taken for exact.
#[test]
fn a_single_length_has_the_noise_of_the_ranges() {
    let chain = text_of("examples/objects/scanner.chain");
    let chain = chain.replace("Ty(range_zero)", "Ty(range_zero), Ty(range_scale*range)");
    assert!(chain.contains("range_scale"), "{chain}");
    let errors: Vec<&str> = ERRORS.into_iter().chain(["range_scale"]).collect();
    for (count, stated) in [(1, false), (1, true), (5, false), (5, true)] {
        let (mut pulls, mut of_scale) = (0.0, 0.0);
        let runs = 12;
        for run in 0..runs {
            let random = &mut Xorshift(31 + 1013 * run);
            let (rows, places) = targets(random);
            let pairs = [[0, 6], [1, 7], [2, 8], [3, 9], [4, 10]];
            let first = STANDS[0];
            let stand = Stand::new([first[0], first[1], first[2]], first[3]);
            let mut lengths = format!(
                "station,from,object,azimuth [rad],elevation [rad],range [m],length [m]{}\n",
                if stated { ",sigma [mm]" } else { "" }
            );
            for [from, to] in &pairs[..count] {
                let read = stand.read(&places[*from], 0);
                let [azimuth, elevation] = [0, 1].map(|at| read[at] + ANGLE_RAD * random.normal());
                let range = read[2] + RANGE_M * random.normal();
                let length = (places[*from] - places[*to]).norm();
                let sigma = if stated { ",0.5" } else { "" };
                writeln!(
                    lengths,
                    "S0,T{from},T{to},{azimuth:.9},{elevation:.9},{range:.7},{length:.7}{sigma}"
                )
                .unwrap();
            }
            let sigma = if stated { "sigma = { column = \"sigma\" }\n" } else { "" };
            let more = format!(
                "[[also]]\ndata = \"lengths\"\n{sigma}[also.observed]\nkind = \"distance\"\nobject = \"object\"\n\
                 station = \"station\"\nlength = \"length\"\n"
            );
            let (plan, found) =
                fitted(&study("target", &more), &chain, &(HEADER.to_owned() + &rows), &lengths);
            for (name, [value, sure]) in errors.iter().zip(estimates(&plan, &found, &errors)) {
                pulls += (value / sure).powi(2);
                assert!(value.abs() < 5.0 * sure, "{count} {stated}, run {run}, {name}: {value} ± {sure}");
            }
            // Of a length of twenty metres, half a millimetre at best.
            let [value, scale] = estimates(&plan, &found, &["range_scale"])[0];
            assert!((3e-6..1e-4).contains(&scale), "{count} {stated}, run {run}: {scale}");
            of_scale += (value / scale).powi(2);
        }
        // Chi-squared of 84 and of 12 are within these in 999 of 1000 cases each.
        assert!((48.0..131.0).contains(&pulls), "{count} {stated}: {pulls}");
        assert!((2.0..33.0).contains(&of_scale), "{count} {stated}: {of_scale}");
    }
}

/// All rows of one station are far off, and set aside: nobody knows what they would have told.
#[test]
fn rows_that_are_set_aside_make_nothing_surer() {
    let chain = text_of("examples/objects/scanner.chain");
    let random = &mut Xorshift(271);
    let (rows, _) = targets(random);
    // The last station counts elevation from the other side in one face.
    let spoiled: String = rows
        .lines()
        .enumerate()
        .map(|(at, line)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if cells[0] == "S3" && at % 2 == 1 {
                let elevation: f64 = cells[3].parse().unwrap();
                cells[3] = (std::f64::consts::PI - elevation).to_string();
            }
            cells.join(",") + "\n"
        })
        .collect();
    let without: String =
        rows.lines().filter(|line| !line.starts_with("S3")).map(|line| format!("{line}\n")).collect();
    let [spoiled, without] = [spoiled, without].map(|rows| {
        let (plan, found) = fitted(&study("target", ""), &chain, &(HEADER.to_owned() + &rows), "");
        assert_eq!(found.rank, ERRORS.len());
        estimates(&plan, &found, &ERRORS)
    });
    for (name, ([one, sure], [other, as_sure])) in ERRORS.iter().zip(spoiled.iter().zip(&without)) {
        assert!((0.7..1.6).contains(&(sure / as_sure)), "{name}: {sure} and {as_sure}");
        assert!((one - other).abs() < as_sure.max(*sure), "{name}: {one} and {other} ± {as_sure}");
    }
}

/// One sight of seven bears the label of another target: it alone is set aside.
#[test]
fn a_row_with_the_label_of_another_target_takes_no_others_with_it() {
    let chain = text_of("examples/objects/scanner.chain");
    let (rows, _) = targets(&mut Xorshift(8081));
    let labels = |line: &str| line.starts_with("S3,T5,");
    let mut rows: Vec<String> =
        rows.lines().filter(|line| !labels(line)).map(|line| format!("{line}\n")).collect();
    let wrong = rows.iter().position(|line| line.starts_with("S1,T2,")).unwrap();
    rows[wrong] = rows[wrong].replace("T2", "T5");
    let (plan, found) = fitted(&study("target", ""), &chain, &(HEADER.to_owned() + &rows.concat()), "");
    let aside: Vec<usize> = found.set_aside.iter().map(|own| own.row).collect();
    assert_eq!(aside, [wrong]);
    for (name, [value, sure]) in ERRORS.iter().zip(estimates(&plan, &found, &ERRORS)) {
        assert!(value.abs() < 4.0 * sure, "{name}: {value} ± {sure}");
    }
}
