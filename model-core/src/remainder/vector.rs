//! The remainder of a vector: its part of degree two cluster by cluster, all higher ones together, and never more than turns
//! and shifts can do at all.

use super::cluster::{Cluster, Element, clusters};
use super::domain::{Domain, DomainError};
use super::isometry::Isometry;
use super::majorant::Majorant;
use super::reach::Reach;
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
    // The vector without errors as it is seen behind each cluster, from the device to the ground.
    let mut behind = vec![Reach::default(); clusters.len()];
    let mut seen = Reach::default();
    for (place, cluster) in behind.iter_mut().zip(clusters).rev() {
        if let Some(turn) = &cluster.turn {
            seen = turn.outward(seen);
        }
        *place = seen;
        seen = seen.plus(Reach::of(cluster.nominal()));
    }
    // How all clusters before one turn it, to first order.
    let mut turned = Reach::default();
    let (mut first_order, mut second_order) = (Upper::ZERO, Upper::ZERO);
    for (cluster, behind) in clusters.iter().zip(behind) {
        let [own, whole] = Sums::of(cluster, behind.axes);
        let moved = Reach {
            axes: whole.first,
            length: Upper::norm(whole.first)
                .min(Upper::norm(own.first) + Upper::norm(own.turned) * behind.length),
        };
        let second = Upper::norm(whole.second).min(Upper::norm(own.second) + own.rotation() * behind.length);
        first_order = first_order + moved.length;
        second_order = second_order + turned.cross(moved) + second;
        turned = turned.plus(Reach::of(own.turned));
        if let Some(turn) = &cluster.turn {
            turned = turn.inward(turned);
        }
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
