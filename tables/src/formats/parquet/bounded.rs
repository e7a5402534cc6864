//! A Parquet file whose pages are judged before they are unpacked and decoded: both make room for as much as a page claims, and a
//! kilobyte can claim gigabytes.

use std::sync::Arc;

use ::parquet::basic::{Compression, Encoding, Type as Physical};
use ::parquet::bloom_filter::Sbbf;
use ::parquet::column::page::{Page, PageMetadata, PageReader};
use ::parquet::data_type::ByteArray;
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::metadata::{ColumnChunkMetaData, ParquetMetaData, RowGroupMetaData};
use ::parquet::file::reader::{ChunkReader as _, FileReader, RowGroupReader, SerializedFileReader};
use ::parquet::file::serialized_reader::SerializedPageReader;
use ::parquet::record::reader::RowIter;
use ::parquet::schema::types::Type;

use super::header::{Kind, PageHeader};
use super::held::{Held, Share};
use super::ranges::Ranges;

/// Memory that a decoder takes for each byte of a page, at most: a text of no letters has four bytes in a page and
/// thirty-two in memory.
const GROWTH: u64 = 8;

/// Bytes that a page may have beyond twice what its values take: levels and blocks of the encodings.
const BESIDE: u64 = 1 << 16;

/// The part of the memory that open columns hold before others are closed behind each chunk.
const CROWDED: u64 = 64;

/// Memory of what unpacks Zstandard, for each open column.
const ZSTD_BYTES: u64 = 1 << 18;

/// A file that refuses pages which claim more than they hold.
pub(super) struct BoundedFile {
    inner: SerializedFileReader<Ranges>,
    ranges: Ranges,
    /// How much memory its pages may take.
    memory_bytes: u64,
    held: Held,
}

impl BoundedFile {
    /// One whose open pages take so much memory at most.
    ///
    /// # Errors
    /// It is none.
    pub fn open(ranges: Ranges, memory_bytes: u64) -> Result<Self> {
        let inner = SerializedFileReader::new(ranges.clone())?;
        Ok(Self { inner, ranges, memory_bytes, held: Held::default() })
    }

    /// Whether its open pages take so much that a column had better be closed; one that is dear to open again, later than others.
    pub fn is_crowded(&self, is_dear: bool) -> bool {
        self.held.bytes() > self.memory_bytes / if is_dear { 2 } else { CROWDED }
    }
}

impl FileReader for BoundedFile {
    fn metadata(&self) -> &ParquetMetaData {
        self.inner.metadata()
    }

    fn num_row_groups(&self) -> usize {
        self.inner.num_row_groups()
    }

    fn get_row_group(&self, i: usize) -> Result<Box<dyn RowGroupReader + '_>> {
        // Not the reader's own group: each makes room for every column of the file, and each column asks for one.
        Ok(Box::new(BoundedGroup { metadata: self.metadata().row_group(i), file: self }))
    }

    fn get_row_iter(&self, projection: Option<Type>) -> Result<RowIter<'_>> {
        RowIter::from_file(projection, self)
    }
}

struct BoundedGroup<'a> {
    metadata: &'a RowGroupMetaData,
    file: &'a BoundedFile,
}

impl RowGroupReader for BoundedGroup<'_> {
    fn metadata(&self) -> &RowGroupMetaData {
        self.metadata
    }

    fn num_columns(&self) -> usize {
        self.metadata.num_columns()
    }

    fn get_column_page_reader(&self, i: usize) -> Result<Box<dyn PageReader>> {
        let column = self.metadata.column(i);
        let name = column.column_path().string();
        let (rows, values) = (self.metadata.num_rows(), column.num_values());
        let Some(values_left) = usize::try_from(values).ok().filter(|_| values == rows) else {
            let what = format!("it has {values} cells in a group of {rows} rows");
            return Err(spoiled(&name, &what));
        };
        let unpacks = if matches!(column.compression(), Compression::ZSTD(_)) { ZSTD_BYTES } else { 0 };
        let (at, left) = column.byte_range();
        let file = Arc::new(self.file.ranges.clone());
        Ok(Box::new(BoundedPages {
            inner: Box::new(SerializedPageReader::new(file, column, values_left, None)?),
            has_levels: column.column_descr().max_def_level() > 0,
            width: width(column),
            of_text: if is_text(column.column_type()) { size_of::<ByteArray>() as u64 } else { 0 },
            values_left: values_left as u64,
            ranges: self.file.ranges.clone(),
            at,
            left,
            memory_bytes: self.file.memory_bytes,
            share: self.file.held.share(unpacks),
            column: name,
        }))
    }

    fn get_column_bloom_filter(&self, _: usize) -> Option<&Sbbf> {
        None
    }

    fn get_row_iter(&self, projection: Option<Type>) -> Result<RowIter<'_>> {
        RowIter::from_row_group(projection, self)
    }
}

fn is_text(of_type: Physical) -> bool {
    matches!(of_type, Physical::BYTE_ARRAY | Physical::FIXED_LEN_BYTE_ARRAY)
}

