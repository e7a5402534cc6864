//! The contest through the whole command: an effect along a slow path, and which of several effects one function is. The instrument is
//! simulated here, by turns written out, and by nothing of the product.

use std::f64::consts::PI;

use serde_json::Value;

use crate::support::Folder;

const ARCSEC: f64 = PI / 648_000.0;

const MOUNT: &str = "chain Mount {
    body fork on ground {
        position_error: Rx(tilt_east), Ry(tilt_north);
        motion: Rz(-azimuth);
        motion_error: Rz(-azimuth_index);
    }
    body tube on fork {
        position_error: Ry(askew);
        motion: Rx(elevation);
        motion_error: Rx(elevation_index), Rz(collimation);
    }
    observe sight: direction(0, 1, 0) of tube;
}
";

const STUDY: &str = "chain = \"mount.chain\"
data = \"measured.csv\"
[observed]
kind = \"direction\"
x = \"x\"
y = \"y\"
z = \"z\"
";

/// Numbers that look drawn: a linear congruence, and the sum of twelve for a normal one.
struct Drawn(u64);

impl Drawn {
    fn even(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }
}

fn about_x([x, y, z]: [f64; 3], by: f64) -> [f64; 3] {
    [x, y * by.cos() - z * by.sin(), y * by.sin() + z * by.cos()]
}

fn about_y([x, y, z]: [f64; 3], by: f64) -> [f64; 3] {
    [x * by.cos() + z * by.sin(), y, z * by.cos() - x * by.sin()]
}

fn about_z([x, y, z]: [f64; 3], by: f64) -> [f64; 3] {
    [x * by.cos() - y * by.sin(), x * by.sin() + y * by.cos(), z]
}

/// Where the mount points, with the tilts of its base and what bends its fork about x.
fn sight(azimuth: f64, elevation: f64, base: [f64; 2], fork: f64) -> [f64; 3] {
    let tube = about_x(about_z([0.0, 1.0, 0.0], -30.0 * ARCSEC), elevation + 12.0 * ARCSEC);
    let on_fork = about_x(about_y(tube, 8.0 * ARCSEC), fork);
    about_x(about_y(about_z(on_fork, -azimuth - 20.0 * ARCSEC), base[1]), base[0])
}

/// A line of the data: readings, what was seen with 2″ of noise a component, and another cell.
fn line(drawn: &mut Drawn, [azimuth, elevation]: [f64; 2], seen: [f64; 3], cell: &str) -> String {
    let (right, up) = ([azimuth.cos(), -azimuth.sin(), 0.0], [0.0, 0.0, 1.0]);
    let (along, across) = (2.0 * ARCSEC * drawn.normal() / elevation.cos(), 2.0 * ARCSEC * drawn.normal());
    let mut noisy = [0.0; 3];
    for axis in 0..3 {
        noisy[axis] = seen[axis] + across * right[axis] + along * (up[axis] - seen[2] * seen[axis]);
    }
    let length = noisy.iter().map(|part| part * part).sum::<f64>().sqrt();
    let [x, y, z] = noisy.map(|part| part / length);
    format!("{azimuth:.12},{elevation:.12},{x:.15},{y:.15},{z:.15},{cell}\n")
}

/// A study of the mount with its data.
fn measured(folder: &Folder, study: &str, data: &str) {
    folder.write("mount.chain", MOUNT).write("study.toml", study).write("measured.csv", data);
}

/// Readings from all over the sky, 15° to 75° high.
fn anywhere(drawn: &mut Drawn) -> [f64; 2] {
    [360.0 * drawn.even() - 180.0, 15.0 + 60.0 * drawn.even()].map(f64::to_radians)
}

/// What is seen where the fork bends by 3″ a degree of temperature from 20.
fn warm(azimuth: f64, elevation: f64, temperature: f64) -> [f64; 3] {
    sight(azimuth, elevation, [15.0 * ARCSEC, -9.0 * ARCSEC], 3.0 * ARCSEC * (temperature - 20.0))
}

