//! Objects and stations that come out far from where the study states them: a coordinate that was read wrongly, or another label's.
//!
//! In terms of what it states where that has an uncertainty; by their rows where these were set aside for it, together.

use model_core::Chain;
use nalgebra::{Rotation3, Vector3};
use statrs::distribution::{ContinuousCDF, Normal};

use super::caution::Caution;
use super::uneven::Uneven;
use fit::{FitResult, align_robustly, robust};
use network::{Row, is_in_a_line, rows, tells};
use observe::Observations;
use observe::unknowns::{Freedom, Unknowns, own_numbers};

/// What chance explains less often than this, over all that is stated, is told.
const UNLIKELY: f64 = 0.001;

/// What is pulled along with the one that is off most lies by less than this share of it off.
const ALONG: f64 = 0.5;

/// So many are named at most.
const MOST: usize = 3;

/// Rows say together that something stands elsewhere when this share of them was set aside, of so many at least, and when they lie from
/// each other by less than that share of how far off they are.
const ASIDE: f64 = 0.8;
const FEWEST: usize = 2;
const ALIKE: f64 = 0.2;

/// Something that is not where it is stated.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Misplaced {
    pub what: Uneven,
    pub label: String,
    /// By how many of its standard uncertainties, in the number that is off most; none where its rows were set aside.
    pub sigmas: Option<f64>,
    /// How far along x, y and z, m.
    pub shift_m: [f64; 3],
    /// How far a station is turned, rad.
    pub turn_rad: f64,
}

impl Misplaced {
    /// How far, m.
    fn away_m(&self) -> f64 {
        Vector3::from(self.shift_m).norm()
    }

    /// Whether this is a station of which the uncertainty is stated.
    pub fn is_stated_station(&self) -> bool {
        self.what == Uneven::Station && self.sigmas.is_some()
    }

    /// Whether this is that object or station.
    pub fn is(&self, what: Uneven, label: &str) -> bool {
        self.what == what && self.label == label
    }
}

impl From<Misplaced> for Caution {
    fn from(own: Misplaced) -> Self {
        let away_m = own.away_m();
        let Misplaced { what, label, sigmas, shift_m, turn_rad } = own;
        Self::NotWhereStated { what, label, sigmas, away_m, shift_m, turn_rad }
    }
}

/// Whether a row was set aside since what it observes, or where from, is not where it is stated.
pub(super) fn explains(misplaced: &[Misplaced], observations: &Observations, row: usize) -> bool {
    let [station, object] = observations.unknowns.as_ref().map_or([None; 2], |unknowns| unknowns.labels(row));
    misplaced.iter().filter(|own| own.sigmas.is_none()).any(|own| {
        let label = if own.what == Uneven::Station { station } else { object };
        label == Some(own.label.as_str())
    })
}

/// Those whose rows say so, the furthest off first; behind them those that chance does not explain.
pub(super) fn misplaced(chain: &Chain, observations: &Observations, fit: &FitResult) -> Vec<Misplaced> {
    let Some(unknowns) = &observations.unknowns else { return Vec::new() };
    let mut found = by_rows(chain, observations, unknowns, fit);
    let is_new = |one: &Misplaced| !found.iter().any(|own| own.is(one.what, &one.label));
    let stated: Vec<Misplaced> = by_what_is_stated(unknowns, fit).into_iter().filter(is_new).collect();
    found.extend(stated);
    found.truncate(MOST);
    found
}

