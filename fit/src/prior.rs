//! Prior standard deviations of what the data do not determine: as the study states, as the determined errors suggest, or
//! by default.

use model_core::{Quantity, SymbolId, SymbolKind};

use super::FitError;
use super::normal::Rest;
use super::size::{CONSTANT, Size, SizeOrigin, UNSHOWN};
use super::solver::{Course, Solver};

impl Solver<'_> {
    /// The sizes before anything is known of the errors, in the order of the parameters.
    pub(super) fn first_sizes(&self) -> Vec<f64> {
        self.sizes(&|_| None).into_iter().map(|size| size.value).collect()
    }

    /// The sizes at the end of a course.
    pub(super) fn resolved_sizes(&mut self, course: &Course) -> Result<Vec<f64>, FitError> {
        let partial = self.partial(&course.point.sweep);
        let root = course.subspace.covariance_root(&partial, &Rest::Still);
        let separable = course.subspace.separable();
        let deviation = self.deviation(&course.point.values, &course.subspace);
        let mut largest: Vec<(Quantity, f64)> = Vec::new();
        for (at, &parameter) in self.model.parameters().iter().enumerate() {
            let symbol = self.chain.symbol(parameter);
            if !separable[at] || symbol.kind != SymbolKind::Error {
                continue;
            }
            // What noise alone would make of it does not count.
            let variance: f64 = root.row(at).iter().map(|part| part * part).sum();
            let size = (deviation[at].powi(2) - variance).max(0.0).sqrt();
            match largest.iter_mut().find(|(quantity, _)| *quantity == symbol.quantity) {
                Some((_, known)) => *known = known.max(size),
                None => largest.push((symbol.quantity, size)),
            }
        }
        let shown = |quantity| largest.iter().find(|(known, _)| *known == quantity).map(|(_, size)| *size);
        self.prior_sizes = self.sizes(&|quantity| shown(quantity).filter(|size| *size > 0.0));
        Ok(self.prior_sizes.iter().map(|size| size.value).collect())
    }

    fn sizes(&self, shown: &dyn Fn(Quantity) -> Option<f64>) -> Vec<Size> {
        let size = |&parameter: &SymbolId| {
            let symbol = self.chain.symbol(parameter);
            let stated = self.options.sizes.iter().find(|(id, _)| *id == parameter);
            let (value, origin) = match (stated, symbol.kind, shown(symbol.quantity)) {
                (Some((_, size)), ..) => (*size, SizeOrigin::Stated),
                (None, SymbolKind::Constant, _) => (CONSTANT, SizeOrigin::Default),
                (None, _, Some(size)) => (size, SizeOrigin::LargestShown),
                (None, _, None) => (UNSHOWN, SizeOrigin::Default),
            };
            Size { parameter, value, origin }
        };
        self.model.parameters().iter().map(size).collect()
    }
}
