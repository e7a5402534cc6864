//! The influences to first order: how fast they go with each joint, and their exact mean squares over full turns.

use super::poses::Space;
use crate::algebra::Poly;
use crate::chain::{Chain, ObservableId, ObservableKind};
use crate::forms::{self, FormError};
use crate::symbol::{SymbolId, SymbolKind};

/// The first-order columns of the errors that have a size.
pub(super) struct FirstOrder {
    columns: Vec<(SymbolId, [Poly; 3])>,
    /// Whether the columns are those of the form, not only what stands above a stroke in it.
    is_whole: bool,
    /// The observable in its body, where its influence is an angle whatever its length.
    length: Option<[Poly; 3]>,
    /// By [`SymbolId`]: the highest multiple in any column.
    harmonics: Vec<u32>,
    ramps: Vec<SymbolId>,
}

impl FirstOrder {
    pub fn new(
        chain: &Chain,
        observable: ObservableId,
        errors: &[(SymbolId, f64)],
    ) -> Result<Self, FormError> {
        let (form, is_closed) = match forms::derive(chain, observable, 1) {
            // What has no closed form has the waves of its vector, and is measured at nodes.
            Err(error) if error.is_of_no_closed_form() => {
                (forms::derive_vector(chain, observable, 1)?, false)
            }
            form => (form?, true),
        };
        let is_whole = is_closed && form.is_whole();
        let mut columns = form.columns(chain);
        columns.retain(|(error, _)| errors.iter().any(|(sized, _)| sized == error));
        let mut harmonics = vec![0; chain.symbols.len()];
        for symbol in chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input)) {
            let parts = columns.iter().flat_map(|(_, column)| column);
            let below = form.components.iter().map(|component| &component.below);
            let waves = parts.chain(below).map(|part| part.highest_harmonic(symbol));
            harmonics[symbol.index()] = waves.max().unwrap_or(0);
        }
        let ramps = chain.ramps.iter().map(|ramp| ramp.symbol).collect();
        let observable = chain.observable(observable);
        // The components of a direction make an angle by its length.
        let is_angle = observable.is_vector() && observable.kind == ObservableKind::Direction;
        let length = is_angle.then(|| observable.components.clone());
        Ok(Self { columns, is_whole, length, harmonics, ramps })
    }

    /// The highest multiple of a joint or input in any column.
    pub fn harmonic(&self, symbol: SymbolId) -> u32 {
        self.harmonics[symbol.index()]
    }

    /// What a unit of an error adds to the observable in the ground frame; none if it adds nothing.
    pub fn column(&self, error: SymbolId) -> Option<&[Poly; 3]> {
        self.columns.iter().find(|(symbol, _)| *symbol == error).map(|(_, column)| column)
    }

    /// The root mean square of the influence of an error of this size, exact, if the poses are full turns of joints that
    /// stand in sines and cosines alone. `values` holds everything that is fixed.
    pub fn rms(&self, space: &Space<'_>, error: SymbolId, size: f64, values: &[f64]) -> Option<f64> {
        let turning = space.turning()?;
        // A ramp is no wave, and has no exact mean here.
        let is_turning = |symbol: SymbolId| turning.contains(&symbol) || self.ramps.contains(&symbol);
        if !self.is_whole {
            return None;
        }
        let column = self.column(error)?;
        let mut sum = 0.0;
        for part in column {
            sum += part.mean_square_over_turns(is_turning, values)?;
        }
        let length_squared = match &self.length {
            None => 1.0,
            Some(length) => length.iter().map(|part| part.eval(values).powi(2)).sum(),
        };
        let rms = size.abs() * (sum / length_squared).sqrt();
        rms.is_finite().then_some(rms)
    }
}
