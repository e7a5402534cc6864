//! Studies and the data that they name, read from the workspace.

use std::path::{Path, PathBuf};

use calibration::calibrate::{Calibration, Request, calibrate};
use model_core::Chain;
use observe::Observations;
use study::{Plan, Study};
use tables::formats::{DataError, Input};

/// The workspace's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A study, ready to calibrate.
pub struct Loaded {
    pub text: String,
    pub plan: Plan,
    pub observations: Observations,
    pub second: Option<Observations>,
}

/// The study file itself.
pub fn study(path: &str) -> Study {
    Study::from_text(&std::fs::read_to_string(root().join(path)).unwrap()).unwrap()
}

/// The observations that a study names, for its plan.
pub fn observations(study: &str, plan: &Plan) -> Observations {
    plan.load(&mut opener(study)).unwrap().observations
}

fn opener(study: &str) -> impl FnMut(&str) -> Result<Input<'static>, DataError> {
    let folder = root().join(study).parent().unwrap().to_owned();
    move |file: &str| Ok(std::fs::read(folder.join(file)).expect("the file is there").into())
}

/// Reads a study; `None` where its data are missing.
pub fn load(path: &str) -> Option<Loaded> {
    let study = study(path);
    let folder = root().join(path).parent().unwrap().to_owned();
    let text = std::fs::read_to_string(folder.join(study.chain.get_ref())).unwrap();
    let chain =
        Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("chain", &text)));
    for file in study.data.get_ref().0.iter().filter_map(|file| file.strip_prefix("../../../shared/data/")) {
        testkit::measured(file)?;
    }
    let plan = study.plan(&chain).unwrap();
    let observations = observations(path, &plan);
    let second = plan.load(&mut opener(path)).unwrap().held_out;
    Some(Loaded { text, plan, observations, second })
}

impl Loaded {
    pub fn calibrate(&self) -> Calibration {
        calibrate(Request {
            text: &self.text,
            plan: &self.plan,
            observations: &self.observations,
            sample: None,
            second: self.second.as_ref(),
            when: "2026-11-21",
        })
        .unwrap()
    }
}

/// Radians as arcseconds.
pub fn arcsec(rad: f64) -> f64 {
    rad.to_degrees() * 3600.0
}
