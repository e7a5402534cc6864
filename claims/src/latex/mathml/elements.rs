//! Elements of MathML: operators and tables.

use model_core::escape::markup;

/// An operator, a relation or a bracket; only brackets around something are as high as it is.
pub(super) fn operator(sign: &str, stretches: bool) -> String {
    let is_bracket =
        matches!(sign, "(" | ")" | "[" | "]" | "{" | "}" | "|" | "‖" | "∣" | "∥" | "→" | "^" | "~" | "¯");
    let stretchy = match (is_bracket, stretches) {
        (true, true) => " stretchy=\"true\"",
        (true, false) => " stretchy=\"false\"",
        _ => "",
    };
    format!("<mo{stretchy}>{}</mo>", markup(sign))
}

/// Rows of cells; aligned at their signs, or each in the middle of its column.
pub(super) fn table(rows: &[Vec<String>], is_aligned: bool) -> String {
    let mut out = String::from("<mtable>");
    for row in rows {
        out.push_str("<mtr>");
        for (at, cell) in row.iter().enumerate() {
            let side = match (row.len(), at) {
                (0 | 1, _) | (3, 1) => "",
                _ if !is_aligned => "",
                (3, 2) => " style=\"text-align:left\"",
                (_, at) if at % 2 == 0 => " style=\"text-align:right\"",
                _ => " style=\"text-align:left\"",
            };
            out.push_str(&format!("<mtd{side}>{cell}</mtd>"));
        }
        out.push_str("</mtr>");
    }
    out.push_str("</mtable>");
    out
}
