//! Words inside comments: whatever they are, they stay there.
//!
//! One function a language takes any text apart into lines that are safe behind the language's comment marks.

pub use super::letters::lines;
use super::markdown::markdown;

/// One line of it all.
#[must_use]
pub fn line(text: &str) -> String {
    lines(text).join(" ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Line comments behind a mark, which no letter of the line ends.
fn behind(mark: &str, text: &str) -> String {
    let line_of = |line: &String| format!("{}\n", format!("{mark} {line}").trim_end());
    let lines = lines(text);
    if lines.is_empty() { format!("{mark}\n") } else { lines.iter().map(line_of).collect() }
}

/// `//` comments of Rust and JavaScript.
#[must_use]
pub fn slashes(text: &str) -> String {
    behind("//", text)
}

/// `///` comments of Rust: documentation whose words stay words, so that no test of it runs.
#[must_use]
pub fn rust_doc(text: &str) -> String {
    behind("///", &markdown(text))
}

/// `//` comments of C. A backslash at the end, or its trigraph, would go on with the next line.
#[must_use]
pub fn c(text: &str) -> String {
    let closed = |line: String| {
        let end = line.trim_end();
        if end.ends_with('\\') || end.ends_with("??/") { format!("{end} .") } else { line }
    };
    behind("//", &lines(text).into_iter().map(closed).collect::<Vec<_>>().join("\n"))
}

/// Inside `/** … */` of JavaScript.
#[must_use]
pub fn javascript_doc(text: &str) -> String {
    line(text).replace("*/", "* /")
}

/// `#` comments of Python.
#[must_use]
pub fn python(text: &str) -> String {
    behind("#", text)
}

/// `%` comments of MATLAB and Octave: behind a space no letter begins a block, or a test of Octave.
#[must_use]
pub fn matlab(text: &str) -> String {
    behind("%", text)
}

/// Inside `r"""…"""` of Python, where it ends before the end of a line.
#[must_use]
pub fn python_doc(text: &str) -> String {
    lines(text).join("\n").replace("\"\"\"", "'''")
}

/// Inside `(* … *)` of Coq: nothing in it ends the comment, begins another or opens a string.
#[must_use]
pub fn coq(text: &str) -> String {
    line(text).replace('"', "'").replace("(*", "( *").replace("*)", "* )")
}

/// `%` comments of LaTeX.
#[must_use]
pub fn latex(text: &str) -> String {
    behind("%", text)
}
