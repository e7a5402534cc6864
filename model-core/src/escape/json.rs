//! JSON: letters that nobody sees are written by their number, which means the same.

use std::borrow::Cow;

use super::letters::{is_unseen, replaced};

/// A finished text of JSON with every letter seen. Of control characters it has line breaks between its parts alone, as
/// JSON forbids others inside strings.
#[must_use]
pub fn json(text: &str) -> Cow<'_, str> {
    replaced(text, |letter| is_unseen(letter) && letter != '\n', by_number)
}

/// The same inside the script of a page, which no element can end.
#[must_use]
pub fn json_in_script(text: &str) -> String {
    replaced(text, |letter| (is_unseen(letter) && letter != '\n') || "<>&".contains(letter), by_number)
        .into_owned()
}

/// `\u202e`, in two parts where the number is beyond 16 bits.
fn by_number(out: &mut String, letter: char) {
    let mut units = [0; 2];
    for unit in letter.encode_utf16(&mut units) {
        out.push_str(&format!("\\u{unit:04x}"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_means_the_same_and_is_seen() {
        assert_eq!(
            json("{\n  \"a\": \"\u{202e}\u{e0041}\u{7f}\"\n}"),
            "{\n  \"a\": \"\\u202e\\udb40\\udc41\\u007f\"\n}"
        );
        assert_eq!(json_in_script("\"</script>\""), r#""\u003c/script\u003e""#);
    }
}
