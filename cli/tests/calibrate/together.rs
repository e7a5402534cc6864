//! Readings that are off together, as a trajectory's are: their correlations say what they bring.

use std::fmt::Write;

use insta::assert_snapshot;

use crate::figures::{calibrated, error};
use crate::support::Folder;
use testkit::Random;

/// A fine stage on a coarse one.
const SLIDE: &str = "chain Slide {
    body stage on ground { motion: Tx(coarse), Tx(fine); position_error: Tx(zero); }
    observe tip: point(0, 0, 0) of stage;
}
";

const STUDY: &str = "chain = \"slide.chain\"
data = \"data.csv\"
[columns]
coarse = { column = \"coarse\", unit = \"m\", sigma = \"2 mm\", correlation = { fine = \"rho\" } }
fine   = { column = \"fine\", unit = \"m\", sigma = \"2 mm\" }
[observed]
kind = \"point\"
x = { column = \"x\", unit = \"m\" }
y = { column = \"y\", unit = \"m\" }
z = { column = \"z\", unit = \"m\" }
[search]
functions = false
";

const ROWS: usize = 400;
const SIGMA_M: f64 = 2e-3;
const OWN_M: f64 = 1e-4;
const ZERO_M: f64 = 3e-3;

/// Where one reading is too large by as much as the other is too small, their sum is exact, and such rows say most.
#[test]
fn rows_weigh_as_their_readings_are_off_together() {
    let mut random = Random::new(7);
    let mut data = String::from("coarse,fine,x,y,z,rho\n");
    let (mut sum, mut weights) = (0.0, 0.0);
    for row in 0..ROWS {
        let rho: f64 = [-1.0, -0.5, 0.5, 1.0][row % 4];
        let [a, b] = [random.normal(), random.normal()];
        let off = [SIGMA_M * a, SIGMA_M * (rho * a + (1.0 - rho * rho).sqrt() * b)];
        let truth = [2.0 * random.even(), 0.1 * random.even()];
        let read = [truth[0] + off[0], truth[1] + off[1]];
        let x = truth[0] + truth[1] + ZERO_M + OWN_M * random.normal();
        let [y, z] = [OWN_M * random.normal(), OWN_M * random.normal()];
        writeln!(data, "{},{},{x},{y},{z},{rho}", read[0], read[1]).expect("a string takes all");
        let weight = 1.0 / (OWN_M * OWN_M + 2.0 * SIGMA_M * SIGMA_M * (1.0 + rho));
        sum += weight * (x - read[0] - read[1]);
        weights += weight;
    }
    let folder = Folder::new("together");
    folder.write("slide.chain", SLIDE).write("study.toml", STUDY).write("data.csv", data);
    let [value, sigma] = error(&calibrated(&folder, "study.toml"), "zero");
    let (expected, expected_sigma) = (sum / weights, weights.powf(-0.5));
    assert!((value - expected).abs() < 0.3 * expected_sigma, "{value} m is not {expected} m");
    assert!((sigma / expected_sigma - 1.0).abs() < 0.15, "{sigma} m is not {expected_sigma} m");

    // As if they were off independently, the rows say less by far.
    folder.write("study.toml", STUDY.replace(", correlation = { fine = \"rho\" }", ""));
    let [_, alone] = error(&calibrated(&folder, "study.toml"), "zero");
    assert!(alone > 5.0 * sigma, "{alone} m");
}

/// What `calibrate` says of the study with one place changed.
fn refused(from: &str, to: &str) -> String {
    assert!(STUDY.contains(from), "{from}");
    let folder = Folder::new("together-refused");
    let data = "coarse,fine,x,y,z,rho\n0,0,0,0,0,0.5\n1,0,1,0,0,-1.5\n2,0,2,0,0,0\n";
    folder.write("slide.chain", SLIDE).write("study.toml", STUDY.replace(from, to)).write("data.csv", data);
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{run}");
    run.stderr
}

#[test]
fn correlations_that_are_none() {
    assert_snapshot!(refused("fine = \"rho\"", "fin = \"rho\""));
    assert_snapshot!(refused("fine = \"rho\"", "coarse = \"rho\""));
    assert_snapshot!(refused("fine = \"rho\"", "fine = -1.5"));
    assert_snapshot!(refused("fine = \"rho\"", "fine = true"));
    assert_snapshot!(refused("fine = \"rho\"", "fine = \"rh\""));
    assert_snapshot!(refused("fine = \"rho\"", "fine = \"rho\""));
    let twice = "\"fine\", unit = \"m\", sigma = \"2 mm\", correlation = { coarse = 0.1 }";
    assert_snapshot!(refused("\"fine\", unit = \"m\", sigma = \"2 mm\"", twice));
    assert_snapshot!(refused("\"fine\", unit = \"m\", sigma = \"2 mm\"", "\"fine\", unit = \"m\""));
    let observed = "\"x\", unit = \"m\", correlation = { fine = 0.1 }";
    assert_snapshot!(refused("\"x\", unit = \"m\"", observed));
}

/// Two readings that are off as a third one is are off alike.
#[test]
fn readings_that_hang_together_with_one_hang_together() {
    let folder = Folder::new("together-none");
    let chain = SLIDE.replace("Tx(fine);", "Tx(fine), Tx(finest);");
    let more = "correlation = { fine = 0.9, finest = 0.9 }";
    let study = STUDY.replace("correlation = { fine = \"rho\" }", more);
    let third = |with: &str| {
        format!("finest = {{ column = \"x\", unit = \"m\", sigma = \"2 mm\"{with} }}\n[observed]")
    };
    let run = |with: &str| {
        folder.write("study.toml", study.replace("[observed]", &third(with)));
        folder.trueaxis(&["calibrate", "study.toml", "--format", "json"])
    };
    let data = "coarse,fine,x,y,z\n0,0,0,0,0\n1,0,1,0,0\n2,0,2,0,0\n3,0,3,0,0\n";
    folder.write("slide.chain", chain).write("data.csv", data);
    assert_snapshot!(run("").stderr);
    assert_ne!(run(", correlation = { fine = 0.8 }").code, 2, "that study is right");
}
