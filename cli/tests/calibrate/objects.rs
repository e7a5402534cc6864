//! Objects and stations that nobody knows: every kind of observation on data of independent programs, which stand beside the
//! data and share no code with ours; and what is wrong with such studies.

use serde_json::Value;

use crate::figures::{error, first_effect, holds};
use crate::support::{Folder, Run, root, run_in, trueaxis};

const ARCSEC: f64 = std::f64::consts::PI / 648_000.0;

fn example(study: &str) -> Value {
    let run = trueaxis(&["calibrate", &format!("examples/{study}.toml"), "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// What was planted stands in `simulate_wires_and_sights.py`.
#[test]
fn wires_and_sights_show_the_encoder_that_sits_off_centre() {
    let wires = example("objects/wires");
    assert!(first_effect(&wires).contains("encoder eccentricity of q2"), "{}", first_effect(&wires));
    holds(&wires, &[("length2", 0.7e-3), ("zero3", -1.1e-3), ("length3", -0.5e-3), ("aside", 0.9e-3)]);

    let sights = example("objects/sights");
    assert!(first_effect(&sights).contains("encoder eccentricity of azimuth"), "{}", first_effect(&sights));
    holds(&sights, &[("trunnion", 12.0 * ARCSEC), ("index", -18.0 * ARCSEC), ("collimation", 25.0 * ARCSEC)]);
}

/// The same arm, its lengths held by the lengths that a bar reads, and its place by the one pivot that is known.
#[test]
fn distances_show_the_same_as_wires() {
    let bars = example("objects/bars");
    assert!(first_effect(&bars).contains("encoder eccentricity of q2"), "{}", first_effect(&bars));
    holds(&bars, &[("length2", 0.7e-3), ("length3", -0.5e-3), ("aside", 0.9e-3)]);
    // Without the rows of the one pivot that is known nothing says where the arm stands: a fold that is searched without them has
    // nothing to say of that. The noise is 0.1 mm.
    let held_out = bars["after"]["held_out_rms"].as_f64().expect("a number");
    assert!(held_out < 0.12e-3, "{held_out}");
    assert_eq!(bars["after"]["held_out_rms_kept"], bars["after"]["held_out_rms"]);
}

/// What was planted stands in `examples/mobile-scanner/simulate.py`.
#[test]
fn a_mobile_scanner_shows_boresight_lever_arm_and_latency() {
    let report = example("mobile-scanner/walls");
    assert_eq!(report["verdict"], "nothing detectable");
    holds(
        &report,
        &[
            ("lever_x", 0.012),
            ("lever_y", -0.020),
            ("boresight_x", 1.5e-3),
            ("boresight_y", -2.0e-3),
            ("boresight_z", 2.5e-3),
            ("latency", 4e-3),
        ],
    );
}

/// Targets place the stations that walls alone would need rough poses for; the planted errors are those of `simulate.py`.
#[test]
fn targets_and_walls_go_together_in_one_study() {
    let both = example("objects/both");
    assert!(first_effect(&both).contains("encoder eccentricity of azimuth"), "{}", first_effect(&both));
    assert_eq!(both["observations"]["rows"], 792);
    let planted = [
        ("axes_apart", 0.4e-3),
        ("trunnion", 25.0 * ARCSEC),
        ("index", -30.0 * ARCSEC),
        ("beam_aside", -0.6e-3),
        ("collimation", 40.0 * ARCSEC),
        ("range_zero", 1.5e-3),
    ];
    holds(&both, &planted);
    let targets = example("objects/targets");
    // Of the axes' offset walls tell less than the ± themselves are known to.
    for name in ["index", "range_zero"] {
        let [[_, alone], [_, together]] = [error(&targets, name), error(&both, name)];
        assert!(together < alone, "{name}: {together} with walls, {alone} without");
    }
}

/// A study of `examples/objects` with its data in a folder of the test's own, some lines written otherwise.
fn changed(folder: &str, study: &str, files: &[&str], change: impl Fn(String) -> String) -> Folder {
    let folder = Folder::new(folder);
    files.iter().for_each(|file| {
        folder.copy(&format!("examples/objects/{file}"));
    });
    let text =
        std::fs::read_to_string(root().join(format!("examples/objects/{study}"))).expect("it is there");
    folder.write(study, change(text));
    folder
}

fn run(folder: &Folder, arguments: &[&str]) -> Run {
    run_in(&folder.0, arguments, "")
}

fn report(folder: &Folder, study: &str) -> Value {
    let run = run(folder, &["calibrate", study, "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    serde_json::from_str(&run.stdout).expect("JSON")
}

/// Two faces from one place show the circle that sits off centre. How far off the targets are they cannot show: noise would, if readings
/// were taken at their word.
#[test]
fn one_station_shows_the_circle_and_no_scale() {
    for station in ["A", "B", "C", "D"] {
        let name = format!("objects-one-{station}");
        let folder = changed(&name, "targets.toml", &["scanner.chain", "targets.csv"], |text| text);
        let all = folder.read("targets.csv");
        let is_own = |(at, line): &(usize, &str)| *at == 0 || line.starts_with(&format!("{station},"));
        let own: Vec<&str> = all.lines().enumerate().filter(is_own).map(|(_, line)| line).collect();
        folder.write("targets.csv", own.join("\n") + "\n");
        let report = report(&folder, "targets.toml");
        assert!(first_effect(&report).contains("encoder eccentricity of azimuth"), "{}", report["effects"]);
        let found = report["effects"].as_array().expect("a list");
        assert!(found.len() <= 2 && !report["effects"].to_string().contains("range scale"), "{found:?}");
    }
}

/// The first screen says what else explains the data, and where to stand next.
#[test]
fn the_first_screen_says_where_to_stand_next() {
    let folder = changed("objects-next", "next.toml", &["scanner.chain", "walls.csv"], |text| text);
    let told = run(&folder, &["calibrate", "next.toml"]).stdout;
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    let report = report(&folder, "next.toml");

    let effect = &report["effects"][0];
    let (causes, others) = (effect["causes"].as_array(), effect["competing_with"].as_array());
    assert_eq!((causes.map(Vec::len), others.map(Vec::len)), (Some(1), Some(0)), "{effect:#}");
    assert!(told.contains("EFFECT FOUND With this effect, the residual looks like noise."), "{told}");

    let next = &report["next_places"][0];
    let places = next["places"].as_array().expect("a list");
    assert_eq!(places.len(), 1);
    let x = places[0]["place_m"][0].as_f64().expect("a number");
    let best = format!("To reduce the uncertainties, add to the set-up. Best is a station at x {x:.2} m");
    assert!(told.contains(&best.replace('-', "−").replace("set−up", "set-up")), "{best}: {told}");
    assert_eq!(places[0]["pointings"].as_array().expect("a list").len(), 20);
    for error in next["uncertainties"].as_array().expect("a list") {
        let [now, then] = [1, 2].map(|at| error[at].as_f64().expect("a number"));
        assert!(then <= now && then > 0.0, "{error}");
    }
}

/// Nothing holds the frame: all rough poses turned by 50 degrees about the vertical and shifted, the same errors come out.
#[test]
fn errors_do_not_depend_on_the_frame() {
    let (sine, cosine) = 50_f64.to_radians().sin_cos();
    let turned = |text: String| {
        let poses = [
            ("A", 0.0, 0.0, 1.6, 0.0),
            ("B", 4.2, -1.0, 1.5, 75.0),
            ("C", 1.0, 4.0, 1.7, -125.0),
            ("D", -3.0, 1.7, 0.9, 165.0),
        ];
        let (before, _) = text.split_once("[stations]").expect("they come last");
        let lines = poses.map(|(name, x, y, z, heading): (&str, f64, f64, f64, f64)| {
            let (x, y) = (cosine * x - sine * y + 100.0, sine * x + cosine * y - 30.0);
            let (z, heading) = (z + 7.0, heading + 50.0);
            format!(
                "{name} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} deg\", rough = true }}\n"
            )
        });
        format!("{before}[stations]\n{}", lines.concat())
    };
    let folder = changed("objects-turned", "walls.toml", &["scanner.chain", "walls.csv"], turned);
    let (here, there) = (example("objects/walls"), report(&folder, "walls.toml"));
    assert_ne!(here["errors"].as_array().expect("a list").len(), 0);
    assert_eq!(first_effect(&here), first_effect(&there));
    for name in ["axes_apart", "trunnion", "index", "beam_aside", "collimation", "range_zero"] {
        let [[one, sigma], [other, _]] = [error(&here, name), error(&there, name)];
        assert!((one - other).abs() < 1e-3 * sigma, "{name}: {one} and {other} ± {sigma}");
    }
}

/// Directions alone have no scale: all rough places half as large again, the same errors come out.
#[test]
fn errors_of_directions_do_not_depend_on_the_scale() {
    let larger = |text: String| {
        [
            ("9 m", "13.5 m"),
            ("1 m", "1.5 m"),
            ("3 m", "4.5 m"),
            ("8 m", "12 m"),
            ("-6 m", "-9 m"),
            ("5 m", "7.5 m"),
        ]
        .iter()
        .fold(text, |text, (from, to)| text.replace(&format!("\"{from}\""), &format!("\"{to}\"")))
    };
    let folder = changed("objects-larger", "sights.toml", &["theodolite.chain", "sights.csv"], larger);
    let (here, there) = (example("objects/sights"), report(&folder, "sights.toml"));
    for name in ["trunnion", "index", "collimation"] {
        let [[one, sigma], [other, _]] = [error(&here, name), error(&there, name)];
        assert!((one - other).abs() < 1e-3 * sigma, "{name}: {one} and {other} ± {sigma}");
    }
}

/// An arm whose two lengths are estimated, and a ball in a socket.
const BALL: &str = "chain Ball {
    body upper on ground { motion: Rz(q1); }
    body fore on upper { position: Ty(0.5); position_error: Ty(longer); motion: Rx(q2); }
    body ball on fore { position: Ty(0.4); position_error: Ty(farther); }
    observe ball: point(0, 0, 0) of ball;
}
";
const SOCKETS: &str =
    "chain = \"ball.chain\"\ndata = \"ball.csv\"\n[observed]\nkind = \"fixed\"\nobject = \"socket\"\n";
const ROWS: &str =
    "socket,q1 [rad],q2 [rad]\nA,0.1,0.2\nA,0.1001,0.2001\nA,0.0999,0.2\nB,1.0,-0.4\nB,1.0001,-0.4\n";

#[test]
fn an_arm_that_could_shrink_to_nothing_is_refused() {
    let folder = Folder::new("objects-shrink");
    folder.write("ball.chain", BALL).write("ball.csv", ROWS).write("study.toml", SOCKETS);
    for command in ["calibrate", "identify"] {
        let run = run(&folder, &[command, "study.toml"]);
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains("nothing holds the scale: `longer`, `farther`"), "{run}");
        assert!(run.stderr.contains("fix = { longer = 0 }"), "{run}");
    }
    // What the message says to write is enough.
    folder.write("study.toml", format!("{SOCKETS}[fit]\nfix = {{ longer = 0 }}\n"));
    let run = run(&folder, &["identify", "study.toml"]);
    assert_eq!(run.code, 0, "{run}");
}

/// Ranges that are all so much too long make a room that is so much too large: only noise would tell of such a scale.
#[test]
fn a_scale_of_the_ranges_that_nothing_holds_is_refused() {
    let chain = std::fs::read_to_string(root().join("examples/objects/scanner.chain")).expect("it is there");
    let scaled = chain.replace("Ty(range_zero)", "Ty(range_zero), Ty(stretch*range)");
    assert_ne!(scaled, chain);
    let folder = changed("objects-stretch", "targets.toml", &["targets.csv"], |text| text);
    folder.write("scanner.chain", &scaled);
    let refused = run(&folder, &["calibrate", "targets.toml"]);
    assert_eq!(refused.code, 2, "{refused}");
    assert!(refused.stderr.contains("nothing holds the scale: `stretch` could"), "{refused}");
    assert!(refused.stderr.contains("fix = { stretch = 0 }"), "{refused}");
    // What the message says to write is enough; and what these rows see of the errors is asked all the same.
    let asked = run(&folder, &["identify", "targets.toml"]);
    assert_eq!(asked.code, 0, "{asked}");
    folder.write("held.toml", folder.read("targets.toml") + "[fit]\nfix = { stretch = 0 }\n");
    let held = run(&folder, &["calibrate", "held.toml"]);
    assert_eq!(held.code, 0, "{held}");
}

#[test]
fn a_length_says_its_unit_and_is_not_negative() {
    let table = std::fs::read_to_string(root().join("examples/objects/bars.csv")).expect("it is there");
    let study = |text: String| text;
    let folder = changed("objects-unit", "bars.toml", &["arm.chain"], study);
    folder.write("bars.csv", table.replace("length [mm]", "length"));
    let run = run_in(&folder.0, &["identify", "bars.toml"], "");
    assert!(run.stderr.contains("column `length` reaches") && run.stderr.contains("has no unit"), "{run}");

    let (header, rows) = table.split_once('\n').expect("a header");
    let (cells, rest) = rows.split_once('\n').expect("rows");
    let (before, length) = cells.rsplit_once(',').expect("cells");
    folder.write("bars.csv", format!("{header}\n{before},-{length}\n{rest}"));
    let run = run_in(&folder.0, &["calibrate", "bars.toml"], "");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("is negative") && run.stderr.contains("line 2"), "{run}");
}

/// Two labels of one station changed for each other, and an object that one row alone observes.
#[test]
fn labels_that_are_swapped_are_named() {
    let table = std::fs::read_to_string(root().join("examples/objects/targets.csv")).expect("it is there");
    let swapped = table.replace("B,T3,", "B,X,").replace("B,T7,", "B,T3,").replace("B,X,", "B,T7,");
    let folder = changed("objects-swapped", "targets.toml", &["scanner.chain"], |text| text);
    folder.write("targets.csv", swapped + "A,T99,0.1,0.1,5.0\n");
    let run = run(&folder, &["identify", "targets.toml"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("the labels `T3` and `T7` are likely swapped"), "{run}");
    assert!(run.stderr.contains("the rows of `T99` say where it is and nothing of the errors"), "{run}");
    assert_eq!(run.stderr.matches("swapped").count(), 1, "{run}");
}

/// A wall straight ahead alone.
#[test]
fn walls_that_say_little_are_named() {
    let table = std::fs::read_to_string(root().join("examples/objects/walls.csv")).expect("it is there");
    let ahead: String = [(0.01, 0.02), (0.03, -0.02), (-0.04, 0.01), (-0.02, -0.03), (0.05, 0.04)]
        .iter()
        .map(|(azimuth, elevation): &(f64, f64)| {
            format!("A,screen,{azimuth},{elevation},{}\n", 5.0 / azimuth.cos() / elevation.cos())
        })
        .collect();
    let folder = changed("objects-head-on", "walls.toml", &["scanner.chain"], |text| text);
    folder.write("walls.csv", format!("{table}{ahead}"));
    let seen = run(&folder, &["identify", "walls.toml"]);
    assert_eq!(seen.code, 0, "{seen}");
    assert!(seen.stderr.contains("the plane `screen` was seen head-on alone"), "{seen}");
}

/// Rows of objects that they do not place are left out, whatever stands beside them, and the page says so.
#[test]
fn rows_that_do_not_say_where_their_object_is_are_left_out() {
    let table = std::fs::read_to_string(root().join("examples/objects/walls.csv")).expect("it is there");
    let (header, rows) = table.split_once('\n').expect("a header");
    let door = "A,door,0.1,0.1,4\nA,door,0.2,0.1,4\n";
    let folder = changed("objects-lost", "walls.toml", &["scanner.chain"], |text| text);
    folder.write("walls.csv", &table);
    let without = report(&folder, "walls.toml");
    // Before the others, so that every one of these moves up by one.
    folder.write("walls.csv", format!("{header}\n{door}{rows}A,sill,0.3,0.1,4\n"));
    let warning = "3 rows of 2 objects do not say where these are and were left out; of `door`, the first: observe it at three";
    let seen = run(&folder, &["identify", "walls.toml"]);
    assert_eq!(seen.code, 0, "{seen}");
    assert!(seen.stderr.contains(warning), "{seen}");
    let made = run(&folder, &["calibrate", "walls.toml", "--out", "result"]);
    assert_eq!(made.code, 0, "{made}");
    let with: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
    assert_eq!(with["errors"], without["errors"]);
    assert!(with["provenance"]["warnings"].to_string().contains(warning), "{}", with["provenance"]);
    assert!(folder.read("result/report.html").contains("3 rows of 2 objects do not say where these are"));
    let residuals = folder.read("result/residuals.csv");
    assert!(
        residuals.starts_with("row,line,station,object,"),
        "{}",
        residuals.lines().next().expect("a header")
    );
    assert!(residuals.contains("\n3,4,A,") && !residuals.contains("door") && !residuals.contains("sill"));
}

/// A label is a text that can be read: neither nothing nor what a terminal would obey.
#[test]
fn labels_that_cannot_be_read_are_refused_with_their_line() {
    let table = std::fs::read_to_string(root().join("examples/objects/walls.csv")).expect("it is there");
    let folder = changed("objects-labels", "walls.toml", &["scanner.chain"], |text| text);
    for (label, told) in [
        ("", "the cell is empty: fill in the label"),
        ("\u{1b}[31mdoor", "a control character stands in the text"),
        ("do\u{9b}or", "a control character stands in the text"),
    ] {
        folder.write("walls.csv", format!("{table}A,{label},0.1,0.1,4\n"));
        let seen = run(&folder, &["calibrate", "walls.toml"]);
        assert_eq!(seen.code, 2, "{seen}");
        assert!(seen.stderr.contains(told) && seen.stderr.contains("line 602, row 601"), "{seen}");
        assert!(!seen.stderr.contains(['\u{1b}', '\u{9b}']), "{seen}");
    }
}

#[test]
fn a_station_that_nothing_connects_is_named() {
    let table = std::fs::read_to_string(root().join("examples/objects/targets.csv")).expect("it is there");
    let folder = changed("objects-apart", "targets.toml", &["scanner.chain"], |text| text);
    folder.write("targets.csv", table.replace("D,T", "D,elsewhere"));
    let seen = run(&folder, &["calibrate", "targets.toml"]);
    assert_eq!(seen.code, 2, "{seen}");
    assert!(
        seen.stderr.contains("nothing says where station `D` stood: it shares 0 of the targets"),
        "{seen}"
    );
    assert!(seen.stderr.contains("rough = true"), "{seen}");
}
