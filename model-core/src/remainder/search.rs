//! A search for the largest remainder in a domain: many starts, each climbing one symbol at a time.

use nalgebra::Vector3;

use super::domain::{Domain, DomainError};
use super::has_first_order;
use crate::chain::{Chain, ObservableId};
use crate::exact::{Each, Path};
use crate::symbol::{SymbolId, SymbolKind};

/// The largest remainder that a search found, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// The length of exact minus first order, in the unit of [`Bound::value`](super::Bound).
    pub value: f64,
    /// Values of all symbols at that place, indexed by [`SymbolId`], in SI units.
    pub values: Vec<f64>,
    /// How often the remainder was evaluated.
    pub evaluations: usize,
}

/// Points tried across the range of a joint or input before the climb refines the best of them.
const GRID: u32 = 12;
/// Halvings of the step when refining.
const REFINEMENTS: u32 = 12;
/// Rounds over all symbols after which a climb ends in any case.
const ROUNDS: u32 = 30;
/// Errors in wider ranges may do most inside of them; of others only the ends are tried.
const WIDE: f64 = 1.0;
/// Evaluations times errors after which no more starts are made and no more rounds: seconds.
const WORK: usize = 30_000_000;

/// Searches a domain for the largest |exact − first order| of an observable. The same seed finds the same.
///
/// # Errors
/// [`DomainError`] if an input has no range, or what is shown has no first order.
pub fn search(
    chain: &Chain,
    observable: ObservableId,
    domain: &Domain,
    starts: u32,
    seed: u64,
) -> Result<Found, DomainError> {
    has_first_order(chain, observable)?;
    let path = Path::new(chain, observable);
    let evaluations = std::cell::Cell::new(0);
    let length = |values: &[f64]| {
        evaluations.set(evaluations.get() + 1);
        path.shown_remainder(values).iter().map(|part| part * part).sum::<f64>().sqrt()
    };
    let nominal = chain.nominal_values();
    let mut climbed = Vec::new();
    let mut cornered = Vec::new();
    for id in path.symbols() {
        let symbol = chain.symbol(id);
        match (symbol.kind, domain.range(id)) {
            // The path gives ramps and angles of lines of sight their values.
            (SymbolKind::Pi | SymbolKind::Constant | SymbolKind::Ramp | SymbolKind::SightAngle, _) => {}
            (SymbolKind::Error, Some([low, high])) if high - low > WIDE => climbed.push((id, [low, high])),
            (SymbolKind::Error, Some([low, high])) if low < high => cornered.push((id, [low, high])),
            (SymbolKind::Error, _) => {}
            (_, Some(range)) => climbed.push((id, range)),
            (SymbolKind::Joint, None) => climbed.push((id, [0.0, std::f64::consts::TAU])),
            (SymbolKind::Input, None) => {
                return Err(DomainError::RangeNeeded { name: symbol.name.clone() });
            }
        }
    }
    let each = Each::new(chain, observable);
    let size = path.symbols().len();
    let mut work = 0;
    let mut random = Random(seed);
    // Without errors nothing remains.
    let mut best = Found { value: 0.0, values: nominal.clone(), evaluations: 0 };
    for _ in 0..starts {
        let mut values = nominal.clone();
        for &(id, [low, high]) in &climbed {
            values[id.index()] = low + (high - low) * random.uniform();
        }
        // What errors do together to second order is large where they add up to first: each at the end that moves the vector
        // to the same side.
        let side = Vector3::from_fn(|_, _| 2.0 * random.uniform() - 1.0);
        chain.set_derived(&mut values);
        let (_, slopes) = each.slopes(&values);
        for &(id, [low, high]) in &cornered {
            let there = each.errors().binary_search(&id).map_or(0.0, |index| slopes[index].dot(&side));
            let end = if there == 0.0 { 2.0 * random.uniform() - 1.0 } else { there };
            values[id.index()] = if end < 0.0 { low } else { high };
        }
        let start = length(&values);
        // On a pole there is no value; the climb leads away from it.
        let mut found = Found { value: if start.is_finite() { start } else { 0.0 }, values, evaluations: 0 };
        for _ in 0..ROUNDS {
            let before = found.value;
            for &(id, range) in &climbed {
                found.climb(id, range, length);
            }
            for &(id, range) in &cornered {
                for end in range {
                    found.try_value(id, end, length);
                }
                work += 2 * size;
                if work > WORK {
                    break;
                }
            }
            work += size * climbed.len() * (GRID + 2 * REFINEMENTS) as usize;
            if found.value <= before * (1.0 + 1e-9) || work > WORK {
                break;
            }
        }
        if found.value > best.value {
            best = found;
        }
        if work > WORK {
            break;
        }
    }
    best.evaluations = evaluations.get();
    Ok(best)
}

impl Found {
    /// Moves one symbol to a value if the remainder grows.
    fn try_value(&mut self, id: SymbolId, value: f64, length: impl Fn(&[f64]) -> f64) -> bool {
        let old = std::mem::replace(&mut self.values[id.index()], value);
        let candidate = length(&self.values);
        if candidate.is_finite() && candidate > self.value {
            self.value = candidate;
            return true;
        }
        self.values[id.index()] = old;
        false
    }

    /// Moves one symbol to the best place in a range: a grid first, then halved steps around the best.
    fn climb(&mut self, id: SymbolId, [low, high]: [f64; 2], length: impl Fn(&[f64]) -> f64) {
        let mut step = (high - low) / f64::from(GRID);
        for index in 0..=GRID {
            self.try_value(id, low + step * f64::from(index), &length);
        }
        for _ in 0..REFINEMENTS {
            step /= 2.0;
            let here = self.values[id.index()];
            let _ = self.try_value(id, (here - step).max(low), &length)
                || self.try_value(id, (here + step).min(high), &length);
        }
    }
}

/// SplitMix64: repeatable, and good enough to scatter starts.
///
/// Source: Steele, Lea, Flood, "Fast splittable pseudorandom number generators" (2014).
struct Random(u64);

impl Random {
    /// Uniform in [0, 1).
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        (z >> 11) as f64 / (1u64 << 53) as f64
    }
}
