//! What no program writes, in every form: refused with words and a place, and nothing is written.

use crate::folder;

/// The samples by name, and what spoils each.
const FILES: [&str; 13] = [
    "radio-1.dat",
    "north.model",
    "asa-1.pox",
    "solves-1.csv",
    "solves-2.csv",
    "stations.gsi",
    "control.gsi",
    "points-2.csv",
    "puma.dh.csv",
    "bar-xy.csv",
    "bar-zx.csv",
    "r-test-ac.csv",
    "grid-2.csv",
];

/// Cut off, doubled, with letters and numbers that no reader expects: the command ends with an answer.
#[test]
fn spoiled_files_end_with_an_answer() {
    let folder = folder("spoiled", &FILES);
    for file in FILES {
        let bytes = std::fs::read(folder.0.join(file)).expect("a sample");
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let wide: Vec<u8> =
            [0xFF, 0xFE].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
        let half = bytes[..bytes.len() / 2 + 3].to_vec();
        let lines: Vec<&str> = text.lines().collect();
        let spoiled: Vec<(&str, Vec<u8>)> = vec![
            ("half", half),
            ("wide", wide),
            ("empty", Vec::new()),
            ("binary", (0..=255).cycle().take(4096).collect()),
            ("returns", text.replace("\r\n", "\n").replace('\n', "\r\n").into_bytes()),
            ("marked", [b"\xEF\xBB\xBF".as_slice(), text.trim_start_matches('\u{feff}').as_bytes()].concat()),
            ("large", text.replacen('1', "1e308", 6).into_bytes()),
            ("first", lines[..1].join("\n").into_bytes()),
        ];
        for (how, bytes) in spoiled {
            let extension = file.rsplit_once('.').expect("an ending").1;
            let name = format!("{how}.{extension}");
            folder.write(&name, bytes);
            let out = format!("{how}-{}.toml", file.replace('.', "-"));
            let run =
                folder.trueaxis(&["init", &name, "--latitude", "48", "--longitude", "11", "--out", &out]);
            assert!(run.code == 0 || run.code == 2, "{file}, {how}: {run}");
            assert_eq!(
                run.code == 0,
                folder.0.join(&out).with_extension("chain").exists(),
                "{file}, {how}: {run}"
            );
            if run.code == 2 {
                assert!(run.stderr.len() > 20 && !run.stderr.contains("panicked"), "{file}, {how}: {run}");
            }
            if matches!(how, "returns" | "marked") {
                assert_eq!(run.code, 0, "{file}, {how}: {run}");
            }
        }
    }
}

#[test]
fn what_a_file_lacks_is_said_in_a_sentence() {
    for (file, arguments, said) in [
        ("asa-1.pox", &[][..], "say where the mount stands"),
        ("ur10e.conf", &[], "say --arm, one of UR3, UR5"),
        ("ur10e.conf", &["--arm", "UR10f"], "did you mean `UR10`?"),
    ] {
        let folder = folder(&format!("lacks-{file}"), &[file]);
        let run = folder.trueaxis(&[&["init", file], arguments].concat());
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains(said), "{run}");
        assert_eq!(folder.names(), [file]);
    }
}

/// Plate solves that lack something are a table without an instrument, and what to add is said.
#[test]
fn plate_solves_without_a_time_say_what_to_add() {
    let folder = folder("no-time", &["solves-1.csv"]);
    let text = folder.read("solves-1.csv").replace(",LST,", ",other,");
    folder.write("d.csv", text);
    let run = folder.trueaxis(&["init", "d.csv"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("no column has the sidereal time (call it `lst`)"), "{run}");
    folder.write("numbers.csv", "1 0 0 0.5 0 1 0 0.2 0 0 1 0.1 0 0 0 1\n".repeat(3));
    let run = folder.trueaxis(&["init", "numbers.csv"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("16 numbers a row are poses as matrices"), "{run}");
}

#[test]
fn a_file_that_looks_like_two_forms_names_both() {
    let folder = folder("two", &["asa-1.pox"]);
    folder.write("two.dat", "2\n\"Number 1\"\n:EQUAT\n35 52 8.4 2001 5 30\n");
    let run = folder.trueaxis(&["init", "two.dat"]);
    assert_eq!(run.code, 2, "{run}");
    assert!(
        run.stderr.contains("looks like observations of TPOINT and like points of AutoSlew (.pox)"),
        "{run}"
    );
}

/// A description alone has no poses: the declaration is written, and what to add is said.
#[test]
fn a_robot_alone_becomes_a_declaration() {
    let folder = folder("robot-alone", &["puma.dh.csv", "ur5e.conf"]);
    for (file, with) in [("puma.dh.csv", &[][..]), ("ur5e.conf", &["--arm", "UR5e"])] {
        let run = folder.trueaxis(&[&["init", file], with].concat());
        assert_eq!(run.code, 0, "{run}");
        assert!(run.stderr.contains("a description has no measured poses"), "{run}");
        let chain = folder.0.join(file).with_extension("chain");
        let run = folder.trueaxis(&["identify", &chain.to_string_lossy()]);
        assert!(run.code < 2, "{run}");
    }
}
