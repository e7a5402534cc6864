//! Where the readings of points come from: a dimension of each point, or a table by time.

use model_core::{Chain, Quantity, SymbolId};
use rayon::prelude::*;
use service::readings::factor_of;
use tables::formats::{DataError, declared_columns, find_reading};
use tables::units::Plausible;

use super::by_time::{Opened, Timetable};
use super::dimensions::{Dimension, TIME};
use super::points::{Cloud, Points};
use crate::failure::Failure;
use crate::table_files;
use model_core::names::listed;

/// Points whose readings one processor gathers at a time.
const PIECE: usize = 1 << 13;

/// A reading that stands in each point.
struct InPoint {
    symbol: SymbolId,
    dimension: Dimension,
    /// Takes it to SI.
    factor: f64,
    /// Its name, for messages.
    name: String,
    /// How large it may be, where nothing says its unit.
    plausible: Option<Plausible>,
}

/// Readings of joints and inputs, a column each.
pub type Columns = Vec<(SymbolId, Vec<f64>)>;

/// Columns of the readings of consecutive points; or which point has not all, and why.
type Piece = Result<Vec<Vec<f64>>, (usize, String)>;

/// Where the readings of a chain come from.
pub struct Readings {
    in_points: Vec<InPoint>,
    by_time: Option<(Dimension, Timetable)>,
    has_standard_time: bool,
    record_length: usize,
}

impl Readings {
    /// Finds each of these joints and inputs in the points or in the table.
    ///
    /// # Errors
    /// One that is in neither, or in both; a dimension that is no number, or whose unit is none or measures something else; a
    /// table that cannot be read.
    pub fn of(
        cloud: &Cloud,
        table: Option<Opened<'_>>,
        chain: &Chain,
        wanted: &[SymbolId],
    ) -> Result<Self, Failure> {
        let declared = declared_columns(chain);
        let declared: Vec<&str> = declared.iter().map(String::as_str).collect();
        let (names, file) = (&cloud.dimensions.names, cloud.name());
        let (mut in_points, mut in_table) = (Vec::new(), Vec::new());
        for &symbol in wanted {
            let name = &chain.symbol(symbol).name;
            let in_both = table.as_ref().is_some_and(|table| table.has(symbol) && !table.is_time(symbol));
            let at = match find_reading(names, name, &declared, &file) {
                Ok(at) => at,
                Err(DataError::MissingColumn { .. })
                    if table.as_ref().is_some_and(|table| table.has(symbol)) =>
                {
                    in_table.push(symbol);
                    continue;
                }
                Err(DataError::MissingColumn { .. }) => return Err(missing(cloud, table.as_ref(), name)),
                Err(other) => return Err(table_files::failure(other)),
            };
            if let Some(table) = table.as_ref().filter(|_| in_both) {
                return Err(cloud.wrong(format_args!(
                    "its points have a dimension `{}`, and {} a column of that name: take one away, or rename it",
                    names[at].full,
                    table.name()
                )));
            }
            let dimension = cloud.dimensions.dimensions[at].clone();
            let dimension = dimension.map_err(|why| {
                cloud.wrong(format_args!("`{name}` cannot be read of dimension `{}`: {why}", names[at].full))
            })?;
            let (factor, is_bare) =
                factor_of(&names[at], chain.symbol(symbol), &file).map_err(table_files::failure)?;
            let plausible = is_bare.then(|| Plausible::readings(chain, symbol));
            in_points.push(InPoint { symbol, dimension, factor, name: names[at].full.clone(), plausible });
        }
        let by_time = match table {
            Some(table) if in_table.is_empty() => {
                return Err(Failure::Input(format!(
                    "{}: no reading is missing that this table could bring: leave --readings out",
                    table.name()
                )));
            }
            Some(table) => {
                let time = names.iter().position(|column| column.full == TIME);
                let Some(Ok(time)) = time.map(|at| cloud.dimensions.dimensions[at].clone()) else {
                    return Err(cloud.wrong(format_args!(
                        "its points (format {}) have no GPS time to find their readings by in {}",
                        cloud.header.format,
                        table.name()
                    )));
                };
                Some((time, table.read(&in_table)?))
            }
            None => None,
        };
        let has_standard_time = cloud.header.has_standard_time();
        Ok(Self { in_points, by_time, has_standard_time, record_length: cloud.header.record_length })
    }

