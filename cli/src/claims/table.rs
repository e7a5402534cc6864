//! A claims file as TOML has it; what it means is decided in [`super::read`].

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};
use toml::{Spanned, Value};

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// The declaration, relative to this file.
    pub chain: Spanned<String>,
    /// Printed symbols and what they stand for.
    #[serde(default)]
    pub symbols: BTreeMap<Spanned<String>, Spanned<String>>,
    /// The claims.
    #[serde(default)]
    pub claim: Vec<Spanned<ClaimTable>>,
}

/// One claim: one of `components`, `compare` and `count`, and what goes with it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimTable {
    pub name: Spanned<String>,
    pub observable: Option<Spanned<String>>,
    pub order: Option<Spanned<i64>>,
    pub keep: Option<Spanned<Texts>>,
    pub neglect: Option<Spanned<Texts>>,
    pub components: Option<Spanned<Texts>>,
    pub compare: Option<Spanned<CompareTable>>,
    pub path: Option<Spanned<String>>,
    pub range: Option<Spanned<Texts>>,
    pub count: Option<Spanned<CountTable>>,
}

/// A comparison.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CompareTable {
    pub error: Spanned<String>,
    pub against: Spanned<String>,
    pub size: Spanned<Value>,
    pub measure: Spanned<String>,
    pub at_most: Spanned<f64>,
}

/// A count.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CountTable {
    pub errors: Spanned<Texts>,
    pub equals: Spanned<i64>,
}

/// A text, or a list of texts.
#[derive(Debug)]
pub enum Texts {
    /// One, at the place of the whole value.
    One(String),
    /// Several, each with its place.
    Many(Vec<Spanned<String>>),
}

impl<'de> Deserialize<'de> for Texts {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TextsVisitor;

        impl<'de> Visitor<'de> for TextsVisitor {
            type Value = Texts;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a string or a list of strings")
            }

            fn visit_str<E>(self, text: &str) -> Result<Texts, E> {
                Ok(Texts::One(text.to_owned()))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Texts, A::Error> {
                let mut texts = Vec::new();
                while let Some(text) = list.next_element()? {
                    texts.push(text);
                }
                Ok(Texts::Many(texts))
            }
        }

        deserializer.deserialize_any(TextsVisitor)
    }
}
