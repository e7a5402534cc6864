//! A claims file as TOML has it; what it means is decided in [`super::read`].

use std::collections::BTreeMap;
use std::fmt;

use serde::Deserialize;
use serde::de::{Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use toml::{Spanned, Value};

/// The whole file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// The declaration, relative to this file. Without one the claims are equalities of formulas.
    pub chain: Option<Spanned<String>>,
    /// A Denavit–Hartenberg table in place of a declaration.
    pub dh: Option<Spanned<DhTable>>,
    /// What `R_z(\\psi)` turns where nothing defines it: vectors or axes.
    pub rotations: Option<Spanned<String>>,
    /// Printed symbols and what they stand for.
    #[serde(default)]
    pub symbols: BTreeMap<Spanned<String>, Spanned<Meant>>,
    /// The claims.
    #[serde(default)]
    pub claim: Vec<Spanned<ClaimTable>>,
}

impl File {
    /// Whether nothing is claimed but that formulas are equal.
    #[must_use]
    pub fn has_equalities_only(&self) -> bool {
        !self.claim.is_empty() && self.claim.iter().all(|claim| claim.get_ref().equal.is_some())
    }
}

/// One claim: one of the keys that name a kind, and what goes with it.
#[derive(Debug, Clone, Deserialize)]
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
    pub correction: Option<Spanned<Texts>>,
    pub shows: Option<Spanned<Texts>>,
    pub frame: Option<Spanned<String>>,
    pub body: Option<Spanned<String>>,
    #[serde(rename = "in")]
    pub within: Option<Spanned<String>>,
    pub jacobian: Option<Spanned<String>>,
    pub by: Option<Spanned<Texts>>,
    pub image: Option<Spanned<Texts>>,
    pub camera: Option<Spanned<CameraTable>>,
    pub value: Option<Spanned<ValueTable>>,
    pub neglected: Option<Spanned<NeglectedTable>>,
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

impl ClaimTable {
    /// The formulas that are printed.
    #[must_use]
    pub fn formulas(&self) -> Vec<&str> {
        let several = [&self.components, &self.correction, &self.shows, &self.image, &self.equal];
        let single = [&self.total, &self.frame, &self.jacobian];
        let several = several.into_iter().flatten().flat_map(|texts| match texts.get_ref() {
            Texts::One(text) => vec![text.as_str()],
            Texts::Many(many) => many.iter().map(|text| text.get_ref().as_str()).collect(),
        });
        several.chain(single.into_iter().flatten().map(|text| text.get_ref().as_str())).collect()
    }
}

/// What a printed symbol stands for.
#[derive(Debug)]
pub enum Meant {
    /// An amount, a vector or a matrix, in the plain syntax or in LaTeX.
    Text(String),
    /// A screw: angular and linear velocity.
    Screw([Spanned<String>; 2]),
}

/// A Denavit–Hartenberg table.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DhTable {
    pub convention: Spanned<String>,
    pub rows: Vec<Spanned<BTreeMap<String, Spanned<String>>>>,
    #[serde(default)]
    pub constants: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    pub errors: bool,
}

/// A pinhole camera.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CameraTable {
    pub focal: Spanned<Texts>,
    pub center: Option<Spanned<Texts>>,
    pub axes: Option<Spanned<Texts>>,
    pub radial: Option<Spanned<Texts>>,
    #[serde(default)]
    pub change: bool,
}

/// Numbers at one pose.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ValueTable {
    #[serde(default)]
    pub at: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    pub errors: BTreeMap<Spanned<String>, Spanned<Value>>,
    pub of: Option<Spanned<String>>,
    pub equals: Spanned<Texts>,
    pub within: Option<Spanned<String>>,
}

/// What a text leaves out because it is small.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NeglectedTable {
    pub errors: Sizes,
    pub at_most: Spanned<Value>,
}

/// The second face, and what is taken of both.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FacesTable {
    pub second: BTreeMap<Spanned<String>, Spanned<String>>,
    pub take: Spanned<String>,
}

/// Errors by name or pattern, with their sizes.
pub type Sizes = Spanned<BTreeMap<Spanned<String>, Spanned<Value>>>;

/// An absolute size.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SizeTable {
    pub errors: Sizes,
    pub measure: Spanned<String>,
    pub combine: Option<Spanned<String>>,
    pub at_most: Option<Spanned<Value>>,
    pub at_least: Option<Spanned<Value>>,
}

/// A bound on what the first order drops.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoundTable {
    pub errors: Sizes,
    pub at_most: Spanned<Value>,
}

/// A comparison.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CompareTable {
    pub error: Spanned<String>,
    pub against: Spanned<String>,
    pub size: Spanned<Value>,
    pub measure: Spanned<String>,
    pub at_most: Spanned<f64>,
}

/// A count, or a rank.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CountTable {
    pub errors: Spanned<Texts>,
    pub equals: Spanned<i64>,
}

/// A text, or a list of texts.
#[derive(Debug, Clone)]
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

impl<'de> Deserialize<'de> for Meant {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct MeantVisitor;

        impl<'de> Visitor<'de> for MeantVisitor {
            type Value = Meant;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a string, or a screw `{ omega = \"[…]\", v = \"[…]\" }`")
            }

            fn visit_str<E>(self, text: &str) -> Result<Meant, E> {
                Ok(Meant::Text(text.to_owned()))
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Meant, A::Error> {
                let (mut omega, mut v) = (None, None);
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "omega" => omega = Some(map.next_value()?),
                        "v" => v = Some(map.next_value()?),
                        other => return Err(A::Error::unknown_field(other, &["omega", "v"])),
                    }
                }
                let omega = omega.ok_or_else(|| A::Error::missing_field("omega"))?;
                Ok(Meant::Screw([omega, v.ok_or_else(|| A::Error::missing_field("v"))?]))
            }
        }

        deserializer.deserialize_any(MeantVisitor)
    }
}
