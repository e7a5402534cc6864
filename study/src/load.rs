//! Data files of a plan, read into observations.

use model_core::{SymbolId, exact};

use super::cells::RowCells;
use super::columns::Columns;
use super::labels::{Numbered, number};
use super::order::{not_understood, set_back, times};
use super::plan::{Plan, Reading, SourcePlan};
use super::ranges::check_ranges;
use super::repeated::{fitted_as_well, without_repeats};
use super::rows::Rows;
use super::sample::Sample;
use super::stated::{of_components, of_pairs, of_readings};
use super::trajectory::{Joining, TrajectoryPlan};
use network::{Remark, StartError, check_named, check_scale, place};
use observe::orientation::Turned;
use observe::{Measured, Observations, Series};
use tables::formats::{self, DataError, Input, TableReader, clipped};
use tables::units::BareColumn;

/// Opens a data file of a study by its path as the study writes it.
pub type Open<'a> = dyn FnMut(&str) -> Result<Input<'static>, DataError> + 'a;

/// Opens a table of a study by its name, read as the study says.
pub type OpenTable<'a> =
    dyn FnMut(&str, &formats::Options) -> Result<Box<dyn TableReader + 'a>, DataError> + 'a;

/// What the data files of a plan hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Loaded {
    /// The observations to calibrate with.
    pub observations: Observations,
    /// Those of the file held out, if the study names one.
    pub held_out: Option<Observations>,
    /// Columns that were taken as SI, since nothing says their unit, and whose numbers are hardly in SI.
    pub doubtful: Vec<BareColumn>,
    /// What is doubtful of rows.
    pub remarks: Vec<Remark>,
    /// What is doubtful of whole files.
    pub of_files: Vec<String>,
    /// Some of the rows as the files have them, to be read otherwise.
    pub sample: Sample,
}

impl Loaded {
    /// The same without rows that repeat others number by number; how many they were stands among the remarks.
    #[must_use]
    pub fn without_repeats(self) -> Self {
        let (observations, repeated) = without_repeats(self.observations);
        let remarks = repeated.into_iter().chain(self.remarks).collect();
        Self { observations, remarks, ..self }
    }
}

/// What is doubtful of the files while they are read.
#[derive(Default)]
struct Doubtful {
    columns: Vec<BareColumn>,
    of_files: Vec<String>,
}

/// Appends values; to nothing without a copy.
fn append<T>(all: &mut Vec<T>, values: Vec<T>) {
    if all.is_empty() { *all = values } else { all.extend(values) }
}

impl Plan {
    /// Reads all data files.
    ///
    /// Row numbers count on through the files of one source. Rows are brought into order of acquisition if the study
    /// names a column for it.
    ///
    /// # Errors
    /// What is wrong with a file, with its place.
    pub fn load(&self, open: &mut Open<'_>) -> Result<Loaded, DataError> {
        self.load_tables(&mut |path, options| formats::open(open(path)?, path, options))
    }

    /// Reads all tables, wherever they are, as [`Plan::load`] does.
    ///
    /// # Errors
    /// What is wrong with a table, with its place.
    pub fn load_tables(&self, open: &mut OpenTable<'_>) -> Result<Loaded, DataError> {
        let (mut doubtful, mut sample) = (Doubtful::default(), Sample::default());
        let mut read =
            |plan: &TrajectoryPlan| Joining::read(plan, &mut *open(&plan.path, &self.format)?, &self.format);
        let joining = self.trajectory.as_ref().map(&mut read).transpose()?;
        let open: &mut OpenTable<'_> =
            &mut |path, options| Joining::table(joining.as_ref(), open(path, options)?);
        let mut observations = self.no_observations();
        let mut groups = Numbered::default();
        for source in &self.sources {
            let columns = Columns::of(self, source);
            let paths = &source.paths;
            let mut rows = self.rows(&mut observations, source, paths, open, &columns, &mut doubtful)?;
            sample.take(&columns, &rows, self.object_numbers(source, &rows).as_deref());
            self.observe(&mut observations, source, &columns, &mut rows, &mut groups)?;
        }
        let held_out = match (&self.hold_out.file, self.sources.first()) {
            // The file held out is read as the first source's files are.
            (Some(path), Some(source)) => {
                let mut all = self.no_observations();
                let (paths, columns) = (std::slice::from_ref(path), Columns::of(self, source));
                let mut rows = self.rows(&mut all, source, paths, open, &columns, &mut doubtful)?;
                self.observe(&mut all, source, &columns, &mut rows, &mut Numbered::default())?;
                let fitted = fitted_as_well(&all, &observations);
                if 2 * fitted > all.rows() {
                    let (file, rows) = (path.clone(), all.rows());
                    return Err(DataError::NotHeldOut { file, fitted, rows });
                }
                Some(all)
            }
            _ => None,
        };
        let remarks = self
            .place_objects(&mut observations)
            .map_err(|error| DataError::NotPlaced { why: error.to_string() })?;
        let Doubtful { columns: doubtful, of_files } = doubtful;
        Ok(Loaded { observations, held_out, doubtful, remarks, of_files, sample })
    }

