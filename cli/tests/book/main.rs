//! Every command that the book and the README show is run, and prints what they show.
//!
//! `UPDATE_BOOK=1 cargo test -p trueaxis-cli --test book` writes what is printed now into the pages; read the difference
//! before you commit it.

#[path = "../support/mod.rs"]
mod support;

mod decks;
mod explorables;
#[path = "../support/grade.rs"]
mod grade;
mod interactive;
mod lessons;
mod links;
mod page;
mod pictures;
#[path = "../../../tests/architecture/plain.rs"]
mod plain;
mod quoted;
mod reference;
mod signatures;
mod words;

use std::fs;
use std::path::{Path, PathBuf};

use page::{Step, matches, steps};
use support::{Folder, root};

fn pages() -> Vec<PathBuf> {
    let mut pages = vec![root().join("README.md")];
    let mut folders = vec![root().join("docs/src")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("the book is there") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}

/// Rooms of the book that are no reference.
const OTHER: [&str; 5] = ["course", "teaching", "interactive", "SUMMARY", "literature"];

/// The reference pages of which this is true, as `algebra/speed`.
fn reference_pages(is: impl Fn(&str) -> bool) -> Vec<String> {
    let book = root().join("docs/src");
    let found = pages().into_iter().filter_map(|path| {
        let name = path.strip_prefix(&book).ok()?.with_extension("").display().to_string();
        let is_other = OTHER.iter().any(|room| name.starts_with(room));
        (!is_other && is(&fs::read_to_string(path).expect("a page"))).then_some(name)
    });
    found.collect()
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder of examples") {
        let entry = entry.expect("readable");
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target)
        } else {
            drop(fs::copy(entry.path(), target))
        }
    }
}

/// Runs a page in a folder of its own; what went wrong, and the page with what was printed.
fn run(path: &Path) -> (Vec<String>, String) {
    let text = fs::read_to_string(path).expect("a page");
    let steps = steps(&text);
    let name = path.strip_prefix(root()).expect("a page of ours").display().to_string();
    let mut wrong = Vec::new();
    if !steps.iter().any(|step| matches!(step, Step::Run { .. })) {
        return (wrong, text);
    }
    let folder = Folder::new(&format!("book-{}", name.replace(['/', '.'], "-")));
    copy(&root().join("examples"), &folder.0.join("examples"));
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut moved = 0_isize;
    for step in steps {
        match step {
            Step::Write { name, text } => {
                let file = folder.0.join(name);
                fs::create_dir_all(file.parent().expect("inside the folder")).expect("a folder");
                fs::write(file, text).expect("a file of the page");
            }
            Step::Run { line, arguments, code, shown } => {
                let run = folder.trueaxis(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
                if run.code != code {
                    wrong.push(format!(
                        "{name}:{line}: {arguments:?} ended with {}:\n{}",
                        run.code, run.stderr
                    ));
                }
                let Some(shown) = shown else { continue };
                if !matches(&shown.text, &run.stdout) {
                    wrong.push(format!(
                        "{name}:{}: shows\n{}\nbut {arguments:?} prints\n{}",
                        shown.lines.start + 1,
                        shown.text,
                        run.stdout
                    ));
                    let printed: Vec<String> = run.stdout.trim_end().lines().map(str::to_owned).collect();
                    let start = shown.lines.start.checked_add_signed(moved).expect("inside the page");
                    moved += printed.len() as isize - shown.lines.len() as isize;
                    lines.splice(start..start + shown.lines.len(), printed);
                }
            }
        }
    }
    (wrong, lines.iter().map(|line| format!("{line}\n")).collect())
}

#[test]
fn every_command_shown_prints_what_is_shown() {
    let pages = pages();
    let results: Vec<(Vec<String>, String)> = std::thread::scope(|scope| {
        let runs: Vec<_> = pages.iter().map(|page| scope.spawn(move || run(page))).collect();
        runs.into_iter().map(|run| run.join().expect("a page runs")).collect()
    });
    if std::env::var_os("UPDATE_BOOK").is_some() {
        for (path, (wrong, page)) in pages.iter().zip(&results) {
            if !wrong.is_empty() {
                fs::write(path, page).expect("the page is ours to write");
            }
        }
    }
    let wrong: Vec<String> = results.into_iter().flat_map(|(wrong, _)| wrong).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
