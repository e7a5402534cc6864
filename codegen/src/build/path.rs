//! The way from the ground to an observable as steps, each split into what the design says and what the
//! errors add to it.

use model_core::algebra::Poly;
use model_core::{Axis, Chain, Motion, ObservableId, ObservableKind, SymbolId, SymbolKind};

/// One factor on the way: an elementary transform by `nominal + error`, which commute.
pub(super) struct Step {
    pub(super) motion: Motion,
    pub(super) axis: Axis,
    /// The amount where every error is zero.
    pub(super) nominal: Poly,
    /// The rest of the amount.
    pub(super) error: Poly,
}

/// The way to an observable.
pub(super) struct Path {
    /// From the ground up.
    pub(super) steps: Vec<Step>,
    pub(super) kind: ObservableKind,
    /// In the frame of the body that carries it.
    pub(super) components: [Poly; 3],
}

/// Shifts do not move directions, so the way of a direction has none.
pub(super) fn path(chain: &Chain, observable: ObservableId) -> Path {
    let kind = chain.observable(observable).kind;
    let steps = chain
        .factors_to(observable)
        .into_iter()
        .filter(|factor| kind == ObservableKind::Point || factor.motion == Motion::Rotation)
        .map(|factor| {
            let nominal = factor.amount.graded_part(|symbol| is_error(chain, symbol), 0);
            let error = &factor.amount - &nominal;
            Step { motion: factor.motion, axis: factor.axis, nominal, error }
        })
        .collect();
    Path { steps, kind, components: chain.observable(observable).components.clone() }
}

pub(super) fn is_error(chain: &Chain, symbol: SymbolId) -> bool {
    chain.symbol(symbol).kind == SymbolKind::Error
}
