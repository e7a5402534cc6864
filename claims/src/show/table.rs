//! Verdicts as a table that a referee attaches: equation, verdict, what differs, in Markdown, LaTeX or HTML.

use std::fmt::Write as _;

use model_core::{escape, print};

use crate::checker::{Claim, Outcome, Verdict};
use crate::file::{Checked, Claims, Unread};
use crate::latex::mathml;

/// How a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A table of Markdown, formulas between dollars.
    Markdown,
    /// A `longtable` of LaTeX.
    Latex,
    /// A page of HTML, formulas as MathML; what cannot be set so, as it is written in LaTeX.
    Html,
}

/// A part of a cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Piece {
    /// Words.
    Words(String),
    /// A formula in LaTeX.
    Formula(String),
    /// A formula in the plain syntax, or a line of a program.
    Code(String),
}

/// One row of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// What the equation is called, or where it stands.
    pub name: String,
    /// The equation.
    pub equation: Vec<Piece>,
    /// `holds`, `differs`, `open` or `unread`.
    pub verdict: &'static str,
    /// What differs, or why there is no verdict.
    pub remarks: Vec<Vec<Piece>>,
}

/// The rows of a file: claims with a verdict, and those without.
#[must_use]
pub fn lines(file: &Claims, checked: &[Checked<'_>], undecided: &[Unread]) -> Vec<Line> {
    let mut lines: Vec<(usize, Line)> =
        checked.iter().map(|one| (one.claim.place.start, of_claim(file, one))).collect();
    for one in file.unread.iter().chain(undecided) {
        let remarks = one.mistakes.iter().map(|mistake| {
            let help = mistake.help.as_ref().map_or(String::new(), |help| format!("; {help}"));
            vec![Piece::Words(format!("{}{help}", mistake.message))]
        });
        let line = Line {
            name: one.name.clone(),
            equation: Vec::new(),
            verdict: "unread",
            remarks: remarks.collect(),
        };
        lines.push((one.place.start, line));
    }
    lines.sort_by_key(|(place, _)| *place);
    lines.into_iter().map(|(_, line)| line).collect()
}

/// The row of one claim.
#[must_use]
pub fn of_claim(file: &Claims, Checked { claim, verdict }: &Checked<'_>) -> Line {
    let words = |text: String| Piece::Words(text);
    let formula = |text: String| Piece::Formula(text);
    let mut equation = Vec::new();
    for text in &claim.texts {
        if !equation.is_empty() {
            equation.push(words(", ".to_owned()));
        }
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        equation.push(if claim.is_plain { Piece::Code(text) } else { formula(bare(&text)) });
    }
    let latex = |value: &crate::checker::Fraction| formula(value.show(&file.printed, print::Style::Latex));
    let mut remarks = Vec::new();
    match (verdict, &claim.claim) {
        (Verdict::ClosedForm(form), Claim::ClosedForm(claimed)) => {
            let shown = file.chain.observable(claimed.observable);
            for difference in &form.differences {
                remarks.push(vec![
                    words(format!("{}, ", shown.label(difference.component.index()))),
                    formula(print::latex(&difference.error_product(), &file.printed)),
                    words(": printed ".to_owned()),
                    latex(&difference.printed),
                    words(", derived ".to_owned()),
                    latex(&difference.derived),
                ]);
            }
            for slip in &form.slips {
                remarks.push(vec![words(slip.describe(&file.chain, claimed.observable))]);
            }
            if claimed.printed.truncated && form.differences.is_empty() {
                remarks.push(vec![words(
                    "compared to the claimed order; the print has terms beyond".to_owned(),
                )]);
            }
        }
        (Verdict::Equality(equality), _) if !equality.difference.is_zero() => {
            remarks.push(vec![words(equality.words().to_owned()), latex(&equality.difference)]);
        }
        (Verdict::Entries(entries), _) => {
            for difference in &entries.differences {
                remarks.push(vec![
                    words(format!("{}: printed ", difference.label)),
                    latex(&difference.printed),
                    words(", derived ".to_owned()),
                    latex(&difference.derived),
                ]);
            }
        }
        (Verdict::Values(values), Claim::Values(claimed)) => {
            let shown = file.chain.observable(claimed.observable);
            for (value, reading) in values.iter().zip(&shown.shown).filter(|(value, _)| !value.holds()) {
                let unit = reading.unit(shown.kind);
                remarks.push(vec![words(format!(
                    "{}: printed {:e} {unit}, computed {:e} {unit}",
                    value.label, value.claimed, value.found
                ))]);
            }
        }
        _ => {}
    }
    let verdict = match verdict.outcome() {
        Outcome::Holds => "holds",
        Outcome::Differs => "differs",
        Outcome::Undecided => "open",
    };
    Line { name: claim.name.clone(), equation, verdict, remarks }
}

/// A formula without what sets it on a page.
fn bare(text: &str) -> String {
    let text = text.trim().trim_matches('`').trim_matches('$').trim();
    let text = text.strip_prefix(r"\[").and_then(|inside| inside.strip_suffix(r"\]")).unwrap_or(text);
    let mut text = text.trim().to_owned();
    for name in [
        "equation",
        "equation*",
        "align",
        "align*",
        "displaymath",
        "gather",
        "gather*",
        "eqnarray",
        "eqnarray*",
    ] {
        let (begin, end) = (format!(r"\begin{{{name}}}"), format!(r"\end{{{name}}}"));
        if let Some(inside) = text.strip_prefix(&begin).and_then(|rest| rest.strip_suffix(&end)) {
            let inside = inside.trim();
            let is_aligned = inside.contains('&');
            text = if is_aligned {
                format!(r"\begin{{aligned}}{inside}\end{{aligned}}")
            } else {
                inside.to_owned()
            };
        }
    }
    text
}

/// The table.
#[must_use]
pub fn as_table(title: &str, lines: &[Line], format: Format) -> String {
    let held = lines.iter().filter(|line| line.verdict == "holds").count();
    let total = format!("{held} of {} claims hold", lines.len());
    match format {
        Format::Markdown => markdown(title, lines, &total),
        Format::Latex => latex(title, lines, &total),
        Format::Html => html(title, lines, &total),
    }
}

fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn markdown(title: &str, lines: &[Line], total: &str) -> String {
    let words = |text: &str| {
        let blank = |is: bool| if is { " " } else { "" };
        let shown = escape::markdown(&escape::line(text));
        format!("{}{shown}{}", blank(text.starts_with(' ')), blank(text.ends_with(' ')))
    };
    let cell = |pieces: &[Piece]| -> String {
        let written = pieces.iter().map(|piece| match piece {
            Piece::Words(text) => words(text),
            Piece::Formula(text) => match escape::latex_formula(&on_one_line(text)) {
                None => format!("${}$", on_one_line(text).replace('|', r"\vert ").replace('<', r"\lt ")),
                Some(_) => format!("`{}`", escape::markdown_code(text)),
            },
            Piece::Code(text) => format!("`{}`", escape::markdown_code(text)),
        });
        written.collect()
    };
    let mut out =
        format!("# {}\n\n| claim | equation | verdict | what differs |\n|---|---|---|---|\n", words(title));
    for line in lines {
        let remarks: Vec<String> = line.remarks.iter().map(|remark| cell(remark)).collect();
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} |",
            words(&line.name),
            cell(&line.equation),
            line.verdict,
            remarks.join("<br>")
        );
    }
    let _ = writeln!(out, "\n{total}");
    out
}

