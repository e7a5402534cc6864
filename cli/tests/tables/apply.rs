//! `trueaxis apply`: angles, corrections, readings to set, and the ranges that a model was found over.

use crate::support::Folder;

const MOUNT: &str = "examples/alt-azimuth/alt-azimuth.chain";
const ERRORS: &str =
    "tilt_east = \"30 arcsec\"\ncollimation = \"60 arcsec\"\nelevation_index = \"-20 arcsec\"\n";

fn folder(name: &str, errors: &str) -> Folder {
    let folder = Folder::new(name);
    folder.copy(MOUNT).write("errors.toml", errors);
    folder
}

fn apply(folder: &Folder, data: &str, more: &[&str]) -> (i32, Vec<Vec<String>>, String) {
    let chain = "alt-azimuth.chain";
    let fixed = ["apply", chain, "--errors", "errors.toml", "--data", data, "--out", "-"];
    let run = folder.trueaxis(&[&fixed[..], more].concat());
    let rows = run.stdout.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect();
    (run.code, rows, run.stderr)
}

fn column(rows: &[Vec<String>], name: &str) -> Vec<f64> {
    let at = rows[0].iter().position(|cell| cell == name).unwrap_or_else(|| panic!("{name}: {:?}", rows[0]));
    rows[1..].iter().map(|row| row[at].parse().unwrap_or(f64::NAN)).collect()
}

/// The index error of an encoder is added to it as it stands; collimation grows with the elevation as its secant.
#[test]
fn angles_are_corrected_as_the_textbook_says() {
    let folder = folder("apply_angles", "elevation_index = \"-20 arcsec\"\n");
    folder.write("data.csv", "star,azimuth [deg],elevation [deg]\nVega,120,45\nMizar,-30,10\n");
    let (code, rows, stderr) = apply(&folder, "data.csv", &["--as", "azimuth-elevation", "--correction"]);
    assert_eq!((code, stderr.as_str()), (0, ""));
    let close = |name: &str, expected: [f64; 2], within: f64| {
        for (found, expected) in column(&rows, name).into_iter().zip(expected) {
            assert!((found - expected).abs() < within, "{name}: {found} {expected}");
        }
    };
    close("sight_azimuth [deg]", [120.0, 330.0], 1e-10);
    close("sight_elevation [deg]", [45.0 - 20.0 / 3600.0, 10.0 - 20.0 / 3600.0], 1e-12);
    close("sight_azimuth_correction [arcsec]", [0.0; 2], 1e-9);
    close("sight_elevation_correction [arcsec]", [-20.0; 2], 1e-9);
    assert_eq!(rows[1][0], "Vega");

    let folder = self::folder("apply_collimation", "collimation = \"60 arcsec\"\n");
    folder.write("data.csv", "azimuth [deg],elevation [deg]\n120,45\n0,60\n");
    let (_, rows, _) = apply(&folder, "data.csv", &["--as", "azimuth-elevation", "--correction"]);
    for (found, secant) in
        column(&rows, "sight_azimuth_correction [arcsec]").into_iter().zip([2f64.sqrt(), 2.0])
    {
        // The chain turns collimation from the line of sight towards smaller azimuth, exact to the third order.
        assert!((found.abs() - 60.0 * secant).abs() < 1e-4, "{found}");
    }
}

/// Readings that were solved for point where was wanted: what comes out goes in again.
#[test]
fn solved_readings_point_at_what_was_wanted() {
    let folder = folder("apply_solve", ERRORS);
    let wanted =
        "star,sight_azimuth [deg],sight_elevation [deg]\nVega,120,45\nlow,300,5\nhigh,10,88\nPole,0,90\n";
    folder.write("wanted.csv", wanted);
    let options = ["--as", "azimuth-elevation", "--solve", "--correction"];
    let (code, rows, stderr) = apply(&folder, "wanted.csv", &options);
    assert_eq!(code, 0, "{stderr}");
    // Tilted by 30″ and looking 60″ askew, the mount cannot see its own pole.
    assert!(stderr.contains("1 of 4 targets are out of reach"), "{stderr}");
    let remaining = column(&rows, "sight_remaining [rad]");
    assert!(remaining[..3].iter().all(|left| *left < 1e-14), "{remaining:?}");
    assert!(remaining[3] > 1e-5, "{remaining:?}");
    let text: Vec<String> = rows.iter().map(|row| row.join(",")).collect();
    folder.write("solved.csv", text.join("\n") + "\n");
    let (_, again, _) = apply(&folder, "solved.csv", &["--as", "azimuth-elevation"]);
    for (name, expected) in
        [("sight_azimuth [deg]", [120.0, 300.0, 10.0]), ("sight_elevation [deg]", [45.0, 5.0, 88.0])]
    {
        for (found, expected) in column(&again, name).into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-11, "{name}: {found} {expected}");
        }
    }
    // Readings in the table are where the search starts: beyond the zenith the mount points there with its other face.
    folder.write(
        "faces.csv",
        "azimuth [deg],elevation [deg],sight_x,sight_y,sight_z\n300,135,0.6123724,-0.3535534,0.7071068\n",
    );
    let (_, other, stderr) = apply(&folder, "faces.csv", &["--solve"]);
    assert_eq!(stderr, "");
    let elevation = column(&other, "elevation [rad]")[0].to_degrees();
    assert!((elevation - 135.0).abs() < 0.1, "{elevation}");
    assert!(column(&other, "sight_remaining [rad]")[0] < 1e-14);
}

