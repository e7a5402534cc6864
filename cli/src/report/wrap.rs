//! Text set to a width: words are never cut, lines after the first hang under it.

use std::fmt::Write as _;

/// Appends a paragraph: the first line after `first`, the others after as many blanks; `width` letters at most.
pub fn paragraph(text: &mut String, first: &str, words: &str, width: usize) {
    let indent = first.chars().count();
    let mut line = first.to_owned();
    let mut empty = true;
    for word in words.split_whitespace() {
        let letters = line.chars().count() + usize::from(!empty) + word.chars().count();
        if !empty && letters > width {
            let _ = writeln!(text, "{}", line.trim_end());
            line = " ".repeat(indent);
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    let _ = writeln!(text, "{}", line.trim_end());
}

#[cfg(test)]
mod tests {
    use super::paragraph;

    #[test]
    fn lines_hang_under_the_first() {
        let mut text = String::new();
        paragraph(&mut text, "  - ", "the encoder of β sits off centre", 20);
        assert_eq!(text, "  - the encoder of β\n    sits off centre\n");
    }

    #[test]
    fn a_long_word_is_not_cut() {
        let mut text = String::new();
        paragraph(&mut text, "", "a incomprehensibilities b", 8);
        assert_eq!(text, "a\nincomprehensibilities\nb\n");
    }
}
