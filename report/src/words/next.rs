//! Where to measure next, as tables: poses that determine the errors best, and poses that separate effects.

use super::numbers::{self, Reading};
use calibration::design::{Criterion, Proposal, Separation};
use calibration::diagnose::Diagnosis;
use observe::SiUnit;

/// Errors whose uncertainty is listed for proposed poses, those that gain most.
const ERRORS: usize = 5;

/// Poses with what they are good for.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseTable {
    /// What measuring there gains.
    pub title: String,
    /// Each joint with its unit, and how often to measure.
    pub joints: Vec<String>,
    /// One pose a row, in those units; poses that are proposed more than once appear once, with how often.
    pub poses: Vec<Vec<String>>,
    /// What else to know, a sentence each.
    pub notes: Vec<String>,
}

/// Every proposal of poses; `unit` is that of a joint by its name.
pub(super) fn tables_of_poses(diagnosis: &Diagnosis, unit: impl Fn(&str) -> SiUnit + Copy) -> Vec<PoseTable> {
    let proposals = diagnosis.next_poses.iter().map(|proposal| of_proposal(diagnosis, proposal, unit));
    let separations = diagnosis.separating.iter().map(|separation| of_separation(separation, unit));
    proposals.chain(separations).collect()
}

fn of_proposal(diagnosis: &Diagnosis, proposal: &Proposal, unit: impl Fn(&str) -> SiUnit) -> PoseTable {
    let title = match proposal.criterion {
        Criterion::D => "to determine all errors together best",
        Criterion::A => "to make the uncertainties small on average",
    };
    let of_error = |(name, now, then): &(String, f64, f64)| Gain::of_error(diagnosis, name, *now, *then);
    let notes = gained(proposal.uncertainties.iter().map(of_error).collect());
    let (joints, poses) = in_reading_units(&proposal.joints, &proposal.poses, unit);
    PoseTable { title: title.to_owned(), joints, poses, notes }
}

/// How surely something is known, and would be.
pub(super) struct Gain {
    pub what: String,
    pub unit: SiUnit,
    pub now: f64,
    pub then: f64,
}

impl Gain {
    /// Of an error.
    pub fn of_error(diagnosis: &Diagnosis, name: &str, now: f64, then: f64) -> Self {
        let error = diagnosis.errors.iter().find(|error| error.name == name);
        Self { what: name.to_owned(), unit: error.map_or(SiUnit::ONE, |error| error.unit), now, then }
    }
}

/// How surely would be known what was known less surely: what gains most.
pub(super) fn gained(mut gains: Vec<Gain>) -> Vec<String> {
    gains.retain(|gain| gain.now.is_finite() && gain.then < gain.now);
    gains.sort_by(|a, b| (a.then / a.now).total_cmp(&(b.then / b.now)));
    let told = gains.into_iter().take(ERRORS).map(|Gain { what, unit, now, then }| {
        let [now, then] = [now, then].map(|si| numbers::told(si, unit));
        format!("the standard uncertainty of {what} would fall from {now} to {then}")
    });
    told.collect()
}

fn of_separation(separation: &Separation, unit: impl Fn(&str) -> SiUnit) -> PoseTable {
    let apart: Vec<&str> = separation.apart.iter().map(|told| told.name.as_str()).collect();
    let title = format!("to separate {} from the other candidate causes", separation.effect);
    let mut notes = Vec::new();
    if !apart.is_empty() {
        notes.push(format!("these poses separate {} from {}", separation.effect, apart.join(", and from ")));
    }
    if !separation.never.is_empty() {
        notes.push(format!(
            "no pose within the ranges separates {} from {}",
            separation.effect,
            separation.never.join(", or from ")
        ));
    }
    let (joints, poses) = in_reading_units(&separation.joints, &separation.poses, unit);
    PoseTable { title, joints, poses, notes }
}

/// Names of joints with units, and poses in them, each once.
fn in_reading_units(
    joints: &[String],
    poses: &[Vec<f64>],
    unit: impl Fn(&str) -> SiUnit,
) -> (Vec<String>, Vec<Vec<String>>) {
    // An angle of a pose is printed in degrees, however small.
    let units: Vec<Reading> = joints.iter().map(|name| numbers::reading(unit(name), 1.0)).collect();
    let mut names: Vec<String> =
        joints.iter().zip(&units).map(|(name, unit)| numbers::name_with_unit(name, &unit.name)).collect();
    let mut rows: Vec<(Vec<String>, usize)> = Vec::new();
    for pose in poses {
        let cells: Vec<String> =
            pose.iter().zip(&units).map(|(value, unit)| format!("{:.2}", value / unit.in_si)).collect();
        match rows.iter_mut().find(|(known, _)| *known == cells) {
            Some((_, times)) => *times += 1,
            None => rows.push((cells, 1)),
        }
    }
    let repeated = rows.iter().any(|&(_, times)| times > 1);
    if repeated {
        names.push("times".to_owned());
    }
    let rows = rows.into_iter().map(|(mut cells, times)| {
        if repeated {
            cells.push(times.to_string());
        }
        cells
    });
    (names, rows.collect())
}
