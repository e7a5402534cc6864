//! How the residual components of observations lie in one long column.

use std::ops::Range;

use observe::Observations;

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

/// Which row and which kind each residual component belongs to: series by series, row by row, component by component.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// The number of kinds.
    pub kinds: usize,
    /// One run a series.
    pub runs: Vec<Run>,
    /// The rows of each series.
    rows: Vec<Range<usize>>,
}

impl Layout {
    /// The layout of these observations.
    #[must_use]
    pub fn of(observations: &Observations) -> Self {
        let mut layout = Self { kinds: 0, runs: Vec::new(), rows: Vec::new() };
        for series in &observations.poses.series {
            let (stride, start) = (series.measure.components(), layout.components());
            layout.runs.push(Run { start, end: start + stride * series.rows.len(), stride });
            layout.rows.push(series.rows.clone());
            layout.kinds += stride;
        }
        layout
    }

    /// The number of components.
    #[must_use]
    pub fn components(&self) -> usize {
        self.runs.last().map_or(0, |run| run.end)
    }

    /// The number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.rows.last().map_or(0, |rows| rows.end)
    }

    /// The row of a component.
    #[must_use]
    pub fn row(&self, component: usize) -> usize {
        let series = self.runs.partition_point(|run| run.end <= component);
        let run = self.runs[series];
        self.rows[series].start + (component - run.start) / run.stride
    }

    /// The kind of a component: series by series, component by component.
    #[must_use]
    pub fn kind(&self, component: usize) -> usize {
        let series = self.runs.partition_point(|run| run.end <= component);
        let run = self.runs[series];
        let before: usize = self.runs[..series].iter().map(|run| run.stride).sum();
        before + (component - run.start) % run.stride
    }

    /// The components of some rows that follow each other.
    #[must_use]
    pub fn of_rows(&self, rows: Range<usize>) -> Range<usize> {
        self.first(rows.start)..self.first(rows.end)
    }

    /// Where the components of a row start; behind the last row, where they end.
    #[must_use]
    pub fn first(&self, row: usize) -> usize {
        let series = self.rows.partition_point(|rows| rows.end <= row);
        let Some(run) = self.runs.get(series) else { return self.components() };
        run.start + (row - self.rows[series].start) * run.stride
    }

    /// The row of each component, in order.
    pub fn row_of_each(&self) -> impl Iterator<Item = usize> {
        let series = self.rows.iter().zip(&self.runs);
        series.flat_map(|(rows, run)| rows.clone().flat_map(move |row| std::iter::repeat_n(row, run.stride)))
    }

    /// The kind of each component, in order.
    pub fn kind_of_each(&self) -> impl Iterator<Item = usize> {
        let mut next = 0;
        let series = self.rows.iter().zip(&self.runs).map(move |(rows, run)| {
            next += run.stride;
            (rows, next - run.stride..next)
        });
        series.flat_map(|(rows, kinds)| rows.clone().flat_map(move |_| kinds.clone()))
    }

    /// The components of each row, row by row.
    pub fn by_row<'a>(&'a self, column: &'a [f64]) -> impl Iterator<Item = &'a [f64]> {
        self.runs.iter().flat_map(move |run| column[run.start..run.end].chunks_exact(run.stride))
    }

    /// The length of each row's components.
    pub fn norms<'a>(&'a self, column: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        self.by_row(column).map(|row| row.iter().map(|value| value * value).sum::<f64>().sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model_core::Chain;
    use observe::{Measure, Poses, Series};

    #[test]
    fn rows_and_kinds_of_components_are_those_of_their_series() {
        let chain = Chain::from_text(include_str!("../../../examples/alt-azimuth/alt-azimuth.chain"));
        let Some(observable) = chain.ok().and_then(|chain| chain.find_observable("sight")) else {
            unreachable!("the example has a sight")
        };
        let series = |measure, rows| Series { observable, measure, rows, source: String::new() };
        let series = vec![
            series(Measure::Direction, 0..2),
            series(Measure::Point, 2..2),
            series(Measure::Range, 2..5),
        ];
        let poses = Poses { series, columns: Vec::new() };
        let layout = Layout::of(&Observations { poses, ..Observations::default() });
        let (rows, kinds) = ([0, 0, 1, 1, 2, 3, 4], [0, 1, 0, 1, 5, 5, 5]);
        assert_eq!((layout.components(), layout.rows(), layout.kinds), (7, 5, 6));
        assert_eq!(layout.row_of_each().collect::<Vec<_>>(), rows);
        assert_eq!(layout.kind_of_each().collect::<Vec<_>>(), kinds);
        assert!((0..7).all(|at| (layout.row(at), layout.kind(at)) == (rows[at], kinds[at])));
        assert_eq!((0..=5).map(|row| layout.first(row)).collect::<Vec<_>>(), [0, 2, 4, 5, 6, 7]);
        assert_eq!(layout.of_rows(1..4), 2..6);
        let column = [3.0, 4.0, 0.0, 1.0, 7.0, 8.0, 9.0];
        assert_eq!(layout.norms(&column).collect::<Vec<_>>(), [5.0, 1.0, 7.0, 8.0, 9.0]);
    }
}
