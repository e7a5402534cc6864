//! Amounts evaluated over all rows at once, sines and cosines computed once a joint and harmonic.

use std::collections::BTreeMap;

use codegen::vector::{self, Arithmetic, ROWS};
use model_core::algebra::{Poly, Wave};
use model_core::{Chain, SymbolId};

use crate::data::Poses;

/// Evaluates functions of joints and inputs over the rows of some poses.
pub(crate) struct Functions<'a> {
    chain: &'a Chain,
    poses: &'a Poses,
    /// Of every symbol, for those without readings.
    values: &'a [f64],
    waves: BTreeMap<(SymbolId, u32, Wave), Vec<f64>>,
}

impl<'a> Functions<'a> {
    pub(crate) fn new(chain: &'a Chain, poses: &'a Poses, values: &'a [f64]) -> Self {
        Self { chain, poses, values, waves: BTreeMap::new() }
    }

    /// The function's value at each row; `None` if a symbol has neither readings nor a value.
    pub(crate) fn column(&mut self, amount: &Poly) -> Option<Vec<f64>> {
        let mut sum = vec![0.0; self.poses.rows()];
        for term in amount.terms() {
            let mut product = vec![term.coefficient.to_f64(); sum.len()];
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
            sum.iter_mut().zip(&product).for_each(|(s, p)| *s += p);
        }
        Some(sum)
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
        match self.poses.column(symbol) {
            Some(readings) => Some(readings.to_vec()),
            None => self.values.get(symbol.index()).map(|&value| vec![value; self.poses.rows()]),
        }
    }

    fn wave(&mut self, symbol: SymbolId, harmonic: u32, wave: Wave) -> Option<&[f64]> {
        let key = (symbol, harmonic, wave);
        if !self.waves.contains_key(&key) {
            let mut angles = self.reading(symbol)?;
            angles.iter_mut().for_each(|angle| *angle *= f64::from(harmonic));
            let mut cosines = vec![0.0; angles.len()];
            vector::run(vector::path(), SineCosine { angles: &mut angles, cosines: &mut cosines });
            self.waves.insert((symbol, harmonic, Wave::Sin), angles);
            self.waves.insert((symbol, harmonic, Wave::Cos), cosines);
        }
        self.waves.get(&key).map(Vec::as_slice)
    }
}

/// Puts sines in the place of angles, and cosines beside them.
struct SineCosine<'a> {
    angles: &'a mut [f64],
    cosines: &'a mut [f64],
}

impl vector::Work for SineCosine<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, arithmetic: A) {
        let mut waves = vector::Waves::NEW;
        for (angles, cosines) in self.angles.chunks_mut(ROWS).zip(self.cosines.chunks_mut(ROWS)) {
            let mut space = None;
            let (sine, cosine) =
                vector::sin_cos_rows(arithmetic, vector::whole(angles, &mut space), &mut waves);
            let count = angles.len();
            angles.copy_from_slice(&sine[..count]);
            cosines.copy_from_slice(&cosine[..count]);
        }
    }
}
