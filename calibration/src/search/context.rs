//! What every stage of one calibration shares: the request, the catalogue for its chain, and how a search decides.

use model_core::{ObservableId, SymbolId};

use super::select::Options;
use super::{SearchError, Stage};
use effects::candidate::{Effect, EffectId, Setting};
use effects::catalogue::{Name, catalogue, chosen, known_names};
use observe::Observations;
use study::{Plan, Sample};

/// What to calibrate.
#[derive(Clone, Copy)]
pub struct Request<'a> {
    /// The user's declaration as written.
    pub text: &'a str,
    /// The study, with every name resolved.
    pub plan: &'a Plan,
    /// The measured data.
    pub observations: &'a Observations,
    /// Some of the rows as their files have them, so that columns can be read otherwise; without them none is.
    pub sample: Option<&'a Sample>,
    /// A second file that no stage sees, if the study names one.
    pub second: Option<&'a Observations>,
    /// The date that the amended declaration gives: `2026-11-21`.
    pub when: &'a str,
}

/// An accepted effect, and the evidence for it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Found {
    pub effect: EffectId,
    pub p_value: f64,
    /// The confounded set that it came in with, itself included.
    pub alike: Vec<EffectId>,
    /// Effects that may be the cause, itself among them, with their shares of the posterior; none where no contest said so.
    pub shares: Vec<(EffectId, f64)>,
}

/// What all stages share.
#[derive(Clone)]
pub(crate) struct Context<'a> {
    pub request: Request<'a>,
    pub catalogue: Vec<Effect>,
    /// What other fields call each effect of the catalogue.
    pub names: Vec<Vec<Name>>,
    pub options: Options,
    pub setting: Setting<'a>,
    /// Numbers that a matrix of the search holds at most.
    pub held: usize,
    /// Is told of each stage.
    pub tell: &'a (dyn Fn(Stage) + Sync),
}

impl<'a> Context<'a> {
    pub fn new(
        request: Request<'a>,
        observables: &'a [ObservableId],
        held: usize,
    ) -> Result<Self, SearchError> {
        let plan = request.plan;
        let setting = plan.search.setting(&plan.chain, observables);
        let options = Options {
            false_alarm: plan.search.false_alarm,
            most: plan.search.most,
            seed: plan.hold_out.seed,
            ..Options::default()
        };
        let catalogue = chosen(&setting, catalogue(&setting), &plan.search.only)
            .map_err(|(number, _)| SearchError::NoSuchEffect { name: plan.search.only[number].clone() })?;
        let names = known_names(&setting, &catalogue);
        Ok(Self { request, catalogue, names, options, setting, held, tell: &|_| () })
    }
}

/// The symbols that the study estimates.
pub(crate) fn declared<'a>(whole: &Context<'a>) -> &'a [SymbolId] {
    &whole.request.plan.fit.estimate
}
