//! Where objects and stations come out, against simulators that know where they are.

use std::collections::BTreeMap;

use crate::room::{Room, STUDY, TRACKER};
use crate::support::{Folder, root, run_in};
use testkit::Random;

/// The rows of a table by the label in their first column; each cell by its column.
fn table(folder: &Folder, file: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let text = folder.read(file);
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    lines.map(|cells| (cells[0].clone(), header.iter().cloned().zip(cells).collect())).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} in {row:?}"))
}

fn calibrated(folder: &Folder, study: &str) -> String {
    let run = run_in(&folder.0, &["calibrate", study, "--out", "result"], "");
    assert_eq!(run.code, 0, "{run}");
    run.stderr
}

/// Within their uncertainties, and these are as large as the scatter. The first row, which is far off, counts as set aside.
#[test]
fn targets_and_stations_come_out_where_they_are() {
    let folder = Folder::new("placed-targets");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    let mut pulls: [Vec<f64>; 2] = Default::default();
    for seed in 1..=10 {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        let [([x, y, z], heading), ..] = room.stations;
        let stated = format!(
            "[stations]\nS0 = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\" }}\n"
        );
        let rows = room.rows(random, 0.0);
        let first = rows.lines().nth(1).and_then(|row| row.rsplit_once(',')).expect("a row with a range");
        let further = first.1.parse::<f64>().expect("a number") + 5e-3;
        let rows = rows.replacen(&format!("{},{}", first.0, first.1), &format!("{},{further}", first.0), 1);
        folder.write("rows.csv", rows).write("study.toml", format!("{STUDY}{stated}"));
        calibrated(&folder, "study.toml");
        let objects = table(&folder, "result/objects.csv");
        assert_eq!(objects.len(), room.targets.len());
        for (at, place) in room.targets.iter().enumerate() {
            let own = &objects[&format!("T{at}")];
            assert_eq!((own["kind"].as_str(), own["origin"].as_str()), ("point", "estimated"));
            assert_eq!([&own["rows"], &own["rows_set_aside"]], [["6", "1"], ["6", "0"]][at.min(1)]);
            let off = |axis: usize, name: &str| {
                (number(own, &format!("{name} [m]")) - place[axis])
                    / number(own, &format!("{name}_sigma [m]"))
            };
            pulls[0].extend([off(0, "x"), off(1, "y"), off(2, "z")]);
        }
        let stations = table(&folder, "result/stations.csv");
        assert_eq!(
            (stations["S0"]["origin"].as_str(), number(&stations["S0"], "x_sigma [m]")),
            ("exact", 0.0)
        );
        for (at, (place, heading)) in room.stations.iter().enumerate().skip(1) {
            let own = &stations[&format!("S{at}")];
            let truth = [place[0], place[1], place[2], *heading, 0.0, 0.0];
            let names = ["x", "y", "z", "heading", "pitch", "roll"];
            pulls[1].extend(names.into_iter().zip(truth).enumerate().map(|(at, (name, truth))| {
                let unit = if at < 3 { "m" } else { "rad" };
                (number(own, &format!("{name} [{unit}]")) - truth)
                    / number(own, &format!("{name}_sigma [{unit}]"))
            }));
        }
    }
    for pulls in pulls {
        let rms = (pulls.iter().map(|pull| pull * pull).sum::<f64>() / pulls.len() as f64).sqrt();
        // Those of one room hang together.
        assert!((0.75..1.3).contains(&rms) && pulls.iter().all(|pull| pull.abs() < 5.5), "{rms} {pulls:?}");
    }
}

/// Where nothing is known, all is seen from one station; coordinates are from there, and the report has them too.
#[test]
fn what_nothing_holds_has_the_frame_of_a_station() {
    let folder = Folder::new("placed-frame");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    let random = &mut Random::new(21);
    let room = Room::new(random);
    folder.write("rows.csv", room.rows(random, 0.0)).write("study.toml", STUDY);
    calibrated(&folder, "study.toml");
    let (stations, objects) = (table(&folder, "result/stations.csv"), table(&folder, "result/objects.csv"));
    let frames: Vec<&String> =
        stations.iter().filter(|(_, own)| own["origin"] == "frame").map(|(label, _)| label).collect();
    let [frame] = frames.as_slice() else { panic!("{stations:?}") };
    let ([x, y, z], heading) = room.stations[frame[1..].parse::<usize>().expect("a number")];
    for (at, place) in room.targets.iter().enumerate() {
        let (sine, cosine) = heading.sin_cos();
        let [ahead, aside, up] = [place[0] - x, place[1] - y, place[2] - z];
        let truth = [cosine * ahead + sine * aside, cosine * aside - sine * ahead, up];
        let own = &objects[&format!("T{at}")];
        for (name, truth) in ["x", "y", "z"].into_iter().zip(truth) {
            let (value, sigma) =
                (number(own, &format!("{name} [m]")), number(own, &format!("{name}_sigma [m]")));
            assert!(
                (value - truth).abs() < 5.0 * sigma && sigma < 1e-4,
                "T{at}, {name}: {value} ± {sigma}, not {truth}"
            );
        }
    }
    let report: serde_json::Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
    let places = &report["places"];
    assert_eq!(places["objects"].as_array().map(Vec::len), Some(room.targets.len()), "{places}");
    assert_eq!(places["stations"].as_array().map(Vec::len), Some(3));
}

