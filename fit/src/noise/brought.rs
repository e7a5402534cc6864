//! What uncertain readings bring into residuals, and what noise the rows have beside it.
//!
//! A reading that is off by its standard uncertainty moves a component by as much as the chain says; what several readings bring
//! adds up in squares. How uncertain readings are the study states up to a factor, as it does of what is measured. The factor and the
//! floors beside it are those with which residuals are as large as they are, where either has its part.

use crate::robust;

/// Halvings of an interval of squares: to the last bits.
const HALVINGS: usize = 60;

/// Beside what readings bring, a floor from medians is no smaller than this share of what it were without them: of a few rows that
/// bring nothing the median says nothing.
const LEAST: f64 = 1e-2;

/// Rounds of the estimate of components of variance at most, and the change of a variance below which it has settled.
const ROUNDS: usize = 500;
const SETTLED: f64 = 1e-6;

/// One component: the residual, the standard deviation that is stated of it up to a factor, what its readings bring, its weight, and
/// the share of its weight that estimates leave it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Component {
    pub residual: f64,
    pub stated: f64,
    pub brought: f64,
    pub weight: f64,
    pub left: f64,
}

impl Component {
    /// Of its variance what is its own, and what readings bring.
    fn parts(&self, floor: f64, readings: f64) -> [f64; 2] {
        [floor * self.stated * self.stated, readings * self.brought * self.brought]
    }
}

/// The floor of each pool of components, and the factor on what readings bring; `alone` is the floor of each if readings brought
/// nothing. The factor is one where residuals do not speak clearly for another (Schwarz's criterion).
pub(super) fn floors(pools: &[Vec<Component>], alone: &[f64]) -> (Vec<f64>, f64) {
    let count: f64 = pools.iter().flatten().map(|one| one.left).sum();
    let [stated, free] = [false, true].map(|is_free| Variances::of(pools, alone, is_free));
    let found = if stated.deviance(pools) - free.deviance(pools) > count.ln() { free } else { stated };
    (found.floors.into_iter().map(f64::sqrt).collect(), found.readings.sqrt())
}

/// Components of variance: the floor of each pool, and that of readings, in units of what is stated of them.
struct Variances {
    floors: Vec<f64>,
    readings: f64,
}

impl Variances {
    /// Those with which residuals are as large as they are; that of readings is one if it is not free.
    ///
    /// Source: W. Foerstner, Ein Verfahren zur Schaetzung von Varianz- und Kovarianzkomponenten, Allgemeine Vermessungs-Nachrichten
    /// 86 (1979) 446-453.
    fn of(pools: &[Vec<Component>], alone: &[f64], is_free: bool) -> Self {
        // Readings bring half of it to start from, or as much as is stated of them.
        let sum =
            |of: fn(&Component) -> f64| pools.iter().flatten().map(|one| one.weight * of(one)).sum::<f64>();
        let (squares, brought) = (sum(|one| one.residual.powi(2)), sum(|one| one.brought.powi(2)));
        let readings = if is_free && brought > 0.0 { 0.5 * squares / brought } else { 1.0 };
        let others = (1.0 - readings * brought / squares.max(f64::MIN_POSITIVE)).max(0.1);
        let mut found = Self { floors: alone.iter().map(|alone| others * alone * alone).collect(), readings };
        for _ in 0..ROUNDS {
            let (mut of_readings, mut moved) = ([0.0; 2], 0.0_f64);
            for (own, square) in pools.iter().zip(&mut found.floors) {
                let mut of_floor = [0.0; 2];
                for one in own.iter().filter(|one| one.weight > 0.0) {
                    let [floor, brought] = one.parts(*square, found.readings);
                    let whole = floor + brought;
                    if whole <= 0.0 {
                        continue;
                    }
                    let ratio = one.weight * one.residual.powi(2) / whole;
                    for (sums, part) in [(&mut of_floor, floor / whole), (&mut of_readings, brought / whole)]
                    {
                        sums[0] += part * ratio;
                        sums[1] += part * one.left;
                    }
                }
                moved = moved.max(step(square, of_floor));
            }
            if is_free {
                moved = moved.max(step(&mut found.readings, of_readings));
            }
            if moved < SETTLED {
                break;
            }
        }
        found
    }

