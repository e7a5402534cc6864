//! The bias that an effect which the data cannot show puts into the declared errors: what the report says, against a fit of
//! simulated data that have the effect.

use calibration::calibrate::{Calibration, Request, calibrate};
use model_core::{Chain, SymbolId};
use observe::{Measure, Measured, direction_from_spherical, tangent_frame};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use study::Study;

use crate::data::root;
use crate::simulated::observed_alone;

const ARCSEC: f64 = std::f64::consts::PI / 180.0 / 3600.0;

/// An alt-azimuth mount between 35° and 55° of elevation, `droop` times the cotangent of the elevation added to it.
fn calibrated(droop: f64) -> Calibration {
    let text = std::fs::read_to_string(root().join("examples/alt-azimuth/alt-azimuth.chain")).unwrap();
    let chain = Chain::from_text(&text).unwrap();
    let study = "chain = \"c\"\ndata = \"d\"\n[observed]\nkind = \"direction\"\n[fit]\nrobust = false\n\
                 [noise]\nvariance = false\nserial = false\n[search]\nfalse_alarm = 1e-6\n[hold_out]\nfolds = 2\n";
    let plan = Study::from_text(study).unwrap().plan(&chain).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let ids = ["azimuth", "elevation"].map(|name| chain.find_symbol(name).unwrap());
    let mut columns: Vec<(SymbolId, Vec<f64>)> = ids.iter().map(|&id| (id, Vec::new())).collect();
    let mut measured = Vec::new();
    let rows = 120;
    for _ in 0..rows {
        let azimuth: f64 = random.random_range(-3.1..3.1);
        let elevation: f64 = random.random_range(35.0_f64..55.0).to_radians();
        columns[0].1.push(azimuth);
        columns[1].1.push(elevation);
        let aim = direction_from_spherical(azimuth, elevation + droop / elevation.tan());
        let [across, along] = tangent_frame(&aim);
        let mut noise = || 5.0 * ARCSEC * random.sample::<f64, _>(StandardNormal);
        measured.push(Measured::Direction((aim + across * noise() + along * noise()).normalize()));
    }
    let observations = observed_alone(&chain, "sight", Measure::Direction, columns, measured);
    calibrate(Request {
        text: &text,
        plan: &plan,
        observations: &observations,
        sample: None,
        second: None,
        when: "2026-11-21",
    })
    .unwrap()
}

#[test]
fn an_effect_that_does_not_show_shifts_the_errors_as_the_report_says() {
    let (plain, shifted) = (calibrated(0.0), calibrated(2.0 * ARCSEC));
    for found in [&plain, &shifted] {
        assert!(found.diagnosis.effects.is_empty(), "{:?}", found.diagnosis.effects);
    }
    let hidden =
        plain.diagnosis.not_shown.iter().find(|effect| effect.name == "refraction, cot of elevation");
    let hidden = hidden.expect("over so few degrees it does not show");
    assert!(hidden.absorbed > 0.95, "{hidden:?}");
    let largest = hidden.mistaken_for.values().copied().fold(0.0, f64::max);
    assert!(largest > 0.5, "{hidden:?}");
    let error = |found: &Calibration, name: &str| {
        found.diagnosis.errors.iter().find(|error| error.name == name).unwrap().value
    };
    for name in
        ["elevation_index", "azimuth_index", "collimation", "nonperpendicularity", "tilt_east", "tilt_north"]
    {
        let shift = (error(&shifted, name) - error(&plain, name)).abs();
        let said = hidden.mistaken_for.get(name).copied().unwrap_or(0.0) * 2.0 * ARCSEC;
        // What is told starts at a twentieth of the largest.
        assert!(
            (shift - said).abs() < 0.06 * largest * 2.0 * ARCSEC,
            "{name}: {shift} where {said} was said"
        );
    }
    let index = error(&shifted, "elevation_index") - error(&plain, "elevation_index");
    let said = hidden.mistaken_for["elevation_index"] * 2.0 * ARCSEC;
    assert!((index.abs() - said).abs() < 1e-3 * said, "{index} where {said} was said");
}
