//! What one row makes of what is unknown: its residual, and how that moves with the chain, the object and the station.

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::measured::Measured;
use super::residual::{Component, Part};
use crate::unknowns::{OF_OBJECT, Object, Pose, State, WIDTH, right_jacobian};

/// An angle that is its sine to the last digit, rad.
const SMALL_RAD: f64 = 1e-6;

/// What turns with a station when the derivative of a target or a sight is taken.
///
/// The two differ by the residual. Steps go by the object: a frame that nothing holds, with all in it, then changes no row. What
/// the data determine is asked by the prediction, which the chain's own turns move: by the object every row would tell the two
/// apart by its residual, and thousands of rows would determine what none of them shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TurnsBy {
    /// The object as the station's numbers have it.
    Object,
    /// What the chain predicts.
    Prediction,
    /// The object, where the row would hit it. Where everything could be larger the rows' noise would tell how much: a search would find a
    /// scale, and as surely as the noise is there.
    Adjusted,
}

/// A row, the object that it observes, and where the station stands.
#[derive(Debug)]
pub(super) struct Seeing<'a> {
    pub measured: &'a Measured,
    pub object: &'a Object,
    /// The object's numbers.
    pub own: [f64; OF_OBJECT],
    pub pose: Pose,
    pub by: TurnsBy,
    /// Transpose of the right Jacobian of the station's turn.
    jacobian: Matrix3<f64>,
}

impl<'a> Seeing<'a> {
    /// Of a row of the observations; `None` if it observes nothing unknown.
    pub fn new(state: &'a State<'a>, row: usize, measured: &'a Measured, by: TurnsBy) -> Option<Self> {
        let (object, own) = state.object(row)?;
        let (pose, moved) = state.station(row)?;
        let jacobian = right_jacobian(&Vector3::new(moved[3], moved[4], moved[5])).transpose();
        Some(Self { measured, object, own, pose, by, jacobian })
    }

    /// The place of a point as its numbers have it, in the objects' frame, three of them from number `first` on.
    pub fn place(&self, first: usize) -> Vector3<f64> {
        self.object.place + Vector3::new(self.own[first], self.own[first + 1], self.own[first + 2])
    }

    /// A component with its derivatives by object and station: by the numbers of the object, by the station's shift, and by a small
    /// turn about the axes of the chain's frame.
    pub fn component<const N: usize>(
        &self,
        part: Part,
        object: [f64; N],
        shift: Vector3<f64>,
        turn: Vector3<f64>,
    ) -> Component {
        let turn = self.jacobian * turn;
        let mut unknown = [0.0; WIDTH];
        unknown[..N].copy_from_slice(&object);
        unknown[OF_OBJECT..].copy_from_slice(&[shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]);
        Component { part, unknown }
    }

    /// Rᵀ(X − t) − p along some axes of the chain's frame.
    pub fn point(&self, p: &Vector3<f64>, axes: [Vector3<f64>; 3]) -> [Component; 3] {
        let there = self.pose.back(&self.place(0));
        let difference = there - p;
        axes.map(|axis| {
            let outside = self.pose.turn * axis;
            let arm = if self.by == TurnsBy::Prediction { *p } else { there };
            let part = (difference.dot(&axis), axis);
            self.component(part, [-outside.x, -outside.y, -outside.z], outside, arm.cross(&axis))
        })
    }
}

/// The way that a point has to go for a residual to be none, by its gradient.
pub(super) fn to_no_residual((residual, gradient): &Part) -> Vector3<f64> {
    let square = gradient.norm_squared();
    if square > 0.0 { gradient * (*residual / square) } else { Vector3::zeros() }
}

/// The residual of a row with derivatives at the point that it would have without one. The chain's are turned and stretched by what
/// takes its point there, and its beam with it.
pub(super) fn adjusted<const M: usize>(
    components: [Component; M],
    predicted: &Vector3<f64>,
    beam: &Vector3<f64>,
    seen: impl Fn(&Vector3<f64>, &Vector3<f64>) -> Option<[Component; M]>,
) -> Option<[Component; M]> {
    let there = components.iter().fold(*predicted, |point, own| point + to_no_residual(&own.part));
    let turn = turn_between(predicted, &there);
    let stretch = Some(there.norm() / predicted.norm()).filter(|stretch| stretch.is_finite()).unwrap_or(1.0);
    let mut at_object = seen(&there, &(turn * beam * stretch))?;
    for (there, own) in at_object.iter_mut().zip(components) {
        there.part = (own.part.0, turn.inverse() * there.part.1 * stretch);
    }
    Some(at_object)
}

/// The turn from one direction to another. Of directions that differ by rounding alone the arc cosine has no value: a row by which alone an
/// object is placed has no residual.
fn turn_between(from: &Vector3<f64>, to: &Vector3<f64>) -> Rotation3<f64> {
    let sine = from.normalize().cross(&to.normalize());
    if sine.norm() < SMALL_RAD && from.dot(to) > 0.0 {
        return Rotation3::new(sine);
    }
    Rotation3::rotation_between(from, to).unwrap_or_else(Rotation3::identity)
}
