//! What a contest gives: what is told, with sets and shares; values with their uncertainty; the record.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::average::{Moments, averaged, plain};
use crate::bench::{Bench, Model};
use crate::families::{Driver, Family, Law, Where};
use crate::likelihood::Posterior;
use crate::linearise::Amount;
use crate::margins::Finding;
use crate::noise::Memory;
use crate::problem::{Place, Rows};
use crate::record::Step;
use crate::run::Run;

/// The outcome of a contest.
pub struct Outcome<'a> {
    run: Run<'a>,
    told: Model,
    findings: Vec<Finding>,
}

/// A declared error with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Its name.
    pub name: String,
    /// Its value, averaged over what competes.
    pub value: f64,
    /// Its standard uncertainty, averaged over what competes.
    pub uncertainty: f64,
    /// Whether the data determine it by itself.
    pub determined: bool,
}

/// A hypothesis in the contest.
#[derive(Debug, Clone, PartialEq)]
pub struct Competitor {
    /// Number of its family.
    pub family: usize,
    /// Gain of log evidence beside the explanation that is told (its own cause taken out), nats.
    pub gain: f64,
    /// Price, nats.
    pub price: f64,
    /// Share of the posterior in the set it stands in; zero where it stands in none.
    pub share: f64,
    /// The steps at which it came or left.
    pub steps: Vec<Step>,
}

/// Why a hypothesis is or is not told.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// Number of its family.
    pub family: usize,
    /// Whether it is part of the explanation that is told.
    pub told: bool,
    /// Gain of log evidence beside the others that are told, nats. Minus infinity where they absorb it.
    pub gain: f64,
    /// Price, nats.
    pub price: f64,
    /// RMS of the effect that the data show, in the unit of the residual.
    pub shows: f64,
    /// RMS of the effect that would be named, in the unit of the residual; none where the others absorb it.
    pub needs: Option<f64>,
}

/// New rows at which a prediction is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct NewRows {
    /// Joints, inputs and sessions, as in the problem.
    pub rows: Rows,
    /// Column of each declared error at [`Outcome::estimates`]: rows times components each.
    pub declared: Vec<Vec<f64>>,
    /// The places with their columns there.
    pub places: Vec<Place>,
}

/// Correction of the exact chain at new rows, with the uncertainty of its systematic part.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Mean of each value.
    pub mean: Vec<f64>,
    /// Standard uncertainty of each value, without the noise of a reading.
    pub uncertainty: Vec<f64>,
}

impl<'a> Outcome<'a> {
    pub(crate) fn new(run: Run<'a>, told: Model, findings: Vec<Finding>) -> Self {
        Self { run, told, findings }
    }

