//! A unit vector, and the ways to write one: by components, by two angles, by its offset from what the chain shows.

use std::f64::consts::{FRAC_PI_2, PI};

use codegen::vector::{self, Arithmetic};
use model_core::Quantity;
use nalgebra::Vector3;

use super::azimuth;
use super::compare::{Compared, Mismatch, Rows};
use super::kind::{ANGLES, Kind, Map, Scale, SpaceAxes};
use super::tangent_plane::on_tangent_plane;
use super::written::{Cells, Filled, Key, Observes, OfReadings, Shows, UNIT_TOLERANCE, Written};
use super::{Measure, Measured};
use crate::{direction_from_offset, offset_of_direction, tangent_frame};

pub(super) const KIND: Kind = Kind {
    scale: |_| Scale::Unseen,
    tells_far_off: true,
    space_axes: Some(SpaceAxes { turn: true, of: axes }),
    map: Some(Map {
        title: "Over the sky",
        labels: ["azimuth, °", "elevation, °"],
        place: |measured| match measured {
            Measured::Direction(u) => {
                Some((u.x.atan2(u.y) * 180.0 / PI, u.z.clamp(-1.0, 1.0).asin() * 180.0 / PI))
            }
            _ => None,
        },
    }),
    ..Kind::new(&["across", "along"], ANGLES, Measure::Direction, &[DIRECTION, SPHERICAL, OFFSET], compare)
};

const DIRECTION: Written = Written {
    name: "direction",
    of: Observes::Direction,
    quantity: Quantity::Number,
    columns: &[&[Key::new("x"), Key::new("y"), Key::new("z")]],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: |cells| {
        let vector = Vector3::new(cells.at(0), cells.at(1), cells.at(2));
        let length = vector.norm();
        if (length - 1.0).abs() > UNIT_TOLERANCE {
            return Err(format!(
                "x, y, z is no unit vector: divide its components by their length, {length:.6}"
            ));
        }
        Ok(Measured::Direction(vector / length))
    },
    filled: Filled::with(|shows| shows.vector().normalize().into()),
};

const SPHERICAL: Written = Written {
    name: "spherical",
    of: Observes::Direction,
    quantity: Quantity::Angle,
    columns: &[
        &[
            Key { name: "ha", headers: &["ha", "hourangle"] },
            Key { name: "dec", headers: &["dec", "declination", "decl"] },
        ],
        &[
            Key { name: "azimuth", headers: &["azimuth", "az", "azi", "azm"] },
            Key { name: "elevation", headers: &["elevation", "el", "elev", "altitude", "alt"] },
        ],
    ],
    of_readings: OfReadings::TwoAngles,
    is_meant: |asked| !azimuth::is_alone(asked),
    read: spherical,
    filled: Some(azimuth::ROUND),
};

const OFFSET: Written = Written {
    name: "offset",
    of: Observes::Direction,
    quantity: Quantity::Angle,
    columns: &[&[
        Key { name: "cross", headers: &["cross", "across", "xel", "xdec"] },
        Key {
            name: "along",
            headers: &["along", "elevation", "el", "alt", "altitude", "dec", "declination"],
        },
    ]],
    of_readings: OfReadings::Nothing,
    is_meant: |_| true,
    read: |cells| {
        let nominal = cells.nominal().normalize();
        if !nominal.iter().all(|component| component.is_finite()) {
            return Err("the chain has no direction at these readings".to_owned());
        }
        Ok(Measured::Direction(direction_from_offset(&nominal, cells.at(0), cells.at(1))))
    },
    filled: Some(Filled { of: offset, beside_nominal: true, turns: false }),
};

/// The offset of what is shown from what is shown without errors.
fn offset(shows: &dyn Shows) -> [f64; 3] {
    let [across_rad, along_rad] = offset_of_direction(&shows.nominal().normalize(), &shows.vector());
    [across_rad, along_rad, 0.0]
}

fn spherical(cells: &mut dyn Cells) -> Result<Measured, String> {
    let (direction, elevation) = cells.direction(cells.at(0), cells.at(1));
    if elevation.abs() > FRAC_PI_2 * (1.0 + 1e-9) {
        return Err(format!(
            "an elevation of {:.1} deg is beyond the zenith: are the unit and the order of the columns right?",
            elevation.to_degrees()
        ));
    }
    Ok(Measured::Direction(direction))
}

/// Across and along, as they lie in space.
fn axes(measured: &Measured) -> [[f64; 3]; 3] {
    match measured {
        Measured::Direction(direction) => {
            let [across, along] = tangent_frame(direction);
            [across.into(), along.into(), [0.0; 3]]
        }
        _ => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    }
}

