//! A study with every name resolved against its chain.

use model_core::unit::Measures;
use model_core::{Chain, Mistakes, ObservableId, SymbolId, SymbolKind};
use toml::Spanned;

use super::amount::si;
use super::asked::Asked;
use super::column_plan::{ColumnPlan, column_plan};
use super::estimated::{estimable, matching};
use super::frozen::Frozen;
use super::hold_out::HoldOut;
use super::inputs::needed;
use super::mistakes::{Gathered, Outcome, Several, every, mistake, plain, unknown, within};
use super::next::NextPoses;
use super::observed::{ObservedColumns, observed_columns};
use super::orientation;
use super::shown::{self, Convention};
use super::sights;
use super::timeless::{Timeless, timeless};
use super::trajectory::TrajectoryPlan;
use super::uncertain_readings::{UncertainReadings, uncertain};
use super::unsought::{Unsought, unsought};
use super::unstated::{Unstated, unstated};
use super::written::{Column, Study, Table};
use effects::candidate::Effect;
use fit::FitOptions;
use fit::noise::NoiseOptions;
use observe::kinds::Written;
use observe::unknowns::Places;
use observe::{Measure, derive::Derived, derive::parse_derived};
use tables::formats::Options;
use tables::units::Doubt;

/// What a study asks for, ready to read data and fit.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The chain, with an input for every side quantity of the study that it does not declare.
    pub chain: Chain,
    /// What to read.
    pub sources: Vec<SourcePlan>,
    /// What to estimate and how.
    pub fit: FitOptions,
    /// How large errors may be that are findings, where the study says so, SI.
    pub plausible: Vec<(SymbolId, f64)>,
    /// What to look for.
    pub search: Search,
    /// The terms of the model, where they are given and not looked for.
    pub frozen: Option<Frozen>,
    /// How to judge on data that no stage saw.
    pub hold_out: HoldOut,
    /// Where to propose to measure next.
    pub next: Option<NextPoses>,
    /// What is asked of the answer.
    pub asked: Asked,
    /// Where the data are to be had, for whoever has not got them.
    pub data_from: Option<String>,
    /// Bare numbers of the study that are hardly in SI.
    pub doubts: Vec<Doubt>,
    /// Inputs whose names sound like what they do not state.
    pub unstated: Vec<Unstated>,
    /// Inputs that say what they are, and that nothing uses.
    pub unsought: Vec<Unsought>,
    /// Whether the rows are in sequence while nothing says when they were taken.
    pub timeless: Option<Timeless>,
    pub(super) id: Option<String>,
    /// Where objects and stations are as far as the study says.
    pub places: Places,
    pub(super) group: Vec<String>,
    /// The columns that name the targets whose coordinates rows share.
    pub(super) target: Vec<String>,
    pub(super) order: Option<String>,
    pub(super) format: Options,
    /// What joins the rows by time.
    pub trajectory: Option<TrajectoryPlan>,
}

impl Plan {
    /// How its tables are read.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.format
    }

    /// Whether some readings state how uncertain they are.
    #[must_use]
    pub fn has_uncertain_readings(&self) -> bool {
        self.sources.iter().any(|source| !source.uncertain.sigma.is_empty())
    }

    /// Whether a component that a source observes has this key in `[observed]`.
    #[must_use]
    pub fn has_observed_key(&self, source: usize, key: &str) -> bool {
        self.sources.get(source).is_some_and(|source| source.observed_keys.contains(&key))
    }

    /// The key in `[observed]` of a component that a source observes.
    #[must_use]
    pub fn observed_key(&self, source: usize, component: usize) -> &'static str {
        match self.sources.get(source).and_then(|source| source.observed_keys.get(component)) {
            Some(key) => key,
            None => unreachable!("a component that is observed has a key"),
        }
    }
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
    /// How it is written.
    pub(super) way: &'static Written,
    /// The key of each in `[observed]`.
    pub(super) observed_keys: Vec<&'static str>,
    /// What the angles are that are observed, where the declaration says so.
    pub(super) convention: Option<Convention>,
    /// How an orientation is written, where one is observed.
    pub(super) orientation: Option<orientation::Form>,
    pub(super) sigma: Vec<ColumnPlan>,
    /// How uncertain the readings of joints and inputs are.
    pub(super) uncertain: UncertainReadings,
    /// The columns that name what was observed, and where from.
    pub object: Vec<String>,
    /// The columns that name the station.
    pub station: Vec<String>,
}

