//! The noise beside unknown targets: along a beam it is that of the range, across it that of the angles times the range.

use fit::fit;
use nalgebra::Vector3;

use super::{read, text_of};
use testkit::{Stand, Xorshift};

const RANGE_M: f64 = 0.5e-3;
const ANGLE_RAD: f64 = 4e-5;
const RUNS: u64 = 40;
/// Twice as many as the rows of which two components each are thirty: whose noise is the smallest, a fit tells only nearly.
const NEAREST: usize = 30;
const STUDY: &str = "chain = \"c\"\ndata = \"d\"\n[observed]\nkind = \"target\"\nobject = \"object\"\nstation = \"station\"\n";
const ERRORS: [&str; 6] = ["axes_apart", "trunnion", "index", "beam_aside", "collimation", "range_zero"];

/// Targets from half a metre to ten, each seen from four places in two faces; and the range of each row.
fn table(random: &mut Xorshift) -> (String, Vec<f64>) {
    let stands = [
        Stand::new([0.0, 0.0, 1.6], 0.4),
        Stand::new([4.2, -1.1, 1.5], -2.0),
        Stand::new([1.0, 3.9, 1.7], 1.1),
        Stand::new([-3.1, 1.7, 0.9], 2.6),
    ];
    let mut within = |low: f64, high: f64| low + (high - low) * random.even();
    let targets: Vec<Vector3<f64>> =
        (0..50).map(|_| Vector3::new(within(-7.0, 8.0), within(-5.0, 7.0), within(0.0, 3.4))).collect();
    let mut text = "station,object,azimuth [rad],elevation [rad],range [m]\n".to_owned();
    let mut ranges = Vec::new();
    for (number, stand) in stands.iter().enumerate() {
        for (label, target) in targets.iter().enumerate() {
            for face in 0..2 {
                let read = stand.read(target, face);
                let [azimuth, elevation] = [0, 1].map(|at| read[at] + ANGLE_RAD * random.normal());
                let range = read[2] + RANGE_M * random.normal();
                text += &format!("S{number},T{label},{azimuth:.9},{elevation:.9},{range:.7}\n");
                ranges.push(read[2]);
            }
        }
    }
    (text, ranges)
}

#[test]
fn noise_along_and_across_a_beam_is_what_it_was_made_and_so_are_the_uncertainties() {
    let chain = text_of("examples/objects/scanner.chain");
    // Of near and of far rows: the square of what was found over what it was made, across and along.
    let mut found_over_made = [[0.0; 2]; 2];
    let mut nearest_over_made = 0.0;
    let mut pulls = [0.0; ERRORS.len()];
    for run in 0..RUNS {
        let (data, ranges) = table(&mut Xorshift(5000 + 131 * run));
        let (plan, loaded) = read(&chain, STUDY, &data).unwrap();
        let result = fit(&plan.chain, &loaded.observations, &plan.fit).unwrap();
        let sigma = result.noise.sigma_without_memory();
        // No row is taken for surer than the nearest are together, which tell what their noise is.
        let mut by_range = ranges.clone();
        by_range.sort_by(f64::total_cmp);
        let known = by_range[NEAREST];
        let nearest = (0..ranges.len()).filter(|&row| ranges[row] < known);
        let ratios = nearest.map(|row| sigma[3 * row + 1] / (ANGLE_RAD * ranges[row]));
        nearest_over_made += ratios.sum::<f64>() / NEAREST as f64 / RUNS as f64;
        for is_far in [false, true] {
            let own = (0..ranges.len()).filter(|&row| (ranges[row] > 3.0) == is_far && ranges[row] >= known);
            let own: Vec<usize> = own.collect();
            let mean = |square: &dyn Fn(usize) -> f64| {
                own.iter().map(|&row| square(row)).sum::<f64>() / own.len() as f64 / RUNS as f64
            };
            let [across, along] = &mut found_over_made[usize::from(is_far)];
            *across += mean(&|row| (sigma[3 * row + 1] / (ANGLE_RAD * ranges[row])).powi(2));
            *along += mean(&|row| (sigma[3 * row + 2] / RANGE_M).powi(2));
        }
        for (pull, name) in pulls.iter_mut().zip(ERRORS) {
            let id = plan.chain.find_symbol(name).unwrap();
            *pull += (result.values[id.index()] / result.standard_uncertainty(id).unwrap()).powi(2);
        }
    }
    for [across, along] in found_over_made {
        assert!(
            (across.sqrt() - 1.0).abs() < 0.05 && (along.sqrt() - 1.0).abs() < 0.05,
            "{found_over_made:?}"
        );
    }
    assert!((0.95..2.0).contains(&nearest_over_made), "{nearest_over_made}");
    // Forty squares of what is normal, of six errors: chi-squared is within these in 999 of 1000 cases each.
    for (pull, name) in pulls.iter().zip(ERRORS) {
        assert!((17.0..77.0).contains(pull), "{name}: {pulls:?}");
    }
    let all: f64 = pulls.iter().sum();
    assert!((175.0..315.0).contains(&all), "{pulls:?}");
}
