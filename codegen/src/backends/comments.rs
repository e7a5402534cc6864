//! Words of a declaration inside comments: whatever they are, they stay there.
//!
//! One function a language takes any text apart into lines that are safe behind the language's comment marks. What ends
//! a line in some language ends it here, and letters that show nothing or turn the direction of writing are written by
//! their number.

/// Lines without any character that ends a line, or that readers of the text do not see.
pub(crate) fn lines(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut line = String::new();
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\r' if letters.peek() == Some(&'\n') => {}
            '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}' => {
                lines.push(std::mem::take(&mut line));
            }
            '\t' => line.push(' '),
            letter if letter.is_control() || is_unseen(letter) => {
                line.push_str(&format!("<U+{:04X}>", u32::from(letter)));
            }
            letter => line.push(letter),
        }
    }
    if !line.is_empty() {
        lines.push(line);
    }
    lines
}

/// One line of it all.
pub(crate) fn line(text: &str) -> String {
    lines(text).join(" ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Marks that turn the direction of writing, or have no width.
fn is_unseen(letter: char) -> bool {
    matches!(letter, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}')
}

/// Line comments behind a mark, which no letter of the line ends.
fn behind(mark: &str, text: &str) -> String {
    let line_of = |line: &String| format!("{}\n", format!("{mark} {line}").trim_end());
    let lines = lines(text);
    if lines.is_empty() { format!("{mark}\n") } else { lines.iter().map(line_of).collect() }
}

/// `//` comments of Rust and JavaScript.
pub(crate) fn slashes(text: &str) -> String {
    behind("//", text)
}

/// `///` comments of Rust.
pub(crate) fn rust_doc(text: &str) -> String {
    behind("///", text)
}

/// `//` comments of C. A backslash at the end, or its trigraph, would go on with the next line.
pub(crate) fn c(text: &str) -> String {
    let closed = |line: String| {
        let end = line.trim_end();
        if end.ends_with('\\') || end.ends_with("??/") { format!("{end} .") } else { line }
    };
    behind("//", &lines(text).into_iter().map(closed).collect::<Vec<_>>().join("\n"))
}

/// Inside `/** … */` of JavaScript.
pub(crate) fn javascript_doc(text: &str) -> String {
    line(text).replace("*/", "* /")
}

/// `#` comments of Python.
pub(crate) fn python(text: &str) -> String {
    behind("#", text)
}

/// Inside `r"""…"""` of Python, where it ends before the end of a line.
pub(crate) fn python_doc(text: &str) -> String {
    lines(text).join("\n").replace("\"\"\"", "'''")
}

/// `%` comments of LaTeX.
pub(crate) fn latex(text: &str) -> String {
    behind("%", text)
}
