//! Residuals of many measured directions at once, with their gradients.

use codegen::vector::{self, Arithmetic};
use nalgebra::Vector3;

use super::FitError;
use super::block::Block;
use super::residual::on_tangent_plane;
use observe::Measured;

impl Block {
    /// Residuals and gradients of rows that observe a direction, from what the program has put out; nothing is `measured` where
    /// poses alone are seen.
    pub(super) fn compare_directions(&mut self, measured: Option<&[Measured]>) -> Result<(), FitError> {
        let Self { rows, residual, defined, gradient, outputs, .. } = self;
        let count = *rows;
        let predicted: [&[f64]; 3] = [0, 1, 2].map(|axis| &outputs[axis * count..][..count]);
        let at = |row: usize| Vector3::new(predicted[0][row], predicted[1][row], predicted[2][row]);
        let mut directions = vec![0.0; 3 * count];
        for row in 0..count {
            let direction = match measured.map(|measured| &measured[row]) {
                None => at(row).normalize(),
                Some(Measured::Direction(direction)) => *direction,
                Some(_) => {
                    let why = "a row of directions measures something else".to_owned();
                    return Err(FitError::WrongShape { why });
                }
            };
            (0..3).for_each(|axis| directions[axis * count + row] = direction[axis]);
        }
        let measured = [0, 1, 2].map(|axis| &directions[axis * count..][..count]);
        let mut facing = vec![0.0; count];
        vector::run(
            vector::path(),
            TangentPlanes { measured, predicted, residual, gradient, facing: &mut facing },
        );
        for row in (0..count).filter(|&row| facing[row] < 0.0) {
            let direction = Vector3::new(measured[0][row], measured[1][row], measured[2][row]);
            for (component, (left, slope)) in
                on_tangent_plane(&direction, &at(row)).iter().take(2).enumerate()
            {
                residual[component * count + row] = *left;
                (0..3).for_each(|axis| gradient[(3 * component + axis) * count + row] = slope[axis]);
            }
        }
        for row in 0..count {
            let is_defined = residual[row].is_finite() && residual[count + row].is_finite();
            defined.push(is_defined);
            if !is_defined {
                (residual[row], residual[count + row]) = (0.0, 0.0);
            }
        }
        Ok(())
    }
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
        let outputs = (0..3).flat_map(|axis| pairs.iter().map(move |pair| pair.1[axis])).collect();
        let mut block = Block {
            rows: count,
            components: 2,
            residual: vec![9.0; 2 * count],
            gradient: vec![9.0; 6 * count],
            outputs,
            ..Block::default()
        };
        let measured: Vec<Measured> = pairs.iter().map(|pair| Measured::Direction(pair.0)).collect();
        block.compare_directions(Some(&measured)).unwrap();
        assert_eq!(block.defined, [true, true, true, true, false]);
        for (row, (direction, predicted)) in pairs.iter().enumerate().take(4) {
            for (component, (left, slope)) in
                on_tangent_plane(direction, predicted).iter().take(2).enumerate()
            {
                assert!((block.residual[component * count + row] - left).abs() < 1e-15, "{row} {component}");
                for axis in 0..3 {
                    let own = block.gradient[(3 * component + axis) * count + row];
                    assert!((own - slope[axis]).abs() < 1e-15, "{row} {component} {axis}");
                }
            }
        }
        assert_eq!([block.residual[4], block.residual[9]], [0.0, 0.0]);
        assert!(block.compare_directions(Some(&[Measured::Readings; 5])).is_err());
    }
}
