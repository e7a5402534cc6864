//! The scanner of thirty errors, of which directions determine eight combinations: what is left open moves the rest by products.

use fit::{FitOptions, fit};
use model_core::{Chain, Quantity, SymbolKind, exact};
use nalgebra::Vector3;
use observe::{Measure, Measured, Observations, Poses, Series, direction_from_offset};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use rayon::prelude::*;

use crate::Failure;
use crate::rate::Rate;
use testkit::mount::SIGMA;

const LIDAR: &str = include_str!("../../../../examples/mobile-lidar/mobile-lidar.chain");

/// Noise of points, m.
const POINTS: f64 = 1e-4;

/// How often intervals of the determined combinations hold the truth, with angles of so many rad and shifts of so many m.
pub fn coverage(observable: &str, errors: f64, runs: usize) -> Result<Rate, Failure> {
    let chain = Chain::from_text(LIDAR).map_err(|mistakes| mistakes.render("scanner", LIDAR))?;
    let hits = (0..runs as u64).into_par_iter().map(|seed| one(&chain, observable, errors, seed));
    Ok(Rate::of(hits.collect::<Result<Vec<_>, _>>()?.concat()))
}

fn one(chain: &Chain, observable: &str, errors: f64, seed: u64) -> Result<Vec<bool>, Failure> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut values = chain.nominal_values();
    for id in chain.symbols_of(SymbolKind::Error) {
        let size = if chain.symbol(id).quantity == Quantity::Angle { errors } else { errors.min(1e-3) };
        values[id.index()] = size * random.sample::<f64, _>(StandardNormal);
    }
    let id = chain.find_observable(observable).ok_or("no such observable")?;
    let path = exact::Path::new(chain, id);
    let mut columns: Vec<_> = chain.symbols_of(SymbolKind::Joint).map(|id| (id, Vec::new())).collect();
    let inputs = chain.symbols_of(SymbolKind::Input).map(|id| (id, Vec::new()));
    let joints = columns.len();
    columns.extend(inputs);
    let mut measured = Vec::new();
    let measure = if observable == "pointing" { Measure::Direction } else { Measure::Point };
    for _ in 0..300 {
        for (at, (id, column)) in columns.iter_mut().enumerate() {
            let range = if at < joints { -3.1..3.1 } else { 2.0..30.0 };
            values[id.index()] = random.random_range(range);
            column.push(values[id.index()]);
        }
        let mut noise = || -> f64 { random.sample(StandardNormal) };
        let truth = path.value(&values);
        measured.push(match measure {
            Measure::Direction => {
                Measured::Direction(direction_from_offset(&truth, SIGMA * noise(), SIGMA * noise()))
            }
            _ => Measured::Point(truth + POINTS * Vector3::new(noise(), noise(), noise())),
        });
    }
    columns.sort_by_key(|(id, _)| *id);
    let rows = measured.len();
    let observations = Observations {
        poses: Poses {
            series: vec![Series { observable: id, measure, rows: 0..rows, source: "simulated".to_owned() }],
            columns,
        },
        measured,
        groups: (0..rows as u32).collect(),
        row_numbers: (1..=rows as u64).collect(),
        ..Observations::default()
    };
    let result = fit(chain, &observations, &FitOptions::for_chain(chain))?;
    let hit = |one: &fit::Estimable| {
        let truth: f64 = one.combination.iter().map(|(id, ratio)| ratio * values[id.index()]).sum();
        one.half_width(0.95).is_some_and(|reach| (one.value - truth).abs() <= reach)
    };
    Ok(result.estimable.iter().map(hit).collect())
}
