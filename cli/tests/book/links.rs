//! No link of the book leads nowhere: the files that pages name are there, and so are the headings; every page is in the table
//! of contents.

use std::fs;
use std::path::{Path, PathBuf};

use super::pages;
use super::support::root;

/// What a page links to or shows: `](target)` outside of code.
fn links(page: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut is_code = false;
    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        }
        if is_code {
            continue;
        }
        for (at, _) in line.match_indices("](") {
            // In a span of code it is text.
            if line[..at].matches('`').count() % 2 == 1 {
                continue;
            }
            let rest = &line[at + 2..];
            if let Some(end) = rest.find(')') {
                found.push(rest[..end].to_owned());
            }
        }
        for (at, key) in line.match_indices("src=\"") {
            let rest = &line[at + key.len()..];
            found.extend(rest.find('"').map(|end| rest[..end].to_owned()));
        }
    }
    found
}

/// The anchors of a page's headings, as mdBook makes them.
fn anchors(page: &str) -> Vec<String> {
    let mut anchors: Vec<String> = Vec::new();
    let mut is_code = false;
    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        }
        let title = line.trim_start_matches('#');
        if is_code || title.len() == line.len() || !title.starts_with(' ') {
            continue;
        }
        // Of a link only its text counts.
        let mut text = title.trim().to_owned();
        while let (Some(from), true) = (text.find("]("), text.contains('[')) {
            let to = text[from..].find(')').map_or(text.len(), |end| from + end + 1);
            text.replace_range(from..to, "");
            text = text.replacen('[', "", 1);
        }
        let anchor: String = text
            .chars()
            .filter_map(|c| match c {
                c if c.is_alphanumeric() || c == '_' || c == '-' => Some(c.to_lowercase().to_string()),
                c if c.is_whitespace() => Some("-".to_owned()),
                _ => None,
            })
            .collect();
        let before = anchors.iter().filter(|known| **known == anchor).count();
        anchors.push(if before == 0 { anchor } else { format!("{anchor}-{before}") });
    }
    anchors
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).expect("a page")
}

#[test]
fn every_link_leads_somewhere() {
    let mut dead = Vec::new();
    for page in pages() {
        let folder = page.parent().expect("a page lies in a folder");
        for link in links(&read(&page)) {
            if link.contains("://") || link.starts_with("mailto:") {
                continue;
            }
            let (file, anchor) = link.split_once('#').map_or((link.as_str(), None), |(f, a)| (f, Some(a)));
            let target = if file.is_empty() { page.clone() } else { folder.join(file) };
            // What is outside of the book is not where the book is read.
            let leaves = page.starts_with(root().join("docs/src"))
                && file.matches("../").count()
                    >= page.strip_prefix(root()).expect("ours").components().count() - 2;
            let is_there = !leaves
                && target.exists()
                && anchor.is_none_or(|anchor| {
                    target.extension().is_none_or(|extension| extension != "md")
                        || anchors(&read(&target)).iter().any(|known| known == anchor)
                });
            if !is_there {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(dead.is_empty(), "{}", dead.join("\n"));
}

/// mdBook writes a README as `index.html`, and links to it as `README.html`.
#[test]
fn links_to_a_readme_are_led_on() {
    let (settings, book) = (read(&root().join("docs/book.toml")), root().join("docs/src"));
    let lost: Vec<String> = pages()
        .iter()
        .filter(|page| page.starts_with(&book) && page.ends_with("README.md"))
        .map(|page| {
            page.strip_prefix(&book).expect("a page of the book").with_extension("html").display().to_string()
        })
        .filter(|page| !settings.contains(&format!("\"/{page}\" = \"index.html\"")))
        .collect();
    assert!(lost.is_empty(), "docs/book.toml leads nowhere from {lost:?}");
}

#[test]
fn every_page_is_in_the_table_of_contents() {
    let book = root().join("docs/src");
    let listed: Vec<PathBuf> =
        links(&read(&book.join("SUMMARY.md"))).iter().map(|link| book.join(link)).collect();
    let missing: Vec<PathBuf> = pages()
        .into_iter()
        .filter(|page| page.starts_with(&book) && !page.ends_with("SUMMARY.md") && !listed.contains(page))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn anchors_are_those_of_the_headings() {
    assert_eq!(
        anchors("# A `b_c` d\n```sh\n# no heading\n```\n## What's [that](x.md)?\n## What's that?\n"),
        ["a-b_c-d", "whats-that", "whats-that-1"]
    );
    assert_eq!(
        links("a [b](c.md#d) `[e](f)`\n```\n[g](h)\n```\n<iframe src=\"i.html\">"),
        ["c.md#d", "i.html"]
    );
}
