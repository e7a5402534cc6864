//! The rows of one station are in another unit than those of the others.

use std::ops::Range;

use model_core::Quantity;

use super::{Hypothesis, Reading, Tried, unit};
use crate::misread::policy::FROM_ROW_PRICE;
use study::{Changed, SampledColumn};

/// Stations that are tried one by one at most. It bounds work.
const STATIONS: usize = 12;

pub(super) fn tried(tried: &Tried<'_>) -> Vec<Hypothesis> {
    let Some(unknowns) = &tried.rows.unknowns else { return Vec::new() };
    let angles: Vec<&SampledColumn> =
        tried.joints.iter().copied().filter(|column| column.quantity == Quantity::Angle).collect();
    let ranges = tried.ranges.iter().map(|range| vec![*range]);
    let sets: Vec<Vec<&SampledColumn>> = std::iter::once(angles).chain(ranges).collect();
    let whole: Vec<Hypothesis> = sets.iter().flat_map(|set| unit::of_set(tried, set)).collect();
    let labelled = unknowns.stations.iter().enumerate().filter(|(_, own)| !own.label.is_empty());
    let mut all = Vec::new();
    for (at, station) in labelled.take(STATIONS) {
        let is_own = |row: usize| unknowns.station.get(row).is_some_and(|own| *own as usize == at);
        if (0..tried.rows.rows()).all(is_own) {
            continue;
        }
        let series = tried.rows.poses.series.iter().enumerate();
        let runs: Vec<(usize, Range<usize>)> = series
            .flat_map(|(source, series)| {
                runs(series.rows.clone(), is_own).into_iter().map(move |run| (source, run))
            })
            .collect();
        all.extend(whole.iter().map(|own| of_rows(own, &station.label, &runs)));
    }
    all
}

fn of_rows(whole: &Hypothesis, station: &str, runs: &[(usize, Range<usize>)]) -> Hypothesis {
    let of_change = |own: &Changed| {
        let (place, change) = (own.place, own.change);
        let of_source = runs.iter().filter(move |(source, _)| *source == place.source);
        of_source.map(move |(_, rows)| Changed { place, change, rows: rows.clone() })
    };
    let changes = whole.changes.iter().flat_map(of_change).collect();
    let reading =
        Reading::OfStation { reading: Box::new(whole.reading.clone()), station: station.to_owned() };
    Hypothesis::new(reading, changes, Vec::new(), whole.price + FROM_ROW_PRICE)
}

/// The runs of rows that are so, counted from the first of the series.
fn runs(rows: Range<usize>, is: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for row in rows.clone().filter(|row| is(*row)).map(|row| row - rows.start) {
        match runs.last_mut() {
            Some(run) if run.end == row => run.end += 1,
            _ => runs.push(row..row + 1),
        }
    }
    runs
}
