//! Where memory is limited, a command works, or says that the limit is too low and ends as for any bad input.

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

#[test]
fn every_command_works_within_a_limit_or_says_that_it_is_too_low() {
    let folder = shaft("limited");
    folder.write("wide.chain", wide()).write("wide.toml", "\"e*\" = \"1 arcsec\"\n");
    let commands = [
        "derive wide.chain",
        "generate wide.chain --language rust --out wide.rs",
        "bound wide.chain --sizes wide.toml",
        "calibrate study.toml --out result",
        "eval shaft.chain --errors e.toml --data poses.csv --out out.csv",
    ];
    let mut refused = 0;
    for command in commands {
        for limit_mb in [1000, 100, 50] {
            let run = within(&folder, limit_mb, command);
            let is_told = run
                .stderr
                .contains(&format!("a limit of {} MB of memory is too low", limit_mb * 1024 / 1000));
            assert!(run.code == 0 || run.code == 2 && is_told, "{command}, {limit_mb} MB: {run}");
            refused += usize::from(run.code == 2);
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
