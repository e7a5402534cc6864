//! Where results go: whole or not at all, together, and never over what the command reads.

#[path = "../support/mod.rs"]
mod support;

#[cfg(target_os = "linux")]
mod limited;

use std::fs;

use support::{Folder, Run};

const SHAFT: &str = "chain Shaft {
    body shaft on ground { motion: Rz(-reading); motion_error: Rz(-index); }
    observe mark: direction(0, 1, 0) of shaft;
}
";
const STUDY: &str = "chain = \"shaft.chain\"
data = \"measured.csv\"
[observed]
kind = \"direction\"
[hold_out]
folds = 3
";

/// A folder with a declaration, its errors, poses, a study and its data.
fn shaft(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("shaft.chain", SHAFT).write("e.toml", "index = \"3 arcsec\"\n").write("study.toml", STUDY);
    folder.write("poses.csv", "reading [deg]\n10\n20\n");
    let simulate =
        "simulate shaft.chain --errors e.toml --poses 30 --noise 1arcsec --seed 1 --out measured.csv";
    done(&words(&folder, simulate));
    folder
}

fn words(folder: &Folder, words: &str) -> Run {
    folder.trueaxis(&words.split(' ').collect::<Vec<_>>())
}

fn done(run: &Run) {
    assert_eq!(run.code, 0, "{run}");
}

fn refused(run: &Run, why: &str) {
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains(why), "{run}");
}

const EVAL: &str = "eval shaft.chain --errors e.toml --data poses.csv --out";
const CALIBRATE: &str = "calibrate study.toml --out";
const FILES: [&str; 6] =
    ["amended.chain", "errors.toml", "instrument.toml", "report.html", "report.json", "residuals.csv"];

#[test]
fn the_files_of_a_calibration_appear_together_or_not_at_all() {
    let folder = shaft("together");
    let before = folder.names();
    done(&words(&folder, &format!("{CALIBRATE} new/result")));
    assert_eq!(fs::read_dir(folder.0.join("new")).expect("made").count(), 1, "nothing is left beside it");
    for name in FILES {
        assert!(folder.0.join("new/result").join(name).is_file(), "{name}");
    }
    fs::create_dir_all(folder.0.join("there/report.html")).expect("a folder where a file is to stand");
    folder.write("there/errors.toml", "what stood there").write("there/mine.txt", "mine");
    refused(&words(&folder, &format!("{CALIBRATE} there")), "report.html");
    let there = Folder(folder.0.join("there"));
    assert_eq!(there.names(), ["errors.toml", "mine.txt", "report.html"]);
    assert_eq!(there.read("errors.toml"), "what stood there");
    fs::remove_dir(folder.0.join("there/report.html")).expect("empty");
    done(&words(&folder, &format!("{CALIBRATE} there")));
    assert_eq!(
        there.names(),
        [
            "amended.chain",
            "errors.toml",
            "instrument.toml",
            "mine.txt",
            "report.html",
            "report.json",
            "residuals.csv"
        ]
    );
    assert_ne!(there.read("errors.toml"), "what stood there");
    assert_eq!(folder.names().len(), before.len() + 2);
}

#[test]
fn residuals_of_very_many_rows_are_a_part_that_stands_for_all() {
    let folder = shaft("many-rows");
    let simulate =
        "simulate shaft.chain --errors e.toml --poses 100500 --noise 1arcsec --seed 1 --out measured.csv";
    done(&words(&folder, simulate));
    // One row that is far off.
    let text = folder.read("measured.csv");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut far: Vec<&str> = lines[777].split(',').collect();
    let components = far.len() - 3;
    far.splice(components.., ["0", "0", "1"]);
    lines[777] = far.join(",");
    folder.write("measured.csv", lines.join("\n") + "\n");
    let run = words(&folder, &format!("{CALIBRATE} part"));
    done(&run);
    assert!(run.stderr.contains("residuals.csv has 100000 of 100500 rows"), "{run}");
    let part = folder.read("part/residuals.csv");
    let (header, rows) = part.split_once('\n').expect("a header");
    assert!(header.starts_with("row,") && header.ends_with(",weight,stands_for"), "{header}");
    let cells: Vec<Vec<&str>> = rows.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(cells.len(), 100_000);
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let all: f64 = cells.iter().map(|row| number(row.last().expect("a cell"))).sum();
    assert!((all - 100_500.0).abs() < 1e-6, "{all}");
    assert!(cells.iter().is_sorted_by(|a, b| number(a[0]) < number(b[0])), "in the order of the file");
    let aside: Vec<&Vec<&str>> = cells.iter().filter(|row| number(row[row.len() - 2]) == 0.0).collect();
    assert!(aside.iter().any(|row| row[0] == "777" && number(row[row.len() - 1]) == 1.0), "{aside:?}");

    let run = words(&folder, &format!("{CALIBRATE} all --all-residuals"));
    done(&run);
    assert!(!run.stderr.contains("residuals.csv has"), "{run}");
    let all = folder.read("all/residuals.csv");
    assert_eq!(all.lines().count(), 100_501);
    assert!(all.lines().next().is_some_and(|header| header.ends_with(",weight")), "no part, no share");
    // What is in both says the same.
    let of_all: Vec<&str> = all.lines().collect();
    for row in rows.lines() {
        let (own, _) = row.rsplit_once(',').expect("a row");
        let at: usize = own.split(',').next().expect("a cell").parse().expect("a row number");
        assert_eq!(of_all[at], own);
    }
    refused(&words(&folder, "calibrate study.toml --all-residuals"), "--out");
}

