//! Readings from a table by time: each point gets those of its GPS time, on the straight line between the two rows about it. An
//! angle goes the short way round.

use std::f64::consts::TAU;
use std::path::Path;

use model_core::{Chain, Quantity, SymbolId};
use service::readings::ReadingsTable;
use tables::formats::{ColumnName, DataError, Options};

use super::dimensions::TIME;
use crate::failure::Failure;
use crate::table_files;
use model_core::names::listed;

/// Steps of the table that are so many times longer than the usual one are gaps.
const GAP: f64 = 10.0;
/// Angles that turn farther from row to row may have gone the other way round, rad.
const FARTHEST: f64 = TAU / 3.0;

/// A table with a time in each row.
pub struct Timetable {
    times: Vec<f64>,
    columns: Vec<(SymbolId, Quantity, Vec<f64>)>,
    /// The step from row to row in the middle of all, s.
    usual: f64,
    /// What is to be doubted of its units, in words.
    pub doubts: Vec<String>,
}

/// A table that was opened, of which no row was read.
pub struct Opened<'c> {
    table: ReadingsTable<'static>,
    chain: &'c Chain,
    time: String,
}

impl<'c> Opened<'c> {
    /// Opens a table, and finds its times: in the column of this name, or else in `gps_time` or `time`.
    ///
    /// # Errors
    /// It cannot be read, or has no such column.
    pub fn open(
        path: &Path,
        chain: &'c Chain,
        time: Option<&str>,
        comment: Option<u8>,
    ) -> Result<Self, Failure> {
        let table = table_files::open_readings(path, chain, Options { comment, ..Options::default() }, None)?;
        let wanted = time.map_or_else(|| vec![TIME, "time"], |time| vec![time]);
        let stands = |name: &&str| table.header().iter().any(|column| table.means(column, name));
        let there: Vec<&str> = wanted.into_iter().filter(stands).collect();
        let time = match (there.as_slice(), time) {
            ([one], _) => (*one).to_owned(),
            ([], _) => {
                let columns = listed(table.header().iter().map(|column| column.full.as_str()));
                let wanted = time.map_or_else(|| format!("`{TIME}` or `time`"), |time| format!("`{time}`"));
                return Err(Failure::Input(format!(
                    "{}: no column {wanted} has the times of its rows: name it with --time; the file has {columns}",
                    table.source()
                )));
            }
            (several, _) => {
                return Err(Failure::Input(format!(
                    "{}: both {} may have the times of its rows: name one with --time",
                    table.source(),
                    listed(several.iter().copied())
                )));
            }
        };
        Ok(Self { table, chain, time })
    }

    /// Its name, for messages.
    pub fn name(&self) -> &str {
        self.table.source()
    }

    /// The names of its columns, as a message lists them.
    pub fn columns(&self) -> String {
        listed(self.table.header().iter().map(|column| column.full.as_str()))
    }

    /// Whether it has the readings of a joint or input.
    pub fn has(&self, reading: SymbolId) -> bool {
        self.table.has(self.chain, &[reading])
    }

    /// Whether the readings of a joint or input would be the times themselves.
    pub fn is_time(&self, reading: SymbolId) -> bool {
        self.chain.symbol(reading).name == self.time
    }

    /// Reads these readings at every time.
    ///
    /// # Errors
    /// A row that cannot be read, a time that is no later than the one before, or more rows than are held.
    pub fn read(mut self, readings: &[SymbolId]) -> Result<Timetable, Failure> {
        self.table.want(self.chain, readings)?;
        let is_time = |column: &&ColumnName| self.table.means(column, &self.time);
        if let Some(column) = self.table.header().iter().find(is_time)
            && let Some(unit) = column.full.strip_prefix(&self.time)
            && !["", "s", "sec"].contains(&unit.trim().trim_matches(['[', ']', '(', ')']))
        {
            let column = &column.full;
            let why = format!("column `{column}`: GPS times are seconds; write these as `{} [s]`", self.time);
            return Err(Failure::Input(format!("{}: {why}", self.table.source())));
        }
        self.table.want_other(&self.time, Quantity::Number)?;
        let quantity = |id: SymbolId| self.chain.symbol(id).quantity;
        let mut columns: Vec<_> = readings.iter().map(|&id| (id, quantity(id), Vec::new())).collect();
        let mut times: Vec<f64> = Vec::new();
        while let Some(rows) = self.table.next_rows()? {
            let [more] = rows.others.as_slice() else { unreachable!("one column of times is wanted") };
            for time in more {
                if let Some(before) = times.last().filter(|before| *before >= time) {
                    let why = format!(
                        "its time {time} is not after {before}, that of the row before: sort the table by time, and take away \
                         what stands there twice"
                    );
                    let (file, row) = (self.table.source().to_owned(), times.len() as u64 + 1);
                    return Err(table_files::failure(DataError::Impossible { file, line: None, row, why }));
                }
                times.push(*time);
            }
            for ((_, _, column), (_, more)) in columns.iter_mut().zip(rows.readings) {
                column.extend(more);
            }
            let bytes = size_of::<f64>() * times.len() * (columns.len() + 1);
            Options::default().holds(bytes, self.table.source()).map_err(table_files::failure)?;
        }
        let mut steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let middle = steps.len() / 2;
        let usual =
            if steps.is_empty() { 0.0 } else { *steps.select_nth_unstable_by(middle, f64::total_cmp).1 };
        let doubts = self.table.doubtful().map(ToString::to_string).collect();
        Ok(Timetable { times, columns, usual, doubts })
    }
}

