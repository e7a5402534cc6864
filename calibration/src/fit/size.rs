//! How large a parameter may be of which the data say nothing: as the study states, or by default as large as the largest
//! error of the same kind that the data do show.

use model_core::{Quantity, SymbolId, SymbolKind};

use super::FitError;
use super::descent::Course;
use super::normal::Rest;
use super::solve::Solver;

/// The size of errors where the data show none of the same kind, rad, m or 1.
pub const UNSHOWN: f64 = 1e-4;

/// The size of constants that are estimated, rad, m or 1: they are no errors, and may stand anywhere.
const CONSTANT: f64 = 1.0;

/// How large an error may be that these data do not show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// The error or constant.
    pub parameter: SymbolId,
    /// The standard deviation of its prior, SI.
    pub value: f64,
    /// Where it comes from.
    pub origin: SizeOrigin,
}

/// Where the size of an error comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SizeOrigin {
    /// The caller stated it.
    Stated,
    /// The largest error of the same kind that the data determine.
    LargestShown,
    /// The data determine no error of the same kind.
    Default,
}

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
        let mut largest: Vec<(Quantity, f64)> = Vec::new();
        for (at, &parameter) in self.model.parameters().iter().enumerate() {
            let symbol = self.chain.symbol(parameter);
            if !separable[at] || symbol.kind != SymbolKind::Error {
                continue;
            }
            // What noise alone would make of it does not count.
            let variance: f64 = root.row(at).iter().map(|part| part * part).sum();
            let size = (course.point.values[parameter.index()].powi(2) - variance).max(0.0).sqrt();
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
