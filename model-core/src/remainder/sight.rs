//! What an observable sees over a domain, for bounds of its readings: the vector without errors as a canonical form, and bounds
//! on what the errors add to it.

use super::angles::Seen;
use super::cells;
use super::domain::{Domain, DomainError};
use super::interval::Interval;
use super::parameter::{Parameter, place};
use super::upper::Upper;
use super::vector::{self, Whole};
use crate::algebra::{Poly, Term};
use crate::chain::reading::{Measures, Reading};
use crate::chain::{Chain, ObservableId, ObservableKind, TransformKind};
use crate::forms;
use crate::symbol::{SymbolId, SymbolKind};

/// The vector of an observable over a domain.
pub(super) struct Sight<'a> {
    chain: &'a Chain,
    observable: ObservableId,
    nominal: [Poly; 3],
    /// The square of its length.
    square: Poly,
    /// What the errors add over the whole domain.
    whole: Whole,
    /// The symbols, errors apart, that what the errors add is bounded by.
    bounding: Vec<SymbolId>,
}

impl<'a> Sight<'a> {
    pub(super) fn new(
        chain: &'a Chain,
        observable: ObservableId,
        domain: &Domain,
    ) -> Result<Self, DomainError> {
        let nominal = forms::nominal(chain, observable)?;
        let square = sum_of_squares(nominal.iter());
        let whole = vector::bound(chain, observable, domain)?;
        let is_error = |symbol: SymbolId| chain.symbol(symbol).kind == SymbolKind::Error;
        let is_point = chain.observable(observable).kind == ObservableKind::Point;
        let way = chain.way(observable);
        // Turns without errors keep lengths, and shifts move no direction: they bound nothing.
        let counts = |kind: TransformKind, term: &Term| {
            (kind == TransformKind::Translation && is_point)
                || term.powers.iter().any(|&(symbol, _)| is_error(symbol))
        };
        let amounts = way.iter().flat_map(|passed| {
            let factor = &passed.factor;
            factor.amount.terms().filter(move |term| counts(factor.kind, term))
        });
        let components = chain.observable(observable).components.iter().flat_map(Poly::terms);
        let mut bounding: Vec<SymbolId> = amounts
            .chain(components)
            .flat_map(|term| {
                let powers: Vec<SymbolId> = term.powers.iter().map(|(symbol, _)| *symbol).collect();
                powers.into_iter().chain(term.poles.into_iter().map(|pole| pole.symbol))
            })
            .filter(|&symbol| !is_error(symbol))
            .filter(|&symbol| domain.range(symbol).is_none_or(|[low, high]| low < high))
            .filter(|&symbol| chain.symbol(symbol).kind != SymbolKind::Pi)
            .collect();
        bounding.sort_unstable();
        bounding.dedup();
        Ok(Self { chain, observable, nominal, square, whole, bounding })
    }

    /// The bound of one reading over the domain.
    pub(super) fn bound(&self, reading: &Reading, domain: &Domain) -> Result<f64, DomainError> {
        let moving: Vec<(SymbolId, [f64; 2])> = self
            .symbols(reading)
            .into_iter()
            .map(|symbol| (symbol, domain.range(symbol).unwrap_or_else(Interval::turn)))
            .filter(|(_, [low, high])| low < high)
            .collect();
        let (symbols, start): (Vec<SymbolId>, Vec<[f64; 2]>) = moving.into_iter().unzip();
        let split = self.split(reading);
        // The vector itself is bounded over the whole domain, and boxes in it are no other matter.
        let bound = |ranges: &[[f64; 2]]| match self.seen(&split, &domain.with(&symbols, ranges)) {
            Ok(seen) => seen.bound(reading.measures),
            Err(_) => f64::INFINITY,
        };
        cells::largest(&start, bound).map_err(|at| {
            let parameters: Vec<Parameter> = symbols.iter().copied().map(Parameter::Symbol).collect();
            self.lost(reading, place(self.chain, &parameters, &at))
        })
    }

    /// The symbols that the bound of a reading depends on, errors apart.
    pub(super) fn symbols(&self, reading: &Reading) -> Vec<SymbolId> {
        let (along, across) = self.split(reading);
        let mut symbols: Vec<SymbolId> =
            [&self.square, &along, &across].into_iter().flat_map(Poly::symbols).collect();
        symbols.extend(&self.bounding);
        symbols.retain(|&symbol| self.chain.symbol(symbol).kind != SymbolKind::Pi);
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    /// The component along the axis of a reading, and the square of the distance from it.
    pub(super) fn split(&self, reading: &Reading) -> (Poly, Poly) {
        let up = match reading.measures {
            Measures::Azimuth { zero, through } | Measures::CrossElevation { zero, through } => {
                3 - zero.axis.index() - through.axis.index()
            }
            Measures::Elevation { up } | Measures::ZenithDistance { up } => up.axis.index(),
            Measures::Component(_)
            | Measures::Range
            | Measures::OffAxis
            | Measures::Rotation(_)
            | Measures::Image(_) => return (Poly::zero(), Poly::zero()),
        };
        let others = (0..3).filter(|axis| *axis != up).map(|axis| &self.nominal[axis]);
        (self.nominal[up].clone(), sum_of_squares(others))
    }

    /// What is seen in a part of the domain: see [`Self::split`].
    pub(super) fn seen(&self, (along, across): &(Poly, Poly), domain: &Domain) -> Result<Seen, DomainError> {
        let enclose = |poly: &Poly| domain.enclose(self.chain, poly);
        let (square, along, mut across) = (enclose(&self.square)?, enclose(along)?, enclose(across)?);
        // The same by Pythagoras, which is often the sharper one.
        across.low = across.low.max((square + -along.square()).low);
        let narrowed;
        let whole = if self.bounding.is_empty() {
            &self.whole
        } else {
            narrowed = vector::bound(self.chain, self.observable, domain)?;
            &narrowed
        };
        Ok(Seen {
            square,
            across,
            along: Upper::exact(along.magnitude()),
            error: whole.error(),
            remainder: whole.remainder(),
        })
    }

    /// That a reading is lost at a place.
    pub(super) fn lost(&self, reading: &Reading, place: String) -> DomainError {
        let lost = match reading.measures {
            Measures::Range | Measures::OffAxis => "the origin",
            _ => "its axis",
        };
        let observable = self.chain.observable(self.observable).name.clone();
        DomainError::Lost { observable, reading: reading.words(), place, lost }
    }
}

fn sum_of_squares<'p>(parts: impl Iterator<Item = &'p Poly>) -> Poly {
    parts.fold(Poly::zero(), |sum, part| &sum + &(part * part))
}