impl Timetable {
    /// The readings at a time, in the order in which they were asked for.
    ///
    /// # Errors
    /// A time outside of the table or in a gap of it, or an angle that turns too far in one step; in words.
    pub fn at(&self, time: f64, into: &mut [f64]) -> Result<(), String> {
        let (row, share) = self.place(time)?;
        for (value, (_, quantity, column)) in into.iter_mut().zip(&self.columns) {
            *value = column[row];
            if share > 0.0 {
                *value += share * self.step(row, *quantity, column)?;
            }
        }
        Ok(())
    }

    /// The joints and inputs whose readings it has.
    pub fn readings(&self) -> impl Iterator<Item = SymbolId> + '_ {
        self.columns.iter().map(|(id, ..)| *id)
    }

    /// The row at or before a time, and how far the time is on the way to the next.
    fn place(&self, time: f64) -> Result<(usize, f64), String> {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else {
            unreachable!("a table without rows is refused when it is read")
        };
        if !(*first..=*last).contains(&time) {
            return Err(format!("the readings are those of {first} s to {last} s"));
        }
        let after = self.times.partition_point(|row| *row <= time);
        let row = after - 1;
        let Some(next) = self.times.get(after).filter(|_| self.times[row] < time) else {
            return Ok((row, 0.0));
        };
        let step = next - self.times[row];
        if step > GAP * self.usual {
            let (from, usual) = (self.times[row], self.usual);
            return Err(format!(
                "the readings have a gap there, from {from} s to {next} s, where they usually come every {usual:.3e} s"
            ));
        }
        Ok((row, (time - self.times[row]) / step))
    }

    /// What is added from a row to the next; of an angle, the short way round.
    fn step(&self, row: usize, quantity: Quantity, column: &[f64]) -> Result<f64, String> {
        let step = column[row + 1] - column[row];
        if quantity != Quantity::Angle {
            return Ok(step);
        }
        let step = step - TAU * (step / TAU).round();
        if step.abs() > FARTHEST {
            let (from, to) = (self.times[row], self.times[row + 1]);
            return Err(format!(
                "an angle turns by {:.1}° from {from} s to {to} s, which may be the other way round: readings must come more often",
                step.to_degrees()
            ));
        }
        Ok(step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(times: &[f64], quantity: Quantity, column: &[f64]) -> Timetable {
        let columns = vec![(SymbolId(1), quantity, column.to_vec())];
        Timetable { times: times.to_vec(), columns, usual: times[1] - times[0], doubts: Vec::new() }
    }

    fn at(table: &Timetable, time: f64) -> Result<f64, String> {
        let mut value = [f64::NAN];
        table.at(time, &mut value).map(|()| value[0])
    }

    #[test]
    fn angles_go_the_short_way_round_and_other_readings_straight() {
        let [a, b] = [359_f64.to_radians(), 1_f64.to_radians()];
        let turning = table(&[10.0, 11.0], Quantity::Angle, &[a, b]);
        let halfway = at(&turning, 10.5).expect("within");
        assert!((halfway - TAU).abs() < 1e-12, "{halfway}");
        let back = at(&table(&[10.0, 11.0], Quantity::Angle, &[b, a]), 10.25).expect("within");
        assert!((back - 0.5_f64.to_radians()).abs() < 1e-12, "{back}");
        // Many turns that were counted stay counted.
        let counted = at(&table(&[0.0, 1.0], Quantity::Angle, &[20.0, 20.5]), 0.5).expect("within");
        assert!((counted - 20.25).abs() < 1e-12, "{counted}");
        let length = at(&table(&[10.0, 11.0], Quantity::Length, &[a, b]), 10.5).expect("within");
        assert!((length - 180_f64.to_radians()).abs() < 1e-12, "{length}");
    }

    #[test]
    fn nothing_is_read_beyond_the_ends_in_a_gap_or_where_an_angle_turns_too_far() {
        let wide = table(&[0.0, 1.0, 2.0, 13.0, 14.0], Quantity::Angle, &[0.0, 0.1, 0.2, 0.3, 2.5]);
        assert_eq!(at(&wide, 0.0), Ok(0.0));
        assert_eq!(at(&wide, 14.0), Ok(2.5));
        for (time, wanted) in [
            (-1e-9, "0 s to 14 s"),
            (14.001, "0 s to 14 s"),
            (f64::NAN, "0 s to 14 s"),
            (2.5, "a gap there, from 2 s to 13 s"),
            (13.5, "turns by 126.1°"),
        ] {
            let why = at(&wide, time).expect_err("refused");
            assert!(why.contains(wanted), "{time}: {why}");
        }
        // Where rows stand, nothing lies between.
        assert_eq!(at(&wide, 2.0), Ok(0.2));
        assert_eq!(at(&wide, 13.0), Ok(0.3));
    }
}
