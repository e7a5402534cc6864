//! Where to put the next station, wall, target, socket, circle or wire, and what to aim at: additions to a set-up with places that
//! nobody knows, by which the worst-determined errors gain most.
//!
//! An addition brings numbers of its own, which are estimated with all others: a target that is seen once tells nothing. Of
//! places spread over where things are each is judged by the pointings that tell most there.

mod aim;
mod candidates;
mod known;
mod noise;
mod proposal;
mod seen;
mod weigh;

use std::collections::BTreeSet;

use model_core::{Chain, SymbolId};
use nalgebra::{DMatrix, Vector3};

use crate::design::Criterion;
use aim::ranges_of;
use candidates::{Candidate, Candidates, New, as_the_others};
use fit::noise::Layout;
use fit::{FitError, FitResult, Model, variance_of};
use known::{Known, OF_STATION, of_object, roots};
use noise::Usual;
use observe::unknowns::{Freedom, OF_OBJECT, Object, Shape, Station, Unknowns, WIDTH};
use observe::{Observations, Poses, Series};
pub use proposal::{Addition, Place, PlaceProposal, Pointing};
use seen::Seen;
use study::{NextPlaces, NextPoses, Plan};
use weigh::{Pointed, badness, chosen, measured};

/// The size of what the study states none of: coefficients of effects.
const ANY_SIZE: f64 = 1.0;

/// An error that is no surer than this share of its tolerance is not shown.
const NOT_SHOWN: f64 = 0.7;

/// What everything that is proposed is judged by.
struct Setting<'a> {
    model: Model,
    observations: &'a Observations,
    fit: &'a FitResult,
    chain: &'a Chain,
    usual: Usual<'a>,
    /// What an error does to the observations so far.
    scale: Vec<f64>,
}

/// Proposes additions as the study asks for them; none where nothing was asked for.
///
/// # Errors
/// As a fit of them would have.
pub(crate) fn propose_places(
    chain: &Chain,
    observations: &Observations,
    fit: &FitResult,
    plan: &Plan,
) -> Result<Vec<PlaceProposal>, FitError> {
    let Some((next, wanted)) = plan.next.as_ref().and_then(|next| Some((next, next.places.as_ref()?))) else {
        return Ok(Vec::new());
    };
    let Some(unknowns) = &observations.unknowns else { return Ok(Vec::new()) };
    let own = unknowns.stations.iter().filter(|station| !station.label.is_empty());
    let of_stations = as_the_others(own.map(|station| station.freedom));
    let unknowns = in_a_frame(unknowns.at(&fit.values[chain.symbols.len()..]));
    let mut values = fit.values[..chain.symbols.len()].to_vec();
    values.resize(values.len() + unknowns.numbers(), 0.0);
    let observations = &Observations { unknowns: Some(unknowns.clone()), ..observations.clone() };
    let model = Model::new(chain, &observations.poses, &fit.parameters)?.for_determination();
    let size = |id: &_| plan.fit.sizes.iter().find(|(own, _)| own == id).map_or(ANY_SIZE, |(_, size)| *size);
    let sizes: Vec<f64> = fit.parameters.iter().map(size).collect();
    let candidates = Candidates::of(chain, observations, unknowns, of_stations, &values, next, wanted);
    let known =
        Known::of(&model, observations, &candidates.unknowns, fit, &values, &sizes, candidates.extent_m())?;
    let layout = Layout::of(observations);
    let scale = (0..sizes.len()).map(|at| fit.factor.length(at).max(1.0 / sizes[at]));
    let usual = Usual::of(&fit.noise, observations, &layout);
    let setting = Setting { model, observations, fit, chain, usual, scale: scale.collect() };
    let mut proposals = Vec::new();
    for (adds, count) in asked(wanted) {
        let places = candidates.all(adds, &known);
        let seen = parallel::each_of(&places, |place| setting.pointed(place, &known));
        let seen = seen.into_iter().collect::<Result<Vec<_>, FitError>>()?;
        let places: Vec<(Candidate, Vec<Pointed>)> = places.into_iter().zip(seen).collect();
        for criterion in [Criterion::D, Criterion::A] {
            proposals.extend(setting.proposal(&places, &known, adds, count, criterion, next));
        }
    }
    for proposal in &mut proposals {
        let after = |at: usize| proposal.uncertainties[at].2 > NOT_SHOWN * sizes[at];
        proposal.never = (0..sizes.len())
            .filter(|&at| after(at) && !fit.separable[at])
            .map(|at| proposal.uncertainties[at].0.clone())
            .collect();
    }
    Ok(proposals)
}

