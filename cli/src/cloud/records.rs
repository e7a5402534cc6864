//! The variable-length records of a LAS file, before the points and behind them.

use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;

use super::header::{Header, field, length};

/// Bytes before the content of a record.
const HEAD: usize = 54;
/// The same of an extended record.
const EXTENDED_HEAD: u64 = 60;

/// A record.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Record {
    /// Who says what its content means.
    pub user: String,
    /// Which of that user's records it is.
    pub id: u16,
    /// Where it lies in the file, its head included.
    pub place: Range<u64>,
    /// Where its content lies in the file.
    pub content: Range<u64>,
}

impl Record {
    /// Whether it is this one of this user.
    pub fn is(&self, user: &str, id: u16) -> bool {
        self.user == user && self.id == id
    }

    /// Its content.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(&self, file: &mut (impl Read + Seek)) -> io::Result<Vec<u8>> {
        file.seek(SeekFrom::Start(self.content.start))?;
        let mut content = Vec::new();
        file.take(self.content.end - self.content.start).read_to_end(&mut content)?;
        Ok(content)
    }

    /// A record as it stands in a file.
    pub fn written(user: &str, id: u16, description: &str, content: &[u8]) -> Option<Vec<u8>> {
        let length = u16::try_from(content.len()).ok()?;
        let padded = |text: &str, length| text.bytes().chain(std::iter::repeat(0)).take(length).collect();
        let (user, description): (Vec<u8>, Vec<u8>) = (padded(user, 16), padded(description, 32));
        Some([&[0, 0], &user[..], &id.to_le_bytes(), &length.to_le_bytes(), &description, content].concat())
    }
}

/// Every record of a file, those before the points first; and where those end.
///
/// # Errors
/// A record that goes beyond the points or the file, in words.
pub fn records(file: &mut (impl Read + Seek), header: &Header) -> Result<(Vec<Record>, u64), String> {
    let unreadable = |error: io::Error| error.to_string();
    let end = length(file).map_err(unreadable)?;
    let mut at = header.bytes().len() as u64;
    if header.points_at < at || header.points_at > end {
        return Err(format!(
            "its header says that points begin at byte {}, and the file has {end}: it is spoiled, or cut off",
            header.points_at
        ));
    }
    file.seek(SeekFrom::Start(at)).map_err(unreadable)?;
    let mut found = Vec::new();
    for number in 1..=header.records {
        let beyond = || format!("its record {number} goes beyond the start of the points: it is spoiled");
        let mut head = [0; HEAD];
        if header.points_at - at < HEAD as u64 {
            return Err(beyond());
        }
        file.read_exact(&mut head).map_err(unreadable)?;
        let content = at + HEAD as u64;
        let next = content + u64::from(u16::from_le_bytes(field(&head, 20)));
        if next > header.points_at {
            return Err(beyond());
        }
        found.push(record(&head, at..next, content));
        file.seek(SeekFrom::Start(next)).map_err(unreadable)?;
        at = next;
    }
    let last = at;
    let (mut at, extended) = header.extended.unwrap_or_default();
    for number in 1..=extended {
        let beyond =
            || format!("its extended record {number} goes beyond its end: it is spoiled, or cut off");
        let content = at.checked_add(EXTENDED_HEAD).filter(|content| *content <= end).ok_or_else(beyond)?;
        let mut head = [0; EXTENDED_HEAD as usize];
        file.seek(SeekFrom::Start(at)).and_then(|_| file.read_exact(&mut head)).map_err(unreadable)?;
        let length = u64::from_le_bytes(field(&head, 20));
        let next = content.checked_add(length).filter(|next| *next <= end).ok_or_else(beyond)?;
        found.push(record(&head, at..next, content));
        at = next;
    }
    Ok((found, last))
}

fn record(head: &[u8], place: Range<u64>, content: u64) -> Record {
    let id = u16::from_le_bytes(field(head, 18));
    let content = content..place.end;
    Record { user: text(&head[2..18]), id, place, content }
}

/// A text that ends with its field, or with a zero before that.
pub fn text(field: &[u8]) -> String {
    let end = field.iter().position(|byte| *byte == 0).unwrap_or(field.len());
    String::from_utf8_lossy(&field[..end]).trim().to_owned()
}
