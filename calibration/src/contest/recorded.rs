//! The contest as it is told: who competed, what speaks for each, what each costs, and why it is or is not told.

use evidence::families::Law;
use evidence::{Finding, Outcome, Policy, Reason, Step};
use serde::Serialize;

/// A hypothesis of the contest, and how it came out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Hypothesis {
    /// Its name; of an effect that of the catalogue.
    pub name: String,
    /// Where it acts: `tube.Rx`, or `tube.tilt` of both tilts.
    pub place: String,
    /// What it follows: a joint, an input, `order`; empty of a constant.
    pub driver: String,
    /// Whether the explanation that is told holds it.
    pub told: bool,
    /// What it gains of log evidence beside all that is told but the causes, nats; absent where these take up all that it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gain: Option<f64>,
    /// What it costs, nats: the logarithm of how many others of its kind could stand in its place.
    pub price: f64,
    /// Its share of the posterior among the causes that explain the same; zero where it is none of these.
    pub share: f64,
    /// How far it is behind the best of them, nats; absent where it is none of these.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub behind: Option<f64>,
    /// The cause that is told and that it competes with; absent where it competes with none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub instead_of: Option<String>,
    /// Root mean square of what these data show of it beside what is told, rad or m.
    pub shows: f64,
    /// Root mean square that it would need to be told, rad or m; absent where what is told takes up all that it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub needs: Option<f64>,
    /// Why it left again, where it had come.
    pub left: Option<String>,
}

impl Hypothesis {
    /// Whether it is one to the data with the cause that it competes with.
    #[must_use]
    pub fn is_one_with_it(&self) -> bool {
        self.behind.is_some_and(|behind| behind <= Policy::default().even)
    }
}

/// The family that stands for a finding: of the catalogue's effects that are one to the data the first. None where none is among those
/// that explain it.
pub(super) fn leader(outcome: &Outcome<'_>, finding: &Finding, even: f64) -> Option<usize> {
    let offered = |family: usize| match outcome.families()[family].law {
        Law::Offered(number) => Some(number),
        _ => None,
    };
    let named = || finding.set.iter().filter_map(|&(family, score)| Some((offered(family)?, family, score)));
    let best = named().map(|(.., score)| score).fold(f64::NEG_INFINITY, f64::max);
    named()
        .filter(|(.., score)| *score >= best - even)
        .min_by_key(|(number, ..)| *number)
        .map(|(_, family, _)| family)
}

/// All hypotheses of a contest, those that are told first, then by what they gain.
pub(super) fn recorded(outcome: &Outcome<'_>, even: f64) -> Vec<Hypothesis> {
    let stands = |finding: &Finding| leader(outcome, finding, even).unwrap_or(finding.family);
    let leaders: Vec<usize> = outcome.findings().iter().map(stands).collect();
    let causes: Vec<usize> = outcome.findings().iter().map(|finding| finding.family).collect();
    let mut all: Vec<Hypothesis> = (outcome.contest().into_iter())
        .filter_map(|competitor| {
            let own = outcome.explain(competitor.family)?;
            let finding = outcome.findings().iter().find(|finding| score(finding, own.family).is_some());
            let best = finding.map(|finding| finding.set.iter().map(|(_, score)| *score));
            let best = best.map(|scores| scores.fold(f64::NEG_INFINITY, f64::max));
            let behind = finding.and_then(|finding| Some(best? - score(finding, own.family)?));
            let instead_of = finding.map(stands).filter(|leader| *leader != own.family);
            let told = leaders.contains(&own.family) || (own.told && !causes.contains(&own.family));
            Some(Hypothesis {
                name: name(outcome, own.family),
                place: outcome.place(own.family),
                driver: outcome.driver(own.family),
                told,
                gain: competitor.gain.is_finite().then_some(competitor.gain),
                price: own.price,
                share: competitor.share,
                behind,
                instead_of: instead_of.map(|leader| name(outcome, leader)),
                shows: own.shows,
                needs: own.needs,
                left: competitor.steps.last().and_then(|step| why(outcome, step)),
            })
        })
        .collect();
    let net = |own: &Hypothesis| own.gain.map_or(f64::NEG_INFINITY, |gain| gain - own.price);
    all.sort_by(|a, b| b.told.cmp(&a.told).then(net(b).total_cmp(&net(a))));
    all
}

fn score(finding: &Finding, family: usize) -> Option<f64> {
    finding.set.iter().find(|(own, _)| *own == family).map(|(_, score)| *score)
}

/// Why a family left, by its last step; none where it stayed.
fn why(outcome: &Outcome<'_>, step: &Step) -> Option<String> {
    if step.came || outcome.active().iter().any(|(family, _)| *family == step.family) {
        return None;
    }
    Some(match step.reason {
        Reason::Best | Reason::NoGain => "gains nothing beside the others".to_owned(),
        Reason::Swapped(other) => format!("{} explains the same better", name(outcome, other)),
        Reason::OneForTwo(other) => format!("{} explains what it and another did", name(outcome, other)),
        Reason::Unpacked => "named effects explain that function better".to_owned(),
        Reason::Shaped(other) => format!("{} explains that function better", name(outcome, other)),
    })
}

/// A family's name, plainly.
fn name(outcome: &Outcome<'_>, family: usize) -> String {
    let (driver, place) = (outcome.driver(family), outcome.place(family));
    match outcome.families()[family].law {
        Law::Smooth(0) => format!("smooth function of {driver} at {place}"),
        Law::Smooth(1) => format!("rough function of {driver} at {place}"),
        Law::Smooth(number) => format!("short-ranged function {} of {driver} at {place}", number - 1),
        Law::Surface => format!("function of {} at {place}", driver.replace('&', " and ")),
        Law::Shape(shape) => {
            format!("{} of {driver} at {place}", format!("{:?}", shape.kind).to_lowercase())
        }
        Law::Walk => format!("wandering along the rows at {place}"),
        Law::Sessions => format!("sessions at {place}"),
        Law::Setups(count) => format!("{count} set-ups at {place}"),
        Law::StepAt(_) => format!("step in {driver} at {place}"),
        _ => outcome.name(family),
    }
}
