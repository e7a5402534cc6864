//! The influences to first order: how fast they go with each joint, and their exact mean squares over full turns.

use super::poses::Space;
use crate::algebra::{AlgebraError, AngleSum, Poly};
use crate::chain::{Chain, ObservableId, ObservableKind};
use crate::forms::{self, FormError};
use crate::symbol::{SymbolId, SymbolKind};

/// The first-order columns of the errors that have a size, where they are no longer than what is worth integrating.
pub(super) struct FirstOrder {
    columns: Vec<(SymbolId, [Poly; 3])>,
    /// Whether the columns are those of the form, not only what stands above a stroke in it, or none at all.
    is_whole: bool,
    /// The observable in its body, where its influence is an angle whatever its length.
    length: Option<[Poly; 3]>,
    /// By [`SymbolId`]: the highest multiple in any column.
    harmonics: Vec<u32>,
    ramps: Vec<SymbolId>,
}

/// Terms of a form on its way beyond which means are taken over poses: with each joint there are twice as many.
const TERMS: usize = 20_000;

impl FirstOrder {
    pub fn new(
        chain: &Chain,
        observable: ObservableId,
        errors: &[(SymbolId, f64)],
    ) -> Result<Self, FormError> {
        let derived = match forms::derive_within(chain, observable, 1, TERMS) {
            // What has no closed form has the waves of its vector, and is measured at nodes.
            Err(error) if error.is_of_no_closed_form() => {
                forms::derive_vector_within(chain, observable, 1, TERMS).map(|form| (form, false))
            }
            form => form.map(|form| (form, true)),
        };
        let angles = chain.sight_angles.iter().map(|angle| angle.symbol);
        let ramps = chain.ramps.iter().map(|ramp| ramp.symbol).chain(angles).collect();
        let shown = chain.observable(observable);
        // The components of a direction make an angle by its length.
        let is_angle = shown.is_vector() && shown.kind == ObservableKind::Direction;
        let length = is_angle.then(|| shown.components.clone());
        let (form, is_closed) = match derived {
            Ok(derived) => derived,
            Err(FormError::Factor { error: AlgebraError::TooLarge, .. }) => {
                let harmonics = fastest(chain, observable);
                return Ok(Self { columns: Vec::new(), is_whole: false, length, harmonics, ramps });
            }
            Err(error) => return Err(error),
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
        Ok(Self { columns, is_whole, length, harmonics, ramps })
    }

    /// The highest multiple of a joint or input in any column.
    pub fn harmonic(&self, symbol: SymbolId) -> u32 {
        self.harmonics[symbol.index()]
    }

    /// What a unit of an error adds to the observable in the ground frame; none if it adds nothing, or the form is too long.
    fn column(&self, error: SymbolId) -> Option<&[Poly; 3]> {
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

/// By [`SymbolId`], the most that the multiple of a joint or input can be in a form, as every amount on the way adds to it.
fn fastest(chain: &Chain, observable: ObservableId) -> Vec<u32> {
    let mut harmonics = vec![0_u32; chain.symbols.len()];
    let way = chain.way(observable);
    for (factor, symbol) in way.iter().flat_map(|passed| {
        let symbols = passed.factor.amount.symbols();
        symbols.into_iter().map(move |symbol| (&passed.factor, symbol))
    }) {
        let turned = match AngleSum::from_poly(&factor.amount) {
            Ok(angle) => {
                angle.multiples().iter().filter(|(id, _)| *id == symbol).map(|(_, n)| n.unsigned_abs()).sum()
            }
            Err(_) => 0,
        };
        let waves = factor.amount.highest_harmonic(symbol);
        let sum = &mut harmonics[symbol.index()];
        *sum = sum.saturating_add(turned).saturating_add(waves);
    }
    harmonics
}
