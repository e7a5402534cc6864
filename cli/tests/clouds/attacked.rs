//! Clouds that somebody made on purpose: huge records, records whose lengths lie, corrections that are no numbers; and a run that is
//! interrupted, has no room, or one thread.

use std::process::{Command, Output};

use crate::support::{Folder, Run};
use crate::whole::{Whole, number};
use crate::{applied, apply, bytes, folder, refused};

/// Where the header of `file` says that its points begin.
fn points_at(file: &[u8]) -> usize {
    u32::from_le_bytes(number(file, 96)) as usize
}

/// Points of 65,535 bytes, the most that a header can say, are corrected as short ones are; in LAZ too.
#[test]
fn points_as_long_as_can_be_are_corrected() {
    let file = bytes("v12f1.las");
    let (start, short) = (points_at(&file), usize::from(u16::from_le_bytes(number(&file, 105))));
    let mut long = file[..start].to_vec();
    long[105..107].copy_from_slice(&u16::MAX.to_le_bytes());
    for (row, point) in file[start..].chunks_exact(short).enumerate() {
        let more = (0..usize::from(u16::MAX) - short).map(|at| ((at * 31 + row * 7) % 251) as u8);
        long.extend(point.iter().copied().chain(more));
    }
    let folder = folder("cloud_long_points", &["v12f1.las"]);
    folder.write("long.las", &long);
    let expected = Whole::of(&applied(&folder, "v12f1.las", "short.out.las", &[])).steps();
    let before = Whole::of(&long).without_coordinates();
    for out in ["long.out.las", "long.out.laz"] {
        let after = Whole::of(&applied(&folder, "long.las", out, &[]));
        assert_eq!(after.steps(), expected, "{out}");
        assert!(after.without_coordinates() == before, "{out}: every other byte stays");
    }
}

/// Counts and lengths of records, up to more than any file has.
#[test]
fn records_whose_counts_or_lengths_lie_are_refused() {
    let folder = folder("cloud_records", &[]);
    let file = bytes("v14f6.las");
    let size = usize::from(u16::from_le_bytes(number(&file, 94)));
    let extended = usize::try_from(u64::from_le_bytes(number(&file, 235))).expect("small");
    let with = |at: usize, new: &[u8]| {
        let mut file = file.clone();
        file[at..at + new.len()].copy_from_slice(new);
        file
    };
    let long = u64::MAX.to_le_bytes();
    for (what, file, wanted) in [
        ("four thousand million records", with(100, &[0xff; 4]), "goes beyond the start of the points"),
        ("a record of 65,535 bytes", with(size + 20, &[0xff; 2]), "its record 1 goes beyond the start"),
        ("as many extended ones", with(243, &[0xff; 4]), "goes beyond its end"),
        ("an extended record of 2^64 bytes", with(extended + 20, &long), "its extended record 1 goes beyond"),
        (
            "one of 2^63",
            with(extended + 20, &(1_u64 << 63).to_le_bytes()),
            "its extended record 1 goes beyond",
        ),
        ("extended records at 2^64", with(235, &long), "its extended record 1 goes beyond"),
        ("extended records within the points", with(235, &100_u64.to_le_bytes()), "extended record"),
        ("a header of 65,535 bytes", with(94, &[0xff; 2]), "within its header"),
        ("points behind the end", with(96, &[0xff; 4]), "points begin at byte"),
        ("points within the header", with(96, &[8, 0, 0, 0]), "points begin at byte"),
    ] {
        folder.write("lying.las", file);
        for out in ["out.las", "out.laz"] {
            let said = refused(&folder, "lying.las", out, &[]);
            assert!(said.starts_with("error: lying.las: ") && said.contains(wanted), "{what}: {said}");
        }
    }
}

/// A correction beyond all numbers ends with the point that it would move; nothing is written.
#[test]
fn corrections_that_are_no_numbers_are_refused() {
    let folder = folder("cloud_no_number", &["v12f1.las"]);
    for errors in [
        "beside = nan",
        "beside = inf",
        "beside = \"1e308 m\"\naskew = 1.5",
        "beside = 1e400",
        "tilt = -inf",
        "beside = \"1e300 m\"",
    ] {
        folder.write("errors.toml", errors);
        for out in ["out.las", "out.laz"] {
            let said = refused(&folder, "v12f1.las", out, &[]);
            let error = said.lines().find(|line| line.starts_with("error: ")).unwrap_or_default();
            let is_of_point = error.starts_with("error: v12f1.las: point 1: ");
            assert!(is_of_point || said.contains("errors.toml"), "{errors}: {said}");
            assert!(!error.is_empty() && error.len() < 400, "{errors}: {said}");
        }
    }
}

fn command(folder: &Folder, data: &str, out: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_trueaxis"));
    command.args(["apply", "scanner.chain", "--errors", "errors.toml", "--data", data, "--out", out]);
    command.current_dir(&folder.0);
    command
}

