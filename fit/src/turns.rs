//! Whole turns of an angle: a fit that came round came to where it would have come without. And quarter turns: an angle that is zero
//! where it was not declared to be.

use std::f64::consts::{FRAC_PI_2, TAU};

use model_core::algebra::Poly;
use model_core::{Body, Chain, Factor, Quantity, Role, SymbolId, SymbolKind, TransformKind};

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

/// The whole quarter turns in the value of an error that is the index of a joint, rad: its home, about which it is small. No quarter turn for
/// others.
pub(super) fn home(chain: &Chain, id: SymbolId, value: f64) -> f64 {
    let quarters = (value / FRAC_PI_2).round();
    let turns = quarters != 0.0
        && quarters.is_finite()
        && chain.symbol(id).kind == SymbolKind::Error
        && is_index(chain, id);
    if turns { quarters * FRAC_PI_2 } else { 0.0 }
}

/// Whether an error is the index of a joint: a turn about the axis of its body's motion, and nothing else.
pub(super) fn is_index(chain: &Chain, id: SymbolId) -> bool {
    let has_it = |factor: &&Factor| !factor.amount.derivative(id).is_zero();
    let of_motion = |body: &Body| {
        let own = body.factors.iter().find(has_it)?;
        let motion = |factor: &Factor| {
            factor.role == Role::Motion && factor.kind == own.kind && factor.axis == own.axis
        };
        Some(own.role == Role::MotionError && body.factors.iter().any(motion))
    };
    only_turns(chain, id) && chain.bodies.iter().find_map(of_motion) == Some(true)
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
    fn the_home_of_a_turning_error_is_its_whole_quarter_turns() {
        let chain = Chain::from_text(
            "chain Arm {
                body link on ground { motion: Rz(q); motion_error: Rz(index), Ry(slope*q), Tx(length); }
                body tip on link { position: Rz(pose); }
                const pose: angle = 1.6;
                observe tip: point(1, 0, 0) of tip;
            }",
        )
        .expect("a chain");
        let home = |name: &str, degrees: f64| {
            let id = chain.find_symbol(name).expect("a name");
            home(&chain, id, degrees.to_radians()).to_degrees()
        };
        for (value, wanted) in [(3.0, 0.0), (-44.0, 0.0), (91.0, 90.0), (-182.0, -180.0), (f64::NAN, 0.0)] {
            assert!((home("index", value) - wanted).abs() < 1e-9, "{value}");
        }
        for name in ["slope", "length", "pose"] {
            assert_eq!(home(name, 91.0), 0.0, "{name}");
        }
        let indices: Vec<&str> = ["index", "slope", "length", "pose"]
            .into_iter()
            .filter(|name| is_index(&chain, chain.find_symbol(name).expect("a name")))
            .collect();
        assert_eq!(indices, ["index"]);
    }

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
