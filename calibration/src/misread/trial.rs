//! Every reading of the data, fitted: all by a few steps, the best to the end.

use std::f64::consts::FRAC_PI_2;

use fit::noise::{Layout, NoiseOptions, resolution};
use fit::{FitOptions, Model, residuals};
use model_core::{Quantity, SymbolId};
use nalgebra::UnitQuaternion;
use network::place;
use observe::Observations;
use study::{Change, Changed, Plan, Sample, SampledColumn};

use super::hypotheses::{self, Hypothesis, QUARTERS, Reading, both, from_row};
use super::policy::{
    FITTED, MOST_TILT_RAD, OBJECT_STEPS, PAIRED, PARTS, ROUGH_SHARE, SCREENED_STEPS, TOOL_SHARE,
};
use super::prior::{Implausible, Priors, indexed};
use super::score::{Score, jacobian, score, trimmed, written};
use super::{estimated, explains, frame, size, states, strayed};

/// Shares of the residual that differ by less are the same but for rounding.
const ROUNDED: f64 = 1e-9;

/// A reading of the data, and what it comes to.
#[derive(Clone)]
pub(super) struct Tried {
    pub hypothesis: Hypothesis,
    pub score: Score,
    pub observations: Observations,
}

/// The rows of a sample, and what their fits go by.
pub(super) struct Trial<'a> {
    plan: &'a Plan,
    sample: &'a Sample,
    columns: Vec<SampledColumn>,
    priors: Priors,
    options: FitOptions,
    model: Model,
    /// The rows as the study reads them.
    pub own: Observations,
    /// What rounding leaves of a residual, rad or m.
    pub rounding: f64,
}

impl<'a> Trial<'a> {
    /// `None` where there are no rows, or nowhere to start from.
    pub fn new(plan: &'a Plan, sample: &'a Sample) -> Option<Self> {
        let own = read(plan, sample, None)?;
        if own.rows() == 0 {
            return None;
        }
        // No model of the noise.
        let noise = NoiseOptions { variance: false, serial: false, ..plan.fit.noise.by_residuals() };
        let options = FitOptions { noise, other_starts: false, reference: None, ..plan.fit.clone() };
        let model = Model::new(&plan.chain, &own.poses, &plan.fit.estimate).ok()?;
        let priors = Priors::of(plan, &own);
        let (columns, rounding) = (sample.columns(), resolution(&own));
        Some(Self { plan, sample, columns, priors, options, model, own, rounding })
    }

    /// Whether a reading changes columns of joints: any, and all that it changes.
    pub fn changes_joints(&self, hypothesis: &Hypothesis) -> [bool; 2] {
        let is_joint = |changed: &Changed| {
            let own = self.columns.iter().find(|column| column.place == changed.place);
            own.is_some_and(|column| hypotheses::is_joint(self.plan, column))
        };
        [hypothesis.changes.iter().any(is_joint), hypothesis.changes.iter().all(is_joint)]
    }

    /// Which columns are readings of joints.
    pub fn joints(&self) -> Vec<usize> {
        let is_joint = |at: &usize| hypotheses::is_joint(self.plan, &self.columns[*at]);
        (0..self.columns.len()).filter(is_joint).collect()
    }

    /// The score of the study's own reading with the numbers of one column multiplied.
    pub fn total_scaled(&self, column: usize, by: f64) -> Option<f64> {
        let &SampledColumn { place, factor, .. } = self.columns.get(column)?;
        let changes = [Changed::all(place, Change::Factor(factor * by))];
        let observations = self.sample.observations(self.plan, &changes).ok()?;
        let steps = self.plan.fit.max_iterations;
        self.score(&observations, &self.plan.fit.start, steps, None).map(|score| score.total)
    }

    /// The error that a reading needs and that is furthest beyond its limit.
    pub fn beyond(&self, score: &Score) -> Option<Implausible> {
        let (error, limit) = self.priors.beyond(&score.values)?;
        let symbol = self.plan.chain.symbol(error);
        let value = score.values[error.index()];
        Some(Implausible::Error { name: symbol.name.clone(), value, limit, unit: symbol.quantity.into() })
    }

    /// The score of the study's own reading. It alone is worth other starts: most other readings are wrong and end far off.
    pub fn as_read(&self) -> Option<Score> {
        if self.own.unknowns.is_some() {
            return self.score(&self.own, &self.plan.fit.start, self.object_steps(), None);
        }
        let options = FitOptions { other_starts: true, ..self.options.clone() };
        self.score_by(&self.own, &options, None)
    }

