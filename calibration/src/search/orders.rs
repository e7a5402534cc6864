//! Fine waves of a joint, found blind: every order that the readings resolve is held against what the declaration leaves.
//!
//! Teeth of a worm wheel, poles of a motor and a harmonic drive repeat hundreds of times a turn. The catalogue cannot hold every order. So
//! those that gain more than their price are looked up here, and become effects of the catalogue; the contest decides, as of all others.

use std::f64::consts::TAU;
use std::ops::Range;

use evidence::Policy;
use faer::Mat;

use super::SearchError;
use super::columns::Columns;
use super::context::Context;
use super::fitted::Fitted;
use super::library::{orthonormal, take_out};
use effects::candidate::{Dependence, JointAxis};
use effects::families::{SmoothPlace, smooth};
use observe::waves::waves;

/// Values of residuals that are scanned at most, taken evenly. It bounds work.
const SCANNED: usize = 4000;

/// Readings by which orders are compared at most, taken evenly. It bounds work.
const COMPARED: usize = 400;

/// Orders scanned together. It bounds work.
const TOGETHER: usize = 64;

/// A wave keeps half its amplitude where readings are steps so many times shorter than its period a radian: sin(x)/x = 1/2 at x = 1.895.
const HALF_OF_STEPS: f64 = 2.0 * 1.895_494_267;

/// And where readings scatter by so much of it: exp(-x²/2) = 1/2.
const HALF_OF_NOISE: f64 = 1.177_410_023;

/// Parts of a column's square that declared errors leave at least.
const LEFT: f64 = 1e-3;

/// A wave to be held against others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Peak {
    /// Where it acts, and the joint.
    pub at: SmoothPlace,
    /// Periods a turn.
    pub order: u32,
    /// What it gains beyond its price, nats.
    net: f64,
}

/// The residual, and what declared errors and waves found before can explain.
struct Scanned {
    residual: Vec<f64>,
    /// Orthonormal.
    basis: Mat<f64>,
}

impl Scanned {
    /// Takes columns into what is explained.
    fn explain(&mut self, columns: impl IntoIterator<Item = Vec<f64>>) {
        let rows = self.residual.len();
        let known: Vec<Vec<f64>> =
            (0..self.basis.ncols()).map(|j| self.basis.col_as_slice(j).to_vec()).collect();
        self.basis = orthonormal(known.into_iter().chain(columns), rows);
        take_out(&self.basis, &mut self.residual);
    }

    /// Logarithm of how much better two columns make the residual, nats.
    fn gain(&self, [a, b]: &[Vec<f64>; 2]) -> f64 {
        let whole = [square(a), square(b)];
        let (mut aa, mut ab, mut bb) = (whole[0], product(a, b), whole[1]);
        for j in 0..self.basis.ncols() {
            let own = self.basis.col_as_slice(j);
            let (of_a, of_b) = (product(own, a), product(own, b));
            aa -= of_a * of_a;
            ab -= of_a * of_b;
            bb -= of_b * of_b;
        }
        let determinant = aa * bb - ab * ab;
        if aa < LEFT * whole[0] || bb < LEFT * whole[1] || determinant < LEFT * aa * bb {
            return 0.0;
        }
        let (ra, rb) = (product(a, &self.residual), product(b, &self.residual));
        let explained = (bb * ra * ra - 2.0 * ab * ra * rb + aa * rb * rb) / determinant;
        let freedom = self.residual.len() as f64 - self.basis.ncols() as f64;
        -0.5 * freedom * (-(explained / square(&self.residual)).min(1.0 - f64::EPSILON)).ln_1p()
    }
}

fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

fn square(column: &[f64]) -> f64 {
    product(column, column)
}

/// A joint's readings, and a place's column, at the values that are scanned.
struct Site {
    at: SmoothPlace,
    readings: Vec<f64>,
    column: Vec<f64>,
    orders: Range<u32>,
}

