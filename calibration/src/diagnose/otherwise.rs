//! A fit that is far off, and the one mistake that would explain it: coordinates exchanged, zenith distances for elevations, gon for
//! degrees. Each is undone and the rows are fitted once more; those that leave a small part of the residual are named.

use model_core::{Quantity, SymbolId};
use nalgebra::Vector3;
use serde::Serialize;

use super::mistakes::{Misreading, Undo, mistakes, range};
use crate::search::context::Context;
use fit::noise::{Layout, NoiseOptions};
use fit::{FitOptions, Model, fit, residuals, robust};
use network::{place, rows};
use observe::unknowns::{Station, Unknowns};
use observe::{Observations, SiUnit};

/// Rows that are fitted at most, evenly spread.
const ROWS: usize = 1500;

/// The share of rows that lies furthest off, of which a mistake need not explain anything.
const FURTHEST: f64 = 0.02;

/// What was read otherwise explains the residual where no more than this share of it is left; one of several, where it leaves no more than
/// so many times what the best leaves.
const LEFT: f64 = 0.1;
const AS_GOOD: f64 = 2.0;

/// A large error is explained where all angles are small without it, rad, and the residual is hardly larger.
const SMALL_RAD: f64 = 0.1;
const HARDLY_LARGER: f64 = 1.5;

/// A mistake is worth a fit where rows start from so much smaller a residual without it, and so many are fitted.
const NEARER: f64 = 0.5;
const FITTED: usize = 6;

/// Steps of such a fit.
const STEPS: usize = 20;

/// So many are named at most.
const MOST: usize = 3;

/// What explains the residual, and what is left of it then.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Otherwise {
    /// What is likely wrong: what explains the data about as well, the mistake first that is made most.
    pub mistakes: Vec<Misreading>,
    /// RMS of the residual as the data were read, without the rows furthest off, SI.
    pub before: f64,
    /// The same without the first mistake.
    pub after: f64,
    /// Their unit.
    pub unit: SiUnit,
}

/// Why it is worth looking.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Doubt {
    /// The residual is large.
    Residual,
    /// The residual is not, but an error is.
    Error,
}

/// The mistakes that explain it, where rows observe objects; `None` if none does.
pub(super) fn otherwise(whole: &Context<'_>, doubt: Doubt) -> Option<Otherwise> {
    let plan = whole.request.plan;
    whole.request.observations.unknowns.as_ref()?;
    let sample = sample(whole.request.observations);
    let placed = placed(whole, &sample, None)?;
    let (from, before) = (placed.relative, left_by(whole, &placed.observations)?);
    let explains = |mistake: &Misreading, left: &Left| match doubt {
        Doubt::Residual => {
            left.relative() <= LEFT * before.relative()
                && (mistake.changes_size() || left.rms <= LEFT * before.rms)
        }
        Doubt::Error => left.largest_rad < SMALL_RAD && left.rms <= HARDLY_LARGER * before.rms,
    };
    // Where everything starts tells most of them apart, in no time; few are fitted.
    let starts = mistakes(&plan.chain, &plan.places, &sample).into_iter().enumerate().filter_map(
        |(number, (mistake, undo))| Some((number, mistake, self::placed(whole, &sample, Some(&undo))?)),
    );
    let nearer = |placed: &Placed| doubt == Doubt::Error || placed.relative < NEARER * from;
    let mut starts: Vec<(usize, Misreading, Placed)> =
        starts.filter(|(_, _, placed)| nearer(placed)).collect();
    starts.sort_by(|a, b| a.2.relative.total_cmp(&b.2.relative));
    starts.truncate(FITTED);
    starts.sort_by_key(|(number, ..)| *number);
    let mut found: Vec<(Misreading, Left)> = Vec::new();
    for (_, mistake, placed) in starts {
        let left = left_by(whole, &placed.observations);
        let left = left.filter(|left| explains(&mistake, left));
        found.extend(left.map(|left| (mistake, left)));
    }
    // Counted from elsewhere, a joint that runs the other way is no more than that.
    let reversed = |one: &Misreading| match one {
        Misreading::FromZenith { joint } => Some(joint.clone()),
        _ => None,
    };
    let is_reversed = |joint: &String| {
        found.iter().any(|(other, _)| matches!(other, Misreading::Reversed { joint: own } if own == joint))
    };
    let twice: Vec<bool> =
        found.iter().map(|(one, _)| reversed(one).as_ref().is_some_and(is_reversed)).collect();
    let mut twice = twice.into_iter();
    found.retain(|_| twice.next() == Some(false));
    let best = found.iter().map(|(_, left)| left.relative()).fold(f64::INFINITY, f64::min);
    found.retain(|(_, left)| left.relative() <= AS_GOOD * best);
    found.truncate(MOST);
    let after = found.first()?.1.rms;
    let unit = sample.poses.series.first()?.measure.unit();
    let mistakes = found.into_iter().map(|(mistake, _)| mistake).collect();
    Some(Otherwise { mistakes, before: before.rms, after, unit })
}

