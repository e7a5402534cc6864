//! Data files of a plan, read into observations.

use std::collections::BTreeMap;
use std::io::Read;

use model_core::{SymbolId, exact};
use nalgebra::Vector3;

use super::plan::{ColumnPlan, Plan, Reading, SourcePlan};
use super::written::Kind;
use crate::data::{Observations, Series, UNSTATED, direction_from_offset, direction_from_spherical};
use crate::formats::{self, Cells, DataError, TableReader, Wanted, find_column};

/// Opens a data file of a study by its path as the study writes it.
pub type Open<'a> = dyn FnMut(&str) -> Result<Box<dyn Read>, DataError> + 'a;

/// How far from one the length of a unit vector may be in a file: written with three digits.
const UNIT_TOLERANCE: f64 = 2e-3;

/// The columns of one source as numbers and labels, in the order of [`Columns`].
struct Rows {
    numbers: Vec<Vec<f64>>,
    labels: Vec<Vec<String>>,
    row_numbers: Vec<u64>,
}

/// Which of the numbers read is what.
struct Columns {
    plans: Vec<ColumnPlan>,
    readings: Vec<(SymbolId, usize)>,
    observed: std::ops::Range<usize>,
    sigma: std::ops::Range<usize>,
    times: Vec<(String, usize)>,
    labels: Vec<String>,
}

impl Plan {
    /// Reads all data files.
    ///
    /// Row numbers count on through the files of one source. Rows are brought into order of acquisition if the study
    /// names a column for it.
    ///
    /// # Errors
    /// What is wrong with a file, with its place.
    pub fn observations(&self, open: &mut Open<'_>) -> Result<Observations, DataError> {
        let mut all = Observations {
            in_sequence: self.order.is_some() || self.search.sequence,
            ..Observations::default()
        };
        let mut groups = BTreeMap::new();
        for source in &self.sources {
            self.append(&mut all, source, &source.paths, open, &mut groups)?;
        }
        Ok(all)
    }

    /// Reads the file held out, as the first source's files are; `None` if the study names none.
    ///
    /// # Errors
    /// What is wrong with the file, with its place.
    pub fn held_out(&self, open: &mut Open<'_>) -> Result<Option<Observations>, DataError> {
        let (Some(path), Some(source)) = (&self.hold_out.file, self.sources.first()) else {
            return Ok(None);
        };
        let mut all = Observations {
            in_sequence: self.order.is_some() || self.search.sequence,
            ..Observations::default()
        };
        self.append(&mut all, source, std::slice::from_ref(path), open, &mut BTreeMap::new())?;
        Ok(Some(all))
    }

    fn append(
        &self,
        all: &mut Observations,
        source: &SourcePlan,
        paths: &[String],
        open: &mut Open<'_>,
        groups: &mut BTreeMap<Vec<String>, u32>,
    ) -> Result<(), DataError> {
        let columns = Columns::of(self, source);
        let mut rows = Rows {
            numbers: vec![Vec::new(); columns.plans.len()],
            labels: vec![Vec::new(); columns.labels.len()],
            row_numbers: Vec::new(),
        };
        for path in paths {
            let reader = open(path)?;
            rows.append(&mut *formats::open(reader, path, &self.format)?, &columns)?;
        }
        let file = paths.join(", ");
        if rows.row_numbers.is_empty() {
            return Err(DataError::NoRows { file });
        }
        if self.order.is_some() {
            // The column of the order is the last label.
            rows.sort_by_label(columns.labels.len() - 1);
        }
        let start = all.rows();
        let count = rows.row_numbers.len();
        let readings = self.readings(source, &columns, &rows);
        let measured = self.measured(source, &columns, &rows, &readings, &file)?;
        for (id, values) in readings {
            match all.columns.binary_search_by_key(&id, |(known, _)| *known) {
                Ok(at) => all.columns[at].1.extend(values),
                Err(at) => {
                    let mut padded = vec![0.0; start];
                    padded.extend(values);
                    all.columns.insert(at, (id, padded));
                }
            }
        }
        for (_, values) in &mut all.columns {
            // A source that does not have the column has no use for it either.
            values.resize(start + count, 0.0);
        }
        all.measured.extend(measured);
        if !columns.sigma.is_empty() {
            all.sigma.resize(start, UNSTATED);
            all.sigma.extend(sigma(&columns, &rows, &file)?);
        } else if !all.sigma.is_empty() {
            all.sigma.resize(start + count, UNSTATED);
        }
        let grouping = columns.labels.len() - usize::from(self.order.is_some());
        for row in 0..count {
            let group = if grouping == 0 {
                u32::try_from(start + row).unwrap_or(u32::MAX)
            } else {
                let label = rows.labels.iter().take(grouping).map(|labels| labels[row].clone()).collect();
                let next = u32::try_from(groups.len()).unwrap_or(u32::MAX);
                *groups.entry(label).or_insert(next)
            };
            all.groups.push(group);
        }
        all.row_numbers.extend(&rows.row_numbers);
        all.series.push(Series {
            observable: source.observable,
            measure: source.measure,
            rows: start..start + count,
            source: file,
        });
        Ok(())
    }

