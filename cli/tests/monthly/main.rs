//! What a calibration is used for every month: is it still valid, what changed, how sure is a corrected row.

#[path = "../support/mod.rs"]
mod support;

mod compare;
mod plan;
mod poses;
mod refused;
mod uncertainty;
mod verify;

use std::f64::consts::PI;

use nalgebra::Vector3;
use support::Folder;
use testkit::{Random, rotation};

const ARCSEC: f64 = PI / 648_000.0;

/// Errors of the mount: `tilt_x`, `tilt_y`, `index` and `collimation`, arc seconds.
type Errors = [f64; 4];

/// An instrument file of a mount whose errors are known to 0.1″, with noise of 1″ in each component.
fn instrument(errors: Errors) -> String {
    let [tilt_x, tilt_y, index, collimation] = errors;
    let variance = (0.1 * ARCSEC).powi(2);
    let sigma = ARCSEC;
    format!(
        "instrument = 1

chain = '''
/// A mount.
chain Mount {{
    body fork on ground {{
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
    }}
    body tube on fork {{
        motion: Rx(elevation);
        motion_error: Rx(index), Rz(collimation);
    }}
    observe pointing: direction(0, 1, 0) of tube;
}}
'''

[errors]
tilt_x = \"{tilt_x} arcsec\"
tilt_y = \"{tilt_y} arcsec\"
index = \"{index} arcsec\"
collimation = \"{collimation} arcsec\"

[found-over]
azimuth = [\"-180 deg\", \"180 deg\"]
elevation = [\"10 deg\", \"80 deg\"]

[covariance]
of = [\"tilt_x\", \"tilt_y\", \"index\", \"collimation\"]
undetermined = []
rows = [
  [{variance:e}, 0.0, 0.0, 0.0],
  [0.0, {variance:e}, 0.0, 0.0],
  [0.0, 0.0, {variance:e}, 0.0],
  [0.0, 0.0, 0.0, {variance:e}],
]

[[noise]]
sigma = [{sigma:e}, {sigma:e}]
degrees-of-freedom = 400.0

[study]
chain = \"mount.chain\"
data = \"stars.csv\"

[study.columns]
azimuth = {{ column = \"az\", unit = \"deg\" }}
elevation = {{ column = \"el\", unit = \"deg\" }}

[study.observed]
kind = \"spherical\"
azimuth = {{ column = \"true_az\", unit = \"deg\" }}
elevation = {{ column = \"true_el\", unit = \"deg\" }}

[provenance]
date = \"2026-01-31\"
"
    )
}

/// The same with noise of so many arc seconds.
fn noisier(text: &str, sigma: f64) -> String {
    let of = |sigma: f64| format!("sigma = [{0:e}, {0:e}]", sigma * ARCSEC);
    text.replace(&of(1.0), &of(sigma))
}

/// Where the mount points, by matrices of its own.
fn pointing(errors: Errors, azimuth_rad: f64, elevation_rad: f64) -> Vector3<f64> {
    let [tilt_x, tilt_y, index, collimation] = errors.map(|error| error * ARCSEC);
    rotation(0, tilt_x)
        * rotation(1, tilt_y)
        * rotation(2, -azimuth_rad)
        * rotation(0, elevation_rad + index)
        * rotation(2, collimation)
        * Vector3::y()
}

/// Azimuth and elevation of a direction, degrees.
fn angles(direction: &Vector3<f64>) -> [f64; 2] {
    [direction.x.atan2(direction.y).to_degrees(), direction.z.clamp(-1.0, 1.0).asin().to_degrees()]
}

/// Rows measured with these errors at poses in degrees, with noise of so many arc seconds in each component.
fn rows(errors: Errors, poses: &[[f64; 2]], sigma: f64, seed: u64) -> String {
    let mut random = Random::new(seed);
    let mut text = "az,el,true_az,true_el\n".to_owned();
    for [azimuth, elevation] in poses {
        let direction = pointing(errors, azimuth.to_radians(), elevation.to_radians());
        let [true_az, true_el] = angles(&direction);
        let noise = [(); 2].map(|()| random.normal() * sigma / 3600.0);
        let row = [*azimuth, *elevation, true_az + noise[0] / true_el.to_radians().cos(), true_el + noise[1]];
        text.push_str(&row.map(|cell| format!("{cell:.9}")).join(","));
        text.push('\n');
    }
    text
}

/// Ten poses over the whole measured region.
const SPREAD: [[f64; 2]; 10] = [
    [-160.0, 15.0],
    [-120.0, 60.0],
    [-90.0, 30.0],
    [-45.0, 75.0],
    [-10.0, 20.0],
    [20.0, 50.0],
    [60.0, 12.0],
    [95.0, 70.0],
    [130.0, 40.0],
    [170.0, 25.0],
];

/// Ten poses in one corner of it.
const CORNER: [[f64; 2]; 10] = [
    [0.0, 10.5],
    [1.0, 11.0],
    [2.0, 12.0],
    [3.0, 10.5],
    [4.0, 11.0],
    [5.0, 12.0],
    [4.5, 12.5],
    [3.5, 11.5],
    [2.5, 13.0],
    [1.5, 12.0],
];

/// A folder with an instrument file.
fn folder(name: &str, text: &str) -> Folder {
    let folder = Folder::new(&format!("monthly-{name}"));
    folder.write("instrument.toml", text);
    folder
}

fn json(run: &support::Run) -> serde_json::Value {
    serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}: {run}"))
}
