//! A study with every name resolved against its chain.

use std::ops::Range;

use model_core::{Chain, ObservableId, Quantity, Symbol, SymbolId, SymbolKind, names};
use toml::Spanned;

use super::StudyError;
use super::written::{Column, HoldOut, Kind, Observed, SearchTable, Study, Table};
use crate::candidate::Effect;
use crate::data::units::{Amount, Unit};
use crate::data::{Measure, derive::Derived, derive::parse_derived};
use crate::fit::FitOptions;
use crate::fit::noise::NoiseOptions;
use crate::formats::csv;

/// What a study asks for, ready to read data and fit.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The chain, with an input for every side quantity of the study that it does not declare.
    pub chain: Chain,
    /// What to read.
    pub sources: Vec<SourcePlan>,
    /// What to estimate and how.
    pub fit: FitOptions,
    /// What to look for.
    pub search: Search,
    /// How to judge on data that no stage saw.
    pub hold_out: HoldOut,
    /// Where to propose to measure next.
    pub next: Option<NextPoses>,
    pub(super) group: Vec<String>,
    pub(super) order: Option<String>,
    pub(super) format: csv::Options,
}

/// How many poses to propose, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPoses {
    /// How many.
    pub count: usize,
    /// Between which values of a joint, SI; joints without a range stay within that of the data.
    pub ranges: Vec<(SymbolId, Range<f64>)>,
}

/// Files that observe one thing in one way.
#[derive(Debug, Clone)]
pub struct SourcePlan {
    /// Paths of the files, relative to the study.
    pub paths: Vec<String>,
    /// What was observed.
    pub observable: ObservableId,
    /// What its numbers are.
    pub measure: Measure,
    pub(super) readings: Vec<(SymbolId, Reading)>,
    pub(super) observed: Vec<ColumnPlan>,
    pub(super) kind: Kind,
    pub(super) sigma: Vec<ColumnPlan>,
}

/// What the search for missing effects is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// The share of false alarms that is accepted.
    pub false_alarm: f64,
    /// Effects that are accepted at most.
    pub most: usize,
    /// Whether functions that no family spells out are taken up as effects.
    pub functions: bool,
    /// Side quantities that effects may use.
    pub inputs: Vec<SymbolId>,
    /// Whether rows are in order of acquisition, so that direction of motion and drift may be used.
    pub sequence: bool,
    /// Harmonics of each encoder up to this order, for gears and motors that repeat many times a turn.
    pub harmonics: u32,
    /// Lines a turn of encoders, for their sub-divisional errors.
    pub lines: Vec<(SymbolId, u32)>,
    /// The study's own effects.
    pub own: Vec<Effect>,
    /// The effects that may be found, by their names, their families' or those of other fields; empty for all.
    pub only: Vec<String>,
}

/// Where the values of a joint or input come from.
#[derive(Debug, Clone)]
pub(super) enum Reading {
    Column(ColumnPlan),
    Derived(Derived),
}

/// A column that is to be found in a file.
#[derive(Debug, Clone)]
pub(super) struct ColumnPlan {
    pub name: String,
    pub unit: Option<Unit>,
    pub quantity: Quantity,
    /// A column with a declared name needs no unit: it is in SI.
    pub declared: bool,
}

impl Study {
    /// Resolves every name.
    ///
    /// # Errors
    /// The first name that the chain does not declare, or value that cannot be.
    pub fn plan(&self, chain: &Chain) -> Result<Plan, StudyError> {
        let chain = self.with_inputs(chain)?;
        let first = (&self.observable, &self.data, &self.columns, &self.observed, &None);
        let also = self
            .also
            .iter()
            .map(|also| (&also.observable, &also.data, &also.columns, &also.observed, &also.sigma));
        let mut sources: Vec<SourcePlan> = Vec::new();
        for (observable, data, columns, observed, own) in std::iter::once(first).chain(also) {
            let observable = self.observable(&chain, observable.as_ref())?;
            let (kind, measure, observed) = observed_columns(&chain, observable, observed)?;
            let paths = data.get_ref().0.clone();
            if paths.is_empty() {
                return Err(StudyError::new(data.span(), "no data file", "name one, or a list of them"));
            }
            let first = sources.first().map_or(measure, |first| first.measure);
            let sigma = self.sigma_columns(own.as_ref(), measure, first)?;
            let readings = self.readings(&chain, observable, columns)?;
            sources.push(SourcePlan { paths, observable, measure, readings, observed, kind, sigma });
        }
        let sigma = self.stated_sigma(&sources)?;
        let observables: Vec<ObservableId> = sources.iter().map(|source| source.observable).collect();
        let search = self.search(&chain, &observables)?;
        let noise = NoiseOptions { sigma, variance: self.noise.variance, serial: self.noise.serial };
        Ok(Plan {
            sources,
            fit: self.fit_options(&chain, noise)?,
            search,
            hold_out: self.hold_out.clone(),
            next: self.next(&chain)?,
            group: self.noise.group.0.clone(),
            order: self.noise.order.clone(),
            format: csv::Options { separator: self.separator()? },
            chain,
        })
    }

