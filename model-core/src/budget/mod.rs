//! The error budget: what each error alone does to an observable over a set of poses, and what all of them do together.
//!
//! Largest values are measured on the exact form, and so are means over ranges and paths. The root mean square over full
//! turns of all joints is that of the first-order influence, which the canonical form gives without any nodes. The influence of an error at a pose is the angle between the direction with
//! the error and the one without (rad), or the distance of the two points (m). Over the poses it is summed up by its
//! largest value and its root mean square.
//!
//! - [`Poses`]: along a path of one parameter, or over ranges of joints and inputs.
//! - [`Budget::measure`]: the influences and their sums.
//! - [`Sensitivity`]: the first-order columns at poses, from which tolerances are summed.
//! - [`Curves::along`]: the influences point by point along a path, for plots.

mod curves;
mod first_order;
mod poses;
mod probe;
mod quadrature;
mod sample;
mod sensitivity;
mod summary;

#[cfg(test)]
mod tests;

use crate::chain::{Chain, ObservableId, ObservableKind};
use crate::forms::FormError;
use crate::remainder::DomainError;
use crate::symbol::SymbolId;
use first_order::FirstOrder;
use poses::Space;
use probe::Probe;
use summary::Sampled;

pub use curves::{Curve, Curves};
pub use poses::{JointRange, Path, PathError, Poses, spread};
pub use sample::influences_at;
pub use sensitivity::Sensitivity;
pub use summary::{Measure, Summary};

/// What every error does to an observable over a set of poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Budget {
    /// The observable.
    pub observable: ObservableId,
    /// The joints and inputs that [`Summary::at`] gives for ranges; empty along a path.
    pub parameters: Vec<SymbolId>,
    /// One for each error with a size, in the order of the chain.
    pub influences: Vec<Influence>,
    /// The sum of all influences at each pose: to first order no combination within the sizes does more.
    pub worst_case: Summary,
    /// The root of the sum of the squared influences at each pose: what to expect of independent errors.
    pub root_sum_square: Summary,
    /// Whether some root mean square comes from scattered poses and is right to about a percent only: the influences have
    /// more waves over the poses than a rule has nodes for. That of `worst_case` does so wherever that is the case.
    pub is_sampled: bool,
}

/// What one error alone does.
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// The error.
    pub error: SymbolId,
    /// Its size in SI.
    pub size: f64,
    /// What it does over the poses.
    pub summary: Summary,
}

/// Why a budget cannot be measured.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BudgetError {
    /// A joint or input moves the observable, and nothing says what its value is.
    #[error("{observable} depends on {name}, and nothing says over which values it goes")]
    NoValue {
        /// The observable.
        observable: String,
        /// The joint or input.
        name: String,
    },
    /// The observable has no first-order form.
    #[error(transparent)]
    Form(#[from] FormError),
    /// An observable shows angles and lengths together.
    #[error("{observable} shows {one} and {other}, whose errors are not of one unit: observe them apart")]
    Units {
        /// The observable.
        observable: String,
        /// What it shows first.
        one: &'static str,
        /// What has another unit.
        other: &'static str,
    },
    /// Tolerances are summed as vectors.
    #[error(
        "{observable} shows single readings, and tolerances are summed for whole directions and points: observe one"
    )]
    NotVector {
        /// The observable.
        observable: String,
    },
    /// There is a pole among the poses.
    #[error(transparent)]
    Pole(#[from] DomainError),
    /// There is one at a given pose.
    #[error("pose {row}: {why}")]
    AtPose {
        /// The number of the pose, from one.
        row: usize,
        /// What is wrong there.
        why: DomainError,
    },
    /// The observable has no finite value at a pose.
    #[error("{observable} has no finite value at {pose}")]
    NotFinite {
        /// The observable.
        observable: String,
        /// The pose in words.
        pose: String,
    },
}

