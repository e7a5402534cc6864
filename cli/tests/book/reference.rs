//! The reference reads as the course does: sentences are short, and words are those of the field.

use std::cell::RefCell;

use super::grade::grade;
use super::plain::{LONGEST, NOT, is_in};
use super::reference_pages;
use super::words::{GRADE, prose, sentences};

/// What a page says in sentences of its own: the lists of the catalogue are the program's.
fn said(page: &str) -> String {
    let is_list = |line: &str| {
        ["Names in other fields", "Causes"].iter().any(|of| line.starts_with(&format!("- **{of}.**")))
    };
    let lines = page.lines().filter(|line| !is_list(line));
    prose(&lines.map(|line| format!("{line}\n")).collect::<String>())
}

/// The words of a page that a reader has to decode.
fn decoded(page: &str) -> Vec<&'static str> {
    let lower = said(page).to_lowercase();
    NOT.iter().copied().filter(|words| is_in(&lower, words)).collect()
}

#[test]
fn sentences_of_the_reference_are_short() {
    let said_at_length = RefCell::new(Vec::new());
    let long = reference_pages(|page| {
        let sentences = sentences(&said(page));
        let longest = sentences.iter().max_by_key(|sentence| sentence.len());
        let longest = longest.filter(|longest| longest.len() > LONGEST);
        said_at_length.borrow_mut().extend(longest.map(|longest| longest.join(" ")));
        longest.is_some() || grade(&sentences) > GRADE
    });
    assert!(
        long.is_empty(),
        "more than {LONGEST} words a sentence, or grade {GRADE}: {long:?} {said_at_length:#?}"
    );
}

#[test]
fn words_of_the_reference_are_those_of_the_field() {
    let found: RefCell<Vec<&str>> = RefCell::default();
    let broken = reference_pages(|page| {
        let decoded = decoded(page);
        found.borrow_mut().extend(&decoded);
        !decoded.is_empty()
    });
    assert!(broken.is_empty(), "words that a reader has to decode in {broken:?}: {found:?}");
}
