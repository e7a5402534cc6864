//! Influences point by point along a path, as figures show them.

use super::first_order::FirstOrder;
use super::poses::{Path, Poses, Space};
use super::probe::Probe;
use super::{BudgetError, one_unit, sized};
use crate::chain::{Chain, ObservableId};
use crate::symbol::SymbolId;

/// The influences on one observable along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Curves {
    /// The parameter of the path, in equal steps from its start to its end.
    pub t: Vec<f64>,
    /// By error in the order of the chain, then by size.
    pub curves: Vec<Curve>,
}

/// The influence of one error at one size.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The error.
    pub error: SymbolId,
    /// Its size in SI.
    pub size: f64,
    /// The influence at each `t`: rad for a direction, m for a point.
    pub influence: Vec<f64>,
}

impl Curves {
    /// Evaluates the influences at `points` values of the parameter. Each error is taken at `steps` sizes in equal steps
    /// up to its own in `sizes` (SI, by [`SymbolId`]).
    ///
    /// # Errors
    /// The path does not give the observable a value.
    pub fn along(
        chain: &Chain,
        observable: ObservableId,
        sizes: &[f64],
        path: &Path,
        points: usize,
        steps: u32,
    ) -> Result<Self, BudgetError> {
        one_unit(chain, observable)?;
        let poses = Poses::Path(path.clone());
        // Says what the path leaves open.
        let first_order = FirstOrder::new(chain, observable, &sized(chain, sizes))?;
        let space = Space::new(chain, observable, &poses, |symbol| first_order.harmonic(symbol))?;
        space.keeps_from_poles(chain, observable, &sized(chain, sizes))?;
        let probe = Probe::new(chain, observable);
        let range = Path::PARAMETER;
        let last = points.max(2) - 1;
        let t: Vec<f64> =
            (0..=last).map(|k| range.start + (range.end - range.start) * k as f64 / last as f64).collect();
        let mut curves: Vec<Curve> = sized(chain, sizes)
            .into_iter()
            .flat_map(|(error, size)| {
                (1..=steps.max(1)).map(move |step| Curve {
                    error,
                    size: size * f64::from(step) / f64::from(steps.max(1)),
                    influence: Vec::with_capacity(points),
                })
            })
            .collect();
        let mut values = chain.nominal_values();
        for &parameter in &t {
            space.set(&[parameter], &mut values);
            for curve in &mut curves {
                let influence = probe.influence(&mut values, curve.error, curve.size);
                if !influence.is_finite() {
                    return Err(BudgetError::NotFinite {
                        observable: chain.observable(observable).name.clone(),
                        pose: space.describe(chain, &values),
                    });
                }
                curve.influence.push(influence);
            }
        }
        Ok(Self { t, curves })
    }
}
