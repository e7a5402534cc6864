//! What a page shows of a file is that file's text: `<!-- same as: PATH -->` before a block, or `PATH:FROM:TO` for some of its lines.
//! Pages are plain Markdown, so they read the same in the book and where somebody looks at the file itself. Formulas, too: a formula
//! has no backslash before a sign, which Markdown would take away.
//!
//! `UPDATE_BOOK=1` writes the files' texts into the pages.

use std::fs;

use super::pages;
use super::support::root;

const NOTE: &str = "<!-- same as: ";

/// The lines that a note names: `PATH`, `PATH:FROM:` or `PATH:FROM:TO`, both lines among them.
fn named(note: &str) -> Vec<String> {
    let mut parts = note.split(':');
    let path = root().join(parts.next().expect("a path"));
    let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let number = |part: Option<&str>| part.and_then(|part| part.parse::<usize>().ok());
    let from = number(parts.next()).unwrap_or(1);
    let to = number(parts.next()).unwrap_or(usize::MAX);
    text.lines().take(to).skip(from - 1).map(str::to_owned).collect()
}

/// A page with the text of the files in the blocks that quote them.
fn quoted(page: &str) -> String {
    let mut written = String::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        written.push_str(&format!("{line}\n"));
        let note = line.trim().strip_prefix(NOTE).and_then(|rest| rest.strip_suffix(" -->"));
        let Some(note) = note else { continue };
        let fence = lines.next().filter(|line| line.starts_with("```"));
        let fence = fence.unwrap_or_else(|| panic!("no block follows the note {note}"));
        lines.by_ref().find(|line| *line == "```").expect("the end of the block");
        written.push_str(&format!("{fence}\n{}\n```\n", named(note).join("\n")));
    }
    written
}

#[test]
fn blocks_are_the_files_that_they_quote() {
    let mut stale = Vec::new();
    for path in pages() {
        let page = fs::read_to_string(&path).expect("a page");
        let now = quoted(&page);
        if now.trim_end() != page.trim_end() {
            stale.push(path.display().to_string());
            if std::env::var_os("UPDATE_BOOK").is_some() {
                fs::write(&path, now).expect("the page is ours to write");
            }
        }
    }
    assert!(
        stale.is_empty() || std::env::var_os("UPDATE_BOOK").is_some(),
        "write them anew with UPDATE_BOOK=1: {stale:?}"
    );
}

/// A line of a displayed formula that Markdown takes for an item of a list, a quotation or a heading.
fn is_a_list(line: &str) -> bool {
    ["+ ", "- ", "* ", "> ", "#"].iter().any(|sign| line.trim_start().starts_with(sign))
}

/// A line of a page that only this book's programs would show as it is meant.
fn is_bound_to_the_book(line: &str) -> bool {
    let formulas = line.split('$').skip(1).step_by(2).collect::<String>();
    let is_spoiled = formulas
        .match_indices('\\')
        .any(|(at, _)| formulas[at + 1..].chars().next().is_some_and(|next| next.is_ascii_punctuation()));
    line.contains("{{#") || line.contains(r"\\(") || is_spoiled
}

#[test]
fn pages_are_plain_markdown() {
    let mut bound = Vec::new();
    for path in pages() {
        let page = fs::read_to_string(&path).expect("a page");
        let (mut is_code, mut is_formula) = (false, false);
        for (at, line) in page.lines().enumerate() {
            is_code ^= line.trim_start().starts_with("```");
            let was_formula = is_formula;
            is_formula ^= line.matches("$$").count() % 2 == 1;
            if is_code {
                continue;
            }
            // The dollar signs of a displayed formula may be on lines above and below.
            let shown = if was_formula || is_formula {
                format!("${}$", line.replace('$', ""))
            } else {
                line.replace("$$", "$")
            };
            if is_bound_to_the_book(&without_code(&shown)) || was_formula && is_a_list(line) {
                bound.push(format!("{}:{}: {line}", path.display(), at + 1));
            }
        }
    }
    assert!(bound.is_empty(), "{}", bound.join("\n"));
}

/// A line without what stands between its backquotes.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

#[test]
fn formulas_and_includes_that_only_the_book_shows_are_found() {
    assert!(is_bound_to_the_book("{{#include a.toml}}"));
    assert!(is_bound_to_the_book(r"a $x \, y$"));
    assert!(!is_bound_to_the_book(r"a $x \quad y$ \, b"));
    assert!(is_a_list(" + x") && !is_a_list(" {}+ x"));
    assert_eq!(without_code(r"a `$\,$` b"), "a  b");
    assert_eq!(quoted("a\n```text\nb\n```\n"), "a\n```text\nb\n```\n");
    assert_eq!(named("rustfmt.toml:1:1").len(), 1);
}
