//! The first screens of a dozen studies, read as a person reads them: grade, length of sentences.

use super::grade::grade;
use super::{seen, with};

/// Studies of every kind of observation, with effects and without.
const STUDIES: &[&str] = &[
    "course/study",
    "encoder/encoder-a",
    "encoder/encoder-b",
    "eye-in-hand/marks",
    "mobile-lidar/study",
    "mobile-scanner/walls",
    "objects/bars",
    "objects/rings",
    "objects/sights",
    "objects/targets",
    "objects/wires",
    "turntable/turntable",
];

/// The median grade that a first screen may have: years of school, by Flesch and Kincaid.
const GRADE: f64 = 9.0;

#[test]
fn first_screens_are_read_by_a_pupil_of_fifteen() {
    let mut grades: Vec<(f64, &str)> =
        STUDIES.iter().map(|study| (grade(&sentences(study)), *study)).collect();
    grades.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (below, above) = (grades[grades.len() / 2 - 1].0, grades[grades.len() / 2].0);
    assert!((below + above) / 2.0 <= GRADE, "{grades:?}");
}

/// Lines that a terminal shows.
const LINES: usize = 24;

/// The sentences of a study's first screen as lists of words, without names, code and numbers.
fn sentences(study: &str) -> Vec<Vec<String>> {
    let text = seen(&with("COLUMNS", "80", &["calibrate", &format!("examples/{study}.toml")]));
    let (screen, _) = text.split_once("\nResidual ").expect("figures follow the first screen");
    // The answer ends at the first blank line.
    let (answer, _) = screen.split_once("\n\n").unwrap_or((screen, ""));
    let of_cautions = answer
        .lines()
        .skip_while(|line| !line.starts_with("Caution"))
        .take_while(|line| !["What it is", "How much better"].contains(line));
    assert!(answer.contains("What to do next"), "{answer}");
    let lines = answer.lines().count() - of_cautions.count();
    assert!(lines <= LINES, "{study}: {lines} lines\n{answer}");
    let mut found = vec![Vec::new()];
    let mut is_code = false;
    for line in screen.lines().filter(|line| !line.starts_with("     trueaxis")) {
        // Headings, items of lists and steps begin with a sign or a capital at the margin.
        let begins =
            line.trim_start().starts_with(['-', '1', '2', '3', '4', '5', '6']) || !line.starts_with(' ');
        if begins || line.is_empty() {
            found.push(Vec::new());
        }
        for word in line.split_whitespace() {
            let is_name =
                is_code || word.contains(|c: char| c.is_ascii_digit() || matches!(c, '_' | '`' | '/' | '['));
            if word.matches('`').count() % 2 == 1 {
                is_code = !is_code;
            }
            let letters: String = word.chars().filter(|c| c.is_alphabetic()).collect();
            if !is_name && letters.chars().count() > 1 {
                found.last_mut().expect("one at least").push(letters.to_lowercase());
            }
            if word.trim_end_matches([')', '`']).ends_with(['.', '?', '!', ':']) {
                found.push(Vec::new());
            }
        }
    }
    found.retain(|sentence| !sentence.is_empty());
    found
}
