//! The text of a study read as TOML, past every mistake: what is wrong is told and left out, and the rest is read again.

use std::ops::Range;

use model_core::Mistakes;
use serde::Deserialize as _;
use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue, Deserializer, Error};

use super::toml_mistakes::mistake;
use super::written::Study;

/// Mistakes that are told of one text, at most.
const TOLD: usize = 30;

impl Study {
    /// Reads a study file.
    ///
    /// # Errors
    /// Every mistake of its form, each with its place.
    ///
    /// # Example
    ///
    /// ```
    /// use study::Study;
    ///
    /// let text = "chain = 'mount.chain'\ndata = 'stars.csv'\n[observed]\nkind = 'direction'\nx = 'x'\ny = 'y'\nz = 'z'\n";
    /// let study = Study::from_text(text)?;
    /// assert_eq!(study.chain.get_ref(), "mount.chain");
    ///
    /// let mistakes = Study::from_text(&text.replace("kind", "kidn")).unwrap_err();
    /// assert!(mistakes.to_string().contains("kidn"));
    /// # Ok::<(), model_core::Mistakes>(())
    /// ```
    pub fn from_text(text: &str) -> Result<Self, Mistakes> {
        read(text)
    }
}

fn read(text: &str) -> Result<Study, Mistakes> {
    let (mut table, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(Mistakes::locate(text, errors.iter().map(mistake)));
    }
    let mut mistakes = Vec::new();
    // Tables that lack what was left out of them: what is missing there is no mistake of its own.
    let mut lacking: Vec<Range<usize>> = Vec::new();
    while mistakes.len() < TOLD {
        let error = match Study::deserialize(Deserializer::from(table.clone())) {
            Ok(study) if mistakes.is_empty() => return Ok(Study { text: text.to_owned(), ..study }),
            Ok(_) => break,
            Err(error) => error,
        };
        let place = error.span().unwrap_or_default();
        if !(is_missing(&error) && lacking.contains(&place)) {
            mistakes.push(mistake(&error));
        }
        let whole = table.span();
        let Some(lacks) = remove(table.get_mut(), whole, &place) else { break };
        lacking.push(lacks);
    }
    Err(Mistakes::locate(text, mistakes))
}

fn is_missing(error: &Error) -> bool {
    error.message().starts_with("missing field")
}

/// Takes the innermost entry at a place out of a table, which stands at `of`; returns where the table or list stands that it was
/// taken out of. The place of a table with a header is that of its header alone: every one is looked into.
fn remove(table: &mut DeTable<'_>, of: Range<usize>, place: &Range<usize>) -> Option<Range<usize>> {
    if let Some(inside) = table.iter_mut().find_map(|(_, value)| remove_inside(value, place)) {
        return Some(inside);
    }
    let is_at = |(key, value): &(&Spanned<DeString<'_>>, &Spanned<DeValue<'_>>)| {
        around(&key.span(), place) || around(&value.span(), place)
    };
    let key = table.iter().find(is_at)?.0.clone();
    table.remove(&key);
    Some(of)
}

fn remove_inside(value: &mut Spanned<DeValue<'_>>, place: &Range<usize>) -> Option<Range<usize>> {
    let of = value.span();
    if of == *place {
        return None;
    }
    match value.get_mut() {
        DeValue::Table(table) => remove(table, of, place),
        DeValue::Array(list) => {
            if let Some(inside) = list.iter_mut().find_map(|entry| remove_inside(entry, place)) {
                return Some(inside);
            }
            let at = list.iter().position(|entry| around(&entry.span(), place))?;
            let others = list.iter().enumerate().filter(|(other, _)| *other != at);
            *list = others.map(|(_, entry)| entry.clone()).collect();
            Some(of)
        }
        _ => None,
    }
}

fn around(span: &Range<usize>, place: &Range<usize>) -> bool {
    span.start <= place.start && place.end <= span.end && !place.is_empty()
}
