//! `trueaxis check` as users run it: the paper's verdicts, the formats, and what cannot be read.

#[path = "../support/mod.rs"]
mod support;

mod bad_claims;
mod kinds;
mod printed;

use serde_json::Value;
use support::{Folder, trueaxis};

/// What the independent derivation says: see reference.py, and its output beside it.
const REFERENCE: &str = include_str!("reference.txt");

fn paper() -> Value {
    let run = trueaxis(&["check", "examples/mobile-lidar/paper.toml", "--format", "json"]);
    assert_eq!((run.code, run.stderr.as_str()), (1, ""), "{}", run.stdout);
    serde_json::from_str(&run.stdout).unwrap_or_else(|error| panic!("{error}: {}", run.stdout))
}

fn claims(json: &Value) -> &[Value] {
    json["claims"].as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[test]
fn the_papers_verdicts_are_read_as_a_referee_would_write_them() {
    let run = trueaxis(&["check", "examples/mobile-lidar/paper.toml"]);
    insta::assert_snapshot!(run.to_string());
}

/// Of every claim: does it hold?
#[test]
fn the_papers_verdicts_are_what_the_algebra_says() {
    let json = paper();
    let verdicts: Vec<(&str, &str)> =
        claims(&json).iter().map(|claim| (text(&claim["name"]), text(&claim["verdict"]))).collect();
    assert_eq!(
        verdicts,
        [
            ("equation (6)", "differs"),
            ("equation (7)", "holds"),
            ("Table 1: 6 perpendicularity errors", "holds"),
            ("Table 1: 3 intersection errors", "holds"),
            ("Table 1: 15 rotation errors", "holds"),
            ("Table 1: 6 errors of the device", "holds"),
            ("Table 1: 30 errors", "holds"),
            ("statement 2: the influence of Δγ2 is small", "holds"),
            ("statement 3: Δα1 is small compared with Δβ2", "differs"),
            ("statement 3: Δβ1 is small compared with Δβ2", "differs"),
            ("statement 3: Δα3 is small compared with Δβ2", "differs"),
            ("statement 3: Δβ3 is small compared with Δβ2", "differs"),
        ]
    );
}

/// Component and error of every difference, against the independent derivation.
#[test]
fn the_differences_are_those_of_the_independent_derivation() {
    let expected: Vec<(&str, &str, &str)> = REFERENCE
        .lines()
        .filter_map(|line| {
            let (place, formulas) = line.split_once(": printed ")?;
            let mut words = place.split(' ');
            let equation = words.next()?;
            let component = words.next()?;
            let missing = formulas.starts_with("0,");
            Some((equation, component, words.next()?))
                .map(|(_, component, error)| (component, error, if missing { "missing" } else { "other" }))
        })
        .collect();
    assert_eq!(expected.len(), 3, "the reference has three differences, all of (6)");
    let json = paper();
    let mut found: Vec<(&str, &str, &str)> = claims(&json)
        .iter()
        .flat_map(|claim| claim["differences"].as_array().map_or(&[][..], Vec::as_slice))
        .map(|difference| {
            let missing = text(&difference["printed"]) == "0";
            let kind = if missing { "missing" } else { "other" };
            (text(&difference["component"]), text(&difference["error"]), kind)
        })
        .collect();
    found.sort_unstable();
    let mut expected = expected;
    expected.sort_unstable();
    assert_eq!(found, expected);
    assert!(REFERENCE.contains("(7) holds"));
}

/// The influences behind statements 2 and 3, against quadrature at 40 digits.
#[test]
fn the_measured_influences_are_those_of_the_independent_quadrature() {
    let reference = |error: &str| -> f64 {
        let line = REFERENCE.lines().find(|line| line.starts_with(&format!("influence of {error}:")));
        let rms = line.and_then(|line| line.split(' ').nth(4)).and_then(|number| number.parse().ok());
        rms.unwrap_or_else(|| panic!("no reference for {error}"))
    };
    let json = paper();
    let measured: Vec<&Value> =
        claims(&json).iter().map(|claim| &claim["measured"]).filter(|measured| !measured.is_null()).collect();
    assert_eq!(measured.len(), 5);
    for (measured, error) in measured.into_iter().zip(["dg2", "da1", "db1", "da3", "db3"]) {
        for (found, expected) in
            [(&measured["error"], reference(error)), (&measured["against"], reference("db2"))]
        {
            let found = found.as_f64().unwrap_or(f64::NAN);
            assert!((found - expected).abs() <= 1e-12 * expected + 1e-20, "{error}: {found} {expected}");
        }
    }
}

/// The corrected formula, pasted into a claims file, holds.
#[test]
fn the_corrected_formula_can_be_pasted() {
    let json = paper();
    let components: Vec<String> = claims(&json)[0]["corrected"]
        .as_array()
        .map_or(&[][..], Vec::as_slice)
        .iter()
        .map(|component| format!("'{}'", text(component)))
        .collect();
    let folder = Folder::new("check_corrected");
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").write(
        "claims.toml",
        format!(
            "chain = \"mobile-lidar.chain\"\n[[claim]]\nname = \"corrected\"\nobservable = \"pointing\"\n\
             keep = [\"dtheta_*\", \"delta_*\"]\ncomponents = [{}]\n",
            components.join(", ")
        ),
    );
    let run = folder.trueaxis(&["check", "claims.toml"]);
    assert_eq!(
        (run.code, run.stdout.as_str(), run.stderr.as_str()),
        (0, "holds    corrected\n\n1 of 1 claims hold\n", "")
    );
}

