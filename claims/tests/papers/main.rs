//! Small papers' sources of several fields, drawn up as claims and judged. Those below `shaping` shaped the reader of sources,
//! those below `tried` were written before it was run on them.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

#[path = "../file/support.rs"]
mod support;

use std::fs;
use std::path::{Path, PathBuf};

use claims::paper::{Draft, Kind, draft};
use model_core::Chain;

fn sources(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/papers").join(folder);
    let mut found: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.sort();
    found
}

/// What a source says is expected of it: `holds 2, differs 1`.
fn expected(source: &str, word: &str) -> usize {
    let line = source.lines().find(|line| line.contains("expected:")).unwrap_or_default();
    let behind = line.split(&format!("{word} ")).nth(1).unwrap_or("0");
    behind.chars().take_while(char::is_ascii_digit).collect::<String>().parse().unwrap()
}

fn drawn_up(path: &Path) -> (String, Draft, Vec<(String, String)>) {
    let source = fs::read_to_string(path).unwrap();
    let named = Draft::chain_named(&source).expect("each source names its chain");
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = [own.join("tests/papers/chains"), own.parent().unwrap().join("examples/gallery")];
    let text = folders.iter().find_map(|folder| fs::read_to_string(folder.join(&named)).ok()).unwrap();
    let chain = Chain::symbolic_from_text(&text).unwrap();
    let kind = if path.extension().is_some_and(|ending| ending == "md") { Kind::Markdown } else { Kind::Tex };
    let drawn = draft(&source, kind, &chain, "paper", &named);
    let verdicts = if drawn.claims == 0 { Vec::new() } else { support::verdicts(&text, &drawn.text) };
    (source, drawn, verdicts)
}

fn compared(folder: &str) {
    let mut wrong = Vec::new();
    let paths = sources(folder);
    assert!(paths.len() >= 10);
    for path in paths {
        let (source, drawn, verdicts) = drawn_up(&path);
        for word in ["holds", "differs"] {
            let found = verdicts.iter().filter(|(_, said)| said == word).count();
            if found != expected(&source, word) {
                wrong.push(format!(
                    "{}: {found} {word}\n{}\n{verdicts:?}\n{:?}",
                    path.display(),
                    drawn.text,
                    drawn.unread
                ));
            }
        }
        // The file that is drawn up reads.
        let others: Vec<_> =
            verdicts.iter().filter(|(_, said)| said != "holds" && said != "differs").collect();
        if !others.is_empty() {
            wrong.push(format!("{}: {others:?}\n{}", path.display(), drawn.text));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn the_papers_that_shaped_the_reader_are_read() {
    compared("shaping");
}

#[test]
fn other_papers_are_read_as_well() {
    compared("tried");
}

/// The kind, the claims that should hold and differ, and the text of each short form, with its chain.
#[test]
fn short_forms_are_judged_or_listed() {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/papers");
    let forms = fs::read_to_string(own.join("forms.txt")).unwrap();
    let mut wrong = Vec::new();
    let blocks: Vec<&str> = forms.split("\n=== ").skip(1).collect();
    assert!(blocks.len() >= 80, "{}", blocks.len());
    for block in blocks {
        let (head, source) = block.split_once('\n').unwrap();
        let [name, kind, holds, differs] = head.split(' ').collect::<Vec<_>>().try_into().unwrap();
        let text = fs::read_to_string(own.join(format!("chains/form-{name}.chain"))).unwrap();
        let chain = Chain::symbolic_from_text(&text).unwrap();
        let kind = if kind == "md" { Kind::Markdown } else { Kind::Tex };
        let drawn = draft(source, kind, &chain, "paper", "a.chain");
        let verdicts = if drawn.claims == 0 { Vec::new() } else { support::verdicts(&text, &drawn.text) };
        let count = |word: &str| verdicts.iter().filter(|(_, said)| said == word).count().to_string();
        let judged = [count("holds"), count("differs")];
        if judged != [holds, differs] || verdicts.iter().any(|(_, said)| said != "holds" && said != "differs")
        {
            wrong.push(format!("{block}\n{verdicts:?}\n{:?}", drawn.unread));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