/// What the search for missing effects is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct Search {
    /// The share of false alarms that is accepted.
    pub false_alarm: f64,
    /// Effects that are accepted at most.
    pub most: usize,
    /// Whether functions that no family spells out are taken up as effects; by default where they are confirmed.
    pub functions: Option<bool>,
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
    /// Nobody measures it: a sight ends where its object is.
    Sighted,
}

/// Sources beside the first.
const MOST_ALSO: usize = 100;

impl Study {
    /// Resolves every name.
    ///
    /// # Errors
    /// Every name that the chain does not declare, and every value that cannot be, each with its place in the study.
    pub fn plan(&self, chain: &Chain) -> Result<Plan, Mistakes> {
        self.resolved(chain).map_err(|Several(mistakes)| Mistakes::locate(&self.text, mistakes))
    }

    fn resolved(&self, chain: &Chain) -> Outcome<Plan> {
        let chain = self.with_inputs(chain)?;
        let mut mistakes = Gathered::default();
        let sources = mistakes.take(self.sources(&chain));
        let fit = mistakes.take(self.fit_options(&chain));
        let hold_out = mistakes.take(self.held_out());
        let next = mistakes.take(self.next(&chain));
        let format = mistakes.take(self.format());
        let trajectory = mistakes.take(self.trajectory());
        let sigma = sources.as_ref().and_then(|sources| mistakes.take(self.stated_sigma(sources)));
        let observables: Option<Vec<ObservableId>> =
            sources.as_ref().map(|sources| sources.iter().map(|source| source.observable).collect());
        // What the catalogue holds depends on what was observed.
        let search = mistakes.take(self.search(&chain, observables.as_deref()));
        let frozen = match (&search, &observables) {
            (Some(search), Some(observables)) => mistakes.take(self.frozen(&chain, observables, search)),
            _ => None,
        };
        if let (Some(search), Some(fit), Some(observables), Some(format)) =
            (&search, &fit, &observables, &format)
        {
            mistakes.take(self.fits_into_memory(search, &chain, observables, fit.estimate.len(), format));
        }
        let places = sources.as_ref().and_then(|sources| mistakes.take(self.places(sources)));
        let sizes = sources.as_ref().and_then(|sources| mistakes.take(self.tolerances(&chain, sources)));
        let plausible = mistakes.take(self.plausible(&chain));
        let reference = sources.as_ref().and_then(|sources| mistakes.take(self.reference(sources)));
        let unit = sources.as_ref().and_then(|own| Some(own.first()?.measure.unit()));
        let asked = mistakes.take(self.asked(&chain, unit, fit.as_ref()));
        mistakes.none()?;
        let (
            Some(sources),
            Some(mut fit),
            Some(search),
            Some(frozen),
            Some(hold_out),
            Some(next),
            Some(format),
            Some(sigma),
            Some(places),
            Some(sizes),
            Some(plausible),
            Some(reference),
            Some(asked),
            Some(trajectory),
        ) = (
            sources, fit, search, frozen, hold_out, next, format, sigma, places, sizes, plausible, reference,
            asked, trajectory,
        )
        else {
            unreachable!("what is missing comes with a mistake")
        };
        if let Some(frozen) = &frozen {
            frozen.hold(&chain, &mut fit);
        }
        fit.noise.sigma = sigma;
        fit.sizes = sizes;
        fit.reference = reference;
        self.with_objects(&sources, &mut fit)?;
        let (id, group, order) = (self.id.clone(), self.noise.group.0.clone(), self.noise.order.clone());
        let (data_from, doubts) = (self.data_from.clone(), self.doubts(&chain, &sources));
        let chain = shown::vectors(chain);
        let unstated = unstated(&chain, &search.inputs);
        // Whoever names the effects that may be found has said what is looked for.
        let unsought = if search.only.is_empty() { unsought(&chain, &search.inputs) } else { Vec::new() };
        let timeless =
            if search.sequence { timeless(&chain, &search.inputs, order.as_deref()) } else { None };
        Ok(Plan {
            sources,
            fit,
            search,
            frozen,
            hold_out,
            next,
            asked,
            places,
            plausible,
            data_from,
            doubts,
            unstated,
            unsought,
            timeless,
            id,
            group,
            target: self.target_columns(),
            order,
            format,
            trajectory,
            chain,
        })
    }

