//! Readings in, more columns out: what `eval` and `apply` both do with a table.

use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use model_core::Chain;
use service::errors_file::{self, FoundOver};
use service::evaluation::{Evaluator, Exactness, Quantity, column_names};
use service::readings::{ReadingsTable, Rows};
use tables::formats::Column;

use crate::failure::Failure;
use crate::{output, source, table_files, terminal};

/// What is evaluated over which table, and where to.
#[derive(Debug, clap::Args)]
pub struct OverTable {
    /// The declaration, amended or not
    chain: PathBuf,
    /// Readings of joints and inputs: a .csv or .parquet file, or - for standard input
    #[arg(long, value_name = "IN")]
    pub data: PathBuf,
    /// Values of the errors, as `calibrate` writes them too
    #[arg(long, value_name = "E.toml")]
    errors: PathBuf,
    /// Only this observable (may be given several times); default: every one that the data has the readings for
    #[arg(long)]
    pub observable: Vec<String>,
    /// What lines of the data begin with that are comments, where there are any below the header
    #[arg(long, value_name = "LETTER", value_parser = comment_mark)]
    pub comment: Option<u8>,
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
}

/// What was read before any row.
pub struct Opened {
    /// The declaration.
    pub chain: Chain,
    /// The value of every symbol, SI.
    pub values: Vec<f64>,
    /// The ranges that the errors were found over, if the file says so.
    pub found: Vec<FoundOver>,
    /// The readings.
    pub table: ReadingsTable<'static>,
}

impl OverTable {
    /// Reads the declaration and the errors, and opens the table.
    ///
    /// # Errors
    /// One of them has a mistake, or the output would replace one.
    pub fn open(&self) -> Result<Opened, Failure> {
        output::refuse_to_replace(&self.out, [self.data.as_path()])?;
        let Model { chain, values, found } = self.model()?;
        let table = table_files::open_kept(&self.data, &chain, self.comment)?;
        Ok(Opened { chain, values, found, table })
    }

    /// Reads the declaration and the errors. Data may be replaced: the points of a cloud are corrected in their own place.
    ///
    /// # Errors
    /// One of them has a mistake, or the output would replace one.
    pub fn model(&self) -> Result<Model, Failure> {
        output::refuse_to_replace(&self.out, [self.chain.as_path(), &self.errors])?;
        let chain = source::chain(&self.chain)?;
        let errors = source::read(&self.errors)?;
        let values = errors_file::values(&errors, &chain, &terminal::warn)?;
        let found = errors_file::found_over(&errors, &chain)?;
        Ok(Model { chain, values, found })
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
        self.write(table, &added, |rows| {
            let readings: Vec<_> =
                rows.readings.iter().map(|(id, values)| (*id, values.as_slice())).collect();
            Ok(evaluator.columns(&readings, rows.count)?)
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
        mut compute: impl FnMut(&Rows) -> Result<Vec<Vec<f64>>, Failure>,
    ) -> Result<(), Failure> {
        let is_replaced = table.replaced_by(added);
        let is_kept: Vec<bool> = is_replaced.iter().map(|replaced| !replaced).collect();
        let header: Vec<String> = table.names_of(&is_kept).into_iter().chain(added.iter().cloned()).collect();
        let mut not_finite = 0;
        let mut done = 0_usize;
        let progress = terminal::progress();
        progress.say("reading the header");
        let table = table_files::write(&self.out, |writer| {
            // A large table is read once for the types of its texts.
            writer.header_beside(&header, &table, &is_kept, |share| {
                progress
                    .say(&format!("{:.0} % of the file read for the types of its columns", 100.0 * share));
            })?;
            let began = Instant::now();
            read_ahead(table, |rows, share_read| {
                let computed = compute(&rows)?;
                let is_finite = |row: &usize| computed.iter().all(|column| column[*row].is_finite());
                not_finite += (0..rows.count).filter(|row| !is_finite(row)).count();
                let kept = rows.kept.into_iter().zip(&is_replaced).filter(|(_, replaced)| !**replaced);
                let kept = kept.map(|(kept, _)| Column::Kept(kept));
                writer.rows(kept.chain(computed.into_iter().map(Column::Numbers)).collect(), rows.count)?;
                done += rows.count;
                progress.say(&so_far(done as u64, share_read, began.elapsed()));
                Ok(())
            })
        })?;
        progress.finish_and_clear();
        table.doubtful().for_each(terminal::warn);
        table.lost(&is_replaced).iter().for_each(terminal::warn);
        if not_finite > 0 {
            terminal::warn(format_args!(
                "{not_finite} rows are not finite: the chain has a pole there, or a number too large"
            ));
        }
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
