//! A point cloud that is read: what stands before its points and behind them, and the points, some at a time, as they lie in an
//! uncompressed file.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::chunks::{Chunks, LASZIP};
use super::dimensions::{Dimensions, EXTRA_BYTES};
use super::header::{Header, length};
use super::records::{Record, records};
use crate::failure::Failure;
use crate::{source, terminal};

/// Points that are read, computed and written at a time.
const POINTS: u64 = 1 << 19;
/// Bytes that these have at most, where one chunk has no more.
const BYTES: u64 = 1 << 26;

/// The record of a file whose index says where in it each point lies.
const COPC: (&str, u16) = ("copc", 1);
/// The record of an index that says which points lie in which square.
const LAX: (&str, u16) = ("LAStools", 30);

/// A point cloud.
pub struct Cloud {
    path: PathBuf,
    file: File,
    /// What its header says.
    pub header: Header,
    /// The dimensions of its points.
    pub dimensions: Dimensions,
    /// Where the last record before the points ends.
    pub records_end: u64,
    /// The record that says how points are compressed.
    pub laszip: Option<Record>,
    /// The chunks, where points are compressed.
    pub chunks: Option<Chunks>,
    /// The bytes behind the points.
    pub behind: Range<u64>,
    /// How many points were read.
    taken: u64,
}

/// Some points of a cloud.
pub struct Points {
    /// The number of the first, from 1.
    pub first: u64,
    /// The points, one behind the other.
    pub bytes: Vec<u8>,
    /// How many of them lie in each chunk.
    pub counts: Vec<usize>,
}

impl Cloud {
    /// Opens a file.
    ///
    /// # Errors
    /// It cannot be read, is no point cloud, is cut off or spoiled, or has an index that no correction could leave right.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let mut file = File::open(path).map_err(|error| source::not_readable(path, &error))?;
        let metadata = file.metadata().map_err(|error| Failure::read(path, &error))?;
        if metadata.is_dir() {
            return Err(Failure::read(path, &io::ErrorKind::IsADirectory.into()));
        }
        if !metadata.is_file() {
            let why = "a point cloud is read from a file: write it into one first".to_owned();
            return Err(Failure::Read { path: path.to_owned(), why });
        }
        let wrong = |why: String| Failure::Input(format!("{}: {why}", path.display()));
        let header = Header::read(&mut file).map_err(wrong)?;
        let (records, records_end) = records(&mut file, &header).map_err(wrong)?;
        let find = |(user, id): (&str, u16)| records.iter().find(|record| record.is(user, id));
        if find(COPC).is_some() {
            return Err(wrong(
                "it is a COPC file, whose index says where each point lies, and points are about to move: write it as a plain \
                 LAZ file first"
                    .to_owned(),
            ));
        }
        let mut content = |record: &Record| record.read(&mut file).map_err(|error| wrong(error.to_string()));
        let described = find(EXTRA_BYTES).map(&mut content).transpose()?;
        let dimensions = Dimensions::of(&header, described.as_deref()).map_err(wrong)?;
        let before_points = records.iter().filter(|record| record.place.end <= header.points_at);
        let laszip = before_points.clone().find(|record| record.is(LASZIP.0, LASZIP.1)).cloned();
        let how = laszip.as_ref().map(&mut content).transpose()?;
        let end = length(&mut file).map_err(|error| Failure::read(path, &error))?;
        let (chunks, points_end) = match (header.is_compressed, how) {
            (true, None) => {
                return Err(wrong(
                    "its points are compressed, and no record says how: it is spoiled".to_owned(),
                ));
            }
            (true, Some(how)) => {
                let chunks = Chunks::of(&mut file, &header, &how).map_err(wrong)?;
                let points_end = chunks.end;
                (Some(chunks), points_end)
            }
            (false, _) => {
                let points_end = header
                    .count
                    .checked_mul(header.record_length as u64)
                    .and_then(|bytes| bytes.checked_add(header.points_at))
                    .filter(|points_end| *points_end <= end);
                let there = (end - header.points_at) / header.record_length as u64;
                let Some(points_end) = points_end else {
                    return Err(wrong(format!(
                        "its header counts {} points, and it ends after {there}: it is cut off",
                        header.count
                    )));
                };
                (None, points_end)
            }
        };
        if let Some((at, 1..)) = header.extended
            && at < points_end
        {
            return Err(wrong("its extended records begin before its points end: it is spoiled".to_owned()));
        }
        if find(LAX).is_some() {
            terminal::warn(format_args!(
                "{}: its index (LAStools, record 30) stays as it is and says where points were: index the new file again",
                path.display()
            ));
        }
        let behind = points_end..end;
        let path = path.to_owned();
        Ok(Self { path, file, header, dimensions, records_end, laszip, chunks, behind, taken: 0 })
    }

    /// Its name, for messages.
    pub fn name(&self) -> String {
        self.path.display().to_string()
    }

    /// What is wrong with it.
    pub fn wrong(&self, why: impl std::fmt::Display) -> Failure {
        Failure::Input(format!("{}: {why}", self.path.display()))
    }

    /// The bytes of a part of the file.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn part(&mut self, part: Range<u64>) -> Result<impl Read + '_, Failure> {
        self.file.seek(SeekFrom::Start(part.start)).map_err(|error| Failure::read(&self.path, &error))?;
        Ok((&mut self.file).take(part.end - part.start))
    }

    /// The share of the points that was read.
    pub fn share_read(&self) -> f64 {
        self.taken as f64 / self.header.count.max(1) as f64
    }

    /// The next points; none at the end.
    ///
    /// # Errors
    /// They cannot be read.
    pub fn next(&mut self) -> Result<Option<Points>, Failure> {
        if self.taken == self.header.count {
            return Ok(None);
        }
        let long = self.header.record_length;
        let first = self.taken + 1;
        let (bytes, counts) = match &mut self.chunks {
            Some(chunks) => chunks
                .next(&mut self.file, long, POINTS, BYTES)
                .map_err(|why| Failure::Input(format!("{}: {why}", self.path.display())))?,
            None => {
                let long = long as u64;
                let count = POINTS.min(BYTES / long).min(self.header.count - self.taken);
                let at = self.header.points_at + self.taken * long;
                let mut bytes = Vec::new();
                let read = self.part(at..at + count * long)?.read_to_end(&mut bytes);
                let read = read.map_err(|error| Failure::read(&self.path, &error))?;
                if read as u64 != count * long {
                    return Err(self.wrong("it was cut off while it was read"));
                }
                let counts = vec![bytes.len() / self.header.record_length];
                (bytes, counts)
            }
        };
        self.taken += counts.iter().sum::<usize>() as u64;
        Ok(Some(Points { first, bytes, counts }))
    }
}