#[test]
fn a_place_that_fails_late_gives_back_what_was_replaced() {
    let folder = shaft("late");
    fs::create_dir(folder.0.join("x.h")).expect("a folder where the header is to stand");
    folder.write("x.c", "what stood there");
    refused(&words(&folder, "generate shaft.chain --language c --out x.c"), "x.h");
    assert_eq!(folder.read("x.c"), "what stood there");
    assert!(folder.names().iter().all(|name| !name.ends_with(".partial")), "{:?}", folder.names());
}

#[test]
fn nothing_is_written_over_what_the_command_reads() {
    let folder = shaft("over-input");
    let why = "which this command reads";
    fs::create_dir(folder.0.join("sub")).expect("a folder");
    let study = |chain: &str, data: &str| STUDY.replace("shaft.chain", chain).replace("measured.csv", data);
    folder.write("amended.chain", SHAFT).write("amended.toml", study("amended.chain", "measured.csv"));
    refused(&words(&folder, "calibrate amended.toml --out ."), why);
    fs::copy(folder.0.join("measured.csv"), folder.0.join("sub/residuals.csv")).expect("copied");
    folder.write("residuals.toml", study("shaft.chain", "sub/../sub/residuals.csv"));
    refused(&words(&folder, "calibrate residuals.toml --out sub"), why);
    for out in ["shaft.chain", "e.toml", "./sub/../shaft.chain"] {
        refused(&words(&folder, &format!("{EVAL} {out}")), why);
        let simulate = "simulate shaft.chain --errors e.toml --poses 3 --noise 1arcsec --seed 1 --out";
        refused(&words(&folder, &format!("{simulate} {out}")), why);
    }
    let data = folder.read("measured.csv");
    for command in ["eval", "apply"] {
        let run = format!("{command} shaft.chain --errors e.toml --data measured.csv --out ./measured.csv");
        refused(&words(&folder, &run), why);
    }
    assert_eq!(folder.read("measured.csv"), data);
    refused(&words(&folder, "generate shaft.chain --language rust --out shaft.chain"), why);
    refused(&words(&folder, "generate shaft.chain --language c --out x.h"), "header");
    refused(&words(&folder, "generate shaft.chain --language c --out x.H"), "header");
    assert_eq!(folder.read("shaft.chain"), SHAFT);
}

#[test]
fn what_an_interrupted_run_left_is_removed_and_what_another_writes_is_not() {
    let folder = shaft("stale");
    let (left, mine) = (".out.csv.0123456789abcdef.partial", ".out.csv.fedcba9876543210.partial");
    folder.write(left, "half a").write(mine, "half a").write(".out.csv.notes.partial", "the user's");
    fs::create_dir(folder.0.join(".result.0123456789abcdef.partial")).expect("a folder");
    folder.write(".result.0123456789abcdef.partial/report.json", "{");
    let writing = fs::File::open(folder.0.join(mine)).expect("it is there");
    writing.lock().expect("locked as its writer would");
    done(&words(&folder, &format!("{EVAL} out.csv")));
    done(&words(&folder, &format!("{CALIBRATE} result")));
    let partial: Vec<String> = folder.names().into_iter().filter(|name| name.ends_with("partial")).collect();
    assert_eq!(partial, [mine, ".out.csv.notes.partial"]);
}