    pub(super) fn no_observations(&self) -> Observations {
        let in_sequence = self.order.is_some() || self.search.sequence;
        Observations { in_sequence, ..Observations::default() }
    }

    /// The rows of the files of a source, in their order.
    fn rows(
        &self,
        all: &mut Observations,
        source: &SourcePlan,
        paths: &[String],
        open: &mut OpenTable<'_>,
        columns: &Columns,
        doubtful: &mut Doubtful,
    ) -> Result<Rows, DataError> {
        let mut rows = Rows::of(columns, paths);
        for path in paths {
            let file = all.origins.file(path);
            let mut reader = open(path, &self.format)?;
            doubtful.of_files.extend(reader.remarks());
            rows.append((self, source), &mut *reader, file, columns, &mut doubtful.columns)?;
        }
        if rows.row_numbers.is_empty() {
            return Err(DataError::NoRows { file: rows.file });
        }
        if let Some(order) = &self.order {
            // The column of the order is the last label.
            let at = columns.labels.len() - 1;
            if let Some((row, why)) = not_understood(&rows.labels[at]) {
                let (line, row_number) = (rows.places.line(row), rows.number(row));
                let why = format!("column `{order}`: `{}` {why}", clipped(&rows.labels[at][row]));
                return Err(DataError::Impossible { file: rows.file, line, row: row_number, why });
            }
            if let Some((row, seconds)) = set_back(&rows.labels[at]) {
                doubtful.of_files.push(format!(
                    "{}: row {}: `{order}` goes back by {:.0} min, as clocks do where summer time ends, and no zone is stated. Write the zone \
                     behind each time: `+02:00` before that row, `+01:00` from it on.",
                    rows.file,
                    rows.number(row),
                    seconds / 60.0
                ));
            }
            rows.sort_by_label(at);
        }
        let before = rows.row_numbers.len();
        rows.shift(columns);
        if rows.row_numbers.is_empty() {
            return Err(DataError::ShiftedAway { file: rows.file, rows: before });
        }
        Ok(rows)
    }

    /// Appends what the rows of a source observe.
    pub(super) fn observe(
        &self,
        all: &mut Observations,
        source: &SourcePlan,
        columns: &Columns,
        rows: &mut Rows,
        numbered: &mut Numbered,
    ) -> Result<(), DataError> {
        let file = rows.file.clone();
        let converted = columns.readings.iter().filter(|(_, at)| !rows.in_si[*at]).map(|(id, _)| *id);
        all.converted.extend(converted);
        let start = all.rows();
        let count = rows.row_numbers.len();
        if u32::try_from(start + count).is_err() {
            return Err(DataError::TooManyRows { file });
        }
        let readings = self.readings(source, columns, rows, &file)?;
        check_ranges(&self.chain, source, &readings, rows, &file)?;
        append(&mut all.measured, self.measured(source, columns, rows, &readings, &file)?);
        // Of many rows these are most of what is held.
        rows.numbers[columns.observed.clone()].fill_with(Vec::new);
        // A source that does not have a column has no use for it either; and a reading that states nothing is exact.
        append_columns(&mut all.poses.columns, start, count, readings);
        append_columns(&mut all.reading_sigma, start, count, of_readings(source, columns, rows, &file)?);
        append_columns(&mut all.reading_correlation, start, count, of_pairs(source, columns, rows, &file)?);
        if !columns.sigma.is_empty() {
            all.sigma.resize(start, None);
            all.sigma.extend(of_components(columns, rows, &file)?.into_iter().map(Some));
        } else if !all.sigma.is_empty() {
            all.sigma.resize(start + count, None);
        }
        let grouping = self.group.len();
        self.append_objects(all, source, rows, start);
        if grouping == 0 {
            all.groups.extend((start as u32..).take(count));
        } else {
            all.groups.extend(number(&mut numbered.groups, &rows.labels[..grouping], count));
        }
        let own = self.hold_out.together.len();
        if own > 0 {
            let end = columns.labels.len() - usize::from(self.order.is_some());
            all.together.extend(number(&mut numbered.together, &rows.labels[end - own..end], count));
        }
        if !self.target.is_empty() {
            let end = columns.labels.len() - usize::from(self.order.is_some()) - own;
            let labels = &rows.labels[end - self.target.len()..end];
            all.targets.extend(number(&mut numbered.targets, labels, count));
        }
        all.row_numbers.extend(rows.row_numbers.iter());
        all.origins.extend(
            &rows.places,
            self.id.as_ref().and_then(|_| rows.labels.get(grouping)).map(Vec::as_slice),
        );
        all.poses.series.push(Series {
            observable: source.observable,
            measure: source.measure,
            rows: start..start + count,
            source: file,
        });
        Ok(())
    }

