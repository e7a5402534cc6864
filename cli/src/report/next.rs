//! Where to measure next, as tables: poses that determine the errors best, and poses that tell effects apart.

use calibration::design::{Criterion, Proposal};
use calibration::report::Separation;

use super::{Reported, quantities};

/// Errors whose uncertainty is told for proposed poses, those that gain most.
const ERRORS: usize = 5;

/// Poses with what they are good for.
pub struct Table {
    /// What measuring there gains.
    pub title: String,
    /// Each joint with its unit.
    pub joints: Vec<String>,
    /// One pose a row, in those units.
    pub poses: Vec<Vec<String>>,
    /// What else to know, a sentence each.
    pub notes: Vec<String>,
}

/// Every proposal of the report.
#[must_use]
pub fn tables(reported: &Reported<'_>) -> Vec<Table> {
    let report = &reported.calibration.report;
    let proposals = report.next_poses.iter().map(|proposal| of_proposal(reported, proposal));
    proposals.chain(report.separating.iter().map(|separation| of_separation(reported, separation))).collect()
}

fn of_proposal(reported: &Reported<'_>, proposal: &Proposal) -> Table {
    let title = match proposal.criterion {
        Criterion::D => "to determine all errors together best",
        Criterion::A => "to make the uncertainties small on average",
    };
    let unit_of = |name: &str| {
        let errors = &reported.calibration.report.errors;
        errors.iter().find(|error| error.name == name).map_or("1", |error| error.unit)
    };
    let mut gains: Vec<_> =
        proposal.uncertainties.iter().filter(|(_, now, then)| now.is_finite() && then < now).collect();
    gains.sort_by(|a, b| (a.2 / a.1).total_cmp(&(b.2 / b.1)));
    let notes = gains.into_iter().take(ERRORS).map(|(name, now, then)| {
        let told = |si| quantities::told(si, unit_of(name));
        format!("the standard uncertainty of {name} would go from {} to {}", told(*now), told(*then))
    });
    let (joints, poses) = in_reading_units(reported, &proposal.joints, &proposal.poses);
    Table { title: title.to_owned(), joints, poses, notes: notes.collect() }
}

fn of_separation(reported: &Reported<'_>, separation: &Separation) -> Table {
    let apart: Vec<&str> = separation.apart.iter().map(|told| told.name.as_str()).collect();
    let title = format!("to tell {} from what explains these data as well", separation.effect);
    let mut notes = Vec::new();
    if !apart.is_empty() {
        notes.push(format!("these poses tell it from {}", apart.join("; ")));
    }
    if !separation.never.is_empty() {
        notes.push(format!("no pose within the ranges tells it from {}", separation.never.join("; ")));
    }
    let (joints, poses) = in_reading_units(reported, &separation.joints, &separation.poses);
    Table { title, joints, poses, notes }
}

/// Names of joints with units, and poses in them.
fn in_reading_units(
    reported: &Reported<'_>,
    joints: &[String],
    poses: &[Vec<f64>],
) -> (Vec<String>, Vec<Vec<String>>) {
    let chain = &reported.calibration.chain;
    let unit = |name: &String| {
        let quantity = chain.find_symbol(name).map(|id| chain.symbol(id).quantity.unit());
        // An angle of a pose is told in degrees, however small.
        quantities::reading(quantity.unwrap_or("1"), 1.0)
    };
    let units: Vec<quantities::Reading> = joints.iter().map(unit).collect();
    let names = joints.iter().zip(&units).map(|(name, unit)| quantities::name_with_unit(name, unit.name));
    let rows = poses.iter().map(|pose| {
        pose.iter().zip(&units).map(|(value, unit)| format!("{:.2}", value / unit.in_si)).collect()
    });
    (names.collect(), rows.collect())
}