    /// The same from another reading's errors, and from homes elsewhere: a quarter or half turn away, or by what a frame is turned. A wrong
    /// minimum is no misread column.
    pub fn as_read_elsewhere(&self, other: &Tried, as_read: &Score) -> Option<Score> {
        if self.own.unknowns.is_some() {
            return self.with_large_errors(as_read.size);
        }
        let mut starts = vec![other.score.values.clone()];
        let quarters = QUARTERS.map(|quarters| FRAC_PI_2 * f64::from(quarters));
        let by_rad = match other.hypothesis.reading {
            Reading::Frame { by_deg, .. } => vec![by_deg.to_radians(), -by_deg.to_radians()],
            _ => Vec::new(),
        };
        for (_, index) in indexed(self.plan, &self.own) {
            for by_rad in quarters.iter().chain(&by_rad) {
                let mut start = self.plan.fit.start.clone();
                start[index.index()] += by_rad;
                starts.push(start);
            }
        }
        let steps = self.plan.fit.max_iterations;
        let scores = starts.iter().filter_map(|start| self.score(&self.own, start, steps, None));
        scores.max_by(|one, other| one.total.total_cmp(&other.total))
    }

    /// The score of the study's own reading with errors as large as they may be: held to small ones, a lever arm of a metre leaves a residual
    /// in which nothing shows how large it is.
    fn with_large_errors(&self, size_m: f64) -> Option<Score> {
        let size = |id: SymbolId| match self.plan.chain.symbol(id).quantity {
            Quantity::Length => TOOL_SHARE * size_m,
            _ => MOST_TILT_RAD,
        };
        let sizes = estimated(self.plan).map(|id| (id, size(id))).collect();
        let options = FitOptions { sizes, max_iterations: self.object_steps(), ..self.options.clone() };
        self.score_by(&self.own, &options, None)
    }

    /// The other readings that come out best, fitted to the end, the best first.
    pub fn others(&self, as_read: &Score) -> Vec<Tried> {
        let indexed = indexed(self.plan, &self.own).into_iter().map(|(joint, _)| joint).collect();
        let all = hypotheses::all(self.plan, &self.columns, indexed, (&self.own, self.sample));
        if self.own.unknowns.is_some() {
            return self.nearest(all);
        }
        let screened = |hypothesis| self.screened(hypothesis, as_read);
        let mut screened: Vec<Tried> = parallel::each_of(all, screened).into_iter().flatten().collect();
        screened.extend(self.of_rows(&screened, as_read));
        best_first(&mut screened);
        let mut finalists = self.to_the_end(&screened);
        finalists.extend(self.two_states(as_read));
        finalists.extend(self.in_another_frame());
        best_first(&mut finalists);
        // A second mistake explains what the first leaves.
        let single = finalists.first().cloned();
        let is_rough = |tried: &Tried| tried.score.is_off(ROUGH_SHARE);
        if as_read.is_off(ROUGH_SHARE) && single.as_ref().is_none_or(is_rough) {
            let mut pairs = self.pairs(&screened);
            best_first(&mut pairs);
            let pairs = self.to_the_end(&pairs).into_iter();
            finalists.extend(
                pairs.filter(|pair| single.as_ref().is_none_or(|single| explains(self, pair, &single.score))),
            );
            best_first(&mut finalists);
        }
        finalists
    }

    /// Readings of what observes unknown objects, the best first. Where everything starts tells most of them apart, in no time; few are
    /// fitted.
    fn nearest(&self, all: Vec<Hypothesis>) -> Vec<Tried> {
        let own = at_start(self.plan, &self.own, None);
        // All lengths in another unit, where nothing says how large anything is, are the same data to the fit.
        let is_same =
            |(_, left): (bool, f64)| own.is_some_and(|(_, own)| (left - own).abs() <= ROUNDED * own);
        let of = |hypothesis: Hypothesis| {
            let observations = self.read(&hypothesis)?;
            let near =
                at_start(self.plan, &observations, Some(&hypothesis)).filter(|near| !is_same(*near))?;
            Some((near, hypothesis, observations))
        };
        let mut near: Vec<_> = parallel::each_of(all, of).into_iter().flatten().collect();
        near.sort_by(|(one, ..), (other, ..)| one.0.cmp(&other.0).then(one.1.total_cmp(&other.1)));
        near.truncate(FITTED);
        let fitted = |(_, hypothesis, observations): (_, Hypothesis, Observations)| {
            let score =
                self.score(&observations, &self.plan.fit.start, self.object_steps(), Some(&hypothesis))?;
            Some(Tried { hypothesis, score, observations })
        };
        let mut all: Vec<Tried> = parallel::each_of(near, fitted).into_iter().flatten().collect();
        best_first(&mut all);
        all
    }

