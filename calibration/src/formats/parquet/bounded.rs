//! A Parquet file whose pages are looked at before they are decoded: the crate's decoders make room for as many values as a
//! page claims, and a kilobyte can claim gigabytes.

use ::parquet::basic::Encoding;
use ::parquet::bloom_filter::Sbbf;
use ::parquet::column::page::{Page, PageMetadata, PageReader};
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::metadata::{ParquetMetaData, RowGroupMetaData};
use ::parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use ::parquet::record::reader::RowIter;
use ::parquet::schema::types::Type;

use super::ranges::Ranges;

/// Memory that a decoder takes for each byte of a page, at most: a text of no letters has four bytes in a page and
/// thirty-two in memory.
const GROWTH: u64 = 8;

/// A file that refuses pages which claim more than they hold.
pub(super) struct BoundedFile {
    pub inner: SerializedFileReader<Ranges>,
    /// How much memory one column may take.
    pub memory_bytes: u64,
}

impl FileReader for BoundedFile {
    fn metadata(&self) -> &ParquetMetaData {
        self.inner.metadata()
    }

    fn num_row_groups(&self) -> usize {
        self.inner.num_row_groups()
    }

    fn get_row_group(&self, i: usize) -> Result<Box<dyn RowGroupReader + '_>> {
        Ok(Box::new(BoundedGroup { inner: self.inner.get_row_group(i)?, memory_bytes: self.memory_bytes }))
    }

    fn get_row_iter(&self, projection: Option<Type>) -> Result<RowIter<'_>> {
        RowIter::from_file(projection, self)
    }
}

struct BoundedGroup<'a> {
    inner: Box<dyn RowGroupReader + 'a>,
    memory_bytes: u64,
}

impl RowGroupReader for BoundedGroup<'_> {
    fn metadata(&self) -> &RowGroupMetaData {
        self.inner.metadata()
    }

    fn num_columns(&self) -> usize {
        self.inner.num_columns()
    }

    fn get_column_page_reader(&self, i: usize) -> Result<Box<dyn PageReader>> {
        let has_levels = self.metadata().column(i).column_descr().max_def_level() > 0;
        let inner = self.inner.get_column_page_reader(i)?;
        Ok(Box::new(BoundedPages { inner, has_levels, memory_bytes: self.memory_bytes }))
    }

    fn get_column_bloom_filter(&self, i: usize) -> Option<&Sbbf> {
        self.inner.get_column_bloom_filter(i)
    }

    fn get_row_iter(&self, projection: Option<Type>) -> Result<RowIter<'_>> {
        RowIter::from_row_group(projection, self)
    }
}

struct BoundedPages {
    inner: Box<dyn PageReader>,
    /// Whether levels that say which cells are empty come before the values.
    has_levels: bool,
    memory_bytes: u64,
}

impl BoundedPages {
    fn check(&self, page: &Page) -> Result<()> {
        if page.buffer().len() as u64 > self.memory_bytes / GROWTH {
            return Err(ParquetError::General("a page takes more memory than it may".to_owned()));
        }
        let (claimed, held) = match page {
            // Each value of a dictionary stands in it.
            Page::DictionaryPage { buf, num_values, .. } => (u64::from(*num_values), buf.len() as u64),
            Page::DataPage { buf, num_values, encoding, .. } if has_count(*encoding) => {
                let levels = if self.has_levels { length_prefixed(buf) } else { 0 };
                (claimed_lengths(buf, levels), u64::from(*num_values))
            }
            Page::DataPageV2 {
                buf, num_values, encoding, def_levels_byte_len, rep_levels_byte_len, ..
            } if has_count(*encoding) => {
                let levels = *def_levels_byte_len as usize + *rep_levels_byte_len as usize;
                (claimed_lengths(buf, levels), u64::from(*num_values))
            }
            _ => return Ok(()),
        };
        if claimed > held {
            return Err(ParquetError::General("a page claims more values than it holds".to_owned()));
        }
        Ok(())
    }
}

/// Encodings that say themselves how many lengths of texts follow.
fn has_count(encoding: Encoding) -> bool {
    matches!(encoding, Encoding::DELTA_LENGTH_BYTE_ARRAY | Encoding::DELTA_BYTE_ARRAY)
}

/// The bytes of levels that begin with their own length.
fn length_prefixed(page: &[u8]) -> usize {
    let length = page.first_chunk().map_or(0, |length| u32::from_le_bytes(*length));
    4 + length as usize
}

/// How many lengths delta-encoded texts claim: the third of the numbers that they begin with (the size of a block, the parts
/// of a block, the count), each seven bits a byte.
fn claimed_lengths(page: &[u8], levels: usize) -> u64 {
    let mut bytes = page.iter().skip(levels);
    let mut number = || {
        let mut value = 0_u64;
        for shift in (0..64).step_by(7) {
            let byte = *bytes.next()?;
            value |= u64::from(byte & 0x7F) << shift;
            if byte & 0x80 == 0 {
                return Some(value);
            }
        }
        None
    };
    // What has no such numbers is the decoder's to refuse.
    [number(), number(), number()][2].unwrap_or(0)
}

impl Iterator for BoundedPages {
    type Item = Result<Page>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for BoundedPages {
    fn get_next_page(&mut self) -> Result<Option<Page>> {
        let page = self.inner.get_next_page()?;
        page.as_ref().map_or(Ok(()), |page| self.check(page))?;
        Ok(page)
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>> {
        self.inner.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<()> {
        self.inner.skip_next_page()
    }
}