/// Vectors in one text, plain amounts, abbreviations, ranges and second order.
#[test]
fn every_way_to_write_a_claim_is_read() {
    let folder = Folder::new("check_ways");
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").write(
        "claims.toml",
        r#"
chain = "mobile-lidar.chain"
[symbols]
'S\beta' = "sin(beta)"
"c_{\\beta}" = "cos(beta)"
'u' = "dtheta_x3"
[[claim]]
name = "vector in one text"
observable = "pointing"
keep = ["dtheta_x3"]
components = '[u c_\beta \sin\alpha, -u c_\beta\cos\alpha, -u S\beta]^T'
[[claim]]
name = "plain amounts, all others neglected"
observable = "position"
neglect = ["dtheta_*", "d*1", "d*2", "d*3", "d*4"]
components = ["0", "0", "0", "0"]
[[claim]]
name = "second order"
observable = "pointing"
order = 2
keep = "db2"
components = ["db2*cos(alpha) - db2^2/2*sin(alpha)*sin(beta)", "db2*sin(alpha) + db2^2/2*cos(alpha)*sin(beta)", "-db2^2/2*cos(beta)"]
[[claim]]
name = "over ranges"
compare = { error = "db1", against = "db2", size = 1e-5, measure = "sup", at_most = 0.51 }
range = ["beta=60..120 deg"]
[[claim]]
name = "a plain count"
count = { errors = "dtheta_*", equals = 5 }
"#,
    );
    let run = folder.trueaxis(&["check", "claims.toml"]);
    insta::assert_snapshot!(run.to_string());
}

#[test]
fn a_thousand_claims_are_checked() {
    let folder = Folder::new("check_thousand");
    let mut claims = "chain = \"mobile-lidar.chain\"\n".to_owned();
    for index in 0..1000 {
        let sign = if index % 2 == 0 { "" } else { "-" };
        claims.push_str(&format!(
            "[[claim]]\nname = \"{index}\"\nobservable = \"pointing\"\nkeep = [\"dtheta_x3\", \"dtheta_y1\"]\n\
             components = ['\\Delta\\theta_{{y1}}^0 \\cos\\beta + \\Delta\\theta_{{x3}}^2 \\cos\\beta \\sin\\alpha', \
             '{sign}\\Delta\\theta_{{x3}}^2 \\cos\\alpha \\cos\\beta', \
             '-\\Delta\\theta_{{y1}}^0 \\sin\\alpha\\sin\\beta - \\Delta\\theta_{{x3}}^2 \\sin\\beta']\n"
        ));
    }
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").write("claims.toml", claims);
    let run = folder.trueaxis(&["check", "claims.toml"]);
    assert_eq!((run.code, run.stderr.as_str()), (1, ""));
    assert!(run.stdout.ends_with("\n500 of 1000 claims hold\n"));
}

/// Of one component that is claimed, the correction is of that one; nothing is said of the others.
#[test]
fn a_claim_on_one_component_corrects_that_one() {
    let folder = Folder::new("check_one_component");
    folder.copy("examples/mobile-lidar/mobile-lidar.chain").write(
        "claims.toml",
        "chain = \"mobile-lidar.chain\"\n[[claim]]\nname = \"third\"\nobservable = \"pointing\"\ncomponent = \"z\"\n\
         keep = [\"dtheta_*\"]\ncomponents = ['dtheta_x1']\n",
    );
    let run = folder.trueaxis(&["check", "claims.toml", "--format", "json"]);
    assert_eq!(run.code, 1, "{run}");
    let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let corrected = claims(&json)[0]["corrected"].as_array().expect("a list");
    assert!(corrected[0].is_null() && corrected[1].is_null(), "{run}");
    assert!(text(&corrected[2]).contains("sin"), "{run}");
}