#[cfg(unix)]
mod links {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    use std::process::Command;

    use super::*;

    #[test]
    fn links_are_written_through() {
        let folder = shaft("links");
        fs::create_dir(folder.0.join("far")).expect("a folder");
        folder.write("far/real.csv", "old");
        symlink("far/real.csv", folder.0.join("near.csv")).expect("a link");
        symlink("near.csv", folder.0.join("nearer.csv")).expect("a link");
        symlink("far/to-come.csv", folder.0.join("dangling.csv")).expect("a link");
        symlink("circle.csv", folder.0.join("circle.csv")).expect("a link");
        done(&words(&folder, &format!("{EVAL} nearer.csv")));
        done(&words(&folder, &format!("{EVAL} dangling.csv")));
        refused(&words(&folder, &format!("{EVAL} circle.csv")), "circle");
        for link in ["near.csv", "nearer.csv", "dangling.csv"] {
            assert!(fs::symlink_metadata(folder.0.join(link)).expect("there").is_symlink(), "{link}");
        }
        assert!(folder.read("far/real.csv").starts_with("reading [deg],mark_x"));
        assert_eq!(folder.read("far/real.csv"), folder.read("far/to-come.csv"));
    }

    #[test]
    fn the_names_of_standard_output_mean_standard_output() {
        let folder = shaft("descriptors");
        let expected = words(&folder, &format!("{EVAL} -")).stdout;
        symlink("/dev/stdout", folder.0.join("out.csv")).expect("a link");
        for name in ["/dev/stdout", "/dev/fd/1", "out.csv"] {
            let run = words(&folder, &format!("{EVAL} {name}"));
            assert_eq!((run.code, run.stdout.as_str()), (0, expected.as_str()), "{name}: {run}");
            // Into a file that the shell has opened, behind what stands there already.
            let file = folder.0.join("log.txt");
            fs::write(&file, "before\n").expect("written");
            let log = fs::File::options().append(true).open(&file).expect("opened");
            let words = format!("{EVAL} {name}");
            let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
            let status = command.args(words.split(' ')).current_dir(&folder.0).stdout(log).status();
            assert!(status.expect("it runs").success());
            assert_eq!(folder.read("log.txt"), format!("before\n{expected}"), "{name}");
        }
        done(&words(&folder, &format!("{EVAL} /dev/null")));
        assert!(!fs::metadata("/dev/null").expect("still there").is_file());
    }

    #[test]
    fn an_existing_file_keeps_its_mode_and_one_that_is_read_only_stays() {
        let folder = shaft("modes");
        let mode =
            |name: &str| fs::metadata(folder.0.join(name)).expect("there").permissions().mode() & 0o777;
        for bits in [0o600, 0o664, 0o755] {
            folder.write("out.csv", "old");
            fs::set_permissions(folder.0.join("out.csv"), fs::Permissions::from_mode(bits)).expect("set");
            done(&words(&folder, &format!("{EVAL} out.csv")));
            assert_eq!(mode("out.csv"), bits);
        }
        folder.write("kept.csv", "kept");
        fs::set_permissions(folder.0.join("kept.csv"), fs::Permissions::from_mode(0o444)).expect("set");
        refused(&words(&folder, &format!("{EVAL} kept.csv")), "read-only");
        assert_eq!(folder.read("kept.csv"), "kept");
    }
}

