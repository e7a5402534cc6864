//! The simulated scanner of the examples: one thing is missing in its declaration.

use crate::data::{arcsec, load};

pub fn show(study: &str) {
    let Some(study) = load(study) else { return };
    let t = std::time::Instant::now();
    let found = study.calibrate();
    println!("--- {:?}", t.elapsed());
    let r = &found.report;
    println!("{:?} rows {} used {}", r.verdict, r.observations.rows, r.observations.used);
    for e in &r.effects {
        println!("  {} | {:?} | class {:?} | rivals {:?} | p {} folds {} {:?}", e.text, e.names, e.class, e.rivals, e.p_value, e.selected_in_folds, e.coefficients.values().map(|v| arcsec(*v)).collect::<Vec<_>>());
    }
    let h = |x: Option<f64>| x.map_or(f64::NAN, arcsec);
    println!("  before {:.3} held {:.3} after {:.3} held {:.3}  [arcsec or m/4.85e-6]", arcsec(r.before.rms), h(r.before.held_out_rms), arcsec(r.after.rms), h(r.after.held_out_rms));
    println!("  {:?} rank {} of {}; {:?}  floor {:?} serial {:?} var {}", found.before.outcome, found.before.rank, found.before.parameters.len(), found.after.outcome, found.after.noise.floor, found.after.noise.serial, found.after.noise.variance.is_some());
}

#[test]
fn all() {
    for study in std::env::var("STUDIES").unwrap().split(',') {
        println!("{study}");
        show(study);
    }
}
