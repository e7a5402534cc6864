//! Readings in, more columns out: what `eval` and `apply` both do with a table.

use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use model_core::Chain;
use service::Instrument;
use service::apply::{Layout, Place, not_finite, not_finite_warnings, numbers};
use service::errors_file::{self, FoundOver};
use service::evaluation::{Evaluator, Exactness, Quantity, column_names};
use service::readings::{ReadingsTable, Rows};
use service::source::observables;
use study::{Joining, TrajectoryPlan};
use tables::formats::{Column, Options};

use crate::failure::Failure;
use crate::source::{self, Declared};
use crate::{output, table_files, terminal};

/// What is evaluated over which table, and where to.
#[derive(Debug, clap::Args)]
pub struct OverTable {
    /// An instrument file, or a declaration, amended or not
    chain: PathBuf,
    /// Readings of joints and inputs: a .csv or .parquet file, or - for standard input
    #[arg(long, value_name = "IN")]
    pub data: PathBuf,
    /// Values of the errors of a declaration, as `calibrate` writes them too; an instrument file has its own
    #[arg(long, value_name = "E.toml")]
    errors: Option<PathBuf>,
    /// Only this observable (may be given several times); default: every one that the data has the readings for
    #[arg(long)]
    pub observable: Vec<String>,
    /// What lines of the data begin with that are comments, where there are any below the header
    #[arg(long, value_name = "LETTER", value_parser = comment_mark)]
    pub comment: Option<u8>,
    /// The trajectory that joins the rows, of an instrument whose study has one; default: the study's, beside the data
    #[arg(long, value_name = "SBET")]
    trajectory: Option<PathBuf>,
    /// Where to write: a .csv or .parquet file, or - for standard output
    #[arg(long, value_name = "OUT")]
    pub out: PathBuf,
}

fn comment_mark(text: &str) -> Result<u8, &'static str> {
    match text.as_bytes() {
        [mark] if mark.is_ascii_punctuation() && !b"\"+-.".contains(mark) => Ok(*mark),
        _ => Err("write one mark, such as #"),
    }
}

/// A declaration with the values of its errors.
pub struct Model {
    /// The declaration.
    pub chain: Chain,
    /// The value of every symbol, SI.
    pub values: Vec<f64>,
    /// The ranges that the errors were found over, if the file says so.
    pub found: Vec<FoundOver>,
    /// The instrument, if its file was given.
    pub instrument: Option<Instrument>,
}

/// What was read before any row.
pub struct Opened {
    /// The declaration.
    pub chain: Chain,
    /// The value of every symbol, SI.
    pub values: Vec<f64>,
    /// The ranges that the errors were found over, if the file says so.
    pub found: Vec<FoundOver>,
    /// The instrument, if its file was given.
    pub instrument: Option<Instrument>,
    /// The readings.
    pub table: ReadingsTable<'static>,
}

impl OverTable {
    /// The file of the instrument or declaration.
    pub fn chain(&self) -> &std::path::Path {
        &self.chain
    }

    /// Reads the declaration and the errors, and opens the table.
    ///
    /// # Errors
    /// One of them has a mistake, or the output would replace one.
    pub fn open(&self) -> Result<Opened, Failure> {
        output::refuse_to_replace(&self.out, [self.data.as_path()])?;
        let Model { chain, values, found, instrument } = self.model()?;
        let headings = instrument.as_ref().and_then(|instrument| instrument.headings.as_ref());
        let options = headings.map_or_else(Options::default, |headings| headings.format);
        let options = Options { comment: self.comment.or(options.comment), ..options };
        let plan = headings.and_then(|headings| headings.trajectory.as_ref());
        let joining = self.joining(plan, &options)?;
        let mut table = table_files::open_kept(&self.data, &chain, options, joining)?;
        if let Some(headings) = headings {
            let named = match self.observable.as_slice() {
                [] => Vec::new(),
                names => observables(&chain, names)?,
            };
            table = table.headed_by(headings, &named);
        }
        Ok(Opened { chain, values, found, instrument, table })
    }

    /// The trajectory that joins the rows, if one does.
    fn joining(&self, plan: Option<&TrajectoryPlan>, options: &Options) -> Result<Option<Joining>, Failure> {
        match (plan, &self.trajectory) {
            (Some(plan), own) => table_files::joining(plan, own.as_deref(), &self.data, options).map(Some),
            (None, None) => Ok(None),
            (None, Some(_)) => Err(Failure::Input(format!(
                "`{}` has no study with a [trajectory]: leave --trajectory out",
                self.chain.display()
            ))),
        }
    }