    fn observable(&self, chain: &Chain, name: Option<&Spanned<String>>) -> Result<ObservableId, StudyError> {
        let all = || chain.observables.iter().map(|observable| observable.name.as_str());
        match name {
            Some(name) => chain
                .find_observable(name.get_ref())
                .ok_or_else(|| StudyError::unknown(name.span(), "observable", name.get_ref(), all())),
            None if chain.observables.len() == 1 => Ok(ObservableId(0)),
            None => {
                let help =
                    format!("write `observable = \"…\"`: one of {}", all().collect::<Vec<_>>().join(", "));
                Err(StudyError::new(self.chain.span(), "which observable was measured?", help))
            }
        }
    }

    /// Where each joint and input comes from: those that the observable needs, and those that the study names.
    fn readings(
        &self,
        chain: &Chain,
        observable: ObservableId,
        columns: &Table<Column>,
    ) -> Result<Vec<(SymbolId, Reading)>, StudyError> {
        let mut wanted = needed(chain, observable);
        for name in columns.keys().chain(&self.search.inputs) {
            let read =
                |id: &SymbolId| matches!(chain.symbol(*id).kind, SymbolKind::Joint | SymbolKind::Input);
            let id = chain.find_symbol(name.get_ref()).filter(read).ok_or_else(|| {
                let all = chain
                    .symbols
                    .iter()
                    .filter(|symbol| matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input));
                let names = all.map(|symbol| symbol.name.as_str());
                StudyError::unknown(name.span(), "joint or input", name.get_ref(), names)
            })?;
            wanted.push(id);
        }
        let implied = self.implied(chain);
        wanted.extend(implied.iter().filter_map(|(name, _)| chain.find_symbol(name)));
        wanted.sort_unstable();
        wanted.dedup();
        let reading = |id: SymbolId| {
            let symbol = chain.symbol(id);
            let written = columns.iter().find(|(name, _)| *name.get_ref() == symbol.name);
            let Some((_, column)) = written else {
                if let Some((_, derived)) = implied.iter().find(|(name, _)| *name == symbol.name) {
                    return Ok(Reading::Derived(derived.clone()));
                }
                let (name, quantity) = (symbol.name.clone(), symbol.quantity);
                return Ok(Reading::Column(ColumnPlan { name, unit: None, quantity, declared: true }));
            };
            match &column.get_ref().derive {
                Some(text) => parse_derived(text)
                    .map(Reading::Derived)
                    .map_err(|error| StudyError::new(column.span(), error.to_string(), "")),
                None => {
                    let mut plan = column_plan(column.get_ref(), symbol.quantity, &column.span())?;
                    plan.declared = plan.name == symbol.name;
                    Ok(Reading::Column(plan))
                }
            }
        };
        wanted.into_iter().map(|id| Ok((id, reading(id)?))).collect()
    }

    fn fit_options(&self, chain: &Chain, noise: NoiseOptions) -> Result<FitOptions, StudyError> {
        let estimable = |symbol: &Symbol| matches!(symbol.kind, SymbolKind::Error | SymbolKind::Constant);
        let names_of =
            || chain.symbols.iter().filter(|symbol| estimable(symbol)).map(|symbol| symbol.name.as_str());
        let find = |name: &Spanned<String>| {
            let found = chain.find_symbol(name.get_ref()).filter(|&id| estimable(chain.symbol(id)));
            found.ok_or_else(|| {
                StudyError::unknown(name.span(), "error or constant", name.get_ref(), names_of())
            })
        };
        let mut estimate: Vec<SymbolId> = Vec::new();
        for pattern in &self.fit.estimate {
            if !names::is_pattern(pattern.get_ref()) {
                estimate.push(find(pattern)?);
                continue;
            }
            let matching = |kind| {
                chain.symbols_of(kind).filter(|&id| names::matches(pattern.get_ref(), &chain.symbol(id).name))
            };
            // A pattern means errors; constants are freed by it only where no error matches.
            let mut matched: Vec<SymbolId> = matching(SymbolKind::Error).collect();
            if matched.is_empty() {
                matched = matching(SymbolKind::Constant).collect();
            }
            if matched.is_empty() {
                let message = format!("no error or constant matches `{}`", pattern.get_ref());
                return Err(StudyError::new(pattern.span(), message, ""));
            }
            estimate.extend(matched);
        }
        let mut start = chain.nominal_values();
        for (name, amount) in self.fit.start.iter().chain(&self.fit.fix) {
            let id = find(name)?;
            start[id.index()] = si(amount.get_ref(), chain.symbol(id).quantity, &amount.span())?;
        }
        let fixed: Vec<SymbolId> = self.fit.fix.keys().map(find).collect::<Result<_, _>>()?;
        estimate.retain(|id| !fixed.contains(id));
        estimate.sort_unstable();
        estimate.dedup();
        let (robust, max_iterations) = (self.fit.robust, self.fit.max_iterations);
        Ok(FitOptions { estimate, start, robust, noise, max_iterations })
    }

    fn search(&self, chain: &Chain, observables: &[ObservableId]) -> Result<Search, StudyError> {
        let false_alarm = *self.search.false_alarm.get_ref();
        if !(false_alarm > 0.0 && false_alarm < 1.0) {
            let place = self.search.false_alarm.span();
            return Err(StudyError::new(place, "a share of false alarms lies between 0 and 1", "write 0.05"));
        }
        let mut inputs: Vec<SymbolId> =
            self.search.inputs.iter().filter_map(|name| chain.find_symbol(name.get_ref())).collect();
        inputs.extend(self.implied(chain).iter().filter_map(|(name, _)| chain.find_symbol(name)));
        let SearchTable { sequence, harmonics, most, functions, .. } = self.search;
        let (lines, own) = (self.lines(chain)?, self.own_effects(chain)?);
        let only = self.search.effects.iter().map(|name| name.get_ref().clone()).collect();
        let search = Search { false_alarm, most, functions, inputs, sequence, harmonics, lines, own, only };
        self.check_names(chain, observables, &search)?;
        Ok(search)
    }

    fn next(&self, chain: &Chain) -> Result<Option<NextPoses>, StudyError> {
        let Some(next) = &self.next else { return Ok(None) };
        let joints = || chain.symbols_of(SymbolKind::Joint);
        let mut ranges = Vec::new();
        for (name, range) in &next.range {
            let id = joints().find(|&id| chain.symbol(id).name == *name.get_ref()).ok_or_else(|| {
                let names: Vec<&str> = joints().map(|id| chain.symbol(id).name.as_str()).collect();
                StudyError::unknown(name.span(), "joint", name.get_ref(), names.iter().copied())
            })?;
            let [low, high] = range.get_ref();
            let quantity = chain.symbol(id).quantity;
            let (low, high) = (si(low, quantity, &range.span())?, si(high, quantity, &range.span())?);
            if low > high {
                return Err(StudyError::new(range.span(), "the range ends before it starts", "swap the two"));
            }
            ranges.push((id, low..high));
        }
        Ok(Some(NextPoses { count: next.poses, ranges }))
    }

    fn separator(&self) -> Result<Option<u8>, StudyError> {
        let Some(separator) = &self.separator else { return Ok(None) };
        match u8::try_from(*separator.get_ref()) {
            Ok(byte) if byte.is_ascii() && byte != b'"' && byte != b'#' => Ok(Some(byte)),
            _ => Err(StudyError::new(
                separator.span(),
                "no such separator",
                "write one ASCII character, such as \";\"",
            )),
        }
    }
}

