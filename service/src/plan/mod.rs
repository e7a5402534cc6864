//! A first campaign: how many poses, where, and what standard uncertainty to expect of each wanted error.
//!
//! Poses are chosen by the engine that proposes where to measure next (`calibration::design`). Here they come from limits and
//! constraints, and go out in words.

mod axes;
mod constraint;
mod lost;
mod page;
mod text;

use calibration::design::campaign::{self, Campaign, Wanted};
use model_core::budget::spread;
use model_core::{Chain, ObservableId, SymbolId, SymbolKind};
use observe::{Measure, SiUnit};

use crate::errors_file;
use crate::refusal::Refusal;

pub use axes::Axis;
pub use constraint::Constraint;
pub use page::{as_csv, page, svg};
pub use text::{as_json, as_text};

/// Poses that are compared at most.
const CANDIDATES: usize = 500;

/// Poses that are tried for each that is compared: constraints refuse the others.
const TRIED: usize = 40;

/// A campaign that is asked for.
pub struct Asked<'a> {
    /// The declaration.
    pub chain: &'a Chain,
    /// What is observed.
    pub observable: ObservableId,
    /// What its numbers are.
    pub measure: Measure,
    /// The standard deviation of each component, rad or m.
    pub sigma: Vec<f64>,
    /// The errors to know, with the standard uncertainty that is wanted of each, SI.
    pub wanted: Vec<(SymbolId, f64)>,
    /// What can be set, with its limits.
    pub axes: Vec<Axis>,
    /// What must hold at each pose.
    pub constraints: Vec<Constraint>,
    /// The standard deviation of each error before anything is measured, by [`SymbolId`], SI: zero leaves one out.
    pub prior: Option<Vec<f64>>,
    /// So many poses; none: as few as do.
    pub count: Option<usize>,
}

/// A campaign that is proposed.
pub struct Planned {
    /// The poses: a value of each axis, SI.
    pub poses: Vec<Vec<f64>>,
    /// What to expect of each wanted error, in the order in which they were asked for.
    pub errors: Vec<Expected>,
    /// About how many poses do, where as many as are proposed at most do not.
    pub needed: Option<f64>,
    /// Poses that were compared.
    pub candidates: usize,
}

/// What to expect of a wanted error.
pub struct Expected {
    /// The error.
    pub error: SymbolId,
    /// The standard uncertainty that is wanted, SI.
    pub wanted: f64,
    /// The one to expect, SI; none where the poses do not determine the error.
    pub expected: Option<f64>,
    /// Why no number of poses reaches what is wanted, where that is so.
    pub lost: Option<String>,
}

impl Expected {
    /// Whether the campaign reaches what is wanted.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.expected.is_some_and(|expected| expected <= self.wanted)
    }
}

impl Planned {
    /// Whether every wanted error is reached.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.errors.iter().all(Expected::is_reached)
    }
}

/// The errors of a chain that some patterns name, each once, in the order of the chain.
///
/// # Errors
/// A pattern that names none.
pub fn errors_named(chain: &Chain, patterns: &[String]) -> Result<Vec<SymbolId>, Refusal> {
    let mut named = Vec::new();
    for pattern in patterns {
        let own = errors_file::errors_named(chain, pattern);
        named.extend(own.map_err(|why| Refusal::Input(format!("--for: {why}")))?);
    }
    named.sort_unstable();
    named.dedup();
    Ok(named)
}

/// What is measured of an observable where no study says it: a direction, a point or an orientation.
///
/// # Errors
/// It shows single readings.
pub fn measure_of(chain: &Chain, observable: ObservableId) -> Result<Measure, Refusal> {
    let shown = chain.observable(observable);
    Measure::whole(shown).ok_or_else(|| {
        let name = &shown.name;
        Refusal::Input(format!(
            "`{name}` shows single readings, and a campaign measures a whole direction or point: name one with --observable"
        ))
    })
}

