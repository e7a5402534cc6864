//! Where a study asks to be told to measure next.

use std::ops::Range;

use model_core::{Chain, Quantity, SymbolId, SymbolKind};
use toml::Spanned;

use super::amount::{si, si_with_unit};
use super::mistakes::{Gathered, Outcome, every, mistake, unknown, within};
use super::written::{Kind, NextTable, Observed, Study};
use observe::Measure;
use tables::units::Amount;

/// Stations, or objects of one kind, that are proposed at most.
const MOST_PLACES: u64 = 20;

/// Rows of one addition at most.
const MOST_ROWS: u64 = 1000;

/// What a place can be bounded in.
const BOUNDS: [(&str, Quantity); 4] =
    [("x", Quantity::Length), ("y", Quantity::Length), ("z", Quantity::Length), ("heading", Quantity::Angle)];

/// How many poses to propose, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPoses {
    /// How many poses, or rows of each addition: as many as stations or objects have so far where the study does not say.
    pub count: Option<usize>,
    /// Between which values of a joint, or of a range that is measured, SI; those without stay within that of the data.
    pub ranges: Vec<(SymbolId, Range<f64>)>,
    /// What to add instead where rows observe objects from stations.
    pub places: Option<NextPlaces>,
}

/// How many stations and objects to propose, and where.
#[derive(Debug, Clone, PartialEq)]
pub struct NextPlaces {
    /// Places to stand.
    pub stations: usize,
    /// Objects of each kind.
    pub objects: Vec<NextObjects>,
    /// Between which x, y, z (m) and headings (rad).
    pub bounds: [Option<Range<f64>>; 4],
}

/// How many objects of a kind to propose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NextObjects {
    /// What its rows measure.
    pub measure: Measure,
    /// Whether they read a length.
    pub reads_length: bool,
    /// How many.
    pub count: usize,
}

impl Study {
    /// Where to propose to measure next.
    pub(super) fn next(&self, chain: &Chain) -> Outcome<Option<NextPoses>> {
        let Some(written) = &self.next else { return Ok(None) };
        let (next, place) = (written.get_ref(), written.span());
        let observed = std::iter::once(&self.observed).chain(self.also.iter().map(|also| &also.observed));
        let seen: Vec<Seen> = observed
            .filter_map(|observed| {
                let own = observed.get_ref();
                let Observed { kind, station, radius, length, .. } = own;
                let measure = kind.of_object(&|key| own.names(key))?;
                let reads_length = length.is_some() || radius.is_some();
                Some(Seen { kind: *kind, measure, reads_length, named: !station.0.is_empty() })
            })
            .collect();
        let of_objects = !seen.is_empty();
        let mut mistakes = Gathered::default();
        let most = if of_objects { MOST_ROWS } else { 10_000 };
        if let Some(poses) = &next.poses {
            mistakes.take(within(poses.span(), "poses", *poses.get_ref(), 1..=most));
        } else if !of_objects {
            mistakes.take::<()>(Err(mistake(place, "how many poses?", "write `poses = 12`")));
        }
        let is_joint =
            |kind: SymbolKind| kind == SymbolKind::Joint || (of_objects && kind == SymbolKind::Input);
        let symbols = || {
            let all = chain.symbols_of(SymbolKind::Joint).chain(chain.symbols_of(SymbolKind::Input));
            all.filter(|&id| is_joint(chain.symbol(id).kind))
        };
        let ranges = mistakes.take(every(next.range.iter().map(|(name, range)| {
            let id = symbols().find(|&id| chain.symbol(id).name == *name.get_ref()).ok_or_else(|| {
                let names: Vec<&str> = symbols().map(|id| chain.symbol(id).name.as_str()).collect();
                let what = if of_objects { "joint or range" } else { "joint" };
                unknown(name.span(), what, name.get_ref(), names.iter().copied())
            })?;
            let quantity = chain.symbol(id).quantity;
            Ok((id, ends(range, |end| si(end, quantity, &range.span()))?))
        })));
        let places = mistakes.take(next.places(&seen));
        mistakes.none()?;
        let count = next.poses.as_ref().and_then(|poses| usize::try_from(*poses.get_ref()).ok());
        let (Some(ranges), Some(places)) = (ranges, places) else {
            unreachable!("what is missing comes with a mistake")
        };
        Ok(Some(NextPoses { count, ranges, places }))
    }
}

