//! What one row makes of what is unknown: its residual, and how that moves with the chain, the object and the station.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::residual;
use observe::unknowns::{OF_OBJECT, Object, Pose, Unknowns, WIDTH, own_numbers, right_jacobian, tilted};
use observe::{Measure, Measured, tangent_frame};

/// An angle that is its sine to the last digit, rad.
const SMALL_RAD: f64 = 1e-6;

/// Per component the derivatives of what is predicted by the numbers of the object, then by those of the station.
pub(crate) type Columns = [[f64; WIDTH]; 3];

/// Residual components of a row, the gradient of each predicted component by the chain's x, y, z, and the derivatives by
/// what is unknown.
pub(crate) type Seen = ([(f64, Vector3<f64>); 3], Columns);

/// What a row shows of its object from its station, the chain saying `predicted`; `None` if it observes nothing unknown.
///
/// `state` holds all numbers that are estimated, `first` where those of each station and of each object begin; `beam` points
/// the way in which a target was seen, of any length; that of a sight from a point of the chain goes from there to `predicted`.
#[allow(clippy::too_many_arguments)]
pub(crate) fn seen(
    unknowns: &Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
    measure: Measure,
    measured: &Measured,
    predicted: &Vector3<f64>,
    beam: &Vector3<f64>,
    turns_by: TurnsBy,
) -> Option<Seen> {
    let (object, own) = object_of(unknowns, first, state, row)?;
    let (pose, by) = pose_of(unknowns, first, state, row)?;
    let frame = Frame {
        by: turns_by,
        pose,
        jacobian: right_jacobian(&Vector3::new(by[3], by[4], by[5])).transpose(),
    };
    let shown = |predicted: &Vector3<f64>, beam: &Vector3<f64>| {
        Some(match (measure, measured) {
            (Measure::Plane, _) => frame.plane(object, own, predicted),
            (Measure::Target, _) => frame.target(object, own, predicted, beam),
            (Measure::Fixed, _) => frame.fixed(object, own, predicted),
            // A distance is a wire's length that lacks nothing: an object that is a point has no fourth number.
            (Measure::Wire | Measure::Distance, Measured::Length { length_m }) => {
                frame.wire(object, own, *length_m, predicted)
            }
            (Measure::Circle, _) => frame.circle(object, own, 0.0, predicted),
            (Measure::Ring, Measured::Length { length_m }) => frame.circle(object, own, *length_m, predicted),
            (Measure::Sight, _) => frame.sight(object, own, predicted),
            (Measure::Beam, _) => frame.beam(object, own, predicted, beam),
            _ => return None,
        })
    };
    let seen = shown(predicted, beam)?;
    if turns_by == TurnsBy::Adjusted { adjusted(seen, predicted, beam, shown) } else { Some(seen) }
}

/// How far the point that a row observes is from `origin`, which is in the chain's frame, m.
pub(crate) fn distance(
    unknowns: &Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
    origin: &Vector3<f64>,
) -> Option<f64> {
    let (object, own) = object_of(unknowns, first, state, row)?;
    let (pose, _) = pose_of(unknowns, first, state, row)?;
    Some((pose.back(&(object.place + Vector3::new(own[0], own[1], own[2]))) - origin).norm())
}

/// What a row observes, and its numbers.
fn object_of<'a>(
    unknowns: &'a Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
) -> Option<(&'a Object, [f64; OF_OBJECT])> {
    let at = (*unknowns.object.get(row)?)? as usize;
    let object = unknowns.objects.get(at)?;
    Some((object, own_numbers(state, first[1][at], object.numbers())))
}

/// Where a row was observed from, and the numbers of that station.
fn pose_of(
    unknowns: &Unknowns,
    first: &[Vec<usize>; 2],
    state: &[f64],
    row: usize,
) -> Option<(Pose, [f64; 6])> {
    let at = *unknowns.station.get(row)? as usize;
    let station = unknowns.stations.get(at)?;
    let by = own_numbers(state, first[0][at], station.numbers());
    Some((station.pose.moved(&by), by))
}

/// The way that a point has to go for a residual to be none, by its gradient.
fn to_no_residual((residual, gradient): &(f64, Vector3<f64>)) -> Vector3<f64> {
    let square = gradient.norm_squared();
    if square > 0.0 { gradient * (*residual / square) } else { Vector3::zeros() }
}

