//! Brackets in MathML: those that are as high as what stands between them, and those of environments.

use super::Writer;
use super::elements::{operator, table};
use crate::latex::token::Kind;

/// Environments that have brackets of their own.
const FENCES: [(&str, &str, &str); 8] = [
    ("pmatrix", "(", ")"),
    ("bmatrix", "[", "]"),
    ("Bmatrix", "{", "}"),
    ("vmatrix", "|", "|"),
    ("cases", "{", ""),
    ("dcases", "{", ""),
    ("rcases", "", "}"),
    ("drcases", "", "}"),
];

impl Writer<'_> {
    /// What stands between brackets, which are as high as it is; a bracket without its partner is a sign.
    pub(super) fn fenced(&mut self) -> Option<String> {
        let sign = |kind: &Kind| match kind {
            Kind::Mark(mark) => mark.to_string(),
            Kind::OpenBrace => "{".to_owned(),
            _ => "}".to_owned(),
        };
        let open = sign(&self.peek()?.kind);
        let has_partner = self.has_partner();
        self.at += 1;
        if !has_partner {
            return Some(operator(&open, false));
        }
        let inside = self.row(&closes)?;
        let close = self.peek().filter(|token| closes(&token.kind))?;
        self.at += 1;
        let (open, close) = (operator(&open, true), operator(&sign(&close.kind), true));
        Some(format!("<mrow>{open}{inside}{close}</mrow>"))
    }

    /// Whether the bracket here is closed within the cell or the group that it stands in.
    fn has_partner(&self) -> bool {
        let mut open: Vec<&Kind> = Vec::new();
        for token in &self.tokens[self.at..] {
            let kind = &token.kind;
            let is_within = |kind: &&Kind| matches!(kind, Kind::Mark('{') | Kind::Begin(_));
            match kind {
                Kind::Mark('(' | '[' | '{') | Kind::OpenBrace | Kind::Begin(_) => open.push(kind),
                Kind::Mark('}') | Kind::End(_) => match open.iter().rposition(is_within) {
                    Some(at) => open.truncate(at),
                    None => return false,
                },
                Kind::Row | Kind::Mark('&') if !open.iter().any(is_within) => return false,
                kind if closes(kind) && !open.last().is_some_and(is_within) => {
                    open.pop();
                    if open.is_empty() {
                        return true;
                    }
                }
                _ => {}
            }
        }
        false
    }

    pub(super) fn environment(&mut self, name: &str) -> Option<String> {
        let rows = self.table(&|kind| matches!(kind, Kind::End(_)))?;
        if self.peek()?.kind != Kind::End(name.to_owned()) {
            return None;
        }
        self.at += 1;
        let fence = FENCES.iter().find(|(own, ..)| *own == name);
        let is_aligned = fence.is_none() && !matches!(name, "matrix" | "smallmatrix" | "array");
        let table = table(&rows, is_aligned);
        let Some((_, open, close)) = fence else { return Some(table) };
        let sign = |sign: &str| if sign.is_empty() { String::new() } else { operator(sign, true) };
        Some(format!("<mrow>{}{table}{}</mrow>", sign(open), sign(close)))
    }
}

/// Whether a bracket closes here.
fn closes(kind: &Kind) -> bool {
    matches!(kind, Kind::Mark(')' | ']') | Kind::CloseBrace)
}
