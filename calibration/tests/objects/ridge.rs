//! Walls whose robust fit comes to a ridge: between two rows of which either may be the one that is wrong, steps are tiny at first.
//!
//! `ridge.csv` is run 433 of `benches/blind/objects.py` (walls, nothing planted), which said what was drawn.

use fit::{Outcome, fit};

use super::{read, text_of};

const STUDY: &str = r#"
chain = "scanner.chain"
data  = "ridge.csv"
[observed]
kind    = "plane"
object  = "object"
station = "station"
[stations]
A = { x = "-0.084 m", y = "-0.385 m", z = "1.063 m", roll = "-0.0017 rad", pitch = "-0.0119 rad", heading = "-2.0446 rad", rough = true }
B = { x = "4.002 m", y = "-0.682 m", z = "0.944 m", roll = "0.0002 rad", pitch = "0.0011 rad", heading = "-1.1961 rad", rough = true }
C = { x = "0.994 m", y = "4.284 m", z = "1.544 m", roll = "-0.0027 rad", pitch = "0.0009 rad", heading = "-0.8961 rad", rough = true }
D = { x = "-3.467 m", y = "1.509 m", z = "0.728 m", roll = "0.0002 rad", pitch = "-0.0012 rad", heading = "0.8721 rad", rough = true }
"#;

const DRAWN: [(&str, f64); 6] = [
    ("axes_apart", -0.685e-3),
    ("beam_aside", -0.621e-3),
    ("range_zero", 0.406e-3),
    ("trunnion", 187.4e-6),
    ("index", 58.1e-6),
    ("collimation", 53.5e-6),
];

#[test]
fn a_fit_goes_on_where_a_ridge_lets_it_creep() {
    let chain = text_of("examples/objects/scanner.chain");
    let (plan, loaded) = read(&chain, STUDY, &text_of("calibration/tests/objects/ridge.csv")).unwrap();
    let found = fit(&plan.chain, &loaded.observations, &plan.fit).unwrap();
    assert!(matches!(found.outcome, Outcome::Converged { .. }), "{:?}", found.outcome);
    for (name, drawn) in DRAWN {
        let id = plan.chain.find_symbol(name).unwrap();
        let (value, sigma) = (found.values[id.index()], found.standard_uncertainty(id).unwrap());
        assert!((value - drawn).abs() < 3.0 * sigma, "{name}: {value} ± {sigma}, drawn {drawn}");
    }
}
