//! Claims that are numbers: comparisons of influences, sizes, bounds.

use std::ops::Range;

use crate::checker::{Bound, Claim, Combined, Comparison, Limits, Size, SizeMeasure};
use model_core::budget::{self, JointRange, Measure, Poses};
use model_core::remainder::Domain;
use model_core::{ObservableId, Quantity, Symbol, SymbolId, SymbolKind, names, validate};
use toml::{Spanned, Value};

use super::super::strings::place_in_string;
use super::super::table::{ClaimTable, CompareTable, Sizes};
use super::{Reader, each, span};

impl Reader<'_> {
    pub(super) fn comparison(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let compare: &CompareTable = claim.compare.as_ref()?.get_ref();
        self.numbers(claim.compare.as_ref()?.span())?;
        let observable = self.observable(claim);
        let error = self.one_error(&compare.error);
        let against = self.one_error(&compare.against);
        let measure = self.measure(&compare.measure);
        let poses = self.poses(claim);
        let at_most = *compare.at_most.get_ref();
        if !at_most.is_finite() || at_most < 0.0 {
            self.mistake(compare.at_most.span(), "the largest ratio is a number that is not negative");
            return None;
        }
        let (error, against) = (error?, against?);
        let quantity = self.chain.symbol(error).quantity;
        if quantity != self.chain.symbol(against).quantity {
            let message = format!(
                "`{}` is measured in {} and `{}` in {}: one size cannot fit both",
                compare.error.get_ref(),
                quantity.unit(),
                compare.against.get_ref(),
                self.chain.symbol(against).quantity.unit()
            );
            self.mistake(compare.against.span(), message);
            return None;
        }
        let size = self.quantity(&compare.size, quantity, "a size")?;
        Some(Claim::Comparison(Comparison {
            observable: observable?,
            error,
            against,
            size,
            measure: measure?,
            at_most,
            poses: poses?,
        }))
    }

    /// That every constant has a value, for a claim that is about numbers.
    pub(super) fn numbers(&mut self, place: Range<usize>) -> Option<()> {
        let chain = self.chain;
        let mut constants = chain.symbols_of(SymbolKind::Constant).map(|constant| chain.symbol(constant));
        // Halves of angles, which print has, are no constants of the declaration: no name is written like theirs.
        let is_open = |constant: &&Symbol| constant.value.is_none() && validate::is_name(&constant.name);
        let Some(unknown) = constants.find(is_open) else { return Some(()) };
        let name = &unknown.name;
        self.mistake(place, format!("the constant `{name}` has no value, and this claim is about numbers"))
            .help = Some(format!("write its value into the declaration: `const {name} = 0.25;`"));
        None
    }

    /// A quantity above zero, in SI.
    pub(super) fn quantity(&mut self, value: &Spanned<Value>, quantity: Quantity, what: &str) -> Option<f64> {
        let read = match value.get_ref() {
            Value::String(text) => self.edge.quantity(text, quantity),
            Value::Float(number) => Ok(*number),
            Value::Integer(number) => Ok(*number as f64),
            other => Err(format!("expected a quantity, found {}", other.type_str())),
        };
        let read = read.and_then(|size| {
            if size.is_finite() && size > 0.0 { Ok(size) } else { Err(format!("{what} is above zero")) }
        });
        match read {
            Ok(size) => Some(size),
            Err(why) => {
                self.mistake(value.span(), why).help =
                    Some(format!("write it like {}", self.edge.example(quantity)));
                None
            }
        }
    }

    /// Sizes of errors by name or pattern, indexed by symbol; a plain name wins over a pattern.
    pub(super) fn sizes(&mut self, sizes: &Sizes) -> Option<Vec<f64>> {
        let mut found = vec![0.0; self.chain.symbols.len()];
        let mut complete = !sizes.get_ref().is_empty();
        if !complete {
            self.mistake(sizes.span(), "no error is given a size");
        }
        let mut entries: Vec<_> = sizes.get_ref().iter().collect();
        entries.sort_by_key(|(name, _)| !names::is_pattern(name.get_ref()));
        for (name, size) in entries {
            let Some(errors) = self.errors_of(name.get_ref(), name.span()) else {
                complete = false;
                continue;
            };
            for error in errors {
                match self.quantity(size, self.chain.symbol(error).quantity, "a size") {
                    Some(size) => found[error.index()] = size,
                    None => return None,
                }
            }
        }
        complete.then_some(found)
    }

    /// What an observable's error is measured in.
    pub(super) fn measured_in(&self, observable: ObservableId) -> Quantity {
        if budget::unit(self.chain, observable) == "rad" { Quantity::Angle } else { Quantity::Length }
    }

    pub(super) fn size(&mut self, claim: &ClaimTable) -> Option<Claim> {
        self.numbers(claim.size.as_ref()?.span())?;
        let table = claim.size.as_ref()?.get_ref();
        let observable = self.observable(claim)?;
        let sizes = self.sizes(&table.errors);
        let poses = self.poses(claim);
        let combined = match table.combine.as_ref().map(|combine| combine.get_ref().as_str()) {
            None | Some("sum") => Combined::Sum,
            Some("rss") => Combined::RootSumSquare,
            Some(other) => {
                let place = span(&table.combine).unwrap_or_default();
                self.mistake(place, format!("influences are not combined by `{other}`")).help =
                    Some("\"sum\" is the worst case, \"rss\" the root of the sum of squares".to_owned());
                return None;
            }
        };
        let measure = self.size_measure(&table.measure)?;
        let unit = self.measured_in(observable);
        let mut limit = |value: &Option<Spanned<Value>>| match value {
            None => Some(None),
            Some(value) => self.quantity(value, unit, "a limit").map(Some),
        };
        let limits = Limits { at_most: limit(&table.at_most)?, at_least: limit(&table.at_least)? };
        if limits == Limits::default() {
            self.mistake(claim.name.span(), "this claim says no size").help =
                Some("give `at_most`, `at_least` or both".to_owned());
            return None;
        }
        Some(Claim::Size(Size { observable, sizes: sizes?, combined, measure, limits, poses: poses? }))
    }

    fn size_measure(&mut self, measure: &Spanned<String>) -> Option<SizeMeasure> {
        let text = measure.get_ref().as_str();
        let percent = text.strip_prefix("percentile ").and_then(|number| number.trim().parse::<f64>().ok());
        match (text, percent) {
            ("sup", _) => Some(SizeMeasure::Sup),
            ("rms", _) => Some(SizeMeasure::Rms),
            (_, Some(percent)) if percent > 0.0 && percent < 100.0 => Some(SizeMeasure::Percentile(percent)),
            _ => {
                self.mistake(measure.span(), format!("unknown measure `{text}`")).help = Some(
                    "\"sup\" is the largest value, \"rms\" the root mean square, \"percentile 95\" what 95 % of the poses stay below"
                        .to_owned(),
                );
                None
            }
        }
    }

    pub(super) fn bound(&mut self, claim: &ClaimTable) -> Option<Claim> {
        self.numbers(claim.bound.as_ref()?.span())?;
        let table = claim.bound.as_ref()?.get_ref();
        let observable = self.observable(claim)?;
        let sizes = self.sizes(&table.errors)?;
        let at_most = self.quantity(&table.at_most, self.measured_in(observable), "a bound")?;
        let mut domain = Domain::new(self.chain);
        let errors = self.chain.symbols_of(SymbolKind::Error).map(|error| (error, sizes[error.index()]));
        let set: Result<(), _> =
            errors.into_iter().try_for_each(|(error, size)| domain.set_size(self.chain, error, size));
        let ranges = self.ranges(claim)?;
        let set = set.and_then(|()| {
            ranges
                .iter()
                .try_for_each(|range| domain.set_range(self.chain, range.symbol, range.low, range.high))
        });
        if let Err(error) = set {
            self.mistake(claim.name.span(), error.to_string());
            return None;
        }
        Some(Claim::Bound(Bound { observable, domain, at_most }))
    }

    fn one_error(&mut self, name: &Spanned<String>) -> Option<SymbolId> {
        match self.errors_of(name.get_ref(), name.span())?.as_slice() {
            [only] => Some(*only),
            _ => {
                self.mistake(name.span(), "a comparison is of one error, and this pattern matches several");
                None
            }
        }
    }

    fn measure(&mut self, measure: &Spanned<String>) -> Option<Measure> {
        match measure.get_ref().as_str() {
            "sup" => Some(Measure::Sup),
            "rms" => Some(Measure::Rms),
            other => {
                self.mistake(measure.span(), format!("unknown measure `{other}`")).help =
                    Some("\"sup\" is the largest influence, \"rms\" its root mean square".to_owned());
                None
            }
        }
    }

    pub(super) fn poses(&mut self, claim: &ClaimTable) -> Option<Poses> {
        match (&claim.path, &claim.range) {
            (Some(_), Some(range)) => {
                self.mistake(range.span(), "`path` and `range` are both given").help =
                    Some("leave one out".to_owned());
                None
            }
            (Some(path), None) => match self.edge.path(self.chain, path.get_ref()) {
                Ok(path) => Some(Poses::Path(path)),
                Err(mistake) => {
                    let place = place_in_string(self.text, path.span(), mistake.place);
                    self.mistake(place, mistake.message).help = mistake.help;
                    None
                }
            },
            (None, _) => self.ranges(claim).map(Poses::Ranges),
        }
    }

    /// The ranges of joints and inputs that a claim gives.
    fn ranges(&mut self, claim: &ClaimTable) -> Option<Vec<JointRange>> {
        let mut found: Vec<JointRange> = Vec::new();
        let Some(texts) = &claim.range else { return Some(found) };
        for (text, place) in each(texts) {
            match self.edge.range(self.chain, text) {
                Ok(range) if found.iter().any(|earlier| earlier.symbol == range.symbol) => {
                    self.mistake(place, "this range is given twice");
                    return None;
                }
                Ok(range) => found.push(range),
                Err(why) => {
                    self.mistake(place, why);
                    return None;
                }
            }
        }
        Some(found)
    }
}