/// The bytes of one value of a column; none where they are of any length.
fn width(column: &ColumnChunkMetaData) -> Option<u64> {
    Some(match column.column_type() {
        Physical::BOOLEAN => 1,
        Physical::INT32 | Physical::FLOAT => 4,
        Physical::INT64 | Physical::DOUBLE => 8,
        Physical::INT96 => 12,
        Physical::FIXED_LEN_BYTE_ARRAY => u64::try_from(column.column_descr().type_length()).ok()?,
        Physical::BYTE_ARRAY => return None,
    })
}

fn spoiled(column: &str, what: &str) -> ParquetError {
    ParquetError::General(format!("column `{column}` is spoiled ({what}): copy or write the file again"))
}

struct BoundedPages {
    inner: Box<dyn PageReader>,
    /// Whether levels that say which cells are empty come before the values.
    has_levels: bool,
    /// The bytes of a value, where all have the same; and what its place takes beside its bytes once it is unpacked, of a text.
    width: Option<u64>,
    of_text: u64,
    /// Values that are still to come.
    values_left: u64,
    ranges: Ranges,
    /// Where the next page begins, and the bytes of the column from there on.
    at: u64,
    left: u64,
    /// How much memory all open pages may take.
    memory_bytes: u64,
    /// What this column takes.
    share: Share,
    column: String,
}

impl BoundedPages {
    /// Judges the next page by what its header says.
    fn judge(&mut self) -> Result<()> {
        if self.left == 0 {
            return Ok(());
        }
        let header = PageHeader::read(self.ranges.get_read(self.at)?)
            .map_err(|error| spoiled(&self.column, &error.to_string()))?;
        let whole = header.length + u64::from(header.packed);
        let Some(left) = self.left.checked_sub(whole) else {
            return Err(spoiled(&self.column, "a page is longer than its column"));
        };
        (self.at, self.left) = (self.at + whole, left);
        let (values, unpacked) = (u64::from(header.values), u64::from(header.unpacked));
        if unpacked > self.memory_bytes / GROWTH {
            return Err(ParquetError::General(format!(
                "column `{}`: a page unpacks to {} MiB, more than the {} MiB that one may have: write the file again with smaller pages, or \
                 smaller groups of rows",
                self.column,
                unpacked >> 20,
                (self.memory_bytes / GROWTH) >> 20,
            )));
        }
        let claims = |what: &str| Err(spoiled(&self.column, &format!("a page of {values} values {what}")));
        match header.kind {
            // Each value of a dictionary stands in it.
            Kind::Dictionary if values > unpacked => return claims(&format!("unpacks to {unpacked} bytes")),
            Kind::Dictionary => self.share.keep(unpacked + values * self.of_text),
            Kind::Data => {
                let Some(values_left) = self.values_left.checked_sub(values) else {
                    return claims(&format!("comes where {} are to come", self.values_left));
                };
                if self.width.is_some_and(|width| {
                    unpacked > values.saturating_mul(2 * (width + 4)).saturating_add(BESIDE)
                }) {
                    return claims(&format!("unpacks to {unpacked} bytes"));
                }
                self.values_left = values_left;
                self.share.page(unpacked);
            }
        }
        if self.share.of_all() > self.memory_bytes {
            return Err(ParquetError::General(format!(
                "pages of its columns that are read at the same time take more than {} MiB of memory: write the file again with smaller pages, \
                 or smaller groups of rows",
                self.memory_bytes >> 20,
            )));
        }
        Ok(())
    }