/// The residual of a row with derivatives at the point that it would have without one. The chain's are turned and stretched by what
/// takes its point there, and its beam with it.
fn adjusted(
    (mut components, _): Seen,
    predicted: &Vector3<f64>,
    beam: &Vector3<f64>,
    shown: impl Fn(&Vector3<f64>, &Vector3<f64>) -> Option<Seen>,
) -> Option<Seen> {
    let there = components.iter().fold(*predicted, |point, step| point + to_no_residual(step));
    let turn = turn_between(predicted, &there);
    let stretch = Some(there.norm() / predicted.norm()).filter(|stretch| stretch.is_finite()).unwrap_or(1.0);
    let (at_object, columns) = shown(&there, &(turn * beam * stretch))?;
    for ((_, gradient), (_, there)) in components.iter_mut().zip(at_object) {
        *gradient = turn.inverse() * there * stretch;
    }
    Some((components, columns))
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

/// What turns with a station when the derivative of a target or a sight is taken.
///
/// The two differ by the residual. Steps go by the object: a frame that nothing holds, with all in it, then changes no row. What
/// the data determine is asked by the prediction, which the chain's own turns move: by the object every row would tell the two
/// apart by its residual, and thousands of rows would determine what none of them shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TurnsBy {
    /// The object as the station's numbers have it.
    Object,
    /// What the chain predicts.
    Prediction,
    /// The object, where the row would hit it. Where everything could be larger the rows' noise would tell how much: a search would find a
    /// scale, and as surely as the noise is there.
    Adjusted,
}

/// Where the station stands, and what its turn does when its numbers change.
struct Frame {
    pose: Pose,
    by: TurnsBy,
    /// Transpose of the right Jacobian of the turn.
    jacobian: Matrix3<f64>,
}

impl Frame {
    /// The derivatives of one component by object and station: by the numbers of the object, by the station's shift, and
    /// by a small turn about the axes of the chain's frame.
    fn row<const N: usize>(&self, object: [f64; N], shift: Vector3<f64>, turn: Vector3<f64>) -> [f64; WIDTH] {
        let turn = self.jacobian * turn;
        let mut row = [0.0; WIDTH];
        row[..N].copy_from_slice(&object);
        row[OF_OBJECT..].copy_from_slice(&[shift.x, shift.y, shift.z, turn.x, turn.y, turn.z]);
        row
    }

    /// n·(R p + t) − d against zero.
    fn plane(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>) -> Seen {
        let (n, by_tilt) = tilted(&object.normal, [own[0], own[1]]);
        let from = self.pose.apply(p) - object.place;
        let gradient = self.pose.turn.inverse() * n;
        let object = [by_tilt[0].dot(&from), by_tilt[1].dot(&from), -1.0];
        let row = self.row(object, n, p.cross(&gradient));
        one((own[2] - n.dot(&from), gradient), row)
    }

    /// Rᵀ(X − t) − p across, up and along the beam.
    fn target(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>, beam: &Vector3<f64>) -> Seen {
        let beam = beam.normalize();
        let [across, up] = tangent_frame(&beam);
        self.point(object, own, p, [across, up, beam])
    }

    /// Rᵀ(X − t) − p along x, y, z of the chain's frame: along those of the objects' frame each would have a noise of its own there, by
    /// which a frame that nothing holds would turn.
    fn fixed(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>) -> Seen {
        self.point(object, own, p, [Vector3::x(), Vector3::y(), Vector3::z()])
    }

    /// Rᵀ(X − t) − p along some axes of the chain's frame.
    fn point(
        &self,
        object: &Object,
        own: [f64; OF_OBJECT],
        p: &Vector3<f64>,
        axes: [Vector3<f64>; 3],
    ) -> Seen {
        let there = self.pose.back(&(object.place + Vector3::new(own[0], own[1], own[2])));
        let difference = there - p;
        let component = |axis: Vector3<f64>| {
            let outside = self.pose.turn * axis;
            let arm = if self.by == TurnsBy::Prediction { *p } else { there };
            let row = self.row([-outside.x, -outside.y, -outside.z], outside, arm.cross(&axis));
            ((difference.dot(&axis), axis), row)
        };
        let [a, b, c] = axes.map(component);
        ([a.0, b.0, c.0], [a.1, b.1, c.1])
    }

