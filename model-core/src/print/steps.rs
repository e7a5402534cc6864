//! A derivation in steps, as lines of text or of formulas.

use super::{Style, poly};
use crate::algebra::Poly;
use crate::chain::{Chain, TransformKind};
use crate::forms::{Elementary, Group, Steps};

/// Small turns in a group whose product is written out before products are dropped: of more it fills a page.
const WRITTEN_OUT: usize = 3;

/// A derivation in a style; in LaTeX a line of mathematics each, in Markdown a list.
#[must_use]
pub fn steps(steps: &Steps, chain: &Chain, style: Style) -> String {
    let writer = Writer { chain, style };
    let observable = chain.observable(steps.observable);
    let vector = writer.vector(&observable.components);
    let mut lines = Vec::new();
    let mut product = String::new();
    for (index, group) in steps.groups.iter().enumerate() {
        product.push_str(&writer.product(&group.before));
        product.push_str(&writer.named("E", index + 1));
        product.push(' ');
    }
    product.push_str(&writer.product(&steps.after));
    lines.push(Line::Title("1. Write the product. Each E is a group of errors.".to_owned()));
    lines.push(Line::Formula(format!("v = {product}{vector}")));
    for (index, group) in steps.groups.iter().enumerate() {
        lines.push(Line::Formula(format!(
            "{} = {}",
            writer.named("E", index + 1),
            writer.product(&group.errors).trim_end()
        )));
    }
    lines.push(Line::Title(
        "2. Expand each group: a small turn by e about an axis u is I + e [u]. Drop products of errors."
            .to_owned(),
    ));
    for (index, group) in steps.groups.iter().enumerate() {
        writer.expansion(index + 1, group, &mut lines);
    }
    lines.push(Line::Title(
        "3. Expand the whole product. Terms with two groups are products of errors, and are dropped. What is left of each \
         group turns the vector behind it: t x b + d."
            .to_owned(),
    ));
    for (index, group) in steps.groups.iter().enumerate() {
        lines.push(writer.equation("b", index + 1, &group.behind));
        lines.push(Line::Formula(format!(
            "{} = {}",
            writer.moved(index + 1, group),
            writer.vector(&group.moved)
        )));
    }
    lines.push(Line::Title(
        "4. Use the transpose: R [t] R' = [R t] takes each turn out of its frame, with R all turns before the group.".to_owned(),
    ));
    for (index, group) in steps.groups.iter().enumerate() {
        lines.push(Line::Formula(format!(
            "R {} = {}",
            writer.named("t", index + 1),
            writer.vector(&group.turned_outside)
        )));
        lines.push(Line::Formula(format!(
            "R {} = {}",
            writer.named("b", index + 1),
            writer.vector(&group.behind_outside)
        )));
        lines.push(Line::Formula(format!(
            "R ({}) = {}",
            writer.moved(index + 1, group),
            writer.vector(&group.added)
        )));
    }
    lines.push(Line::Title("5. Collect. The sum over the groups is the error to first order.".to_owned()));
    for (axis, component) in ["x", "y", "z"].into_iter().zip(&steps.collected) {
        let name = match style {
            Style::Text => format!("{}_{axis}", observable.name),
            Style::Latex | Style::Markdown => format!("\\Delta v_{axis}"),
        };
        lines.push(Line::Formula(format!("{name} = {}", writer.poly(component))));
    }
    lines.iter().map(|line| line.show(style)).collect()
}

/// A line of a derivation.
enum Line {
    Title(String),
    Formula(String),
}

impl Line {
    fn show(&self, style: Style) -> String {
        match (self, style) {
            (Self::Title(title), Style::Text) => format!("{title}\n"),
            (Self::Title(title), Style::Latex) => format!("% {title}\n"),
            (Self::Title(title), Style::Markdown) => format!("\n**{title}**\n\n"),
            (Self::Formula(formula), Style::Text) => format!("   {formula}\n"),
            (Self::Formula(formula), Style::Latex) => format!("\\[{formula}\\]\n"),
            (Self::Formula(formula), Style::Markdown) => format!("- ${formula}$\n"),
        }
    }
}

