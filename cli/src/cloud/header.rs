//! The public header block of a LAS file: kept as it came, but for the few fields that say where points and records lie and how far
//! the points reach.
//!
//! Source: LAS Specification 1.4, revision 15, ASPRS (2019), tables 3 and 7; bits 6 and 7 of the point format: LASzip.

use std::io::{Read, Seek, SeekFrom};
use std::ops::Range;

/// Bytes of the header before what version 1.3 added.
const SHORTEST: usize = 227;

// Where fields stand, in bytes from the start of the file.
const HEADER_SIZE: usize = 94;
const POINTS_AT: usize = 96;
const RECORDS: usize = 100;
const FORMAT: usize = 104;
const RECORD_LENGTH: usize = 105;
const COUNT_UNTIL_1_3: usize = 107;
const SCALE: usize = 131;
const OFFSET: usize = 155;
/// Largest, then smallest x; the same of y and z.
const BOUNDS: usize = 179;
/// From version 1.3.
const WAVEFORMS_AT: usize = 227;
/// From version 1.4, and the two below.
const EXTENDED_AT: usize = 235;
const EXTENDED: usize = 243;
const COUNT: usize = 247;

/// Bits of the point format that say that points are compressed.
const COMPRESSED: u8 = 0b1000_0000;
const COMPRESSED_BITS: u8 = 0b1100_0000;

/// Bytes of a record of each point format, and where its GPS time stands.
const FORMATS: [(usize, Option<usize>); 11] = [
    (20, None),
    (28, Some(20)),
    (26, None),
    (34, Some(20)),
    (57, Some(20)),
    (63, Some(20)),
    (30, Some(22)),
    (36, Some(22)),
    (38, Some(22)),
    (59, Some(22)),
    (67, Some(22)),
];

/// What the header says, and its bytes.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    bytes: Vec<u8>,
    /// Where the points begin.
    pub points_at: u64,
    /// How many variable-length records there are between the header and the points.
    pub records: u32,
    /// The point format, 0 to 10.
    pub format: u8,
    /// Whether the points are compressed.
    pub is_compressed: bool,
    /// Bytes of a point.
    pub record_length: usize,
    /// How many points there are.
    pub count: u64,
    /// Size of a step of x, y and z.
    pub scale: [f64; 3],
    /// The coordinates that zero steps mean.
    pub offset: [f64; 3],
    /// Where the first extended record lies, and how many there are; none before version 1.4.
    pub extended: Option<(u64, u32)>,
}