    /// The readings of joints and inputs, derived ones included.
    fn readings(&self, source: &SourcePlan, columns: &Columns, rows: &Rows) -> Vec<(SymbolId, Vec<f64>)> {
        let number = |at: usize| rows.numbers.get(at).cloned().unwrap_or_default();
        let read: Vec<(SymbolId, Vec<f64>)> =
            columns.readings.iter().map(|&(id, at)| (id, number(at))).collect();
        let named = |name: &str| {
            let id = self.chain.find_symbol(name);
            let of_symbol =
                read.iter().find(|(known, _)| Some(*known) == id).map(|(_, values)| values.clone());
            of_symbol
                .or_else(|| columns.times.iter().find(|(time, _)| time == name).map(|&(_, at)| number(at)))
        };
        let derived = source.readings.iter().filter_map(|(id, reading)| {
            let Reading::Derived(derived) = reading else { return None };
            Some((*id, derived.values(named)?))
        });
        let mut all: Vec<_> = read.iter().cloned().chain(derived).collect();
        all.sort_by_key(|(id, _)| *id);
        all
    }

    fn measured(
        &self,
        source: &SourcePlan,
        columns: &Columns,
        rows: &Rows,
        readings: &[(SymbolId, Vec<f64>)],
        file: &str,
    ) -> Result<Vec<[f64; 3]>, DataError> {
        let observed: Vec<&[f64]> =
            columns.observed.clone().filter_map(|at| rows.numbers.get(at).map(Vec::as_slice)).collect();
        let at = |component: usize, row: usize| observed.get(component).map_or(0.0, |values| values[row]);
        let impossible = |row: usize, why: String| DataError::Impossible {
            file: file.to_string(),
            row: rows.row_numbers[row],
            why,
        };
        let mut values = self.chain.nominal_values();
        let path = exact::Path::new(&self.chain, source.observable);
        (0..rows.row_numbers.len())
            .map(|row| match source.kind {
                Kind::Direction => {
                    let vector = Vector3::new(at(0, row), at(1, row), at(2, row));
                    let length = vector.norm();
                    if (length - 1.0).abs() > UNIT_TOLERANCE {
                        let why = format!("x, y, z is no unit vector: its length is {length:.6}");
                        return Err(impossible(row, why));
                    }
                    Ok((vector / length).into())
                }
                Kind::Spherical if observed.len() == 1 => Ok([at(0, row), 0.0, 0.0]),
                Kind::Spherical => {
                    let elevation = at(1, row);
                    if elevation.abs() > std::f64::consts::FRAC_PI_2 * (1.0 + 1e-9) {
                        let why = format!(
                            "an elevation of {:.1} deg is beyond the zenith: are the unit and the order of the columns right?",
                            elevation.to_degrees()
                        );
                        return Err(impossible(row, why));
                    }
                    Ok(direction_from_spherical(at(0, row), elevation).into())
                }
                Kind::Offset => {
                    for (id, readings) in readings {
                        values[id.index()] = readings[row];
                    }
                    let nominal = path.value(&values).normalize();
                    if !nominal.iter().all(|component| component.is_finite()) {
                        return Err(impossible(row, "the chain has no direction at these readings".to_string()));
                    }
                    Ok(direction_from_offset(&nominal, at(0, row), at(1, row)).into())
                }
                Kind::Point => Ok([at(0, row), at(1, row), at(2, row)]),
                Kind::Range if at(0, row) < 0.0 => {
                    Err(impossible(row, format!("a range of {} m is negative", at(0, row))))
                }
                Kind::Range => Ok([at(0, row), 0.0, 0.0]),
            })
            .collect()
    }
}

