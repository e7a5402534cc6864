//! Spoiled files: whatever stands in a file, the command answers or refuses, in good time, and never panics.
//!
//! Each case takes files that are right, spoils one of them in a few places, and runs a command over them.

#[path = "../../../fuzz/src/intruders.rs"]
mod intruders;
#[path = "../support/mod.rs"]
mod support;

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use intruders::INTRUDERS;
use proptest::prelude::*;
use proptest::sample::{Index, select};
use support::Folder;

const MOUNT: &str = "/// A mount.
chain Mount {
    const height: length = 0.12;
    input temperature;
    body fork on ground {
        position: Tz(height);
        position_error: Rx(tilt_x), Ry(tilt_y);
        motion: Rz(-azimuth);
        motion_error: Rz(index + drift*temperature);
    }
    body tube on fork {
        motion: Rx(elevation);
        motion_error: Rx(sag*cos(elevation)), Tx(dx);
    }
    observe pointing: direction(0, 1, 0) of tube;
    observe tip: point(0, 2, 0) of tube;
}
";
const ERRORS: &str = "tilt_x = \"10 arcsec\"\ndx = \"0.1 mm\"\n\"*\" = 1e-5\n";
const POSES: &str = "azimuth [deg],elevation [deg],temperature,cross,along\n10,20,3,1,2\n30,40,4,2,1\n\
    50,-60,5,3,0\n120,10,6,0,3\n200,30,1,1,1\n300,80,2,-1,2\n";
const STUDY: &str = "chain = \"mount.chain\"
observable = \"pointing\"
data = \"poses.csv\"

[columns]
azimuth = { column = \"azimuth\", unit = \"deg\" }

[observed]
kind = \"offset\"
cross = { column = \"cross\", unit = \"arcsec\" }
along = { column = \"along\", unit = \"arcsec\" }

[fit]
estimate = [\"tilt_*\"]

[search]
inputs = [\"temperature\"]

[hold_out]
folds = 3
";
const CLAIMS: &str = r"chain = 'mount.chain'

[symbols]
'\theta_x' = 'tilt_x'
'\theta_y' = 'tilt_y'
'E' = 'elevation'

[[claim]]
name = 'pointing'
observable = 'pointing'
order = 1
keep = ['tilt_*']
components = ['-\theta_y \sin E', 'tilt_x*sin(elevation)', '\theta_x \cos{E}']

[[claim]]
name = 'count'
count = { errors = '*', equals = 6 }
";

/// The file of each name, as it is when it is right.
const FILES: [(&str, &str); 5] = [
    ("mount.chain", MOUNT),
    ("e.toml", ERRORS),
    ("poses.csv", POSES),
    ("study.toml", STUDY),
    ("claims.toml", CLAIMS),
];

/// The commands, each with the files that it reads.
const COMMANDS: [(&str, &[usize]); 8] = [
    ("derive mount.chain --order 2", &[0]),
    ("identify mount.chain", &[0]),
    ("bound mount.chain --sizes e.toml", &[0, 1]),
    ("budget mount.chain --sizes e.toml --range azimuth=0..1", &[0, 1]),
    ("generate mount.chain --language c --out out.c", &[0]),
    ("eval mount.chain --errors e.toml --data poses.csv --out out.csv", &[0, 1, 2]),
    ("calibrate study.toml --out out", &[0, 2, 3]),
    ("check claims.toml", &[0, 4]),
];

/// One change of a text.
#[derive(Debug, Clone)]
enum Change {
    Insert(Index, &'static str),
    Delete(Index, usize),
    RepeatLine(Index),
    Cut(Index),
}

fn change() -> impl Strategy<Value = Change> {
    prop_oneof![
        6 => (any::<Index>(), select(INTRUDERS)).prop_map(|(at, text)| Change::Insert(at, text)),
        4 => (any::<Index>(), 1..8_usize).prop_map(|(at, count)| Change::Delete(at, count)),
        2 => any::<Index>().prop_map(Change::RepeatLine),
        1 => any::<Index>().prop_map(Change::Cut),
    ]
}

fn spoil(text: &str, change: &Change) -> String {
    let letters: Vec<char> = text.chars().collect();
    let at = |index: &Index| index.index(letters.len() + 1);
    match change {
        Change::Insert(index, what) => {
            let (head, tail) = letters.split_at(at(index));
            head.iter().copied().chain(what.chars()).chain(tail.iter().copied()).collect()
        }
        Change::Delete(index, count) => {
            let from = at(index);
            letters[..from].iter().chain(letters.iter().skip(from + count)).collect()
        }
        Change::RepeatLine(index) => {
            let mut lines: Vec<&str> = text.split('\n').collect();
            let line = index.index(lines.len());
            lines.insert(line, lines[line]);
            lines.join("\n")
        }
        Change::Cut(index) => letters[..at(index)].iter().collect(),
    }
}

/// Far above what any of these commands needs, on a machine that does much else.
const PATIENCE: Duration = Duration::from_secs(60);

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn are_answered_or_refused(
        (command, file) in select(&COMMANDS[..]).prop_flat_map(|command| (Just(command.0), select(command.1))),
        changes in prop::collection::vec(change(), 1..4),
    ) {
        let folder = Folder::new("spoiled");
        for (name, text) in FILES {
            folder.write(name, text);
        }
        let (name, text) = FILES[file];
        let spoiled = changes.iter().fold(text.to_owned(), |text, change| spoil(&text, change));
        folder.write(name, &spoiled);
        let mut child = Command::new(env!("CARGO_BIN_EXE_trueaxis"))
            .args(command.split(' '))
            .current_dir(&folder.0)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(std::fs::File::create(folder.0.join("stderr")).expect("a file for the messages"))
            .spawn()
            .expect("the command starts");
        let start = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().expect("the command can be asked") {
                break status;
            }
            if start.elapsed() > PATIENCE {
                child.kill().expect("the command can be stopped");
                prop_assert!(false, "{command} does not end with this {name}:\n{spoiled}");
            }
            std::thread::sleep(Duration::from_millis(1));
        };
        let said = folder.read("stderr");
        prop_assert!(
            matches!(status.code(), Some(0..=2)) && !said.contains("panicked"),
            "{command}: {status}\n{said}\nwith this {name}:\n{spoiled}"
        );
        prop_assert!(status.code() != Some(2) || !said.trim().is_empty(), "{command} refuses without a word");
    }
}

/// The files are right as long as nobody spoils them: otherwise the property above would test little.
#[test]
fn files_are_right_before() {
    let folder = Folder::new("spoiled-before");
    for (name, text) in FILES {
        folder.write(name, text);
    }
    for (command, _) in COMMANDS {
        let arguments: Vec<&str> = command.split(' ').collect();
        let run = folder.trueaxis(&arguments);
        assert!(run.code < 2, "{command}: {run}");
    }
}