fn report(folder: &Folder) -> Value {
    let run = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

fn causes(report: &Value) -> Vec<String> {
    let effects = report["effects"].as_array().expect("a list").iter();
    effects.map(|effect| format!("{} {}", effect["driver"], effect["dof"])).collect()
}

#[test]
fn an_effect_along_a_slow_path_is_found_and_not_taken_for_memory() {
    let mut drawn = Drawn(5);
    let mut data = String::from("azimuth,elevation,x,y,z,temperature\n");
    for row in 0..240 {
        let part = f64::from(row) / 240.0;
        let wave = |turns: f64| 1.0 - (2.0 * ((turns * part).fract()) - 1.0).abs();
        let [azimuth, elevation] = [360.0 * wave(2.0), 20.0 + 60.0 * wave(3.4)].map(f64::to_radians);
        let temperature = 20.0 + 5.0 * (2.0 * PI * 1.3 * part).sin();
        let seen = warm(azimuth, elevation, temperature);
        data += &line(&mut drawn, [azimuth, elevation], seen, &format!("{temperature:.4}"));
    }
    let folder = Folder::new("weighed-path");
    measured(&folder, &format!("{STUDY}[search]\ninputs = [\"temperature\"]\n"), &data);
    let report = report(&folder);
    assert_eq!(causes(&report), ["\"temperature\" \"Rx\""], "{:?}", report["cautions"]);
}

/// An elevation encoder off centre by 110″ of half of its circle, seen over 60°: harmonics of fifth and seventh order follow it as well.
fn off_centre(folder: &Folder) {
    let mut drawn = Drawn(8);
    let mut data = String::from("azimuth,elevation,x,y,z,number\n");
    for row in 0..300 {
        let [azimuth, elevation] = anywhere(&mut drawn);
        let turned = elevation - 95.0 * ARCSEC * elevation.cos() - 50.0 * ARCSEC * elevation.sin();
        let seen = sight(azimuth, turned, [15.0 * ARCSEC, -9.0 * ARCSEC], 0.0);
        data += &line(&mut drawn, [azimuth, elevation], seen, &row.to_string());
    }
    measured(folder, STUDY, &data);
}

#[test]
fn one_low_order_is_told_and_not_two_high_ones_and_the_contest_says_why() {
    let folder = Folder::new("weighed-off-centre");
    off_centre(&folder);
    let report = report(&folder);
    assert_eq!(causes(&report), ["\"elevation\" \"Rx\""], "{:?}", report["effects"]);
    let effect = &report["effects"][0];
    assert_eq!(effect["names"][0], "encoder eccentricity of elevation", "{effect}");
    assert_eq!(effect["selected_in_folds"], 1.0, "{effect}");
    let listed = effect["causes"].as_array().expect("a list");
    let shares: Vec<f64> = listed.iter().filter_map(|cause| cause["share"].as_f64()).collect();
    assert!(shares.len() > 1 && shares.iter().sum::<f64>() <= 1.0 + 1e-9, "{shares:?}");
    assert!(shares.windows(2).all(|pair| pair[0] >= pair[1] - 0.01), "{shares:?}");
    let contest = report["contest"].as_array().expect("a list");
    let named = |name: &str| contest.iter().find(|own| own["name"] == name).expect("it competed");
    assert_eq!(named("encoder eccentricity of elevation")["told"], true);
    let flexure = named("gravity flexure of tube about x");
    assert_eq!(flexure["instead_of"], "encoder eccentricity of elevation", "{flexure}");
    assert!(flexure["behind"].as_f64().expect("nats") < 3.0, "{flexure}");
}

/// An elevation encoder that is oval by 40″, seen over 60°. What a disc off centre would do has columns that are 99.5 % alike, and the
/// contest excludes it.
#[test]
fn an_oval_disc_is_one_effect_and_no_disc_off_centre() {
    let mut drawn = Drawn(21);
    let mut data = String::from("azimuth,elevation,x,y,z,number\n");
    for row in 0..200 {
        let [azimuth, elevation] = anywhere(&mut drawn);
        let turned = elevation + 40.0 * ARCSEC * (2.0 * elevation - 0.4).cos();
        let seen = sight(azimuth, turned, [15.0 * ARCSEC, -9.0 * ARCSEC], 0.0);
        data += &line(&mut drawn, [azimuth, elevation], seen, &row.to_string());
    }
    let folder = Folder::new("weighed-oval");
    measured(&folder, STUDY, &data);
    let report = report(&folder);
    assert_eq!(causes(&report), ["\"elevation\" \"Rx\""], "{:?}", report["effects"]);
    assert_eq!(report["verdict"], "confounded", "{}", report["remaining"]);
    let effect = &report["effects"][0];
    assert_eq!(effect["names"][0], "encoder ellipticity of elevation", "{effect}");
    let listed = effect["causes"].as_array().expect("a list");
    assert!(
        listed.iter().all(|cause| cause["share"].is_f64()),
        "a cause that the contest excludes: {effect}"
    );
}

#[test]
fn a_suspected_cause_is_explained() {
    let folder = Folder::new("weighed-explain");
    off_centre(&folder);
    let run = folder.trueaxis(&["calibrate", "study.toml", "--explain", "Gravity flexure tube"]);
    assert_eq!(run.code, 0, "{run}");
    let told = run.stdout.split_once("Why, or why not").expect("a section").1;
    assert!(told.contains("gravity flexure of tube about x: "), "{run}");
    assert!(told.contains("behind encoder eccentricity of elevation"), "{run}");
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "out", "--explain", "warp of spacetime"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("no explanation that competed"), "{run}");
    assert!(!folder.names().contains(&"out".to_owned()), "{run}");
}

#[test]
fn an_index_that_takes_up_a_far_temperature_is_said_to_be_at_zero_of_it() {
    let mut drawn = Drawn(11);
    let mut data = String::from("azimuth,elevation,x,y,z,temperature\n");
    for _ in 0..200 {
        let [azimuth, elevation] = anywhere(&mut drawn);
        let temperature = 14.0 + 12.0 * drawn.even();
        let seen = warm(azimuth, elevation, temperature);
        data += &line(&mut drawn, [azimuth, elevation], seen, &format!("{temperature:.4}"));
    }
    let folder = Folder::new("weighed-zero");
    measured(&folder, &format!("{STUDY}[search]\ninputs = [\"temperature\"]\n"), &data);
    let report = report(&folder);
    assert_eq!(causes(&report), ["\"temperature\" \"Rx\""], "{:?}", report["cautions"]);
    // The effect is written at the fork; the index is the tube's, and takes up what the effect has of a constant.
    assert_eq!(report["at_zero"][0]["errors"], serde_json::json!(["elevation_index"]));
}
