//! Whole turns of an angle: a fit that came round came to where it would have come without.

use std::f64::consts::TAU;

use model_core::algebra::Poly;
use model_core::{Chain, Quantity, SymbolId, TransformKind};

/// Values with each angle that was estimated within half a turn of zero, where nothing but rotations by it hangs on it.
pub(super) fn unwound(chain: &Chain, parameters: &[SymbolId], mut values: Vec<f64>) -> Vec<f64> {
    for id in parameters {
        let value = &mut values[id.index()];
        let turns = (*value / TAU).round();
        if turns != 0.0 && turns.is_finite() && only_turns(chain, *id) {
            *value -= turns * TAU;
        }
    }
    values
}

/// Whether a whole turn of an angle changes nothing.
fn only_turns(chain: &Chain, id: SymbolId) -> bool {
    let mut factors = chain.factors();
    chain.symbol(id).quantity == Quantity::Angle
        && factors.all(|factor| {
            let by = factor.amount.derivative(id);
            by.is_zero()
                || factor.kind == TransformKind::Rotation && (by == Poly::one() || by == -&Poly::one())
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_that_came_round_is_within_half_a_turn_and_nothing_else_changes() {
        let chain = Chain::from_text(
            "chain Arm {
                body link on ground { motion: Rz(q); motion_error: Rz(index), Rx(-twist), Ry(slope*q), Tx(length); }
                observe tip: point(1, 0, 0) of link;
            }",
        )
        .expect("a chain");
        let ids: Vec<SymbolId> = ["index", "twist", "slope", "length"]
            .map(|name| chain.find_symbol(name).expect("a name"))
            .to_vec();
        let degrees = [8370.0_f64, -725.0, 8370.0, 8370.0].map(f64::to_radians);
        let mut values = chain.nominal_values();
        ids.iter().zip(degrees).for_each(|(id, value)| values[id.index()] = value);
        let unwound = unwound(&chain, &ids, values);
        let found = ids.iter().map(|id| unwound[id.index()].to_degrees());
        for (found, wanted) in found.zip([90.0, -5.0, 8370.0, 8370.0]) {
            assert!((found - wanted).abs() < 1e-9, "{found} in place of {wanted}");
        }
    }
}
