//! The header of a Parquet page, read before the page is: the crate tells what it says only when the page has been unpacked.
//!
//! A struct of the compact protocol of Thrift. What the crate reads without a look at its type has to be of that type here, so that
//! both read the same.

use std::io::Read;

use ::parquet::errors::{ParquetError, Result};

/// How deep the structs of a header may lie in each other.
const DEPTH: usize = 8;

/// What a page holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    Dictionary,
    Data,
}

/// What a page says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PageHeader {
    pub kind: Kind,
    /// How many values it has, empty cells among them.
    pub values: u32,
    /// Its bytes in the file, and the bytes that they unpack to.
    pub packed: u32,
    pub unpacked: u32,
    /// The bytes of the header itself.
    pub length: u64,
}

impl PageHeader {
    /// Reads one.
    ///
    /// # Errors
    /// It cannot be read, is none, or is of a page that holds no values of a column.
    pub fn read(from: impl Read) -> Result<Self> {
        let mut thrift = Thrift { from, length: 0 };
        // Per field of the header its number, and per struct in it the first of its own.
        let (mut numbers, mut values) = ([None; 4], [None; 9]);
        let mut last = 0;
        while let Some((field, of_type)) = thrift.field(&mut last)? {
            match field {
                1..=4 => numbers[field as usize - 1] = Some(thrift.number_of(of_type)?),
                5 | 7 | 8 => values[field as usize] = thrift.values(field, of_type)?,
                _ => thrift.skip(of_type, DEPTH)?,
            }
        }
        let [kind, unpacked, packed, _] = numbers;
        let (kind, field) = match kind {
            Some(0) => (Kind::Data, 5),
            Some(2) => (Kind::Dictionary, 7),
            Some(3) => (Kind::Data, 8),
            _ => return Err(spoiled()),
        };
        let count = |number: Option<i32>| number.and_then(|number| u32::try_from(number).ok());
        match (count(values[field]), count(packed), count(unpacked)) {
            (Some(values), Some(packed), Some(unpacked)) => {
                Ok(Self { kind, values, packed, unpacked, length: thrift.length })
            }
            _ => Err(spoiled()),
        }
    }
}

fn spoiled() -> ParquetError {
    ParquetError::General("the header of a page is none".to_owned())
}

// Types of fields that are looked at by name.
const TRUE: u8 = 1;
const FALSE: u8 = 2;
const I32: u8 = 5;
const BINARY: u8 = 8;
const STRUCT: u8 = 12;

struct Thrift<R> {
    from: R,
    /// Bytes that were read.
    length: u64,
}

impl<R: Read> Thrift<R> {
    fn byte(&mut self) -> Result<u8> {
        let mut byte = [0];
        self.from.read_exact(&mut byte)?;
        self.length += 1;
        Ok(byte[0])
    }

    /// Seven bits a byte.
    fn whole(&mut self) -> Result<u64> {
        let mut whole = 0;
        for shift in (0..63).step_by(7) {
            let byte = self.byte()?;
            whole |= u64::from(byte & 0x7F) << shift;
            if byte & 0x80 == 0 {
                return Ok(whole);
            }
        }
        Err(spoiled())
    }

    fn number(&mut self) -> Result<i32> {
        let whole = u32::try_from(self.whole()?).map_err(|_| spoiled())?;
        Ok((whole >> 1) as i32 ^ -((whole & 1) as i32))
    }

    fn number_of(&mut self, of_type: u8) -> Result<i32> {
        if of_type == I32 { self.number() } else { Err(spoiled()) }
    }

    /// The next field of a struct and its type; none at the end.
    fn field(&mut self, last: &mut i32) -> Result<Option<(i32, u8)>> {
        let head = self.byte()?;
        if head & 0xF == 0 {
            return Ok(None);
        }
        *last = match head >> 4 {
            0 => self.number()?,
            more => *last + i32::from(more),
        };
        if i16::try_from(*last).is_err() {
            return Err(spoiled());
        }
        Ok(Some((*last, head & 0xF)))
    }

    /// How many values the header of one kind of page says, whose fields are of these types.
    fn values(&mut self, kind: i32, of_type: u8) -> Result<Option<i32>> {
        let (numbers, flag, statistics) = match kind {
            5 => (1..=4, None, Some(5)),
            7 => (1..=2, Some(3), None),
            _ => (1..=6, Some(7), Some(8)),
        };
        if of_type != STRUCT {
            return Err(spoiled());
        }
        let (mut values, mut last) = (None, 0);
        while let Some((field, of_type)) = self.field(&mut last)? {
            if field == 1 {
                values = Some(self.number_of(of_type)?);
                continue;
            }
            let is_known = numbers.contains(&field) && of_type == I32
                || flag == Some(field) && [TRUE, FALSE].contains(&of_type)
                || statistics == Some(field) && of_type == STRUCT;
            let is_other = !numbers.contains(&field) && flag != Some(field) && statistics != Some(field);
            if !is_known && !is_other {
                return Err(spoiled());
            }
            self.skip(of_type, DEPTH)?;
        }
        Ok(values)
    }

    fn skip_bytes(&mut self, count: u64) -> Result<()> {
        let skipped = std::io::copy(&mut self.from.by_ref().take(count), &mut std::io::sink())?;
        self.length += skipped;
        if skipped == count { Ok(()) } else { Err(spoiled()) }
    }

    fn skip(&mut self, of_type: u8, depth: usize) -> Result<()> {
        if depth == 0 {
            return Err(spoiled());
        }
        match of_type {
            TRUE | FALSE => Ok(()),
            3 => self.skip_bytes(1),
            4 | I32 | 6 => self.whole().map(|_| ()),
            7 => self.skip_bytes(8),
            BINARY => {
                let count = self.whole()?;
                self.skip_bytes(count)
            }
            STRUCT => {
                let mut last = 0;
                while let Some((_, of_type)) = self.field(&mut last)? {
                    self.skip(of_type, depth - 1)?;
                }
                Ok(())
            }
            // No field of a header is a list or a map.
            _ => Err(spoiled()),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// As Apache Arrow writes it: a data page of 3 values, 30 bytes, 28 of them packed.
    const DATA: [u8; 17] = [0x15, 0, 0x15, 60, 0x15, 56, 0x2C, 0x15, 6, 0x15, 0, 0x15, 6, 0x15, 6, 0, 0];

    #[test]
    fn a_header_is_read_whole() {
        let read = PageHeader::read([DATA.as_slice(), b"page"].concat().as_slice()).unwrap();
        let header = PageHeader { kind: Kind::Data, values: 3, packed: 28, unpacked: 30, length: 17 };
        assert_eq!(read, header);
    }

    #[test]
    fn what_is_none_is_refused() {
        for end in 0..DATA.len() {
            assert!(PageHeader::read(&DATA[..end]).is_err(), "{end}");
        }
        // Sizes below nothing, a page of an index, a size that is a text, and structs in structs in structs.
        let spoiled = |at: usize, byte: u8| {
            let mut bytes = DATA;
            bytes[at] = byte;
            PageHeader::read(bytes.as_slice())
        };
        for (at, byte) in [(3, 61), (5, 57), (8, 7), (1, 2), (2, 0x18), (9, 0x11), (6, 0x28)] {
            assert!(spoiled(at, byte).is_err(), "{byte} at {at}");
        }
        assert!(PageHeader::read([0xFC].repeat(1 << 20).as_slice()).is_err());
        assert!(PageHeader::read([0x15, 0xFF].repeat(1 << 20).as_slice()).is_err());
    }
}
