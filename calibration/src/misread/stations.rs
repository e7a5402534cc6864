//! Stations that come out nowhere near where the study roughly puts them, with residuals as small as ever: a room seen in a mirror.
//!
//! Beside unknown objects a joint that runs the other way fits as well, in a room whose left is right. Rough poses tell.

use serde::Serialize;

use super::policy::FAR;
use fit::robust;
use observe::unknowns::{Freedom, Pose, Station, Unknowns};

/// A station that is off.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Strayed {
    /// Its label.
    pub station: String,
    /// How far from where the study puts it, beside the others, m.
    pub away_m: f64,
    /// How far it is turned, rad.
    pub turn_rad: f64,
}

/// That which is off most where most are off, by what the study writes and by a fit; `None` where they are not.
pub(crate) fn strayed(written: &[Station], unknowns: &Unknowns, values: &[f64]) -> Option<Strayed> {
    let there = unknowns.at(unknowns.state(values));
    off(written, &there).filter(|(off, _)| *off > FAR).map(|(_, furthest)| furthest)
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
        let mut furthest = Strayed { station: String::new(), away_m: 0.0, turn_rad: 0.0 };
        let mut all: Vec<f64> = Vec::new();
        let mut most = 0.0;
        for (own, pose, away_m) in &pairs {
            let away = (frame.apply(&pose.shift) - own.pose.shift).norm();
            let turn_rad = (frame.turn * pose.turn).angle_to(&own.pose.turn);
            let off = away / away_m + turn_rad;
            if off > most {
                most = off;
                furthest = Strayed { station: own.label.clone(), away_m: away, turn_rad };
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
