//! The influence of one error at one pose.

use nalgebra::Vector3;

use crate::chain::{Chain, ObservableId, ObservableKind};
use crate::exact;
use crate::symbol::SymbolId;

/// Evaluates one observable.
#[derive(Debug)]
pub(super) struct Probe {
    path: exact::Path,
    kind: ObservableKind,
    /// Whether it shows its vector.
    is_vector: bool,
}

impl Probe {
    pub fn new(chain: &Chain, observable: ObservableId) -> Self {
        let path = exact::Path::new(chain, observable);
        let observable = chain.observable(observable);
        Self { path, kind: observable.kind, is_vector: observable.is_vector() }
    }

    /// The observable without errors; `values` has all errors at zero.
    pub fn nominal(&self, values: &[f64]) -> Vector3<f64> {
        self.path.value(values)
    }

    /// What one error of this size does: rad for a direction, m for a point, and for readings the root of the sum of their
    /// squared errors. `values` has all errors at zero, and has them so afterwards.
    pub fn influence(&self, values: &mut [f64], error: SymbolId, size: f64, nominal: &Vector3<f64>) -> f64 {
        values[error.index()] = size;
        if !self.is_vector {
            let errors = self.path.shown_error(values);
            values[error.index()] = 0.0;
            return errors.iter().map(|error| error * error).sum::<f64>().sqrt();
        }
        let difference = self.path.error(values);
        values[error.index()] = 0.0;
        match self.kind {
            // The cross product of the two directions needs the difference alone: no digits are lost.
            ObservableKind::Direction => {
                nominal.cross(&difference).norm().atan2(nominal.dot(&(nominal + difference)))
            }
            ObservableKind::Point => difference.norm(),
        }
    }
}
