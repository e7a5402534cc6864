//! What a unit of each error does to an observable at poses, to first order: the columns that tolerances are summed with.

use super::first_order::FirstOrder;
use super::poses::{Path, Poses, Space, domain_of, movable, spread};
use super::probe::Probe;
use super::{BudgetError, sized};
use crate::chain::{Chain, ObservableId, ObservableKind};
use crate::remainder::{Domain, DomainError, keep_away};
use crate::symbol::SymbolId;

/// The first-order columns of some errors at poses, a row of them a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The observable.
    pub observable: ObservableId,
    /// Whether it shows a direction or a point.
    pub kind: ObservableKind,
    /// The errors, in the order of the chain.
    pub errors: Vec<SymbolId>,
    /// The parameter `t` of each pose of a path, rising; empty for poses over ranges, and for given ones.
    pub t: Vec<f64>,
    /// The observable without errors at each pose: a unit vector, or m.
    pub places: Vec<[f64; 3]>,
    /// Pose by pose, error by error: what a unit of the error adds, rad or m by the error's unit. That of a direction is
    /// across it.
    pub columns: Vec<[f64; 3]>,
}

impl Sensitivity {
    /// At `count` poses that stand evenly for a set of them: in the middles of equal steps along a path, or scattered without a
    /// period over ranges. `sizes` says by [`SymbolId`] which errors count: those that are not zero.
    ///
    /// # Errors
    /// The poses do not give the observable a value: see [`BudgetError`].
    pub fn over(
        chain: &Chain,
        observable: ObservableId,
        sizes: &[f64],
        poses: &Poses,
        count: usize,
    ) -> Result<Self, BudgetError> {
        whole_vector(chain, observable)?;
        let first_order = FirstOrder::new(chain, observable, &sized(chain, sizes))?;
        let space = Space::new(chain, observable, poses, |symbol| first_order.harmonic(symbol))?;
        space.keeps_from_poles(chain, observable, &sized(chain, sizes))?;
        let probe = Probe::new(chain, observable);
        let mut found = Self::empty(chain, observable, sizes);
        let parameters: Vec<Vec<f64>> = match poses {
            Poses::Path(_) => {
                let step = (Path::PARAMETER.end - Path::PARAMETER.start) / count.max(1) as f64;
                found.t = (0..count).map(|at| Path::PARAMETER.start + (at as f64 + 0.5) * step).collect();
                found.t.iter().map(|&t| vec![t]).collect()
            }
            Poses::Ranges(_) => spread(&space.bounds, count).collect(),
        };
        let mut values = chain.nominal_values();
        for parameters in &parameters {
            space.set(parameters, &mut values);
            found.add(chain, &probe, &values, || space.describe(chain, &values))?;
        }
        Ok(found)
    }

    /// At given readings: a column of as many values for each joint and input that the observable depends on, SI.
    ///
    /// # Errors
    /// The readings do not give the observable a value: see [`BudgetError`].
    pub fn at(
        chain: &Chain,
        observable: ObservableId,
        sizes: &[f64],
        readings: &[(SymbolId, Vec<f64>)],
    ) -> Result<Self, BudgetError> {
        whole_vector(chain, observable)?;
        let errors = domain_of(chain, &sized(chain, sizes))?;
        let probe = Probe::new(chain, observable);
        let mut found = Self::empty(chain, observable, sizes);
        let mut values = chain.nominal_values();
        let rows = readings.iter().map(|(_, column)| column.len()).min().unwrap_or_default();
        for row in 0..rows {
            for (symbol, column) in readings {
                values[symbol.index()] = column[row];
            }
            at_pose(chain, observable, &errors, &values)
                .map_err(|why| BudgetError::AtPose { row: row + 1, why })?;
            found.add(chain, &probe, &values, || format!("pose {}", row + 1))?;
        }
        Ok(found)
    }

    fn empty(chain: &Chain, observable: ObservableId, sizes: &[f64]) -> Self {
        Self {
            observable,
            kind: chain.observable(observable).kind,
            errors: sized(chain, sizes).into_iter().map(|(error, _)| error).collect(),
            t: Vec::new(),
            places: Vec::new(),
            columns: Vec::new(),
        }
    }

    fn add(
        &mut self,
        chain: &Chain,
        probe: &Probe,
        values: &[f64],
        pose: impl Fn() -> String,
    ) -> Result<(), BudgetError> {
        let (place, slopes) = probe.slopes(values, &self.errors);
        let length = match self.kind {
            ObservableKind::Direction => place.norm(),
            ObservableKind::Point => 1.0,
        };
        self.columns.extend(slopes.into_iter().map(|slope| <[f64; 3]>::from(slope / length)));
        let place = [place.x / length, place.y / length, place.z / length];
        let last = &self.columns[self.columns.len() - self.errors.len()..];
        if last.iter().chain([&place]).flatten().any(|value| !value.is_finite()) {
            let observable = chain.observable(self.observable).name.clone();
            return Err(BudgetError::NotFinite { observable, pose: pose() });
        }
        self.places.push(place);
        Ok(())
    }

    /// The number of poses.
    #[must_use]
    pub fn poses(&self) -> usize {
        self.places.len()
    }

    /// The columns of one pose, one an error.
    #[must_use]
    pub fn at_pose(&self, pose: usize) -> &[[f64; 3]] {
        &self.columns[pose * self.errors.len()..(pose + 1) * self.errors.len()]
    }
}

/// Refuses one pose at a pole.
fn at_pose(
    chain: &Chain,
    observable: ObservableId,
    errors: &Domain,
    values: &[f64],
) -> Result<(), DomainError> {
    let moved: Vec<SymbolId> = movable(chain).collect();
    let there: Vec<[f64; 2]> = moved.iter().map(|id| [values[id.index()]; 2]).collect();
    let domain = errors.with(&moved, &there);
    keep_away(chain, observable, (&[], &[]), |_| Some(domain.clone()))
}

/// What an observable shows has to be its whole vector.
fn whole_vector(chain: &Chain, id: ObservableId) -> Result<(), BudgetError> {
    let observable = chain.observable(id);
    if observable.is_vector() {
        return Ok(());
    }
    Err(BudgetError::NotVector { observable: observable.name.clone() })
}