/// Many rows at once; those more than 90° off one by one.
fn compare(rows: &Rows<'_>, to: &mut Compared<'_>) -> Result<(), Mismatch> {
    let count = rows.count;
    let predicted = [0, 1, 2].map(|axis| &rows.predicted[axis * count..][..count]);
    let mut directions = vec![0.0; 3 * count];
    for row in 0..count {
        let direction = match rows.measured.map(|measured| &measured[row]) {
            None => rows.at(row).normalize(),
            Some(Measured::Direction(direction)) => *direction,
            Some(_) => return Err(Mismatch { row }),
        };
        (0..3).for_each(|axis| directions[axis * count + row] = direction[axis]);
    }
    let measured = [0, 1, 2].map(|axis| &directions[axis * count..][..count]);
    let mut facing = vec![0.0; count];
    let (residual, gradient) = (&mut *to.residual, &mut *to.gradient);
    vector::run(
        vector::path(),
        TangentPlanes { measured, predicted, residual, gradient, facing: &mut facing },
    );
    for row in (0..count).filter(|&row| facing[row] < 0.0) {
        let direction = Vector3::new(measured[0][row], measured[1][row], measured[2][row]);
        for (component, (left, slope)) in on_tangent_plane(&direction, &rows.at(row)).iter().enumerate() {
            to.residual[component * count + row] = *left;
            (0..3).for_each(|axis| to.gradient[(3 * component + axis) * count + row] = slope[axis]);
        }
    }
    for row in 0..count {
        let is_defined = to.residual[row].is_finite() && to.residual[count + row].is_finite();
        to.defined.push(is_defined);
        if !is_defined {
            (to.residual[row], to.residual[count + row]) = (0.0, 0.0);
        }
    }
    rows.nothing_unknown::<2>(to);
    Ok(())
}

/// What [`on_tangent_plane`] makes of rows less than 90° off, and the cosine of that angle.
struct TangentPlanes<'a> {
    measured: [&'a [f64]; 3],
    predicted: [&'a [f64]; 3],
    residual: &'a mut [f64],
    gradient: &'a mut [f64],
    facing: &'a mut [f64],
}

impl vector::Work for TangentPlanes<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, _: A) {
        let count = self.facing.len();
        let [x, y, z] = self.measured.map(|axis| &axis[..count]);
        let [px, py, pz] = self.predicted.map(|axis| &axis[..count]);
        let (across, along) = self.residual.split_at_mut(count);
        let along = &mut along[..count];
        let facing = self.facing;
        let (of_across, of_along) = self.gradient.split_at_mut(3 * count);
        let (ax, rest) = of_across.split_at_mut(count);
        let (ay, az) = rest.split_at_mut(count);
        let (lx, rest) = of_along.split_at_mut(count);
        let (ly, lz) = rest.split_at_mut(count);
        let lz = &mut lz[..count];
        for row in 0..count {
            // Rotations keep the length, which is divided out.
            let length = (px[row] * px[row] + py[row] * py[row] + pz[row] * pz[row]).sqrt();
            let horizontal = (x[row] * x[row] + y[row] * y[row]).sqrt();
            let is_off_axis = horizontal > 0.0;
            let sin = if is_off_axis { x[row] / horizontal } else { 0.0 };
            let cos = if is_off_axis { y[row] / horizontal } else { 1.0 };
            let (up_x, up_y) = (-sin * z[row], -cos * z[row]);
            across[row] = -(cos * px[row] - sin * py[row]) / length;
            along[row] = -(up_x * px[row] + up_y * py[row] + horizontal * pz[row]) / length;
            (ax[row], ay[row], az[row]) = (cos / length, -sin / length, 0.0);
            (lx[row], ly[row], lz[row]) = (up_x / length, up_y / length, horizontal / length);
            facing[row] = x[row] * px[row] + y[row] * py[row] + z[row] * pz[row];
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Near, on the axis, more than 90° off, opposite, and nowhere: as each row alone.
    #[test]
    fn many_rows_are_as_each_alone() {
        let unit = |x: f64, y: f64, z: f64| Vector3::new(x, y, z).normalize();
        let pairs = [
            (unit(0.3, -0.4, 0.5), unit(0.31, -0.39, 0.52) * 2.0),
            (Vector3::z(), unit(1e-6, 0.0, 1.0)),
            (unit(1.0, 2.0, 3.0), unit(-1.0, 0.1, 0.2)),
            (Vector3::x(), -Vector3::x()),
            (Vector3::y(), Vector3::repeat(f64::NAN)),
        ];
        let count = pairs.len();
        let predicted: Vec<f64> =
            (0..3).flat_map(|axis| pairs.iter().map(move |pair| pair.1[axis])).collect();
        let measured: Vec<Measured> = pairs.iter().map(|pair| Measured::Direction(pair.0)).collect();
        let (mut residual, mut gradient) = (vec![9.0; 2 * count], vec![9.0; 6 * count]);
        let (mut defined, mut unknown) = (Vec::new(), Vec::new());
        let mut compared = |measured: &[Measured]| {
            let rows =
                Rows { count, predicted: &predicted, measured: Some(measured), unknown: None, beams: None };
            let (residual, gradient) = (&mut residual[..], &mut gradient[..]);
            compare(&rows, &mut Compared { residual, defined: &mut defined, gradient, unknown: &mut unknown })
        };
        compared(&measured).unwrap();
        assert_eq!(compared(&[Measured::Readings; 5]), Err(Mismatch { row: 0 }));
        assert_eq!(defined, [true, true, true, true, false]);
        for (row, (direction, predicted)) in pairs.iter().enumerate().take(4) {
            for (component, (left, slope)) in on_tangent_plane(direction, predicted).iter().enumerate() {
                assert!((residual[component * count + row] - left).abs() < 1e-15, "{row} {component}");
                for axis in 0..3 {
                    let own = gradient[(3 * component + axis) * count + row];
                    assert!((own - slope[axis]).abs() < 1e-15, "{row} {component} {axis}");
                }
            }
        }
        assert_eq!([residual[4], residual[9]], [0.0, 0.0]);
        assert!(unknown.is_empty());
    }
}