impl Header {
    /// Reads the header of a file.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn read(file: &mut (impl Read + Seek)) -> Result<Self, String> {
        let mut bytes = Vec::new();
        let mut read = |bytes: &mut Vec<u8>, count: usize| {
            (&mut *file).take(count as u64).read_to_end(bytes).map_err(|error| error.to_string())
        };
        read(&mut bytes, SHORTEST)?;
        if !bytes.starts_with(b"LASF") {
            return Err("it is no LAS file: one begins with `LASF`".to_owned());
        }
        if bytes.len() < SHORTEST {
            return Err(format!("it ends after {} bytes, within its header: it is cut off", bytes.len()));
        }
        let version = [bytes[24], bytes[25]];
        let least = match version {
            [1, 0..=2] => SHORTEST,
            [1, 3] => 235,
            [1, 4] => 375,
            [major, minor] => {
                return Err(format!("it is LAS {major}.{minor}, and LAS 1.0 to 1.4 are read"));
            }
        };
        let size = usize::from(u16::from_le_bytes(field(&bytes, HEADER_SIZE)));
        if size < least {
            let [major, minor] = version;
            return Err(format!(
                "its header says that it has {size} bytes, and one of LAS {major}.{minor} has {least}"
            ));
        }
        read(&mut bytes, size - SHORTEST)?;
        if bytes.len() < size {
            return Err(format!("it ends after {} bytes, within its header: it is cut off", bytes.len()));
        }
        Self::of(bytes, version)
    }

    fn of(bytes: Vec<u8>, version: [u8; 2]) -> Result<Self, String> {
        let format = bytes[FORMAT] & !COMPRESSED_BITS;
        let record_length = usize::from(u16::from_le_bytes(field(&bytes, RECORD_LENGTH)));
        let Some((least, _)) = FORMATS.get(usize::from(format)) else {
            return Err(format!("its points have format {format}, and formats 0 to 10 are read"));
        };
        if record_length < *least {
            return Err(format!(
                "its header says that a point has {record_length} bytes, and one of format {format} has {least} at least"
            ));
        }
        let number = |at| u32::from_le_bytes(field(&bytes, at));
        let long = |at| u64::from_le_bytes(field(&bytes, at));
        let triple = |at: usize| [0, 1, 2].map(|axis| f64::from_le_bytes(field(&bytes, at + 8 * axis)));
        let (scale, offset) = (triple(SCALE), triple(OFFSET));
        if scale.iter().any(|scale| !(scale.is_finite() && *scale > 0.0)) {
            return Err(format!(
                "its header says {scale:?} for the steps of x, y and z, which must be positive"
            ));
        }
        if offset.iter().any(|offset| !offset.is_finite()) {
            return Err(format!("its header says {offset:?} for the offsets of x, y and z"));
        }
        let before = u64::from(number(COUNT_UNTIL_1_3));
        let is_1_4 = version == [1, 4];
        let count = if is_1_4 { long(COUNT) } else { before };
        if before != 0 && before != count {
            return Err(format!("its header counts {count} points in one place and {before} in another"));
        }
        Ok(Self {
            points_at: u64::from(number(POINTS_AT)),
            records: number(RECORDS),
            format,
            is_compressed: bytes[FORMAT] & COMPRESSED_BITS != 0,
            record_length,
            count,
            scale,
            offset,
            extended: is_1_4.then(|| (long(EXTENDED_AT), number(EXTENDED))),
            bytes,
        })
    }

    /// Its bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Where the bytes stand that belong to no field of the point format.
    pub fn extra(&self) -> Range<usize> {
        FORMATS[usize::from(self.format)].0..self.record_length
    }

    /// Where the GPS time of a point stands, if the format has one.
    pub fn time_at(&self) -> Option<usize> {
        FORMATS[usize::from(self.format)].1
    }

    /// Whether times are seconds since 1980 less 10⁹; otherwise they are seconds of a week.
    pub fn has_standard_time(&self) -> bool {
        self.bytes[6] & 1 != 0
    }

    /// The fields with the place of something behind the points, where the version has them: where, and what they say.
    fn places_behind(&self) -> impl Iterator<Item = (usize, u64)> + '_ {
        let fields = [WAVEFORMS_AT, EXTENDED_AT].into_iter().zip([3_u8, 4]);
        fields
            .filter(|(_, since)| self.bytes[25] >= *since)
            .map(|(at, _)| (at, u64::from_le_bytes(field(&self.bytes, at))))
    }

    /// Says that points are compressed or not, with so many more or fewer records and bytes before them.
    pub fn set_compressed(&mut self, is_compressed: bool, more_records: i8, more_bytes: i64) -> Option<()> {
        self.is_compressed = is_compressed;
        let bits = if is_compressed { COMPRESSED } else { 0 };
        self.bytes[FORMAT] = self.format | bits;
        self.records = self.records.checked_add_signed(more_records.into())?;
        self.points_at = self.points_at.checked_add_signed(more_bytes)?;
        let points_at = u32::try_from(self.points_at).ok()?;
        self.put(RECORDS, &self.records.to_le_bytes());
        self.put(POINTS_AT, &points_at.to_le_bytes());
        Some(())
    }

    /// Moves what lies behind the points, in these bytes, to another place.
    pub fn move_behind(&mut self, from: Range<u64>, to: u64) {
        let lies = |(_, place): &(usize, u64)| *place >= from.start && *place <= from.end;
        let moved: Vec<(usize, u64)> = self.places_behind().filter(lies).collect();
        for (at, place) in moved {
            self.put(at, &(place - from.start + to).to_le_bytes());
        }
    }

    /// Says how far the points reach, smallest and largest of each axis.
    pub fn set_bounds(&mut self, bounds: [[f64; 2]; 3]) {
        for (axis, [smallest, largest]) in bounds.into_iter().enumerate() {
            self.put(BOUNDS + 16 * axis, &largest.to_le_bytes());
            self.put(BOUNDS + 16 * axis + 8, &smallest.to_le_bytes());
        }
    }

    fn put(&mut self, at: usize, bytes: &[u8]) {
        self.bytes[at..at + bytes.len()].copy_from_slice(bytes);
    }
}

/// The bytes of a field.
pub fn field<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    match bytes.get(at..).and_then(|rest| rest.first_chunk()) {
        Some(field) => *field,
        None => unreachable!("fields are read of blocks whose length was looked at"),
    }
}

/// The length of a file.
///
/// # Errors
/// The system's.
pub fn length(file: &mut impl Seek) -> std::io::Result<u64> {
    file.seek(SeekFrom::End(0))
}
