//! The reference reads as the course does: sentences are short, and words are those of the field.

use super::grade::grade;
use super::plain::{LONGEST, NOT, is_in};
use super::reference_pages;
use super::words::{GRADE, prose, sentences};

/// Pages with words that a reader has to decode. The list only shrinks: a page that has none any more leaves it.
const NOT_YET_PLAIN: [&str; 2] = ["certificates/README", "diagnosis/catalogue"];

/// What a page says in sentences of its own: the lists of the catalogue are the program's.
fn said(page: &str) -> String {
    let is_list =
        |line: &str| ["Names elsewhere", "Causes"].iter().any(|of| line.starts_with(&format!("- **{of}.**")));
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
    let long = reference_pages(|page| {
        let sentences = sentences(&said(page));
        let longest = sentences.iter().max_by_key(|sentence| sentence.len());
        let is_long = longest.is_some_and(|longest| longest.len() > LONGEST);
        if is_long {
            println!("{}", longest.expect("one at least").join(" "));
        }
        is_long || grade(&sentences) > GRADE
    });
    assert!(long.is_empty(), "more than {LONGEST} words a sentence, or grade {GRADE}: {long:?}");
}

#[test]
fn words_of_the_reference_are_those_of_the_field() {
    let broken = reference_pages(|page| {
        let decoded = decoded(page);
        if !decoded.is_empty() {
            println!("{decoded:?}: {}", page.lines().next().unwrap_or_default());
        }
        !decoded.is_empty()
    });
    assert_eq!(broken, NOT_YET_PLAIN, "the list of pages that wait for plain words only shrinks");
}
