//! Compressed points: where their chunks lie, looked at before any is decompressed, and the chunks decompressed, on all processors.
//!
//! The codec makes room for whatever a spoiled chunk claims, and may panic: what it claims is compared with what there is first,
//! and a panic becomes an error.

use std::cell::Cell;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::panic::{AssertUnwindSafe, catch_unwind};

use laz::laszip::{ChunkTable, ChunkTableEntry, CompressorType};
use laz::{LazItemRecordBuilder, LazItemType, LazVlr};
use rayon::prelude::*;

use super::header::{Header, field};

/// The record that says how points are compressed.
pub const LASZIP: (&str, u16) = (LazVlr::USER_ID, LazVlr::RECORD_ID);

/// Bytes that one chunk may have when it is decompressed.
const LARGEST: u64 = 1 << 30;

thread_local! {
    /// Whether this thread is in the codec.
    static DECODING: Cell<bool> = const { Cell::new(false) };
}

/// Whether a panic of this thread would be one of the codec: it becomes an error, and need not be told.
pub fn is_decoding() -> bool {
    DECODING.get()
}

/// What the codec does with spoiled bytes, panics included.
fn guarded<T, E: std::fmt::Display>(work: impl FnOnce() -> Result<T, E>) -> Result<T, String> {
    DECODING.set(true);
    let done = catch_unwind(AssertUnwindSafe(work));
    DECODING.set(false);
    match done {
        Ok(done) => done.map_err(|error| error.to_string()),
        Err(_) => Err("its bytes mean nothing".to_owned()),
    }
}

/// The compressed points of a file.
pub struct Chunks {
    /// How they are compressed.
    pub how: LazVlr,
    table: Vec<ChunkTableEntry>,
    /// How many of them were read.
    taken: usize,
    /// How many points these had.
    points: u64,
    /// Where the next chunk lies.
    at: u64,
    /// Where the points end, the table of chunks included.
    pub end: u64,
    layers: Option<u64>,
}

impl Chunks {
    /// Finds the chunks of a file, by its record of [`LASZIP`].
    ///
    /// # Errors
    /// A compression that cannot be read, or a table of chunks that is not there or that contradicts the file; in words.
    pub fn of(file: &mut (impl Read + Seek), header: &Header, record: &[u8]) -> Result<Self, String> {
        let how =
            LazVlr::from_buffer(record).map_err(|_| "how its points are compressed is spoiled".to_owned())?;
        let compressor = u16::from_le_bytes(field(record, 0));
        let is_layered = compressor == CompressorType::LayeredChunked as u16;
        if !is_layered && compressor != CompressorType::PointWiseChunked as u16 {
            return Err(format!(
                "its points are compressed as old programs did (way {compressor}); write it again with a current one"
            ));
        }
        let extra = u16::try_from(header.extra().len()).map_err(|error| error.to_string())?;
        let expected = LazItemRecordBuilder::default_for_point_format_id(header.format, extra);
        let expected = expected.map_err(|error| error.to_string())?;
        let types = |items: &[laz::LazItem]| -> Vec<_> {
            items.iter().map(|item| (item.item_type(), item.size())).collect()
        };
        let is_known =
            |item: &laz::LazItem| if is_layered { [3, 4] } else { [1, 2] }.contains(&item.version());
        if types(how.items()) != types(&expected) || !how.items().iter().all(is_known) {
            return Err(format!(
                "its points are compressed as something else than format {} with {extra} extra bytes",
                header.format
            ));
        }
        let layers = |item: &laz::LazItem| match item.item_type() {
            LazItemType::Point14 => 9,
            LazItemType::RGBNIR14 => 2,
            LazItemType::Byte14(bytes) => u64::from(bytes),
            _ => 1,
        };
        let layers = is_layered.then(|| how.items().iter().map(layers).sum());
        let (table, end) = if header.count == 0 {
            (Vec::new(), end_of_none(file, header)?)
        } else {
            table(file, header, &how)?
        };
        Ok(Self { table, taken: 0, points: 0, at: header.points_at + 8, end, layers, how })
    }

    /// The next chunks, decompressed: as many as have so many points and bytes together at most, or one; with the points of
    /// each. None at the end.
    ///
    /// # Errors
    /// A chunk that cannot be read, in words.
    pub fn next(
        &mut self,
        file: &mut (impl Read + Seek),
        record_length: usize,
        points: u64,
        bytes: u64,
    ) -> Result<(Vec<u8>, Vec<usize>), String> {
        let long = record_length as u64;
        let mut sum = 0;
        let fits = |entry: &&ChunkTableEntry| {
            let is_first = sum == 0;
            sum += entry.point_count;
            is_first || sum <= points && sum * long <= bytes
        };
        let chunks: Vec<ChunkTableEntry> =
            self.table[self.taken..].iter().take_while(fits).copied().collect();
        file.seek(SeekFrom::Start(self.at)).map_err(|error| error.to_string())?;
        let mut compressed = Vec::with_capacity(chunks.len());
        for chunk in &chunks {
            let mut content = Vec::new();
            (&mut *file)
                .take(chunk.byte_count)
                .read_to_end(&mut content)
                .map_err(|error| error.to_string())?;
            compressed.push(content);
        }
        let counts: Vec<usize> = chunks
            .iter()
            .map(|chunk| usize::try_from(chunk.point_count).map_err(|error| error.to_string()))
            .collect::<Result<_, _>>()?;
        let mut out = vec![0; counts.iter().sum::<usize>() * record_length];
        let mut parts = Vec::with_capacity(chunks.len());
        let (mut rest, mut first) = (out.as_mut_slice(), self.points + 1);
        for ((content, count), chunk) in compressed.iter().zip(&counts).zip(&chunks) {
            let (part, more) = rest.split_at_mut(count * record_length);
            parts.push((first, content, chunk, part));
            first += chunk.point_count;
            rest = more;
        }
        let decode = |(first, content, chunk, part): (u64, &Vec<u8>, &ChunkTableEntry, &mut [u8])| {
            let decoded = self.looked_at(content, chunk, long).and_then(|()| {
                guarded(|| laz::par_decompress(content, part, &self.how, std::slice::from_ref(chunk)))
            });
            let last = first + chunk.point_count - 1;
            decoded.map_err(|why| {
                format!("points {first} to {last} cannot be decompressed, the file is spoiled: {why}")
            })
        };
        // Of several, the first chunk that cannot be read is told, whoever came to it first.
        let decoded: Vec<Result<(), String>> = parts.into_par_iter().map(decode).collect();
        decoded.into_iter().collect::<Result<(), String>>()?;
        self.points = first - 1;
        self.taken += chunks.len();
        self.at += chunks.iter().map(|chunk| chunk.byte_count).sum::<u64>();
        Ok((out, counts))
    }

