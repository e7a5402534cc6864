//! `apply` on a trajectory: positions and attitudes as the calibration has them, every other number kept.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use service::Instrument;
use service::trajectory::Mounted;
use tables::formats::sbet::{encoded, is_one, records};
use tables::formats::{Options, TableReader};

use crate::failure::Failure;
use crate::output;
use crate::table_files::{failure, open_table};

/// Records that are read at a time.
const CHUNK: usize = 1 << 14;
/// What is read back is told in thousandths of a millimetre and of an arc second.
const ARCSEC: f64 = PI / 180.0 / 3600.0;
/// A length for each radian on the Earth, m.
const RADIUS_M: f64 = 6.4e6;

/// Whether a file is a trajectory to correct. What gives its bytes once, a pipe, is left to who reads it as a table.
pub fn is_one_of(path: &Path) -> bool {
    path != Path::new("-")
        && path.is_file()
        && open_table(path, &Options::default()).is_ok_and(|reader| is_one(&*reader))
}

/// Corrects a trajectory; what was done, and how far what was written is from it, in words.
///
/// # Errors
/// It cannot be read or written; the instrument joins no rows with a trajectory.
pub fn correct(instrument: &Instrument, data: &Path, out: &Path) -> Result<String, Failure> {
    let mounted = Mounted::of(instrument)?;
    let open = |path: &Path| open_table(path, &Options::default()).map_err(failure);
    let next = |reader: &mut dyn TableReader| records(reader, CHUNK).map_err(failure);
    let mut reader = open(data)?;
    let mut count = 0_u64;
    output::write_with(out, |writer| {
        loop {
            let read = next(&mut *reader)?;
            for record in &read {
                let bytes = encoded(&mounted.corrected(record));
                writer.write_all(&bytes).map_err(|error| Failure::write(out, &error))?;
            }
            count += read.len() as u64;
            if read.is_empty() {
                return Ok(());
            }
        }
    })?;
    let said = format!("{count} records. {}\n{}\n", mounted.said(), mounted.left);
    // A pipe or a device gives nothing back.
    if !out.is_file() {
        return Ok(said);
    }
    let (mut before, mut after) = (open(data)?, open(out)?);
    let (mut most_m, mut most_rad) = (0.0_f64, 0.0_f64);
    loop {
        let (given, written) = (next(&mut *before)?, next(&mut *after)?);
        for (given, written) in given.iter().zip(&written) {
            let wanted = mounted.corrected(given);
            let off = |at: usize| written[at] - wanted[at];
            let turned = |at: usize| (off(at) + PI).rem_euclid(TAU) - PI;
            most_m = [off(1) * RADIUS_M, off(2) * RADIUS_M, off(3)]
                .into_iter()
                .fold(most_m, |most, off| most.max(off.abs()));
            most_rad = [7, 8, 9].into_iter().fold(most_rad, |most, at| most.max(turned(at).abs()));
        }
        if given.is_empty() {
            break;
        }
    }
    Ok(format!(
        "{said}The file was read back. It differs from the corrected trajectory by {:.3} mm and {:.3}\u{2033} at most.\n",
        1e3 * most_m,
        most_rad / ARCSEC
    ))
}
