//! Whatever frame a fit starts in, the errors are the same, and they are those that were planted.

use calibration::calibrate::{Request, calibrate};
use fit::{Outcome, fit};
use nalgebra::Vector3;
use observe::unknowns::Pose;
use study::Plan;

use super::{example, text_of};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// What `examples/objects/simulate.py` planted.
const PLANTED: [(&str, f64); 6] = [
    ("axes_apart", 0.4e-3),
    ("trunnion", 25.0 * ARCSEC),
    ("index", -30.0 * ARCSEC),
    ("beam_aside", -0.6e-3),
    ("collimation", 40.0 * ARCSEC),
    ("range_zero", 1.5e-3),
];

fn values(plan: &Plan, of: &fit::FitResult) -> Vec<(f64, f64)> {
    let value = |name: &(&str, f64)| {
        let id = plan.chain.find_symbol(name.0).unwrap();
        (of.values[id.index()], of.standard_uncertainty(id).unwrap())
    };
    PLANTED.iter().map(value).collect()
}

/// The whole start moved and turned: the same errors to a thousandth of their uncertainties.
#[test]
fn a_start_that_is_moved_and_turned_gives_the_same_errors() {
    for name in ["targets", "walls"] {
        let (plan, observations) = example(name);
        let at_home = fit(&plan.chain, &observations, &plan.fit).unwrap();
        assert!(matches!(at_home.outcome, Outcome::Converged { .. }), "{name}: {:?}", at_home.outcome);
        let motion = Pose::new(Vector3::new(3.0, -20.0, 7.0), 0.3, -0.2, 2.2);
        let mut moved = observations.clone();
        let unknowns = moved.unknowns.as_mut().unwrap();
        // The ground, which no row names, is the one station that is given.
        for station in unknowns.stations.iter_mut().filter(|station| !station.label.is_empty()) {
            station.pose =
                Pose { turn: motion.turn * station.pose.turn, shift: motion.apply(&station.pose.shift) };
        }
        for object in &mut unknowns.objects {
            object.place = motion.apply(&object.place);
            object.normal = motion.turn * object.normal;
        }
        let away = fit(&plan.chain, &moved, &plan.fit).unwrap();
        assert!(matches!(away.outcome, Outcome::Converged { .. }), "{name}: {:?}", away.outcome);
        for ((one, sigma), (other, _)) in values(&plan, &at_home).into_iter().zip(values(&plan, &away)) {
            assert!((one - other).abs() < 1e-3 * sigma, "{name}: {one} and {other} ± {sigma}");
        }
    }
}

/// The effect that the declaration lacks is found, and with it the errors are those planted, within four uncertainties.
#[test]
fn the_planted_effect_is_found_and_the_errors_are_those_planted() {
    for name in ["targets", "walls"] {
        let (plan, observations) = example(name);
        let text = text_of("examples/objects/scanner.chain");
        let request = Request {
            text: &text,
            plan: &plan,
            observations: &observations,
            sample: None,
            second: None,
            when: "2026-11-22",
        };
        let found = calibrate(request).unwrap();
        let effects = &found.diagnosis.effects;
        assert_eq!(effects.len(), 1, "{name}: {effects:#?}");
        assert!(
            effects[0].names.iter().any(|own| own == "encoder eccentricity of azimuth"),
            "{name}: {effects:#?}"
        );
        let amplitude = effects[0].coefficients.values().map(|c| c * c).sum::<f64>().sqrt();
        assert!((amplitude - 200e-6).abs() < 60e-6, "{name}: {amplitude}");
        for error in &found.diagnosis.errors {
            let Some((_, planted)) = PLANTED.iter().find(|(own, _)| *own == error.name) else { continue };
            let sigma = error.standard_uncertainty.unwrap();
            assert!((error.value - planted).abs() < 4.0 * sigma, "{name}: {error:?}, planted {planted}");
        }
        let (before, after) = (found.diagnosis.before.held_out_rms, found.diagnosis.after.held_out_rms);
        assert!(after.unwrap() < before.unwrap(), "{name}");
        // What a region of the joints would be, nobody knows here; and nobody asked for places.
        assert!(found.diagnosis.after.elsewhere_rms.is_none() && found.diagnosis.next_places.is_empty());
    }
}