impl Site {
    fn columns(&self, order: u32) -> [Vec<f64>; 2] {
        let [sine, cosine] = waves(&self.readings, f64::from(order));
        [cosine, sine].map(|wave| wave.iter().zip(&self.column).map(|(w, c)| w * c).collect())
    }
}

/// Waves in what a fit leaves that gain more than their price, the strongest first, with those that come close to each at its place.
/// The fit's own effects stay out: the residual holds nothing of them, and waves that follow them gain no more than they should.
pub(crate) fn peaks(whole: &Context<'_>, fitted: &Fitted) -> Result<Vec<Peak>, SearchError> {
    let policy = Policy::default();
    let columns = fitted.probed.columns(whole.request.observations)?;
    let (mut scanned, sites) = prepared(whole, fitted, &columns, &policy);
    let price = (policy.harmonic_sum * sites.len().max(1) as f64).ln();
    let mut found: Vec<Peak> = Vec::new();
    for _ in 0..policy.waves_found as usize {
        let mut all: Vec<(usize, Peak)> = (0..sites.len())
            .flat_map(|number| {
                let site = &sites[number];
                let starts: Vec<u32> = site.orders.clone().step_by(TOGETHER).collect();
                let peaks = parallel::each_of(starts, |start| {
                    let orders = start..site.orders.end.min(start + TOGETHER as u32);
                    let peak = |order| {
                        let gain = scanned.gain(&site.columns(order));
                        Peak { at: site.at, order, net: gain - price - policy.of_order(order as usize) }
                    };
                    orders.map(peak).filter(|peak| peak.net > policy.wave_offered).collect::<Vec<_>>()
                });
                peaks.into_iter().flatten().map(move |peak| (number, peak))
            })
            .collect();
        all.sort_by(|(_, a), (_, b)| b.net.total_cmp(&a.net));
        let Some(&(number, best)) = all.first() else { break };
        let near =
            all.iter().filter(|(_, peak)| peak.at == best.at && peak.net > best.net - policy.set_width);
        found.extend(near.take(policy.waves_near as usize).map(|(_, peak)| *peak));
        scanned.explain(sites[number].columns(best.order));
    }
    Ok(found)
}

/// The whitened residual behind the declared errors, and every joint at the places of its body with the orders that it is scanned for.
fn prepared(
    whole: &Context<'_>,
    fitted: &Fitted,
    columns: &Columns,
    policy: &Policy,
) -> (Scanned, Vec<Site>) {
    let observations = whole.request.observations;
    let sigma = fitted.fit.noise.sigma_without_memory();
    let weight = |at: usize| {
        let row = columns.row[at] as usize;
        fitted.fit.residuals.weight[row].sqrt() / sigma[at]
    };
    let step = columns.residual.len().div_ceil(SCANNED).max(1);
    let chosen: Vec<(usize, f64)> = (0..columns.residual.len())
        .filter(|at| (columns.row[*at] as usize).is_multiple_of(step))
        .map(|at| (at, weight(at)))
        .filter(|(_, weight)| *weight > 0.0 && weight.is_finite())
        .collect();
    let whitened =
        |column: &[f64]| -> Vec<f64> { chosen.iter().map(|&(at, weight)| weight * column[at]).collect() };
    let mut scanned = Scanned { residual: whitened(&columns.residual), basis: Mat::new() };
    let declared: &Mat<f64> = &columns.declared;
    scanned.explain((0..declared.ncols()).map(|j| whitened(declared.col_as_slice(j))));

    let axes = whole.setting.turning();
    let mut sites = Vec::new();
    for at in smooth(&whole.setting) {
        // Teeth and rollers act on the body that their joint moves.
        let of_joint = |axis: &&JointAxis| axis.symbol == at.driver && axis.place().body == at.place.body;
        let Some(axis) = axes.iter().find(of_joint) else { continue };
        let (Some(column), Some(readings)) = (columns.probe(at.place), observations.poses.column(at.driver))
        else {
            continue;
        };
        let stated = observations.reading_sigma.iter().find(|(id, _)| *id == at.driver);
        let noise = stated.map_or(0.0, |(_, own)| own.iter().fold(0.0, |most: f64, one| most.max(*one)));
        let most = if at.place == axis.place() { policy.orders_own } else { policy.harmonics_own };
        let known = whole
            .catalogue
            .iter()
            .filter(|effect| effect.place == at.place && effect.driver == whole.setting.name(at.driver));
        let known = known.filter_map(|effect| match effect.form {
            Dependence::Harmonic { order } if order <= whole.setting.harmonics => Some(order),
            _ => None,
        });
        let Some(orders) = resolved(readings, noise, most as u32, known.max().unwrap_or(0)) else { continue };
        let readings = chosen.iter().map(|&(value, _)| readings[columns.row[value] as usize]).collect();
        sites.push(Site { at, readings, column: whitened(column), orders });
    }
    (scanned, sites)
}