    /// Refuses a chunk of layers that says another count of points, or lengths of layers that are not its own.
    fn looked_at(&self, content: &[u8], chunk: &ChunkTableEntry, record_length: u64) -> Result<(), String> {
        let Some(layers) = self.layers.filter(|_| chunk.point_count > 0) else { return Ok(()) };
        let number = |at: u64| -> Option<u64> {
            let bytes = content.get(usize::try_from(at).ok()?..)?.first_chunk()?;
            Some(u64::from(u32::from_le_bytes(*bytes)))
        };
        if number(record_length) != Some(chunk.point_count) {
            return Err("a chunk counts other points than the table of chunks".to_owned());
        }
        let lengths = (0..layers).map(|layer| number(record_length + 4 + 4 * layer));
        let Some(sum) = lengths.sum::<Option<u64>>() else {
            return Err("a chunk ends within the lengths of its layers".to_owned());
        };
        if record_length + 4 + 4 * layers + sum != content.len() as u64 {
            return Err("the layers of a chunk are longer or shorter than the chunk".to_owned());
        }
        Ok(())
    }
}

/// Where no points, compressed, end: programs differ in what they write for them, and nobody needs it.
fn end_of_none(file: &mut impl Seek, header: &Header) -> Result<u64, String> {
    let end = super::header::length(file).map_err(|error| error.to_string())?;
    Ok(match header.extended {
        Some((at, 1..)) => at.clamp(header.points_at, end),
        _ => end,
    })
}

/// The table of chunks, and where it ends.
fn table(
    file: &mut (impl Read + Seek),
    header: &Header,
    how: &LazVlr,
) -> Result<(Vec<ChunkTableEntry>, u64), String> {
    let unreadable = |error: io::Error| error.to_string();
    let cut_off = || "the table of its chunks is not there: it is cut off, or was never finished".to_owned();
    let end = super::header::length(file).map_err(unreadable)?;
    let mut file = BufReader::new(file);
    let mut number_at = |at: SeekFrom| -> Result<u64, String> {
        let mut number = [0; 8];
        file.seek(at).and_then(|_| file.read_exact(&mut number)).map_err(|_| cut_off())?;
        Ok(u64::from_le_bytes(number))
    };
    let first = header.points_at + 8;
    let is_place = |place: u64| place >= first && place.checked_add(8).is_some_and(|behind| behind <= end);
    let mut at = number_at(SeekFrom::Start(header.points_at))?;
    if !is_place(at) {
        // Who could not go back wrote it at the end.
        at = number_at(SeekFrom::End(-8))?;
    }
    if !is_place(at) {
        return Err(cut_off());
    }
    let spoiled = |why: &str| format!("the table of its chunks is spoiled: {why}");
    let chunks = number_at(SeekFrom::Start(at))? >> 32;
    let size = u64::from(how.chunk_size());
    let is_right = if how.uses_variable_size_chunks() {
        chunks <= header.count
    } else {
        chunks == header.count.div_ceil(size)
    };
    // Each chunk begins with a point as it is; room is made for as many chunks as are claimed.
    if !is_right || chunks > (at - first) / header.record_length as u64 {
        return Err(spoiled(&format!("it has {chunks} chunks, and the file {} points", header.count)));
    }
    file.seek(SeekFrom::Start(at)).map_err(unreadable)?;
    let read = guarded(|| ChunkTable::read(&mut file, how.uses_variable_size_chunks()));
    let mut table: Vec<ChunkTableEntry> = read.map_err(|why| spoiled(&why))?.as_ref().to_vec();
    let table_end = file.stream_position().map_err(unreadable)?;
    if !how.uses_variable_size_chunks() {
        let mut left = header.count;
        for entry in &mut table {
            entry.point_count = left.min(size);
            left -= entry.point_count;
        }
    }
    let sum = |of: fn(&ChunkTableEntry) -> u64| table.iter().map(of).try_fold(0, u64::checked_add);
    if sum(|entry| entry.point_count) != Some(header.count) {
        return Err(spoiled("its chunks have other points than the file"));
    }
    if sum(|entry| entry.byte_count) != Some(at - first) {
        return Err(spoiled("its chunks have other bytes than the file"));
    }
    let is_large = |entry: &&ChunkTableEntry| {
        let long = entry.point_count.checked_mul(header.record_length as u64);
        long.is_none_or(|long| long > LARGEST) || entry.byte_count > LARGEST
    };
    if let Some(entry) = table.iter().find(is_large) {
        let count = entry.point_count;
        return Err(format!(
            "{count} points are compressed in one piece, more than is held at once: write the file again in chunks"
        ));
    }
    Ok((table, table_end))
}