impl Budget {
    /// Measures a budget; `sizes` are in SI and indexed by [`SymbolId`], zero for errors to leave out.
    ///
    /// # Errors
    /// The poses do not give the observable a value: see [`BudgetError`].
    pub fn measure(
        chain: &Chain,
        observable: ObservableId,
        sizes: &[f64],
        poses: &Poses,
    ) -> Result<Self, BudgetError> {
        one_unit(chain, observable)?;
        let errors = sized(chain, sizes);
        let first_order = FirstOrder::new(chain, observable, &errors)?;
        let space = Space::new(chain, observable, poses, |symbol| first_order.harmonic(symbol))?;
        space.keeps_from_poles(chain, observable, &errors)?;
        let probe = Probe::new(chain, observable);
        let mut single = vec![Sampled::default(); errors.len()];
        let (mut summed, mut rooted) = (Sampled::default(), Sampled::default());
        let mut values = chain.nominal_values();
        let nodes = space.nodes();
        for (number, node) in nodes.iter().enumerate() {
            space.set(&node.parameters, &mut values);
            let influences = probe.influences(&mut values, &errors);
            for (&influence, sampled) in influences.iter().zip(&mut single) {
                sampled.add(number, node, influence);
            }
            summed.add(number, node, sum(&influences));
            rooted.add(number, node, in_quadrature(&influences));
            if influences.iter().any(|value| !value.is_finite()) {
                return Err(BudgetError::NotFinite {
                    observable: chain.observable(observable).name.clone(),
                    pose: space.describe(chain, &values),
                });
            }
        }
        let mut is_sampled = false;
        let influences: Vec<Influence> = errors
            .iter()
            .zip(&single)
            .map(|(&(error, size), sampled)| {
                let mut summary = sampled.summarise(&space, &nodes, |parameters| {
                    space.set(parameters, &mut values);
                    probe.influence(&mut values, error, size)
                });
                match first_order.rms(&space, error, size, &values) {
                    Some(rms) => summary.rms = rms,
                    None => is_sampled |= space.is_sampled,
                }
                Influence { error, size, summary }
            })
            .collect();
        let sum_of_squares: f64 = influences.iter().map(|one| one.summary.rms * one.summary.rms).sum();
        let together = |sampled: &Sampled, combine: fn(&[f64]) -> f64| {
            let mut values = chain.nominal_values();
            sampled.summarise(&space, &nodes, |parameters| {
                space.set(parameters, &mut values);
                combine(&probe.influences(&mut values, &errors))
            })
        };
        // The mean of a sum of squares is the sum of their means.
        let root_sum_square = Summary { rms: sum_of_squares.sqrt(), ..together(&rooted, in_quadrature) };
        Ok(Self {
            observable,
            parameters: space.symbols().to_vec(),
            influences,
            worst_case: together(&summed, sum),
            root_sum_square,
            is_sampled,
        })
    }

    /// The unit of the influences: `rad`, `m` or `1`.
    #[must_use]
    pub fn unit(&self, chain: &Chain) -> &'static str {
        unit(chain, self.observable)
    }
}

/// The unit of influences on an observable: `rad` or `m`, and `1` for single components of a direction.
#[must_use]
pub fn unit(chain: &Chain, observable: ObservableId) -> &'static str {
    let observable = chain.observable(observable);
    match observable.kind {
        ObservableKind::Direction if observable.is_vector() => "rad",
        kind => observable.shown.first().map_or("1", |reading| reading.unit(kind)),
    }
}

/// What an observable shows has to be of one unit, so that its errors can be added up.
///
/// # Errors
/// It shows numbers of two units.
pub fn one_unit(chain: &Chain, id: ObservableId) -> Result<(), BudgetError> {
    let observable = chain.observable(id);
    match observable.of_other_unit() {
        None => Ok(()),
        Some(other) => Err(BudgetError::Units {
            observable: observable.name.clone(),
            one: observable.label(0),
            other: other.word,
        }),
    }
}

fn sum(influences: &[f64]) -> f64 {
    influences.iter().sum()
}

fn in_quadrature(influences: &[f64]) -> f64 {
    influences.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// The errors with a size, in order.
fn sized(chain: &Chain, sizes: &[f64]) -> Vec<(SymbolId, f64)> {
    chain
        .symbols_of(crate::SymbolKind::Error)
        .filter_map(|error| sizes.get(error.index()).map(|&size| (error, size)))
        .filter(|(_, size)| *size != 0.0)
        .collect()
}