/// The orders beyond those `known` of which readings keep half the amplitude, and go through a period at least.
fn resolved(readings: &[f64], noise_rad: f64, most: u32, known: u32) -> Option<Range<u32>> {
    let mut sorted: Vec<f64> = readings.iter().copied().filter(|reading| reading.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let span = sorted.last()? - sorted.first()?;
    // Readings that differ by rounding alone are one.
    let apart = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|apart| *apart > 1e-9);
    let step = apart.fold(f64::INFINITY, f64::min);
    let of_steps = HALF_OF_STEPS / step;
    let of_noise = if noise_rad > 0.0 { HALF_OF_NOISE / noise_rad } else { f64::INFINITY };
    let last = f64::from(most).min(of_steps).min(of_noise);
    let first = known.max((TAU / span).ceil().min(f64::from(most)) as u32) + 1;
    (last >= f64::from(first)).then(|| first..last as u32 + 1)
}

/// Orders up to `most` that look the same as one at these readings, itself left out.
pub(crate) fn aliases(readings: &[f64], order: u32, most: u32) -> Vec<u32> {
    let some: Vec<f64> = readings.iter().copied().step_by(readings.len().div_ceil(COMPARED).max(1)).collect();
    let turns_alike = |multiple: i64| {
        let [sine, cosine] = waves(&some, multiple as f64);
        let mean = |values: Vec<f64>| values.iter().sum::<f64>() / values.len().max(1) as f64;
        mean(sine).hypot(mean(cosine)) > 1.0 - LEFT
    };
    let (order, most) = (i64::from(order), i64::from(most));
    let alike = |other: &i64| *other != order && (turns_alike(other - order) || turns_alike(other + order));
    (1..=most).filter(alike).map(|other| other as u32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_end_where_readings_no_longer_show_half_of_a_wave() {
        let grid: Vec<f64> = (0..72).map(|i| f64::from(i) * TAU / 72.0).collect();
        assert_eq!(resolved(&grid, 0.0, 5000, 2), Some(3..44));
        let quarter: Vec<f64> = grid.iter().map(|reading| reading / 4.0).collect();
        assert_eq!(resolved(&quarter, 0.0, 5000, 2), Some(6..174));
        assert_eq!(resolved(&quarter, 0.1, 5000, 2), Some(6..12));
        assert_eq!(resolved(&quarter, 0.5, 5000, 2), None);
        assert_eq!(resolved(&[], 0.0, 5000, 2), None);
        assert_eq!(resolved(&[0.3; 9], 0.0, 5000, 2), None);
    }

    #[test]
    fn on_a_grid_orders_look_alike() {
        let grid: Vec<f64> = (0..72).map(|i| f64::from(i) * TAU / 72.0 - 1.0).collect();
        assert_eq!(aliases(&grid, 19, 100), vec![53, 91]);
        let scattered: Vec<f64> =
            (0..72).map(|i| (f64::from(i) * 12.9898).sin() * 43758.5453 % TAU).collect();
        assert!(aliases(&scattered, 19, 5000).is_empty());
    }
}