/// Standard uncertainties of the components of each row.
fn sigma(columns: &Columns, rows: &Rows, file: &str) -> Result<Vec<[f64; 3]>, DataError> {
    let stated: Vec<&Vec<f64>> = columns.sigma.clone().filter_map(|at| rows.numbers.get(at)).collect();
    (0..rows.row_numbers.len())
        .map(|row| {
            let of = |component: usize| stated[component.min(stated.len() - 1)][row];
            let sigma = [of(0), of(1), of(2)];
            if sigma.iter().all(|&sigma| sigma > 0.0) {
                return Ok(sigma);
            }
            let why = "a standard uncertainty must be positive".to_string();
            Err(DataError::Impossible { file: file.to_string(), row: rows.row_numbers[row], why })
        })
        .collect()
}

impl Columns {
    fn of(plan: &Plan, source: &SourcePlan) -> Self {
        let mut plans: Vec<ColumnPlan> = Vec::new();
        let mut readings = Vec::new();
        for (id, reading) in &source.readings {
            if let Reading::Column(column) = reading {
                readings.push((*id, plans.len()));
                plans.push(column.clone());
            }
        }
        let observed = plans.len()..plans.len() + source.observed.len();
        plans.extend(source.observed.iter().cloned());
        let sigma = plans.len()..plans.len() + source.sigma.len();
        plans.extend(source.sigma.iter().cloned());
        // Names in derivations that are no joint or input of the chain are columns of the file: a time.
        let mut times = Vec::new();
        for (_, reading) in &source.readings {
            let names = match reading {
                Reading::Derived(derived) => derived.columns(),
                Reading::Column(_) => Vec::new(),
            };
            for name in names {
                let of_symbol = plan
                    .chain
                    .find_symbol(name)
                    .is_some_and(|id| readings.iter().any(|(known, _)| *known == id));
                if !of_symbol && !times.iter().any(|(known, _)| known == name) {
                    times.push((name.to_owned(), plans.len()));
                    let quantity = model_core::Quantity::Number;
                    plans.push(ColumnPlan { name: name.to_owned(), unit: None, quantity, declared: true });
                }
            }
        }
        let labels = plan.group.iter().chain(&plan.order).cloned().collect();
        Self { plans, readings, observed, sigma, times, labels }
    }

    fn wanted(&self, reader: &dyn TableReader) -> Result<Vec<Wanted>, DataError> {
        let (header, file) = (reader.header(), reader.source());
        let number = |plan: &ColumnPlan| {
            let column = find_column(header, &plan.name, file)?;
            let factor = header[column].factor(plan.quantity, plan.unit, plan.declared, file)?;
            Ok(Wanted { column, factor: Some(factor) })
        };
        let label = |name: &String| Ok(Wanted { column: find_column(header, name, file)?, factor: None });
        self.plans.iter().map(number).chain(self.labels.iter().map(label)).collect()
    }
}

impl Rows {
    /// Appends all rows of one file.
    fn append(&mut self, reader: &mut dyn TableReader, columns: &Columns) -> Result<(), DataError> {
        let wanted = columns.wanted(reader)?;
        let chunk = reader.read(&wanted, usize::MAX)?;
        let before = self.row_numbers.last().copied().unwrap_or_default();
        self.row_numbers.extend(chunk.rows.iter().map(|row| before + row));
        let (mut numbers, mut labels) = (self.numbers.iter_mut(), self.labels.iter_mut());
        for cells in chunk.columns {
            match cells {
                Cells::Numbers(values) => {
                    numbers.next().into_iter().for_each(|column| column.extend(&values))
                }
                Cells::Labels(values) => {
                    labels.next().into_iter().for_each(|column| column.extend(values.iter().cloned()));
                }
            }
        }
        Ok(())
    }

    /// Brings the rows into the order of a label: by number if all are numbers, else by text. Equal rows keep theirs.
    fn sort_by_label(&mut self, label: usize) {
        let Some(labels) = self.labels.get(label) else { return };
        let numbers: Option<Vec<f64>> = labels.iter().map(|label| label.parse().ok()).collect();
        let mut order: Vec<usize> = (0..labels.len()).collect();
        match numbers {
            Some(numbers) => order.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b])),
            None => order.sort_by(|&a, &b| labels[a].cmp(&labels[b])),
        }
        for column in &mut self.numbers {
            *column = order.iter().map(|&row| column[row]).collect();
        }
        for column in &mut self.labels {
            *column = order.iter().map(|&row| column[row].clone()).collect();
        }
        self.row_numbers = order.iter().map(|&row| self.row_numbers[row]).collect();
    }
}
