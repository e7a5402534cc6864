//! How the residual components of observations lie in one long column.

use crate::data::Observations;

/// Rows that follow each other: components `start..end`, `stride` components a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// First component.
    pub start: usize,
    /// One past the last component.
    pub end: usize,
    /// Components a row, at least one.
    pub stride: usize,
}

/// Which row and which kind each residual component belongs to.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The row of each component.
    pub row: Vec<u32>,
    /// The kind of each component: series by series, component by component.
    pub kind: Vec<u16>,
    /// The number of kinds.
    pub kinds: usize,
    /// Where the components of each row start; one more at the end.
    pub first: Vec<usize>,
    /// One run a series.
    pub runs: Vec<Run>,
}

impl Layout {
    /// The layout of these observations.
    #[must_use]
    pub fn of(observations: &Observations) -> Self {
        let mut layout =
            Self { row: Vec::new(), kind: Vec::new(), kinds: 0, first: vec![0], runs: Vec::new() };
        for series in &observations.poses.series {
            let stride = series.measure.components();
            let start = layout.row.len();
            for row in series.rows.clone() {
                for component in 0..stride {
                    layout.row.push(row as u32);
                    layout.kind.push((layout.kinds + component) as u16);
                }
                layout.first.push(layout.row.len());
            }
            layout.kinds += stride;
            layout.runs.push(Run { start, end: layout.row.len(), stride });
        }
        layout
    }

    /// The number of components.
    #[must_use]
    pub fn components(&self) -> usize {
        self.row.len()
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.first.len() - 1
    }

    /// The components of each row, row by row.
    pub fn by_row<'a>(&'a self, column: &'a [f64]) -> impl Iterator<Item = &'a [f64]> {
        self.first.windows(2).map(|ends| &column[ends[0]..ends[1]])
    }

    /// The length of each row's components.
    pub fn norms<'a>(&'a self, column: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.by_row(column).map(|row| row.iter().map(|value| value * value).sum::<f64>().sqrt())
    }
}