    /// What is read, source by source.
    pub(super) fn sources(&self, chain: &Chain) -> Outcome<Vec<SourcePlan>> {
        if let Some(beyond) = self.also.get(MOST_ALSO) {
            let message = format!("a study has at most {MOST_ALSO} further sources");
            return Err(mistake(
                beyond.data.span(),
                message,
                "give one source several files: `data = [\"a.csv\", \"b.csv\"]`",
            ));
        }
        let first = (&self.observable, &self.data, &self.columns, &self.observed, &None);
        let also = self
            .also
            .iter()
            .map(|also| (&also.observable, &also.data, &also.columns, &also.observed, &also.sigma));
        let mut first_measure = None;
        every(std::iter::once(first).chain(also).map(|(observable, data, columns, observed, own)| {
            let mut mistakes = Gathered::default();
            let paths = data.get_ref().0.clone();
            if paths.is_empty() {
                mistakes.take::<()>(Err(mistake(data.span(), "no data file", "name one, or a list of them")));
            }
            let observable = mistakes.take(self.observable(chain, observable.as_ref()));
            let sighted = observable.and_then(|id| sights::sighted(chain, id, observed.get_ref().kind));
            let readings = mistakes.take(self.readings(chain, observable, columns, sighted));
            let shown = observable.and_then(|observable| {
                mistakes.take(self.check_observed(chain, observable, observed))?;
                mistakes.take(observed_columns(chain, observable, observed))
            });
            let convention = observable.and_then(|id| {
                let (kind, place) = (observed.get_ref().kind, observed.span());
                mistakes.take(shown::convention(chain.observable(id), kind, &place))
            });
            let [object, station] =
                [&observed.get_ref().object, &observed.get_ref().station].map(|own| own.0.clone());
            let sigma = shown.as_ref().and_then(|shown| {
                let first = *first_measure.get_or_insert(shown.measure);
                mistakes.take(self.sigma_columns(own.as_ref(), shown.measure, first))
            });
            let uncertain = mistakes.take(uncertain(chain, columns));
            mistakes.none()?;
            let (
                Some(observable),
                Some(readings),
                Some(uncertain),
                Some(ObservedColumns { measure, way, columns, keys, orientation }),
                Some(convention),
                Some(sigma),
            ) = (observable, readings, uncertain, shown, convention, sigma)
            else {
                unreachable!("what is missing comes with a mistake")
            };
            Ok(SourcePlan {
                paths,
                observable,
                measure,
                readings,
                observed: columns,
                way,
                observed_keys: keys,
                convention,
                orientation,
                sigma,
                uncertain,
                object,
                station,
            })
        }))
    }

    fn observable(&self, chain: &Chain, name: Option<&Spanned<String>>) -> Outcome<ObservableId> {
        let all = || chain.observables.iter().map(|observable| observable.name.as_str());
        match name {
            Some(name) => chain
                .find_observable(name.get_ref())
                .ok_or_else(|| unknown(name.span(), "observable", name.get_ref(), all())),
            None if chain.observables.len() == 1 => Ok(ObservableId(0)),
            None => {
                let help =
                    format!("write `observable = \"…\"`: one of {}", all().collect::<Vec<_>>().join(", "));
                Err(mistake(self.chain.span(), "which observable was measured?", help))
            }
        }
    }

