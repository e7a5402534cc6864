//! What a study's observations may be, and how their files may be written, through the whole command.

use serde_json::Value;

use crate::support::Folder;

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

/// The report of the folder's `study.toml`.
fn report(folder: &Folder) -> Value {
    let run = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// An estimate and its standard uncertainty, SI.
fn estimate(report: &Value, name: &str) -> (f64, f64) {
    let errors = report["errors"].as_array().expect("a list");
    let error = errors.iter().find(|error| error["name"] == name).expect("it was estimated");
    (error["value"].as_f64().expect("a number"), error["standard_uncertainty"].as_f64().expect("a number"))
}

pub const ENCODER: &str = "chain Encoder {
    body shaft on ground { motion: Rz(-reading); motion_error: Rz(-index); }
    observe mark: direction(0, 1, 0) of shaft;
}
";

pub const ENCODER_STUDY: &str = "chain = \"encoder.chain\"
data = \"measured.csv\"
[columns]
reading = { column = \"reading\", unit = \"deg\" }
[observed]
kind = \"spherical\"
azimuth = { column = \"true\", unit = \"deg\" }
[fit]
robust = false
";

/// Readings at every 30 degrees, and how far the truth is from each, arcsec.
const LEFT_ARCSEC: [f64; 12] = [10.0, 12.0, 11.0, 31.0, 9.0, 13.0, -8.0, 11.5, 10.5, 12.5, 9.5, 11.0];

#[test]
fn stated_uncertainties_weigh_the_rows() {
    let sigma = |at: usize| if at.is_multiple_of(3) { 20.0 } else { 1.0 + at as f64 / 10.0 };
    let mut data = String::from("reading,true,sigma\n");
    let (mut weights, mut sum) = (0.0, 0.0);
    for (at, left) in LEFT_ARCSEC.into_iter().enumerate() {
        let reading = 30.0 * at as f64;
        data += &format!("{reading},{},{}\n", reading + left / 3600.0, sigma(at));
        weights += sigma(at).powi(-2);
        sum += left * sigma(at).powi(-2);
    }
    let folder = Folder::new("stated-sigma");
    let noise = "[noise]\nvariance = false\nsigma = { column = \"sigma\", unit = \"arcsec\" }\n";
    folder.write("encoder.chain", ENCODER).write("measured.csv", data);
    folder.write("study.toml", format!("{ENCODER_STUDY}{noise}"));
    let report = report(&folder);
    assert_eq!(report["verdict"], "nothing detectable");
    let (index, _) = estimate(&report, "index");
    assert!((index / (sum / weights * ARCSEC) - 1.0).abs() < 1e-9, "{index} is not the weighted mean");
}

/// One table in four dialects: the reports are the same to the last digit.
#[test]
fn dialects_do_not_change_the_answer() {
    let cell = |number: f64| format!("{number:.9}");
    let rows: Vec<[String; 2]> = LEFT_ARCSEC
        .into_iter()
        .enumerate()
        .map(|(at, left)| [cell(30.0 * at as f64), cell(30.0 * at as f64 + left / 3600.0)])
        .collect();
    let table = |header: &str, separator: &str, end: &str| {
        let lines = rows.iter().map(|row| row.join(separator));
        std::iter::once(header.to_owned()).chain(lines).map(|line| line + end).collect::<String>()
    };
    let plain = table("reading,true", ",", "\n");
    let decimal_comma = format!("\u{feff}{}", table("reading;true", ";", "\r\n").replace('.', ","));
    let commented = format!("# a run\n{}", table("reading [deg]\ttrue [deg]", "\t", "\n# a remark\n"));
    let bars = table("reading (deg) | true (deg)", " | ", "\n");
    let reports = [("plain", plain), ("comma", decimal_comma), ("remarks", commented), ("bars", bars)].map(
        |(name, data)| {
            let folder = Folder::new(&format!("dialect-{name}"));
            folder.write("encoder.chain", ENCODER).write("measured.csv", data);
            folder.write("study.toml", format!("comment = \"#\"\n{ENCODER_STUDY}"));
            report(&folder)
        },
    );
    assert_eq!(estimate(&reports[0], "index").0.signum(), 1.0);
    let without_checksums = |report: &Value| {
        let mut report = report.as_object().expect("a table").clone();
        report.remove("provenance").expect("what it was made with");
        report
    };
    for report in &reports[1..] {
        assert_eq!(without_checksums(report), without_checksums(&reports[0]));
    }
}

#[test]
fn several_files_are_one_run() {
    let rows = |range: std::ops::Range<usize>| {
        let row =
            |at: usize| format!("{},{}\n", 30.0 * at as f64, 30.0 * at as f64 + LEFT_ARCSEC[at] / 3600.0);
        range.map(row).collect::<String>()
    };
    let whole = Folder::new("one-file");
    whole.write("encoder.chain", ENCODER).write("study.toml", ENCODER_STUDY);
    whole.write("measured.csv", format!("reading,true\n{}", rows(0..12)));
    let parts = Folder::new("two-files");
    parts.write("encoder.chain", ENCODER);
    parts.write("study.toml", ENCODER_STUDY.replace("\"measured.csv\"", "[\"a.csv\", \"b.csv\"]"));
    parts.write("a.csv", format!("reading,true\n{}", rows(0..5)));
    parts.write("b.csv", format!("true,reading\n{}", swapped(&rows(5..12))));
    let [parts, whole] = [report(&parts), report(&whole)];
    for key in ["errors", "after", "not_shown"] {
        assert_eq!(parts[key], whole[key], "{key}");
    }
}

/// The two columns of a table the other way round.
fn swapped(rows: &str) -> String {
    rows.lines()
        .filter_map(|row| row.split_once(','))
        .map(|(first, second)| format!("{second},{first}\n"))
        .collect()
}

const TRACKER: &str = "chain Tracker {
    body base on ground { motion: Rz(-azimuth); motion_error: Rz(-azimuth_index); }
    body head on base { motion: Rx(elevation); motion_error: Rx(elevation_index), Ty(range_zero); }
    input distance: length;
    observe sight: direction(0, 1, 0) of head;
    observe target: point(0, distance, 0) of head;
}
";

const TRACKED: &str = "chain = \"tracker.chain\"
observable = \"sight\"
data = \"sight.csv\"
[observed]
kind = \"direction\"
[[also]]
observable = \"target\"
data = \"target.csv\"
[also.observed]
kind = \"point\"
x = { column = \"target_x\", unit = \"m\" }
y = { column = \"target_y\", unit = \"m\" }
z = { column = \"target_z\", unit = \"m\" }
";

/// Directions alone do not see the zero of the ranges, points do; together both kinds count, each by its own noise.
#[test]
fn directions_and_points_are_fitted_together() {
    let folder = Folder::new("directions-and-points");
    folder.write("tracker.chain", TRACKER).write("study.toml", TRACKED);
    let planted =
        [("azimuth_index", 30.0 * ARCSEC), ("elevation_index", -50.0 * ARCSEC), ("range_zero", 2e-3)];
    let errors: String = planted.iter().map(|(name, si)| format!("{name} = {si:e}\n")).collect();
    folder.write("errors.toml", errors);
    let simulate = |observable: &str, noise: &str, seed: &str| {
        let out = format!("{observable}.csv");
        let shown = ["--observable", observable, "--noise", noise, "--seed", seed, "--out", &out];
        let ranges = ["--range", "elevation=5 deg..80 deg", "--range", "distance=2 m..30 m"];
        let arguments = ["simulate", "tracker.chain", "--errors", "errors.toml", "--poses", "60"];
        let run = folder.trueaxis(&[&arguments[..], &shown[..], &ranges[..]].concat());
        assert_eq!(run.code, 0, "{run}");
    };
    simulate("sight", "2 arcsec", "1");
    simulate("target", "0.1 mm", "2");

    let both = report(&folder);
    assert_eq!(both["observations"]["rows"], 120);
    for (name, planted) in planted {
        let (value, sigma) = estimate(&both, name);
        assert!((value - planted).abs() < 4.0 * sigma, "{name}: {value} ± {sigma} is not {planted}");
    }
    // 60 directions of 2 arcsec say more of the indices than 60 points of 0.1 mm, and the points alone know the zero.
    let (zero, sigma) = estimate(&both, "range_zero");
    assert!((sigma / (0.1e-3 / 60_f64.sqrt()) - 1.0).abs() < 0.3, "{zero} ± {sigma}");
    folder.write("study.toml", TRACKED.split("[[also]]").next().expect("a part"));
    let alone = report(&folder);
    let separable = |report: &Value, at: usize| report["errors"][at]["separable"] == true;
    assert_eq!([0, 1, 2].map(|at| separable(&alone, at)), [true, true, false]);
    assert_eq!([0, 1, 2].map(|at| separable(&both, at)), [true; 3]);
    for name in ["azimuth_index", "elevation_index"] {
        assert!(estimate(&both, name).1 < estimate(&alone, name).1, "{name}");
    }
}

const MOUNT: &str = "chain Mount {
    body fork on ground { motion: Rz(-first); motion_error: Rz(-first_index); }
    body tube on fork { motion: Rx(second); motion_error: Rx(second_index); }
    observe sight: direction(0, 1, 0) of tube;
}
";

/// A study of a TPOINT file whose columns begin with `true_` and `encoder_`.
fn tpoint_study(first: &str, second: &str, keys: [&str; 2]) -> String {
    format!(
        "chain = \"mount.chain\"\ndata = \"run.dat\"\n[columns]\nfirst = \"encoder_{first}\"\nsecond = \"encoder_{second}\"\n\
         [observed]\nkind = \"spherical\"\n{} = \"true_{first}\"\n{} = \"true_{second}\"\n",
        keys[0], keys[1]
    )
}

/// Both indices, arcsec, from a TPOINT file.
fn indices_arcsec(name: &str, study: &str, data: &str) -> [f64; 2] {
    let folder = Folder::new(name);
    folder.write("mount.chain", MOUNT).write("study.toml", study).write("run.dat", data);
    let report = report(&folder);
    ["first_index", "second_index"].map(|name| estimate(&report, name).0 / ARCSEC)
}

/// Planted: the encoders read 36 arcsec too little in azimuth and 72 too much in elevation.
#[test]
fn tpoint_alt_azimuth_files_are_read() {
    let mut data = String::from("A run on one night\n: ALTAZ\n 37 14 02\n");
    for (at, (azimuth, elevation)) in
        [(10.0, 30.0), (80.0, 45.0), (200.0, 60.0), (290.0, 25.0)].into_iter().enumerate()
    {
        let noise = [1e-5, -1e-5, -1e-5, 1e-5][at];
        data += &format!(
            " {azimuth:.5} {elevation:.5} {:.5} {:.5}\n",
            azimuth - 0.01 + noise,
            elevation + 0.02 - noise
        );
    }
    data += "END\n";
    let study = tpoint_study("az_deg", "el_deg", ["azimuth", "elevation"]);
    let [azimuth, elevation] = indices_arcsec("tpoint-altaz", &study, &data);
    assert!((azimuth - 36.0).abs() < 0.1 && (elevation + 72.0).abs() < 0.1, "{azimuth}, {elevation}");
}

/// Planted: the telescope read 4 s (60 arcsec) too much right ascension and 30 arcsec too little declination, east of the
/// pier throughout.
#[test]
fn tpoint_equatorial_files_are_read() {
    let data = "A run on one night\n:NODA\n:EQUAT\n+37 14 02 2026 11 20\n\
                04 00 00.0 +20 30 00  04 00 04.0 +20 29 30  6 00\n\
                05 10 00.0 -05 00 00  05 10 04.0 -05 00 30  6 10\n\
                06 20 00.0 +41 12 10  06 20 04.0 +41 11 40  8 30\n\
                02 30 00.0 +61 00 20  02 30 04.0 +60 59 50  1 15\nEND\n";
    let study = tpoint_study("ha_deg", "dec_deg", ["ha", "dec"]);
    let [hour_angle, declination] = indices_arcsec("tpoint-equat", &study, data);
    assert!((hour_angle - 60.0).abs() < 0.01, "{hour_angle}");
    assert!((declination - 30.0).abs() < 0.01, "{declination}");
}

/// The same run as separated values and as Parquet, through every command that reads or writes tables.
#[cfg(feature = "parquet")]
#[test]
fn parquet_is_read_and_written_as_separated_values_are() {
    let folder = Folder::new("parquet");
    folder.write("encoder.chain", ENCODER).write("errors.toml", "index = \"11 arcsec\"\n");
    let done = |arguments: &[&str]| {
        let run = folder.trueaxis(arguments);
        assert_eq!(run.code, 0, "{run}");
    };
    let errors = ["--errors", "errors.toml"];
    let [separated, parquet] = ["csv", "parquet"].map(|ending| {
        let run = format!("run.{ending}");
        let simulated = ["--poses", "50", "--noise", "2 arcsec", "--seed", "3", "--out", &run];
        done(&[&["simulate", "encoder.chain"], &errors[..], &simulated[..]].concat());
        let evaluated = format!("evaluated.{ending}");
        done(&[&["eval", "encoder.chain"], &errors[..], &["--data", &run, "--out", &evaluated]].concat());
        let corrected = format!("corrected-{ending}.csv");
        done(
            &[&["apply", "encoder.chain"], &errors[..], &["--data", &evaluated, "--out", &corrected]]
                .concat(),
        );
        let kind = "[observed]\nkind = \"direction\"\n";
        folder.write("study.toml", format!("chain = \"encoder.chain\"\ndata = \"{run}\"\n{kind}"));
        (report(&folder), folder.read(&corrected))
    });
    assert_eq!(parquet.0["errors"], separated.0["errors"]);
    assert_eq!(parquet.1, separated.1);
}

/// A spoiled file is told as any wrong input is, also where the crate that reads it panics.
#[cfg(feature = "parquet")]
#[test]
fn spoiled_parquet_is_no_panic() {
    let folder = Folder::new("spoiled-parquet");
    folder
        .write("encoder.chain", ENCODER.replace("reading", "az"))
        .write("errors.toml", "index = \"11 arcsec\"\n");
    let good = concat!(env!("CARGO_MANIFEST_DIR"), "/../calibration/tests/reference/snappy.parquet");
    let good = std::fs::read(good).expect("the file");
    // Bits of the page headers at which the crate panics.
    for at in [273, 278, 376, 382] {
        let mut bytes = good.clone();
        bytes[at] ^= 1;
        folder.write("run.parquet", bytes);
        let data = ["--data", "run.parquet", "--out", "out.csv"];
        let run =
            folder.trueaxis(&[&["eval", "encoder.chain", "--errors", "errors.toml"], &data[..]].concat());
        assert_eq!(run.code, 2, "byte {at}: {run}");
        assert_eq!(run.stderr, "error: run.parquet: the file is spoiled: write it again\n", "byte {at}");
    }
}

/// Degrees that nobody declared as such: the data are read as radians, and the residual is no small error.
#[test]
fn misread_data_are_told_before_all_else() {
    let mut data = String::from("reading,true\n");
    for (at, left) in LEFT_ARCSEC.into_iter().enumerate() {
        let reading = 30.0 * at as f64;
        data += &format!("{},{}\n", reading, (reading + left / 3600.0).to_radians());
    }
    let folder = Folder::new("misread");
    let study = ENCODER_STUDY
        .replace(
            "reading = { column = \"reading\", unit = \"deg\" }",
            "reading = { column = \"reading\", unit = \"rad\" }",
        )
        .replace("unit = \"deg\" }\n[fit]", "unit = \"rad\" }\n[fit]");
    folder.write("encoder.chain", ENCODER).write("measured.csv", data).write("study.toml", study);
    let run = folder.trueaxis(&["calibrate", "study.toml"]);
    assert_eq!(run.code, 1, "{run}");
    let said = run.stdout.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.starts_with("A COLUMN IS MISREAD Column `reading` is in deg, not rad."), "{run}");
    assert!(said.contains("reading = { column = \"reading\", unit = \"deg\" }"), "{run}");
    assert!(!folder.names().iter().any(|name| name.contains("amended")), "{run}");
}

#[test]
fn poses_to_measure_next_are_proposed_in_degrees() {
    let folder = Folder::new("next");
    let data: String = std::iter::once("reading,true\n".to_owned())
        .chain((0..12).map(|at| format!("{},{}\n", 30 * at, 30.0 * f64::from(at) + LEFT_ARCSEC[0] / 3600.0)))
        .collect();
    folder.write("encoder.chain", ENCODER).write("measured.csv", data);
    folder.write(
        "study.toml",
        format!("{ENCODER_STUDY}[next]\nposes = 3\nrange = {{ reading = [\"0 deg\", \"90 deg\"] }}\n"),
    );
    let run = folder.trueaxis(&["calibrate", "study.toml", "--verbose"]);
    assert_eq!(run.code, 0, "{run}");
    let (_, proposed) = run.stdout.split_once("measure next\n  to determine").expect("a proposal");
    let mut lines = proposed.lines().skip(1);
    let header = lines.next().unwrap_or_default();
    assert!(header.trim().starts_with("reading, °"), "{run}");
    // A pose that is proposed more than once stands once, with how often.
    let mut measured = 0;
    for line in lines.take_while(|line| line.starts_with("      ")) {
        let mut cells = line.split_whitespace();
        let degrees: f64 =
            cells.next().and_then(|cell| cell.parse().ok()).unwrap_or_else(|| panic!("{line} in {run}"));
        assert!((0.0..=90.0).contains(&degrees), "{run}");
        measured +=
            cells.next().map_or(1, |times| times.parse().unwrap_or_else(|_| panic!("{line} in {run}")));
    }
    assert_eq!(measured, 3, "{run}");
}
