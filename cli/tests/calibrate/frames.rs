//! What is seen in the frame of a body that moves itself: a ball on a turntable, touched by a gantry.
//!
//! The table's encoder sits off centre, so that it stands elsewhere than it says. What the gantry then reads has a closed form.

use std::f64::consts::PI;
use std::fmt::Write;

use crate::figures::{calibrated, first_effect, holds};
use crate::support::Folder;
use testkit::Random;

const GANTRY: &str = "chain Gantry {
    body carriage on ground { motion: Tx(x); }
    body bridge on carriage { position_error: Rz(xy); motion: Ty(y); }
    body ram on bridge { motion: Tz(z); }
    body base on ground { position: Tx(0.5), Ty(0.4); position_error: Tx(beside), Ty(before); }
    body table on base { motion: Rz(c); }
    observe touch: point(0, 0, 0) of ram in table;
}
";
const STUDY: &str =
    "chain = \"gantry.chain\"\ndata = \"rows.csv\"\n[observed]\nkind = \"fixed\"\nobject = \"ball\"\n";
const SQUARE_RAD: f64 = 2e-4;
const BESIDE_M: f64 = 4e-4;
const BEFORE_M: f64 = -3e-4;
const OFF_CENTRE_RAD: f64 = 3e-4;

fn rows(random: &mut Random) -> String {
    let mut rows = String::from("ball,x [m],y [m],z [m],c [rad]\n");
    for ball in 0..6 {
        let [radius, angle, height] =
            [0.1 + 0.25 * random.even(), 2.0 * PI * random.even(), 0.3 * random.even()];
        for _ in 0..20 {
            let said = 2.0 * PI * random.even() - PI;
            let stands = said + OFF_CENTRE_RAD * (said - 0.9).sin();
            let [sine, cosine] = [(angle + stands).sin(), (angle + stands).cos()];
            let place = [0.5 + BESIDE_M + radius * cosine, 0.4 + BEFORE_M + radius * sine];
            // The bridge is turned further by SQUARE_RAD: its travel leads off by as much.
            let y = place[1] / SQUARE_RAD.cos();
            let x = place[0] + y * SQUARE_RAD.sin();
            let [x, y, z] = [x, y, height].map(|value| value + 5e-6 * random.normal());
            writeln!(rows, "B{ball},{x:.8},{y:.8},{z:.8},{said:.9}").expect("a string");
        }
    }
    rows
}

#[test]
fn what_carries_the_frame_is_searched_as_well() {
    let folder = Folder::new("in-the-table");
    folder.write("gantry.chain", GANTRY).write("study.toml", STUDY);
    let mut more = 0;
    for seed in 1..=6 {
        folder.write("rows.csv", rows(&mut Random::new(seed)));
        let report = calibrated(&folder, "study.toml");
        more += report["effects"].as_array().map_or(0, Vec::len) - 1;
        assert!(
            first_effect(&report).contains("encoder eccentricity of c"),
            "{seed}: {}",
            first_effect(&report)
        );
        holds(&report, &[("xy", SQUARE_RAD), ("beside", BESIDE_M), ("before", BEFORE_M)]);
        let held_out = |when: &str| report[when]["held_out_rms"].as_f64().expect("a number");
        assert!(
            held_out("after") < 0.3 * held_out("before"),
            "{seed}: {} {}",
            held_out("before"),
            held_out("after")
        );
    } // One in twenty is a false alarm.
    assert!(more <= 1, "{more} effects more");
}
