//! A table of first-order columns: an error a line, behind the parts that it is written in.

use super::{Hand, Style, by_hand};
use crate::algebra::Poly;
use crate::chain::Chain;
use crate::forms::Table;
use crate::symbol::{Quantity, SymbolId, SymbolKind};

/// A short way of writing a sine or cosine.
struct Short {
    angle: Vec<(SymbolId, i32)>,
    is_sine: bool,
    latex: String,
}

/// Definitions in a line of LaTeX.
const IN_A_LINE: usize = 3;

/// A table in a style.
#[must_use]
pub fn table(table: &Table, style: Style) -> String {
    let shorts = if style == Style::Text { Vec::new() } else { shorts(&table.chain) };
    let mut hand = Hand::default();
    for short in &shorts {
        hand.abbreviate(&short.angle, short.is_sine, &short.latex);
    }
    let inner = if style == Style::Markdown { Style::Latex } else { style };
    let write = |poly: &Poly| by_hand(poly, &table.chain, inner, &hand);
    let symbol = |id: SymbolId| {
        let symbol = table.chain.symbol(id);
        if style == Style::Text { symbol.name.clone() } else { symbol.latex.clone() }
    };
    let mut definitions: Vec<(String, String)> =
        table.parts.iter().map(|(id, part)| (symbol(*id), write(part))).collect();
    let rows: Vec<[String; 4]> = table
        .columns
        .iter()
        .map(|(error, [x, y, z])| [symbol(*error), write(x), write(y), write(z)])
        .collect();
    let placement =
        table.placement.as_ref().map(|rows| rows.each_ref().map(|row| row.each_ref().map(&write)));
    let written: String = definitions
        .iter()
        .map(|(_, part)| part.as_str())
        .chain(rows.iter().flatten().map(String::as_str))
        .chain(placement.iter().flatten().flatten().map(String::as_str))
        .collect();
    let used = shorts.iter().filter(|short| written.contains(&short.latex));
    let waves: Vec<(String, String)> =
        used.map(|short| (short.latex.clone(), short.meaning(&table.chain))).collect();
    definitions.splice(0..0, waves);
    match style {
        Style::Text => in_text(table, &definitions, &rows, placement.as_ref()),
        Style::Latex => in_latex(&definitions, &rows, placement.as_ref()),
        Style::Markdown => in_markdown(table, &definitions, &rows, placement.as_ref()),
    }
}

/// For one angle, and for sums of those that follow each other, the sine and the cosine.
fn shorts(chain: &Chain) -> Vec<Short> {
    /// Angles of a sum.
    const LONGEST: usize = 4;
    let joints: Vec<SymbolId> = chain
        .symbols_of(SymbolKind::Joint)
        .filter(|&id| chain.symbol(id).quantity == Quantity::Angle)
        .collect();
    let number = |id: SymbolId| {
        let name = &chain.symbol(id).name;
        let digits = name.trim_start_matches(|c: char| !c.is_ascii_digit());
        (digits.len() == 1).then(|| digits.to_owned())
    };
    let numbers: Option<Vec<String>> = joints.iter().map(|&id| number(id)).collect();
    let numbers =
        numbers.filter(|numbers| (1..numbers.len()).all(|at| !numbers[..at].contains(&numbers[at])));
    let mut shorts = Vec::new();
    for length in 1..=LONGEST.min(joints.len()) {
        for start in 0..=joints.len() - length {
            let part = &joints[start..start + length];
            let index = match &numbers {
                Some(numbers) => numbers[start..start + length].concat(),
                None => part.iter().map(|&id| chain.symbol(id).latex.clone()).collect::<Vec<_>>().join(" + "),
            };
            for (is_sine, letter) in [(false, 'c'), (true, 's')] {
                let angle = part.iter().map(|&id| (id, 1)).collect();
                shorts.push(Short { angle, is_sine, latex: format!("{letter}_{{{index}}}") });
            }
        }
    }
    // A letter that the chain uses itself says something else there.
    let is_free = |short: &Short| chain.symbols.iter().all(|symbol| symbol.latex != short.latex);
    if shorts.iter().all(is_free) { shorts } else { Vec::new() }
}

