//! Where memory is limited, a command works, or says that the limit is too low and ends as for any bad input.

use std::fs;
use std::process::Command;

use crate::shaft;
use crate::support::{Folder, Run};

/// Runs the command with at most so many MB of addresses.
fn within(folder: &Folder, limit_mb: u32, words: &str) -> Run {
    let script = format!("ulimit -v {}; exec \"$@\"", limit_mb * 1000);
    let output = Command::new("sh")
        .args(["-c", &script, "sh", env!("CARGO_BIN_EXE_trueaxis")])
        .args(words.split(' '))
        .current_dir(&folder.0)
        .output()
        .expect("a shell starts");
    Run {
        code: output.status.code().expect("no signal ends the command"),
        stdout: String::from_utf8(output.stdout).expect("UTF-8"),
        stderr: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

/// A declaration of many errors, which takes memory.
fn wide() -> String {
    let errors: Vec<String> =
        (0..1000).map(|number| format!("R{}(e{number})", ["x", "y", "z"][number % 3])).collect();
    format!(
        "chain Wide {{ body top on ground {{ motion: Rz(turn); motion_error: {}; }} body tip on top {{ motion: Rx(tilt); }} \
         observe mark: point(0.1, 0.2, 0.3) of tip; }}",
        errors.join(", ")
    )
}

/// Every command of the program, with what it reads in the folder. What names a folder or file to write is removed before each run.
const COMMANDS: [&str; 22] = [
    "init measured.csv --template alt-azimuth --out begun.toml",
    "derive wide.chain",
    "derive wide.chain --format latex",
    "identify shaft.chain",
    "identify study.toml",
    "bound wide.chain --sizes wide.toml",
    "check claims.toml",
    "budget wide.chain --sizes wide.toml",
    "generate wide.chain --language rust --out wide.rs",
    "simulate shaft.chain --errors e.toml --poses 100000 --noise 1arcsec --seed 1 --out made.csv",
    "eval shaft.chain --errors e.toml --data poses.csv --out out.csv",
    "calibrate study.toml --out result",
    "apply shaft.chain --errors e.toml --data poses.csv --as vector --out out.csv",
    "apply kept/instrument.toml --data measured.csv --out out.csv",
    "compare kept/instrument.toml kept/instrument.toml",
    "verify kept/instrument.toml --data measured.csv",
    "export kept/instrument.toml --form table --out made.csv",
    "class new --students names.csv --seed phrase --level 1 --out class",
    "class grade handed --key handed.key.toml",
    "completions bash",
    "manual --out pages",
    "derive nowhere.chain",
];
/// What they write.
const WRITTEN: [&str; 9] = [
    "begun.toml",
    "begun.chain",
    "wide.rs",
    "made.csv",
    "out.csv",
    "result",
    "class",
    "class.key.toml",
    "pages",
];

#[test]
fn every_command_works_within_a_limit_or_says_that_it_is_too_low() {
    let folder = shaft("limited");
    folder
        .write("wide.chain", wide())
        .write("wide.toml", "\"e*\" = \"1 arcsec\"\n")
        .write("names.csv", "name\nAda\nBo\n")
        .write(
            "claims.toml",
            "chain = \"shaft.chain\"\n[[claim]]\nname = \"one\"\ncount = { errors = \"*\", equals = 1 }\n",
        );
    crate::done(&crate::words(&folder, "calibrate study.toml --out kept"));
    crate::done(&crate::words(
        &folder,
        "class new --students names.csv --seed phrase --level 1 --out handed",
    ));
    let before = folder.names();
    let mut refused = 0;
    for command in COMMANDS {
        let remove = || {
            for name in WRITTEN {
                let place = folder.0.join(name);
                let _ = if place.is_dir() { fs::remove_dir_all(place) } else { fs::remove_file(place) };
            }
        };
        remove();
        let free = crate::words(&folder, command);
        // As tests build it, the program itself is 48 MB: at 50 the system cannot load it.
        for limit_mb in [1000, 300, 100, 54] {
            remove();
            let run = within(&folder, limit_mb, command);
            let is_told = run.stderr.contains("of memory is too low for this command: ");
            assert!(run.code == free.code || run.code == 2 && is_told, "{command}, {limit_mb} MB: {run}");
            if run.code != free.code {
                refused += 1;
                assert_eq!(folder.names(), before, "{command}, {limit_mb} MB: nothing is written");
            }
        }
    }
    assert!(refused > 0, "some limit is too low");
}

#[test]
fn a_limit_that_is_high_changes_nothing() {
    let folder = shaft("limited-high");
    let within = |words: &str| within(&folder, 8000, words);
    assert_eq!(within("derive nowhere.chain").code, 2);
    let free = folder.trueaxis(&["derive", "shaft.chain"]);
    let limited = within("derive shaft.chain");
    assert_eq!((free.code, free.stdout, free.stderr), (limited.code, limited.stdout, limited.stderr));
}
