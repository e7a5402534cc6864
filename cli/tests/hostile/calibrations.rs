//! A whole calibration whose declaration, study and data are full of hostile strings: terminal, page, JSON and files.

use std::process::Command;

use super::seen::{is_seen, run};
use super::{cell, joined, toml};
use crate::support::Folder;

/// Says of a page which elements and attributes it has beside those of its own, and whether its scripts are the two that it has.
const READ: &str = r#"
import html.parser, json, sys
class Page(html.parser.HTMLParser):
    scripts, found, own = [], [], False
    def handle_starttag(self, tag, attributes):
        if 'injected' in tag or any('injected' in name or name in ('onload', 'onerror') for name, _ in attributes):
            self.found.append(self.get_starttag_text())
        if any(value and value.startswith('javascript:') for name, value in attributes if name in ('href', 'src')):
            self.found.append(self.get_starttag_text())
        self.own = tag == 'script'
        if self.own: self.scripts.append('')
    def handle_data(self, data):
        if self.own: self.scripts[-1] += data
    def handle_endtag(self, tag): self.own = False
page = Page()
page.feed(open(sys.argv[1], encoding='utf-8').read())
assert not page.found, page.found
if len(sys.argv) > 2:
    assert len(page.scripts) == 2, len(page.scripts)
    json.loads(page.scripts[0])
    open(sys.argv[2], 'w', encoding='utf-8').write(page.scripts[1])
"#;

/// A folder with a study that can be fitted.
fn folder(name: &str, text: &str) -> Folder {
    let folder = Folder::new(name);
    let words: String = text.split(['\n', '\r']).map(|line| format!("/// {line}\n")).collect();
    folder
        .write(
            "s.chain",
            format!(
                "{words}chain Shaft {{\n{words}body shaft on ground {{ motion: Rz(reading); motion_error:\n{words} Rz(index); }}\n\
                 {words}observe mark: direction(0, 1, 0) of shaft;\n{words}observe other: direction(1, 0, 0) of shaft;\n\
                 symbol index = \"\\\\iota\"; }}\n"
            ),
        )
        .write("e.toml", "index = \"3 arcsec\"\n");
    let simulate =
        "simulate s.chain --observable mark --errors e.toml --poses 30 --noise 1arcsec --seed 1 --out m.csv";
    assert_eq!(run(&folder, &simulate.split(' ').collect::<Vec<_>>()).code, 0);
    folder
}

#[test]
fn a_calibration() {
    for text in &joined(600) {
        let folder = folder("hostile-calibration", text);
        // Columns with names of the rows and of their groups, and one that nobody asked for. A header has no line breaks, a label no
        // control characters.
        let table = folder.read("m.csv");
        let header = text.replace(['\n', '\r'], " ");
        let label = text.replace(|letter: char| letter.is_control(), "");
        let rows = table.lines().enumerate().map(|(row, line)| match row {
            0 => {
                format!("{line},{},{},free\n", cell(&format!("id {header}")), cell(&format!("set {header}")))
            }
            row => format!(
                "{line},{},{},{}\n",
                cell(&format!("{label} {row}")),
                cell(&format!("{label} {}", row % 3)),
                cell(text)
            ),
        });
        let name = format!("{}.csv", text.replace('/', "_").chars().take(40).collect::<String>());
        folder.write(&name, rows.collect::<String>());
        let comment: String = text.replace(|letter: char| letter.is_control(), "");
        folder.write(
            "s.toml",
            format!(
                "# {comment}\nchain = \"s.chain\"\nobservable = \"mark\"\ndata = {}\nid = {}\ndata_from = {}\n[observed]\n\
                 kind = \"direction\"\n[hold_out]\nfolds = 3\ntogether = {}\n",
                toml(&name),
                toml(&format!("id {header}")),
                toml(text),
                toml(&format!("set {header}"))
            ),
        );
        let said = run(&folder, &["calibrate", "s.toml", "--out", "out", "--verbose"]);
        assert!(said.code < 2, "{text:?}: {}", said.stderr);
        for file in ["report.html", "report.json", "errors.toml"] {
            is_seen(&folder.read(&format!("out/{file}")), file);
        }
        assert!(
            serde_json::from_str::<serde_json::Value>(&folder.read("out/report.json")).is_ok(),
            "{text:?}"
        );
        if let Some(python) = testkit::tool(testkit::PYTHON) {
            let read = Command::new(python)
                .args(["-c", READ, "out/report.html", "page.js"])
                .current_dir(&folder.0)
                .output();
            let read = read.expect("it starts");
            assert!(read.status.success(), "{text:?}: {}", String::from_utf8_lossy(&read.stderr));
            if let Some(node) = testkit::tool(testkit::NODE) {
                let checked = Command::new(node).args(["--check", "page.js"]).current_dir(&folder.0).status();
                assert!(checked.is_ok_and(|status| status.success()));
            }
        }
    }
}

/// Runs a command with a terminal of its own, and hands on what that gets.
#[cfg(unix)]
const TERMINAL: &str = r"
import os, pty, sys
status = pty.spawn(sys.argv[1:])
sys.exit(os.waitstatus_to_exitcode(status))
";

#[cfg(unix)]
#[test]
fn a_table_that_a_terminal_gets_commands_nothing_and_a_file_keeps_it() {
    let Some(python) = testkit::tool(testkit::PYTHON) else { return };
    let folder = folder("hostile-pty", "");
    let hostile = "\u{1b}]0;injected\u{7}\u{9b}31m\u{202e}é\r";
    folder.write("d.csv", format!("reading [deg],{0}\n1,{0}\n", cell(hostile)));
    let evaluate = ["eval", "s.chain", "--errors", "e.toml", "--data", "d.csv", "--out"];
    assert_eq!(run(&folder, &[&evaluate[..], &["x.csv"]].concat()).code, 0);
    assert!(folder.read("x.csv").contains(hostile), "cells that are passed on stay as they are");
    let shown = Command::new(python)
        .args(["-c", TERMINAL, env!("CARGO_BIN_EXE_trueaxis")])
        .args(evaluate)
        .args(["-", "--quiet"])
        .current_dir(&folder.0)
        .output()
        .expect("it starts");
    let shown = String::from_utf8(shown.stdout).expect("UTF-8").replace("\r\n", "\n");
    assert!(shown.contains(r"\u{1b}]0;injected\u{7}\u{9b}31m\u{202e}é\r"), "{shown:?}");
    is_seen(&shown, "a terminal");
}
