//! The fit of a study whose rows somebody else deals out, to processes or machines: passes and sums of them as bytes.

use calibration::calibrate::OfEveryRow;
use fit::{FitOptions, Foretelling, Next, Pass, Streamed, StreamedResult, Tally, Validation};
use model_core::SymbolKind;
use observe::Observations;
use serde_json::{Value, json};
use service::{Calibrated, Source, Studied, errors_file};
use study::{Loaded, Plan};
use tables::formats::part::{Stretches, count};
use tables::formats::{DataError, Options, TableReader, open};

use crate::draw::stretches;
use crate::failure::Failure;
use crate::{table_files, terminal};

/// A fit between passes, or done.
#[derive(Clone)]
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
    /// The paths of some files, and how many rows to draw from all of them, evenly.
    Drawn(&'a [String], u64),
}

impl Streaming {
    /// Starts from some of the rows; none where there are none.
    ///
    /// # Errors
    /// A study that asks for more than a streamed fit does; rows that cannot be read, or that are too few to start from.
    pub fn new(studied: Studied, sample: Rows<'_>) -> Result<Option<Self>, Failure> {
        let Some(loaded) = load(&studied, sample)? else { return Ok(None) };
        loaded.doubtful.iter().for_each(terminal::warn);
        loaded.of_files.iter().for_each(terminal::warn);
        let plan = &studied.plan;
        let streamed =
            Streamed::from_sample(&plan.chain, &loaded.observations, &options(plan)).map_err(input)?;
        Ok(Some(Self { next: Next::Pass(Box::new(streamed)), studied }))
    }

    /// The pass to make, as bytes; none when the fit is done.
    #[must_use]
    pub fn pass(&self) -> Option<Vec<u8>> {
        match &self.next {
            Next::Pass(streamed) => Some(streamed.pass.to_bytes()),
            Next::Done(_) => None,
        }
    }

    /// Takes up what all rows say in that pass: of each file the tallies of its parts, in the order in which they are to be merged. A
    /// file without any counts for none.
    ///
    /// # Errors
    /// Bytes that are no tally of this pass.
    pub fn take(self, files: &[Vec<Vec<u8>>]) -> Result<Self, Failure> {
        let Next::Pass(streamed) = self.next else { return Ok(self) };
        let of_file = |parts: &Vec<Vec<u8>>| {
            parts.iter().try_fold(streamed.pass.empty(), |whole, bytes| {
                whole.merge(&Tally::from_bytes(bytes).map_err(input)?).map_err(input)
            })
        };
        let files =
            files.iter().filter(|parts| !parts.is_empty()).map(of_file).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { next: streamed.next(&files).map_err(input)?, ..self })
    }

    /// Takes what every row says into a calibration of some: this fit, of all of them, and the same fit of those that the
    /// calibration read; `validation` is of the others, and all come in so many `files`.
    ///
    /// # Errors
    /// A fit is not done.
    pub fn complete(
        &self,
        calibrated: &mut Calibrated,
        drawn: &Self,
        files: usize,
        validation: Option<Validation>,
    ) -> Result<(), Failure> {
        let (Next::Done(fit), Next::Done(drawn)) = (&self.next, &drawn.next) else {
            return Err(Failure::Input("the fit is not done: make all of its passes first".to_owned()));
        };
        let chain = &self.studied.plan.chain;
        calibrated.calibration.take_every_row(OfEveryRow { chain, fit, drawn, files, validation });
        Ok(())
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

/// What some rows say in a pass; none where there are none.
///
/// # Errors
/// The rows cannot be read; the pass is of another declaration or version.
pub fn accumulated(studied: &Studied, rows: Rows<'_>, pass: &[u8]) -> Result<Option<Vec<u8>>, Failure> {
    let Some(Loaded { observations, .. }) = load(studied, rows)? else { return Ok(None) };
    let plan = &studied.plan;
    let pass = Pass::from_bytes(pass, &plan.chain, &observations, &options(plan)).map_err(input)?;
    pass.accumulate(&observations).map(|tally| Some(tally.to_bytes())).map_err(input)
}

/// A study by a declaration, and its errors.
#[derive(Clone, Copy)]
pub struct Foretold<'a> {
    /// The study, with the declaration.
    pub studied: &'a Studied,
    /// A file of errors.
    pub errors: &'a Source,
}

