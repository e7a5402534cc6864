//! The simulated scanner of the examples: its middle encoder sits off centre, and the declaration does not know.
//! What was planted stands in `examples/mobile-lidar/simulate.py`, which shares no code with ours.

use calibration::diagnose::Verdict;
use model_core::Chain;

use crate::data::{Loaded, arcsec, load};

/// Eccentricity planted: cosine and sine of beta, arcsec.
const PLANTED: [f64; 2] = [6.0, 8.0];
/// RMS of two components of the planted noise of 2 arcsec.
const NOISE: f64 = 2.0 * std::f64::consts::SQRT_2;

fn study() -> Loaded {
    load("examples/mobile-lidar/study.toml").expect("the example has its data")
}

#[test]
fn the_eccentric_encoder_is_found_and_the_declaration_amended() {
    let study = study();
    let found = study.calibrate();
    let report = &found.diagnosis;
    assert_eq!(report.verdict, Verdict::Confounded, "{report:#?}");
    let [effect] = report.effects.as_slice() else { panic!("{:#?}", report.effects) };
    assert!(effect.names.iter().any(|name| name == "encoder eccentricity of beta"), "{effect:#?}");
    assert_eq!((effect.body.as_str(), effect.dof.as_str()), ("middle", "Rx"));
    assert!(effect.p_value <= 0.05);
    assert!(effect.selected_in_folds > 0.99);

    // The planted amplitude within four standard uncertainties.
    let amplitude = effect.coefficients.values().map(|c| c * c).sum::<f64>().sqrt();
    let sigma = report
        .errors
        .iter()
        .filter(|error| effect.coefficients.contains_key(&error.name))
        .map(|error| error.standard_uncertainty.unwrap())
        .fold(0.0, f64::max);
    assert!((arcsec(amplitude) - PLANTED[0].hypot(PLANTED[1])).abs() < 4.0 * arcsec(sigma));

    let held_out = arcsec(report.after.held_out_rms.unwrap());
    assert!(held_out < 1.1 * NOISE, "{held_out}");
    assert!(arcsec(report.before.held_out_rms.unwrap()) > 2.0 * held_out);

    // Only lines added, and what comes out is a declaration that means what was fitted.
    let amended = found.amended.as_ref().unwrap();
    let mut lines = amended.lines();
    let is_kept = |line: &&str| lines.any(|own| own == *line);
    assert_eq!(study.text.lines().filter(is_kept).count(), study.text.lines().count(), "{amended}");
    let amended = Chain::from_text(amended).unwrap();
    for observable in [0, 1, 2].map(model_core::ObservableId) {
        let by_text: Vec<String> = amended
            .way(observable)
            .iter()
            .map(|passed| model_core::print::text(&passed.factor.amount, &amended))
            .collect();
        let in_memory: Vec<String> = found
            .chain
            .way(observable)
            .iter()
            .map(|passed| model_core::print::text(&passed.factor.amount, &found.chain))
            .collect();
        assert_eq!(by_text, in_memory);
    }
}
