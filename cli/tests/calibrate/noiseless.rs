//! Data without noise: what a fit leaves of them is rounding, and rounding has effects for whoever looks for some.

use crate::support::Folder;

#[test]
fn what_is_left_of_data_without_noise_is_called_rounding() {
    for (chain, observable, range) in [
        ("examples/alt-azimuth/alt-azimuth.chain", "sight", "elevation=15..85 deg"),
        ("examples/mobile-lidar/mobile-lidar.chain", "target", "range=5..50 m"),
    ] {
        let folder = Folder::new(&format!("noiseless_{observable}"));
        folder.copy(chain);
        let name = chain.rsplit('/').next().unwrap_or_default();
        let errors = match observable {
            "sight" => "tilt_east = \"30 arcsec\"\ncollimation = \"60 arcsec\"\n",
            _ => "db2 = \"30 arcsec\"\ndx1 = \"0.3 mm\"\n",
        };
        folder.write("errors.toml", errors);
        let run = folder.trueaxis(&[
            "simulate",
            name,
            "--errors",
            "errors.toml",
            "--observable",
            observable,
            "--poses",
            "150",
            "--noise",
            "0",
            "--seed",
            "1",
            "--range",
            range,
            "--out",
            "data.csv",
        ]);
        assert_eq!(run.code, 0, "{run}");
        let kind = if observable == "sight" { "direction" } else { "point" };
        let study = format!(
            "chain = \"{name}\"\nobservable = \"{observable}\"\ndata = \"data.csv\"\n[observed]\nkind = \"{kind}\"\n\
             x = \"{observable}_x\"\ny = \"{observable}_y\"\nz = \"{observable}_z\"\n"
        );
        folder.write("study.toml", study);
        let run = folder.trueaxis(&["calibrate", "study.toml", "--format", "json"]);
        assert_eq!(run.code, 0, "{run}");
        let json: serde_json::Value =
            serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(json["verdict"], "nothing detectable", "{observable}");
        assert_eq!(json["effects"].as_array().map(Vec::len), Some(0), "{observable}");
        let told = |caution: &serde_json::Value| caution["kind"] == "residual is rounding";
        assert!(json["cautions"].as_array().is_some_and(|all| all.iter().any(told)), "{}", json["cautions"]);
        let run = folder.trueaxis(&["calibrate", "study.toml"]);
        assert!(run.stdout.contains("Only rounding remains"), "{run}");
    }
}
