//! What single components of rows tell, whitened: of the errors, of their object and of their station.

use fit::noise::Layout;
use fit::{FitError, Model};
use observe::Observations;
use observe::unknowns::WIDTH;

/// One component.
pub(super) struct Seen {
    pub row: usize,
    /// Derivatives by what is unknown of object and station.
    pub unknown: [f64; WIDTH],
    /// Derivatives by the errors, in the order of the parameters.
    pub errors: Vec<f64>,
}

impl Seen {
    /// Of all rows that count; `root` is what each component is multiplied by.
    pub fn of(
        model: &Model,
        observations: &Observations,
        layout: &Layout,
        values: &[f64],
        root: &[f64],
    ) -> Result<Vec<Self>, FitError> {
        let blocks = model.map_blocks(observations, values, |_, rows, block| {
            let columns: Vec<&[f64]> = block.columns().collect();
            let mut seen = Vec::new();
            for row in (0..block.rows).filter(|&row| block.defined[row]) {
                for component in 0..block.components {
                    let (at, own) = (component * block.rows + row, row * block.components + component);
                    let root = root[layout.first(rows.start + row) + component];
                    if root == 0.0 {
                        continue;
                    }
                    let by = |column: &Option<usize>| column.map_or(0.0, |column| columns[column][at] * root);
                    seen.push(Self {
                        row: rows.start + row,
                        unknown: block.unknown[own].map(|value| value * root),
                        errors: model.column_of().iter().map(by).collect(),
                    });
                }
            }
            seen
        })?;
        Ok(blocks.into_iter().flatten().collect())
    }
}