    /// −2 ln of the likelihood, up to a constant.
    fn deviance(&self, pools: &[Vec<Component>]) -> f64 {
        let of_pool = |(own, square): (&Vec<Component>, &f64)| {
            let of_each = own.iter().filter(|one| one.weight > 0.0).map(|one| {
                let variance = one.parts(*square, self.readings).iter().sum::<f64>().max(f64::MIN_POSITIVE);
                one.left * variance.ln() + one.weight * one.residual.powi(2) / variance
            });
            of_each.sum::<f64>()
        };
        pools.iter().zip(&self.floors).map(of_pool).sum()
    }
}

/// Takes a variance to where its part of the residuals says; by what share it moves.
fn step(square: &mut f64, [found, expected]: [f64; 2]) -> f64 {
    if expected <= 0.0 {
        return 0.0;
    }
    *square *= found / expected;
    (found / expected - 1.0).abs()
}

/// The floor with which the median residual is what it is of normal noise, with readings as they are stated; `alone` is that of
/// readings that bring nothing.
pub(super) fn floor_of_median(components: &[Component], alone: f64) -> f64 {
    let too_small = |square: f64| {
        let scaled = components.iter().filter(|own| own.residual != 0.0);
        let scaled = scaled
            .map(|own| own.residual.abs() / own.parts(square, 1.0).iter().sum::<f64>().sqrt())
            .collect();
        robust::median(scaled) > robust::median_norm(1)
    };
    let (mut low, mut high) = (0.0, alone * alone);
    if too_small(low) {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let end = if too_small(middle) { &mut low } else { &mut high };
            *end = middle;
        }
    } else {
        high = 0.0;
    }
    high.sqrt().max(LEAST * alone)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// Components of a standard deviation of their own, and of what readings bring, which is stated wrong by a factor.
    fn components(own: f64, brought: impl Fn(usize) -> f64, factor: f64) -> Vec<Component> {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        (0..20_000)
            .map(|at| {
                let brought = brought(at);
                let residual = own * normal() + factor * brought * normal();
                Component { residual, stated: 1.0, brought, weight: 1.0, left: 1.0 }
            })
            .collect()
    }

    fn alone(components: &[Component]) -> f64 {
        let squares: f64 = components.iter().map(|own| own.residual * own.residual).sum();
        (squares / components.len() as f64).sqrt()
    }

    #[test]
    fn the_floor_is_what_readings_do_not_bring() {
        for (own, factor) in [(0.3, 1.0), (1.0, 1.0), (5.0, 1.0), (1.0, 3.0), (1.0, 0.2)] {
            let of = components(own, |at| if at % 3 == 0 { 4.0 } else { 0.5 }, factor);
            let (floors, found) = floors(std::slice::from_ref(&of), &[alone(&of)]);
            assert!((floors[0] - own).abs() < 0.1 * own, "{own} {factor}: {floors:?} {found}");
            assert!((found - factor).abs() < 0.2 * factor, "{own} {factor}: {floors:?} {found}");
        }
        // What is stated is next to nothing beside the floor: no residual says anything of it.
        let of = components(1.0, |at| if at % 3 == 0 { 0.01 } else { 0.001 }, 5.0);
        assert_eq!(floors(std::slice::from_ref(&of), &[alone(&of)]).1, 1.0);
        let of = components(1.0, |at| if at % 3 == 0 { 4.0 } else { 0.5 }, 1.0);
        assert!((floor_of_median(&of, alone(&of)) - 1.0).abs() < 0.1);
    }

    /// Readings that bring as much into every row are told by nobody from the rows' own noise: both together are as large as residuals.
    #[test]
    fn what_cannot_be_told_apart_stays_as_stated() {
        let of = components(1.0, |_| 1.0, 1.0);
        let (floors, factor) = floors(std::slice::from_ref(&of), &[alone(&of)]);
        assert!((floors[0].hypot(factor) - alone(&of)).abs() < 1e-3 * alone(&of), "{floors:?} {factor}");
        assert!((factor - 1.0).abs() < 0.05, "{factor}");
        // And readings that bring nothing leave the floor what it is alone.
        let of = components(1.0, |_| 0.0, 1.0);
        let (floors, factor) = super::floors(std::slice::from_ref(&of), &[alone(&of)]);
        assert!((floors[0] - alone(&of)).abs() < 1e-6 && factor == 1.0, "{floors:?} {factor}");
    }
}
