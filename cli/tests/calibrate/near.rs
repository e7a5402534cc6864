//! A target close to a scanner whose noise across the beam is that of its angles.
//!
//! All targets stand at the scanner's height, where what a beam aside and askew does to the two faces has a closed form: an azimuth
//! that is off by aside / range − askew, the other way round in the second face.

use std::f64::consts::PI;
use std::fmt::Write;

use crate::figures::{calibrated, error};
use crate::support::Folder;
use testkit::Random;

const SCANNER: &str = "chain Scanner {
    body alidade on ground { motion: Rz(-azimuth); }
    body mirror on alidade { motion: Rx(elevation); }
    body beam on mirror { position_error: Tx(beam_aside), Rz(collimation); }
    input range: length;
    observe hit: point(0, range, 0) of beam;
}
";
const STUDY: &str =
    "chain = \"scanner.chain\"\ndata = \"rows.csv\"\n[observed]\nkind = \"target\"\nobject = \"object\"\n";

const ASIDE_M: f64 = 0.3e-3;
const ARCSEC: f64 = PI / 648_000.0;
const ASKEW: f64 = 20.0 * ARCSEC;
const TARGETS: usize = 31;

/// Every target twice in two faces, the first half a metre away.
fn rows(random: &mut Random) -> String {
    let mut rows = String::from("object,azimuth [rad],elevation [rad],range [m]\n");
    for target in 0..TARGETS {
        let range = if target == 0 { 0.5 } else { 3.0 + 9.0 * random.even() };
        let azimuth = 2.0 * PI * random.even() - PI;
        for face in [1.0, -1.0, 1.0, -1.0] {
            let (turned, elevation) = if face < 0.0 { (PI, PI) } else { (0.0, 0.0) };
            let off = face * (ASIDE_M / range - ASKEW);
            let [across, up] = [(); 2].map(|()| 8.0 * ARCSEC * random.normal());
            let along = 0.5e-3 * random.normal();
            let (azimuth, elevation) = (azimuth - off + turned + across, elevation + up);
            writeln!(rows, "T{target},{azimuth:.9},{elevation:.9},{:.6}", range + along).expect("a string");
        }
    }
    rows
}

#[test]
fn a_near_target_does_not_decide_by_a_noise_that_nothing_tells() {
    let folder = Folder::new("near-target");
    folder.write("scanner.chain", SCANNER).write("study.toml", STUDY);
    for seed in 1..=12 {
        folder.write("rows.csv", rows(&mut Random::new(seed)));
        let report = calibrated(&folder, "study.toml");
        for (name, planted) in [("beam_aside", ASIDE_M), ("collimation", ASKEW)] {
            let [value, sigma] = error(&report, name);
            assert!((value - planted).abs() < 4.0 * sigma, "{seed}: {name} {value} ± {sigma}, not {planted}");
        }
        // Without the near target the others would tell 55 µm: noise of 8 arc seconds, in four rows each. By a noise next to nothing it
        // would tell 2 µm; the ± itself is known to a fifth.
        let [_, sigma] = error(&report, "beam_aside");
        assert!((15e-6..80e-6).contains(&sigma), "{seed}: {sigma}");
    }
}
