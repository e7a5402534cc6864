//! Which columns a source of a plan takes from its files, and where each of them stands.

use model_core::SymbolId;

use super::column_plan::ColumnPlan;
use super::plan::{Plan, Reading, SourcePlan};
use super::uncertain::Uncertain;
use tables::formats::{DataError, Form, TableReader, Wanted, declared_columns, find_column};
use tables::units::{BareColumn, Plausible};

/// Columns whose unit nothing says, each with its place among the numbers.
type PlacedBareColumns = Vec<(usize, BareColumn)>;

/// Which of the numbers read is what.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    pub plans: Vec<ColumnPlan>,
    pub readings: Vec<(SymbolId, usize)>,
    pub observed: std::ops::Range<usize>,
    pub sigma: std::ops::Range<usize>,
    /// Columns that say how uncertain a reading is.
    pub uncertain: Vec<(SymbolId, usize)>,
    /// Columns that say how two readings hang together.
    pub correlated: Vec<([SymbolId; 2], usize)>,
    pub times: Vec<(String, usize)>,
    pub labels: Vec<String>,
}

impl Columns {
    pub fn of(plan: &Plan, source: &SourcePlan) -> Self {
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
        let uncertain = placed(&source.uncertain.sigma, &mut plans);
        let correlated = placed(&source.uncertain.correlated, &mut plans);
        // Names in derivations that are no joint or input of the chain are columns of the file: a time.
        let mut times = Vec::new();
        let derived = source.readings.iter().filter_map(|(_, reading)| match reading {
            Reading::Derived(derived) => Some(derived),
            Reading::Column(_) | Reading::Sighted => None,
        });
        for derived in derived {
            for name in derived.columns() {
                let of_symbol = plan
                    .chain
                    .find_symbol(name)
                    .is_some_and(|id| readings.iter().any(|(known, _)| *known == id));
                // What the rows are ordered by is among the labels: it may be dates.
                let is_order = plan.order.as_deref() == Some(name);
                if !of_symbol && !is_order && !times.iter().any(|(known, _)| known == name) {
                    times.push((name.to_owned(), plans.len()));
                    let is_time = derived.time() == Some(name);
                    let plan = if is_time { ColumnPlan::of_times } else { ColumnPlan::of_numbers };
                    plans.push(plan(name));
                }
            }
        }
        let of_objects = source.object.iter().chain(&source.station);
        let of_folds = plan.hold_out.together.iter().chain(&plan.order);
        let of_folds = plan.target.iter().chain(of_folds);
        let labels = plan.group.iter().chain(&plan.id).chain(of_objects).chain(of_folds).cloned().collect();
        Self { plans, readings, observed, sigma, uncertain, correlated, times, labels }
    }

    /// The columns of a file, and those whose unit nothing says, each with its place among the numbers.
    pub fn wanted(
        &self,
        plan: &Plan,
        source: &SourcePlan,
        reader: &dyn TableReader,
    ) -> Result<(Vec<Wanted>, PlacedBareColumns), DataError> {
        let (header, file) = (reader.header(), reader.source());
        let declared = declared_columns(&plan.chain);
        let declared: Vec<&str> = declared.iter().map(String::as_str).collect();
        let mut bare = Vec::new();
        let mut wanted = Vec::new();
        for (at, column) in self.plans.iter().enumerate() {
            let found = column.find(header, &declared, file)?;
            let symbol = self.readings.iter().find(|(_, reading)| *reading == at).map(|(symbol, _)| *symbol);
            let plausible = if let Some(symbol) = symbol {
                Plausible::readings(&plan.chain, symbol)
            } else if self.sigma.contains(&at) || self.uncertain.iter().any(|(_, own)| *own == at) {
                Plausible::noise(&plan.chain)
            } else {
                Plausible::measured(&plan.chain, source.observable)
            };
            if found.is_bare {
                let name = &header[found.at].full;
                bare.push((at, BareColumn::new(plausible, column.measures.quantity(), name, file)));
            }
            wanted.push(Wanted { column: found.at, form: Form::Number(found.factor) });
        }
        for name in &self.labels {
            wanted.push(Wanted { column: find_column(header, name, file)?, form: Form::Label });
        }
        Ok((wanted, bare))
    }
}

/// Puts the columns that say something of readings behind those there are; where each of them stands.
fn placed<K: Copy>(stated: &[(K, Uncertain)], plans: &mut Vec<ColumnPlan>) -> Vec<(K, usize)> {
    let mut placed = Vec::new();
    for (of, own) in stated {
        if let Uncertain::Column(column) = own {
            placed.push((*of, plans.len()));
            plans.push(column.clone());
        }
    }
    placed
}