/// How two declarations foretell rows that neither was fitted to, given once for either; `floor` is what a fit found of each component's
/// standard deviation.
///
/// # Errors
/// The rows or the errors cannot be read.
pub fn validated(
    before: Foretold<'_>,
    after: Foretold<'_>,
    rows: [Rows<'_>; 2],
    floor: &[f64],
) -> Result<Validation, Failure> {
    let [rows_before, rows_after] = rows;
    let (own_before, own_after) = (before.loaded(rows_before)?, after.loaded(rows_after)?);
    let options = options(&after.studied.plan);
    Validation::of(before.foretelling(&own_before), after.foretelling(&own_after), floor, &options)
        .map_err(input)
}

impl<'a> Foretold<'a> {
    /// Rows as this declaration reads them, and the values of its symbols.
    fn loaded(self, rows: Rows<'_>) -> Result<(Observations, Vec<f64>), Failure> {
        let values = errors_file::values(self.errors, &self.studied.plan.chain, &terminal::warn)?;
        let Some(loaded) = load(self.studied, rows)? else {
            return Err(Failure::Input("there are no rows to judge".to_owned()));
        };
        Ok((loaded.observations, values))
    }

    fn foretelling(self, (observations, values): &'a (Observations, Vec<f64>)) -> Foretelling<'a> {
        Foretelling { chain: &self.studied.plan.chain, values, observations }
    }
}

/// How to fit, as the search does.
pub fn options(plan: &Plan) -> FitOptions {
    FitOptions { noise: plan.fit.noise.by_residuals(), ..plan.fit.clone() }
}

pub fn input(error: impl ToString) -> Failure {
    Failure::Input(error.to_string())
}

/// Refuses what a streamed fit would leave undone, and reads the rows; none where there are none.
fn load(studied: &Studied, rows: Rows<'_>) -> Result<Option<Loaded>, Failure> {
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
    if studied.plan.has_uncertain_readings() {
        return refused(
            "rows that are read chunk by chunk take their readings as exact: leave `sigma` out under [columns], or calibrate on one \
             machine",
        );
    }
    let beside = |file: &str, options: &Options| {
        open(table_files::open_beside(&studied.study, file, None)?, file, options)
    };
    let loaded = match rows {
        Rows::Drawn(files, wanted) => {
            let options = studied.plan.options();
            let rows = |file: &String| count(&mut *beside(file, options)?);
            let counts =
                files.iter().map(rows).collect::<Result<Vec<u64>, _>>().map_err(table_files::failure)?;
            let mut stretches = stretches(&counts, wanted, studied.plan.hold_out.seed).into_iter();
            studied.plan.of_files(files).load_tables(&mut |path, options| match stretches.next() {
                Some(own) => Ok(Box::new(Stretches::new(beside(path, options)?, 0, own))),
                None => unreachable!("each file is read once: {path}"),
            })
        }
        rows => {
            let mut rows = Some(rows);
            studied.plan.load_tables(&mut |path, options| match rows.take() {
                Some(Rows::Table(table)) => Ok(table),
                Some(Rows::File(file)) => beside(file, options),
                _ => unreachable!("one table is read once: {path}"),
            })
        }
    };
    let loaded = match loaded {
        Err(DataError::NoRows { .. }) => return Ok(None),
        loaded => loaded.map_err(table_files::failure)?,
    };
    if loaded.observations.unknowns.is_some() {
        return refused(
            "objects and stations that nobody knows are estimated from all rows at once: calibrate on one machine",
        );
    }
    Ok(Some(loaded))
}

fn as_json(studied: &Studied, result: &StreamedResult) -> Value {
    let chain = &studied.plan.chain;
    let errors = result.parameters.iter().enumerate().map(|(at, id)| {
        let symbol = chain.symbol(*id);
        json!({
            "name": symbol.name,
            "value": result.values[id.index()],
            // Of what the data do not tell from the rest the prior alone would speak.
            "standard_uncertainty": result.separable[at].then(|| result.standard_uncertainty(&[(at, 1.0)])),
            "unit": symbol.quantity.unit(),
            "separable": result.separable[at],
        })
    });
    let values =
        || chain.symbols.iter().zip(&result.values).filter(|(symbol, _)| symbol.kind == SymbolKind::Error);
    let [rows, kept] = result.rows;
    json!({
        "errors": errors.collect::<Vec<_>>(),
        "values": values().map(|(symbol, &value)| (symbol.name.clone(), json!(value))).collect::<serde_json::Map<_, _>>(),
        "units": values().map(|(symbol, _)| (symbol.name.clone(), json!(symbol.quantity.unit()))).collect::<serde_json::Map<_, _>>(),
        "rank": result.rank,
        "noise": result.floor,
        "shared_by_files": result.shared.as_ref().map(|shared| json!({
            "files": shared.units,
            "ratio": shared.ratio,
            "p_value": shared.p_value,
        })),
        "rms": result.rms,
        "rows": rows,
        "rows_kept": kept,
        "passes": result.passes,
        "converged": result.converged,
    })
}