    /// Reads the declaration and the errors. Data may be replaced: the points of a cloud are corrected in their own place.
    ///
    /// # Errors
    /// One of them has a mistake, or the output would replace one.
    pub fn model(&self) -> Result<Model, Failure> {
        output::refuse_to_replace(
            &self.out,
            [&self.chain].into_iter().chain(&self.errors).map(PathBuf::as_path),
        )?;
        let Declared { chain, instrument, .. } = Declared::read(&self.chain)?;
        let (values, found) = match (&self.errors, &instrument) {
            (None, Some(instrument)) => (instrument.values.clone(), instrument.found.clone()),
            (Some(path), None) => {
                let errors = source::read(path)?;
                let values = errors_file::values(&errors, &chain, &terminal::warn)?;
                (values, errors_file::found_over(&errors, &chain)?)
            }
            (Some(_), Some(_)) => {
                return Err(Failure::Input(format!(
                    "`{}` is an instrument file, which has its errors: leave --errors out, or give a declaration",
                    self.chain.display()
                )));
            }
            (None, None) => {
                return Err(Failure::Input(format!(
                    "`{}` is a declaration: say --errors E.toml, or give the instrument file that `calibrate` writes",
                    self.chain.display()
                )));
            }
        };
        Ok(Model { chain, values, found, instrument })
    }

    /// Writes the table with a quantity of each observable.
    ///
    /// # Errors
    /// The declaration, the errors or the readings have a mistake, or the place cannot be written.
    pub fn evaluate(&self, form: Exactness, quantity: Quantity) -> Result<(), Failure> {
        let Opened { chain, values, mut table, .. } = self.open()?;
        let chosen = table.with_readings(&chain, &self.observable)?;
        let evaluator = Evaluator::new(&chain, chosen, form, quantity, &values);
        table.want(&chain, &evaluator.readings)?;
        let added = column_names(&chain, &evaluator.observables)?;
        self.write(table, &added, Place::Behind, |rows| {
            let readings: Vec<_> =
                rows.readings.iter().map(|(id, values)| (*id, values.as_slice())).collect();
            Ok(numbers(evaluator.columns(&readings, rows.count)?))
        })
    }

    /// Writes the table with the columns that `compute` makes of its rows; warns of columns of the input that these replace.
    ///
    /// # Errors
    /// A row cannot be read or computed, or the place cannot be written.
    pub fn write(
        &self,
        table: ReadingsTable<'static>,
        added: &[String],
        place: Place,
        mut compute: impl FnMut(&Rows) -> Result<Vec<Column>, Failure>,
    ) -> Result<(), Failure> {
        let layout = Layout::of(&table, added, place);
        let mut infinite = 0;
        let mut done = 0_usize;
        let progress = terminal::progress();
        progress.say("reading the header");
        let table = table_files::write(&self.out, |writer| {
            // A large table is read once for the types of its texts.
            writer.header_beside(&layout.header, &table, &layout.kept(), |share| {
                progress
                    .say(&format!("{:.0} % of the file read for the types of its columns", 100.0 * share));
            })?;
            let began = Instant::now();
            read_ahead(table, |rows, share_read| {
                let computed = compute(&rows)?;
                infinite += not_finite(&computed, rows.count);
                let count = rows.count;
                writer.rows(layout.rows(rows.kept, computed), count)?;
                done += count;
                progress.say(&so_far(done as u64, share_read, began.elapsed()));
                Ok(())
            })
        })?;
        progress.finish_and_clear();
        table.doubtful().for_each(terminal::warn);
        table.lost(&layout.is_replaced).iter().for_each(terminal::warn);
        not_finite_warnings(infinite, table.without_reading()).iter().for_each(terminal::warn);
        Ok(())
    }
}

/// Lets `take` have all rows of a table in order, and the share of it that was read; the next ones are read while it works. Gives the
/// table back.
fn read_ahead(
    mut table: ReadingsTable<'static>,
    mut take: impl FnMut(Rows, Option<f64>) -> Result<(), Failure>,
) -> Result<ReadingsTable<'static>, Failure> {
    let (ready, rows) = mpsc::sync_channel(0);
    let reader = thread::spawn(move || {
        while let Some(next) = table.next_rows().transpose() {
            let is_last = next.is_err();
            // Who takes no more has failed.
            if ready.send(next.map(|rows| (rows, table.share_read()))).is_err() || is_last {
                break;
            }
        }
        table
    });
    // Whoever fails does not wait for the reader, which may itself be waiting for rows that never come.
    rows.into_iter().try_for_each(|next| {
        let (rows, share_read) = next?;
        take(rows, share_read)
    })?;
    Ok(reader.join().unwrap_or_else(|panic| resume_unwind(panic)))
}

/// What is done, and how long the rest takes, as far as that is known.
pub fn so_far(rows: u64, share: Option<f64>, elapsed: Duration) -> String {
    match share.filter(|&share| share > 0.0) {
        Some(share) => {
            let left = elapsed.as_secs_f64() * (1.0 / share - 1.0).max(0.0);
            format!("{rows} rows, {:.0} % of the file, about {left:.0} s left", 100.0 * share.min(1.0))
        }
        None => format!("{rows} rows"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn progress_tells_what_is_left() {
        let told = so_far(65_536, Some(0.25), Duration::from_secs(10));
        assert_eq!(told, "65536 rows, 25 % of the file, about 30 s left");
        assert_eq!(so_far(7, None, Duration::from_secs(1)), "7 rows");
        assert_eq!(so_far(7, Some(0.0), Duration::ZERO), "7 rows");
    }
}
