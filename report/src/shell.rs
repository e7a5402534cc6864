//! Command lines that can be copied.

use std::borrow::Cow;

/// A path or a text as one word of a command line: in quotes where a shell would take it apart.
#[must_use]
pub fn shell_word(text: &str) -> Cow<'_, str> {
    let is_plain = |letter: char| letter.is_alphanumeric() || "/\\._-+=:,@%".contains(letter);
    if !text.is_empty() && text.chars().all(is_plain) {
        return Cow::Borrowed(text);
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
        ] {
            assert_eq!(shell_word(text), word);
        }
    }
}