/// The same with one station held where nothing holds the frame, which changes no error.
fn in_a_frame(mut unknowns: Unknowns) -> Unknowns {
    let used: BTreeSet<u32> = unknowns.station.iter().copied().collect();
    let is_free = |freedom: Freedom| freedom == Freedom::Free;
    let mut of_stations = used.iter().map(|&number| unknowns.stations[number as usize].freedom);
    if of_stations.all(is_free) && unknowns.objects.iter().all(|object| is_free(object.freedom)) {
        for &first in used.iter().take(1) {
            unknowns.stations[first as usize].freedom = Freedom::Given;
        }
    }
    unknowns
}

/// What is asked for, and how many.
fn asked(wanted: &NextPlaces) -> Vec<(Addition, usize)> {
    let objects = wanted.objects.iter();
    let objects = objects.filter_map(|own| Some((Addition::of(own.measure, own.reads_length)?, own.count)));
    let all = std::iter::once((Addition::Station, wanted.stations)).chain(objects);
    all.filter(|(_, count)| *count > 0).collect()
}

/// What becomes of a candidate.
struct Trial {
    badness: f64,
    pointings: Vec<usize>,
}

impl Setting<'_> {
    fn proposal(
        &self,
        candidates: &[(Candidate, Vec<Pointed>)],
        known: &Known,
        adds: Addition,
        count: usize,
        criterion: Criterion,
        next: &NextPoses,
    ) -> Option<PlaceProposal> {
        let before = known.of_errors();
        let mut covariance = known.covariance.clone();
        let read: Vec<_> = self.read(next);
        let mut places = Vec::new();
        let mut used: Vec<usize> = Vec::new();
        for _ in 0..count {
            let trials = parallel::each_of(candidates, |(candidate, seen)| {
                self.trial(candidate, seen, known, &covariance, criterion)
            });
            let best = trials
                .into_iter()
                .enumerate()
                .filter(|(at, _)| !used.contains(at))
                .filter_map(|(at, trial)| Some((at, trial?)))
                .min_by(|a, b| a.1.badness.total_cmp(&b.1.badness).then(a.0.cmp(&b.0)));
            let Some((best, trial)) = best else { break };
            used.push(best);
            let (candidate, seen) = &candidates[best];
            let whole = extended(&covariance, candidate, known.extent_m);
            let Some(whole) = measured(&whole, trial.pointings.iter().map(|&at| &seen[at])) else {
                break;
            };
            let n = covariance.nrows();
            covariance = whole.view((0, 0), (n, n)).into_owned();
            places.push(candidate.place(&known.unknowns, &trial.pointings, &read));
        }
        if places.is_empty() {
            return None;
        }
        let names = self.fit.parameters.iter().enumerate().map(|(at, id)| {
            let now = self.fit.covariance[(at, at)].sqrt();
            let now = if now.is_finite() { now } else { before[(at, at)].sqrt() };
            let gain = (covariance[(at, at)] / before[(at, at)]).max(0.0).sqrt();
            (self.chain.symbol(*id).name.clone(), now, now * gain)
        });
        let uncertainties = names.collect();
        let several = self.fit.estimable.iter().filter(|one| one.combination.len() > 1);
        let combinations = several.filter_map(|one| {
            let now = one.standard_uncertainty?;
            let parts = one.combination.iter().map(|&(id, factor)| (self.place(id), factor));
            let parts: Vec<(usize, f64)> = parts.collect();
            let of = |covariance: &DMatrix<f64>| variance_of(&parts, |i, j| covariance[(i, j)]);
            Some((now, now * (of(&covariance) / of(&before)).max(0.0).sqrt()))
        });
        let combinations = combinations.collect();
        let readings = read
            .iter()
            .map(|&at| self.observations.poses.columns[at].0)
            .map(|id| self.chain.symbol(id).name.clone());
        let (never, remedies) = (Vec::new(), Vec::new());
        let readings = readings.collect();
        Some(PlaceProposal {
            adds,
            criterion,
            readings,
            places,
            uncertainties,
            combinations,
            never,
            remedies,
        })
    }

    /// Where an error stands among those of the fit.
    fn place(&self, id: SymbolId) -> usize {
        match self.fit.parameters.iter().position(|known| *known == id) {
            Some(at) => at,
            None => unreachable!("what is determined is of errors that were estimated"),
        }
    }

    /// Which columns of the readings are told: those that an instrument is set by.
    fn read(&self, next: &NextPoses) -> Vec<usize> {
        let poses = &self.observations.poses;
        let mut own = crate::design::joints(self.chain, poses);
        own.extend(ranges_of(self.chain, poses, &next.ranges));
        (0..poses.columns.len()).filter(|&at| own.contains(&poses.columns[at].0)).collect()
    }

    /// The rows of each pointing, whitened, over the numbers of all that is known and those of the candidate behind.
    fn pointed(&self, candidate: &Candidate, known: &Known) -> Result<Vec<Pointed>, FitError> {
        let poses = &self.observations.poses;
        let mut order: Vec<usize> = (0..candidate.pointings.len()).collect();
        order.sort_by_key(|&at| candidate.pointings[at].series);
        let mut start = 0;
        let series = poses.series.iter().enumerate().map(|(number, series)| {
            let own = order.iter().filter(|&&at| candidate.pointings[at].series == number).count();
            start += own;
            Series { rows: start - own..start, ..series.clone() }
        });
        let series: Vec<Series> = series.collect();
        let column = |at: usize| order.iter().map(|&own| candidate.pointings[own].readings[at]).collect();
        let columns = poses.columns.iter().enumerate().map(|(at, (id, _))| (*id, column(at))).collect();
        let mut unknowns: Unknowns = known.unknowns.clone();
        unknowns.stations.extend(candidate.new.station().cloned());
        unknowns.objects.extend(candidate.new.object().cloned());
        unknowns.object = order.iter().map(|&at| Some(candidate.pointings[at].object as u32)).collect();
        unknowns.station = order.iter().map(|&at| candidate.pointings[at].station as u32).collect();
        // How long it would be read plays no part in what it tells.
        let measure = |at: usize| poses.series[candidate.pointings[at].series].measure;
        let measured = order.iter().map(|&at| measure(at).kind().anything_of_object());
        let mut values = self.fit.values[..self.chain.symbols.len()].to_vec();
        values.resize(values.len() + unknowns.numbers(), 0.0);
        let there = Observations {
            measured: measured.collect(),
            poses: Poses { series, columns },
            unknowns: Some(unknowns),
            ..Observations::default()
        };
        let root: Vec<f64> = order
            .iter()
            .flat_map(|&at| {
                let pointing = &candidate.pointings[at];
                let reading = |id| {
                    let column = poses.columns.iter().position(|(own, _)| *own == id);
                    column.map_or(f64::NAN, |column| pointing.readings[column])
                };
                self.usual.sigma(pointing.series, reading).into_iter().map(f64::recip)
            })
            .collect();
        let seen = Seen::of(&self.model, &there, &Layout::of(&there), &values, &root)?;
        let behind = (candidate.new.numbers() > 0).then_some(known.covariance.nrows());
        let mut pointed: Vec<Pointed> = Vec::new();
        for (row, &at) in order.iter().enumerate() {
            let pointing = &candidate.pointings[at];
            let of_row: Vec<&Seen> = seen.iter().filter(|seen| seen.row == row).collect();
            let station = known.stations.get(pointing.station).copied().unwrap_or(behind);
            let object = known.objects.get(pointing.object).copied().unwrap_or(behind);
            let thing = known.unknowns.objects.get(pointing.object).or(candidate.new.object());
            let k = thing.map_or(0, Object::numbers);
            // In the order of the derivatives.
            let mut places: Vec<(usize, usize)> = Vec::new();
            places.extend(object.iter().flat_map(|start| (0..k).map(move |number| (start + number, number))));
            places.extend(
                station
                    .iter()
                    .flat_map(|start| (0..WIDTH - OF_OBJECT).map(move |j| (start + j, OF_OBJECT + j))),
            );
            let at = (0..known.errors).chain(places.iter().map(|(at, _)| *at)).collect();
            let columns = DMatrix::from_fn(of_row.len(), known.errors + places.len(), |i, j| {
                let seen = of_row[i];
                if j < known.errors { seen.errors[j] } else { seen.unknown[places[j - known.errors].1] }
            });
            pointed.push(Pointed { at, columns });
        }
        // Back in the order of the candidate's pointings.
        let mut by_pointing: Vec<(usize, Pointed)> = order.into_iter().zip(pointed).collect();
        by_pointing.sort_by_key(|(at, _)| *at);
        Ok(by_pointing.into_iter().map(|(_, pointed)| pointed).collect())
    }

    /// How good a candidate is with those of its pointings that tell most.
    fn trial(
        &self,
        candidate: &Candidate,
        seen: &[Pointed],
        known: &Known,
        covariance: &DMatrix<f64>,
        criterion: Criterion,
    ) -> Option<Trial> {
        // Only the numbers that it has to do with: the others follow.
        let mut numbers: Vec<usize> = (0..known.errors).collect();
        let mut more: Vec<usize> =
            seen.iter().flat_map(|own| own.at[known.errors..].iter().copied()).collect();
        more.sort_unstable();
        more.dedup();
        numbers.extend(more);
        let whole = extended(covariance, candidate, known.extent_m);
        let own = DMatrix::from_fn(numbers.len(), numbers.len(), |i, j| whole[(numbers[i], numbers[j])]);
        let behind = &numbers[known.errors..];
        let local = |at: &usize| match *at < known.errors {
            true => *at,
            false => known.errors + behind.partition_point(|number| number < at),
        };
        let pointed: Vec<Pointed> = seen
            .iter()
            .map(|own| Pointed { at: own.at.iter().map(local).collect(), columns: own.columns.clone() })
            .collect();
        let (pointings, errors) = chosen(&own, &pointed, candidate.wanted, &self.scale, criterion)?;
        let badness = badness(&errors, &self.scale, criterion);
        badness.is_finite().then_some(Trial { badness, pointings })
    }
}

