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

/// One claim: one of `components`, `equal`, `total`, `compare`, `size`, `bound`, `count`, `rank`, `confounded`, `separable`, and
/// what goes with it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimTable {
    pub name: Spanned<String>,
    pub observable: Option<Spanned<Texts>>,
    pub order: Option<Spanned<Value>>,
    pub keep: Option<Spanned<Texts>>,
    pub neglect: Option<Spanned<Texts>>,
    pub component: Option<Spanned<String>>,
    pub faces: Option<Spanned<FacesTable>>,
    pub path: Option<Spanned<String>>,
    pub range: Option<Spanned<Texts>>,
    pub components: Option<Spanned<Texts>>,
    pub equal: Option<Spanned<Texts>>,
    pub total: Option<Spanned<String>>,
    pub compare: Option<Spanned<CompareTable>>,
    pub size: Option<Spanned<SizeTable>>,
    pub bound: Option<Spanned<BoundTable>>,
    pub count: Option<Spanned<CountTable>>,
    pub rank: Option<Spanned<CountTable>>,
    pub confounded: Option<Spanned<Texts>>,
    pub separable: Option<Spanned<Texts>>,
}

/// The second face, and what is taken of both.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FacesTable {
    pub second: BTreeMap<Spanned<String>, Spanned<String>>,
    pub take: Spanned<String>,
}

/// Errors by name or pattern, with their sizes.
pub type Sizes = Spanned<BTreeMap<Spanned<String>, Spanned<Value>>>;

/// An absolute size.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SizeTable {
    pub errors: Sizes,
    pub measure: Spanned<String>,
    pub combine: Option<Spanned<String>>,
    pub at_most: Option<Spanned<Value>>,
    pub at_least: Option<Spanned<Value>>,
}

/// A bound on what the first order drops.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundTable {
    pub errors: Sizes,
    pub at_most: Spanned<Value>,
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

/// A count, or a rank.
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
