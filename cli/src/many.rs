//! A calibration of more rows than its search reads: the search reads rows drawn from all files, a fit reads every row, chunk by chunk, and
//! what the search found is judged on the rows that were not drawn.

use std::ops::Range;

use calibration::calibrate::OfEveryRow;
use calibration::diagnose::Diagnosis;
use fit::{Foretelling, Next, Pass, Streamed, StreamedResult, Tally, Validation};
use model_core::SymbolId;
use observe::{Observations, Poses, Series};
use service::{Calibrated, Measured, Source, Studied};
use study::{OpenTable, Plan, SourcePlan};
use tables::formats::part::{Budget, Stretches, Within, count};

use crate::calibrating;
use crate::draw::stretches;
use crate::failure::Failure;
use crate::streaming::{input, options};
use crate::{table_files, terminal};

/// Rows of a chunk.
const CHUNK: u64 = 1 << 18;

/// Rows that were not drawn for the search.
pub struct Others {
    files: Vec<Drawn>,
}

/// A file, and the rows that were drawn of it.
struct Drawn {
    path: String,
    rows: u64,
    stretches: Vec<Range<u64>>,
}

/// Reads every row of a study's tables or, where there are more, draws so many, and says what the others are.
///
/// # Errors
/// What is wrong with a table.
pub fn read(
    studied: Studied,
    at_most: usize,
    open: &mut OpenTable<'static>,
) -> Result<(Measured, Option<Others>), Failure> {
    let plan = &studied.plan;
    // A pipe can be read once only.
    if !may_be_drawn(plan) || !calibrating::table_files(&studied).iter().all(|path| path.is_file()) {
        return Ok((studied.load(open, &terminal::warn)?, None));
    }
    let budget = Budget::new(at_most);
    let loaded =
        plan.load_tables(&mut |path, options| Ok(Box::new(Within::new(open(path, options)?, &budget))));
    if !budget.is_exceeded() {
        let loaded = loaded.map_err(table_files::failure)?;
        return Ok((studied.with_data(loaded.without_repeats(), &terminal::warn), None));
    }
    drop(loaded);
    let paths = plan.sources.iter().flat_map(|source| &source.paths);
    let rows = paths.map(|path| Ok((path.clone(), count(&mut *open(path, plan.options())?)?)));
    let rows: Vec<(String, u64)> = rows.collect::<Result<_, _>>().map_err(table_files::failure)?;
    let counts: Vec<u64> = rows.iter().map(|(_, rows)| *rows).collect();
    let stretches = stretches(&counts, at_most as u64, plan.hold_out.seed);
    let drawn = |((path, rows), stretches)| Drawn { path, rows, stretches };
    let files: Vec<Drawn> = rows.into_iter().zip(stretches).map(drawn).collect();
    let mut left = files.iter();
    let loaded = plan.load_tables(&mut |path, options| {
        let Some(file) = left.next() else { unreachable!("each file of the study is read once: {path}") };
        Ok(Box::new(Stretches::new(open(path, options)?, 0, file.stretches.iter().cloned())))
    });
    let loaded = loaded.map_err(table_files::failure)?;
    Ok((studied.with_data(loaded, &terminal::warn), Some(Others { files })))
}

/// The errors that the written model does without.
fn held(diagnosis: &Diagnosis, plan: &Plan) -> Vec<SymbolId> {
    let names = diagnosis.ladder.iter().flat_map(|ladder| ladder.above(ladder.written));
    names.filter_map(|name| plan.chain.find_symbol(name)).collect()
}

/// Whether a part of the rows can stand for all: not where they observe what nobody knows, or several things, where poses join them, or where
/// readings are uncertain, which rows that are read chunk by chunk do not follow.
fn may_be_drawn(plan: &Plan) -> bool {
    let has_objects = |source: &SourcePlan| source.measure.observes_object();
    plan.sources.len() == 1
        && plan.trajectory.is_none()
        && plan.hold_out.file.is_none()
        && !plan.sources.iter().any(has_objects)
        && !plan.has_uncertain_readings()
}

impl Others {
    /// All rows, those that were drawn among them.
    pub fn all(&self) -> u64 {
        self.files.iter().map(|file| file.rows).sum()
    }

