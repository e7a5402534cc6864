//! What surrounds the answers: completions, manual pages, colours, silence, the width of lines.

#[path = "../support/grade.rs"]
mod grade;
mod plain;
#[path = "../support/mod.rs"]
mod support;

use std::process::Command;

use serde_json::Value;
use support::{Folder, root, trueaxis};

const LIDAR: &str = "examples/mobile-lidar/mobile-lidar.chain";
const BOX: &str = "examples/mobile-lidar/box.toml";
const COURSE: &str = "examples/course/study.toml";

/// Every command there is, as the help lists them.
fn commands() -> Vec<String> {
    let help = trueaxis(&["--help"]).stdout;
    let list = help.split("Commands:").nth(1).and_then(|rest| rest.split("Options:").next()).expect("a list");
    let names = list.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names: Vec<String> =
        names.filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect();
    assert!(names.len() > 10, "{names:?}");
    names.into_iter().filter(|name| name != "help").collect()
}

#[test]
fn completions_name_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = trueaxis(&["completions", shell]);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{shell}");
        for command in commands() {
            assert!(run.stdout.contains(&command), "{shell}: {command}");
        }
    }
    assert_eq!(trueaxis(&["completions", "tcsh"]).code, 2);
}

#[test]
fn completions_of_bash_complete() {
    let Some(bash) = testkit::tool(testkit::BASH) else { return };
    let script = trueaxis(&["completions", "bash"]).stdout
        + "\nCOMP_WORDS=(trueaxis cal); COMP_CWORD=1; _trueaxis trueaxis cal trueaxis; echo \"${COMPREPLY[@]}\"\n";
    let bash = Command::new(bash).arg("-c").arg(script).output().expect("bash runs");
    assert_eq!(
        String::from_utf8_lossy(&bash.stdout).trim(),
        "calibrate",
        "{}",
        String::from_utf8_lossy(&bash.stderr)
    );
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = Folder::new("manual");
    let run = folder.trueaxis(&["manual", "--out", "man"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    let read = |name: &str| folder.read(&format!("man/{name}.1"));
    assert!(read("trueaxis").contains(".TH"), "{}", read("trueaxis"));
    for command in commands() {
        let page = read(&format!("trueaxis-{command}"));
        assert!(page.contains(".SH NAME") && page.contains(".SH SYNOPSIS"), "{command}: {page}");
    }
    assert!(read("trueaxis-class-grade").contains("KEY.toml"));
    // Flags that are kept for those who know them are not offered.
    assert!(!read("trueaxis-bound").contains("former name"));
}

/// Runs the command with a variable set.
fn with(variable: &str, value: &str, arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
    let command =
        command.args(arguments).current_dir(root()).env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    let output = command.env("CLICOLOR_FORCE", "1").env(variable, value).output().expect("it runs");
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn colours_heed_no_color() {
    let arguments = ["derive", LIDAR, "--observable", "pointing"];
    assert!(with("CLICOLOR_FORCE", "1", &arguments).contains('\u{1b}'));
    assert!(!with("NO_COLOR", "1", &arguments).contains('\u{1b}'));
    // Nor is there colour where nobody looks.
    assert!(!trueaxis(&arguments).stdout.contains('\u{1b}'));
}

#[test]
fn quiet_says_warnings_and_errors_and_nothing_else() {
    let said = trueaxis(&["calibrate", COURSE, "--dry-run"]);
    assert!(said.stderr.contains("160 observations"), "{said}");
    for place in 0..2 {
        let mut arguments = vec!["calibrate", COURSE, "--dry-run"];
        arguments.insert(2 * place, "--quiet");
        let quiet = trueaxis(&arguments);
        assert_eq!((quiet.stderr.as_str(), &quiet.stdout), ("", &said.stdout));
    }
    let warned = trueaxis(&[
        "bound",
        "examples/course/mount.chain",
        "--errors",
        "examples/course/box.toml",
        "--quiet",
    ]);
    assert!(warned.code == 0 && warned.stderr.contains("--errors is called --sizes here"), "{warned}");
    let refused = trueaxis(&["derive", "no.chain", "--quiet"]);
    assert!(refused.code == 2 && refused.stderr.starts_with("error: "), "{refused}");
}

#[test]
fn a_dry_run_tells_programs_the_whole_report_and_writes_nothing() {
    let folder = Folder::new("dry-run");
    folder.copy(COURSE).copy("examples/course/mount.chain").copy("examples/course/secret.csv");
    let before = folder.names();
    let run = folder.trueaxis(&["calibrate", "study.toml", "--dry-run", "--format", "json"]);
    assert_eq!(run.code, 0, "{run}");
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert!(report["schema"].as_u64() >= Some(4) && report["verdict"].is_string());
    assert!(
        report["diff"].as_str().is_some_and(|diff| diff.starts_with("--- mount.chain")),
        "{}",
        report["diff"]
    );
    assert_eq!(folder.names(), before);
    assert_eq!(folder.trueaxis(&["calibrate", "study.toml", "--dry-run", "--out", "x"]).code, 2);
}

#[test]
fn sizes_are_called_the_same_everywhere_and_go_by_their_former_name() {
    for command in [
        &["bound", LIDAR, "--observable", "pointing"][..],
        &["budget", LIDAR, "--observable", "pointing"],
        &["generate", LIDAR, "--language", "latex", "--out", "-", "--observable", "pointing"],
    ] {
        let by = |flag: &str| trueaxis(&[command, &[flag, BOX]].concat());
        let (now, before) = (by("--sizes"), by("--errors"));
        assert_eq!((now.code, now.stderr.as_str()), (0, ""), "{now}");
        assert_eq!(now.stdout, before.stdout);
        assert!(before.stderr.contains("--errors is called --sizes here"), "{before}");
        assert_eq!(trueaxis(&[command, &["--sizes", BOX, "--errors", BOX]].concat()).code, 2);
    }
    let neither = trueaxis(&["bound", LIDAR]);
    assert!(neither.code == 2 && neither.stderr.contains("--sizes BOX.toml"), "{neither}");
}

/// Letters of a line as a person sees them, without colours.
fn seen(text: &str) -> String {
    anstream::adapter::strip_str(text).to_string()
}

#[test]
fn a_calibration_fits_its_width() {
    for study in [COURSE, "examples/objects/wires.toml"] {
        let text = seen(&with("COLUMNS", "60", &["calibrate", study]));
        let (report, change) = text.split_once("The declaration, amended\n").unwrap_or((&text, ""));
        // Commands are to be copied, and the declaration is quoted.
        let last = change.split("\n\n").last().unwrap_or_default();
        let lines =
            report.lines().filter(|line| !line.trim_start().starts_with("trueaxis ")).chain(last.lines());
        for line in lines {
            assert!(line.chars().count() <= 60, "{study}: {line}");
        }
    }
}

/// Colours repeat what a word says: what is coloured is words, and the text is the same without.
#[test]
fn what_is_coloured_is_a_word() {
    let claims = "examples/mobile-lidar/paper.toml";
    for arguments in [&["calibrate", COURSE][..], &["derive", LIDAR], &["check", claims]] {
        let [coloured, plain] = ["CLICOLOR_FORCE", "NO_COLOR"].map(|variable| with(variable, "1", arguments));
        assert_eq!(seen(&coloured), plain, "{arguments:?}");
        let mut runs = coloured.split('\u{1b}').skip(1).filter_map(|run| run.split_once('m'));
        let words = runs.by_ref().filter(|(code, _)| *code != "[0").map(|(_, words)| words);
        let words: Vec<&str> = words.filter(|words| !words.is_empty()).collect();
        assert!(!words.is_empty(), "{arguments:?}");
        for word in words {
            // Carets mark a place by where they are.
            let is_mark = word.chars().all(|letter| letter == '^');
            assert!(is_mark || word.chars().any(char::is_alphabetic), "{arguments:?}: {word:?}");
        }
    }
}

#[test]
fn tables_fit_their_width() {
    for arguments in [
        &["identify", LIDAR][..],
        &["identify", "examples/ur10/ur10.chain"],
        &["bound", LIDAR, "--sizes", BOX, "--range", "range=1..10"],
        &["budget", LIDAR, "--sizes", BOX, "--range", "range=1..10"],
        &["init", "--list"],
    ] {
        for columns in ["60", "80"] {
            let text = with("COLUMNS", columns, arguments);
            let plain = anstream::adapter::strip_str(&text).to_string();
            let most: usize = columns.parse().expect("a number");
            // A word is never cut, and a column of numbers stays in its row.
            let least = if arguments[0] == "budget" { 80 } else { most };
            for line in plain.lines() {
                assert!(line.chars().count() <= most.max(least), "{arguments:?} at {columns}: {line}");
            }
        }
        // Nobody says how wide: a hundred letters.
        assert!(trueaxis(arguments).stdout.lines().all(|line| line.chars().count() <= 100), "{arguments:?}");
    }
    // Formulas are for whoever reads them next: one line each, unless a person looks.
    let formulas = trueaxis(&["derive", LIDAR, "--observable", "pointing"]).stdout;
    assert!(formulas.lines().filter(|line| line.starts_with("pointing_")).count() == 3, "{formulas}");
}