    /// The readings of some points, in SI.
    ///
    /// # Errors
    /// A point without a reading, or with one that is not finite; a time that the table cannot serve.
    pub fn columns(&self, cloud: &Cloud, points: &Points) -> Result<Columns, Failure> {
        let long = self.record_length;
        let pieces: Vec<Piece> = points
            .bytes
            .par_chunks(PIECE * long)
            .enumerate()
            .map(|(piece, bytes)| {
                let at = |(row, why)| (piece * PIECE + row, why);
                self.piece(bytes).map_err(at)
            })
            .collect();
        let from_table = self.by_time.iter().flat_map(|(_, table)| table.readings());
        let symbols = self.in_points.iter().map(|reading| reading.symbol).chain(from_table);
        let mut columns: Columns = symbols.map(|symbol| (symbol, Vec::new())).collect();
        for piece in pieces {
            let piece = piece.map_err(|(row, why)| {
                cloud.wrong(format_args!("point {}: {why}", points.first + row as u64))
            })?;
            columns.iter_mut().zip(piece).for_each(|((_, column), more)| column.extend(more));
        }
        Ok(columns)
    }

    /// The readings of these points; or the first one that has not all.
    fn piece(&self, bytes: &[u8]) -> Piece {
        let mut columns = Vec::new();
        let points = || bytes.chunks_exact(self.record_length).enumerate();
        for InPoint { dimension, factor, name, .. } in &self.in_points {
            let value = |(row, point)| match dimension.value(point) {
                Some(value) if value.is_finite() => Ok(value * factor),
                Some(value) => Err((row, format!("dimension `{name}` is {value}, which is no reading"))),
                None => Err((row, format!("dimension `{name}` has no value there"))),
            };
            columns.push(points().map(value).collect::<Result<Vec<f64>, _>>()?);
        }
        if let Some((time, table)) = &self.by_time {
            let mut values = vec![0.0; table.readings().count()];
            let mut more = vec![Vec::new(); values.len()];
            for (row, point) in points() {
                let time = time.value(point);
                let time = time.ok_or_else(|| (row, format!("dimension `{TIME}` has no value there")))?;
                table.at(time, &mut values).map_err(|why| (row, self.not_served(time, &why)))?;
                more.iter_mut().zip(&values).for_each(|(column, value)| column.push(*value));
            }
            columns.extend(more);
        }
        Ok(columns)
    }

    fn not_served(&self, time: f64, why: &str) -> String {
        let kind = if self.has_standard_time {
            "GPS time less 10⁹ s, by its header"
        } else {
            "seconds of the GPS week, by its header"
        };
        format!("its time is {time} s ({kind}); {why}")
    }

    /// By how much each reading that stands in these points may differ from what was meant, its type being no finer; those that
    /// are as fine as can be left out.
    pub fn steps(&self, points: &Points) -> Columns {
        let of = |reading: &InPoint| {
            let step = |point: &[u8]| {
                let Some(value) = reading.dimension.value(point) else {
                    unreachable!("each point has shown its readings")
                };
                reading.dimension.step(value) * reading.factor
            };
            let column: Vec<f64> = points.bytes.chunks_exact(self.record_length).map(step).collect();
            (reading.symbol, column)
        };
        let is_coarse = |(_, column): &(SymbolId, Vec<f64>)| column.iter().any(|step| *step > 0.0);
        self.in_points.iter().map(of).filter(is_coarse).collect()
    }

    /// What is to be doubted of the units of these readings, in words.
    pub fn doubts(&self, chain: &Chain, columns: &Columns) -> Vec<String> {
        let mut doubts = Vec::new();
        for reading in &self.in_points {
            let quantity = chain.symbol(reading.symbol).quantity;
            let column =
                columns.iter().find(|(symbol, _)| *symbol == reading.symbol).map(|(_, column)| column);
            let refused = |number: &&f64| {
                reading.plausible.is_some_and(|plausible| plausible.refuses(quantity, **number))
            };
            if let Some(number) = column.and_then(|column| column.iter().find(refused)) {
                let (name, si) = (&reading.name, quantity.unit());
                let likely = if quantity == Quantity::Angle { "deg" } else { "mm" };
                doubts.push(format!(
                    "dimension `{name}` reaches {number} and has no unit, and was taken as {si}: a unit stands in its name or its \
                     description, as `[{likely}]`"
                ));
            }
        }
        doubts.extend(self.by_time.iter().flat_map(|(_, table)| table.doubts.iter().cloned()));
        doubts
    }
}

/// A reading that is nowhere, with what there is.
fn missing(cloud: &Cloud, table: Option<&Opened<'_>>, name: &str) -> Failure {
    let names = &cloud.dimensions.names;
    let near = model_core::names::nearest(name, names.iter().map(|column| column.stem.as_str()))
        .and_then(|stem| names.iter().find(|column| column.stem == stem));
    let near = near.map_or_else(String::new, |near| format!("did you mean `{}`? ", near.full));
    let there = listed(names.iter().map(|column| column.full.as_str()));
    let not_described = match cloud.dimensions.not_described {
        0 => String::new(),
        bytes => format!(", and {bytes} bytes that no record describes"),
    };
    let elsewhere = match table {
        Some(table) => format!("; {} has {}", table.name(), table.columns()),
        None => "; --readings brings readings from a table by time".to_owned(),
    };
    cloud
        .wrong(format_args!("no dimension `{name}`: {near}its points have {there}{not_described}{elsewhere}"))
}