    pub(crate) fn bench(&self) -> &Bench<'a> {
        &self.run.bench
    }

    pub(crate) fn told(&self) -> &Model {
        &self.told
    }

    /// The causes of the explanation that is told, named or not.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// All hypotheses.
    #[must_use]
    pub fn families(&self) -> &[Family] {
        &self.run.bench.dictionary.families
    }

    /// The families of the noise in the explanation that is told.
    #[must_use]
    pub fn noise(&self) -> Vec<usize> {
        let families = self.told.active.iter().map(|&(family, _)| family);
        families.filter(|&family| self.run.bench.is_noise(family)).collect()
    }

    /// Active families with their variance over the noise.
    #[must_use]
    pub fn active(&self) -> &[(usize, f64)] {
        &self.told.active
    }

    /// Log evidence less prices of the explanation that is told, up to a constant of the problem.
    #[must_use]
    pub fn odds(&self) -> f64 {
        self.told.odds
    }

    /// Lead of the explanation that is told over the best one without any cause, nats.
    #[must_use]
    pub fn lead_over_none(&self) -> f64 {
        let bare = self.run.reached.iter().filter(|model| self.run.bench.causes(&model.active).is_empty());
        self.told.odds - bare.fold(f64::NEG_INFINITY, |best: f64, model| best.max(model.odds))
    }

    /// Memory of the noise, where it has some.
    #[must_use]
    pub fn memory(&self) -> Option<Memory> {
        self.told.state.memory
    }

    /// Degrees of freedom of the noise's tails; infinite where they are Gaussian.
    #[must_use]
    pub fn tails(&self) -> f64 {
        self.run.bench.noises[self.told.state.noise].tails
    }

    /// First row of each found set-up but the first.
    #[must_use]
    pub fn cuts(&self) -> &[usize] {
        self.run.cuts.as_deref().unwrap_or(&[])
    }

    /// Each step of the search.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.run.record.steps
    }

    /// The name of a family: law, driver, place.
    #[must_use]
    pub fn name(&self, family: usize) -> String {
        let law = match self.families()[family].law {
            Law::Offered(number) => return self.run.bench.problem.offered[number].name.clone(),
            law => self::law(law),
        };
        format!("{law}|{}|{}", self.driver(family), self.place(family))
    }

    /// What a family is a function of: `azimuth`; empty of a constant.
    #[must_use]
    pub fn driver(&self, family: usize) -> String {
        let rows = &self.run.bench.problem.rows;
        let joint = |joint: usize| rows.joints[joint].name.as_str();
        match self.families()[family].driver {
            Driver::Nothing => String::new(),
            Driver::Joint(only) => joint(only).to_owned(),
            Driver::Joints(first, second) => format!("{}&{}", joint(first), joint(second)),
            Driver::Input(input) => rows.inputs[input].name.clone(),
            Driver::Gravity => "gravity".to_owned(),
            Driver::Order => "order".to_owned(),
        }
    }

    /// Where a family acts: `fork.Rx`, or `fork.tilt` of both.
    #[must_use]
    pub fn place(&self, family: usize) -> String {
        let (bench, family) = (&self.run.bench, &self.families()[family]);
        let problem = bench.problem;
        match (family.law, family.place) {
            (Law::Offered(number), _) => problem.places[problem.offered[number].place].name.clone(),
            (_, Where::Place(place)) => problem.places[bench.places.distinct[place].place].name.clone(),
            (_, Where::Tilts(frame)) => format!("{}.tilt", problem.frames[frame].name),
        }
    }

    /// Numbers in the problem of the places that a family's place stands for; empty for both tilts of a frame.
    #[must_use]
    pub fn members(&self, family: usize) -> &[usize] {
        match self.families()[family].place {
            Where::Place(place) => &self.run.bench.places.distinct[place].members,
            Where::Tilts(_) => &[],
        }
    }

    /// Who competed, in the order of the registry.
    #[must_use]
    pub fn contest(&self) -> Vec<Competitor> {
        let causes: Vec<usize> = self.findings.iter().map(|found| found.family).collect();
        let others: Vec<(usize, f64)> =
            self.told.active.iter().copied().filter(|(family, _)| !causes.contains(family)).collect();
        let view = self.run.bench.view(self.told.state);
        let gains = view.scan(&others, &|_| true);
        let share = |family: usize| {
            let of = |found: &Finding| {
                found.set.iter().position(|&(own, _)| own == family).map(|at| found.shares[at])
            };
            self.findings.iter().filter_map(of).fold(0.0, f64::max)
        };
        (0..gains.len())
            .map(|family| Competitor {
                family,
                gain: gains[family].nats,
                price: self.families()[family].price,
                share: share(family),
                steps: self.steps().iter().filter(|step| step.family == family).copied().collect(),
            })
            .collect()
    }

    /// Why one hypothesis is or is not told. None for a number that is no family's.
    #[must_use]
    pub fn explain(&self, family: usize) -> Option<Explanation> {
        let bench = &self.run.bench;
        let price = self.families().get(family)?.price;
        let mut active: Vec<(usize, f64)> =
            self.told.active.iter().copied().filter(|&(own, _)| own != family).collect();
        let view = bench.view(self.told.state);
        let gain = view.one(&active, family);
        let unit = bench.scaling.unit;
        let needs = view.needed(&active, family, price + bench.policy.name_margin);
        let mut shows = 0.0;
        if gain.nats.is_finite() {
            active.push((family, gain.variance));
            shows = bench.shown(&active, self.told.state).unwrap_or(0.0);
        }
        let needs = needs.map(|square| unit * square.sqrt());
        Some(Explanation {
            family,
            told: self.told.has(family),
            gain: gain.nats,
            price,
            shows: unit * shows,
            needs,
        })
    }

    /// The declared errors, averaged over what competes. None where the products cannot be factored.
    #[must_use]
    pub fn declared(&self) -> Option<Vec<Estimate>> {
        let quantity = |posterior: &Posterior, point: usize| self.declared_moments(posterior, point);
        averaged(&self.run, &self.told, &self.findings, &quantity).map(|moments| self.estimates_of(&moments))
    }

    /// The declared errors under the explanation that is told alone.
    #[must_use]
    pub fn declared_alone(&self) -> Option<Vec<Estimate>> {
        let quantity = |posterior: &Posterior, point: usize| self.declared_moments(posterior, point);
        plain(&self.run, &self.told.active, self.told.state, &quantity)
            .map(|moments| self.estimates_of(&moments))
    }

    /// The factor of a standard uncertainty for an interval of 95 %.
    #[must_use]
    pub fn quantile(&self) -> f64 {
        let freedom = self.run.bench.scaling.freedom;
        let upper = 0.975;
        if freedom < self.run.bench.policy.t_below {
            StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |t| t.inverse_cdf(upper))
        } else {
            Normal::standard().inverse_cdf(upper)
        }
    }

    /// Estimates of the declared errors at which columns of new rows are to be taken.
    #[must_use]
    pub fn estimates(&self) -> &[f64] {
        &self.run.bench.points[self.told.state.point].estimates
    }

    /// Effects that are in the exact chain where columns of new rows are to be taken.
    #[must_use]
    pub fn effects(&self, rows: &Rows, places: &[Place]) -> Vec<Amount> {
        let bench = &self.run.bench;
        let inside = &bench.points[self.told.state.point].inside;
        let mut table = crate::design::Table::default();
        table.extend(&bench.dictionary, rows, &bench.places, places);
        bench.amounts_of(&table, inside)
    }

    /// The correction at new rows, averaged over what competes.
    #[must_use]
    pub fn predict(&self, new: &NewRows) -> Option<Prediction> {
        let moments = self.run.bench.new_moments(new, self.told.state.point);
        averaged(&self.run, &self.told, &self.findings, &moments).map(|moments| Prediction {
            uncertainty: moments.variance.iter().map(|variance| variance.max(0.0).sqrt()).collect(),
            mean: moments.mean,
        })
    }

    fn declared_moments(&self, posterior: &Posterior, point: usize) -> Moments {
        let bench = &self.run.bench;
        let (unit, combinations) = (bench.scaling.unit, &bench.scaling.combinations);
        let estimates = &bench.points[point].estimates;
        let (mut mean, mut variance) = (estimates.clone(), vec![0.0; estimates.len()]);
        for error in 0..estimates.len() {
            for a in 0..combinations.ncols() {
                mean[error] += unit * combinations[(error, a)] * posterior.mean[a];
                for b in 0..combinations.ncols() {
                    let product =
                        combinations[(error, a)] * posterior.shape[(a, b)] * combinations[(error, b)];
                    variance[error] += product * posterior.variance * unit * unit;
                }
            }
        }
        Moments { mean, variance }
    }

    fn estimates_of(&self, moments: &Moments) -> Vec<Estimate> {
        let errors = self.run.bench.problem.declared.iter().enumerate();
        errors
            .map(|(at, error)| Estimate {
                name: error.name.clone(),
                value: moments.mean[at],
                uncertainty: moments.variance[at].max(0.0).sqrt(),
                determined: self.run.bench.scaling.determined[at],
            })
            .collect()
    }
}

/// A short name of a law.
fn law(law: Law) -> String {
    match law {
        Law::Constant => "constant".into(),
        Law::Scale => "scale".into(),
        Law::Cot => "cot".into(),
        Law::Tan => "tan".into(),
        Law::Direction => "direction".into(),
        Law::DirectionHarmonic => "direction harmonic".into(),
        Law::DirectionSmooth => "direction smooth".into(),
        Law::Harmonic(order) => format!("harmonic {order}"),
        Law::Whirl(order) => format!("whirl {order:+}"),
        Law::Product => "product".into(),
        Law::Smooth(spectrum) => format!("smooth {spectrum}"),
        Law::Surface => "surface".into(),
        Law::Linear => "linear".into(),
        Law::StepAt(part) => format!("step at {part:.2}"),
        Law::Gravity => "gravity".into(),
        Law::Compliance(load) => format!("compliance {load}"),
        Law::AllLoads => "all loads".into(),
        Law::Walk => "walk".into(),
        Law::Sessions => "sessions".into(),
        Law::Setups(count) => format!("{count} set-ups"),
        Law::Offered(number) => format!("offered {number}"),
        Law::Shape(shape) => format!("{:?} at {:.3} wide {:.3}", shape.kind, shape.position, shape.width),
    }
}
