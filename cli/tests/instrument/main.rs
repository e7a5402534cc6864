//! The instrument file: `calibrate` writes it, and every command that takes a declaration takes it.

#[path = "../support/mod.rs"]
mod support;

mod columns;
mod generated;
mod kept;
mod printed;
mod refused;

use support::Folder;

/// An alt-azimuth mount whose data have columns of other names, units and notation than its declaration.
const MOUNT: &str = "/// A mount.
chain Mount {
    const arm: length = 0.5;
    body fork on ground {
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
    }
    body tube on fork {
        motion: Rx(elevation);
        motion_error: Rx(index), Rz(side*collimation);
    }
    input side: side;
    observe pointing: direction(0, 1, 0) of tube;
}
";

const STUDY: &str = "chain = \"mount.chain\"
data = \"stars.csv\"
id = \"star\"

[columns]
azimuth   = { column = \"Az\", unit = \"gon\" }
elevation = { column = \"zenith\", notation = \"ddd.mmss\", sign = -1, offset = \"90 deg\" }
side      = \"pier\"

[observed]
kind = \"spherical\"
azimuth   = { column = \"true az (deg)\", unit = \"deg\" }
elevation = { column = \"true el\", notation = \"ddd.mmss\" }

[hold_out]
folds = 3
";

/// Degrees as `ddd.mmss`.
fn packed(degrees: f64) -> String {
    let seconds = degrees.abs() * 3600.0;
    let (whole, rest) = ((seconds / 3600.0).floor(), seconds % 3600.0);
    let (minutes, seconds) = ((rest / 60.0).floor(), rest % 60.0);
    let sign = if degrees < 0.0 { "-" } else { "" };
    format!("{sign}{whole}.{minutes:02}{}", format!("{seconds:09.6}").replace('.', ""))
}

/// Stars as they are seen with an index error of an elevation that is counted from it: 40″, and collimation 0; azimuths both ways of zero.
fn stars() -> String {
    let mut text = "star,Az,zenith,pier,true az (deg),true el\n".to_owned();
    for star in 0..36 {
        let azimuth = f64::from((star * 47) % 360) - 180.0;
        let elevation = 15.0 + f64::from((star * 31) % 60);
        let side = if star % 2 == 0 { 1 } else { -1 };
        let seen = elevation + (40.0 + noise(2 * star)) / 3600.0;
        let row = format!(
            "s{star},{},{},{side},{:.9},{}\n",
            azimuth / 0.9,
            packed(90.0 - elevation),
            azimuth + noise(2 * star + 1) / 3600.0 / elevation.to_radians().cos(),
            packed(seen)
        );
        text.push_str(&row);
    }
    text
}

/// Noise without a pattern, of 0.06″.
fn noise(number: i32) -> f64 {
    let scattered = (f64::from(number) * 12.9898).sin() * 43_758.545_3;
    (scattered - scattered.floor() - 0.5) * 0.2
}

/// A folder with the mount, its study and its data.
fn mount(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("mount.chain", MOUNT).write("study.toml", STUDY).write("stars.csv", stars());
    folder
}

/// The same, calibrated into `result`.
fn calibrated(name: &str) -> Folder {
    let folder = mount(name);
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(run.code, 0, "{run}");
    folder
}
