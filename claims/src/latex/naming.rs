//! What stands on the left of `=`: a name, and perhaps which component it is.

use super::Unreadable;
use super::glyph;
use super::layout::Row;
use super::token::{Kind, Token};
use model_core::mistake::Mistake;

/// A name is symbols and functions of them; one that ends in x, y or z says which component it is.
pub(super) fn check(text: &str, row: &Row, axis: Option<usize>) -> Result<(), Unreadable> {
    let Some(first) = row.name.first() else { return Ok(()) };
    let mut depth = 0;
    for token in &row.name {
        match token.kind {
            Kind::Mark('{' | '(') => depth += 1,
            Kind::Mark('}' | ')') => depth -= 1,
            Kind::Mark('+' | '-' | '/') if depth == 0 => {
                return Err(Mistake::new(
                    token.place.clone(),
                    "what stands on the left of `=` is more than a name",
                )
                .with_help("give the right-hand side alone"));
            }
            _ => {}
        }
    }
    if matches!(first.kind, Kind::Digit(_)) {
        return Err(Mistake::new(first.place.clone(), "a number stands on the left of `=`")
            .with_help("give the right-hand side alone"));
    }
    let said = named_axis(row);
    match (axis, said) {
        (Some(axis), Some(said)) if axis != said => {
            let letters = ["x", "y", "z"];
            let place = first.place.start..row.name.last().unwrap_or(first).place.end;
            let shown = &text[place.clone()];
            Err(Mistake::new(
                place,
                format!(
                    "`{shown}` is named as component {}, and stands where {} belongs",
                    letters[said],
                    letters.get(axis).unwrap_or(&"none")
                ),
            )
            .with_help("write the components in the order x, y, z"))
        }
        _ => Ok(()),
    }
}

/// The component that a name says: `x`, `\Delta x`, `e_y`. The last letter of a longer name, `\Delta Az`, says none.
fn named_axis(row: &Row) -> Option<usize> {
    // As programs name it: `dx`, `delta_y`.
    if let [Token { kind: Kind::Name(name), .. }] = row.name.as_slice() {
        let letter = name.rsplit('_').next().unwrap_or(name);
        let letter = if letter.len() == 2 { letter.strip_prefix('d')? } else { letter };
        return ["x", "y", "z"].iter().position(|axis| *axis == letter);
    }
    let mut glyphs = Vec::new();
    let mut at = 0;
    while let Some(rest) = row.name.get(at..).filter(|rest| !rest.is_empty()) {
        match glyph::read(rest) {
            Ok(Some(read)) => {
                at += read.tokens;
                glyphs.push(read.glyph);
            }
            // An argument in parentheses ends the name.
            _ => break,
        }
    }
    let axis = |letter: &str| ["x", "y", "z"].iter().position(|axis| letter.eq_ignore_ascii_case(axis));
    let is_difference =
        |base: &str| matches!(base, "\\Delta" | "\\delta" | "d" | "\\mathrm{d}" | "\\partial" | "e");
    let (last, before) = glyphs.split_last()?;
    if !before.iter().all(|glyph| is_difference(&glyph.base)) {
        return None;
    }
    axis(&last.base).filter(|_| last.lower.is_empty()).or_else(|| axis(&last.lower))
}
