//! What an estimated symbol does to an observable: it places the instrument, it is the zero of a joint, or it is geometry.
//!
//! A small change of a factor is a rigid motion about or along an axis. Seen from the ground it is the same motion at every pose where it
//! commutes with every motion on the way there: the symbol then places the base. Seen from the observed body, it places the target. Where the
//! motion is that of a joint itself, the symbol is that joint's zero.

use model_core::algebra::Poly;
use model_core::{Chain, Factor, ObservableId, ObservableKind, SymbolId, SymbolKind, TransformKind};
use nalgebra::{Rotation3, Unit, Vector3};

use observe::Series;
use observe::kinds::Predicted;

/// Motions that differ by less, of one radian or one metre, are one: a description of a robot rounds its quarter turns to five digits.
const ALIKE: f64 = 1e-5;

/// What a symbol is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Acts {
    /// Places the base, or the target on the last body.
    Places,
    /// Is the zero of a joint.
    Index,
    /// Anything else.
    Geometry,
}

/// What a symbol does to what was observed: the most general of what it does to each series.
pub(super) fn acts(chain: &Chain, series: &[Series], symbol: SymbolId) -> Acts {
    let mut most = None;
    for own in series {
        let points = chain.observable(own.observable).kind == ObservableKind::Direction
            && own.measure.kind().predicted == Predicted::Vector;
        most = most.max(on_way(chain, own.observable, symbol, points));
    }
    most.unwrap_or(Acts::Geometry)
}

/// What it does on the way to one observable; none where it is not on it.
fn on_way(chain: &Chain, observable: ObservableId, symbol: SymbolId, points: bool) -> Option<Acts> {
    let way = chain.way(observable);
    let factors: Vec<&Factor> = way.iter().map(|passed| passed.factor.as_ref()).collect();
    let bent = chain.observable(observable).bend.as_ref().map_or(0, |bend| bend.factors.len());
    let body = factors.len() - bent;
    let places: Vec<usize> =
        (0..factors.len()).filter(|&at| factors[at].amount.symbols().contains(&symbol)).collect();
    let (&at, others) = places.split_first()?;
    let is_rigid = others.is_empty() && at < body && {
        let change = at_zero(chain, &factors[at].amount.derivative(symbol));
        !change.is_zero() && !moves(chain, &change)
    };
    if !is_rigid {
        return Some(Acts::Geometry);
    }
    let down = walked(chain, factors[..at].iter().rev(), factors[at], 1.0);
    let up = walked(chain, factors[at + 1..body].iter(), factors[at], -1.0);
    // Where an instrument points its last body is what points: nothing is put on it.
    Some(match (down.arrives || (up.arrives && !points), down.is_joint || up.is_joint) {
        (true, _) => Acts::Places,
        (false, true) => Acts::Index,
        (false, false) => Acts::Geometry,
    })
}

/// What became of a small motion on its way along the chain.
struct Walked {
    /// Whether it is the same motion at every pose where the way ends.
    arrives: bool,
    /// Whether it was the motion of a joint somewhere.
    is_joint: bool,
}

fn walked<'a>(
    chain: &Chain,
    factors: impl Iterator<Item = &'a &'a Factor>,
    own: &Factor,
    sign: f64,
) -> Walked {
    let nominal = chain.nominal_values();
    let mut motion = Motion::of(own);
    let mut is_joint = false;
    for factor in factors {
        let amount = at_zero(chain, &factor.amount);
        if amount.is_zero() {
            continue;
        }
        if !moves(chain, &amount) {
            motion = motion.seen_through(factor, sign * amount.eval(&nominal));
            continue;
        }
        let joint = Motion::of(factor);
        is_joint |= motion.is_along(&joint);
        if !motion.commutes_with(&joint) {
            return Walked { arrives: false, is_joint };
        }
    }
    Walked { arrives: true, is_joint }
}

/// An amount without errors.
fn at_zero(chain: &Chain, amount: &Poly) -> Poly {
    amount.graded_part(|symbol| chain.symbol(symbol).kind == SymbolKind::Error, 0)
}

/// Whether an amount changes from row to row.
fn moves(chain: &Chain, amount: &Poly) -> bool {
    amount.symbols().into_iter().any(|symbol| {
        matches!(
            chain.symbol(symbol).kind,
            SymbolKind::Joint | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle
        )
    })
}

/// A small rigid motion: a turn about an axis through the origin, and a shift.
struct Motion {
    turn: Vector3<f64>,
    shift: Vector3<f64>,
}

