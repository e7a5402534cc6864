//! The fit of a study whose rows somebody else deals out, to processes or machines: passes and sums of them as bytes.

use calibration::fit::{Next, Pass, Streamed, StreamedResult, Tally};
use calibration::formats::{DataError, TableReader, open};
use calibration::study::Loaded;
use model_core::SymbolKind;
use serde_json::{Value, json};

use crate::calibrating::Studied;
use crate::commands::calibrate;
use crate::failure::Failure;
use crate::{tables, terminal};

/// A fit between passes, or done.
pub struct Streaming {
    studied: Studied,
    next: Next,
}

/// Rows of a study's table: read already, or a file of this path.
pub enum Rows<'a> {
    /// Read already.
    Table(Box<dyn TableReader + 'a>),
    /// The path of a file.
    File(&'a str),
}

impl Streaming {
    /// Starts from some of the rows.
    ///
    /// # Errors
    /// A study that asks for more than a streamed fit does; rows that cannot be read, or that are too few to start from.
    pub fn new(studied: Studied, sample: Rows<'_>) -> Result<Self, Failure> {
        let loaded = load(&studied, sample)?;
        loaded.doubtful.iter().for_each(terminal::warn);
        let plan = &studied.plan;
        let streamed = Streamed::from_sample(&plan.chain, &loaded.observations, &plan.fit).map_err(input)?;
        Ok(Self { next: Next::Pass(Box::new(streamed)), studied })
    }

    /// The pass to make, as bytes; none when the fit is done.
    #[must_use]
    pub fn pass(&self) -> Option<Vec<u8>> {
        match &self.next {
            Next::Pass(streamed) => Some(streamed.pass.to_bytes()),
            Next::Done(_) => None,
        }
    }

    /// Takes up what all rows say in that pass: the tallies of its parts, in the order in which they are to be merged.
    ///
    /// # Errors
    /// Bytes that are no tally of this pass.
    pub fn take<'t>(self, tallies: impl IntoIterator<Item = &'t [u8]>) -> Result<Self, Failure> {
        let Next::Pass(streamed) = self.next else { return Ok(self) };
        let whole = tallies.into_iter().try_fold(streamed.pass.empty(), |whole, bytes| {
            whole.merge(&Tally::from_bytes(bytes).map_err(input)?).map_err(input)
        })?;
        Ok(Self { next: streamed.next(&whole), ..self })
    }

    /// What the fit found; none while there are passes to make.
    #[must_use]
    pub fn found(&self) -> Option<Value> {
        match &self.next {
            Next::Pass(_) => None,
            Next::Done(result) => Some(as_json(&self.studied, result)),
        }
    }
}

/// What some rows say in a pass.
///
/// # Errors
/// The rows cannot be read; the pass is of another declaration or version.
pub fn accumulated(studied: &Studied, rows: Rows<'_>, pass: &[u8]) -> Result<Vec<u8>, Failure> {
    let Loaded { observations, .. } = load(studied, rows)?;
    let plan = &studied.plan;
    let pass = Pass::from_bytes(pass, &plan.chain, &observations, &plan.fit).map_err(input)?;
    pass.accumulate(&observations).map(|tally| tally.to_bytes()).map_err(input)
}

fn input(error: impl ToString) -> Failure {
    Failure::Input(error.to_string())
}

/// Refuses what a streamed fit would leave undone, and reads the rows.
fn load(studied: &Studied, rows: Rows<'_>) -> Result<Loaded, Failure> {
    let names: Vec<&str> = studied.tables().collect();
    let refused = |why: &str| Err(Failure::Input(format!("{}: {why}", studied.study.path.display())));
    if studied.plan.hold_out.file.is_some() {
        return refused(
            "the fit over many files judges nothing on a second file: take `file` out of [hold_out]",
        );
    }
    if names.len() != 1 {
        return refused(
            "the fit over many files is of one table: name one file in `data`, which the others stand for",
        );
    }
    let place = match &rows {
        Rows::Table(table) => table.source().to_owned(),
        Rows::File(file) => (*file).to_owned(),
    };
    let mut rows = Some(rows);
    let loaded = studied.plan.load_tables(&mut |path, options| match rows.take() {
        Some(Rows::Table(table)) => Ok(table),
        Some(Rows::File(file)) => open(calibrate::open_beside(&studied.study, file, None)?, file, options),
        None => unreachable!("one table is read once: {path}"),
    });
    let loaded = loaded.map_err(|error| match error {
        // The study's table stands for this file.
        DataError::NoRows { .. } => tables::failure(DataError::NoRows { file: place }),
        error => tables::failure(error),
    })?;
    if loaded.observations.unknowns.is_some() {
        return refused(
            "objects and stations that nobody knows are estimated from all rows at once: calibrate on one machine",
        );
    }
    Ok(loaded)
}

fn as_json(studied: &Studied, result: &StreamedResult) -> Value {
    let chain = &studied.plan.chain;
    let errors = result.parameters.iter().enumerate().map(|(at, id)| {
        let symbol = chain.symbol(*id);
        json!({
            "name": symbol.name,
            "value": result.values[id.index()],
            "standard_uncertainty": result.covariance[(at, at)].sqrt(),
            "unit": symbol.quantity.unit(),
            "separable": result.separable[at],
        })
    });
    let values =
        chain.symbols.iter().zip(&result.values).filter(|(symbol, _)| symbol.kind == SymbolKind::Error);
    let [rows, kept] = result.rows;
    json!({
        "errors": errors.collect::<Vec<_>>(),
        "values": values.map(|(symbol, &value)| (symbol.name.clone(), json!(value))).collect::<serde_json::Map<_, _>>(),
        "rank": result.rank,
        "noise": result.floor,
        "rms": result.rms,
        "rows": rows,
        "rows_kept": kept,
        "passes": result.passes,
        "converged": result.converged,
    })
}