    /// Where each joint and input comes from: those that the observable needs, and those that the study names.
    fn readings(
        &self,
        chain: &Chain,
        observable: Option<ObservableId>,
        columns: &Table<Column>,
        sighted: Option<SymbolId>,
    ) -> Outcome<Vec<(SymbolId, Reading)>> {
        let mut wanted = observable.map_or_else(Vec::new, |observable| needed(chain, observable));
        let named = every(columns.keys().chain(&self.search.inputs).map(|name| {
            let read =
                |id: &SymbolId| matches!(chain.symbol(*id).kind, SymbolKind::Joint | SymbolKind::Input);
            chain.find_symbol(name.get_ref()).filter(read).ok_or_else(|| {
                let all = chain
                    .symbols
                    .iter()
                    .filter(|symbol| matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input));
                let names = all.map(|symbol| symbol.name.as_str());
                unknown(name.span(), "joint or input", name.get_ref(), names)
            })
        }))?;
        wanted.extend(named);
        let implied = self.implied(chain);
        wanted.extend(implied.iter().filter_map(|(name, _)| chain.find_symbol(name)));
        wanted.sort_unstable();
        wanted.dedup();
        let reading = |id: SymbolId| {
            let symbol = chain.symbol(id);
            let written = columns.iter().find(|(name, _)| *name.get_ref() == symbol.name);
            if sighted == Some(id) {
                return match written {
                    Some((name, _)) => Err(sights::no_range(name)),
                    None => Ok(Reading::Sighted),
                };
            }
            let Some((_, column)) = written else {
                if let Some((_, derived)) = implied.iter().find(|(name, _)| *name == symbol.name) {
                    return Ok(Reading::Derived(derived.clone()));
                }
                let name = symbol.name.clone();
                return Ok(Reading::Column(ColumnPlan::declared(name, Measures::of(symbol))));
            };
            match &column.get_ref().derive {
                Some(text) => parse_derived(text)
                    .map(Reading::Derived)
                    .map_err(|error| plain(column.span(), error.to_string())),
                None => {
                    let mut plan = column_plan(column.get_ref(), Measures::of(symbol), &column.span(), true)?;
                    plan.declared = plan.name == symbol.name;
                    Ok(Reading::Column(plan))
                }
            }
        };
        every(wanted.into_iter().map(|id| Ok((id, reading(id)?))))
    }

    fn fit_options(&self, chain: &Chain) -> Outcome<FitOptions> {
        let mut mistakes = Gathered::default();
        let fixed = mistakes.take(every(self.fit.fix.keys().map(|name| estimable(chain, name))));
        let estimate = mistakes.take(every(self.fit.estimate.iter().map(|name| matching(chain, name))));
        let start = mistakes.take(every(self.fit.start.iter().chain(&self.fit.fix).map(|(name, amount)| {
            // A name in `fix` that is none has been told.
            let Ok(id) = estimable(chain, name) else { return Ok(None) };
            let value = si(amount.get_ref(), chain.symbol(id).quantity, &amount.span())?;
            Ok(Some((id, value)))
        })));
        mistakes.take(every(self.fit.start.keys().map(|name| estimable(chain, name))));
        let iterations = &self.fit.max_iterations;
        mistakes.take(within(iterations.span(), "iterations", *iterations.get_ref(), 1..=10_000));
        mistakes.none()?;
        let (Some(fixed), Some(estimate), Some(given)) = (fixed, estimate, start) else {
            unreachable!("what is missing comes with a mistake")
        };
        let mut start = chain.nominal_values();
        for (id, value) in given.into_iter().flatten() {
            start[id.index()] = value;
        }
        let mut estimate: Vec<SymbolId> = estimate.into_iter().flatten().collect();
        estimate.retain(|id| !fixed.contains(id));
        estimate.sort_unstable();
        estimate.dedup();
        let max_iterations = usize::try_from(*iterations.get_ref()).unwrap_or(usize::MAX);
        let noise = NoiseOptions {
            sigma: None,
            stated: None,
            variance: self.noise.variance,
            serial: self.noise.serial,
            stretches: self.noise.serial,
            beside_effects: true,
        };
        let rest = FitOptions::for_chain(chain);
        Ok(FitOptions { estimate, start, robust: self.fit.robust, noise, max_iterations, ..rest })
    }
}
