//! Ranges along a beam that are negative: a sign by mistake, or a mark of the instrument's for no return.

use model_core::{Chain, SymbolId};

use super::plan::SourcePlan;
use super::rows::Rows;
use fit::range_of;
use observe::kinds::Ranges;
use tables::formats::DataError;

/// A sensor that reads to either side of its zero has a larger share of negative readings.
const SIGNED: f64 = 0.1;

/// Refuses the first negative range of rows that observe objects, unless the sensor reads to either side of its zero.
pub(super) fn check_ranges(
    chain: &Chain,
    source: &SourcePlan,
    readings: &[(SymbolId, Vec<f64>)],
    rows: &Rows,
    file: &str,
) -> Result<(), DataError> {
    let expected = source.measure.kind().ranges;
    let has_beam = expected != Ranges::Any;
    let Some(range) = range_of(chain, source.observable).filter(|_| has_beam) else { return Ok(()) };
    // A slide of the chain may go either way.
    let components = &chain.observable(source.observable).components;
    if !components.iter().any(|component| chain.symbols_in(component).contains(&range)) {
        return Ok(());
    }
    let Some((_, values)) = readings.iter().find(|(id, _)| *id == range) else { return Ok(()) };
    let negative = values.iter().filter(|value| **value < 0.0).count();
    let all = values.len();
    let is_signed = negative as f64 > SIGNED * all as f64 && (negative < all || expected == Ranges::OfSensor);
    let Some(row) = values.iter().position(|value| *value < 0.0).filter(|_| !is_signed) else {
        return Ok(());
    };
    let others = if negative > 1 { format!(" ({negative} of {all} rows are)") } else { String::new() };
    Err(DataError::Impossible {
        file: file.to_owned(),
        line: rows.places.line(row),
        row: rows.number(row),
        why: format!(
            "`{}` is {} m, and a range is not negative{others}: write how far away the object is, or leave the row out if there was \
             no return",
            chain.symbol(range).name,
            values[row]
        ),
    })
}