impl Motion {
    fn of(factor: &Factor) -> Self {
        let mut axis = Vector3::zeros();
        axis[factor.axis.index()] = 1.0;
        match factor.kind {
            TransformKind::Rotation => Self { turn: axis, shift: Vector3::zeros() },
            TransformKind::Translation => Self { turn: Vector3::zeros(), shift: axis },
        }
    }

    /// The same motion in the frame on the other side of a fixed transform.
    fn seen_through(&self, factor: &Factor, amount: f64) -> Self {
        let mut axis = Vector3::zeros();
        axis[factor.axis.index()] = 1.0;
        match factor.kind {
            TransformKind::Rotation => {
                let rotation = Rotation3::from_axis_angle(&Unit::new_unchecked(axis), amount);
                Self { turn: rotation * self.turn, shift: rotation * self.shift }
            }
            TransformKind::Translation => {
                Self { turn: self.turn, shift: self.shift + (axis * amount).cross(&self.turn) }
            }
        }
    }

    /// Whether it does not matter which of two motions comes first.
    fn commutes_with(&self, other: &Self) -> bool {
        let turn = self.turn.cross(&other.turn);
        let shift = self.turn.cross(&other.shift) - other.turn.cross(&self.shift);
        turn.norm() < ALIKE && shift.norm() < ALIKE
    }

    /// Whether both are turns about one axis, or shifts along one direction.
    fn is_along(&self, other: &Self) -> bool {
        if other.turn.norm() > 0.5 {
            return self.turn.cross(&other.turn).norm() < ALIKE
                && self.turn.norm() > 0.5
                && (self.shift - other.shift).norm() < ALIKE;
        }
        self.turn.norm() < ALIKE && self.shift.cross(&other.shift).norm() < ALIKE && self.shift.norm() > 0.5
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// What each of some errors does to a point, or to a direction.
    fn of(text: &str, names: &[&str], points: bool) -> Vec<Acts> {
        let chain = Chain::from_text(text).unwrap();
        let observable = chain.find_observable("seen").unwrap();
        let own = |name: &&str| on_way(&chain, observable, chain.find_symbol(name).unwrap(), points).unwrap();
        names.iter().map(own).collect()
    }

    const ARM: &str = "chain Arm {
        const a: length = 0.4; const b: length = 0.3;
        body base on ground { position_error: Tx(base_x), Rx(base_rx), Rz(base_rz); }
        body first on base {
            motion: Rz(q1);
            motion_error: Rz(zero_1), Ry(lean);
        }
        body second on first {
            position: Tx(a), Rx(pi/2);
            position_error: Rz(zero_2), Ry(slant), Tx(longer);
            motion: Rz(q2);
        }
        body tool on second {
            position: Tx(b);
            position_error: Tx(tool_x), Ry(tool_ry), Rz(wave*cos(q2));
        }
        observe seen: POINT of tool;
    }";

    #[test]
    fn what_is_rigid_on_the_ground_or_the_last_body_places_and_what_turns_like_a_joint_is_its_zero() {
        let names = ["base_x", "base_rx", "zero_1", "zero_2", "slant", "longer", "lean", "tool_x", "wave"];
        let text = ARM.replace("POINT", "point(0.1, 0, 0.2)");
        let expected = [
            Acts::Places,
            Acts::Places,
            // The zero of the first joint turns the base, that of the last one the tool.
            Acts::Places,
            Acts::Places,
            Acts::Geometry,
            Acts::Geometry,
            Acts::Geometry,
            Acts::Places,
            Acts::Geometry,
        ];
        assert_eq!(of(&text, &names, false), expected);
        // Of an instrument that points the base alone is placed.
        let text = ARM.replace("POINT", "direction(1, 0, 0)");
        let pointing = of(&text, &["base_rx", "zero_1", "zero_2", "tool_ry"], true);
        assert_eq!(pointing, [Acts::Places, Acts::Places, Acts::Index, Acts::Geometry]);
    }

    #[test]
    fn a_turn_about_another_axis_that_a_fixed_quarter_turn_makes_the_joints_own_is_its_zero() {
        let text = "chain Mount {
            body az on ground { motion: Rz(azimuth); }
            body el on az {
                position_error: Ry(behind);
                position: Rz(pi/2);
                motion: Rx(elevation);
            }
            body eye on el { position_error: Rx(eye_x), Rz(eye_z); }
            observe seen: direction(0, 1, 0) of eye;
        }";
        let names = ["behind", "eye_x", "eye_z"];
        assert_eq!(of(text, &names, true), [Acts::Index, Acts::Index, Acts::Geometry]);
    }
}
