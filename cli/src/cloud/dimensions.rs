//! The dimensions of a point that readings may stand in: those that the file itself describes (extra bytes), its GPS time and its
//! intensity.
//!
//! Source: LAS Specification 1.4, revision 15, ASPRS (2019), "Extra Bytes", tables 24 and 25.

use model_core::unit::Unit;
use tables::formats::ColumnName;

use super::header::{Header, field};
use super::records::text;

/// The record that describes extra bytes.
pub const EXTRA_BYTES: (&str, u16) = ("LASF_Spec", 4);
/// The name of the dimension that a table is joined by.
pub const TIME: &str = "gps_time";

/// Bytes of the description of one dimension.
const DESCRIPTION: usize = 192;
/// Bits of what a description says: a value that means none, a scale, an offset.
const NONE_BIT: u8 = 1;
const SCALE_BIT: u8 = 1 << 3;
const OFFSET_BIT: u8 = 1 << 4;

/// How a number is written in a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

const KINDS: [Kind; 10] = [
    Kind::U8,
    Kind::I8,
    Kind::U16,
    Kind::I16,
    Kind::U32,
    Kind::I32,
    Kind::U64,
    Kind::I64,
    Kind::F32,
    Kind::F64,
];

impl Kind {
    const fn bytes(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    fn number(self, bytes: &[u8]) -> f64 {
        match self {
            Self::U8 => f64::from(bytes[0]),
            Self::I8 => f64::from(bytes[0].cast_signed()),
            Self::U16 => f64::from(u16::from_le_bytes(field(bytes, 0))),
            Self::I16 => f64::from(i16::from_le_bytes(field(bytes, 0))),
            Self::U32 => f64::from(u32::from_le_bytes(field(bytes, 0))),
            Self::I32 => f64::from(i32::from_le_bytes(field(bytes, 0))),
            Self::U64 => u64::from_le_bytes(field(bytes, 0)) as f64,
            Self::I64 => i64::from_le_bytes(field(bytes, 0)) as f64,
            Self::F32 => f64::from(f32::from_le_bytes(field(bytes, 0))),
            Self::F64 => f64::from_le_bytes(field(bytes, 0)),
        }
    }
}

/// A dimension that numbers can be read of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dimension {
    at: usize,
    kind: Kind,
    scale: f64,
    offset: f64,
    /// The bytes that mean that there is no value.
    none: Option<[u8; 8]>,
}

impl Dimension {
    /// What stands in a point; none where it says that there is no value.
    pub fn value(&self, point: &[u8]) -> Option<f64> {
        let bytes = &point[self.at..self.at + self.kind.bytes()];
        // The value that means none has the dimension's type, widened to eight bytes.
        let is_none = self.none.is_some_and(|none| none.starts_with(bytes));
        (!is_none).then(|| self.kind.number(bytes) * self.scale + self.offset)
    }

    /// By how much a value that stands in a point may differ from what was meant, its type being no finer.
    pub fn step(&self, value: f64) -> f64 {
        match self.kind {
            Kind::F64 => 0.0,
            Kind::F32 => (value - self.offset).abs() * f64::from(f32::EPSILON),
            _ => self.scale.abs(),
        }
    }
}

/// The dimensions of the points of a file, each under its name with its unit as a column of a table has them.
#[derive(Debug, Default, PartialEq)]
pub struct Dimensions {
    /// Their names.
    pub names: Vec<ColumnName>,
    /// Where their numbers stand; or why there are none.
    pub dimensions: Vec<Result<Dimension, String>>,
    /// Bytes of each point that nothing describes.
    pub not_described: usize,
}

impl Dimensions {
    /// The dimensions, by the header and what the file says of its extra bytes.
    ///
    /// # Errors
    /// A description that is none, or more bytes than a point has, in words.
    pub fn of(header: &Header, described: Option<&[u8]>) -> Result<Self, String> {
        let mut all = Self::default();
        let plain = |at, kind| Ok(Dimension { at, kind, scale: 1.0, offset: 0.0, none: None });
        all.push("intensity", plain(12, Kind::U16));
        if let Some(at) = header.time_at() {
            all.push(TIME, plain(at, Kind::F64));
        }
        let mut at = header.extra().start;
        let described = described.unwrap_or_default();
        if !described.len().is_multiple_of(DESCRIPTION) {
            return Err("what it says of its extra dimensions is cut off".to_owned());
        }
        for description in described.chunks_exact(DESCRIPTION) {
            let (dimension, bytes) = dimension(description, at)?;
            at += bytes;
            all.push(&name(description), dimension);
        }
        all.not_described = header.extra().end.checked_sub(at).ok_or_else(|| {
            let (described, extra) = (at - header.extra().start, header.extra().len());
            format!("it describes {described} extra bytes of each point, and a point has {extra}")
        })?;
        Ok(all)
    }

    fn push(&mut self, name: &str, dimension: Result<Dimension, String>) {
        self.names.push(ColumnName::parse(name));
        self.dimensions.push(dimension);
    }
}

/// One dimension, or why no number can be read of it; and how many bytes it has.
fn dimension(description: &[u8], at: usize) -> Result<(Result<Dimension, String>, usize), String> {
    let (code, options) = (description[2], description[3]);
    let has = |bit| options & bit != 0;
    let Some(of_one) = code.checked_sub(1).map(usize::from) else {
        // Bytes without a type, whose count stands in place of the options.
        return Ok((Err("it is bytes without a type".to_owned()), usize::from(options)));
    };
    let (kind, together) = (KINDS[of_one % KINDS.len()], of_one / KINDS.len() + 1);
    if together > 3 {
        return Err(format!(
            "its dimension `{}` has a type {code}, which LAS 1.4 has not",
            name(description)
        ));
    }
    let bytes = together * kind.bytes();
    if together > 1 {
        return Ok((Err(format!("it is {together} numbers together")), bytes));
    }
    let said = |bit, at, unsaid| if has(bit) { f64::from_le_bytes(field(description, at)) } else { unsaid };
    let (scale, offset) = (said(SCALE_BIT, 112, 1.0), said(OFFSET_BIT, 136, 0.0));
    if !(scale.is_finite() && scale != 0.0 && offset.is_finite()) {
        return Ok((Err(format!("its scale is {scale} and its offset {offset}")), bytes));
    }
    let none = has(NONE_BIT).then(|| none(kind, field(description, 40)));
    Ok((Ok(Dimension { at, kind, scale, offset, none }), bytes))
}

/// The bytes of a point that mean none: a description has them as the widest type of their kind.
fn none(kind: Kind, widened: [u8; 8]) -> [u8; 8] {
    match kind {
        Kind::F32 => {
            let mut bytes = [0; 8];
            bytes[..4].copy_from_slice(&(f64::from_le_bytes(widened) as f32).to_le_bytes());
            bytes
        }
        _ => widened,
    }
}

/// The name of a dimension, with the unit that its description says where the name says none.
fn name(description: &[u8]) -> String {
    let (name, more) = (text(&description[4..36]), text(&description[160..192]));
    let column = ColumnName::parse(&name);
    if column.unit().is_some() || name.contains(['[', '(']) {
        return name;
    }
    let in_brackets = || {
        let open = more.rfind(['[', '('])?;
        more[open + 1..].strip_suffix([']', ')'])
    };
    let unit =
        [Some(more.as_str()), in_brackets()].into_iter().flatten().find_map(|unit| Unit::find(unit.trim()));
    match unit {
        Some(unit) => format!("{name} [{}]", unit.name()),
        None => name,
    }
}
