//! The remainder of a vector: its part of degree two cluster by cluster, all higher ones together.

use super::PairShare;
use super::cluster::{Cluster, Element, clusters};
use super::domain::{Domain, DomainError};
use super::majorant::Majorant;
use super::quadratic::{Linear, PairTable, Quadratic};
use super::upper::Upper;
use crate::chain::{Chain, ObservableId};
use crate::symbol::SymbolId;

/// Bounds on what the errors add to a vector, by degree in them.
#[derive(Debug)]
pub(super) struct Whole {
    pub(super) first_order: Upper,
    pub(super) second_order: Upper,
    pub(super) tail: Upper,
    table: PairTable,
}

/// Bounds the vector of an observable over a domain.
pub(super) fn bound(chain: &Chain, observable: ObservableId, domain: &Domain) -> Result<Whole, DomainError> {
    let clusters = clusters(chain, observable, domain)?;
    let mut prefix = Prefix::new(chain.symbols.len());
    let mut table = PairTable::new(chain.symbols.len());
    let (mut first_order, mut second_order) = (Upper::ZERO, Upper::ZERO);
    for cluster in &clusters {
        let [first, second] = prefix.carry(cluster, &mut table);
        (first_order, second_order) = (first_order + first, second_order + second);
        prefix.append(cluster);
    }
    Ok(Whole { first_order, second_order, tail: tail(&clusters), table })
}

impl Whole {
    /// A bound on the remainder.
    pub(super) fn remainder(&self) -> Upper {
        self.second_order + self.tail
    }

    /// A bound on the whole error.
    pub(super) fn error(&self) -> Upper {
        self.first_order + self.remainder()
    }

    /// What share of the second order each pair of errors has, largest first.
    pub(super) fn shares(&self) -> Vec<PairShare> {
        let sum: f64 = self.table.entries().map(|(_, _, value)| value).sum();
        let share =
            |(one, other, value): (SymbolId, SymbolId, f64)| PairShare { one, other, share: value / sum };
        let mut shares: Vec<PairShare> = self.table.entries().map(share).collect();
        shares.sort_by(|a, b| b.share.total_cmp(&a.share));
        shares
    }
}

/// Bounds on the product of all clusters passed, by degree in the errors.
struct Prefix {
    first: Upper,
    second: Upper,
    /// `first` and `second` by errors, for the shares.
    by_error: Vec<(SymbolId, f64)>,
    by_pair: PairTable,
}

impl Prefix {
    fn new(symbols: usize) -> Self {
        Self {
            first: Upper::ZERO,
            second: Upper::ZERO,
            by_error: Vec::new(),
            by_pair: PairTable::new(symbols),
        }
    }

    /// The parts of degree one and two of the cluster's vectors in the ground frame.
    fn carry(&self, cluster: &Cluster, table: &mut PairTable) -> [Upper; 2] {
        let nominal = Upper::norm(cluster.nominal());
        let (first, by_error) = length(&cluster.first_order());
        let second = add_length(&cluster.second_order(), table);
        table.add_table(nominal.get(), &self.by_pair);
        table.add_product(1.0, &self.by_error, &by_error);
        [self.first * nominal + first, self.second * nominal + self.first * first + second]
    }

    /// Multiplies by the rotation of the cluster.
    fn append(&mut self, cluster: &Cluster) {
        let (first, by_error) = length(&cluster.rotation_vector());
        let [crosses, amounts] = cluster.commutators();
        let second = (first * first).half()
            + add_length(&crosses, &mut self.by_pair)
            + add_length(&amounts, &mut self.by_pair);
        self.by_pair.add_product(0.5, &by_error, &by_error);
        self.by_pair.add_product(1.0, &self.by_error, &by_error);
        self.second = self.second + self.first * first + second;
        self.first = self.first + first;
        self.by_error.extend(by_error);
    }
}

/// The length of a vector of degree one, given by what adds up along each axis, and what each error has of it.
fn length(terms: &[(usize, Upper, &Linear)]) -> (Upper, Vec<(SymbolId, f64)>) {
    let mut sum = [Upper::ZERO; 3];
    for &(axis, scale, linear) in terms {
        sum[axis] = sum[axis] + scale * linear.sum;
    }
    let length = Upper::norm(sum);
    let mut by_error = Vec::new();
    if !length.is_zero() {
        for &(axis, scale, linear) in terms {
            let weight = scale.get() * sum[axis].get() / length.get();
            by_error.extend(linear.parts.iter().map(|&(error, size)| (error, weight * size.get())));
        }
    }
    (length, by_error)
}

/// The length of a vector of degree two, its pairs added to the table.
fn add_length(terms: &[(usize, Quadratic)], table: &mut PairTable) -> Upper {
    let mut sum = [Upper::ZERO; 3];
    for (axis, quadratic) in terms {
        sum[*axis] = sum[*axis] + quadratic.size();
    }
    let length = Upper::norm(sum);
    if !length.is_zero() {
        for (axis, quadratic) in terms {
            table.add_quadratic(sum[*axis].get() / length.get(), quadratic);
        }
    }
    length
}

/// All parts of degree three and more, of every vector carried to the ground.
fn tail(clusters: &[Cluster]) -> Upper {
    let mut prefix = Majorant::ONE;
    let mut tail = Upper::ZERO;
    for element in clusters.iter().flat_map(|cluster| &cluster.elements) {
        match element {
            Element::Rotation(_, amount) => prefix = &prefix * &Majorant::rotation(&amount.majorant()),
            Element::Vector(_, amount) => tail = tail + (&prefix * &amount.majorant()).tail,
        }
    }
    tail
}
