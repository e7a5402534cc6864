//! The types of the texts of a table that is written as a Parquet file, from reading it once before.

use rayon::prelude::*;
use tables::formats::parquet::TextType;
use tables::formats::{Form, Kept, Wanted};

use super::{Reading, ReadingsTable, Use};
use crate::refusal::Refusal;

/// Bytes of a file up to which its texts are held until the last is known.
const HELD: u64 = 1 << 26;

impl ReadingsTable<'_> {
    /// What the texts of each column are that is kept as it came, from reading the whole file once before, of which `tell` hears: with that, a large
    /// table with types of its own is written as it is read. None where it is no such file, or has types itself.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn text_types(&self, tell: impl Fn(f64)) -> Result<Option<Vec<TextType>>, Refusal> {
        let Some(again) = &self.again else { return Ok(None) };
        if self.extent.as_ref().is_none_or(|extent| extent.length() <= HELD) {
            return Ok(None);
        }
        let (reader, extent) = again()?;
        let is_kept = |wanted: &&Wanted| matches!(wanted.form, Form::Kept);
        let wanted: Vec<Wanted> = self.wanted.iter().filter(is_kept).copied().collect();
        let readings = self.readings.iter();
        let readings = readings.map(|own| Reading {
            symbol: own.symbol,
            column: own.column,
            conversion: own.conversion,
            bare: None,
        });
        let mut scanned = Self {
            reader,
            declared: self.declared.clone(),
            headed: None,
            readings: readings.collect(),
            followed: Vec::new(),
            asked: Vec::new(),
            without_reading: 0,
            started: false,
            extent,
            again: None,
            uses: wanted.iter().map(|_| Use::Kept).collect(),
            wanted,
        };
        let mut types = vec![TextType::default(); scanned.wanted.len()];
        while let Some(rows) = scanned.next_rows()? {
            if let Some(share) = scanned.share_read() {
                tell(share);
            }
            if rows.kept.iter().any(|kept| matches!(kept, Kept::Typed(_))) {
                return Ok(None);
            }
            types.par_iter_mut().zip(&rows.kept).for_each(|(seen, kept)| {
                if let Kept::Texts(texts) = kept {
                    seen.see(texts);
                }
            });
        }
        Ok(Some(types))
    }
}
