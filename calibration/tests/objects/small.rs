//! Surveys in which objects and stations follow much of every row: intervals of 95 % hold the truth as often as they say.

use std::fmt::Write as _;

use fit::{FitResult, fit};
use nalgebra::Vector3;
use statrs::distribution::{ContinuousCDF, StudentsT};
use study::Plan;

use super::{read, text_of};
use testkit::{Stand, Xorshift};

const ERRORS: [&str; 6] = ["axes_apart", "trunnion", "index", "beam_aside", "collimation", "range_zero"];
/// The noise of a range, m, and of an angle, rad.
type Precision = (f64, f64);
const EVEN: Precision = (0.5e-3, 4e-5);
/// Along a beam much more than across it.
const ALONG: Precision = (1.5e-3, 2e-5);
const RUNS: u64 = 100;
const HEADER: &str = "station,object,azimuth [rad],elevation [rad],range [m]\n";

/// Where the stations stand: x, y, z and the heading.
const STANDS: [[f64; 4]; 4] =
    [[0.2, 0.1, 1.6, 0.4], [4.2, -1.1, 1.5, -2.0], [1.0, 3.9, 1.7, 1.1], [-3.1, 1.7, 0.9, 2.6]];

/// Walls, a floor, a ceiling and two boards: n·x = d.
const WALLS: [([f64; 3], f64); 8] = [
    ([0.0, 0.0, -1.0], 0.0),
    ([-0.01, 0.0, 1.0], 3.4),
    ([0.0, 1.0, 0.0], 7.0),
    ([-0.02, -1.0, 0.0], 5.5),
    ([1.0, -0.03, 0.0], 8.0),
    ([-1.0, 0.0, -0.02], 6.5),
    ([0.6, 0.7, -0.3], 4.9),
    ([-0.5, 0.2, 0.8], 4.6),
];

fn row(
    text: &mut String,
    random: &mut Xorshift,
    (range_m, angle_rad): Precision,
    names: (usize, usize),
    read: [f64; 3],
) {
    let [azimuth, elevation] = [0, 1].map(|at| read[at] + angle_rad * random.normal());
    let range = read[2] + range_m * random.normal();
    writeln!(text, "S{},T{},{azimuth:.9},{elevation:.9},{range:.7}", names.0, names.1).unwrap();
}

/// Forty rows from each station, wherever the beam points, in both faces; with rough places of the stations.
fn walls(random: &mut Xorshift, precision: Precision) -> (String, String) {
    let mut text = HEADER.to_owned();
    let mut stations = "[stations]\n".to_owned();
    for (number, [x, y, z, heading]) in STANDS.into_iter().enumerate() {
        let stand = Stand::new([x, y, z], heading);
        for face in 0..40 {
            let (azimuth, elevation) = (6.3 * random.even(), 2.2 * random.even() - 0.9);
            let level = f64::cos(elevation);
            let beam = Vector3::new(level * azimuth.sin(), level * azimuth.cos(), elevation.sin());
            let along = |(normal, distance): ([f64; 3], f64)| {
                let normal = Vector3::from(normal);
                (distance - normal.dot(&stand.shift)) / normal.dot(&beam)
            };
            let hits = WALLS.into_iter().map(along).enumerate().filter(|(_, along)| *along > 0.0);
            let (wall, range) = hits.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
            let read = stand.read(&(stand.shift + beam * range), face % 2);
            row(&mut text, random, precision, (number, wall), read);
        }
        writeln!(
            stations,
            "S{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\", rough = true }}"
        )
        .unwrap();
    }
    (text, stations)
}

/// Thirty targets, each seen once from three stations, in either face.
fn once(random: &mut Xorshift, precision: Precision) -> (String, String) {
    let mut within = |low: f64, high: f64| low + (high - low) * random.even();
    let places: Vec<Vector3<f64>> =
        (0..30).map(|_| Vector3::new(within(-7.0, 8.0), within(-5.0, 7.0), within(0.0, 3.4))).collect();
    let mut text = HEADER.to_owned();
    for (number, [x, y, z, heading]) in STANDS.into_iter().take(3).enumerate() {
        let stand = Stand::new([x, y, z], heading);
        for (label, place) in places.iter().enumerate() {
            row(&mut text, random, precision, (number, label), stand.read(place, (number + label) % 2));
        }
    }
    (text, String::new())
}

