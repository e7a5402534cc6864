//! How surely rows would be measured that nobody has measured yet.

use model_core::SymbolId;

use fit::noise::{Layout, Noise, VarianceTerm};
use observe::Observations;

/// Of each series and component a usual row with its standard deviation, and the smallest one of all.
pub(super) struct Usual<'a> {
    noise: &'a Noise,
    observations: &'a Observations,
    of_series: Vec<Vec<(usize, [f64; 2])>>,
}

impl<'a> Usual<'a> {
    pub fn of(noise: &'a Noise, observations: &'a Observations, layout: &Layout) -> Self {
        let sigma = noise.sigma_without_memory();
        let of_series = observations.poses.series.iter().map(|series| {
            let of_component = |component: usize| {
                let own = |row: usize| (row, sigma[layout.first(row) + component]);
                let mut rows: Vec<(usize, f64)> = series.rows.clone().map(own).collect();
                rows.sort_by(|a, b| a.1.total_cmp(&b.1));
                let smallest = rows.first().map_or(0.0, |(_, sigma)| *sigma);
                rows.get(rows.len() / 2).map_or((0, [1.0, 0.0]), |&(row, sigma)| (row, [sigma, smallest]))
            };
            (0..series.measure.components()).map(of_component).collect()
        });
        Self { noise, observations, of_series: of_series.collect() }
    }

    /// The standard deviation of each component of a row of a series at some readings, rad or m.
    pub fn sigma(&self, series: usize, reading: impl Fn(SymbolId) -> f64) -> Vec<f64> {
        let measure = self.observations.poses.series[series].measure;
        let own = |(component, &(row, [sigma, smallest])): (usize, &(usize, [f64; 2]))| {
            let there =
                |id: SymbolId| self.observations.poses.column(id).map_or(f64::NAN, |column| column[row]);
            let of = measure.kind().noise[component];
            let own = self.noise.variance.iter().filter(|variance| variance.of == of);
            let terms = own.flat_map(|variance| &variance.terms);
            let ln: f64 =
                terms.map(|(term, by)| by * (function(*term, &reading) - function(*term, &there))).sum();
            // Nothing that was measured says that any row could be surer.
            (sigma * (ln / 2.0).exp()).max(smallest).max(f64::MIN_POSITIVE)
        };
        self.of_series[series].iter().enumerate().map(own).collect()
    }
}

fn function(term: VarianceTerm, reading: &impl Fn(SymbolId) -> f64) -> f64 {
    match term {
        VarianceTerm::Cos(id, times) => (f64::from(times) * reading(id)).cos(),
        VarianceTerm::Sin(id, times) => (f64::from(times) * reading(id)).sin(),
        VarianceTerm::LogRange(id) => reading(id).ln(),
    }
}
