//! The influences of errors at one pose, each of them alone.

use nalgebra::Vector3;

use crate::chain::reading::Reading;
use crate::chain::{Chain, ObservableId, ObservableKind};
use crate::exact;
use crate::symbol::SymbolId;

/// Evaluates one observable.
#[derive(Debug)]
pub(super) struct Probe {
    path: exact::Path,
    each: exact::Each,
    kind: ObservableKind,
    shown: Shown,
}

/// What is shown.
#[derive(Debug)]
enum Shown {
    /// The vector.
    Vector,
    /// Readings of the vector.
    Readings(Vec<Reading>),
    /// How a body is turned, or where a camera sees a point: no reading of the vector alone.
    Whole,
}

impl Probe {
    pub fn new(chain: &Chain, observable: ObservableId) -> Self {
        let path = exact::Path::new(chain, observable);
        let each = exact::Each::new(chain, observable);
        let observable = chain.observable(observable);
        let shown = if observable.is_vector() {
            Shown::Vector
        } else if observable.is_orientation() || observable.is_image() {
            Shown::Whole
        } else {
            Shown::Readings(observable.shown.clone())
        };
        Self { path, each, kind: observable.kind, shown }
    }

    /// What a unit of each of some errors adds to the vector to first order, and the vector without errors.
    pub fn slopes(&self, values: &[f64], errors: &[SymbolId]) -> (Vector3<f64>, Vec<Vector3<f64>>) {
        let (nominal, slopes) = self.each.slopes(values);
        (nominal, errors.iter().filter_map(|error| Some(slopes[self.place(*error)?])).collect())
    }

    /// What one error of this size does: rad for a direction, m for a point, and for readings the root of the sum of their
    /// squared errors. `values` has all errors at zero, and has them so afterwards.
    pub fn influence(&self, values: &mut [f64], error: SymbolId, size: f64) -> f64 {
        if matches!(self.shown, Shown::Vector)
            && let Some([nominal, added]) = self.each.one_alone(values, error, size)
        {
            return self.size(&nominal, &added);
        }
        values[error.index()] = size;
        let influence = match self.shown {
            Shown::Vector => {
                let added = self.path.error(values);
                values[error.index()] = 0.0;
                self.size(&self.path.value(values), &added)
            }
            Shown::Readings(_) | Shown::Whole => root_of_squares(self.path.shown_error(values)),
        };
        values[error.index()] = 0.0;
        influence
    }

    /// The same of several errors, each with its size.
    pub fn influences(&self, values: &mut [f64], errors: &[(SymbolId, f64)]) -> Vec<f64> {
        if matches!(self.shown, Shown::Whole) {
            return errors.iter().map(|&(error, size)| self.influence(values, error, size)).collect();
        }
        let mut sizes = vec![0.0; self.each.errors().len()];
        for (error, size) in errors {
            if let Some(place) = self.place(*error) {
                sizes[place] = *size;
            }
        }
        let (nominal, added) = self.each.alone(values, &sizes);
        let influence = |(error, _): &(SymbolId, f64)| {
            let added = self.place(*error).map_or_else(Vector3::zeros, |place| added[place]);
            match &self.shown {
                Shown::Readings(readings) => {
                    root_of_squares(readings.iter().map(|reading| reading.error(&nominal, &added)))
                }
                Shown::Vector | Shown::Whole => self.size(&nominal, &added),
            }
        };
        errors.iter().map(influence).collect()
    }

    fn place(&self, error: SymbolId) -> Option<usize> {
        self.each.errors().binary_search(&error).ok()
    }

    /// How much is added to a vector: the angle of a direction, the distance of a point.
    fn size(&self, nominal: &Vector3<f64>, added: &Vector3<f64>) -> f64 {
        match self.kind {
            // The cross product of the two directions needs the difference alone: no digits are lost.
            ObservableKind::Direction => nominal.cross(added).norm().atan2(nominal.dot(&(nominal + added))),
            ObservableKind::Point => added.norm(),
        }
    }
}

fn root_of_squares(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().map(|error| error * error).sum::<f64>().sqrt()
}