/// A survey of these rows, with these places of stations.
fn fitted(kind: &str, (data, stations): &(String, String)) -> (Plan, FitResult) {
    let study = format!(
        "chain = \"c\"\ndata = \"d\"\n[observed]\nkind = \"{kind}\"\nobject = \"object\"\nstation = \"station\"\n{stations}"
    );
    let (plan, loaded) = read(&text_of("examples/objects/scanner.chain"), &study, data).unwrap();
    let found = fit(&plan.chain, &loaded.observations, &plan.fit).unwrap();
    (plan, found)
}

/// How many of all intervals hold the truth, the root mean square of estimates over their ±, and in how many surveys a row was set
/// aside.
fn held(
    kind: &str,
    precision: Precision,
    scene: fn(&mut Xorshift, Precision) -> (String, String),
) -> (f64, f64, usize) {
    let (mut inside, mut squares, mut spoiled) = (0.0, 0.0, 0);
    for run in 0..RUNS {
        let (plan, found) = fitted(kind, &scene(&mut Xorshift(7000 + 131 * run), precision));
        spoiled += usize::from(!found.set_aside.is_empty());
        for name in ERRORS {
            let id = plan.chain.find_symbol(name).unwrap();
            let at = found.parameters.iter().position(|own| *own == id).unwrap();
            let pull = found.values[id.index()] / found.standard_uncertainty(id).unwrap();
            let free = found.parameter_degrees_of_freedom[at];
            let reach = StudentsT::new(0.0, 1.0, free).unwrap().inverse_cdf(0.975);
            inside += f64::from(u8::from(pull.abs() <= reach));
            squares += pull * pull;
        }
    }
    let count = RUNS as f64 * ERRORS.len() as f64;
    (inside / count, (squares / count).sqrt(), spoiled)
}

#[test]
fn intervals_of_few_rows_before_walls_hold_the_truth() {
    let (inside, ratio, _) = held("plane", EVEN, walls);
    assert!(inside > 0.93 && (0.9..1.12).contains(&ratio), "{inside} {ratio}");
}

#[test]
fn intervals_of_targets_that_are_seen_three_times_hold_the_truth() {
    let (inside, ratio, _) = held("target", EVEN, once);
    assert!(inside > 0.92 && (0.9..1.15).contains(&ratio), "{inside} {ratio}");
}

/// Of rows of which objects follow most, some can always be chosen that agree far better than noise has it.
#[test]
fn rows_whose_noise_is_chance_are_not_set_aside() {
    let (inside, ratio, spoiled) = held("target", ALONG, once);
    assert!(spoiled <= 2, "in {spoiled} of {RUNS} surveys");
    assert!(inside > 0.9 && ratio < 1.25, "{inside} {ratio}");
}

/// Ranges that are a metre off are set aside, and hardly any other row with them.
#[test]
fn rows_that_are_far_off_are_set_aside_alone() {
    let (mut found_wrong, mut found_right) = (0, 0);
    for run in 0..20 {
        let random = &mut Xorshift(5501 + 97 * run);
        let (data, stations) = once(random, ALONG);
        let wrong: Vec<usize> = (0..5).map(|number| 18 * number + run as usize % 18).collect();
        let rows = data.lines().enumerate().map(|(at, line)| {
            let (before, range) = line.rsplit_once(',').unwrap();
            let off = at.checked_sub(1).is_some_and(|at| wrong.contains(&at));
            if off {
                format!("{before},{}\n", range.parse::<f64>().unwrap() + 1.0)
            } else {
                format!("{line}\n")
            }
        });
        let (_, found) = fitted("target", &(rows.collect(), stations));
        let is_wrong = found.set_aside.iter().filter(|own| wrong.contains(&own.row)).count();
        found_wrong += is_wrong;
        found_right += found.set_aside.len() - is_wrong;
    }
    assert!(found_wrong == 100 && found_right <= 10, "{found_wrong} of 100, and {found_right} others");
}