    /// Checks what a page says within itself.
    fn check(&self, page: &Page) -> Result<()> {
        let (claimed, held) = match page {
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
            return Err(spoiled(&self.column, &format!("a page of {held} values has {claimed} texts")));
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
        self.judge()?;
        let page = self.inner.get_next_page().map_err(|error| spoiled(&self.column, &error.to_string()))?;
        page.as_ref().map_or(Ok(()), |page| self.check(page))?;
        Ok(page)
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>> {
        self.inner.peek_next_page()
    }

    fn skip_next_page(&mut self) -> Result<()> {
        self.judge()?;
        self.inner.skip_next_page()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::Arc;

    use ::parquet::basic::ZstdLevel;
    use ::parquet::data_type::DoubleType;
    use ::parquet::file::properties::WriterProperties;
    use ::parquet::file::writer::SerializedFileWriter;
    use ::parquet::schema::parser::parse_message_type;

    use super::super::Reader;
    use super::*;
    use crate::formats::{Cells, Chunk, DataError, Form, Options, TableReader as _, Wanted};

    /// Written by `tests/reference/parquet.py`: as `snappy.parquet`, with checksums.
    const CHECKED: &[u8] = include_bytes!("../../../tests/reference/checked.parquet");

    /// So many rows of the first columns.
    fn read(
        file: &[u8],
        memory_bytes: u64,
        (columns, rows): (usize, usize),
    ) -> std::result::Result<Chunk, DataError> {
        let options = Options { memory_bytes, ..Options::default() };
        let wanted: Vec<Wanted> =
            (0..columns).map(|column| Wanted { column, form: Form::Number(1.0) }).collect();
        Reader::new(file.into(), "run.parquet", &options)?.read(&wanted, rows)
    }

    /// So many columns of one page of zeros each.
    fn zeros(columns: usize, rows: usize, compression: Compression) -> Vec<u8> {
        let fields: String = (0..columns).map(|at| format!("required double c{at};")).collect();
        let schema = parse_message_type(&format!("message t {{ {fields} }}")).unwrap();
        let properties = WriterProperties::builder()
            .set_compression(compression)
            .set_dictionary_enabled(false)
            .set_data_page_size_limit(usize::MAX)
            .set_data_page_row_count_limit(usize::MAX)
            .build();
        let mut writer =
            SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties)).unwrap();
        let mut group = writer.next_row_group().unwrap();
        while let Some(mut column) = group.next_column().unwrap() {
            column.typed::<DoubleType>().write_batch(&vec![0.0; rows], None, None).unwrap();
            column.close().unwrap();
        }
        group.close().unwrap();
        writer.into_inner().unwrap()
    }

    #[test]
    fn a_page_is_judged_before_it_is_unpacked() {
        const MIB: u64 = 1 << 20;
        let zstd = Compression::ZSTD(ZstdLevel::default());
        for compression in [zstd, Compression::SNAPPY] {
            let file = zeros(1, 1 << 18, compression);
            assert_eq!(
                read(&file, 8 * MIB, (1, 9)).unwrap_err().to_string(),
                "run.parquet: column `c0`: a page unpacks to 2 MiB, more than the 1 MiB that one may have: write the file again with \
                 smaller pages, or smaller groups of rows"
            );
            assert!(read(&file, 32 * MIB, (1, 9)).is_ok());
        }
        // Each page may be, and not all at the same time.
        let ranges = |file: Vec<u8>| {
            let length = file.len() as u64;
            Ranges::of(Box::new(std::io::Cursor::new(file)), length, 1 << 30)
        };
        let file = BoundedFile::open(ranges(zeros(12, 1 << 18, zstd)), 16 * MIB).unwrap();
        let group = file.get_row_group(0).unwrap();
        let mut open: Vec<_> = (0..12).map(|at| group.get_column_page_reader(at).unwrap()).collect();
        let read: Vec<_> = open.iter_mut().map(|pages| pages.get_next_page()).collect();
        assert!(read[..6].iter().all(Result::is_ok));
        assert_eq!(
            read[11].as_ref().unwrap_err().to_string(),
            "Parquet error: pages of its columns that are read at the same time take more than 16 MiB of memory: write the file again \
             with smaller pages, or smaller groups of rows"
        );
        drop(open);
        assert_eq!(file.held.bytes(), 0);
    }

    /// The places in a file, of one group of one page a column, where a header begins, where its page does, and where that ends.
    fn pages(file: &[u8]) -> Vec<[usize; 3]> {
        let file = BoundedFile::open(
            Ranges::of(Box::new(std::io::Cursor::new(file.to_vec())), file.len() as u64, 1 << 30),
            1 << 30,
        );
        let file = file.unwrap();
        let mut pages = Vec::new();
        for column in file.metadata().row_group(0).columns() {
            let (mut at, length) = column.byte_range();
            let end = at + length;
            while at < end {
                let header = PageHeader::read(file.ranges.get_read(at).unwrap()).unwrap();
                let body = at + header.length;
                pages.push([at, body, body + u64::from(header.packed)].map(|at| at as usize));
                at = body + u64::from(header.packed);
            }
        }
        pages
    }

    #[test]
    fn what_a_checksum_does_not_fit_is_refused() {
        let good = read(CHECKED, 1 << 30, (1, 9)).unwrap();
        assert_eq!(good.columns, [Cells::Numbers(vec![1.5, -4.0, 0.125])]);
        let pages = pages(CHECKED);
        // Those of the other column nobody reads.
        for &[_, start, end] in &pages[..2] {
            for at in start..end {
                let mut file = CHECKED.to_vec();
                file[at] ^= 0x04;
                assert_eq!(
                    read(&file, 1 << 30, (1, 9)).unwrap_err().to_string(),
                    "run.parquet: column `az_deg` is spoiled (Parquet error: Page CRC checksum mismatch): copy or write the file again"
                );
            }
        }
    }

    #[test]
    fn a_header_claims_no_more_than_it_has() {
        let file = zeros(1, 100, Compression::SNAPPY);
        let [[header, body, _]] = pages(&file)[..] else { panic!("one page") };
        let mut refused = 0;
        for at in header..body {
            for bit in 0..8 {
                let mut spoiled = file.clone();
                spoiled[at] ^= 1 << bit;
                match read(&spoiled, 1 << 30, (1, 999)) {
                    Ok(chunk) => assert_eq!(chunk.columns, [Cells::Numbers(vec![0.0; 100])]),
                    Err(_) => refused += 1,
                }
            }
        }
        assert!(refused > 8, "{refused}");
    }
}
