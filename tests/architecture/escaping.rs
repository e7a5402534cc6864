//! What others wrote reaches each target through `model_core::escape` alone.

use crate::sources::{SourceFile, below, libraries};

/// What writes to the terminal: only this may, and it takes screens and one-line messages.
const TERMINAL: &[&str] = &["cli/src/terminal.rs", "cli/src/output/mod.rs"];
const WRITES_THERE: &[&str] = &["stdout()", "stderr()", "println!", "print!(", "dbg!"];

/// Where markup is taken as it is: pictures whose texts went through `escape::markup`, styles and scripts of our own, and JSON for a script.
const MARKUP: &[&str] = &[
    "report/src/page/answer.rs",
    "report/src/page/card.rs",
    "report/src/page/chain.rs",
    "report/src/page/map.rs",
    "report/src/page/mod.rs",
    "report/src/page/pictures.rs",
    "service/src/budget/page.rs",
    "service/src/plan/page.rs",
];

/// What escapes by hand.
const BY_HAND: &[&str] = &[
    "&lt;",
    "&amp;",
    "&quot;",
    "escape_debug",
    "escape_default",
    "escape_unicode",
    "\"* /\"",
    "textbackslash",
];
/// Where it is done.
const ROOM: &str = "model-core/src/escape/";

fn forbidden<'a>(file: &'a SourceFile, words: &'a [&str]) -> impl Iterator<Item = (usize, &'a str)> {
    file.code().filter(|(_, line)| words.iter().any(|word| line.contains(word)))
}

#[test]
fn the_terminal_has_one_writer() {
    for file in below("cli/src").iter().filter(|file| !TERMINAL.contains(&file.path.as_str())) {
        let found = forbidden(file, WRITES_THERE).next();
        assert_eq!(found, None, "{}: write to a `Screen` and hand it to `terminal`", file.path);
    }
}

#[test]
fn markup_as_it_is_stands_where_its_texts_are_escaped() {
    let all = libraries().into_iter().chain(below("cli/src"));
    for file in all.filter(|file| !MARKUP.contains(&file.path.as_str())) {
        assert_eq!(forbidden(&file, &["PreEscaped"]).next(), None, "{}: hand `maud` the text", file.path);
    }
}

#[test]
fn nothing_is_escaped_by_hand() {
    for file in libraries().iter().chain(&below("cli/src")).filter(|file| !file.path.starts_with(ROOM)) {
        assert_eq!(forbidden(file, BY_HAND).next(), None, "{}: use `model_core::escape`", file.path);
    }
}