/// A limit of the size of files stands for a full disk: both are told by a write that fails. What was there stays, and nothing is left.
#[cfg(unix)]
#[test]
fn a_disk_that_is_full_is_told_and_what_was_there_stays() {
    let folder = shaft("full");
    folder.write("poses.csv", format!("reading [deg]\n{}", "10.25\n".repeat(20_000)));
    folder.write("out.csv", "what stood there").write("wide.chain", full_chain());
    fs::create_dir(folder.0.join("there")).expect("a folder");
    folder.write("there/report.json", "what stood there");
    let before = folder.names();
    for command in [
        "eval shaft.chain --errors e.toml --data poses.csv --out out.csv",
        "eval shaft.chain --errors e.toml --data poses.csv --out new.csv",
        "apply shaft.chain --errors e.toml --data poses.csv --as vector --out out.csv",
        "simulate shaft.chain --errors e.toml --poses 20000 --noise 1arcsec --seed 1 --out out.csv",
        "generate wide.chain --language c --out out.c",
        "calibrate study.toml --out there",
        "calibrate study.toml --out new",
        "eval shaft.chain --errors e.toml --data poses.csv --out /dev/full",
    ] {
        // Of blocks of 512 bytes; a report alone has more.
        let script = "trap '' XFSZ; ulimit -f 12; exec \"$@\"";
        let output = std::process::Command::new("sh")
            .args(["-c", script, "sh", env!("CARGO_BIN_EXE_trueaxis")])
            .args(command.split(' '))
            .current_dir(&folder.0)
            .output()
            .expect("a shell starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{command}: {said}");
        assert!(said.lines().any(|line| line.starts_with("error: ")), "{command}: {said}");
        assert_eq!(folder.names(), before, "{command}");
    }
    assert_eq!(folder.read("out.csv"), "what stood there");
    let there = Folder(folder.0.join("there"));
    assert_eq!(there.names(), ["report.json"]);
    assert_eq!(there.read("report.json"), "what stood there");
}

/// A declaration whose generated code is long.
#[cfg(unix)]
fn full_chain() -> String {
    let errors: Vec<String> = (0..200).map(|number| format!("Rx(e{number})")).collect();
    format!(
        "chain Wide {{ body top on ground {{ motion: Rz(turn); motion_error: {}; }} observe mark: point(0.1, 0.2, 0.3) of top; }}",
        errors.join(", ")
    )
}

/// Interrupted between two rows, a command leaves what it found: neither a part of its output, nor what it writes that into.
#[cfg(unix)]
#[test]
fn an_interrupted_command_leaves_nothing_behind() {
    use std::io::Write as _;
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    for (signal, command) in [("INT", "apply"), ("TERM", "apply"), ("TERM", "eval")] {
        let folder = shaft(&format!("interrupted_{signal}_{command}"));
        folder.write("out.csv", "what stood there\n");
        let before = folder.names();
        let mut running = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
            .args([command, "shaft.chain", "--errors", "e.toml", "--data", "-", "--out", "out.csv"])
            .current_dir(&folder.0)
            .stdin(Stdio::piped())
            .spawn()
            .expect("a command");
        let rows = format!("reading [deg]\n{}", "10.25\n".repeat(100_000));
        let mut stdin = running.stdin.take().expect("piped");
        stdin.write_all(rows.as_bytes()).expect("it reads");
        let began = Instant::now();
        while folder.names() == before {
            assert!(began.elapsed() < Duration::from_secs(60), "it writes");
            std::thread::sleep(Duration::from_millis(5));
        }
        let id = running.id().to_string();
        let sent = Command::new("kill").args([&format!("-{signal}"), &id]).status().expect("kill");
        assert!(sent.success());
        let ended = running.wait().expect("it ends");
        assert_eq!(ended.code(), Some(130), "{signal}");
        assert_eq!(folder.names(), before, "{signal}");
        assert_eq!(folder.read("out.csv"), "what stood there\n");
    }
}

/// Who reads the output has seen enough, while more rows may come: the command ends, and waits for none of them.
#[test]
fn a_command_that_nobody_reads_ends_while_its_input_is_open() {
    use std::io::{Read as _, Write as _};
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};

    let folder = shaft("nobody_reads");
    let mut running = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
        .args(["eval", "shaft.chain", "--errors", "e.toml", "--data", "-", "--out", "-"])
        .current_dir(&folder.0)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("a command");
    let mut output = running.stdout.take().expect("piped");
    let mut input = running.stdin.take().expect("piped");
    let (seen, has_seen) = std::sync::mpsc::channel();
    // Nobody reads from the moment on when the first rows were seen: kept open, the pipe would fill up, and all would wait.
    std::thread::spawn(move || {
        output.read_exact(&mut [0; 100]).expect("it writes");
        drop(output);
        seen.send(()).expect("the test waits");
    });
    input.write_all(b"reading [deg]\n").expect("it reads");
    while has_seen.try_recv().is_err() {
        if input.write_all("10.25\n".repeat(1000).as_bytes()).is_err() {
            break;
        }
    }
    let began = Instant::now();
    while running.try_wait().expect("a process").is_none() {
        assert!(began.elapsed() < Duration::from_secs(60), "it ends");
        std::thread::sleep(Duration::from_millis(5));
    }
    drop(input);
}