/// The columns of a table in LaTeX: an equation has a line of its own below them, as wide as the page.
const LATEX_COLUMNS: &str = "\\begin{longtable}{>{\\raggedright}p{0.25\\textwidth}p{0.1\\textwidth}>{\\raggedright\\arraybackslash}p{0.5\\textwidth}}\n";
const LATEX_LINE: &str = r">{\raggedright\arraybackslash}p{0.9\textwidth}";

/// A formula that stays on the page: in a line it breaks at its signs; what cannot break is made smaller where it is too wide.
fn fitting(formula: &str) -> String {
    if formula.contains(r"\begin{") || formula.contains(r"\left") {
        format!(r"\adjustbox{{max width=\linewidth}}{{$\displaystyle {formula}$}}")
    } else {
        format!("${formula}$")
    }
}

fn latex(title: &str, lines: &[Line], total: &str) -> String {
    let words = escape::latex;
    let cell = |pieces: &[Piece]| -> String {
        let written = pieces.iter().map(|piece| match piece {
            Piece::Words(text) => words(text).into_owned(),
            Piece::Formula(text) => match escape::latex_formula(&on_one_line(text)) {
                None => fitting(&on_one_line(text)),
                Some(_) => format!(r"\texttt{{{}}}", words(text)),
            },
            Piece::Code(text) => format!(r"\texttt{{{}}}", words(text)),
        });
        written.collect()
    };
    let mut out = format!(
        "{}% needs \\usepackage{{longtable,array,amsmath,adjustbox}}\n{LATEX_COLUMNS}claim and equation & verdict & what differs \\\\ \\hline\n",
        escape::comments::latex(&escape::line(title))
    );
    for line in lines {
        let remarks: Vec<String> = line.remarks.iter().map(|remark| cell(remark)).collect();
        let _ =
            writeln!(out, "{} & {} & {} \\\\*", words(&line.name), line.verdict, remarks.join(r" \newline "));
        if !line.equation.is_empty() {
            let _ = writeln!(out, r"\multicolumn{{3}}{{{LATEX_LINE}}}{{{}}} \\", cell(&line.equation));
        }
        out.push_str("\\hline\n");
    }
    let _ = writeln!(out, "\\end{{longtable}}\n{}", words(total));
    out
}

fn html(title: &str, lines: &[Line], total: &str) -> String {
    let words = escape::markup;
    let cell = |pieces: &[Piece]| -> String {
        let written = pieces.iter().map(|piece| match piece {
            Piece::Words(text) => words(text).into_owned(),
            Piece::Formula(text) => mathml(text).unwrap_or_else(|| format!("<code>{}</code>", words(text))),
            Piece::Code(text) => format!("<code>{}</code>", words(text)),
        });
        written.collect()
    };
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n<style>body{{font-family:sans-serif}}td,th{{padding:.3em .6em;border-bottom:1px solid #ccc;text-align:left;vertical-align:top}}.differs,.unread{{color:#a00}}</style></head>\n<body><h1>{0}</h1>\n<table><thead><tr><th>claim</th><th>equation</th><th>verdict</th><th>what differs</th></tr></thead><tbody>\n",
        words(title)
    );
    for line in lines {
        let remarks: Vec<String> = line.remarks.iter().map(|remark| cell(remark)).collect();
        let _ = writeln!(
            out,
            "<tr><td>{}</td><td>{}</td><td class=\"{}\">{}</td><td>{}</td></tr>",
            words(&line.name),
            cell(&line.equation),
            line.verdict,
            line.verdict,
            remarks.join("<br>")
        );
    }
    let _ = writeln!(out, "</tbody></table>\n<p>{}</p></body></html>", words(total));
    out
}