/// The covariance with the numbers of a candidate behind, of which nothing is known but what the study would say.
fn extended(covariance: &DMatrix<f64>, candidate: &Candidate, extent_m: f64) -> DMatrix<f64> {
    let n = covariance.nrows();
    let (freedom, turns) = match &candidate.new {
        New::Station(station) => (station.freedom, OF_STATION),
        // A wire has a fourth number, a length as the others.
        New::Object(object) => (object.freedom, of_object(object.shape)),
    };
    let k = candidate.new.numbers();
    let mut whole = DMatrix::zeros(n + k, n + k);
    whole.view_mut((0, 0), (n, n)).copy_from(covariance);
    roots(freedom, turns, extent_m)
        .into_iter()
        .take(k)
        .enumerate()
        .for_each(|(at, root)| whole[(n + at, n + at)] = root.powi(-2));
    whole
}

/// A vector as a list.
fn list(vector: &Vector3<f64>) -> [f64; 3] {
    [vector.x, vector.y, vector.z]
}

impl Candidate {
    /// What is told of it.
    fn place(&self, unknowns: &Unknowns, pointings: &[usize], read: &[usize]) -> Place {
        let (place, heading_rad, normal) = match &self.new {
            New::Station(Station { pose, .. }) => (pose.shift, Some(pose.turn.euler_angles().2), None),
            New::Object(object) => {
                let is_point = matches!(object.shape, Shape::Point | Shape::Wire);
                (object.place, None, (!is_point).then(|| list(&object.normal)))
            }
        };
        let label = |own: Option<&String>| own.cloned().unwrap_or_default();
        Place {
            place_m: list(&place),
            heading_rad,
            normal,
            radius_m: self.radius_m,
            pointings: pointings
                .iter()
                .map(|&at| {
                    let own = &self.pointings[at];
                    Pointing {
                        station: label(unknowns.stations.get(own.station).map(|station| &station.label)),
                        object: label(unknowns.objects.get(own.object).map(|object| &object.label)),
                        readings: read.iter().map(|&column| own.readings[column]).collect(),
                    }
                })
                .collect(),
        }
    }
}