/// Those that chance does not explain by their stated uncertainties, the furthest off first.
pub(super) fn by_what_is_stated(unknowns: &Unknowns, fit: &FitResult) -> Vec<Misplaced> {
    let state = unknowns.state(&fit.values);
    let mut found: Vec<(f64, Misplaced)> = Vec::new();
    let mut numbers = 0;
    // The shift comes first, whatever turns are behind it.
    let mut judge = |what, label: &str, own: &[f64], stated: &[f64]| {
        numbers += stated.iter().filter(|sigma| sigma.is_finite()).count();
        let in_sigmas = own.iter().zip(stated).map(|(value, sigma)| value.abs() / sigma);
        let sigmas = in_sigmas.fold(0.0, f64::max);
        let turn = own.iter().skip(3).map(|value| value * value).sum::<f64>().sqrt();
        let (label, shift_m) = (label.to_owned(), own_numbers(own, 0, 3));
        found.push((sigmas, Misplaced { what, label, sigmas: Some(sigmas), shift_m, turn_rad: turn }));
    };
    for (station, start) in unknowns.stations.iter().zip(unknowns.first_of_stations()) {
        let numbers = station.numbers();
        let stated: Vec<f64> = (0..numbers).filter_map(|at| station.stated(at)).collect();
        let mut own: [f64; 6] = own_numbers(state, start, numbers);
        if station.freedom.is_within() {
            judge(Uneven::Station, &station.label, &own, &stated);
        } else if !stated.is_empty() {
            // Of one that was levelled the tilts alone are stated.
            own[..3].fill(0.0);
            own[5] = 0.0;
            judge(
                Uneven::Station,
                &station.label,
                &own,
                &[f64::INFINITY, f64::INFINITY, f64::INFINITY, stated[0], stated[1]],
            );
        }
    }
    for (object, start) in unknowns.objects.iter().zip(unknowns.first_of_objects()) {
        if let Freedom::Within { shift_m, .. } = object.freedom {
            let own: [f64; 3] = own_numbers(state, start, object.numbers().min(3));
            judge(Uneven::of(object.shape), &object.label, &own, &[shift_m; 3]);
        }
    }
    let chance = |sigmas: f64| 2.0 * Normal::standard().sf(sigmas) * numbers as f64;
    let furthest = found.iter().map(|(sigmas, _)| *sigmas).fold(0.0, f64::max);
    found.retain(|(sigmas, _)| chance(*sigmas) < UNLIKELY && *sigmas >= ALONG * furthest);
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.into_iter().map(|(_, one)| one).collect()
}

/// Those whose rows were set aside, and agree on another place.
fn by_rows(
    chain: &Chain,
    observations: &Observations,
    unknowns: &Unknowns,
    fit: &FitResult,
) -> Vec<Misplaced> {
    let state = unknowns.state(&fit.values);
    let there = unknowns.at(state);
    let all = rows(chain, observations, unknowns, &fit.values);
    let is_aside = |row: &Row| fit.residuals.weight[row.number] == 0.0;
    let set_aside = |is_own: &dyn Fn(&Row) -> bool| -> Option<Vec<&Row>> {
        let own: Vec<&Row> = all.iter().filter(|row| is_own(row)).collect();
        let aside = own.iter().filter(|row| is_aside(row)).count();
        let is_told = aside >= FEWEST && aside as f64 >= ASIDE * own.len() as f64;
        (is_told && own.iter().all(|row| tells(row))).then_some(own)
    };
    let mut found = Vec::new();
    for (at, object) in unknowns.objects.iter().enumerate().filter(|(_, own)| own.freedom != Freedom::Free) {
        let Some(own) = set_aside(&|row| row.object == at) else { continue };
        let points = own.iter().map(|row| there.stations[row.station].pose.apply(&row.point));
        let points: Vec<Vector3<f64>> = points.collect();
        let middle = |axis: usize| robust::median(points.iter().map(|point| point[axis]).collect());
        let place = Vector3::new(middle(0), middle(1), middle(2));
        let shift = place - object.place;
        let apart = robust::median(points.iter().map(|point| (point - place).norm()).collect());
        if apart <= ALIKE * shift.norm() {
            let (what, label) = (Uneven::of(object.shape), object.label.clone());
            let shift_m = [shift.x, shift.y, shift.z];
            found.push(Misplaced { what, label, sigmas: None, shift_m, turn_rad: 0.0 });
        }
    }
    for (at, station) in unknowns.stations.iter().enumerate().filter(|(_, own)| own.freedom != Freedom::Free)
    {
        let Some(own) = set_aside(&|row| row.station == at) else { continue };
        let pairs = own.iter().map(|row| (row.point, there.objects[row.object].place));
        let (from, to): (Vec<_>, Vec<_>) = pairs.unzip();
        let laid = if is_in_a_line(&from) { None } else { align_robustly(&from, &to) };
        let Some((turn, shift)) = laid else { continue };
        let away = |turn: &Rotation3<f64>, shift: &Vector3<f64>| {
            robust::median(from.iter().zip(&to).map(|(from, to)| (turn * from + shift - to).norm()).collect())
        };
        let turn = Rotation3::from_matrix_unchecked(turn);
        let stated = &station.pose;
        if away(&turn, &shift) <= ALIKE * away(&stated.turn, &stated.shift) {
            let moved = shift - stated.shift;
            found.push(Misplaced {
                what: Uneven::Station,
                label: station.label.clone(),
                sigmas: None,
                shift_m: [moved.x, moved.y, moved.z],
                turn_rad: turn.angle_to(&stated.turn),
            });
        }
    }
    found.sort_by(|a, b| b.away_m().total_cmp(&a.away_m()));
    found
}
