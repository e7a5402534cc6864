//! The sentences that the program prints: the field's words, short, one statement each. Judged by the texts in the sources.

use crate::plain::{LONGEST, NOT, is_in};
use crate::sources::{SourceFile, below, root};

/// Folders whose sentences follow the rules.
const MOVED: &[&str] = &["observe/src", "report/src", "web/src"];

/// Folders whose sentences have not been rewritten yet. The list only shrinks: a folder that breaks no rule any more goes to [`MOVED`].
const NOT_YET_MOVED: &[&str] = &[
    "calibration/src",
    "claims/src",
    "class/src",
    "cli/src",
    "effects/src",
    "init/src",
    "model-core/src",
    "network/src",
    "service/src",
    "study/src",
    "tables/src",
];

#[test]
fn what_the_report_prints_is_said_in_plain_words() {
    let broken: Vec<String> =
        MOVED.iter().flat_map(|folder| below(folder)).flat_map(|file| broken(&file)).collect();
    assert!(broken.is_empty(), "{}", broken.join("\n"));
    let script = root().join("report/src/page/script.js");
    assert!(!std::fs::read_to_string(script).expect("UTF-8").contains("set aside"));
}

#[test]
fn rooms_that_wait_for_plain_words_are_few_and_still_need_them() {
    for folder in NOT_YET_MOVED {
        let some = below(folder).iter().any(|file| !broken(file).is_empty());
        assert!(some, "{folder}: nothing left to rewrite; list it under MOVED");
    }
    assert!(NOT_YET_MOVED.len() <= 11, "the list only shrinks");
}

/// What a file's texts break, each with its place. Code and markup among them are no sentences.
fn broken(file: &SourceFile) -> Vec<String> {
    let mut found = Vec::new();
    for (line, text) in texts(&file.text) {
        if text.contains('<') || !text.trim().contains(' ') {
            continue;
        }
        let prose = without_code(&text);
        let lower = prose.to_lowercase();
        for word in NOT.iter().filter(|word| is_in(&lower, word)) {
            found.push(format!("{}:{line}: `{word}`: {text}", file.path));
        }
        if prose.contains(';') {
            found.push(format!("{}:{line}: two statements in one sentence: {text}", file.path));
        }
        for sentence in prose.split_inclusive(['.', '?', '!', ':']) {
            let words =
                sentence.split_whitespace().filter(|word| word.contains(char::is_alphanumeric)).count();
            if words > LONGEST {
                found.push(format!("{}:{line}: {words} words: {sentence}", file.path));
            }
        }
    }
    found
}

/// A text without what is filled in and without code between backquotes; each counts as one word.
fn without_code(text: &str) -> String {
    let mut prose = String::new();
    let mut depth = 0_usize;
    let mut is_code = false;
    for letter in text.chars() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => {
                depth -= 1;
                prose.push('x');
            }
            '`' => {
                is_code = !is_code;
                prose.push('x');
            }
            _ if depth > 0 || is_code => {}
            letter => prose.push(letter),
        }
    }
    prose
}

/// The texts between quotation marks of a source before its tests, each with its line. Comments are passed over; a raw string ends
/// at its first quotation mark, which is enough for words.
fn texts(source: &str) -> Vec<(usize, String)> {
    let source = source.split("#[cfg(test)]").next().unwrap_or_default();
    let mut found = Vec::new();
    let mut letters = source.chars().peekable();
    let mut line = 1;
    while let Some(letter) = letters.next() {
        match letter {
            '\n' => line += 1,
            '/' if letters.peek() == Some(&'/') => {
                letters.by_ref().find(|letter| *letter == '\n');
                line += 1;
            }
            // `'"'` opens no text, and neither does `'\"'`.
            '\'' if letters.peek() == Some(&'"') => {
                letters.next();
            }
            '\'' if letters.peek() == Some(&'\\') => {
                letters.nth(1);
            }
            '"' => {
                let began = line;
                let mut text = String::new();
                while let Some(letter) = letters.next().filter(|letter| *letter != '"') {
                    match letter {
                        '\\' if letters.peek() == Some(&'\n') => {
                            line += 1;
                            letters.next();
                            while letters.next_if(|letter| letter.is_whitespace()).is_some() {}
                        }
                        '\\' => text.extend(letters.next()),
                        '\n' => {
                            line += 1;
                            text.push(' ');
                        }
                        letter => text.push(letter),
                    }
                }
                found.push((began, text));
            }
            _ => {}
        }
    }
    found
}

#[test]
fn texts_are_read_as_the_program_prints_them() {
    let source =
        "// \"no\"\nlet a = \"these data say\"; let b = '\"'; let c = \"one \\\n    two \\\" {three:4}\";";
    assert_eq!(texts(source), [(2, "these data say".to_owned()), (2, "one two \" {three:4}".to_owned())]);
    assert_eq!(without_code("a {told} `says` b"), "a x xx b");
}