/// What rows observe that is unknown.
struct Seen {
    kind: Kind,
    measure: Measure,
    reads_length: bool,
    /// Whether they name where from.
    named: bool,
}

impl Seen {
    /// So many more of them.
    fn asked(&self, count: usize) -> NextObjects {
        NextObjects { measure: self.measure, reads_length: self.reads_length, count }
    }
}

impl NextTable {
    /// The stations and objects that are asked for: one of each kind of the study where nothing is.
    fn places(&self, seen: &[Seen]) -> Outcome<Option<NextPlaces>> {
        if seen.is_empty() {
            let stations = self.stations.as_ref().map(|stations| ("stations", stations.span()));
            let first = |table: Option<Range<usize>>, key| table.map(|span| (key, span));
            let objects = first(self.objects.keys().next().map(Spanned::span), "objects");
            let place = first(self.place.keys().next().map(Spanned::span), "place");
            return match stations.or(objects).or(place) {
                None => Ok(None),
                Some((key, span)) => Err(mistake(
                    span,
                    format!("`{key}` is for a study whose rows observe objects"),
                    "leave it out: `poses` are proposed here",
                )),
            };
        }
        let mut mistakes = Gathered::default();
        let named = seen.iter().any(|own| own.named);
        let nothing_asked = self.stations.is_none() && self.objects.is_empty();
        let stations =
            self.stations.as_ref().map_or(u64::from(nothing_asked && named), |count| *count.get_ref());
        if let Some(written) = &self.stations {
            mistakes.take(within(written.span(), "stations", stations, 0..=MOST_PLACES));
            if stations > 0 && !named {
                let help = "write `station = \"…\"` under [observed]: the column that names where from, or ask for `objects`";
                mistakes.take::<()>(Err(mistake(
                    written.span(),
                    "no row of this study names a station",
                    help,
                )));
            }
        }
        let mut objects: Vec<NextObjects> = Vec::new();
        for own in seen.iter().filter(|_| nothing_asked).map(|seen| seen.asked(1)) {
            if !objects.contains(&own) {
                objects.push(own);
            }
        }
        let asked = mistakes.take(every(self.objects.iter().map(|(name, count)| {
            let own = seen.iter().find(|own| own.kind.name() == name.get_ref());
            let own = own.ok_or_else(|| {
                let names = seen.iter().map(|own| own.kind.name());
                unknown(name.span(), "kind of object of this study", name.get_ref(), names)
            })?;
            within(count.span(), "objects", *count.get_ref(), 0..=MOST_PLACES)?;
            Ok(own.asked(usize::try_from(*count.get_ref()).unwrap_or(usize::MAX)))
        })));
        let mut bounds: [Option<Range<f64>>; 4] = Default::default();
        for (name, range) in &self.place {
            let at = BOUNDS.iter().position(|(own, _)| own == name.get_ref());
            let Some(at) = at else {
                let names = BOUNDS.iter().map(|(name, _)| *name);
                mistakes.take::<()>(Err(unknown(
                    name.span(),
                    "coordinate of a place",
                    name.get_ref(),
                    names,
                )));
                continue;
            };
            let (name, quantity) = BOUNDS[at];
            bounds[at] = mistakes.take(ends(range, |end| si_with_unit(name, end, quantity, &range.span())));
        }
        mistakes.none()?;
        objects.extend(asked.into_iter().flatten());
        let stations = usize::try_from(stations).unwrap_or(usize::MAX);
        Ok(Some(NextPlaces { stations, objects, bounds }))
    }
}

/// The ends of a range, SI.
fn ends(range: &Spanned<[Amount; 2]>, si: impl Fn(&Amount) -> Outcome<f64>) -> Outcome<Range<f64>> {
    let [low, high] = range.get_ref();
    let (low, high) = (si(low)?, si(high)?);
    if low > high {
        return Err(mistake(range.span(), "the range ends before it starts", "swap the two"));
    }
    Ok(low..high)
}