    /// The length read against |R p + t − a| − z.
    fn wire(&self, object: &Object, own: [f64; OF_OBJECT], length_m: f64, p: &Vector3<f64>) -> Seen {
        let from = self.pose.apply(p) - object.place - Vector3::new(own[0], own[1], own[2]);
        let distance = from.norm();
        let u = from / distance;
        let gradient = self.pose.turn.inverse() * u;
        let row = self.row([-u.x, -u.y, -u.z, -1.0], u, p.cross(&gradient));
        one((length_m + object.offset + own[3] - distance, gradient), row)
    }

    /// How far R p + t is off the plane of a circle, and how far outside of it; `radius_m` is what is known of the radius.
    fn circle(&self, object: &Object, own: [f64; OF_OBJECT], radius_m: f64, p: &Vector3<f64>) -> Seen {
        let (n, by_tilt) = tilted(&object.normal, [own[0], own[1]]);
        let from = self.pose.apply(p) - object.place - Vector3::new(own[2], own[3], own[4]);
        let off = n.dot(&from);
        let inside = from - n * off;
        let distance = inside.norm();
        let u = inside / distance;
        let tilts = by_tilt.map(|by| by.dot(&from));
        let out = self.pose.turn.inverse() * u;
        let up = self.pose.turn.inverse() * n;
        let off_plane = self.row([tilts[0], tilts[1], -n.x, -n.y, -n.z, 0.0], n, p.cross(&up));
        let lean = off / distance;
        let off_circle =
            self.row([-tilts[0] * lean, -tilts[1] * lean, -u.x, -u.y, -u.z, -1.0], u, p.cross(&out));
        let radius = radius_m + object.offset + own[5];
        let none = (0.0, Vector3::zeros());
        ([(-off, up), (radius - distance, out), none], [off_plane, off_circle, [0.0; WIDTH]])
    }

    /// The direction of the object from where the beam begins against the beam, which ends as far away, on the tangent plane of the
    /// first.
    fn beam(&self, object: &Object, own: [f64; OF_OBJECT], p: &Vector3<f64>, beam: &Vector3<f64>) -> Seen {
        let there = self.pose.back(&(object.place + Vector3::new(own[0], own[1], own[2])));
        let from = there - (p - beam);
        let distance = from.norm();
        let direction = from / distance;
        let mut axes = tangent_frame(&direction);
        let mut components = residual::on_tangent_plane(&direction, beam);
        let mut arm = there;
        if self.by == TurnsBy::Prediction {
            // Along the beam nothing is determined: an eye that moves away from all that it sees makes every residual small, by a share of
            // itself.
            (arm, axes) = (*p, tangent_frame(&beam.normalize()));
            components.iter_mut().zip(axes).for_each(|(own, axis)| own.1 = axis / beam.norm());
        }
        let row = |axis: Vector3<f64>| {
            let outside = self.pose.turn * axis / distance;
            self.row([-outside.x, -outside.y, -outside.z], outside, arm.cross(&axis) / distance)
        };
        (components, [row(axes[0]), row(axes[1]), [0.0; WIDTH]])
    }

    /// The direction of the object from the station against the beam, on the tangent plane of the first.
    fn sight(&self, object: &Object, own: [f64; OF_OBJECT], beam: &Vector3<f64>) -> Seen {
        let there = self.pose.back(&(object.place + Vector3::new(own[0], own[1], own[2])));
        let distance = there.norm();
        let direction = there / distance;
        let axes = tangent_frame(&direction);
        let components = residual::on_tangent_plane(&direction, beam);
        let arm = if self.by == TurnsBy::Prediction { beam.normalize() } else { direction };
        let row = |axis: Vector3<f64>| {
            let outside = self.pose.turn * axis / distance;
            self.row([-outside.x, -outside.y, -outside.z], outside, arm.cross(&axis))
        };
        (components, [row(axes[0]), row(axes[1]), [0.0; WIDTH]])
    }
}

/// A row of one component.
fn one(component: (f64, Vector3<f64>), row: [f64; WIDTH]) -> Seen {
    let none = (0.0, Vector3::zeros());
    ([component, none, none], [row, [0.0; WIDTH], [0.0; WIDTH]])
}

#[cfg(test)]
mod tests;
