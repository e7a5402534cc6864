//! The commands that a report of `calibrate` prints run as they are printed, where nothing else lies.

use std::fs;

use crate::support::{Folder, Run, root};
use crate::{calibrated, mount};

/// The command lines that a report prints, in order.
fn printed(run: &Run) -> Vec<Vec<String>> {
    let lines = run.stdout.lines().map(str::trim).filter(|line| line.starts_with("trueaxis "));
    let words = |line: &str| line.split(' ').skip(1).map(str::to_owned).collect();
    lines.map(words).collect()
}

/// Runs every command that a calibration of a study prints, `new.csv` being the study's data without what was observed.
fn runs_as_printed(folder: &Folder, study: &str, data: &str, observed: &[&str]) -> String {
    let run = folder.trueaxis(&["calibrate", study]);
    assert_eq!(run.code, 0, "{study}: {run}");
    let commands = printed(&run);
    assert!(!commands.is_empty(), "{study}: {run}");
    folder.write("new.csv", without(&folder.read(data), observed));
    for command in &commands {
        let run = folder.trueaxis(&command.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(run.code, 0, "{study}: {command:?}: {run}");
    }
    folder.read("corrected.csv")
}

/// A table without some columns.
fn without(text: &str, names: &[&str]) -> String {
    let separator = if text.lines().next().is_some_and(|header| header.contains(';')) { ';' } else { ',' };
    let header: Vec<&str> = text.lines().next().expect("a header").split(separator).collect();
    let stays: Vec<bool> = header.iter().map(|cell| !names.contains(cell)).collect();
    let row = |line: &str| {
        let cells = line.split(separator).zip(&stays).filter(|(_, stays)| **stays).map(|(cell, _)| cell);
        cells.collect::<Vec<_>>().join(&separator.to_string()) + "\n"
    };
    text.lines().map(row).collect()
}

fn example(name: &str, files: &[&str]) -> Folder {
    let folder = Folder::new(&format!("printed-{}", name.replace('/', "-")));
    files.iter().for_each(|file| {
        folder.copy(&format!("examples/{name}/{file}"));
    });
    folder
}

#[test]
fn of_four_examples_and_of_a_study_with_headings_of_its_own() {
    // Each with its data and with the headings under which it is to write.
    let examples = [
        (
            "mobile-lidar",
            "study.toml",
            "mobile-lidar.chain",
            "measured.csv",
            &["pointing_x", "pointing_y", "pointing_z"],
        ),
        (
            "turntable",
            "turntable.toml",
            "turntable.chain",
            "measured.csv",
            &["pointing_x", "pointing_y", "pointing_z"],
        ),
        ("course", "study.toml", "mount.chain", "secret.csv", &["east", "north", "up"]),
        ("probed-arm", "arm.toml", "arm.chain", "poses.csv", &["x", "y", "z"]),
    ];
    for (name, study, chain, data, observed) in examples {
        let folder = example(name, &[study, chain, data]);
        let corrected = runs_as_printed(&folder, study, data, observed);
        let header = corrected.lines().next().expect("a header");
        assert!(header.ends_with(&observed.join(",")), "{name}: {header}");
        let rows = fs::read_to_string(root().join("examples").join(name).join(data)).expect("its data");
        assert_eq!(corrected.lines().count(), rows.lines().count(), "{name}");
        assert!(!corrected.contains("NaN"), "{name}");
    }
    let folder = mount("printed-mount");
    let corrected = runs_as_printed(&folder, "study.toml", "stars.csv", &["true az (deg)", "true el"]);
    assert!(corrected.starts_with("star,Az,zenith,pier,true az (deg),true el\n"), "{corrected}");
}

/// Written into a folder, the report names that folder.
#[test]
fn with_files_the_report_names_their_folder() {
    let folder = mount("printed-folder");
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "my result"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(
        run.stdout.contains("trueaxis apply 'my result/instrument.toml' --data new.csv --out corrected.csv"),
        "{run}"
    );
}

/// One command a change: each takes the file alone.
#[test]
fn every_command_takes_it_in_place_of_a_declaration() {
    let folder = calibrated("printed-every");
    let file = "result/instrument.toml";
    for command in [
        vec!["apply", file, "--data", "stars.csv", "--out", "a.csv"],
        vec!["eval", file, "--data", "stars.csv", "--out", "b.csv"],
        vec!["generate", file, "--language", "c", "--out", "m.c"],
        vec!["identify", file],
        vec!["bound", file],
        vec!["budget", file],
        vec!["bound", file, "--sizes", "box.toml"],
        vec!["budget", file, "--sizes", "box.toml"],
    ] {
        folder.write("box.toml", "\"*\" = \"10 arcsec\"\n");
        let run = folder.trueaxis(&command);
        assert_eq!(run.code, 0, "{command:?}: {run}");
    }
    // The errors stand in the code: no field is left for them.
    assert!(!folder.read("m.h").contains("collimation;"), "{}", folder.read("m.h"));
    let bound = folder.trueaxis(&["bound", file]);
    assert!(bound.stderr.contains("the value plus two standard uncertainties"), "{bound}");
    // The side of the pier has the range that was measured.
    assert!(bound.stdout.contains("pointing"), "{bound}");
}
