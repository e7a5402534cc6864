//! Chains and studies for these tests.

use std::path::{Path, PathBuf};

use effects::candidate::{Effect, Setting};
use effects::catalogue::catalogue;
use model_core::{Chain, ObservableId};
use study::{Plan, Study};

/// A scanner or total station: azimuth, elevation and a measured range.
pub const SCANNER: &str = "/// A terrestrial scanner.
chain Scanner {
    body alidade on ground {
        position_error: Rx(level_x), Ry(level_y);
        motion:         Rz(-azimuth);
        motion_error:   Rz(-azimuth_index);
    }
    body telescope on alidade {
        motion:       Rx(elevation);
        motion_error: Rx(elevation_index);
    }
    input range: length;
    observe target: point(0, range, 0) of telescope;
}
";

/// The workspace's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The text of a chain among the examples.
pub fn example(path: &str) -> String {
    std::fs::read_to_string(root().join("examples").join(path)).unwrap()
}

/// A chain and what a study of one of its observables asks for.
pub struct Asked {
    pub plan: Plan,
    pub observables: Vec<ObservableId>,
}

impl Asked {
    /// `more` goes to the end of the study.
    pub fn of(chain: &str, observable: &str, kind: &str, more: &str) -> Self {
        let chain = Chain::from_text(chain).unwrap();
        let observables = vec![chain.find_observable(observable).unwrap()];
        let study = format!(
            "chain = \"c\"\nobservable = \"{observable}\"\ndata = \"d\"\n[observed]\nkind = \"{kind}\"\n{more}"
        );
        let plan = Study::from_text(&study).unwrap().plan(&chain).unwrap();
        Self { plan, observables }
    }

    pub fn setting(&self) -> Setting<'_> {
        self.plan.search.setting(&self.plan.chain, &self.observables)
    }

    pub fn catalogue(&self) -> Vec<Effect> {
        catalogue(&self.setting())
    }
}

/// The mounts that published names belong to.
pub fn mounts() -> [Asked; 3] {
    [
        Asked::of(&example("alt-azimuth/alt-azimuth.chain"), "sight", "direction", ""),
        Asked::of(&example("equatorial/equatorial.chain"), "sight", "direction", ""),
        Asked::of(SCANNER, "target", "point", ""),
    ]
}
