//! Tables of readings that are files.

use std::io;
use std::path::Path;

use model_core::Chain;
use service::readings::ReadingsTable;
#[cfg(feature = "parquet")]
use service::{Refusal, readings::Again};
use study::Joining;
use tables::formats::{self, Options};

use super::{failure, known_format};
use crate::failure::Failure;
use crate::source;

/// Opens a file with the readings of a chain; `-` is standard input. Every column is kept as it came.
///
/// # Errors
/// The file cannot be read.
pub fn open_kept(
    path: &Path,
    chain: &Chain,
    options: Options,
    joining: Option<Joining>,
) -> Result<ReadingsTable<'static>, Failure> {
    Ok(open_readings(path, chain, options, joining)?.keeping_all())
}

/// The same for a file of which nothing but readings is wanted.
///
/// # Errors
/// The file cannot be read.
pub fn open_readings(
    path: &Path,
    chain: &Chain,
    options: Options,
    joining: Option<Joining>,
) -> Result<ReadingsTable<'static>, Failure> {
    known_format(path)?;
    if path == Path::new("-") {
        let reader = formats::open(io::stdin(), "standard input", &options)
            .and_then(|reader| Joining::table(joining.as_ref(), reader))
            .map_err(failure)?;
        return Ok(ReadingsTable::of(reader, chain));
    }
    let input = super::open(path).map_err(|error| source::not_readable(path, &error))?;
    let extent = input.extent();
    let reader = formats::open(input, &path.display().to_string(), &options)
        .and_then(|reader| Joining::table(joining.as_ref(), reader))
        .map_err(failure)?;
    #[cfg(feature = "parquet")]
    let is_file = extent.is_some();
    let table = ReadingsTable::of(reader, chain).of_extent(extent);
    #[cfg(feature = "parquet")]
    let table = if is_file { table.opened_by(again(path, options, joining)) } else { table };
    Ok(table)
}

/// What opens a file again.
#[cfg(feature = "parquet")]
fn again(path: &Path, options: Options, joining: Option<Joining>) -> Box<Again> {
    let path = path.to_owned();
    Box::new(move || {
        let input = super::open(&path)
            .map_err(|error| Refusal::Input(source::not_readable(&path, &error).to_string()))?;
        let extent = input.extent();
        let reader = formats::open(input, &path.display().to_string(), &options)
            .and_then(|reader| Joining::table(joining.as_ref(), reader))
            .map_err(Refusal::of)?;
        Ok((reader, extent))
    })
}
