//! Where levelled stations stood: upright, so that two targets say it.

use nalgebra::Vector3;

use super::solved::{FLAT, is_in_a_line};
use fit::{align_robustly, robust};
use observe::unknowns::Pose;

/// The upright pose that brings points onto others; none where they are all above each other, or one.
pub(super) fn upright(from: &[Vector3<f64>], to: &[Vector3<f64>]) -> Option<Pose> {
    if are_above_each_other(from) {
        return None;
    }
    let whole = align_robustly(from, to).filter(|_| !is_in_a_line(from));
    let heading = whole.map_or_else(
        || {
            let (start, end) = (middle(from), middle(to));
            let pairs = from.iter().zip(to).map(|(from, to)| (from - start, to - end));
            let (sine, cosine) = pairs.fold((0.0, 0.0), |(sine, cosine), (from, to)| {
                (sine + from.x * to.y - from.y * to.x, cosine + from.x * to.x + from.y * to.y)
            });
            sine.atan2(cosine)
        },
        |(turn, _)| turn[(1, 0)].atan2(turn[(0, 0)]),
    );
    let turned = Pose::new(Vector3::zeros(), 0.0, 0.0, heading);
    let shifts: Vec<Vector3<f64>> = from.iter().zip(to).map(|(from, to)| to - turned.apply(from)).collect();
    let usual = |axis: usize| robust::median(shifts.iter().map(|shift| shift[axis]).collect());
    Some(Pose { shift: Vector3::new(usual(0), usual(1), usual(2)), ..turned })
}

/// Whether points leave a heading open.
pub(super) fn are_above_each_other(points: &[Vector3<f64>]) -> bool {
    let centre = middle(points);
    let aside = points.iter().map(|point| (point - centre).xy().norm_squared()).sum::<f64>();
    let all = points.iter().map(|point| point.norm_squared()).sum::<f64>();
    aside <= FLAT * FLAT * all
}

fn middle(points: &[Vector3<f64>]) -> Vector3<f64> {
    points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn two_points_say_where_a_levelled_station_stood() {
        let pose = Pose::new(Vector3::new(3.0, -2.0, 1.5), 0.0, 0.0, 2.5);
        let from = [Vector3::new(4.0, 1.0, 0.3), Vector3::new(-2.0, 5.0, 1.0), Vector3::new(4.0, 1.0, 9.0)];
        let to = from.map(|point| pose.apply(&point));
        let found = upright(&from[..2], &to[..2]).unwrap();
        assert!((found.turn.angle_to(&pose.turn) + (found.shift - pose.shift).norm()) < 1e-12, "{found:?}");
        assert!(upright(&from[..1], &to[..1]).is_none());
        assert!(upright(&[from[0], from[2]], &[to[0], to[2]]).is_none());
    }
}
