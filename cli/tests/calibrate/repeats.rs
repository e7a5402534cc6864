//! Rows that are there twice, rows that were fitted and are held out, labels that are missing, and few places that are known.

use serde_json::Value;

use crate::support::{Folder, Run, run_in};

const STUDY: &str = "targets.toml";
const DATA: &str = "targets.csv";

/// The targets of `examples/objects` in a folder of the test's own.
fn targets(name: &str) -> (Folder, Vec<String>) {
    let folder = Folder::new(name);
    for file in [STUDY, DATA, "scanner.chain"] {
        folder.copy(&format!("examples/objects/{file}"));
    }
    let lines = folder.read(DATA).lines().map(str::to_owned).collect();
    (folder, lines)
}

fn calibrated(folder: &Folder) -> (Run, Value) {
    let run = run_in(&folder.0, &["calibrate", STUDY, "--format", "json"], "");
    assert_eq!(run.code, 0, "{run}");
    let report = serde_json::from_str(&run.stdout).expect("JSON");
    (run, report)
}

/// However rows come to be there twice, they count once, and it is said.
#[test]
fn rows_that_are_there_twice_count_once() {
    let (folder, lines) = targets("repeats-twice");
    let (_, once) = calibrated(&folder);
    let (header, rows) = lines.split_first().expect("a header");
    let pasted: Vec<&String> = rows.iter().chain(rows).collect();
    let doubled: Vec<&String> = rows.iter().flat_map(|row| [row, row]).collect();
    let logged_again: Vec<&String> = rows.iter().chain(rows.iter().step_by(50)).collect();
    for (written, repeats, first) in
        [(pasted, 192, "row 193"), (doubled, 192, "row 2,"), (logged_again, 4, "row 193")]
    {
        let text: String = written.into_iter().map(|row| format!("{row}\n")).collect();
        folder.write(DATA, format!("{header}\n{text}"));
        let (run, report) = calibrated(&folder);
        assert!(run.stderr.contains(&format!("{repeats} rows repeat others")), "{run}");
        assert!(run.stderr.contains(first), "{run}");
        agree(&report, &once, 1e-4);
    }
}

/// Of an encoder that shows whole minutes of arc, and a reference that does as well, readings repeat by chance: all of them count.
#[test]
fn readings_of_few_digits_repeat_by_chance() {
    let folder = Folder::new("repeats-coarse");
    folder.write(
        "table.chain",
        "chain Table { body top on ground { motion: Rz(angle); motion_error: Rz(index); }
            observe mark: direction(1, 0, 0) of top; }",
    );
    let mut random = testkit::Random::new(1);
    let mut row = || {
        let angle = random.below(40);
        format!("{angle},{}\n", angle + random.below(3))
    };
    let rows: String = (0..400).map(|_| row()).collect();
    folder.write("d.csv", format!("angle [deg],truth [deg]\n{rows}"));
    folder.write(
        STUDY,
        "chain = \"table.chain\"\ndata = \"d.csv\"\n[observed]\nkind = \"spherical\"\nazimuth = \"truth\"\n",
    );
    let run = run_in(&folder.0, &["calibrate", STUDY, "--format", "json"], "");
    assert!(!run.stderr.contains("repeat others"), "{run}");
}

/// What is held out has to be what nobody fitted: neither the same file nor a copy of it.
#[test]
fn what_is_fitted_is_not_held_out() {
    let folder = Folder::new("repeats-held-out");
    for file in ["study.toml", "mobile-lidar.chain", "measured.csv"] {
        folder.copy(&format!("examples/mobile-lidar/{file}"));
    }
    folder.write("copy.csv", folder.read("measured.csv"));
    let study = folder.read("study.toml");
    for file in ["measured.csv", "copy.csv"] {
        assert!(study.contains("[hold_out]"), "{study}");
        folder.write("held.toml", study.replace("[hold_out]", &format!("[hold_out]\nfile = \"{file}\"")));
        let run = run_in(&folder.0, &["calibrate", "held.toml", "--out", "result"], "");
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(file) && run.stderr.contains("nobody fitted"), "{run}");
        assert!(!folder.0.join("result").exists());
    }
}

#[test]
fn a_row_says_what_it_observes_and_from_where() {
    for (at, column) in ["station", "object"].into_iter().enumerate() {
        let (folder, mut lines) = targets(&format!("repeats-label-{column}"));
        let mut cells: Vec<&str> = lines[7].split(',').collect();
        cells[at] = " ";
        lines[7] = cells.join(",");
        folder.write(DATA, lines.join("\n") + "\n");
        let run = run_in(&folder.0, &["calibrate", STUDY, "--out", "result"], "");
        assert_eq!(run.code, 2, "{run}");
        let place = format!("{DATA}: line 8, row 7, column `{column}`");
        assert!(run.stderr.contains(&place) && run.stderr.contains("fill in the label"), "{run}");
        assert!(!folder.0.join("result").exists());
    }
}

/// A target that is known holds where all stands: the errors are those that no known target gives.
#[test]
fn a_known_target_is_no_hindrance() {
    let (folder, _) = targets("repeats-known");
    let (_, free) = calibrated(&folder);
    let study = folder.read(STUDY);
    folder.write(STUDY, format!("{study}\n[objects]\nT1 = {{ x = \"3 m\", y = \"-7 m\", z = \"1.5 m\" }}\n"));
    let (_, held) = calibrated(&folder);
    agree(&held, &free, 0.01);
}

/// A row without a label of its group is of no group: such rows together are none either.
#[test]
fn a_row_says_to_which_group_it_belongs() {
    let (folder, lines) = targets("repeats-groups");
    let study = folder.read(STUDY);
    for (cell, key) in [("", "[noise]\ngroup"), ("NaN", "[noise]\ngroup"), ("", "[hold_out]\ntogether")] {
        let rows = lines.iter().enumerate().map(|(at, line)| match at {
            0 => format!("{line},day\n"),
            7 => format!("{line},{cell}\n"),
            at => format!("{line},{}\n", at / 20),
        });
        folder.write(DATA, rows.collect::<String>());
        folder.write(STUDY, format!("{study}\n{key} = \"day\"\n"));
        let run = run_in(&folder.0, &["calibrate", STUDY], "");
        assert_eq!(run.code, 2, "{run}");
        let place = "targets.csv: line 8, row 7, column `day`: the cell is empty";
        assert!(run.stderr.contains(place) && run.stderr.contains("which group"), "{run}");
    }
}

/// The same errors, apart by no more than this share of their ±.
fn agree(report: &Value, other: &Value, share: f64) {
    let errors = |report: &Value| report["errors"].as_array().cloned().expect("a list");
    assert_eq!(errors(report).len(), errors(other).len());
    for (own, other) in errors(report).iter().zip(&errors(other)) {
        let of = |error: &Value, key: &str| error[key].as_f64().expect("a number");
        let apart = of(own, "value") - of(other, "value");
        assert!(apart.abs() < share * of(other, "standard_uncertainty"), "{own}\n{other}");
    }
}
