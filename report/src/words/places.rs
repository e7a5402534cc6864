//! Where to put the next station, wall, target, socket, circle or wire, as tables of what to aim at from there.

use super::errors::combination;
use super::next::{Gain, PoseTable, gained};
use super::numbers::{self, Reading};
use calibration::design::{Addition, Criterion, Place, PlaceProposal};
use calibration::diagnose::Diagnosis;
use network::Remedy;
use observe::SiUnit;

/// Pointings of one proposal that a table holds.
const POINTINGS: usize = 12;

/// What gets smaller by less than this is as it was.
const GAINS: f64 = 0.995;

/// What is determined only together with others is listed with them, unless an addition leaves less than this share of its uncertainty
/// and so determines it by itself.
const BY_ITSELF: f64 = 0.5;

/// Every proposal; what both rules propose, once.
pub(super) fn tables_of_places(diagnosis: &Diagnosis, unit: impl Fn(&str) -> SiUnit) -> Vec<PoseTable> {
    let all = &diagnosis.next_places;
    let mut tables = Vec::new();
    for (at, proposal) in all.iter().enumerate() {
        let alike = |other: &&PlaceProposal| other.adds == proposal.adds && other.places == proposal.places;
        if all[..at].iter().any(|other| alike(&other)) {
            continue;
        }
        let aims: Vec<&str> = all.iter().filter(alike).map(|own| aim(own.criterion)).collect();
        tables.push(table(diagnosis, proposal, &aims.join(" and "), &unit));
    }
    tables
}

fn aim(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::D => "to determine all errors together best",
        Criterion::A => "to make the uncertainties small on average",
    }
}

fn table(
    diagnosis: &Diagnosis,
    proposal: &PlaceProposal,
    aim: &str,
    unit: impl Fn(&str) -> SiUnit,
) -> PoseTable {
    let title = format!("{}, {aim}", told_places(proposal));
    let several = proposal.places.len() > 1;
    let units: Vec<Reading> =
        proposal.readings.iter().map(|name| numbers::reading(unit(name), 1.0)).collect();
    let all = || {
        let each = proposal.places.iter().enumerate();
        each.flat_map(|(number, place)| place.pointings.iter().map(move |pointing| (number, pointing)))
    };
    let from = proposal.adds != Addition::Station && all().any(|(_, own)| !own.station.is_empty());
    let at = proposal.adds == Addition::Station;
    let mut joints: Vec<String> = Vec::new();
    joints.extend(several.then(|| "number".to_owned()));
    joints.extend(from.then(|| "from".to_owned()));
    joints.extend(at.then(|| "at".to_owned()));
    joints.extend(
        proposal.readings.iter().zip(&units).map(|(name, unit)| numbers::name_with_unit(name, &unit.name)),
    );
    let poses = all().take(POINTINGS).map(|(number, own)| {
        let mut cells: Vec<String> = Vec::new();
        cells.extend(several.then(|| (number + 1).to_string()));
        cells.extend(from.then(|| own.station.clone()));
        cells.extend(at.then(|| own.object.clone()));
        cells.extend(
            own.readings.iter().zip(&units).map(|(value, unit)| format!("{:.2}", value / unit.in_si)),
        );
        cells
    });
    let poses = poses.collect();
    let mut notes = Vec::new();
    let count = all().count();
    if count > POINTINGS {
        notes.push(format!(
            "there are {count} pointings in all, much like these. report.json lists every one"
        ));
    }
    let is_told = |(name, now, then): &&(String, f64, f64)| {
        let together = diagnosis.errors.iter().any(|error| error.name == *name && !error.separable);
        !proposal.never.contains(name) && *then < if together { BY_ITSELF } else { 1.0 } * now
    };
    let errors = proposal.uncertainties.iter().filter(is_told);
    let errors = errors.map(|(name, now, then)| Gain::of_error(diagnosis, name, *now, *then));
    let together = diagnosis.estimable.iter().zip(&proposal.combinations);
    let together =
        together.map(|(own, &(now, then))| Gain { what: combination(own), unit: own.unit, now, then });
    let gains = gained(errors.chain(together).filter(|gain| gain.then < GAINS * gain.now).collect());
    if gains.is_empty() {
        notes.push("no uncertainty becomes smaller".to_owned());
    }
    notes.extend(gains);
    if !proposal.never.is_empty() {
        notes.push(format!("these measurements still do not show {}", proposal.never.join(", ")));
    }
    for (remedy, errors) in &proposal.remedies {
        notes.push(format!("{} {}", remedy_would_show(*remedy).to_lowercase(), errors.join(", ")));
    }
    PoseTable { title, joints, poses, notes }
}

/// What is added, and where.
pub(super) fn told_places(proposal: &PlaceProposal) -> String {
    let places: Vec<String> = proposal.places.iter().map(|place| told(proposal.adds, place)).collect();
    places.join(", and ")
}

/// `a station at x 1.20 m, y −3.41 m, z 1.60 m, heading 37°`
fn told(adds: Addition, place: &Place) -> String {
    let [x, y, z] = place.place_m.map(|value| format!("{value:.2} m").replace('-', "−"));
    let what = match adds {
        Addition::Station => "a station",
        Addition::Object(thing) => thing.told,
    };
    let mut text = format!("{what} at x {x}, y {y}, z {z}");
    if let (Addition::Object(thing), Some(radius_m)) = (adds, place.radius_m) {
        let [before, behind] = thing.radius;
        text += &format!("{before}{:.0}{behind}", radius_m * 1e3);
    }
    if let Some(heading) = place.heading_rad {
        text += &format!(", heading {:.0}°", heading.to_degrees()).replace('-', "−");
    }
    if let (Addition::Object(thing), Some([x, y, z])) = (adds, place.normal) {
        let which = thing.turned_by;
        text += &format!(" with its {which} along ({x:.2}, {y:.2}, {z:.2})").replace('-', "−");
    }
    text
}

/// What would show more than a set-up shows.
#[must_use]
pub fn remedy_would_show(remedy: Remedy) -> &'static str {
    match remedy {
        Remedy::OneLength => "One known length between two of the objects would show",
        Remedy::KnownStations => "Known stations would show",
        Remedy::KnownObjects => "Known objects would show",
        Remedy::KnownBoth => "Known stations and objects would show",
    }
}
