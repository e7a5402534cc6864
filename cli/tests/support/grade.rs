//! How many years of school a text asks for.

/// The grade of Flesch and Kincaid. Source: J. P. Kincaid et al., Research Branch Report 8-75, Naval Technical Training Command, 1975.
pub fn grade(sentences: &[Vec<String>]) -> f64 {
    let words: Vec<&String> = sentences.iter().flatten().collect();
    let syllables: usize = words.iter().map(|word| syllables(word)).sum();
    let count = words.len() as f64;
    0.39 * count / sentences.len() as f64 + 11.8 * syllables as f64 / count - 15.59
}

/// Groups of vowels, a silent `e` at the end left out. It takes `area` for two syllables and `used` for two: right within about a tenth
/// over a page, which is half a grade.
fn syllables(word: &str) -> usize {
    let is_vowel = |c: char| "aeiouyäöü".contains(c);
    let mut count = 0;
    let mut before = false;
    for c in word.chars() {
        let now = is_vowel(c);
        count += usize::from(now && !before);
        before = now;
    }
    let is_silent = word.ends_with('e') && !word.ends_with("le") && count > 1;
    (count - usize::from(is_silent)).max(1)
}

#[test]
fn syllables_are_counted_about_right() {
    for (word, count) in
        [("residual", 3), ("noise", 1), ("table", 2), ("the", 1), ("correction", 3), ("axis", 2), ("x", 1)]
    {
        assert_eq!(syllables(word), count, "{word}");
    }
}