impl Short {
    fn meaning(&self, chain: &Chain) -> String {
        let function = if self.is_sine { "\\sin" } else { "\\cos" };
        let angles: Vec<&str> = self.angle.iter().map(|(id, _)| chain.symbol(*id).latex.as_str()).collect();
        match angles.as_slice() {
            [only] => format!("{function} {only}"),
            several => format!("{function}\\left({}\\right)", several.join(" + ")),
        }
    }
}

fn in_text(
    table: &Table,
    definitions: &[(String, String)],
    rows: &[[String; 4]],
    placement: Option<&[[String; 3]; 3]>,
) -> String {
    let mut text = String::new();
    for (number, bodies) in &table.frames {
        text.push_str(&format!("frame {number}: behind {bodies}\n"));
    }
    for (name, part) in definitions {
        text.push_str(&format!("{name} = {part}\n"));
    }
    for [error, x, y, z] in rows {
        text.push_str(&format!("{error}\n  x: {x}\n  y: {y}\n  z: {z}\n"));
    }
    if let Some(rows) = placement {
        text.push_str("x, y and z are turned into the frame of the observable by the rows\n");
        rows.iter().for_each(|row| text.push_str(&format!("  [{}]\n", row.join(", "))));
    }
    text
}

fn in_latex(
    definitions: &[(String, String)],
    rows: &[[String; 4]],
    placement: Option<&[[String; 3]; 3]>,
) -> String {
    let mut latex = String::new();
    if !definitions.is_empty() {
        let lines: Vec<String> = definitions
            .chunks(IN_A_LINE)
            .map(|line| {
                line.iter().map(|(name, part)| format!("{name} = {part}")).collect::<Vec<_>>().join(" &\n  ")
            })
            .collect();
        latex.push_str(&format!(
            "\\[\\begin{{array}}{{{}}}\n  {}\n\\end{{array}}\\]\n",
            "l".repeat(IN_A_LINE),
            lines.join(" \\\\\n  ")
        ));
    }
    let lines: Vec<String> = rows.iter().map(|row| row.join(" & ")).collect();
    latex.push_str(&format!(
        "\\[\\begin{{array}}{{l|lll}}\n   & x & y & z \\\\ \\hline\n  {}\n\\end{{array}}\\]\n",
        lines.join(" \\\\\n  ")
    ));
    if let Some(rows) = placement {
        let rows: Vec<String> = rows.iter().map(|row| row.join(" & ")).collect();
        latex.push_str(&format!(
            "\\[\\Delta = \\begin{{pmatrix}}\n  {}\n\\end{{pmatrix}} \\begin{{pmatrix}} x \\\\ y \\\\ z \\end{{pmatrix}}\\]\n",
            rows.join(" \\\\\n  ")
        ));
    }
    latex
}

fn in_markdown(
    table: &Table,
    definitions: &[(String, String)],
    rows: &[[String; 4]],
    placement: Option<&[[String; 3]; 3]>,
) -> String {
    let mut text = String::new();
    for (number, bodies) in &table.frames {
        text.push_str(&format!("- frame {number}: behind {bodies}\n"));
    }
    for (name, part) in definitions {
        text.push_str(&format!("- ${name} = {part}$\n"));
    }
    text.push_str("\n| error | x | y | z |\n|---|---|---|---|\n");
    for row in rows {
        let cells: Vec<String> = row.iter().map(|cell| format!("${cell}$")).collect();
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    if let Some(rows) = placement {
        let rows: Vec<String> = rows.iter().map(|row| row.join(" & ")).collect();
        text.push_str(&format!(
            "\n$\\Delta = \\begin{{pmatrix}} {} \\end{{pmatrix}} \\begin{{pmatrix}} x \\\\ y \\\\ z \\end{{pmatrix}}$\n",
            rows.join(" \\\\ ")
        ));
    }
    text
}