    fn object_steps(&self) -> usize {
        self.plan.fit.max_iterations.min(OBJECT_STEPS)
    }

    /// The first of some readings, fitted to the end, the best first.
    fn to_the_end(&self, screened: &[Tried]) -> Vec<Tried> {
        let fitted = |tried: &Tried| {
            let Tried { hypothesis, score, observations } = tried.clone();
            let steps = self.plan.fit.max_iterations;
            let score = self.score(&observations, &score.values, steps, Some(&hypothesis))?;
            Some(Tried { hypothesis, score, observations })
        };
        let nearest: Vec<&Tried> = screened.iter().take(FITTED).collect();
        let mut finalists: Vec<Tried> = parallel::each_of(nearest, fitted).into_iter().flatten().collect();
        best_first(&mut finalists);
        finalists
    }

    /// The best single mistakes of each stage, each with every other, after a few steps from the errors of the first. By itself a mistake of
    /// one stage may hide those of another.
    fn pairs(&self, singles: &[Tried]) -> Vec<Tried> {
        let mut first: Vec<usize> = Vec::new();
        for stage in both::STAGES {
            let of_stage = |at: &usize| both::stage(&singles[*at].hypothesis.reading) == Some(stage);
            first.extend((0..singles.len()).filter(of_stage).take(PAIRED));
        }
        let first = &first;
        let pairs = first.iter().enumerate().flat_map(|(at, one)| {
            let others = (0..singles.len()).filter(move |other| !first[..=at].contains(other));
            let one = &singles[*one];
            others.filter_map(move |other| {
                Some((both::of(&one.hypothesis, &singles[other].hypothesis)?, one.score.values.as_slice()))
            })
        });
        let pairs: Vec<(Hypothesis, &[f64])> = pairs.collect();
        let tried = |(hypothesis, first): (Hypothesis, &[f64])| {
            let observations = self.read(&hypothesis)?;
            let starts = [self.plan.fit.start.as_slice(), first];
            let from = |start: &[f64]| self.score(&observations, start, SCREENED_STEPS, Some(&hypothesis));
            let score = starts.into_iter().filter_map(from).max_by(|a, b| a.total.total_cmp(&b.total))?;
            Some(Tried { hypothesis, score, observations })
        };
        parallel::each_of(pairs, tried).into_iter().flatten().collect()
    }

    /// Rows of two kinds that no column tells apart.
    fn two_states(&self, as_read: &Score) -> Option<Tried> {
        let rows = states::Rows {
            plan: self.plan,
            observations: &self.own,
            labels: &self.sample.undeclared(&self.own),
            jacobian: jacobian(&self.own, &self.columns, None, None),
        };
        let (hypothesis, score) = rows.parted(as_read)?;
        Some(Tried { hypothesis, score, observations: self.own.clone() })
    }

    /// The measured directions turned as a whole: first by what the study starts from, then by the errors that are found so.
    fn in_another_frame(&self) -> Option<Tried> {
        let start = self.plan.fit.start.as_slice();
        let first = frame::turn(self.plan, &self.own, start)?;
        let steps = self.plan.fit.max_iterations;
        let of = |turn: &UnitQuaternion<f64>, start: &[f64]| {
            let observations = frame::turned(&self.own, turn);
            let hypothesis = frame::hypothesis(&observations, turn);
            let mut score = self.score(&observations, start, steps, Some(&hypothesis))?;
            // Turned or not, the numbers of the file are the same ones.
            score.of_numbers(&self.own, &observations, &self.columns);
            Some(Tried { hypothesis, score, observations })
        };
        let first = of(&first, start)?;
        let again = frame::turn(self.plan, &self.own, &first.score.values);
        let again = again.and_then(|turn| of(&turn, &first.score.values));
        again.filter(|again| again.score.total > first.score.total).or(Some(first))
    }

    /// A reading after a few steps, from the errors that the study starts from or from those found so far.
    fn screened(&self, hypothesis: Hypothesis, as_read: &Score) -> Option<Tried> {
        let observations = self.read(&hypothesis)?;
        let from = |start: &[f64]| self.score(&observations, start, SCREENED_STEPS, Some(&hypothesis));
        // Where the study's own reading is near, so are its errors: another start would only come to the same.
        let start = as_read.is_off(ROUGH_SHARE).then_some(self.plan.fit.start.as_slice());
        let scores = start.into_iter().chain([as_read.values.as_slice()]).filter_map(from);
        let score = scores.max_by(|a, b| a.total.total_cmp(&b.total))?;
        Some(Tried { hypothesis, score, observations })
    }

