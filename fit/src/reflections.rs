//! Reflections, two at a time: what brings rows into a triangular factor.

use codegen::vector::{self, Arithmetic};

/// Numbers that are multiplied at once.
pub(super) const LANES: usize = 8;

/// Columns that are multiplied by one at once.
const AT_ONCE: usize = 4;

/// Reflections that turn a triangle on top of rows into a triangle alone. Nothing is fused, so that a factor has the
/// same bits on every processor; `faer` fuses where the processor can.
///
/// Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 4th ed., section 5.1; rows go in block by block as in
/// J. Demmel et al., Communication-optimal Parallel and Sequential QR and LU Factorizations (2012), section 4.
pub(super) struct Reflections<'a> {
    /// The triangle, column by column, each down to its diagonal.
    pub packed: &'a mut [f64],
    /// How many columns there are.
    pub side: usize,
    /// So many columns are turned into the triangle; the rows keep what is left of the others.
    pub leading: usize,
    /// The rows, column by column, filled up with zeros to whole groups of lanes: so many numbers a column.
    pub values: &'a mut [f64],
    pub stride: usize,
}

impl vector::Work for Reflections<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, _: A) {
        let Self { packed, side, leading, values, stride } = self;
        if values.is_empty() {
            return;
        }
        let mut turns: Vec<Option<Turn>> = Vec::with_capacity(leading);
        // Of each two of them the product of what is below: what the first adds to a column, the second meets.
        let mut across: Vec<f64> = Vec::with_capacity(leading / 2);
        // Few columns at a time meet all before them: they stay in the first-level cache, and one sum does not wait for another.
        for first in (0..side).step_by(AT_ONCE) {
            let (done, others) = values.split_at_mut(first * stride);
            let several = &mut others[..AT_ONCE.min(side - first) * stride];
            for (pair, turns) in turns.chunks(2).enumerate() {
                let column = 2 * pair;
                let (below, next) = done[column * stride..].split_at(stride);
                if let [Some(one), Some(two)] = turns {
                    let next = &next[..stride];
                    let products = dots_of_two(below, next, several);
                    for (at, target) in several.chunks_exact_mut(stride).enumerate() {
                        let [product, other] = products.map(|of_turn| of_turn[at]);
                        let share = one.apply(column, first + at, packed, product);
                        let shares =
                            [share, two.apply(column + 1, first + at, packed, other + share * across[pair])];
                        add_two(target, shares, below, next);
                    }
                    continue;
                }
                for (column, (turn, below)) in (column..).zip(turns.iter().zip([below, next])) {
                    let Some(turn) = turn else { continue };
                    let below = &below[..stride];
                    let products = dots(below, several);
                    for (at, target) in several.chunks_exact_mut(stride).enumerate() {
                        add(target, turn.apply(column, first + at, packed, products[at]), below);
                    }
                }
            }
            for column in first..(first + AT_ONCE).min(leading) {
                let (own, others) = several.split_at_mut((column - first + 1) * stride);
                let (before, below) = own.split_at((column - first) * stride);
                let turn = Turn::of(dot(below, below), &mut packed[column * (column + 1) / 2 + column]);
                for (target, other) in others.chunks_exact_mut(stride).zip(column + 1..) {
                    let product = dot(below, target);
                    if let Some(turn) = &turn {
                        add(target, turn.apply(column, other, packed, product), below);
                    }
                }
                if column % 2 == 1 {
                    across.push(dot(&before[before.len() - stride..], below));
                }
                turns.push(turn);
            }
        }
    }
}

/// The reflection that turns a column into its corner.
struct Turn {
    corner: f64,
    head: f64,
}

impl Turn {
    /// Of a column with this sum of squares below its corner, which becomes what it is then; none where nothing is below.
    #[inline(always)]
    fn of(square: f64, corner: &mut f64) -> Option<Self> {
        if square < f64::MIN_POSITIVE {
            return None;
        }
        let old = *corner;
        // The sign that does not cancel.
        *corner = -(old * old + square).sqrt().copysign(old);
        Some(Self { corner: *corner, head: old - *corner })
    }

