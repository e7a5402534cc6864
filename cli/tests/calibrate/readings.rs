//! Studies of what circles show, simulated and calibrated: the errors come back within their uncertainties.

use serde_json::Value;

use crate::support::Folder;

const SKY: &str = "chain Sky {
    body base on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(-azimuth); motion_error: Rz(-index); }
    body tube on base { position_error: Ry(cross); motion: Rx(elevation); motion_error: Rz(-collimation); }
    observe sky: azimuth(y, x), elevation of direction(0, 1, 0) of tube;
    observe clock: hour_angle(x, -y), zenith_distance of direction(0, 1, 0) of tube;
    observe arcs: cross_elevation(y, x), elevation of direction(0, 1, 0) of tube;
}
";

const ERRORS: &str = "tilt_x = \"10 arcsec\"\ntilt_y = \"5 arcsec\"\nindex = \"40 arcsec\"\ncross = \"20 arcsec\"\n\
                      collimation = \"30 arcsec\"\n";

fn study(observable: &str) -> String {
    format!(
        "chain = \"sky.chain\"\nobservable = \"{observable}\"\ndata = \"sky.csv\"\n[observed]\nkind = \"spherical\"\n\
         [noise]\nsigma = \"1 arcsec\"\n"
    )
}

#[test]
fn angles_by_the_convention_of_the_declaration_give_the_errors_back() {
    for observable in ["sky", "clock"] {
        let folder = Folder::new(&format!("readings-{observable}"));
        folder.write("sky.chain", SKY);
        folder.write("errors.toml", ERRORS);
        folder.write("study.toml", study(observable));
        let simulated = folder.trueaxis(&[
            "simulate",
            "sky.chain",
            "--errors",
            "errors.toml",
            "--poses",
            "300",
            "--noise",
            "1 arcsec",
            "--seed",
            "3",
            "--range",
            "elevation=10 deg..70 deg",
            "--observable",
            observable,
            "--out",
            "sky.csv",
        ]);
        assert_eq!(simulated.code, 0, "{simulated}");
        let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
        assert_eq!(run.code, 0, "{run}");
        let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
        let arcsec = |value: &Value| value.as_f64().expect("a number") * 648_000.0 / std::f64::consts::PI;
        for (name, truth) in
            [("tilt_x", 10.0), ("tilt_y", 5.0), ("index", 40.0), ("cross", 20.0), ("collimation", 30.0)]
        {
            let errors = report["errors"].as_array().expect("a list");
            let error = errors.iter().find(|error| error["name"] == name).expect("every error");
            let off = (arcsec(&error["value"]) - truth).abs() / arcsec(&error["standard_uncertainty"]);
            assert!(off < 4.0, "{observable}, {name}: {off} standard uncertainties");
        }
    }
}

#[test]
fn what_no_kind_measures_is_refused_with_what_does() {
    let folder = Folder::new("readings-arcs");
    folder.write("sky.chain", SKY);
    folder.write("sky.csv", "azimuth,elevation,arcs_cross_elevation,arcs_elevation\n0,1,0,0\n");
    folder.write("study.toml", study("arcs"));
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(
        run.stderr.contains("`arcs` shows cross_elevation(y, x), elevation, which no kind measures"),
        "{run}"
    );
    assert!(run.stderr.contains("kind = \"spherical\""), "{run}");
}
