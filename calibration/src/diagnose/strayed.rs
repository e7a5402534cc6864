//! Stations that come out nowhere near where the study roughly puts them, with residuals as small as ever: a room seen in a mirror.
//!
//! Beside unknown objects a joint that runs the other way fits as well, in a room whose left is right. Rough poses tell.

use serde::Serialize;

use super::mistakes::{Misreading, Undo, mistakes};
use super::otherwise::{left_by, placed, sample};
use crate::search::context::Context;
use fit::{FitResult, robust};
use observe::unknowns::{Freedom, Pose, Station, Unknowns};

/// Most stations are off by more than this, as a share of how far away objects are and in rad together.
const FAR: f64 = 0.5;

/// A mistake explains it where they are off by less than this share of it, and the residual is hardly larger; one of several, where they
/// are off by no more than so many times what the best leaves, or by no more than rough places are.
const LEFT: f64 = 0.3;
const HARDLY_LARGER: f64 = 1.5;
const AS_GOOD: f64 = 2.0;
const ROUGHLY: f64 = 0.05;

/// A station that is off.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Strayed {
    /// Its label.
    pub station: String,
    /// How far from where the study puts it, beside the others, m.
    pub away_m: f64,
    /// How far it is turned, rad.
    pub turn_rad: f64,
    /// What would explain it, the mistake first that is made most; empty where nothing that is tried does.
    pub mistakes: Vec<Misreading>,
}

/// That which is off most where most are off, and what explains it; `None` where they are not.
pub(super) fn strayed(whole: &Context<'_>, fit: &FitResult) -> Option<Strayed> {
    let (request, plan) = (whole.request, whole.request.plan);
    let unknowns = request.observations.unknowns.as_ref()?;
    let there = unknowns.at(unknowns.state(&fit.values));
    let (off, furthest) = off(&plan.places.stations, &there)?;
    if off <= FAR {
        return None;
    }
    let sample = sample(request.observations);
    let before = left_by(whole, &placed(whole, &sample, None)?.observations)?;
    let explains = |undo: &Undo| {
        let placed = placed(whole, &sample, Some(undo))?;
        let left = left_by(whole, &placed.observations)?;
        let (now, _) = self::off(&placed.written, &left.there)?;
        (now < LEFT * off && left.rms <= HARDLY_LARGER * before.rms).then_some(now)
    };
    let mistakes = mistakes(&plan.chain, &plan.places, &sample).into_iter();
    let mistakes = mistakes.filter(|(mistake, _)| mirrors(mistake));
    let mut found: Vec<(Misreading, f64)> =
        mistakes.filter_map(|(mistake, undo)| Some((mistake, explains(&undo)?))).collect();
    let best = found.iter().map(|(_, now)| *now).fold(f64::INFINITY, f64::min);
    found.retain(|(_, now)| *now <= ROUGHLY.max(AS_GOOD * best));
    let mistakes = found.into_iter().map(|(mistake, _)| mistake).collect();
    Some(Strayed { mistakes, ..furthest })
}

/// Whether a mistake moves stations and leaves residuals as they are.
fn mirrors(mistake: &Misreading) -> bool {
    matches!(
        mistake,
        Misreading::Reversed { .. }
            | Misreading::ExchangedXY { .. }
            | Misreading::HeadingsReversed
            | Misreading::HeadingsFromY { .. }
    )
}

/// By how much most stations are off from where they are written to be, and which is furthest off. Where nothing holds the frame they
/// are laid over the one that puts the others nearest.
fn off(written: &[Station], there: &Unknowns) -> Option<(f64, Strayed)> {
    let away_m = there.away_m();
    let pairs = written.iter().filter_map(|own| {
        let at = there.stations.iter().position(|station| station.label == own.label)?;
        Some((own, &there.stations[at].pose, away_m[at]))
    });
    let pairs: Vec<(&Station, &Pose, f64)> = pairs.filter(|(_, _, away_m)| *away_m > 0.0).collect();
    let is_held = there.objects.iter().any(|own| own.freedom != Freedom::Free)
        || written.iter().any(|own| own.freedom != Freedom::Free);
    let turned = |(own, ..): &(&Station, &Pose, f64)| own.pose.turn.angle() > 0.0;
    // Headings that nobody writes say nothing.
    if pairs.len() < 2 || !pairs.iter().any(turned) {
        return None;
    }
    let frames: Vec<Pose> = match is_held {
        true => vec![Pose::default()],
        false => pairs.iter().map(|(own, pose, _)| laid(pose, &own.pose)).collect(),
    };
    let from = |frame: &Pose| {
        let mut furthest =
            Strayed { station: String::new(), away_m: 0.0, turn_rad: 0.0, mistakes: Vec::new() };
        let mut all: Vec<f64> = Vec::new();
        let mut most = 0.0;
        for (own, pose, away_m) in &pairs {
            let away = (frame.apply(&pose.shift) - own.pose.shift).norm();
            let turn_rad = (frame.turn * pose.turn).angle_to(&own.pose.turn);
            let off = away / away_m + turn_rad;
            if off > most {
                most = off;
                furthest =
                    Strayed { station: own.label.clone(), away_m: away, turn_rad, mistakes: Vec::new() };
            }
            all.push(off);
        }
        // The one that the others are laid over is where it is.
        if !is_held {
            all.sort_by(f64::total_cmp);
            all.remove(0);
        }
        (robust::median(all), furthest)
    };
    frames.iter().map(from).min_by(|one, other| one.0.total_cmp(&other.0))
}

/// The motion of the frame that lays a pose over another.
fn laid(from: &Pose, to: &Pose) -> Pose {
    let turn = to.turn * from.turn.inverse();
    Pose { turn, shift: to.shift - turn * from.shift }
}
