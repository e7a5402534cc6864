//! HTML and SVG.

use std::borrow::Cow;

use super::letters::{by_number, is_unseen, replaced};

/// A text in an element or an attribute: it opens nothing, ends nothing, and every letter is seen.
#[must_use]
pub fn markup(text: &str) -> Cow<'_, str> {
    replaced(
        text,
        |letter| is_hidden(letter) || "&<>\"'".contains(letter),
        |out, letter| match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            letter => by_number(out, letter),
        },
    )
}

/// A finished page or picture: whatever stands in its texts is seen.
#[must_use]
pub fn page(text: &str) -> Cow<'_, str> {
    replaced(text, is_hidden, by_number)
}

fn is_hidden(letter: char) -> bool {
    is_unseen(letter) && letter != '\n' && letter != '\t'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_opened_or_hidden() {
        assert_eq!(
            markup("<b x='\"'>&\u{202e}\n"),
            r"&lt;b x=&#39;&quot;&#39;&gt;&amp;\u{202e}".to_owned() + "\n"
        );
        assert_eq!(page("<p>\u{1b}\u{200b}</p>\n"), "<p>\\u{1b}\\u{200b}</p>\n");
    }
}
