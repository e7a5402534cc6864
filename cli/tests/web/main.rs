//! What the page's module answers is what the command writes: the same files, names, words and mistakes.

#[path = "../support/mod.rs"]
mod support;

use std::fs;

use support::{Folder, root, trueaxis};
use web::Message;

/// The answer to parts, given to the module as a page gives them.
fn ask(parts: &[(&str, &[u8])]) -> Message {
    let asked = parts.iter().fold(Message::default(), |asked, (name, content)| asked.with(name, *content));
    Message::from_bytes(&web::answer(&asked.to_bytes(), &|_| {})).expect("an answer is a message")
}

fn text<'m>(answer: &'m Message, name: &str) -> &'m str {
    answer
        .text(name)
        .unwrap_or_else(|why| panic!("{name}: {why}; {:?}", answer.find("why").map(String::from_utf8_lossy)))
}

fn bytes(from_root: &str) -> Vec<u8> {
    fs::read(root().join(from_root)).expect("a file of the workspace")
}

/// A report without what says when and how it was made.
fn bare(report: &str) -> String {
    let start = report.find("\"provenance\"").expect("it says how it was made");
    let length = report[start..].find("\n  }").expect("an object");
    format!("{}{}", &report[..start], &report[start + length..])
}

/// An instrument file without how it was asked for.
fn unasked(text: &str) -> Vec<&str> {
    text.lines().filter(|line| !line.starts_with("command = ")).collect()
}

/// The value of a key whose value is a text.
fn said<'t>(json: &'t str, key: &str) -> &'t str {
    let (_, behind) = json.split_once(&format!("\"{key}\": \"")).expect("the key");
    behind.split('"').next().expect("its value")
}

/// A study of the examples: its folder, its file, its declaration, its table.
const STUDIES: &[[&str; 4]] = &[
    ["examples/course", "study.toml", "mount.chain", "secret.csv"],
    ["examples/turntable", "turntable.toml", "turntable.chain", "measured.csv"],
    ["examples/objects", "targets.toml", "scanner.chain", "targets.csv"],
];

#[test]
fn a_calibration_has_the_files_of_the_command() {
    for [folder, study, chain, table] in STUDIES {
        let run = Folder::new(&format!("web-{}", folder.replace('/', "-")));
        [study, chain, table].into_iter().for_each(|file| {
            run.copy(&format!("{folder}/{file}"));
        });
        let told = run.trueaxis(&["calibrate", study, "--out", "."]);
        let report = run.read("report.json");
        let own = |file: &str| bytes(&format!("{folder}/{file}"));
        let answer = ask(&[
            ("do", b"calibrate"),
            ("study-name", study.as_bytes()),
            ("study", &own(study)),
            ("chain", &own(chain)),
            ("date", said(&report, "date").as_bytes()),
            (&format!("table:{table}"), &own(table)),
        ]);
        assert_eq!(text(&answer, "status") == "done", told.code == 0, "{study}: {told}");
        assert_eq!(bare(text(&answer, "file:report.json")), bare(&report), "{study}");
        for (name, content) in answer.beginning("file:").filter(|(name, _)| !name.starts_with("report.")) {
            assert_eq!(
                unasked(&String::from_utf8_lossy(content)),
                unasked(&run.read(name)),
                "{study}: {name}"
            );
        }
        let made = answer.beginning("file:").count();
        assert_eq!(made, run.names().len() - 3, "{study}: {:?}", run.names());
        for sha256 in ["\"sha256\"", said(&report, "sha256")] {
            assert!(text(&answer, "file:report.json").contains(sha256), "{study}");
        }
    }
}

#[test]
fn a_table_is_begun_corrected_and_written_as_code_as_by_the_command() {
    let run = Folder::new("web-begun");
    run.copy("examples/course/secret.csv");
    run.trueaxis(&["init", "secret.csv"]);
    let table = bytes("examples/course/secret.csv");
    let begun = ask(&[("do", b"begin"), ("name", b"secret.csv"), ("table", &table)]);
    assert_eq!(text(&begun, "template"), "alt-azimuth");
    assert_eq!((text(&begun, "chain-name"), text(&begun, "study-name")), ("secret.chain", "secret.toml"));
    assert_eq!(text(&begun, "chain"), run.read("secret.chain"));
    assert_eq!(text(&begun, "study"), run.read("secret.toml"));
    assert!(text(&begun, "columns").starts_with("[{\"cells\":["), "{}", text(&begun, "columns"));

    run.trueaxis(&["calibrate", "secret.toml", "--out", "result"]);
    run.trueaxis(&[
        "apply",
        "result/instrument.toml",
        "--data",
        "secret.csv",
        "--out",
        "corrected.csv",
        "--correction",
        "--uncertainty",
    ]);
    let instrument = run.read("result/instrument.toml");
    let corrected = ask(&[
        ("do", b"correct"),
        ("instrument", instrument.as_bytes()),
        ("name", b"secret.csv"),
        ("table", &table),
        ("correction", b"yes"),
        ("uncertainty", b"yes"),
    ]);
    assert_eq!(text(&corrected, "table"), run.read("corrected.csv"));

    let code = ask(&[("do", b"generate"), ("instrument", instrument.as_bytes()), ("language", b"c")]);
    let names: Vec<&str> = code.beginning("file:").map(|(name, _)| name).collect();
    let [source, _header] = names.as_slice() else { panic!("{names:?}") };
    run.trueaxis(&["generate", "result/instrument.toml", "--language", "c", "--out", source]);
    for name in names {
        assert_eq!(text(&code, &format!("file:{name}")), run.read(name), "{name}");
    }
}

#[test]
fn formulas_are_those_of_the_command() {
    let file = "examples/course/mount.chain";
    let chain = bytes(file);
    let same = |parts: &[(&str, &[u8])], arguments: &[&str]| {
        let with = [&[("chain", chain.as_slice())], parts].concat();
        let (answer, run) = (ask(&with), trueaxis(arguments));
        assert_eq!(text(&answer, "text"), run.stdout, "{arguments:?}: {run}");
    };
    same(&[("do", b"derive"), ("order", b"2")], &["derive", file, "--order", "2"]);
    same(&[("do", b"identify")], &["identify", file]);
    let sizes = bytes("examples/course/box.toml");
    same(
        &[("do", b"bound"), ("sizes", &sizes), ("ranges", b"elevation=10 deg..80 deg\n")],
        &["bound", file, "--sizes", "examples/course/box.toml", "--range", "elevation=10 deg..80 deg"],
    );
}

#[test]
fn a_mistake_is_shown_where_it_stands() {
    let run = Folder::new("web-mistake");
    let study = String::from_utf8(bytes("examples/course/study.toml")).expect("UTF-8");
    let spoiled = study.replace("azimuth [deg]", "azimut [deg]");
    run.copy("examples/course/mount.chain").copy("examples/course/secret.csv").write("study.toml", &spoiled);
    let told = run.trueaxis(&["calibrate", "study.toml"]);
    let answer = ask(&[
        ("do", b"calibrate"),
        ("study-name", b"study.toml"),
        ("study", spoiled.as_bytes()),
        ("chain", &bytes("examples/course/mount.chain")),
        ("date", b"2026-11-27"),
        ("table:secret.csv", &bytes("examples/course/secret.csv")),
    ]);
    assert_eq!(text(&answer, "status"), "refused");
    let why = text(&answer, "why");
    assert!(told.stderr.contains(why) && why.contains("azimut [deg]"), "{why}\n{told}");
}
