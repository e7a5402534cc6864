//! The remainder: a proven bound on |exact − first order| over a box of errors, and a search for the largest one.
//!
//! The error of an observable is a power series in the errors that converges everywhere. Its part of degree two is
//! bounded cluster by cluster (`cluster`), all higher parts together by a majorant series (`majorant`); every
//! number on the way is rounded up (`upper`). [`search`] looks for a large remainder, to show how sharp the bound is.
//! The derivation is in the book, page "Remainder".

mod cluster;
mod domain;
mod majorant;
mod quadratic;
mod search;
mod upper;
mod words;

use crate::chain::reading::Reading;
use crate::chain::{Axis, Chain, ObservableId};
use crate::symbol::SymbolId;
use cluster::{Cluster, Element, clusters};
use majorant::Majorant;
use quadratic::{Linear, PairTable, Quadratic};
use upper::Upper;

pub use domain::{Domain, DomainError};
pub use search::{Found, search};
pub use words::text;

/// A bound on the length of the remainder, exact minus first order; no unit for a direction, metres for a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Bound {
    /// Of which observable.
    pub observable: ObservableId,
    /// The bound: never exceeded in the domain. The sum of the two below, rounded up.
    pub value: f64,
    /// The part of it for products of two errors.
    pub second_order: f64,
    /// The part of it for products of three errors and more.
    pub tail: f64,
    /// What share of `second_order` each pair of errors has, largest first. They add up to one.
    pub shares: Vec<PairShare>,
}

/// The share of a pair of errors in a bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairShare {
    /// One error.
    pub one: SymbolId,
    /// The other, or the same again.
    pub other: SymbolId,
    /// Between 0 and 1.
    pub share: f64,
}

/// Bounds |exact − first order| of an observable over a domain.
///
/// Joints without a range turn freely; the bound then holds at all of their angles.
///
/// # Errors
/// [`DomainError`] if a joint or input without a range stands outside of sines and cosines, a denominator vanishes, or
/// something else than components is shown. The bound of some components is that of the whole vector.
///
/// # Example
///
/// ```
/// use model_core::{Chain, remainder::{Domain, bound}};
///
/// let chain = Chain::from_text(
///     "chain Table { body top on ground { motion: Rz(turn); motion_error: Rz(index); } \
///      observe edge: direction(1, 0, 0) of top; }",
/// )?;
/// let (edge, index) = (chain.find_observable("edge").ok_or("none")?, chain.find_symbol("index").ok_or("none")?);
/// let mut domain = Domain::new(&chain);
/// domain.set_range(&chain, index, -1e-3, 1e-3)?;
/// let bound = bound(&chain, edge, &domain)?.value;
/// // What the first order leaves out of a turn by ε is ε²/2 to next order.
/// assert!(bound >= 0.5e-6 && bound < 0.51e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bound(chain: &Chain, observable: ObservableId, domain: &Domain) -> Result<Bound, DomainError> {
    shown_axes(chain, observable)?;
    let clusters = clusters(chain, observable, domain)?;
    let mut prefix = Prefix::new(chain.symbols.len());
    let mut table = PairTable::new(chain.symbols.len());
    let mut second_order = Upper::ZERO;
    for cluster in &clusters {
        second_order = second_order + prefix.carry(cluster, &mut table);
        prefix.append(cluster);
    }
    let tail = tail(&clusters);
    let sum: f64 = table.entries().map(|(_, _, value)| value).sum();
    let mut shares: Vec<PairShare> =
        table.entries().map(|(one, other, value)| PairShare { one, other, share: value / sum }).collect();
    shares.sort_by(|a, b| b.share.total_cmp(&a.share));
    Ok(Bound {
        observable,
        value: (second_order + tail).get(),
        second_order: second_order.get(),
        tail: tail.get(),
        shares,
    })
}

/// The axes of the components that are shown.
fn shown_axes(chain: &Chain, id: ObservableId) -> Result<Vec<Axis>, DomainError> {
    let observable = chain.observable(id);
    let axis = |reading: &Reading| {
        reading.component().ok_or_else(|| DomainError::NoProof {
            observable: observable.name.clone(),
            reading: reading.words(),
        })
    };
    observable.shown.iter().map(axis).collect()
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

    /// The part of degree two of the cluster's vectors in the ground frame.
    fn carry(&self, cluster: &Cluster, table: &mut PairTable) -> Upper {
        let nominal = Upper::norm(cluster.nominal());
        let (first, by_error) = length(&cluster.first_order());
        let second = add_length(&cluster.second_order(), table);
        table.add_table(nominal.get(), &self.by_pair);
        table.add_product(1.0, &self.by_error, &by_error);
        self.second * nominal + self.first * first + second
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
