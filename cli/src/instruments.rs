//! Instrument files as values, for a program that has no command line: read, checked by rows in memory, compared.

use service::compare::{self, File};
use service::verify::{self, Asked};
use tables::formats::memory::{Column, Reader};
use tables::formats::{DataError, Options, TableReader};

use crate::failure::Failure;
use crate::told::{Told, plain};
use crate::{date, source, terminal};
use service::{Calibrated, Instrument, Source};

/// Reads an instrument file; warns of what is doubtful of it, and where its date is over.
///
/// # Errors
/// Another kind of file, and the mistakes of the file, each with its place.
pub fn instrument(file: &Source) -> Result<Instrument, Failure> {
    let instrument = source::instrument_of(file)?;
    instrument.expired(&date::today()).iter().for_each(terminal::warn);
    Ok(instrument)
}

/// The text of the instrument file of a calibration, if a usable model came out.
#[must_use]
pub fn instrument_toml(calibrated: &Calibrated) -> Option<String> {
    calibrated.instrument(None)
}

/// The values of its errors, and of constants that were fitted, in SI with their units.
#[must_use]
pub fn values_of(instrument: &Instrument) -> Vec<(String, f64, &'static str)> {
    let told = |&(id, value): &(model_core::SymbolId, f64)| {
        let symbol = instrument.chain.symbol(id);
        (symbol.name.clone(), value, symbol.quantity.unit())
    };
    instrument.named.iter().map(told).collect()
}

/// The ranges of the readings that it was found over, SI.
#[must_use]
pub fn ranges_of(instrument: &Instrument) -> Vec<(String, f64, f64)> {
    let name = |id| instrument.chain.symbol(id).name.clone();
    instrument.found.iter().map(|range| (name(range.symbol), range.low, range.high)).collect()
}

/// Whether it is still valid, by rows under the headings of its study; as `verify`.
///
/// # Errors
/// As the command says.
pub fn verified(
    instrument: &Instrument,
    (name, columns): (&str, &[(&str, Column<'_>)]),
    goal: Option<&str>,
    false_alarm: Option<f64>,
) -> Result<Told, Failure> {
    let asked = Asked { goal, false_alarm: false_alarm.unwrap_or(verify::FALSE_ALARM) };
    let mut open = |_: &str, _: &Options| -> Result<Box<dyn TableReader + '_>, DataError> {
        Ok(Box::new(Reader::new(name, columns.iter().copied())?))
    };
    let verified = verify::verify(instrument, name, &mut open, &asked, &terminal::warn)?;
    Ok(Told { text: plain(&verify::as_text(&verified)), json: verify::as_json(&verified) })
}

/// What changed from the first of some calibrations to the last; as `compare`.
///
/// # Errors
/// As the command says.
pub fn compared(files: &[(String, &Instrument)]) -> Result<Told, Failure> {
    let files = files.iter().map(|(name, instrument)| File {
        name: name.clone(),
        instrument,
        date: instrument.made.clone(),
    });
    let comparison = compare::compare(&files.collect::<Vec<_>>())?;
    Ok(Told { text: plain(&compare::as_text(&comparison)), json: compare::as_json(&comparison) })
}
