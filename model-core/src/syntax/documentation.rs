//! Reading documentation: the `///` lines above what they document.

use proc_macro2::{Delimiter, Span, TokenTree};
use syn::buffer::Cursor;

use super::tokens::Reader;
use crate::mistake::Mistake;

/// The `///` lines here, which the lexer has turned into `#[doc = "…"]`.
pub fn documentation(reader: &mut Reader<'_, '_>) -> Result<String, Mistake<Span>> {
    let mut lines = Vec::new();
    let mut last = None;
    while let Some(hash) = reader.mark('#') {
        last = Some(hash);
        reader.mark('!');
        let line = reader.group(Delimiter::Bracket).and_then(|(inside, _)| documentation_line(inside));
        match line {
            Some(line) => lines.push(line),
            None => reader.mistakes.push(
                Mistake::new(hash, "an attribute cannot stand here")
                    .with_help("write documentation as `/// …`, and comments as `// …`"),
            ),
        }
    }
    match last {
        Some(last) if reader.is_at_end() => Err(Mistake::new(last, "nothing follows this documentation")
            .with_help("write `/// …` above what it documents, and any other remark as `// …`")),
        _ => Ok(lines.join("\n")),
    }
}

/// The text in `doc = "…"`, without the blank that follows `///`.
fn documentation_line(inside: Cursor<'_>) -> Option<String> {
    let (word, rest) = inside.ident()?;
    let (equals, rest) = rest.punct()?;
    let (literal, rest) = rest.literal()?;
    if word != "doc" || equals.as_char() != '=' || !rest.eof() {
        return None;
    }
    let line = string_value(&TokenTree::Literal(literal))?;
    Some(line.strip_prefix(' ').unwrap_or(&line).trim_end().to_owned())
}

/// The text that a string literal stands for.
pub fn string_value(literal: &TokenTree) -> Option<String> {
    syn::parse2::<syn::LitStr>(literal.clone().into()).ok().map(|string| string.value())
}
