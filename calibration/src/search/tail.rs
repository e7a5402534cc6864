//! Tail probabilities of the F test, as logarithms and from a table, so that a thousand sign flips of a hundred
//! candidates cost look-ups.

use statrs::function::beta::{beta_reg, ln_beta};

/// Grid points of the table.
const POINTS: usize = 513;
/// The table's end in the grid variable; p is about e^−144 there.
const END: f64 = 12.0;

/// ln p of the share R² of a sum of squares that a block of `rank` columns explains, under no effect.
///
/// R² is Beta(rank/2, df/2) distributed; the F statistic is the monotone function
/// (R²/rank) / ((1 − R²)/df) of it, so both give the same p.
#[derive(Debug, Clone)]
pub struct Tail {
    rank: usize,
    df: f64,
    /// ln p at even steps of √(−ln(1 − R²)·df/2), in which it is smooth for every rank.
    table: Vec<f64>,
}

/// ln P(R² ≥ `share`) by the incomplete beta function, by its leading asymptotic term where that underflows.
fn ln_tail(rank: usize, df: f64, share: f64) -> f64 {
    let (a, b) = (rank as f64 / 2.0, df / 2.0);
    if share <= 0.0 {
        return 0.0;
    }
    if share >= 1.0 {
        return f64::NEG_INFINITY;
    }
    let p = beta_reg(b, a, 1.0 - share);
    if p > 1e-250 {
        return p.ln();
    }
    b * (-share).ln_1p() + (a - 1.0) * share.ln() - b.ln() - ln_beta(a, b)
}

impl Tail {
    /// Tabulates for blocks of `rank` columns and `df` degrees of freedom left in the residual after them.
    #[must_use]
    pub fn new(rank: usize, df: f64) -> Self {
        let table = (0..POINTS)
            .map(|i| {
                let x = END * i as f64 / (POINTS - 1) as f64;
                ln_tail(rank, df, -(-2.0 * x * x / df).exp_m1())
            })
            .collect();
        Self { rank, df, table }
    }

    /// ln p of explaining `gain` of the sum of squares `rss`.
    #[must_use]
    pub fn ln_p(&self, gain: f64, rss: f64) -> f64 {
        if gain <= 0.0 || rss <= 0.0 || self.rank == 0 || self.df <= 0.0 {
            return 0.0;
        }
        let share = (gain / rss).min(1.0);
        let x = (-(-share).ln_1p() * self.df / 2.0).sqrt();
        let place = x / END * (POINTS - 1) as f64;
        if place >= (POINTS - 1) as f64 {
            return ln_tail(self.rank, self.df, share);
        }
        let i = place as usize;
        let t = place - i as f64;
        self.table[i] * (1.0 - t) + self.table[i + 1] * t
    }
}

/// Tables for every rank that a search meets, at one number of rows.
#[derive(Debug, Clone)]
pub struct Tails {
    by_rank: Vec<Option<Tail>>,
}

impl Tails {
    /// For the ranks given, where `df` degrees of freedom are left before a candidate is added.
    #[must_use]
    pub fn new(ranks: impl IntoIterator<Item = usize>, df: f64) -> Self {
        let mut by_rank: Vec<Option<Tail>> = Vec::new();
        for rank in ranks.into_iter().filter(|&rank| rank > 0 && df > rank as f64) {
            by_rank.resize(by_rank.len().max(rank + 1), None);
            by_rank[rank].get_or_insert_with(|| Tail::new(rank, df - rank as f64));
        }
        Self { by_rank }
    }

    /// ln p of explaining `gain` of `rss` with `rank` columns.
    #[must_use]
    pub fn ln_p(&self, rank: usize, gain: f64, rss: f64) -> f64 {
        self.by_rank.get(rank).and_then(Option::as_ref).map_or(0.0, |tail| tail.ln_p(gain, rss))
    }
}