/// Rows that tell a mistake, evenly spread.
pub(super) fn sample(observations: &Observations) -> Observations {
    let step = observations.rows().div_ceil(ROWS).max(1);
    observations.select(&(0..observations.rows()).step_by(step).collect::<Vec<usize>>())
}

/// What a fit leaves.
#[derive(Debug, Clone)]
pub(super) struct Left {
    /// RMS without the rows furthest off, SI.
    pub rms: f64,
    /// How large things are, m.
    size_m: f64,
    /// The largest error that is an angle, rad.
    largest_rad: f64,
    /// Where objects and stations come out.
    pub there: Unknowns,
}

impl Left {
    /// In units of how large things are: a room that is read a thousand times as large has residuals a thousand times as large, and
    /// joints that hardly move reach hardly more than one point.
    fn relative(&self) -> f64 {
        self.rms / self.size_m
    }
}

/// Rows with a mistake undone, objects and stations where they start.
pub(super) struct Placed {
    pub observations: Observations,
    /// Where the study writes that stations stood.
    pub written: Vec<Station>,
    /// What is left at the start, in units of how large things are.
    relative: f64,
}

/// `None` where there is nowhere to start from.
pub(super) fn placed(whole: &Context<'_>, sample: &Observations, undo: Option<&Undo>) -> Option<Placed> {
    let plan = whole.request.plan;
    let mut observations = sample.clone();
    let unknowns = observations.unknowns.as_mut()?;
    // As the study says; where the rest is comes from the rows anew.
    for station in unknowns.stations.iter_mut().filter(|own| !own.label.is_empty()) {
        *station = plan.places.station(&station.label);
    }
    for object in &mut unknowns.objects {
        *object = plan.places.object(&object.label, object.shape);
    }
    undo.iter().for_each(|undo| undo.undo(&mut observations));
    let unknowns = observations.unknowns.as_mut()?;
    let written = unknowns.stations.iter().filter(|own| own.is_written()).cloned().collect();
    place(&plan.chain, &mut observations, &plan.fit.start).ok()?;
    if observations.rows() < sample.rows() {
        return None;
    }
    let numbers = observations.unknowns.as_ref()?.numbers();
    let mut values = plan.fit.start.clone();
    values.resize(plan.chain.symbols.len() + numbers, 0.0);
    let model = Model::without_columns(&plan.chain, &observations.poses);
    let raw = residuals(&model, &observations, &values).ok()?;
    let relative = trimmed_rms(&observations, &raw)? / size_m(whole, &observations, &values)?;
    Some(Placed { observations, written, relative })
}

/// What a fit of them leaves.
pub(super) fn left_by(whole: &Context<'_>, observations: &Observations) -> Option<Left> {
    let plan = whole.request.plan;
    let noise = NoiseOptions { variance: false, serial: false, ..plan.fit.noise.by_residuals() };
    let options =
        FitOptions { noise, max_iterations: plan.fit.max_iterations.min(STEPS), ..plan.fit.clone() };
    let fit = fit(&plan.chain, observations, &options).ok()?;
    let unknowns = observations.unknowns.as_ref()?;
    let is_angle = |id: &&SymbolId| plan.chain.symbol(**id).quantity == Quantity::Angle;
    let angles = fit.parameters.iter().filter(is_angle).map(|id| fit.values[id.index()].abs());
    Some(Left {
        rms: trimmed_rms(observations, &fit.residuals.raw)?,
        size_m: size_m(whole, observations, &fit.values)?,
        largest_rad: angles.fold(0.0, f64::max),
        there: unknowns.at(&fit.values[plan.chain.symbols.len()..]),
    })
}

/// How large things are, m: how far what is observed usually lies from the middle of all, as the chain has it, or how long ranges are where
/// they are shorter. One coordinate that is read as too large makes the whole room large.
fn size_m(whole: &Context<'_>, observations: &Observations, values: &[f64]) -> Option<f64> {
    let points = rows(&whole.request.plan.chain, observations, observations.unknowns.as_ref()?, values);
    let middle = points.iter().map(|row| row.point).sum::<Vector3<f64>>() / points.len() as f64;
    let spread = robust::median(points.iter().map(|row| (row.point - middle).norm()).collect());
    let range = range(&whole.request.plan.chain, observations);
    let ranges = observations.poses.columns.iter().find(|(id, _)| Some(*id) == range);
    let size = ranges.map_or(spread, |(_, own)| robust::median(own.clone()).abs().min(spread));
    (size > 0.0).then_some(size)
}

/// RMS of the residual without the rows furthest off, SI; `None` where more have none.
fn trimmed_rms(observations: &Observations, raw: &[f64]) -> Option<f64> {
    let layout = Layout::of(observations);
    let mut squares: Vec<f64> = layout.norms(raw).map(|norm| norm * norm).collect();
    let all = squares.len();
    squares.retain(|square| square.is_finite());
    squares.sort_by(f64::total_cmp);
    let kept = all - (all as f64 * FURTHEST) as usize;
    squares.truncate(kept);
    (squares.len() == kept && kept > 0).then(|| (squares.iter().sum::<f64>() / kept as f64).sqrt())
}
