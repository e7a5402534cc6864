//! A scanner on a vehicle whose trajectory is off, as files would hold it.
//!
//! The rows follow each other along a path, as those of a drive do. What the scanner shows is worked out here, by rotations of the
//! test's own.

use std::f64::consts::TAU;
use std::fmt::Write;

use serde_json::Value;

use crate::figures::{calibrated, number};
use crate::support::Folder;
use testkit::{Random, turned};

type Point = [f64; 3];

/// Boresight about x, y, z, rad; lever arm across and ahead, m; lateness, s.
const BORESIGHT_RAD: Point = [1.5e-3, -2.0e-3, 2.5e-3];
const LEVER_M: [f64; 2] = [0.012, -0.020];
const LATE_S: f64 = 4e-3;

/// Normals and distances: a road, four walls, a roof, a gable, a bank.
const PLANES: [(&str, Point, f64); 8] = [
    ("road", [0.0, 0.0, 1.0], 0.0),
    ("north", [0.0, -1.0, 0.0], -40.0),
    ("south", [0.02, 1.0, 0.0], -40.0),
    ("east", [-1.0, 0.03, 0.0], -42.0),
    ("west", [1.0, 0.05, 0.0], -42.0),
    ("roof", [0.3, -0.2, -1.0], -25.0),
    ("gable", [-0.7, -0.7, -0.2], -45.0),
    ("bank", [0.6, -0.5, 0.6], -30.0),
];

/// Standard deviations by which poses are off: east, north, up, m; heading, pitch, roll, rad.
const OFF: [f64; 6] = [0.01, 0.01, 0.015, 3e-4, 1e-4, 1e-4];

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|at| a[at] * b[at]).sum()
}

/// Rows of a drive, but for the few that see nothing.
pub const ROWS: i32 = 900;

/// How the poses of a drive are off.
pub struct Off {
    /// What neighbours share is forgotten after so many rows; none: each row is off by itself.
    pub remembered: Option<f64>,
    /// How many times as far as usual a row's pose is off.
    pub times: fn(i32) -> f64,
    /// What the rows say of it, as a share of what there is.
    pub stated: f64,
}

/// A drive of three rounds; the encoder of the mirror sits off centre by this angle. Each row says how uncertain its pose is.
pub fn drive(seed: u64, off: &Off, off_centre_rad: f64) -> String {
    let mut random = Random::new(seed);
    let (rows, remembered) = (ROWS, off.remembered);
    let mut text =
        "wall,east [m],north [m],up [m],heading [rad],pitch [rad],roll [rad],way [m],angle [rad],range [m],\
                    s_east,s_north,s_up,s_heading,s_pitch,s_roll\n"
            .to_owned();
    let keep = remembered.map_or(0.0, |rows| (-1.0 / rows).exp());
    let mut drift: [f64; 6] = std::array::from_fn(|_| random.normal());
    for row in 0..rows {
        drift = drift.map(|own| keep * own + (1.0 - keep * keep).sqrt() * random.normal());
        let t = 3.0 * TAU * f64::from(row) / f64::from(rows);
        let heading = (25.0 * t.cos()).atan2(40.0 * (2.0 * t).cos());
        let speed = 8.0 + 6.0 * (3.0 * t).sin() + random.even();
        let pose = [
            25.0 * t.sin(),
            20.0 * (2.0 * t).sin(),
            0.5 + 0.1 * random.normal(),
            heading,
            0.03 * random.normal(),
            0.03 * random.normal(),
        ];
        let angle = TAU * (random.even() - 0.5);
        let to_ground = |point| turned(2, -heading, turned(0, pose[4], turned(1, pose[5], point)));
        let beam = turned(1, angle, [0.0, 0.0, 1.0]);
        let [x, y, z] = BORESIGHT_RAD;
        let beam = to_ground(turned(0, x, turned(1, y, turned(2, z, beam))));
        let place = to_ground([LEVER_M[0], -0.4 + LEVER_M[1] + LATE_S * speed, 1.8]);
        let origin = [0, 1, 2].map(|at| pose[at] + place[at]);
        let seen = PLANES.iter().filter_map(|&(name, normal, distance)| {
            let along = (distance - dot(normal, origin)) / dot(normal, beam);
            (along > 1.0).then_some((along, name))
        });
        let Some((along, name)) = seen.min_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        let sigma = OFF.map(|sigma| sigma * (off.times)(row));
        let read = [0, 1, 2, 3, 4, 5].map(|at| format!("{:.6}", pose[at] + sigma[at] * drift[at])).join(",");
        let stated = sigma.map(|sigma| format!("{:.3e}", off.stated * sigma)).join(",");
        let angle = angle - off_centre_rad * (angle - 0.5).sin();
        let range = along + 0.003 * random.normal();
        writeln!(text, "{name},{read},{speed:.3},{angle:.6},{range:.4},{stated}")
            .expect("a string takes all");
    }
    text
}

/// A report on such a drive; `more` is the end of the study.
pub fn report(name: &str, data: &str, more: &str) -> Value {
    let folder = Folder::new(name);
    for file in ["vehicle.chain", "walls.toml"] {
        folder.copy(&format!("examples/mobile-scanner/{file}"));
    }
    folder.write("drives.csv", data);
    let study = folder.read("walls.toml");
    folder.write("walls.toml", format!("{study}{more}"));
    calibrated(&folder, "walls.toml")
}

/// Of what is determined how many values there are, and how many lie within twice their ± of what was planted.
pub fn held(report: &Value) -> [usize; 2] {
    let planted = |name: &str| match name {
        "latency" => LATE_S,
        "lever_x" => LEVER_M[0],
        "lever_y" => LEVER_M[1],
        "boresight_x" => BORESIGHT_RAD[0],
        "boresight_y" => BORESIGHT_RAD[1],
        "boresight_z" => BORESIGHT_RAD[2],
        other => panic!("{other} is no error of the vehicle"),
    };
    let own = report["errors"].as_array().expect("a list").iter();
    let own = own.filter(|error| !error["standard_uncertainty"].is_null());
    let each = own.map(|error| (error, planted(error["name"].as_str().expect("a name"))));
    let together = report["estimable"].as_array().expect("a list").iter().map(|own| {
        let parts = own["combination"].as_array().expect("a list").iter();
        let part = |part: &Value| {
            let ratio: f64 = part["ratio"].as_str().expect("a number").parse().expect("a number");
            ratio * planted(part["error"].as_str().expect("a name"))
        };
        (own, parts.map(part).sum::<f64>())
    });
    let off = each
        .chain(together)
        .map(|(own, planted)| (number(&own["value"]) - planted).abs() / number(&own["standard_uncertainty"]));
    off.fold([0, 0], |[all, within], off| [all + 1, within + usize::from(off < 2.0)])
}
