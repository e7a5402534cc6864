//! What acts on the line of sight: refraction on a mount of which no joint counts from the horizon, on one whose elevation does, and
//! none where there is no air. The stars are those of `examples/refraction/simulate.py`, which shares no code with ours.

use model_core::{Chain, exact};

use crate::data::{arcsec, load};

/// The names of the effects that were found, and the RMS of held-out rows before and after, arc seconds.
fn found(study: &str) -> (calibration::calibrate::Calibration, Vec<String>, [f64; 2]) {
    let found = load(study).unwrap().calibrate();
    let rms =
        [&found.diagnosis.before, &found.diagnosis.after].map(|rms| arcsec(rms.held_out_rms_kept.unwrap()));
    let names = found.diagnosis.effects.iter().map(|effect| effect.names[0].clone()).collect();
    println!("{study}: {names:?}, held out {rms:?} arcsec");
    (found, names, rms)
}

#[test]
fn an_equatorial_mount_shows_refraction_and_its_declaration_says_so() {
    let (found, names, [before, after]) = found("examples/refraction/stars.toml");
    assert_eq!(names, ["refraction, tangent of the zenith distance"]);
    // The noise of each row is 1 arcsec in either direction.
    assert!(before > 20.0 && after < 1.7, "{before} {after}");
    let refraction = found.diagnosis.effects[0].coefficients["refraction"];
    assert!((arcsec(refraction).abs() - 58.2).abs() < 1.5, "{}", arcsec(refraction));
    let amended = found.amended.unwrap();
    assert!(amended.contains("input zenith: angle = between(sky, up);"), "{amended}");
    assert!(amended.contains("bent up by refraction*tan(zenith);"), "{amended}");
    let chain = Chain::from_text(&amended).unwrap();
    // What was written bends as what was fitted.
    let bent = |chain: &Chain| {
        let mut values = chain.nominal_values();
        for (name, value) in [("ha", 0.6), ("dec", 0.4), ("refraction", 3e-4), ("collimation", 2e-4)] {
            values[chain.find_symbol(name).unwrap().index()] = value;
        }
        exact::error(chain, chain.find_observable("sky").unwrap(), &values)
    };
    assert!((bent(&chain) - bent(&found.chain)).norm() < 1e-16 && bent(&chain).norm() > 1e-4);
}

#[test]
fn without_air_nothing_is_found() {
    let (found, names, _) = found("examples/refraction/clean.toml");
    assert!(names.is_empty(), "{names:?}");
    assert!(!found.amended.unwrap().contains("bent"));
}

#[test]
fn on_an_altitude_refraction_is_the_cotangent_of_the_joint() {
    let (found, names, [_, after]) = found("examples/refraction/alt-azimuth.toml");
    assert_eq!(names[0], "refraction, cot of elevation");
    assert!(after < 1.7, "{after}");
    assert!(found.amended.unwrap().contains("Rx(refraction_cot_elevation*cot(elevation))"));
}