#[test]
fn rows_outside_what_the_model_was_found_over_are_counted() {
    let found = "[found-over]\nazimuth = [\"-170 deg\", \"170 deg\"]\nelevation = [\"15 deg\", \"80 deg\"]\n";
    let folder = folder("apply_outside", &format!("{ERRORS}\n{found}"));
    folder.write("data.csv", "azimuth [deg],elevation [deg]\n200,45\n175,85\n0,10\n10,20\n");
    let (code, rows, stderr) = apply(&folder, "data.csv", &[]);
    assert_eq!((code, rows.len()), (0, 5));
    // 200° is -160°, which is within; 175° is 5° beyond.
    assert!(stderr.contains("2 of 4 rows are outside what the model was found over"), "{stderr}");
    assert!(
        stderr.contains("azimuth by up to 5.0000°") && stderr.contains("elevation by up to 5.0000°"),
        "{stderr}"
    );
    // Every command reads the file.
    let run = folder.trueaxis(&[
        "eval",
        "alt-azimuth.chain",
        "--errors",
        "errors.toml",
        "--data",
        "data.csv",
        "--out",
        "e.csv",
    ]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    for (table, wanted) in [
        ("[found-over]\nazimut = [0, 1]\n", "did you mean `azimuth`?"),
        ("[found-over]\nazimuth = [1, 0]\n", "swap them"),
        ("[found-over]\nazimuth = [\"1 mm\", 2]\n", "`mm` measures a length"),
        ("[found-over]\nazimuth = 3\n", "`azimuth` has no two bounds"),
        ("[found-over]\nazimuth = [\"1 dge\", 2]\n", "`dge` is no unit: did you mean `deg`?"),
        ("[tilt]\nazimuth = [0, 1]\n", "`tilt` is a table, and errors have values"),
    ] {
        folder.write("errors.toml", format!("{ERRORS}\n{table}"));
        let (code, rows, stderr) = apply(&folder, "data.csv", &[]);
        assert_eq!((code, rows.len()), (2, 0), "{table}: {stderr}");
        assert!(stderr.contains(wanted), "{table}: {stderr}");
    }
}

#[test]
fn what_cannot_be_applied_is_said() {
    let folder = folder("apply_wrong", ERRORS);
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").write("lidar.toml", "db2 = \"5 arcsec\"\n");
    folder
        .write("data.csv", "alpha,beta,gamma,range\n1,2,3,10\n")
        .write("sight.csv", "sight_x,sight_y\n0,1\n");
    let lidar = |more: &[&str]| {
        let fixed =
            ["apply", "mobile-lidar.chain", "--errors", "lidar.toml", "--data", "data.csv", "--out", "-"];
        folder.trueaxis(&[&fixed[..], more].concat())
    };
    for (more, wanted) in [
        (&["--solve"][..], "--observable NAME"),
        (&["--observable", "position", "--as", "ha-dec"], "`position` is a point"),
        (&["--observable", "pointing", "--solve"], "pointing_x"),
        (&["--as", "azimut"], "azimuth-elevation"),
    ] {
        let run = lidar(more);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{more:?}: {}", run.stderr);
        assert!(run.stderr.contains(wanted), "{more:?}: {}", run.stderr);
    }
    let (code, _, stderr) = apply(&folder, "sight.csv", &["--solve"]);
    assert!(code == 2 && stderr.contains("sight_z"), "{stderr}");
    // Points stay points where directions become angles.
    let run = lidar(&["--as", "ha-dec"]);
    let header = run.stdout.lines().next().unwrap_or_default();
    assert!(
        header.contains("pointing_ha [deg],pointing_dec [deg],position_x,position_y,position_z"),
        "{header}"
    );
}