    /// Readings of some rows alone: those that gain most.
    fn of_rows(&self, whole: &[Tried], as_read: &Score) -> Vec<Tried> {
        let row_number = |row: usize| self.own.row_numbers.get(row).unwrap_or_default();
        let mut parts: Vec<(Hypothesis, f64)> = Vec::new();
        let own = self.norms(&self.own, &as_read.values);
        let may_be = |tried: &&Tried| {
            let [_, alone] = self.changes_joints(&tried.hypothesis);
            alone && from_row::may_change(&tried.hypothesis)
        };
        for tried in whole.iter().filter(may_be) {
            let of = |as_read: &[f64], values: &[f64]| {
                let otherwise = &self.norms(&tried.observations, values)?;
                from_row::of_rows(&tried.hypothesis, &from_row::Off { as_read, otherwise }, row_number)
            };
            // Most rows may be as the study reads them, or most otherwise.
            let most = own.as_ref().and_then(|own| of(own, &as_read.values));
            let few =
                self.norms(&self.own, &tried.score.values).and_then(|own| of(&own, &tried.score.values));
            parts.extend([most, few].into_iter().flatten().filter(|(_, gain)| *gain > 0.0));
        }
        parts.sort_by(|one, other| other.1.total_cmp(&one.1));
        parts.truncate(PARTS);
        parts.into_iter().filter_map(|(hypothesis, _)| self.screened(hypothesis, as_read)).collect()
    }

    fn score(
        &self,
        observations: &Observations,
        start: &[f64],
        steps: usize,
        hypothesis: Option<&Hypothesis>,
    ) -> Option<Score> {
        // Objects and stations count from where they were placed.
        let start = start[..self.plan.chain.symbols.len()].to_vec();
        let options = FitOptions { start, max_iterations: steps, ..self.options.clone() };
        self.score_by(observations, &options, hypothesis)
    }

    fn score_by(
        &self,
        observations: &Observations,
        options: &FitOptions,
        hypothesis: Option<&Hypothesis>,
    ) -> Option<Score> {
        score(self.plan, &self.model, observations, options, &self.priors, &self.columns, hypothesis)
    }

    /// The rows with some columns or places read otherwise; `None` where that is impossible, or leaves objects without a place.
    fn read(&self, hypothesis: &Hypothesis) -> Option<Observations> {
        let read = read(self.plan, self.sample, Some(hypothesis))?;
        (read.unknowns.is_none() || read.rows() == self.own.rows()).then_some(read)
    }

    /// How far off each row is, SI; `None` where the rows are not those of the sample.
    fn norms(&self, observations: &Observations, values: &[f64]) -> Option<Vec<f64>> {
        let is_whole = self.plan.sources.len() == 1 && observations.rows() == self.own.rows();
        let off = is_whole.then(|| residuals(&self.model, observations, values).ok()).flatten()?;
        Some(Layout::of(observations).norms(&off).collect())
    }
}

/// What the rows observe with some columns or places read otherwise, objects and stations where they start. A score asks for no
/// uncertainties: which rows belong together is of no account.
fn read(plan: &Plan, sample: &Sample, hypothesis: Option<&Hypothesis>) -> Option<Observations> {
    let (changes, places) = hypothesis.map_or((&[][..], &[][..]), |own| (&own.changes, &own.places));
    let mut observations = sample.observations(plan, changes).ok()?;
    if let Some(unknowns) = &mut observations.unknowns {
        places.iter().for_each(|change| change.make(&mut unknowns.objects, &mut unknowns.stations));
        place(&plan.chain, &mut observations, &plan.fit.start).ok()?;
    }
    Some(Observations { groups: Vec::new(), crossed: Vec::new(), ..observations })
}

/// Whether stations start nowhere near where they are written, and what is left there, over how large things are.
fn at_start(
    plan: &Plan,
    observations: &Observations,
    hypothesis: Option<&Hypothesis>,
) -> Option<(bool, f64)> {
    let unknowns = observations.unknowns.as_ref()?;
    let mut values = plan.fit.start.clone();
    values.resize(plan.chain.symbols.len() + unknowns.numbers(), 0.0);
    let model = Model::without_columns(&plan.chain, &observations.poses);
    let raw = residuals(&model, observations, &values).ok()?;
    let norms: Vec<f64> = Layout::of(observations).norms(&raw).collect();
    let left = trimmed(&norms) / size::of_objects(&plan.chain, observations, &values)?.usual_m;
    let is_strayed = strayed(&written(plan, hypothesis), unknowns, &values).is_some();
    left.is_finite().then_some((is_strayed, left))
}

fn best_first(all: &mut [Tried]) {
    all.sort_by(|one, other| other.score.total.total_cmp(&one.score.total));
}
