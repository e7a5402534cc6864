//! A point cloud that is written: every byte as it came, but for coordinates, bounds and, where points are compressed or no longer
//! are, what says so.

use std::fs::File;
use std::io::{self, BufWriter, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::Path;

use laz::{LasZipError, LazVlr, LazVlrBuilder, ParLasZipCompressor};

use super::chunks::LASZIP;
use super::header::Header;
use super::points::{Cloud, Points};
use super::records::Record;
use crate::failure::Failure;

/// What takes the points.
enum Form<'f> {
    Plain(&'f mut BufWriter<File>),
    Compressed(ParLasZipCompressor<&'f mut BufWriter<File>>),
}

/// A point cloud that is being written.
pub struct Writer<'f> {
    path: &'f Path,
    header: Header,
    form: Form<'f>,
}

impl<'f> Writer<'f> {
    /// Writes what stands before the points of a cloud.
    ///
    /// # Errors
    /// The cloud cannot be read, or the place not written.
    pub fn start(
        path: &'f Path,
        file: &'f mut BufWriter<File>,
        cloud: &mut Cloud,
        compressed: bool,
    ) -> Result<Self, Failure> {
        let mut header = cloud.header.clone();
        let header_end = header.bytes().len() as u64;
        let mut records = Vec::new();
        let read = cloud.part(header_end..header.points_at)?.read_to_end(&mut records);
        read.map_err(|error| cloud.wrong(error))?;
        let how = match (&cloud.chunks, compressed) {
            (Some(chunks), true) => Some(chunks.how.clone()),
            (None, true) => Some(how(&header).map_err(|error| cloud.wrong(error))?),
            (_, false) => None,
        };
        let too_large = || cloud.wrong("there is no room for more records before its points");
        let is_compressed = header.is_compressed;
        if is_compressed != compressed
            && let Some(record) = &cloud.laszip
        {
            if !is_compressed {
                return Err(cloud.wrong(
                    "a record says how its points are compressed, and they are not: take the record away, or write a .las file",
                ));
            }
            let inside = |at: u64| usize::try_from(at - header_end).map_err(|_| too_large());
            let place = inside(record.place.start)?..inside(record.place.end)?;
            let length = i64::try_from(place.len()).map_err(|_| too_large())?;
            records.drain(place);
            header.set_compressed(false, -1, -length).ok_or_else(too_large)?;
        }
        if let Some(how) = how.as_ref().filter(|_| !is_compressed) {
            let mut content = Vec::new();
            how.write_to(&mut content).map_err(|error| Failure::write(path, &error))?;
            let record =
                Record::written(LASZIP.0, LASZIP.1, LazVlr::DESCRIPTION, &content).ok_or_else(too_large)?;
            let length = i64::try_from(record.len()).map_err(|_| too_large())?;
            let at = usize::try_from(cloud.records_end - header_end).map_err(|_| too_large())?;
            records.splice(at..at, record);
            header.set_compressed(true, 1, length).ok_or_else(too_large)?;
        }
        let written = file.write_all(header.bytes()).and_then(|()| file.write_all(&records));
        written.map_err(|error| Failure::write(path, &error))?;
        let form = match how {
            None => Form::Plain(file),
            Some(how) => {
                let mut compressor =
                    ParLasZipCompressor::new(file, how).map_err(|error| failed(path, error))?;
                let reserved = compressor.reserve_offset_to_chunk_table();
                reserved.map_err(|error| Failure::write(path, &error))?;
                Form::Compressed(compressor)
            }
        };
        Ok(Self { path, header, form })
    }

    /// Writes some points.
    ///
    /// # Errors
    /// The place cannot be written.
    pub fn points(&mut self, points: &Points) -> Result<(), Failure> {
        let written = match &mut self.form {
            Form::Plain(file) => file.write_all(&points.bytes),
            Form::Compressed(compressor) if compressor.vlr().uses_variable_size_chunks() => {
                let mut rest = points.bytes.as_slice();
                let mut chunks = Vec::with_capacity(points.counts.len());
                for count in &points.counts {
                    let (chunk, more) = rest.split_at(count * self.header.record_length);
                    chunks.push(chunk);
                    rest = more;
                }
                compressor.compress_chunks(chunks)
            }
            Form::Compressed(compressor) => compressor.compress_many(&points.bytes),
        };
        written.map_err(|error| Failure::write(self.path, &error))
    }

    /// Writes what stands behind the points, and the header with how far they reach, if there are any.
    ///
    /// # Errors
    /// The cloud cannot be read, or the place not written.
    pub fn finish(self, cloud: &mut Cloud, bounds: Option<[[f64; 2]; 3]>) -> Result<(), Failure> {
        let Self { path, mut header, form } = self;
        let file = match form {
            Form::Plain(file) => file,
            Form::Compressed(mut compressor) => {
                compressor.done().map_err(|error| failed(path, error))?;
                compressor.into_inner()
            }
        };
        let write = |error: io::Error| Failure::write(path, &error);
        let at = file.stream_position().map_err(write)?;
        let behind = cloud.behind.clone();
        io::copy(&mut cloud.part(behind.clone())?, file).map_err(write)?;
        header.move_behind(behind, at);
        if let Some(bounds) = bounds {
            header.set_bounds(bounds);
        }
        file.seek(SeekFrom::Start(0)).and_then(|_| file.write_all(header.bytes())).map_err(write)
    }
}

/// How points are compressed that were not.
fn how(header: &Header) -> Result<LazVlr, LasZipError> {
    let extra = u16::try_from(header.extra().len()).map_err(io::Error::other)?;
    let how = LazVlrBuilder::default().with_point_format(header.format, extra)?.build();
    let mut record = Vec::new();
    how.write_to(&mut record)?;
    // LASzip opens wave packets of version 1 alone; the library says version 2 of the same bytes.
    for item in record.get_mut(ITEMS_AT..).unwrap_or_default().chunks_exact_mut(ITEM) {
        if item.starts_with(&WAVE_PACKET_13.to_le_bytes()) {
            item[4..].copy_from_slice(&1_u16.to_le_bytes());
        }
    }
    LazVlr::from_buffer(record)
}

/// Where the items of LASzip's record begin, and the bytes of one: type, size and version.
///
/// Source: LASzip, `laszip.cpp`, `LASzip::pack` and `LASzip::check_item`.
const ITEMS_AT: usize = 34;
const ITEM: usize = 6;
/// The type of wave packets of the formats 4 and 5.
const WAVE_PACKET_13: u16 = 9;

fn failed(path: &Path, error: LasZipError) -> Failure {
    match error {
        LasZipError::IoError(error) => Failure::write(path, &error),
        other => Failure::write(path, &io::Error::other(other.to_string())),
    }
}
