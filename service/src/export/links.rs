//! A chain as joints with rigid transforms between them: what tables of robots are written from.

use model_core::algebra::Poly;
use model_core::{Chain, ObservableKind, Role, SymbolId, SymbolKind, TransformKind};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::subject::{Shown, Subject};
use crate::refusal::Refusal;

/// The joints on the way to an observable, and what lies between them.
#[derive(Debug, Clone)]
pub struct Links {
    /// From the ground outwards.
    pub joints: Vec<Joint>,
    /// The transform before each joint, and behind the last one, from the frame behind the joint before.
    pub fixed: Vec<Isometry3<f64>>,
}

/// A joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joint {
    /// Its reading.
    pub symbol: SymbolId,
    /// Whether it turns, or shifts.
    pub turns: bool,
    /// About or along what, as the reading grows.
    pub axis: Unit<Vector3<f64>>,
}

impl Joint {
    /// What a reading moves.
    pub fn moved(&self, reading: f64) -> Isometry3<f64> {
        if self.turns {
            Isometry3::from_parts(
                Translation3::identity(),
                UnitQuaternion::from_axis_angle(&self.axis, reading),
            )
        } else {
            Isometry3::from_parts(
                Translation3::from(self.axis.into_inner() * reading),
                UnitQuaternion::identity(),
            )
        }
    }
}

impl Links {
    /// The links with these values of errors and constants.
    ///
    /// # Errors
    /// A body moves in a way that is no joint of such a table.
    pub fn of(subject: &Subject, values: &[f64]) -> Result<Self, Refusal> {
        let chain = &subject.chain;
        let anywhere = subject.at(0, values);
        let mut links = Self { joints: Vec::new(), fixed: vec![Isometry3::identity()] };
        for passed in chain.way(subject.observable) {
            let body = &chain.body(passed.body).name;
            let refused =
                |why: &str| Err(Refusal::Input(format!("body `{body}` of chain {}: {why}", chain.name)));
            if passed.is_reversed {
                return refused("it is seen from another body, and such a table begins at the ground");
            }
            let factor = &passed.factor;
            let mut along = Vector3::zeros();
            along[factor.axis.index()] = 1.0;
            let turns = factor.kind == TransformKind::Rotation;
            let readings = match factor.role {
                // Errors that follow a reading are zero here, so that it does not matter where.
                Role::PositionError | Role::MotionError => Vec::new(),
                Role::Position | Role::Motion => readings(chain, &factor.amount),
            };
            let zero = Joint { symbol: SymbolId::PI, turns, axis: Unit::new_unchecked(along) };
            let joint = match readings.as_slice() {
                [] => {
                    links.append(zero.moved(factor.amount.eval(&anywhere)));
                    continue;
                }
                [joint] if factor.role == Role::Motion => *joint,
                [_] => return refused("its place follows a reading, and such a table has constant places"),
                _ => return refused("a move by several readings is no joint of such a table"),
            };
            let slope = factor.amount.derivative(joint).as_constant().map(|slope| slope.to_f64());
            let Some(slope) = slope.filter(|slope| slope.abs() == 1.0) else {
                return refused("it moves by another amount than its reading, which such a table cannot say");
            };
            if chain.symbol(joint).kind != SymbolKind::Joint {
                return refused("it moves by an input, and such a table has joints");
            }
            let mut at_zero = values.to_vec();
            at_zero[joint.index()] = 0.0;
            links.append(zero.moved(factor.amount.eval(&at_zero)));
            links.joints.push(Joint { symbol: joint, axis: Unit::new_unchecked(along * slope), turns });
            links.fixed.push(Isometry3::identity());
        }
        if links.joints.is_empty() {
            return Err(Refusal::Input(format!(
                "chain {} has no joint on the way to what is observed",
                chain.name
            )));
        }
        Ok(links)
    }

    fn append(&mut self, behind: Isometry3<f64>) {
        if let Some(last) = self.fixed.last_mut() {
            *last *= behind;
        }
    }

    /// What the observable shows at every pose.
    pub fn shown(&self, subject: &Subject) -> Shown {
        let observable = subject.chain.observable(subject.observable);
        let without = subject.without_errors();
        let shown = (0..subject.poses.count).map(|pose| {
            let at = subject.at(pose, &without);
            let mut place = self.fixed[0];
            for (joint, fixed) in self.joints.iter().zip(&self.fixed[1..]) {
                place = place * joint.moved(at[joint.symbol.index()]) * fixed;
            }
            let own = observable.components.each_ref().map(|component| component.eval(&at));
            match observable.kind {
                ObservableKind::Direction => (place * Vector3::from(own)).into(),
                ObservableKind::Point => (place * Point3::from(own)).coords.into(),
            }
        });
        shown.collect()
    }
}

/// The joints, inputs and ramps in an amount.
fn readings(chain: &Chain, amount: &Poly) -> Vec<SymbolId> {
    let mut all = amount.symbols();
    all.retain(|id| {
        matches!(
            chain.symbol(*id).kind,
            SymbolKind::Joint | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle
        )
    });
    all
}

/// The errors of an instrument that constant places carry, as values of all symbols in which every other error is zero; and the others.
pub fn constant_errors(subject: &Subject) -> (Vec<f64>, Vec<SymbolId>) {
    let chain = &subject.chain;
    let way = chain.way(subject.observable);
    let (mut values, mut others) = (subject.values.clone(), Vec::new());
    for error in chain.symbols_of(SymbolKind::Error) {
        let is_constant = way.iter().all(|passed| {
            let amount = &passed.factor.amount;
            let factors = amount.collect_by(|symbol| symbol == error);
            factors.iter().all(|(monomial, beside)| monomial.is_empty() || readings(chain, beside).is_empty())
        });
        // What bends the line of sight is no place.
        let is_on_the_way = way.iter().any(|passed| passed.factor.amount.symbols().contains(&error));
        if subject.values[error.index()] != 0.0 && !(is_constant && is_on_the_way) {
            values[error.index()] = 0.0;
            others.push(error);
        }
    }
    (values, others)
}