/// Proposes the campaign.
///
/// # Errors
/// No pose is allowed, or the observable has no value at the poses.
pub fn plan(asked: &Asked<'_>) -> Result<Planned, Refusal> {
    let chain = asked.chain;
    let poses = candidates(asked);
    if poses.is_empty() {
        let refused =
            asked.constraints.iter().map(|own| format!("`{}`", own.text)).collect::<Vec<_>>().join(", ");
        return Err(Refusal::Input(format!(
            "no pose within the limits meets {refused}: widen --range, or loosen --where (a number without a unit is in rad or m)"
        )));
    }
    let way = chain.symbols_of_way(asked.observable);
    let size = |id: &SymbolId| asked.prior.as_ref().map_or(1.0, |prior| prior[id.index()]);
    let on_way = |id: &SymbolId| chain.symbol(*id).kind == SymbolKind::Error && way.contains(id);
    if let Some((left_out, _)) = asked.wanted.iter().find(|(id, _)| size(id) <= 0.0) {
        let name = &chain.symbol(*left_out).name;
        return Err(Refusal::Input(format!("the sizes leave `{name}` out: give it one in --sizes")));
    }
    let estimated: Vec<SymbolId> =
        chain.symbols_of(SymbolKind::Error).filter(|id| on_way(id) && size(id) > 0.0).collect();
    let wanted: Vec<(SymbolId, f64)> = asked.wanted.iter().filter(|(id, _)| on_way(id)).copied().collect();
    let columns: Vec<(SymbolId, Vec<f64>)> = asked
        .axes
        .iter()
        .enumerate()
        .map(|(at, axis)| (axis.symbol, poses.iter().map(|pose| pose[at]).collect()))
        .collect();
    let prior: Option<Vec<f64>> =
        asked.prior.as_ref().map(|prior| estimated.iter().map(|id| prior[id.index()]).collect());
    let found = match wanted.is_empty() {
        true => None,
        false => {
            let wanted = Wanted {
                observable: asked.observable,
                measure: asked.measure,
                sigma: &asked.sigma,
                errors: &wanted,
                estimated: &estimated,
                prior: prior.as_deref(),
                count: asked.count,
            };
            Some(campaign::propose(chain, &columns, &wanted).map_err(Refusal::of)?)
        }
    };
    let chosen = found.as_ref().map_or(&[][..], |found| &found.poses);
    let errors = told(asked, &wanted, found.as_ref());
    Ok(Planned {
        poses: chosen.iter().map(|&at| poses[at].clone()).collect(),
        errors,
        needed: found.as_ref().and_then(|found| found.needed),
        candidates: poses.len(),
    })
}

/// What to expect of each error, and why not more.
fn told(asked: &Asked<'_>, wanted: &[(SymbolId, f64)], found: Option<&Campaign>) -> Vec<Expected> {
    let mut why = lost::Why::new(asked.chain, asked.observable);
    let of = |&(error, size): &(SymbolId, f64)| {
        let at = wanted.iter().position(|(other, _)| *other == error);
        let (Some(at), Some(found)) = (at, found) else {
            return Expected { error, wanted: size, expected: None, lost: Some(why.off_the_way(error)) };
        };
        let is_lost = found.limit[at] >= size;
        let lost = is_lost.then(|| why.of(error, &found.beside[at], found.limit[at]));
        Expected { error, wanted: size, expected: found.expected[at], lost }
    };
    asked.wanted.iter().map(of).collect()
}

/// Poses that can be set within the limits, each once, that meet all constraints.
fn candidates(asked: &Asked<'_>) -> Vec<Vec<f64>> {
    let nominal = asked.chain.nominal_values();
    let unit = vec![(0.0, 1.0); asked.axes.len()];
    let mut seen = std::collections::BTreeSet::new();
    let mut poses = Vec::new();
    for fractions in spread(&unit, CANDIDATES * TRIED) {
        let steps: Vec<i64> = asked.axes.iter().zip(&fractions).map(|(axis, at)| axis.step_at(*at)).collect();
        if !seen.insert(steps.clone()) {
            continue;
        }
        let pose: Vec<f64> = asked.axes.iter().zip(&steps).map(|(axis, step)| axis.value(*step)).collect();
        let value = |name: &str| {
            let own = asked.axes.iter().position(|axis| asked.chain.symbol(axis.symbol).name == name);
            // What is no axis is a constant.
            own.map(|at| pose[at]).or_else(|| Some(nominal[asked.chain.find_symbol(name)?.index()]))
        };
        if asked.constraints.iter().all(|own| own.holds(&value)) {
            poses.push(pose);
        }
        if poses.len() == CANDIDATES {
            break;
        }
    }
    poses
}

/// The unit in which an error is told.
fn unit_of(chain: &Chain, error: SymbolId) -> SiUnit {
    chain.symbol(error).quantity.into()
}
