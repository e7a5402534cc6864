//! What share each pair of errors has in the bound on products of two errors; for information, so without directed rounding.

use super::PairShare;
use super::cluster::Cluster;
use super::quadratic::{Linear, PairTable, Quadratic};
use super::sums::Sums;
use super::upper::Upper;
use crate::symbol::SymbolId;

/// Errors of which all pairs are looked at; of more than these, the largest.
const ERRORS: usize = 500;

/// The shares of pairs, largest first: of all errors, or of the largest where there are many. All pairs together have a share
/// of one.
pub(super) fn shares(clusters: &[Cluster]) -> Vec<PairShare> {
    let errors = largest(clusters);
    let keep = |error: SymbolId| errors.binary_search(&error).is_ok();
    let mut prefix = Prefix { by_error: Vec::new(), by_pair: PairTable::new(&errors) };
    // All pairs together: what the products of lengths add up to.
    let (mut first, mut second, mut total) = (Upper::ZERO, Upper::ZERO, Upper::ZERO);
    let mut table = PairTable::new(&errors);
    for cluster in clusters {
        let [sums, _] = Sums::of(cluster, [Upper::ZERO; 3]);
        let nominal = Upper::norm(cluster.nominal());
        total = total + second * nominal + first * Upper::norm(sums.first) + Upper::norm(sums.second);
        let turned = Upper::norm(sums.turned);
        second = second + first * turned + sums.rotation();
        first = first + turned;
        let cluster = cluster.only(keep);
        prefix.carry(&cluster, nominal, &sums, &mut table);
        prefix.append(&cluster, &sums);
    }
    let sum = total.get();
    let share = |(one, other, value): (SymbolId, SymbolId, f64)| PairShare { one, other, share: value / sum };
    let mut shares: Vec<PairShare> = table.entries().map(share).collect();
    shares.sort_by(|a, b| b.share.total_cmp(&a.share));
    shares
}

/// The errors, in order; of many those with the largest sizes of rotations and shifts.
fn largest(clusters: &[Cluster]) -> Vec<SymbolId> {
    let mut sizes: Vec<(SymbolId, f64)> = Vec::new();
    for amount in clusters.iter().flat_map(Cluster::amounts) {
        sizes.extend(amount.first.parts.iter().map(|(error, size)| (*error, size.get())));
        let pairs = amount.second.iter();
        sizes.extend(pairs.flat_map(|(one, other, _)| [(*one, 0.0), (*other, 0.0)]));
    }
    sizes.sort_by_key(|(error, _)| *error);
    let mut summed: Vec<(SymbolId, f64)> = Vec::new();
    for (error, size) in sizes {
        match summed.last_mut() {
            Some((last, sum)) if *last == error => *sum += size,
            _ => summed.push((error, size)),
        }
    }
    summed.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    summed.truncate(ERRORS);
    let mut errors: Vec<SymbolId> = summed.into_iter().map(|(error, _)| error).collect();
    errors.sort_unstable();
    errors
}

/// All clusters passed.
struct Prefix {
    /// What each error has of the first order.
    by_error: Vec<(SymbolId, f64)>,
    /// What each pair has of the second.
    by_pair: PairTable,
}

impl Prefix {
    /// The pairs of the cluster's vectors in the ground frame.
    fn carry(&self, cluster: &Cluster, nominal: Upper, sums: &Sums, table: &mut PairTable) {
        add(&cluster.second_order(), sums.second, table);
        table.add_table(nominal.get(), &self.by_pair);
        table.add_product(1.0, &self.by_error, &by_error(&cluster.first_order(), sums.first));
    }

    /// Multiplies by the rotation of the cluster.
    fn append(&mut self, cluster: &Cluster, sums: &Sums) {
        let by_error = by_error(&cluster.rotation_vector(), sums.turned);
        let [crosses, amounts] = cluster.commutators();
        add(&crosses, sums.crosses, &mut self.by_pair);
        add(&amounts, sums.amounts, &mut self.by_pair);
        self.by_pair.add_product(0.5, &by_error, &by_error);
        self.by_pair.add_product(1.0, &self.by_error, &by_error);
        self.by_error.extend(by_error);
    }
}

/// What each error has of the length of a vector of degree one: the length is the sum of what adds up along each axis, times
/// its direction cosine.
fn by_error(terms: &[(usize, Upper, &Linear)], sum: [Upper; 3]) -> Vec<(SymbolId, f64)> {
    let length = Upper::norm(sum);
    let mut by_error = Vec::new();
    if !length.is_zero() {
        for &(axis, scale, linear) in terms {
            let weight = scale.get() * sum[axis].get() / length.get();
            by_error.extend(linear.parts.iter().map(|&(error, size)| (error, weight * size.get())));
        }
    }
    by_error
}

/// The same of a vector of degree two, pair by pair.
fn add(terms: &[(usize, Quadratic)], sum: [Upper; 3], table: &mut PairTable) {
    let length = Upper::norm(sum);
    if !length.is_zero() {
        for (axis, quadratic) in terms {
            table.add_quadratic(sum[*axis].get() / length.get(), quadratic);
        }
    }
}
