//! Real instruments: the studies of `examples/` on measured data, with the figures that others found.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};

use fit::{FitOptions, FitResult, Outcome, fit};
use model_core::Chain;
use observe::Observations;
use study::{Plan, Study};
use tables::formats::{DataError, Input};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// A study of `examples/` with its data, or `None` where the data are missing.
fn load(study: &str) -> Option<(Plan, Observations)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples").join(study);
    let folder = path.parent().unwrap();
    let study = Study::from_text(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let chain = std::fs::read_to_string(folder.join(study.chain.get_ref())).unwrap();
    let plan = study.plan(&Chain::from_text(&chain).unwrap()).unwrap();
    let data: PathBuf = folder.join(&plan.sources[0].paths[0]);
    testkit::measured(data.file_name().unwrap().to_str().unwrap())?;
    let mut open = |file: &str| -> Result<Input<'static>, DataError> {
        let bytes = std::fs::read(folder.join(file));
        bytes.map(Input::from).map_err(|error| DataError::Unreadable {
            file: data.display().to_string(),
            why: error.to_string(),
        })
    };
    let observations = plan.load(&mut open).unwrap().observations;
    Some((plan, observations))
}

fn fitted(plan: &Plan, observations: &Observations, options: &FitOptions) -> FitResult {
    let result = fit(&plan.chain, observations, options).unwrap();
    assert!(matches!(result.outcome, Outcome::Converged { .. }), "{:?}", result.outcome);
    result
}

/// The plain fit that the published figures come from: all rows and both components alike.
fn plain(plan: &Plan) -> FitOptions {
    let mut options = plan.fit.clone();
    options.robust = false;
    options.noise.sigma = Some(ARCSEC);
    options
}

/// Holds the RMS of a plain fit, in its unit, to what an independent program has.
fn assert_rms(study: &str, found: f64, reference: f64) {
    assert!((found - reference).abs() <= 1e-7 * reference, "{study}: {found} is not {reference}");
}

/// Sources of the figures: tests/reference/instruments.py, for the chain as it is. What others published or found with the
/// same terms is in the book's page of each instrument.
#[test]
fn mounts_are_as_an_independent_program_has_them() {
    for (study, reference_arcsec) in [
        ("auxtel/auxtel-2022-04.toml", 3.140_977_463),
        ("auxtel/auxtel-2020-03.toml", 22.151_861_384),
        ("iram30m/iram30m-2013-04.toml", 9.770_091_152),
        ("iram30m/iram30m-2013-10.toml", 10.939_516_338),
        ("equatorial/equatorial-a.toml", 557.444_877_347),
        ("equatorial/equatorial-b.toml", 127.095_895_354),
    ] {
        let Some((plan, observations)) = load(study) else { return };
        let result = fitted(&plan, &observations, &plain(&plan));
        assert_eq!(result.rank, 6);
        assert_rms(study, result.rms / ARCSEC, reference_arcsec);
    }
}

#[test]
fn rows_of_one_day_and_source_are_one_group() {
    for study in ["iram30m/iram30m-2013-04.toml", "iram30m/iram30m-2013-10.toml"] {
        let Some((_, observations)) = load(study) else { return };
        assert!(observations.groups.iter().max().unwrap() < &(observations.rows() as u32 / 2));
    }
}

#[test]
fn equatorial_mounts_follow_their_pier_side() {
    for study in ["equatorial/equatorial-a.toml", "equatorial/equatorial-b.toml"] {
        let Some((plan, observations)) = load(study) else { return };
        let result = fitted(&plan, &observations, &plain(&plan));
        // Without the side of the pier the declination's index could not be one number.
        let mut blind = observations.clone();
        let pier = plan.chain.find_symbol("pier").unwrap();
        for (id, values) in &mut blind.poses.columns {
            if *id == pier {
                values.fill(1.0);
            }
        }
        let blind = fitted(&plan, &blind, &plain(&plan));
        assert!(blind.rms > 2.0 * result.rms, "{} against {}", blind.rms / ARCSEC, result.rms / ARCSEC);
    }
}

/// The file's own `error_deg` is the difference without its mean. Sources of the figures: tests/reference/instruments.py.
#[test]
fn encoders_have_one_index() {
    for (study, reference_arcsec) in
        [("encoder/encoder-a.toml", 458.492_412_900), ("encoder/encoder-b.toml", 804.337_931_230)]
    {
        let Some((plan, observations)) = load(study) else { return };
        let result = fitted(&plan, &observations, &plain(&plan));
        let mean = result.residuals.raw.iter().sum::<f64>() / observations.rows() as f64;
        assert_eq!(result.rank, 1);
        assert!((mean / ARCSEC).abs() < 1e-6, "{mean}");
        assert_rms(study, result.rms / ARCSEC, reference_arcsec);
    }
}

/// Sources of the figures: tests/reference/ur10.py; the base and the reflector are found from nothing.
#[test]
fn ur10_geometry_halves_the_error() {
    let Some((plan, observations)) = load("ur10/ur10.toml") else { return };
    let mut nominal = plain(&plan);
    let constant =
        |id: &model_core::SymbolId| plan.chain.symbol(*id).kind == model_core::SymbolKind::Constant;
    nominal.estimate.retain(constant);
    let before = fitted(&plan, &observations, &nominal);
    assert_rms("nominal", before.rms * 1e3, 1.084_598_600);
    let after = fitted(&plan, &observations, &plain(&plan));
    // Combinations that hardly show are left where they were there, and are as small as can be here: that moves the sixth digit.
    assert_eq!(after.rank, 23);
    let calibrated_mm = after.rms * 1e3;
    assert!((calibrated_mm / 0.441_868_528 - 1.0).abs() < 1e-5, "{calibrated_mm}");
    // Axes 2, 3 and 4 are parallel: of their shifts along the axis the data see the sum alone.
    let parallel = plan.chain.find_symbol("dd3").unwrap();
    let at = after.parameters.iter().position(|&id| id == parallel).unwrap();
    assert!(!after.separable[at]);
}
