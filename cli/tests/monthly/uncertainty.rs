//! `apply --uncertainty`: the ± of corrected rows, against draws of the errors by an independent program.

use testkit::Random;

use crate::{ARCSEC, Errors, angles, folder, instrument, pointing};

const ERRORS: Errors = [3.0, -2.0, 40.0, 5.0];
/// Draws of the errors: their standard deviation is known to 1.2 % then.
const DRAWS: usize = 3600;

fn column(text: &str, name: &str) -> Vec<String> {
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let at = header.iter().position(|cell| *cell == name).unwrap_or_else(|| panic!("{name}: {header:?}"));
    lines.map(|line| line.split(',').nth(at).expect("a cell").to_owned()).collect()
}

/// The index and the collimation, which hang together: covariance 0.008 beside variances of 0.01, in square arc seconds.
fn correlated() -> String {
    let square = ARCSEC * ARCSEC;
    let entry = |value: f64| format!("{:e}", value * square);
    let rows = format!(
        "rows = [\n  [{0}, 0.0, 0.0, 0.0],\n  [0.0, {0}, 0.0, 0.0],\n  [0.0, 0.0, {0}, {1}],\n  [0.0, 0.0, {1}, {0}],\n]",
        entry(0.01),
        entry(0.008)
    );
    let text = instrument(ERRORS);
    let (start, end) = (text.find("rows = [").expect("rows"), text.find("[[noise]]").expect("noise"));
    format!("{}{rows}\n\n{}", &text[..start], &text[end..])
}

#[test]
fn a_standard_uncertainty_is_that_of_draws() {
    let folder = folder("uncertainty", &correlated());
    let poses: [[f64; 2]; 4] = [[10.0, 20.0], [-100.0, 70.0], [150.0, 45.0], [30.0, 85.0]];
    let rows: String = poses.iter().map(|[az, el]| format!("{az},{el}\n")).collect();
    folder.write("new.csv", format!("az,el\n{rows}"));
    let run =
        folder.trueaxis(&["apply", "instrument.toml", "--data", "new.csv", "--uncertainty", "--out", "-"]);
    assert_eq!(run.code, 0, "{run}");
    let header = run.stdout.lines().next().expect("a header");
    assert_eq!(
        header,
        "az,el,true_az,true_el,true_az_uncertainty [arcsec],true_el_uncertainty [arcsec],measured_region"
    );
    assert_eq!(column(&run.stdout, "measured_region"), ["inside", "inside", "inside", "outside"]);
    let vector = [
        "apply",
        "instrument.toml",
        "--data",
        "new.csv",
        "--uncertainty",
        "--as",
        "azimuth-elevation",
        "--out",
        "-",
    ];
    let other = folder.trueaxis(&vector);
    assert_eq!(other.code, 0, "{other}");
    let mut random = Random::new(11);
    for (at, [azimuth, elevation]) in poses.into_iter().enumerate() {
        let (mut sums, mut squares) = ([0.0; 2], [0.0; 2]);
        let shown = |errors: Errors| angles(&pointing(errors, azimuth.to_radians(), elevation.to_radians()));
        let mean = shown(ERRORS);
        for _ in 0..DRAWS {
            let [a, b, c, d] = [(); 4].map(|()| random.normal());
            let drawn = [0.1 * a, 0.1 * b, 0.1 * c, 0.1 * (0.8 * c + 0.6 * d)];
            let found = shown([0, 1, 2, 3].map(|at: usize| ERRORS[at] + drawn[at]));
            let off = [0, 1].map(|axis: usize| (found[axis] - mean[axis]) * 3600.0);
            sums.iter_mut().zip(off).for_each(|(sum, off)| *sum += off);
            squares.iter_mut().zip(off).for_each(|(sum, off)| *sum += off * off);
        }
        let count = DRAWS as f64;
        for (axis, names) in [
            ["true_az_uncertainty [arcsec]", "pointing_azimuth_uncertainty [arcsec]"],
            ["true_el_uncertainty [arcsec]", "pointing_elevation_uncertainty [arcsec]"],
        ]
        .into_iter()
        .enumerate()
        {
            let drawn = (squares[axis] / count - (sums[axis] / count).powi(2)).sqrt();
            for (text, name) in [&run.stdout, &other.stdout].into_iter().zip(names) {
                let told: f64 = column(text, name)[at].parse().expect("a number");
                // Four standard deviations of what so many draws know.
                assert!((told / drawn - 1.0).abs() < 0.05, "{name} at {azimuth} {elevation}: {told} {drawn}");
            }
        }
    }
}

#[test]
fn a_declaration_has_no_uncertainty() {
    let folder = folder("uncertainty-chain", &instrument(ERRORS));
    let text = instrument(ERRORS);
    folder.write("mount.chain", text.split("'''").nth(1).expect("a chain"));
    folder.write("errors.toml", "index = \"40 arcsec\"\n").write("new.csv", "azimuth,elevation\n0.1,0.2\n");
    let fixed = ["apply", "mount.chain", "--errors", "errors.toml", "--data", "new.csv", "--out", "-"];
    let run = folder.trueaxis(&[&fixed[..], &["--uncertainty"]].concat());
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("--uncertainty needs the covariance of an instrument file"), "{run}");
    let fixed = ["apply", "instrument.toml", "--data", "new.csv", "--out", "-"];
    let run = folder.trueaxis(&[&fixed[..], &["--uncertainty", "--solve"]].concat());
    assert_eq!(run.code, 2, "{run}");
}
