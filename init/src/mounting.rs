//! How a scanner sits on a vehicle, by right angles: that way in which the points of every plane lie flattest.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Rotation3, SymmetricEigen, Vector3};
use tables::trajectory::turned;

/// Ways that are so much less flat than the flattest might be meant as well.
const AS_FLAT: f64 = 1.5;
/// Points that a plane is seen by.
const LEAST: usize = 4;

/// How a scanner's axes lie in a vehicle's.
pub struct Mounting {
    /// As a declaration writes it; nothing where they are the same.
    pub factors: String,
    /// Whether the scanner's first angle counts the other way.
    pub is_reversed: bool,
    /// What the user should know of it.
    pub said: String,
}

/// One way to sit.
struct Way {
    factors: Vec<&'static str>,
    turn: Rotation3<f64>,
    is_reversed: bool,
}

/// The way in which the rows' points, in the scanner's frame, are flattest on the planes that labels name; `pose` is east, north, up,
/// heading, pitch and roll of each row.
///
/// # Errors
/// No plane has enough points.
pub fn mounting(
    pose: &[&[f64]],
    points: &[[f64; 3]],
    may_be_reversed: bool,
    labels: &[u32],
) -> Result<Mounting, String> {
    let at = |column: usize, row: usize| {
        pose.get(column).and_then(|own| own.get(row)).copied().unwrap_or(f64::NAN)
    };
    let vehicles: Vec<(Vector3<f64>, Rotation3<f64>)> = (0..points.len())
        .map(|row| {
            (Vector3::new(at(0, row), at(1, row), at(2, row)), turned(at(3, row), at(4, row), at(5, row)))
        })
        .collect();
    let planes = labels.iter().max().map_or(0, |most| *most as usize + 1);
    let flatness = |way: &Way| {
        let mut hits = vec![Vec::new(); planes];
        for ((point, (place, turn)), label) in points.iter().zip(&vehicles).zip(labels) {
            // The first angle turns about z from y: counted the other way, x changes its sign.
            let x = if way.is_reversed { -point[0] } else { point[0] };
            hits[*label as usize].push(place + turn * (way.turn * Vector3::new(x, point[1], point[2])));
        }
        let (mut sum, mut count) = (0.0, 0);
        for own in hits.iter().filter(|own| own.len() >= LEAST) {
            sum += off_plane(own);
            count += own.len();
        }
        (sum / count as f64).sqrt()
    };
    let mut ways: Vec<(f64, Way)> =
        ways(may_be_reversed).into_iter().map(|way| (flatness(&way), way)).collect();
    ways.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let mut ways = ways.into_iter();
    let Some((flattest, way)) = ways.next().filter(|(flattest, _)| flattest.is_finite()) else {
        return Err(format!(
            "no plane was hit by {LEAST} rows: label the points of a few walls, roads or roofs"
        ));
    };
    let alike = ways.take_while(|(other, _)| *other < AS_FLAT * flattest).count();
    let factors = way.factors.join(", ");
    let sits = match factors.as_str() {
        "" => "The scanner's axes are those of the vehicle: right, forward, up.".to_owned(),
        own => format!(
            "The scanner's axes are turned by {own} against those of the vehicle (right, forward, up)."
        ),
    };
    let shown = match alike {
        0 => format!(
            "The rows show it. With this turn the points are within {flattest:.3} m of planes (RMS), before any error is estimated."
        ),
        more => format!(
            "The rows do not show it alone: {more} other turns by right angles are as good. Correct `position` of `scanner` in the declaration, or \
             take rows of a drive with turns."
        ),
    };
    Ok(Mounting { factors, is_reversed: way.is_reversed, said: format!("{sits} {shown}") })
}

/// The sum of squares of what some points are off their plane.
fn off_plane(points: &[Vector3<f64>]) -> f64 {
    let centre = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    let scatter =
        points.iter().map(|point| (point - centre) * (point - centre).transpose()).sum::<Matrix3<f64>>();
    SymmetricEigen::new(scatter).eigenvalues.min().max(0.0)
}

/// Every way in which axes lie along axes, the plainest first.
fn ways(may_be_reversed: bool) -> Vec<Way> {
    let about_z = [(0, None), (1, Some("Rz(pi/2)")), (2, Some("Rz(pi)")), (3, Some("Rz(-pi/2)"))];
    let then = [
        (Vector3::x_axis(), 0, None),
        (Vector3::x_axis(), 1, Some("Rx(pi/2)")),
        (Vector3::x_axis(), 2, Some("Rx(pi)")),
        (Vector3::x_axis(), 3, Some("Rx(-pi/2)")),
        (Vector3::y_axis(), 1, Some("Ry(pi/2)")),
        (Vector3::y_axis(), 3, Some("Ry(-pi/2)")),
    ];
    let quarter = |turns: i32| f64::from(turns) * FRAC_PI_2;
    let senses = if may_be_reversed { &[false, true][..] } else { &[false] };
    let mut ways = Vec::new();
    for &is_reversed in senses {
        for (axis, second, second_text) in then {
            for (first, first_text) in about_z {
                let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), quarter(first))
                    * Rotation3::from_axis_angle(&axis, quarter(second));
                let factors = first_text.into_iter().chain(second_text).collect();
                ways.push(Way { factors, turn, is_reversed });
            }
        }
    }
    ways
}