/// The joints and inputs that an observable depends on.
fn needed(chain: &Chain, observable: ObservableId) -> Vec<SymbolId> {
    let amounts = chain.factors_to(observable).into_iter().map(|factor| &factor.amount);
    amounts
        .chain(&chain.observable(observable).components)
        .flat_map(|amount| chain.symbols_in(amount))
        .filter(|&id| matches!(chain.symbol(id).kind, SymbolKind::Joint | SymbolKind::Input))
        .collect()
}

pub(super) fn column_plan(
    column: &Column,
    quantity: Quantity,
    place: &Range<usize>,
) -> Result<ColumnPlan, StudyError> {
    let unit = column.unit.as_deref().map(Unit::parse).transpose();
    let unit = unit.map_err(|error| StudyError::new(place.clone(), error.to_string(), ""))?;
    match &column.column {
        Some(name) => Ok(ColumnPlan { name: name.clone(), unit, quantity, declared: false }),
        None => Err(StudyError::new(
            place.clone(),
            "this column is measured, not derived",
            "write `column = \"…\"`",
        )),
    }
}

/// The columns of `[observed]` in their order, and what they measure.
fn observed_columns(
    chain: &Chain,
    id: ObservableId,
    written: &Spanned<Observed>,
) -> Result<(Kind, Measure, Vec<ColumnPlan>), StudyError> {
    let (observed, place) = (written.get_ref(), written.span());
    let observable = chain.observable(id);
    let is_point = observable.kind == model_core::ObservableKind::Point;
    let wants_point = matches!(observed.kind, Kind::Point | Kind::Range);
    if is_point != wants_point {
        let (what, help) = if is_point {
            ("a point", "write kind = \"point\" or \"range\", or name another observable")
        } else {
            (
                "a direction",
                "write kind = \"direction\", \"spherical\" or \"offset\", or name another observable",
            )
        };
        let message = format!("`{}` is {what}, which this kind does not measure", observable.name);
        return Err(StudyError::new(place, message, help));
    }
    let xyz = [("x", &observed.x), ("y", &observed.y), ("z", &observed.z)];
    let (azimuth, elevation) = if observed.ha.is_some() || observed.dec.is_some() {
        (("ha", &observed.ha), ("dec", &observed.dec))
    } else {
        (("azimuth", &observed.azimuth), ("elevation", &observed.elevation))
    };
    let only_azimuth = azimuth.1.is_some() && elevation.1.is_none();
    let (measure, quantity, keys) = match observed.kind {
        Kind::Direction => (Measure::Direction, Quantity::Number, xyz.to_vec()),
        Kind::Point => (Measure::Point, Quantity::Length, xyz.to_vec()),
        Kind::Spherical if only_azimuth => (Measure::Azimuth, Quantity::Angle, vec![azimuth]),
        Kind::Spherical => (Measure::Direction, Quantity::Angle, vec![azimuth, elevation]),
        Kind::Offset => {
            let keys = vec![("cross", &observed.cross), ("along", &observed.along)];
            (Measure::Direction, Quantity::Angle, keys)
        }
        Kind::Range => (Measure::Range, Quantity::Length, vec![("range", &observed.range)]),
    };
    let plan = |(key, column): (&str, &Option<Column>)| match column {
        Some(column) => column_plan(column, quantity, &place),
        // What `simulate` and `eval` write needs no naming.
        None if xyz.iter().any(|(name, _)| *name == key) => Ok(ColumnPlan {
            name: format!("{}_{key}", observable.name),
            unit: None,
            quantity,
            declared: true,
        }),
        None => {
            let help = format!("write `{key} = {{ column = \"…\", unit = \"…\" }}`");
            Err(StudyError::new(place.clone(), format!("no column is named for `{key}`"), help))
        }
    };
    let columns = keys.into_iter().map(plan).collect::<Result<_, _>>()?;
    Ok((observed.kind, measure, columns))
}

pub(super) fn si(amount: &Amount, quantity: Quantity, place: &Range<usize>) -> Result<f64, StudyError> {
    amount.to_si(quantity).map_err(|error| StudyError::new(place.clone(), error.to_string(), ""))
}
