//! What the change of all values together does to what is observed, over the region that both calibrations measured.

use model_core::{Chain, SymbolId};
use nalgebra::{DMatrix, DVector};
use observe::{Poses, SiUnit};

use super::File;
use crate::Instrument;
use crate::errors_file::FoundOver;
use crate::instrument::errors_and_constants;
use crate::refusal::Refusal;
use crate::sensitivity::{OBSERVED, POSES, Watched, derivatives, without_errors};

/// The change of one observable.
#[derive(Debug, Clone, PartialEq)]
pub struct Observed {
    /// Its name.
    pub name: String,
    /// What is measured there: `rad` or `m`.
    pub unit: SiUnit,
    /// Root mean square of the change over the region, with its standard uncertainty.
    pub rms: [f64; 2],
    /// What the uncertainties alone make of that.
    pub expected_rms: f64,
    /// The largest change, with its standard uncertainty.
    pub largest: [f64; 2],
    /// Where that is, by names of joints and inputs, SI.
    pub at: Vec<(String, f64)>,
}

/// The ranges of readings that all files measured. An input or joint of which only some say where they measured counts with those.
pub(super) fn common_region(files: &[File<'_>]) -> Result<Vec<FoundOver>, Refusal> {
    let Some(last) = files.last() else { return Ok(Vec::new()) };
    let chain = &last.instrument.chain;
    let mut common: Vec<FoundOver> = Vec::new();
    for file in files {
        for range in &file.instrument.found {
            let name = &file.instrument.chain.symbol(range.symbol).name;
            let Some(symbol) = chain.find_symbol(name) else { continue };
            match common.iter_mut().find(|own| own.symbol == symbol) {
                Some(own) => (own.low, own.high) = (own.low.max(range.low), own.high.min(range.high)),
                None => common.push(FoundOver { symbol, ..*range }),
            }
        }
    }
    match common.iter().find(|range| range.low > range.high) {
        None => Ok(common),
        Some(range) => Err(Refusal::Input(format!(
            "the files have no common region: they measured different ranges of `{}`; measure the second time where the first time was",
            chain.symbol(range.symbol).name
        ))),
    }
}

/// What an instrument observes, each once.
pub(super) fn watched(instrument: &Instrument) -> Vec<Watched> {
    let mut all: Vec<Watched> = Vec::new();
    for source in instrument.headings.iter().flat_map(|headings| &headings.sources) {
        let own = Watched { observable: source.observable, measure: source.measure.bare() };
        if !all.contains(&own) {
            all.push(own);
        }
    }
    all
}

/// An error or constant in the first and in the last file.
struct Moved {
    in_first: Option<SymbolId>,
    in_last: Option<SymbolId>,
}

/// What the values of the first file and those of the last make different, at each observable.
pub(super) fn changes(files: [&File<'_>; 2], region: &[FoundOver]) -> Result<Vec<Observed>, Refusal> {
    let [first, last] = files.map(|file| file.instrument);
    let mut moved: Vec<Moved> = Vec::new();
    for symbol in errors_and_constants(&last.chain) {
        let in_first = first.chain.find_symbol(&last.chain.symbol(symbol).name);
        moved.push(Moved { in_first, in_last: Some(symbol) });
    }
    for symbol in errors_and_constants(&first.chain) {
        if last.chain.find_symbol(&first.chain.symbol(symbol).name).is_none() {
            moved.push(Moved { in_first: Some(symbol), in_last: None });
        }
    }
    let value =
        |instrument: &Instrument, id: Option<SymbolId>| id.map_or(0.0, |id| instrument.values[id.index()]);
    let change = DVector::from_iterator(
        moved.len(),
        moved.iter().map(|own| value(last, own.in_last) - value(first, own.in_first)),
    );
    let between = |instrument: &Instrument, one: Option<SymbolId>, other: Option<SymbolId>| {
        let covariance = instrument.covariance.as_ref();
        covariance.zip(one.zip(other)).map_or(0.0, |(own, (one, other))| own.between(one, other))
    };
    // As independent estimates.
    let covariance = DMatrix::from_fn(moved.len(), moved.len(), |a, b| {
        between(first, moved[a].in_first, moved[b].in_first)
            + between(last, moved[a].in_last, moved[b].in_last)
    });
    let mut all = Vec::new();
    for watched in watched(last) {
        let Some(headings) = &last.headings else { continue };
        let Some(poses) = watched.poses(&headings.chain, region, POSES) else { continue };
        let columns = columns([first, last], &moved, &poses)?;
        let components = watched.measure.components();
        let name = &last.chain.observable(watched.observable).name;
        let of = (name.as_str(), watched.measure.unit());
        all.push(change_of(of, &columns, (&change, &covariance), components, (&poses, &headings.chain)));
    }
    Ok(all)
}

/// Derivatives half way between the values of both files, where the difference of what is observed is, to second order, what they make of the
/// change of all values.
fn columns([first, last]: [&Instrument; 2], moved: &[Moved], poses: &Poses) -> Result<DMatrix<f64>, Refusal> {
    let mut all = DMatrix::zeros(poses.components(), moved.len());
    let mut of = |instrument: &Instrument, other: &Instrument, by: Vec<(usize, SymbolId)>, poses: &Poses| {
        let Some(headings) = &instrument.headings else { return Ok(()) };
        let mut values = headings.chain.nominal_values();
        for id in errors_and_constants(&instrument.chain) {
            let there = other.chain.find_symbol(&instrument.chain.symbol(id).name);
            let there = there.map_or(0.0, |there| other.values[there.index()]);
            values[id.index()] = 0.5 * (instrument.values[id.index()] + there);
        }
        let symbols: Vec<SymbolId> = by.iter().map(|(_, symbol)| *symbol).collect();
        let own = derivatives(&headings.chain, poses, &values, &symbols)?;
        for (from, (to, _)) in by.iter().enumerate() {
            all.set_column(*to, &own.column(from));
        }
        Ok::<(), Refusal>(())
    };
    let in_last = moved.iter().enumerate().filter_map(|(at, own)| Some((at, own.in_last?)));
    of(last, first, in_last.collect(), poses)?;
    let alone = moved.iter().enumerate().filter(|(_, own)| own.in_last.is_none());
    let alone: Vec<(usize, SymbolId)> = alone.filter_map(|(at, own)| Some((at, own.in_first?))).collect();
    if let (false, Some(headings)) = (alone.is_empty(), &first.headings)
        && let Some(poses) = there(poses, last, first, &headings.chain)
    {
        of(first, last, alone, &poses)?;
    }
    Ok(all)
}

/// The same poses by the symbols of the other file, if it has all.
fn there(poses: &Poses, from: &Instrument, to: &Instrument, chain: &Chain) -> Option<Poses> {
    let mut columns = Vec::new();
    for (symbol, column) in &poses.columns {
        columns
            .push((chain.find_symbol(&from.headings.as_ref()?.chain.symbol(*symbol).name)?, column.clone()));
    }
    columns.sort_by_key(|(symbol, _)| *symbol);
    let mut series = poses.series.clone();
    for own in &mut series {
        own.observable = to.chain.find_observable(&from.chain.observable(own.observable).name)?;
    }
    Some(Poses { series, columns })
}

fn change_of(
    (name, unit): (&str, SiUnit),
    columns: &DMatrix<f64>,
    (change, covariance): (&DVector<f64>, &DMatrix<f64>),
    components: usize,
    (poses, chain): (&Poses, &Chain),
) -> Observed {
    let moved = columns * change;
    let count = poses.rows() as f64;
    let rms = (moved.norm_squared() / count).sqrt();
    let variance = |direction: &DVector<f64>| {
        let along = columns.tr_mul(direction);
        (along.transpose() * covariance * &along)[(0, 0)].max(0.0)
    };
    let spread = columns * covariance;
    let squares: f64 = spread.iter().zip(columns.iter()).map(|(a, b)| a * b).sum();
    let expected_rms = (squares.max(0.0) / count).sqrt();
    let of_rms = if rms > 0.0 { (variance(&moved) / (count * rms).powi(2)).sqrt() } else { expected_rms };
    let length = |pose: usize| moved.rows(pose * components, components).norm();
    let far = (0..poses.rows()).max_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or(0);
    let mut there = DVector::zeros(moved.len());
    if length(far) > 0.0 {
        let own = moved.rows(far * components, components) / length(far);
        there.rows_mut(far * components, components).copy_from(&own);
    }
    let of_largest = if rms > 0.0 { variance(&there).sqrt() } else { expected_rms };
    let at = poses.columns.iter().map(|(id, column)| (chain.symbol(*id).name.clone(), column[far]));
    Observed {
        name: name.to_owned(),
        unit,
        rms: [rms, of_rms],
        expected_rms,
        largest: [length(far), of_largest],
        at: at.collect(),
    }
}

/// What is observed of some errors and constants over the region: a column for each combination that is, in units of the symbols; none where
/// nothing says where to look.
pub(super) fn combinations(
    instrument: &Instrument,
    symbols: &[SymbolId],
    region: &[FoundOver],
) -> Result<Option<DMatrix<f64>>, Refusal> {
    let Some(headings) = &instrument.headings else { return Ok(None) };
    let values = without_errors(&headings.chain, &instrument.values_in(&headings.chain));
    let mut parts: Vec<DMatrix<f64>> = Vec::new();
    for watched in watched(instrument) {
        let Some(poses) = watched.poses(&headings.chain, region, POSES) else { return Ok(None) };
        let own = derivatives(&headings.chain, &poses, &values, symbols)?;
        let largest = own.amax();
        parts.push(if largest > 0.0 { own / largest } else { own });
    }
    let rows = parts.iter().map(DMatrix::nrows).sum();
    if rows == 0 || symbols.is_empty() {
        return Ok(None);
    }
    let mut all = DMatrix::zeros(rows, symbols.len());
    let mut start = 0;
    for part in parts {
        all.rows_mut(start, part.nrows()).copy_from(&part);
        start += part.nrows();
    }
    let sizes: Vec<f64> = all.column_iter().map(|column| column.norm()).collect();
    for (mut column, size) in all.column_iter_mut().zip(&sizes) {
        if *size > 0.0 {
            column /= *size;
        }
    }
    let parts = all.svd(false, true);
    let Some(rows) = parts.v_t else { unreachable!("this factor was asked for") };
    let most = parts.singular_values.max();
    let seen: Vec<usize> =
        (0..rows.nrows()).filter(|at| parts.singular_values[*at] > OBSERVED * most).collect();
    // What is observed of a change of symbols is that of its parts times their sizes.
    Ok(Some(DMatrix::from_fn(symbols.len(), seen.len(), |symbol, at| {
        rows[(seen[at], symbol)] * sizes[symbol]
    })))
}
