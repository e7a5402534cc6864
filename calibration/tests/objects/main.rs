//! Objects and places that nobody knows.
//!
//! Data are made by NumPy scripts that share no code with ours: `examples/objects/simulate.py` (a scanner in a room, with one
//! effect that its declaration lacks) and `tests/reference/objects_rank.py` (the paper's scanner from four stations, with
//! the ranks that it found).
#![allow(clippy::unwrap_used)]

mod frames;
mod next;
mod noise;
mod refused;
mod ridge;
mod small;
mod starts;
mod visible;

use std::path::{Path, PathBuf};

use model_core::Chain;
use observe::Observations;
use study::{Loaded, Plan, Study};
use tables::formats::DataError;

/// The workspace's root.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn text_of(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// A study, of a chain and a table of data that are at hand as texts.
fn read(chain: &str, study: &str, data: &str) -> Result<(Plan, Loaded), DataError> {
    let chain = Chain::from_text(chain).unwrap();
    let plan = Study::from_text(study)
        .unwrap()
        .plan(&chain)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render("study", study)));
    let loaded = plan.load(&mut |_| Ok(data.as_bytes().to_vec().into()))?;
    Ok((plan, loaded))
}

/// A study of `examples/objects`.
fn example(name: &str) -> (Plan, Observations) {
    let [study, data] = ["toml", "csv"].map(|ending| text_of(&format!("examples/objects/{name}.{ending}")));
    let (plan, loaded) = read(&text_of("examples/objects/scanner.chain"), &study, &data).unwrap();
    (plan, loaded.observations)
}
