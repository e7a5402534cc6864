//! The remainder of a vector: its part of degree two cluster by cluster, all higher ones together, and never more than turns
//! and shifts can do at all.

use super::cluster::{Cluster, Element, clusters};
use super::domain::{Domain, DomainError};
use super::isometry::Isometry;
use super::majorant::Majorant;
use super::sums::Sums;
use super::upper::Upper;
use crate::chain::{Chain, ObservableId};

/// Bounds on what the errors add to a vector, by degree in them.
#[derive(Debug)]
pub(super) struct Whole {
    pub(super) first_order: Upper,
    pub(super) second_order: Upper,
    pub(super) tail: Upper,
    /// On the remainder, by what turns and shifts can do.
    possible: Upper,
    /// On the whole error, likewise.
    moved: Upper,
}

/// Bounds the vector of an observable over a domain.
pub(super) fn bound(chain: &Chain, observable: ObservableId, domain: &Domain) -> Result<Whole, DomainError> {
    Ok(of_clusters(&clusters(chain, observable, domain)?))
}

/// Bounds the vector that clusters make.
pub(super) fn of_clusters(clusters: &[Cluster]) -> Whole {
    let mut prefix = Prefix::default();
    let (mut first_order, mut second_order) = (Upper::ZERO, Upper::ZERO);
    for cluster in clusters {
        let sums = Sums::of(cluster);
        let [first, second] = prefix.carry(Upper::norm(cluster.nominal()), &sums);
        (first_order, second_order) = (first_order + first, second_order + second);
        prefix.append(&sums);
    }
    let isometry = Isometry::of(clusters);
    let tail = isometry.tail.map_or_else(|| tail(clusters), |other| other.min(tail(clusters)));
    let possible = isometry.remainder.min(isometry.moved + first_order);
    Whole { first_order, second_order, tail, possible, moved: isometry.moved }
}

impl Whole {
    /// A bound on the remainder.
    pub(super) fn remainder(&self) -> Upper {
        (self.second_order + self.tail).min(self.possible)
    }

    /// Whether the degrees add up to less than what is possible at all.
    pub(super) fn is_by_degree(&self) -> bool {
        self.second_order + self.tail <= self.possible
    }

    /// A bound on the whole error.
    pub(super) fn error(&self) -> Upper {
        (self.first_order + self.remainder()).min(self.moved)
    }
}

/// Bounds on the product of all clusters passed, by degree in the errors.
#[derive(Default)]
struct Prefix {
    first: Upper,
    second: Upper,
}

impl Prefix {
    /// The parts of degree one and two of a cluster's vectors in the ground frame.
    fn carry(&self, nominal: Upper, sums: &Sums) -> [Upper; 2] {
        let [first, second] = [sums.first, sums.second].map(Upper::norm);
        [self.first * nominal + first, self.second * nominal + self.first * first + second]
    }

    /// Multiplies by the rotation of the cluster.
    fn append(&mut self, sums: &Sums) {
        let [first, crosses, amounts] = [sums.turned, sums.crosses, sums.amounts].map(Upper::norm);
        let second = (first * first).half() + crosses + amounts;
        self.second = self.second + self.first * first + second;
        self.first = self.first + first;
    }
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
