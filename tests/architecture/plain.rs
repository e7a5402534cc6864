//! Plain words: what the program prints and what the book's reference says avoids these words, in sentences of so many at most.

/// Words and turns that a reader has to decode: of data, of residuals, of results. Each has a plain word of the field instead.
pub const NOT: &[&str] = &[
    "tell",
    "tells",
    "told",
    "say",
    "says",
    "said",
    "hold",
    "holds",
    "stand",
    "stands",
    "lie",
    "lies",
    "bear",
    "bears",
    "hang",
    "hangs",
    "nobody",
    "elsewhere",
    "left out",
    "left over",
    "out of reach",
    "far out",
    "set aside",
    "off about",
    "off along",
    "as well",
    "all the same",
    "so many",
    "of more",
    "off alike",
    "hit",
    "pass for",
    "counted as",
    "lacks",
    "no value here",
    "no measurement of",
    "across",
    "tell apart",
    "tells apart",
    "sets apart",
    "found again",
    "chance of as much",
    "a check at the instrument",
    "lean on",
    "surer",
];

/// Words of a sentence at most.
pub const LONGEST: usize = 30;

/// Whether words appear in a text as words of their own.
pub fn is_in(text: &str, words: &str) -> bool {
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    text.match_indices(words)
        .any(|(at, _)| !text[..at].ends_with(is_word) && !text[at + words.len()..].starts_with(is_word))
}

#[test]
fn words_are_found_as_words_of_their_own() {
    assert!(is_in("these data say", "say") && !is_in("essays", "say") && !is_in("saying", "say"));
}