fn run(output: Output) -> Run {
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    let code = output.status.code().expect("no signal ends the command");
    Run { code, stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// A file of many points, whose batches several threads share.
fn many(folder: &Folder, count: usize) {
    let small = bytes("v12f1.las");
    let start = points_at(&small);
    let mut file = small[..start].to_vec();
    file.extend(small[start..].iter().cycle().take(count * 57));
    file[107..111].copy_from_slice(&u32::try_from(count).expect("small").to_le_bytes());
    folder.write("many.las", file);
}

#[test]
fn one_thread_and_two_write_the_same_bytes() {
    let folder = folder("cloud_threads", &[]);
    many(&folder, 150_001);
    for end in ["las", "laz"] {
        let written = [1, 2, 3].map(|threads| {
            let out = format!("out-{threads}.{end}");
            let mut command = command(&folder, "many.las", &out);
            let run = run(command.env("RAYON_NUM_THREADS", threads.to_string()).output().expect("it starts"));
            assert_eq!(run.code, 0, "{run}");
            std::fs::read(folder.0.join(out)).expect("written")
        });
        assert!(written[0] == written[1] && written[1] == written[2], "{end}");
    }
    // What one thread compressed, any number reads alike.
    folder.write("errors.toml", "tilt = 0.0\n");
    applied(&folder, "many.las", "packed.laz", &[]);
    let read = [1, 2].map(|threads| {
        let mut command = command(&folder, "packed.laz", "read.las");
        let run = run(command.env("RAYON_NUM_THREADS", threads.to_string()).output().expect("it starts"));
        assert_eq!(run.code, 0, "{run}");
        std::fs::read(folder.0.join("read.las")).expect("written")
    });
    assert!(read[0] == read[1], "read by one thread and by two");
}

/// Where no more fits, the command says so, and leaves what was there. A limit of the size of files stands for a full disk: both are told
/// by a write that fails.
#[cfg(unix)]
#[test]
fn a_disk_that_is_full_is_told_and_what_was_there_stays() {
    let folder = folder("cloud_full", &[]);
    many(&folder, 20_000);
    folder.write("out.las", "what stood there").write("out.laz", "what stood there");
    let before = folder.names();
    for out in ["out.las", "out.laz", "new.las", "new.laz"] {
        let script = "trap '' XFSZ; ulimit -f 100; exec \"$@\"";
        let mut shell = Command::new("sh");
        shell.args(["-c", script, "sh", env!("CARGO_BIN_EXE_trueaxis"), "apply", "scanner.chain"]);
        shell.args(["--errors", "errors.toml", "--data", "many.las", "--out", out]).current_dir(&folder.0);
        let run = run(shell.output().expect("a shell starts"));
        assert_eq!(run.code, 2, "{out}: {run}");
        assert!(run.stderr.contains(out) && run.stderr.starts_with("error: "), "{out}: {run}");
        assert_eq!(folder.names(), before, "{out}");
    }
    assert_eq!(folder.read("out.las"), "what stood there");
    assert_eq!(folder.read("out.laz"), "what stood there");
}

/// Killed at any moment a run leaves the output as it was, or whole; the next run removes what is half-written.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_the_output_as_it_was() {
    use std::time::Duration;

    let folder = folder("cloud_killed", &[]);
    many(&folder, 300_000);
    applied(&folder, "many.las", "whole.laz", &[]);
    let whole = std::fs::read(folder.0.join("whole.laz")).expect("written");
    let mut killed = 0;
    for turn in 0..12 {
        folder.write("out.laz", "what stood there");
        let mut running = command(&folder, "many.las", "out.laz").spawn().expect("it starts");
        std::thread::sleep(Duration::from_millis(7 * turn * turn));
        running.kill().expect("it can be told");
        let ended = running.wait().expect("it ends");
        let out = std::fs::read(folder.0.join("out.laz")).expect("it is there");
        assert!(out == b"what stood there" || out == whole, "turn {turn}");
        killed += usize::from(ended.code().is_none());
    }
    assert!(killed > 0, "some runs were killed");
    applied(&folder, "many.las", "out.laz", &[]);
    assert!(std::fs::read(folder.0.join("out.laz")).expect("written") == whole);
    let left: Vec<String> = folder.names().into_iter().filter(|name| name.ends_with(".partial")).collect();
    assert!(left.is_empty(), "{left:?}");
}

/// Steps as fine and as coarse as numbers go, at a scanner that fits them: what is written is right, or nothing is.
#[test]
fn steps_that_hold_no_point_are_refused() {
    let folder = folder("cloud_steps", &["v12f1.las"]);
    let file = bytes("v12f1.las");
    for scale in [1e-12_f64, 1e-9, 1e-7, 10.0, 1e6] {
        let mut file = file.clone();
        (131..155).step_by(8).for_each(|at| file[at..at + 8].copy_from_slice(&scale.to_le_bytes()));
        folder.write("steps.las", file);
        let run = apply(&folder, "steps.las", "out.las", &[]);
        assert_eq!(run.code, 2, "{scale}: {run}");
        assert!(run.stderr.starts_with("error: steps.las: "), "{scale}: {run}");
    }
}
