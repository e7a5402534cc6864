//! The remainder of how a body is turned.
//!
//! With the turns εᵢuᵢ in order, Θ = Σ|εᵢ| ≤ 1 and P = Σ_{i<j} |εᵢεⱼ| |uᵢ × uⱼ|, the small rotation vector of their product
//! differs from Σ εᵢuᵢ by at most P (½ + kΘ/3) e^{kΘ} with k = ½ + Θ/11. The derivation is in the book, page "Remainder".

use super::cluster::{Cluster, Element};
use super::upper::Upper;

/// The largest Θ that the bound is derived for, rad.
pub(super) const MOST_RAD: f64 = 1.0;

/// A bound on what the first order leaves out of the small rotation vector.
///
/// # Errors
/// Θ, if that is too large.
pub(super) fn bound(clusters: &[Cluster]) -> Result<Upper, f64> {
    let (mut sum, mut pairs, mut beyond) = (Upper::ZERO, Upper::ZERO, Upper::ZERO);
    for cluster in clusters {
        let turns: Vec<(usize, Upper)> = cluster
            .elements
            .iter()
            .filter_map(|element| match element {
                Element::Rotation(axis, amount) => {
                    let later = amount.second_sum() + amount.tail;
                    beyond = beyond + later;
                    Some((*axis, amount.first.sum + later))
                }
                Element::Vector(..) => None,
            })
            .collect();
        let here: Upper = turns.iter().map(|&(_, angle)| angle).sum();
        // Axes of other clusters may stand across, and turns about one axis go one after the other in any order.
        pairs = pairs + sum * here;
        for (index, &(axis, angle)) in turns.iter().enumerate() {
            let across = turns[..index].iter().filter(|(other, _)| *other != axis);
            pairs = pairs + angle * across.map(|&(_, other)| other).sum();
        }
        sum = sum + here;
    }
    if sum.get() > MOST_RAD {
        return Err(sum.get());
    }
    let k = Upper::exact(0.5) + sum * Upper::rounded(1.0 / 11.0);
    let grown = k * sum;
    Ok(pairs * (Upper::exact(0.5) + grown * Upper::rounded(1.0 / 3.0)) * grown.exp() + beyond)
}
