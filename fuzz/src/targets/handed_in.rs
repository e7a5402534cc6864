//! What a student hands in: an answer and a declaration.

use std::sync::OnceLock;

use class::{Handed, Key, Level, grade};

use super::{is_seen, parts, text};

/// A class of one.
fn class() -> &'static (Key, String) {
    static CLASS: OnceLock<(Key, String)> = OnceLock::new();
    CLASS.get_or_init(|| {
        let drawn =
            Level::try_from(1).ok().and_then(|level| class::hand_out(&["A".to_owned()], "seed", level).ok());
        let Some((_, text)) = drawn else { unreachable!("a class of one can be drawn") };
        let Ok(key) = Key::of(&text) else { unreachable!("the key was just written") };
        let mark = key.students[0].mark.clone();
        (key, mark)
    })
}

/// An answer and the declaration below it, graded; `MARK` stands for the mark of the sheet.
pub fn graded(input: &[u8]) {
    let text = text(input);
    let (key, mark) = class();
    let [answer, declaration] = parts(&text);
    let handed = Handed { answer: Ok(answer.replace("MARK", mark)), declaration: Ok(declaration.to_owned()) };
    let Ok(marked) = grade(key, &key.students[0], &handed) else {
        unreachable!("the key is of this version")
    };
    assert!((0.0..=class::full()).contains(&marked.points), "{} points", marked.points);
    is_seen(&class::feedback(&marked));
    is_seen(&class::table(&[marked]));
}