    /// Says where objects and stations are to start.
    fn place_objects(&self, observations: &mut Observations) -> Result<Vec<Remark>, StartError> {
        let Some(unknowns) = &observations.unknowns else { return Ok(Vec::new()) };
        let stations = self.places.stations.iter().map(|station| station.label.as_str());
        let objects = self.places.objects.iter().map(|object| object.label.as_str());
        let unseen = check_named(unknowns, stations, objects)?;
        check_scale(&self.chain, observations, &self.fit)?;
        let remarks = place(&self.chain, observations, &self.fit.start)?;
        Ok(unseen.into_iter().chain(remarks).collect())
    }

    /// The readings of joints and inputs, derived ones included; those that were read are taken out of the rows.
    fn readings(
        &self,
        source: &SourcePlan,
        columns: &Columns,
        rows: &mut Rows,
        file: &str,
    ) -> Result<Vec<(SymbolId, Vec<f64>)>, DataError> {
        // Each has a place of its own among the numbers.
        let taken = |&(id, at): &(SymbolId, usize)| (id, std::mem::take(&mut rows.numbers[at]));
        let mut all: Vec<(SymbolId, Vec<f64>)> = columns.readings.iter().map(taken).collect();
        let elapses = self.ordered_times(source, rows, file)?;
        let named = |name: &str| {
            let id = self.chain.find_symbol(name);
            let of_symbol = all.iter().find(|(known, _)| Some(*known) == id).map(|(_, values)| values);
            let time = || columns.times.iter().find(|(time, _)| time == name);
            let of_order = || elapses.as_ref().filter(|_| self.order.as_deref() == Some(name));
            of_symbol.or_else(|| time().map(|&(_, at)| &rows.numbers[at])).or_else(of_order).cloned()
        };
        let derived = source.readings.iter().filter_map(|(id, reading)| {
            match reading {
                Reading::Derived(derived) => Some((*id, derived.values(named)?)),
                // Until the objects have places.
                Reading::Sighted => Some((*id, vec![1.0; rows.row_numbers.len()])),
                Reading::Column(_) => None,
            }
        });
        let derived: Vec<_> = derived.collect();
        all.extend(derived);
        all.sort_by_key(|(id, _)| *id);
        Ok(all)
    }

    /// The times in the column of the order, where an input is derived from them.
    fn ordered_times(
        &self,
        source: &SourcePlan,
        rows: &Rows,
        file: &str,
    ) -> Result<Option<Vec<f64>>, DataError> {
        let (Some(order), Some(labels)) = (self.order.as_deref(), rows.labels.last()) else {
            return Ok(None);
        };
        let follows = |(_, reading): &(SymbolId, Reading)| matches!(reading, Reading::Derived(derived) if derived.columns().contains(&order));
        if !source.readings.iter().any(follows) {
            return Ok(None);
        }
        let times = times(labels).map_err(|row| DataError::Impossible {
            file: file.to_owned(),
            line: rows.places.line(row),
            row: rows.number(row),
            why: format!(
                "column `{order}`: `{}` says no time that an effect could follow (`sequence` under [search]): write seconds, or points in \
                 time (2026-01-31T18:01:00), in every row, or leave `sequence` out",
                clipped(&labels[row])
            ),
        })?;
        if formats::numbers(labels).is_none() {
            return Ok(Some(times));
        }
        let seconds = rows.seconds.clone()?;
        Ok(Some(times.into_iter().map(|time| time * seconds).collect()))
    }

    fn measured(
        &self,
        source: &SourcePlan,
        columns: &Columns,
        rows: &Rows,
        readings: &[(SymbolId, Vec<f64>)],
        file: &str,
    ) -> Result<Vec<Measured>, DataError> {
        let observed: Vec<&[f64]> =
            columns.observed.clone().filter_map(|at| rows.numbers.get(at).map(Vec::as_slice)).collect();
        let impossible = |row: usize, why: String| DataError::Impossible {
            file: file.to_string(),
            line: rows.places.line(row),
            row: rows.number(row),
            why,
        };
        let turned = source.orientation.map(|form| (form, Turned::new(&self.chain, source.observable)));
        let mut cells = RowCells {
            row: 0,
            observed: &observed,
            readings,
            convention: source.convention,
            path: exact::Path::new(&self.chain, source.observable),
            turned,
            values: self.chain.nominal_values(),
        };
        (0..rows.row_numbers.len())
            .map(|row| {
                cells.row = row;
                (source.way.read)(&mut cells).map_err(|why| impossible(row, why))
            })
            .collect()
    }
}

/// Appends the columns of a source, whose rows are `count` behind `start`; zero where a source has none.
fn append_columns<K: Copy + Ord>(
    all: &mut Vec<(K, Vec<f64>)>,
    start: usize,
    count: usize,
    own: Vec<(K, Vec<f64>)>,
) {
    for (id, values) in own {
        match all.binary_search_by_key(&id, |(known, _)| *known) {
            Ok(at) => all[at].1.extend(values),
            Err(at) => {
                let mut padded = vec![0.0; start];
                append(&mut padded, values);
                all.insert(at, (id, padded));
            }
        }
    }
    all.iter_mut().for_each(|(_, values)| values.resize(start + count, 0.0));
}
