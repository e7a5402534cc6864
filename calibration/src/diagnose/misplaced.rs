//! Objects and stations that come out far from where the study states them, in terms of what it states: a coordinate that was read
//! wrongly, or another label's.

use statrs::distribution::{ContinuousCDF, Normal};

use super::uneven::Uneven;
use crate::data::Observations;
use crate::data::unknowns::{Freedom, own_numbers};
use crate::fit::FitResult;

/// What chance explains less often than this, over all that is stated, is told.
const UNLIKELY: f64 = 0.001;

/// What is pulled along with the one that is off most lies by less than this share of it off.
const ALONG: f64 = 0.5;

/// So many are named at most.
const MOST: usize = 3;

/// Something that is not where it is stated.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Misplaced {
    pub what: Uneven,
    pub label: String,
    /// By how many of its standard uncertainties, in the number that is off most.
    pub sigmas: f64,
    /// How far, m.
    pub away_m: f64,
}

/// Those that chance does not explain, the furthest off first.
pub(super) fn misplaced(observations: &Observations, fit: &FitResult) -> Vec<Misplaced> {
    let Some(unknowns) = &observations.unknowns else { return Vec::new() };
    let state = &fit.values[fit.values.len() - unknowns.numbers()..];
    let mut found = Vec::new();
    let mut numbers = 0;
    // The shift comes first, whatever turns are behind it.
    let mut judge = |what, label: &str, own: &[f64], stated: &[f64]| {
        numbers += stated.len();
        let shift = &own[..own.len().min(3)];
        let in_sigmas = own.iter().zip(stated).map(|(value, sigma)| value.abs() / sigma);
        found.push(Misplaced {
            what,
            label: label.to_owned(),
            sigmas: in_sigmas.fold(0.0, f64::max),
            away_m: shift.iter().map(|value| value * value).sum::<f64>().sqrt(),
        });
    };
    for (station, start) in unknowns.stations.iter().zip(unknowns.first_of_stations()) {
        let numbers = station.numbers();
        let stated: Vec<f64> = (0..numbers).filter_map(|at| station.freedom.of_station(at)).collect();
        if !stated.is_empty() {
            let own: [f64; 6] = own_numbers(state, start, numbers);
            judge(Uneven::Station, &station.label, &own, &stated);
        }
    }
    for (object, start) in unknowns.objects.iter().zip(unknowns.first_of_objects()) {
        if let Freedom::Within { shift_m, .. } = object.freedom {
            let own: [f64; 3] = own_numbers(state, start, object.numbers().min(3));
            judge(Uneven::of(object.shape), &object.label, &own, &[shift_m; 3]);
        }
    }
    let chance = |sigmas: f64| 2.0 * Normal::standard().sf(sigmas) * numbers as f64;
    let furthest = found.iter().map(|one| one.sigmas).fold(0.0, f64::max);
    found.retain(|one| chance(one.sigmas) < UNLIKELY && one.sigmas >= ALONG * furthest);
    found.sort_by(|a, b| b.sigmas.total_cmp(&a.sigmas));
    found.truncate(MOST);
    found
}