    /// Reflects the head of another column, of which the product with this one is given: the share of what is below here that
    /// what is below there gets.
    #[inline(always)]
    fn apply(&self, own: usize, other: usize, packed: &mut [f64], product: f64) -> f64 {
        let at = other * (other + 1) / 2 + own;
        let share = (self.head * packed[at] + product) / (self.corner * self.head);
        packed[at] += share * self.head;
        share
    }
}

/// The sums of products of a column with each of several, at most as many as are taken at once.
#[inline(always)]
fn dots(a: &[f64], several: &[f64]) -> [f64; AT_ONCE] {
    let mut others = several.chunks_exact(a.len());
    let mut next = || others.next().map(|other| other.as_chunks::<LANES>().0);
    let (Some(b), Some(c), Some(d), Some(e)) = (next(), next(), next(), next()) else {
        let mut fewer = several.chunks_exact(a.len());
        return std::array::from_fn(|_| fewer.next().map_or(0.0, |other| dot(a, other)));
    };
    let mut sums = [[0.0; LANES]; AT_ONCE];
    for ((((a, b), c), d), e) in a.as_chunks::<LANES>().0.iter().zip(b).zip(c).zip(d).zip(e) {
        for lane in 0..LANES {
            sums[0][lane] += a[lane] * b[lane];
            sums[1][lane] += a[lane] * c[lane];
            sums[2][lane] += a[lane] * d[lane];
            sums[3][lane] += a[lane] * e[lane];
        }
    }
    sums.map(|sums| sums.iter().sum())
}

/// The same of two columns; written out, since sums in a list of lists would be kept in memory.
#[inline(always)]
fn dots_of_two(a: &[f64], f: &[f64], several: &[f64]) -> [[f64; AT_ONCE]; 2] {
    let mut others = several.chunks_exact(a.len());
    let mut next = || others.next().map(|other| other.as_chunks::<LANES>().0);
    let (Some(b), Some(c), Some(d), Some(e)) = (next(), next(), next(), next()) else {
        return [dots(a, several), dots(f, several)];
    };
    let [a, f] = [a, f].map(|column| column.as_chunks::<LANES>().0);
    let mut sums = [[0.0; LANES]; AT_ONCE];
    let mut more = [[0.0; LANES]; AT_ONCE];
    for (((((a, f), b), c), d), e) in a.iter().zip(f).zip(b).zip(c).zip(d).zip(e) {
        for lane in 0..LANES {
            sums[0][lane] += a[lane] * b[lane];
            sums[1][lane] += a[lane] * c[lane];
            sums[2][lane] += a[lane] * d[lane];
            sums[3][lane] += a[lane] * e[lane];
            more[0][lane] += f[lane] * b[lane];
            more[1][lane] += f[lane] * c[lane];
            more[2][lane] += f[lane] * d[lane];
            more[3][lane] += f[lane] * e[lane];
        }
    }
    [sums, more].map(|sums| sums.map(|sums| sums.iter().sum()))
}

/// The sum of products, lane by lane.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a, _) = a.as_chunks::<LANES>();
    let (b, _) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in a.iter().zip(b) {
        for lane in 0..LANES {
            sums[lane] += a[lane] * b[lane];
        }
    }
    sums.iter().sum()
}

/// Adds a multiple of `b` to `a`.
#[inline(always)]
fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    let (a, _) = a.as_chunks_mut::<LANES>();
    let (b, _) = b.as_chunks::<LANES>();
    for (a, b) in a.iter_mut().zip(b) {
        // All lanes are read before one is written: lane by lane the compiler would take one column for part of the other.
        *a = std::array::from_fn(|lane| a[lane] + factor * b[lane]);
    }
}

/// Adds multiples of two columns to another one.
#[inline(always)]
fn add_two(a: &mut [f64], [factor, other]: [f64; 2], b: &[f64], c: &[f64]) {
    let (a, _) = a.as_chunks_mut::<LANES>();
    let (b, _) = b.as_chunks::<LANES>();
    let (c, _) = c.as_chunks::<LANES>();
    for ((a, b), c) in a.iter_mut().zip(b).zip(c) {
        *a = std::array::from_fn(|lane| a[lane] + factor * b[lane] + other * c[lane]);
    }
}
