//! Poles: whether poses keep away from places where an amount has no value, or an angle is lost.

use super::cells;
use super::domain::{Domain, DomainError};
use super::interval::Interval;
use super::parameter::{Parameter, place};
use super::sight::Sight;
use crate::algebra::Poly;
use crate::chain::reading::Measures;
use crate::chain::{Chain, ObservableId, ObservableKind, TransformKind};
use crate::symbol::{SymbolId, SymbolKind};

/// Refuses poses at which a denominator on the way to an observable vanishes, and those at which the vector of an azimuth or
/// of an angle off the axis may come as near to its axis as the errors reach. `domain_of` says where everything lies in a
/// box of the parameters; nothing, where that is not known.
pub(crate) fn keep_away(
    chain: &Chain,
    observable: ObservableId,
    (parameters, start): (&[Parameter], &[[f64; 2]]),
    domain_of: impl Fn(&[[f64; 2]]) -> Option<Domain>,
) -> Result<(), DomainError> {
    // Boxes are divided along what a question depends on.
    let search = |symbols: &[SymbolId], is_good: &dyn Fn(&Domain) -> bool| -> Result<(), String> {
        let asked: Vec<usize> = (0..start.len())
            .filter(|&index| match parameters[index] {
                Parameter::Symbol(symbol) => symbols.contains(&symbol),
                Parameter::Path => true,
            })
            .filter(|&index| start[index][0] < start[index][1])
            .collect();
        let bound = |ranges: &[[f64; 2]]| {
            let mut whole = start.to_vec();
            asked.iter().zip(ranges).for_each(|(&index, range)| whole[index] = *range);
            match domain_of(&whole) {
                Some(domain) if is_good(&domain) => 0.0,
                _ => f64::INFINITY,
            }
        };
        let ranges: Vec<[f64; 2]> = asked.iter().map(|&index| start[index]).collect();
        let result = cells::largest(&ranges, bound);
        result.map(|_| ()).map_err(|at| {
            let asked: Vec<Parameter> = asked.iter().map(|&index| parameters[index]).collect();
            place(chain, &asked, &at)
        })
    };
    let Some(domain) = domain_of(start) else { return Ok(()) };
    for (symbol, of_sine) in denominators(chain, observable, &domain) {
        let is_good = |domain: &Domain| domain.keeps_from_zero(symbol, of_sine);
        search(&[symbol], &is_good).map_err(|_| DomainError::singular(chain, symbol, of_sine))?;
    }
    let is_lost = |measures| matches!(measures, Measures::Azimuth { .. } | Measures::OffAxis);
    let readings = chain.observable(observable).shown.iter();
    for reading in readings.filter(|reading| is_lost(reading.measures)) {
        let sight = match Sight::new(chain, observable, &domain) {
            // Where a constant has no value, whoever evaluates says so.
            Err(DomainError::RangeNeeded { .. }) => continue,
            sight => sight?,
        };
        // Lengths are lost where ranges are.
        let measures = match reading.measures {
            Measures::OffAxis => Measures::Range,
            other => other,
        };
        let split = sight.split(reading);
        let is_good =
            |domain: &Domain| sight.seen(&split, domain).is_ok_and(|seen| seen.bound(measures).is_finite());
        search(&sight.symbols(reading), &is_good).map_err(|place| sight.lost(reading, place))?;
    }
    Ok(())
}

/// The sines and cosines in denominators on the way to an observable, beside errors that are not zero.
fn denominators(chain: &Chain, id: ObservableId, domain: &Domain) -> Vec<(SymbolId, bool)> {
    let observable = chain.observable(id);
    let way = chain.way(id);
    let moves = |kind| kind == TransformKind::Rotation || observable.kind == ObservableKind::Point;
    let amounts = way.iter().filter(|passed| moves(passed.factor.kind)).map(|passed| &passed.factor.amount);
    let is_there = |symbol: SymbolId| {
        chain.symbol(symbol).kind != SymbolKind::Error || domain.range(symbol) != Some([0.0, 0.0])
    };
    let mut found: Vec<(SymbolId, bool)> = amounts
        .chain(&observable.components)
        .flat_map(Poly::terms)
        .filter(|term| term.powers.iter().all(|&(symbol, _)| is_there(symbol)))
        .flat_map(|term| term.poles)
        .map(|pole| (pole.symbol, pole.sin_power > 0))
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Between what an amount in `t` lies while `t` runs through a range; `None` where that is not known.
pub(crate) fn along_path(chain: &Chain, amount: &Poly, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
    /// Pieces of the range, over which an amount varies less than it seems to over the whole.
    const PIECES: u32 = 16;
    let at = |piece: u32| match piece {
        0 => from,
        PIECES => to,
        _ => from + (to - from) * f64::from(piece) / f64::from(PIECES),
    };
    let mut hull: Option<[f64; 2]> = None;
    for piece in 0..PIECES {
        let domain = Domain::of_path([at(piece), at(piece + 1)]);
        let here = domain.enclose(chain, amount).ok()?;
        let [low, high] = hull.unwrap_or([here.low, here.high]);
        hull = Some([low.min(here.low), high.max(here.high)]);
    }
    hull.filter(|[low, high]| low.is_finite() && high.is_finite())
}

impl Domain {
    /// Where π and the parameter of a path lie, as the amounts of a path number them.
    fn of_path(range: [f64; 2]) -> Self {
        Self::of_ranges(vec![Some([std::f64::consts::PI, std::f64::consts::PI.next_up()]), Some(range)])
    }

    /// Whether a sine or cosine keeps so far from zero that what it divides is a number.
    fn keeps_from_zero(&self, symbol: SymbolId, of_sine: bool) -> bool {
        /// At less, one over it is lost in rounding.
        const LEAST: f64 = 1e-9;
        let angle = Interval::new(self.range(symbol).unwrap_or_else(Interval::turn));
        let wave = if of_sine { angle.sin() } else { angle.cos() };
        wave.low > LEAST || wave.high < -LEAST
    }
}
