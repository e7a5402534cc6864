//! Amounts evaluated over all rows at once, sines and cosines computed once a joint and harmonic.

use std::collections::BTreeMap;

use model_core::algebra::{Poly, Wave};
use model_core::{Chain, SymbolId, SymbolKind};

use observe::Poses;
use observe::waves::waves;

/// Evaluates functions of joints and inputs over the rows of some poses.
pub(crate) struct Functions<'a> {
    chain: &'a Chain,
    poses: &'a Poses,
    /// Of every symbol, for those without readings.
    values: &'a [f64],
    /// Sine and cosine of each joint's harmonics.
    waves: BTreeMap<(SymbolId, u32), [Vec<f64>; 2]>,
}

impl<'a> Functions<'a> {
    pub(crate) fn new(chain: &'a Chain, poses: &'a Poses, values: &'a [f64]) -> Self {
        Self { chain, poses, values, waves: BTreeMap::new() }
    }

    /// The function's value at each row; `None` if a symbol has neither readings nor a value.
    pub(crate) fn column(&mut self, amount: &Poly) -> Option<Vec<f64>> {
        let rows = self.poses.rows();
        let mut sum: Option<Vec<f64>> = None;
        for term in amount.terms() {
            let mut product = vec![term.coefficient.to_f64(); rows];
            for &(symbol, power) in &term.powers {
                let reading = self.reading(symbol)?;
                let power = i32::try_from(power).ok()?;
                product.iter_mut().zip(&reading).for_each(|(p, x)| *p *= x.powi(power));
            }
            for factor in &term.waves {
                let wave = self.wave(factor.symbol, factor.harmonic, factor.wave)?;
                product.iter_mut().zip(wave).for_each(|(p, w)| *p *= w);
            }
            for pole in &term.poles {
                for (wave, power) in [(Wave::Sin, pole.sin_power), (Wave::Cos, pole.cos_power)] {
                    let power = i32::try_from(power).ok()?;
                    let wave = self.wave(pole.symbol, 1, wave)?;
                    product.iter_mut().zip(wave).for_each(|(p, w)| *p /= w.powi(power));
                }
            }
            match &mut sum {
                None => sum = Some(product),
                Some(sum) => sum.iter_mut().zip(&product).for_each(|(s, p)| *s += p),
            }
        }
        Some(sum.unwrap_or_else(|| vec![0.0; rows]))
    }

    fn reading(&self, symbol: SymbolId) -> Option<Vec<f64>> {
        if let Some(ramp) = self.chain.ramp(symbol) {
            let of = self.poses.column(ramp.of)?;
            let mut values = self.values.to_vec();
            values.resize(values.len().max(self.chain.symbols.len()), 0.0);
            let value = |&reading: &f64| {
                values[ramp.of.index()] = reading;
                ramp.value(&values)
            };
            return Some(of.iter().map(value).collect());
        }
        if let Some(angle) = self.chain.sight_angle(symbol) {
            let read: Vec<(SymbolId, &[f64])> =
                angle.depends_on().filter_map(|id| Some((id, self.poses.column(id)?))).collect();
            let mut values = self.values.to_vec();
            values.resize(values.len().max(self.chain.symbols.len()), 0.0);
            let value = |row: usize| {
                for (id, readings) in &read {
                    values[id.index()] = readings[row];
                }
                angle.value(&values)
            };
            return Some((0..self.poses.rows()).map(value).collect());
        }
        match self.poses.column(symbol) {
            Some(readings) => Some(readings.to_vec()),
            // A joint beside the way stands where nobody knows, if it is not read.
            None if self.chain.symbol(symbol).kind == SymbolKind::Joint => None,
            None => self.values.get(symbol.index()).map(|&value| vec![value; self.poses.rows()]),
        }
    }

    fn wave(&mut self, symbol: SymbolId, harmonic: u32, wave: Wave) -> Option<&[f64]> {
        let key = (symbol, harmonic);
        if !self.waves.contains_key(&key) {
            let both = waves(&self.reading(symbol)?, f64::from(harmonic));
            self.waves.insert(key, both);
        }
        let [sine, cosine] = self.waves.get(&key)?;
        Some(match wave {
            Wave::Sin => sine,
            Wave::Cos => cosine,
        })
    }
}