struct Writer<'a> {
    chain: &'a Chain,
    style: Style,
}

impl Writer<'_> {
    fn poly(&self, formula: &Poly) -> String {
        let style = if self.style == Style::Text { Style::Text } else { Style::Latex };
        poly(formula, self.chain, style)
    }

    /// `E1`, `E_{1}`
    fn named(&self, name: &str, number: usize) -> String {
        if self.style == Style::Text { format!("{name}{number}") } else { format!("{name}_{{{number}}}") }
    }

    /// `Rz(alpha) Tx(arm) `
    fn product(&self, factors: &[Elementary]) -> String {
        let one = |factor: &Elementary| {
            let kind = if factor.kind == TransformKind::Rotation { 'R' } else { 'T' };
            let axis = ['x', 'y', 'z'][factor.axis];
            match self.style {
                Style::Text => format!("{kind}{axis}({}) ", self.poly(&factor.amount)),
                Style::Latex | Style::Markdown => {
                    format!("{kind}_{axis}\\left({}\\right) ", self.poly(&factor.amount))
                }
            }
        };
        factors.iter().map(one).collect()
    }

    fn vector(&self, vector: &[Poly; 3]) -> String {
        let parts: Vec<String> = vector.iter().map(|part| self.poly(part)).collect();
        match self.style {
            Style::Text => format!("({})", parts.join(", ")),
            Style::Latex | Style::Markdown => {
                format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", parts.join(" \\\\ "))
            }
        }
    }

    fn matrix(&self, matrix: &[[Poly; 3]; 3]) -> String {
        let separator = if self.style == Style::Text { ", " } else { " & " };
        let rows: Vec<String> = matrix
            .iter()
            .map(|row| row.iter().map(|entry| self.poly(entry)).collect::<Vec<_>>().join(separator))
            .collect();
        match self.style {
            Style::Text => rows.iter().map(|row| format!("[{row}]")).collect::<Vec<_>>().join(" "),
            Style::Latex | Style::Markdown => {
                format!("\\begin{{pmatrix}} {} \\end{{pmatrix}}", rows.join(" \\\\ "))
            }
        }
    }

    fn equation(&self, name: &str, number: usize, vector: &[Poly; 3]) -> Line {
        Line::Formula(format!("{} = {}", self.named(name, number), self.vector(vector)))
    }

    /// `t1 x b1 + d1`, as far as there are turns and shifts.
    fn moved(&self, number: usize, group: &Group) -> String {
        let cross = if self.style == Style::Text { "x" } else { "\\times" };
        let turned = format!("{} {cross} {}", self.named("t", number), self.named("b", number));
        let shifted = self.named("d", number);
        let is_there = |vector: &[Poly; 3]| vector.iter().any(|part| !part.is_zero());
        match (is_there(&group.turned), is_there(&group.shifted)) {
            (true, true) => format!("{turned} + {shifted}"),
            (false, true) => shifted,
            _ => turned,
        }
    }

    fn expansion(&self, number: usize, group: &Group, lines: &mut Vec<Line>) {
        let turns = group.errors.iter().filter(|one| one.kind == TransformKind::Rotation).count();
        if turns > 0 {
            if (2..=WRITTEN_OUT).contains(&turns) {
                let expanded = self.matrix(&group.expanded);
                lines.push(Line::Formula(format!("{} = {expanded}", self.named("E", number))));
            }
            lines.push(Line::Formula(format!(
                "{} = I + [{}] = {}",
                self.named("E", number),
                self.named("t", number),
                self.matrix(&group.dropped)
            )));
            lines.push(self.equation("t", number, &group.turned));
        }
        if turns < group.errors.len() {
            lines.push(self.equation("d", number, &group.shifted));
        }
    }
}
