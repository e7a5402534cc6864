//! Influences at poses spread evenly over a set of poses, for what only the distribution says: percentiles.

use super::first_order::FirstOrder;
use super::poses::{Poses, Space, spread};
use super::probe::Probe;
use super::{BudgetError, one_unit, sized};
use crate::chain::{Chain, ObservableId};

/// The influence of every error with a size (see [`super::Budget::measure`]) at `count` poses, pose by pose.
///
/// The poses are those of the Kronecker sequence of the generalised golden ratio: the same ones each time, and evener than
/// random ones. Source: M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018).
///
/// # Errors
/// The poses do not give the observable a value: see [`BudgetError`].
pub fn influences_at(
    chain: &Chain,
    observable: ObservableId,
    sizes: &[f64],
    poses: &Poses,
    count: usize,
) -> Result<Vec<Vec<f64>>, BudgetError> {
    one_unit(chain, observable)?;
    let errors = sized(chain, sizes);
    let first_order = FirstOrder::new(chain, observable, &errors)?;
    let space = Space::new(chain, observable, poses, |symbol| first_order.harmonic(symbol))?;
    space.keeps_from_poles(chain, observable, &errors)?;
    let probe = Probe::new(chain, observable);
    let mut values = chain.nominal_values();
    let mut found = Vec::with_capacity(count);
    for parameters in spread(&space.bounds, count) {
        space.set(&parameters, &mut values);
        let influences = probe.influences(&mut values, &errors);
        if influences.iter().any(|value| !value.is_finite()) {
            return Err(BudgetError::NotFinite {
                observable: chain.observable(observable).name.clone(),
                pose: space.describe(chain, &values),
            });
        }
        found.push(influences);
    }
    Ok(found)
}