    /// Takes what every row says into a calibration of those that were drawn.
    ///
    /// # Errors
    /// A row that was not drawn cannot be read.
    pub fn complete(
        &self,
        calibrated: &mut Calibrated,
        open: &mut OpenTable<'static>,
        tell: &dyn Fn(String),
    ) -> Result<(), Failure> {
        let Some(amended) = &calibrated.calibration.amended else { return Ok(()) };
        let declared = calibrated.studied();
        let mut amended =
            Studied::of(declared.study.clone(), Source::of_text("amended.chain", amended), &terminal::warn)?;
        amended.plan = amended.plan.holding(&held(&calibrated.calibration.diagnosis, &amended.plan));
        let drawn =
            [calibrated.observations().clone(), renamed(calibrated.observations(), declared, &amended)];
        let start = |studied: &Studied, drawn| {
            Streamed::from_sample(&studied.plan.chain, drawn, &options(&studied.plan)).map_err(input)
        };
        let of_drawn =
            |start, drawn| passes(start, |pass, _| Ok(vec![pass.accumulate(drawn).map_err(input)?]));
        let before = of_drawn(start(declared, &drawn[0])?, &drawn[0])?;
        let start = start(&amended, &drawn[1])?;
        let after = of_drawn(start.clone(), &drawn[1])?;
        let mut validation = Validation::default();
        let fit = passes(start, |pass, number| {
            let mut done = 0;
            let mut of_file = |file: &Drawn| {
                let mut tally = pass.empty();
                each_chunk(&amended.plan, file, open, |first, rows| {
                    tell(format!("fitting every row, pass {number}: row {} of {}", done + first, self.all()));
                    tally = tally.clone().merge(&pass.accumulate(&rows).map_err(input)?).map_err(input)?;
                    if number == 1 {
                        let others = file.without_drawn(first, &rows);
                        let foretold = renamed(&others, &amended, declared);
                        let one = Foretelling {
                            chain: &declared.plan.chain,
                            values: &before.values,
                            observations: &foretold,
                        };
                        let other = Foretelling {
                            chain: &amended.plan.chain,
                            values: &after.values,
                            observations: &others,
                        };
                        let own = Validation::of(one, other, &after.floor, &options(&amended.plan))
                            .map_err(input)?;
                        validation = validation + own;
                    }
                    Ok(())
                })?;
                done += file.rows;
                Ok(tally)
            };
            self.files.iter().map(&mut of_file).collect()
        })?;
        let validation = (before.converged && after.converged).then_some(validation);
        let chain = &amended.plan.chain;
        let every = OfEveryRow { chain, fit: &fit, drawn: &after, files: self.files.len(), validation };
        calibrated.calibration.take_every_row(every);
        Ok(())
    }
}

impl Drawn {
    /// Rows of this file, of which the first has this number, without those that were drawn.
    fn without_drawn(&self, first: u64, rows: &Observations) -> Observations {
        let is_drawn = |row: u64| self.stretches.iter().any(|stretch| stretch.contains(&row));
        let others: Vec<usize> = (0..rows.rows()).filter(|&row| !is_drawn(first + row as u64)).collect();
        rows.select(&others)
    }
}

/// Makes every pass of a fit: `make` gives the tallies of all files in a pass, of which the first has the number 1.
fn passes(
    mut fit: Streamed,
    mut make: impl FnMut(&Pass, usize) -> Result<Vec<Tally>, Failure>,
) -> Result<StreamedResult, Failure> {
    for number in 1.. {
        let tallies = make(&fit.pass, number)?;
        match fit.next(&tallies).map_err(input)? {
            Next::Pass(next) => fit = *next,
            Next::Done(result) => return Ok(*result),
        }
    }
    unreachable!("a fit ends after some passes")
}

/// Reads a file chunk by chunk; `take` is given each chunk and how many rows come before it.
fn each_chunk(
    plan: &Plan,
    file: &Drawn,
    open: &mut OpenTable<'static>,
    mut take: impl FnMut(u64, Observations) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let plan = plan.of_files(std::slice::from_ref(&file.path));
    let mut reader = open(&file.path, plan.options()).map_err(table_files::failure)?;
    let mut first = 0;
    while first < file.rows {
        let end = (first + CHUNK).min(file.rows);
        let mut chunk = Some(Stretches::new(&mut *reader, first, std::iter::once(first..end)));
        let loaded = plan.load_tables(&mut |path, _| match chunk.take() {
            Some(chunk) => Ok(Box::new(chunk)),
            None => unreachable!("one file is read once: {path}"),
        });
        take(first, loaded.map_err(table_files::failure)?.observations)?;
        first = end;
    }
    Ok(())
}

/// Observations by one declaration as another has them, whose symbols of the same names stand at other places.
fn renamed(observations: &Observations, from: &Studied, to: &Studied) -> Observations {
    let (from, to) = (&from.plan.chain, &to.plan.chain);
    let poses = &observations.poses;
    let column =
        |(id, values): &(SymbolId, Vec<f64>)| Some((to.find_symbol(&from.symbol(*id).name)?, values.clone()));
    let mut columns: Vec<_> = poses.columns.iter().filter_map(column).collect();
    columns.sort_by_key(|(id, _)| *id);
    let series = poses.series.iter().map(|series| {
        let name = &from.observable(series.observable).name;
        let Some(observable) = to.find_observable(name) else {
            unreachable!("an amended declaration observes what the declaration does: {name}")
        };
        Series { observable, ..series.clone() }
    });
    let poses = Poses { series: series.collect(), columns };
    Observations { poses, ..observations.clone() }
}
