//! Residual components of some rows and their derivatives, as the fit's sums take them.

use codegen::vector::{self, Arithmetic};

use observe::unknowns::WIDTH;

/// Residuals of some rows of one series, before whitening. Arrays hold all rows of the first component, then all of the
/// second.
#[derive(Debug, Clone, Default)]
pub struct Block {
    /// Rows.
    pub rows: usize,
    /// Components a row.
    pub components: usize,
    /// Measured minus predicted, rad or m; 0 where the chain has no finite value.
    pub residual: Vec<f64>,
    /// Per row, whether the chain has a finite value there.
    pub defined: Vec<bool>,
    /// Derivatives of the predicted components, column by column.
    pub(super) jacobian: Vec<f64>,
    /// Gradient of each predicted component by x, y, z of the observable, or of each of the body's axes: an array of rows for
    /// each of the three, or nine.
    pub(super) gradient: Vec<f64>,
    /// Per row and component the derivatives of what is predicted by what is unknown of object and station, row by row;
    /// empty where nothing is.
    pub unknown: Vec<[f64; WIDTH]>,
    /// What the program puts out.
    pub(super) outputs: Vec<f64>,
}

impl Block {
    /// The derivatives of the predicted components by the parameters of each column, in order.
    pub fn columns(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.jacobian.chunks_exact(self.residual.len().max(1))
    }

    /// An array of this block row by row, component by component.
    pub fn by_row(&self, values: &[f64]) -> Vec<f64> {
        let mut by_row = vec![0.0; values.len()];
        if self.rows > 0 {
            for (component, values) in values.chunks_exact(self.rows).enumerate() {
                let places = by_row[component..].iter_mut().step_by(self.components);
                places.zip(values).for_each(|(to, from)| *to = *from);
            }
        }
        by_row
    }

    /// Turns the derivatives that the program has put out into those of the components.
    pub(super) fn project(&mut self) {
        vector::run(vector::path(), Projection { block: self });
    }
}

/// Turns derivatives of x, y, z into those of the components.
struct Projection<'a> {
    block: &'a mut Block,
}

impl vector::Work for Projection<'_> {
    #[inline(always)]
    fn run<A: Arithmetic>(self, _: A) {
        let Block { rows, components, jacobian, gradient, outputs, .. } = self.block;
        let (rows, m) = (*rows, *components);
        if rows == 0 || m == 0 {
            return;
        }
        let columns = jacobian.len() / (m * rows);
        let vectors = gradient.len() / (3 * m * rows);
        let derivatives = &outputs[3 * vectors * rows..];
        for (column, target) in jacobian.chunks_exact_mut(m * rows).enumerate() {
            let along = |place: usize| &derivatives[(place * columns + column) * rows..][..rows];
            let gradients = gradient.chunks_exact(3 * vectors * rows);
            for (target, gradient) in target.chunks_exact_mut(rows).zip(gradients) {
                for (vector, gradient) in gradient.chunks_exact(3 * rows).enumerate() {
                    let (dx, dy, dz) = (along(3 * vector), along(3 * vector + 1), along(3 * vector + 2));
                    let (gx, gy, gz) = (&gradient[..rows], &gradient[rows..2 * rows], &gradient[2 * rows..]);
                    let is_last = vector + 1 == vectors;
                    for row in 0..rows {
                        let own = gx[row] * dx[row] + gy[row] * dy[row] + gz[row] * dz[row];
                        let change = if vector == 0 { own } else { target[row] + own };
                        target[row] = if is_last && !change.is_finite() { 0.0 } else { change };
                    }
                }
            }
        }
    }
}
