//! Instruments with known errors at random poses, observed with known noise.

use model_core::{Chain, SymbolId, SymbolKind, exact, names};
use nalgebra::Vector3;
use observe::{Grouping, Measure, Measured, Observations, Origins, Poses, Series, direction_from_offset};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// A chain, the true value of each of its symbols, and poses.
pub struct Simulation {
    pub chain: Chain,
    /// By symbol, SI.
    pub values: Vec<f64>,
    pub columns: Vec<(SymbolId, Vec<f64>)>,
    rng: ChaCha8Rng,
}

impl Simulation {
    /// The mobile lidar with its 30 errors, all axes turned at random.
    pub fn lidar(rows: usize, seed: u64) -> Self {
        let text = include_str!("../../../examples/mobile-lidar/mobile-lidar.chain");
        let mut simulation = Self::new(text, seed);
        for joint in ["alpha", "beta", "gamma"] {
            simulation.column(joint, rows, -3.1..3.1);
        }
        simulation
    }

    /// A chain from its text, all errors zero, no poses yet.
    pub fn new(text: &str, seed: u64) -> Self {
        let chain = Chain::from_text(text).unwrap();
        let values = chain.nominal_values();
        Self { chain, values, columns: Vec::new(), rng: ChaCha8Rng::seed_from_u64(seed) }
    }

    /// Readings of a joint or input, even over a range.
    pub fn column(&mut self, name: &str, rows: usize, range: std::ops::Range<f64>) {
        let values = (0..rows).map(|_| self.rng.random_range(range.clone())).collect();
        self.columns.push((self.chain.find_symbol(name).unwrap(), values));
        self.columns.sort_by_key(|(id, _)| *id);
    }

    /// Normal errors for every name that matches.
    pub fn draw_errors(&mut self, pattern: &str, sigma: f64) {
        for id in self.chain.symbols_of(SymbolKind::Error).collect::<Vec<_>>() {
            if names::matches(pattern, &self.chain.symbol(id).name) {
                self.values[id.index()] = sigma * self.normal();
            }
        }
    }

    pub fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.rng)
    }

    pub fn rng(&mut self) -> &mut impl Rng {
        &mut self.rng
    }

    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// The observable at each pose, without noise.
    pub fn truth(&self, observable: &str) -> Vec<Vector3<f64>> {
        let path = exact::Path::new(&self.chain, self.chain.find_observable(observable).unwrap());
        let mut values = self.values.clone();
        (0..self.rows())
            .map(|row| {
                for (id, column) in &self.columns {
                    values[id.index()] = column[row];
                }
                path.value(&values)
            })
            .collect()
    }

    /// Directions with normal noise on the tangent plane.
    pub fn directions(&mut self, observable: &str, sigma_rad: f64) -> Observations {
        self.directions_with(observable, sigma_rad, 0.0)
    }

    /// The same, where each row's noise remembers the share `memory` of the row before.
    pub fn directions_with(&mut self, observable: &str, sigma_rad: f64, memory: f64) -> Observations {
        let truth = self.truth(observable);
        let mut noise = [sigma_rad * self.normal(), sigma_rad * self.normal()];
        let fresh = sigma_rad * (1.0 - memory * memory).sqrt();
        let mut measured = Vec::new();
        for direction in truth {
            measured.push(Measured::Direction(direction_from_offset(&direction, noise[0], noise[1])));
            noise = noise.map(|value| memory * value + fresh * self.normal());
        }
        self.observations(observable, Measure::Direction, measured)
    }

    /// Points with normal noise.
    pub fn points(&mut self, observable: &str, sigma_m: f64) -> Observations {
        let truth = self.truth(observable);
        let measured = truth
            .iter()
            .map(|p| Measured::Point(p + sigma_m * Vector3::new(self.normal(), self.normal(), self.normal())))
            .collect();
        self.observations(observable, Measure::Point, measured)
    }

    pub fn observations(&self, observable: &str, measure: Measure, measured: Vec<Measured>) -> Observations {
        let rows = measured.len();
        Observations {
            poses: Poses {
                series: vec![Series {
                    observable: self.chain.find_observable(observable).unwrap(),
                    measure,
                    rows: 0..rows,
                    source: "simulated".to_string(),
                }],
                columns: self.columns.clone(),
            },
            measured,
            sigma: Vec::new(),
            reading_sigma: Vec::new(),
            reading_correlation: Vec::new(),
            groups: (0..).take(rows).collect(),
            together: Vec::new(),
            targets: Vec::new(),
            grouping: Grouping::Declared,
            converted: Default::default(),
            crossed: Vec::new(),
            in_sequence: false,
            row_numbers: (1..).take(rows).collect(),
            origins: Origins::default(),
            unknowns: None,
        }
    }
}

/// A direction with two of its components swapped.
pub fn swapped(measured: Measured, one: usize, other: usize) -> Measured {
    let mut vector = *measured.vector().unwrap();
    vector.swap_rows(one, other);
    Measured::Direction(vector)
}