/// The walls of `examples/objects/simulate.py`, whose first station is as exact as it says.
#[test]
fn walls_come_out_where_they_are() {
    let folder = Folder::new("placed-walls");
    folder.copy("examples/objects/walls.csv");
    folder.copy("examples/objects/scanner.chain");
    let study = std::fs::read_to_string(root().join("examples/objects/walls.toml")).expect("it is there");
    let exact = "z = \"1.6 m\", heading = \"0 deg\", roll = \"0.002 rad\", pitch = \"-0.001 rad\" }";
    folder.write("walls.toml", study.replace("z = \"1.6 m\", rough = true }", exact));
    calibrated(&folder, "walls.toml");
    let walls: [(&str, [f64; 3], f64); 8] = [
        ("floor", [0.0, 0.0, 1.0], 0.0),
        ("ceiling", [0.01, 0.0, -1.0], -3.4),
        ("north", [0.0, -1.0, 0.0], -7.0),
        ("south", [0.02, 1.0, 0.0], -5.5),
        ("east", [-1.0, 0.03, 0.0], -8.0),
        ("west", [1.0, 0.0, 0.02], -6.5),
        ("board", [-0.6, -0.7, 0.3], -4.1),
        ("roof", [0.5, -0.2, -0.8], -4.6),
    ];
    let objects = table(&folder, "result/objects.csv");
    for (label, normal, distance) in walls {
        let own = &objects[label];
        let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
        let dot = |columns: [&str; 3]| {
            columns.iter().zip(normal).map(|(column, part)| number(own, column) * part / length).sum::<f64>()
        };
        let away = dot(["x [m]", "y [m]", "z [m]"]) - distance / length;
        let leans = (1.0 - dot(["normal_x", "normal_y", "normal_z"]).powi(2)).max(0.0).sqrt();
        let [offset, turn] = ["offset_sigma [m]", "normal_sigma [rad]"].map(|column| number(own, column));
        assert!(away.abs() < 4.0 * offset && offset < 3e-4, "{label}: {away} ± {offset}");
        assert!(leans < 4.0 * turn && turn < 3e-4, "{label}: {leans} ± {turn}");
    }
    let stations = [("B", [4.2, -1.1, 1.5], 1.3), ("C", [1.0, 3.9, 1.7], -2.2), ("D", [-3.1, 1.7, 0.9], 2.9)];
    let seen = table(&folder, "result/stations.csv");
    for (label, [x, y, z], heading) in stations {
        for (name, unit, truth) in [("x", "m", x), ("y", "m", y), ("z", "m", z), ("heading", "rad", heading)]
        {
            let own = &seen[label];
            let (value, sigma) =
                (number(own, &format!("{name} [{unit}]")), number(own, &format!("{name}_sigma [{unit}]")));
            assert!((value - truth).abs() < 4.0 * sigma, "{label}, {name}: {value} ± {sigma}, not {truth}");
        }
    }
}

/// A turn about a line of targets, which nothing holds, has no uncertainty; neither has what it moves.
#[test]
fn what_nothing_holds_has_no_uncertainty() {
    let folder = Folder::new("placed-line");
    folder.write("tracker.chain", TRACKER.replace("longer*range", "range_zero"));
    let random = &mut Random::new(5);
    let room = Room::new(random);
    let mut stated = String::from("[objects]\n");
    for (at, [x, y, z]) in room.targets.iter().enumerate().take(2) {
        stated += &format!("T{at} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\" }}\n");
    }
    folder.write("rows.csv", room.rows(random, 0.0)).write("study.toml", format!("{STUDY}{stated}"));
    let run = run_in(&folder.0, &["calibrate", "study.toml", "--out", "result"], "");
    assert!(run.code < 2, "{run}");
    let objects = table(&folder, "result/objects.csv");
    assert_eq!((objects["T0"]["origin"].as_str(), objects["T0"]["x_sigma [m]"].as_str()), ("exact", "0.0"));
    let told =
        |label: &str| ["x", "y", "z"].map(|name| !objects[label][&format!("{name}_sigma [m]")].is_empty());
    assert!((2..30).all(|at| told(&format!("T{at}")) == [false; 3]), "{objects:?}");
}

/// Tables that the study reads are not replaced.
#[test]
fn a_study_that_reads_objects_keeps_them() {
    let folder = Folder::new("placed-refused");
    folder.write("tracker.chain", TRACKER);
    let random = &mut Random::new(3);
    let rows = Room::new(random).rows(random, 0.0);
    folder.write("objects.csv", &rows).write("study.toml", STUDY.replace("rows.csv", "objects.csv"));
    let run = run_in(&folder.0, &["calibrate", "study.toml", "--out", "."], "");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("objects.csv"), "{run}");
    assert_eq!(folder.read("objects.csv"), rows);
}
