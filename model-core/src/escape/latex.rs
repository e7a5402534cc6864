//! LaTeX: words, and formulas that somebody wrote.

use std::borrow::Cow;

use super::letters::{is_unseen, replaced};

/// Words of a text.
#[must_use]
pub fn latex(text: &str) -> Cow<'_, str> {
    replaced(
        text,
        |letter| is_unseen(letter) || "\\~^&%$#_{}[]*".contains(letter),
        |out, letter| match letter {
            '\n' | '\t' | '\r' => out.push(' '),
            '\\' => out.push_str(r"\textbackslash{}"),
            // Behind a line break they would belong to that.
            '[' | ']' | '*' => out.extend(['{', letter, '}']),
            '~' => out.push_str(r"\textasciitilde{}"),
            '^' => out.push_str(r"\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => {
                out.push('\\');
                out.push(letter);
            }
            letter => out.push_str(&format!("$\\langle$U+{:04X}$\\rangle$", u32::from(letter))),
        },
    )
}

/// Commands that act beyond the formula in which they stand: they read and write files, define commands, or end the formula.
const OUTWARD: [&str; 60] = [
    "input",
    "include",
    "includeonly",
    "includegraphics",
    "InputIfFileExists",
    "IfFileExists",
    "lstinputlisting",
    "verbatiminput",
    "usepackage",
    "RequirePackage",
    "documentclass",
    "openin",
    "openout",
    "read",
    "readline",
    "write",
    "closein",
    "closeout",
    "immediate",
    "special",
    "directlua",
    "latelua",
    "luaexec",
    "luadirect",
    "pdfobj",
    "pdfliteral",
    "pdffiledump",
    "pdfcatalog",
    "pdfximage",
    "def",
    "edef",
    "gdef",
    "xdef",
    "let",
    "futurelet",
    "newcommand",
    "renewcommand",
    "providecommand",
    "DeclareMathOperator",
    "DeclareRobustCommand",
    "newenvironment",
    "catcode",
    "lccode",
    "uccode",
    "csname",
    "endcsname",
    "expandafter",
    "noexpand",
    "scantokens",
    "everymath",
    "everypar",
    "output",
    "jobname",
    "url",
    "href",
    "htmlData",
    "begingroup",
    "endgroup",
    "loop",
    "shipout",
];

/// What keeps a formula from standing inside another: a letter that nobody sees, a comment, a dollar, a brace without its
/// partner, a command that acts beyond it. `None` where nothing does.
#[must_use]
pub fn latex_formula(text: &str) -> Option<String> {
    if let Some(letter) = text.chars().find(|letter| is_unseen(*letter)) {
        return Some(format!("the letter U+{:04X}, which nobody sees", u32::from(letter)));
    }
    let mut depth = 0_usize;
    let mut environments = Vec::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        match letter {
            '\\' => {
                let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
                let (command, behind) = rest.split_at(end);
                if OUTWARD.contains(&command) {
                    return Some(format!("`\\{command}`, which acts beyond the formula"));
                }
                if command == "begin" || command == "end" {
                    let (name, _) =
                        behind.strip_prefix('{').and_then(|name| name.split_once('}')).unwrap_or_default();
                    if command == "begin" {
                        environments.push(name);
                    } else if environments.pop() != Some(name) {
                        return Some(format!("`\\end{{{name}}}` without its `\\begin`"));
                    }
                }
                if environments.is_empty() && command.is_empty() && behind.starts_with('\\') {
                    return Some("`\\\\` outside of an environment".to_owned());
                }
                // `\{`, `\%` and the like are signs; `^^5c` would be a backslash.
                rest = match command {
                    "" => rest.strip_prefix(|_: char| true).unwrap_or_default(),
                    _ => behind,
                };
            }
            '{' => depth += 1,
            '}' => match depth.checked_sub(1) {
                Some(less) => depth = less,
                None => return Some("a `}` without its `{`".to_owned()),
            },
            '&' if environments.is_empty() => {
                return Some("`&` outside of an environment; write `\\&`".to_owned());
            }
            '%' => return Some("`%`, which begins a comment; write `\\%`".to_owned()),
            '$' => return Some("`$`, which ends the formula; write `\\$`".to_owned()),
            '^' if rest.starts_with('^') => {
                return Some("`^^`, which names a letter by its number".to_owned());
            }
            _ => {}
        }
    }
    if depth > 0 {
        return Some("a `{` without its `}`".to_owned());
    }
    environments.pop().map(|name| format!("`\\begin{{{name}}}` without its `\\end`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_words() {
        assert_eq!(latex("[a]*"), "{[}a{]}{*}");
        assert_eq!(latex("50% of \\input{x}_1\n"), r"50\% of \textbackslash{}input\{x\}\_1 ");
    }

    #[test]
    fn a_formula_stays_in_its_place() {
        for formula in [
            r"\Delta\theta_{y1}^{0}",
            r"\{x\}\%",
            "",
            r"\mathrm{tilt}",
            r"\left(a\right)",
            r"\text{e 1}",
            "Δθ",
        ] {
            assert_eq!(latex_formula(formula), None, "{formula}");
        }
        for formula in [
            "a}",
            "{a",
            "a%",
            "$a$",
            "\u{1b}",
            "a\nb",
            r"\input{x}",
            r"\immediate\write18{x}",
            "^^5cinput",
            "a\u{202e}",
        ] {
            assert!(latex_formula(formula).is_some(), "{formula:?}");
        }
    }
}
