//! Command lines that can be copied.

use std::borrow::Cow;

use model_core::escape::is_unseen;

/// A path or a text as one word of a command line: in quotes where a shell would take it apart.
#[must_use]
pub fn shell_word(text: &str) -> Cow<'_, str> {
    let is_plain =
        |letter: char| !is_unseen(letter) && (letter.is_alphanumeric() || "/\\._-+=:,@%".contains(letter));
    if !text.is_empty() && text.chars().all(is_plain) {
        return Cow::Borrowed(text);
    }
    // What nobody would see in quotes is written by its bytes, as bash, zsh and ksh read them.
    if text.contains(is_unseen) {
        let byte = |byte: u8| match byte {
            b'\'' | b'\\' => format!("\\{}", char::from(byte)),
            b' '..=b'~' => char::from(byte).to_string(),
            byte => format!("\\x{byte:02x}"),
        };
        return Cow::Owned(format!("$'{}'", text.bytes().map(byte).collect::<String>()));
    }
    Cow::Owned(format!("'{}'", text.replace('\'', r"'\''")))
}

#[cfg(test)]
mod tests {
    use super::shell_word;

    #[test]
    fn what_a_shell_would_take_apart_is_quoted() {
        for plain in ["result/errors.toml", "../weiß_2.csv", "C:\\data\\a.csv", "a=1"] {
            assert_eq!(shell_word(plain), plain);
        }
        for (text, word) in [
            ("my data.csv", "'my data.csv'"),
            ("a;b", "'a;b'"),
            ("it's", r"'it'\''s'"),
            ("$x", "'$x'"),
            ("", "''"),
            ("a\n'\u{202e}\\", r"$'a\x0a\'\xe2\x80\xae\\'"),
        ] {
            assert_eq!(shell_word(text), word);
        }
    }
}
