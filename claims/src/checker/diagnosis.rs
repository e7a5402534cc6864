//! From a difference to the slip behind it: each printed term of the error is changed in the ways that people go
//! wrong, and a change that gives what the chain gives is the diagnosis.

use std::ops::Range;

use super::angles;
use super::compare::{Columns, Pair};
use super::lowering::{self, Sines};
use super::order::Order;
use super::slip::TermSlip;
use super::terms::{PrintedTerm, TermFactor};
use super::{ClosedForm, compare};
use model_core::algebra::{AngleSum, Fraction, Poly, Rational};
use model_core::chain::{Axis, Chain};
use model_core::expr::{Expr, Function, Node};
use model_core::symbol::{SymbolId, SymbolKind};

/// A printed term of one product of errors.
pub(super) struct Candidate<'a> {
    term: &'a PrintedTerm<'a>,
    /// What multiplies the errors in it.
    factor: Poly,
}

/// What a difference comes from, and where in the text it sits.
pub(super) struct Finding {
    pub slip: Option<TermSlip>,
    pub place: Option<Range<usize>>,
    /// The one printed term of the error.
    pub term: Option<Range<usize>>,
}

/// A change of one factor of a term.
struct Change {
    from: Poly,
    to: Poly,
    kind: ChangeKind,
}

#[derive(Clone, Copy)]
enum ChangeKind {
    Function,
    Angle,
    Removed,
}

impl Change {
    /// The slip that it takes back, perhaps with the other sign; a factor too much with another sign is none.
    fn slip(self, sign: bool) -> Option<TermSlip> {
        let (printed, derived) = (self.from, self.to);
        match self.kind {
            ChangeKind::Function => Some(TermSlip::SineForCosine { printed, derived, sign }),
            ChangeKind::Angle => Some(TermSlip::OtherAngle { printed, derived, sign }),
            ChangeKind::Removed if sign => None,
            ChangeKind::Removed => Some(TermSlip::ExtraFactor(printed)),
        }
    }
}

/// The claim, and both forms by products of errors.
pub(super) struct Case<'a> {
    pub chain: &'a Chain,
    pub claim: &'a ClosedForm,
    pub printed: &'a Columns,
    pub derived: &'a Columns,
    /// What each component stands over in print; both columns are multiplied by it.
    pub below: [&'a Poly; 3],
}

impl Case<'_> {
    /// Diagnoses one difference; `terms` are the printed terms of its component.
    pub fn diagnose(&self, pair: Pair<'_>, terms: &[PrintedTerm<'_>]) -> Finding {
        let candidates = self.candidates(pair, terms);
        let place = hull(candidates.iter().filter_map(|candidate| candidate.term.place.as_ref()));
        let term = match candidates.as_slice() {
            [only] => only
                .term
                .place
                .clone()
                .or_else(|| hull(only.term.factors.iter().map(|f| &f.expression.place))),
            _ => None,
        };
        let found = |slip, place| Finding { slip: Some(slip), place, term: term.clone() };
        let (printed, derived) = (pair.printed, pair.derived);
        if pair.error.iter().any(|(error, _)| self.claim.kept.binary_search(error).is_err()) {
            return found(TermSlip::Neglected, place);
        }
        let degree = pair.error.iter().map(|(_, power)| power).sum::<u32>();
        if matches!(self.claim.order, Order::UpTo(order) if degree > order) {
            return found(TermSlip::BeyondOrder, place);
        }
        if printed.is_zero() {
            let elsewhere = self.elsewhere(pair, self.printed, self.derived, derived);
            return found(elsewhere.map_or(TermSlip::Missing, TermSlip::StandsIn), place);
        }
        if derived.is_zero()
            && let Some(axis) = self.elsewhere(pair, self.derived, self.printed, printed)
        {
            return found(TermSlip::BelongsTo(axis), place);
        }
        if let Some(factor) = ratio(printed, derived) {
            let slip = if factor == -&Rational::ONE { TermSlip::Sign } else { TermSlip::Factor(factor) };
            return found(slip, place);
        }
        // What one term has to become, all others being right.
        let lacking = derived - printed;
        for candidate in &candidates {
            let needed = &candidate.factor + &lacking;
            if let Some((slip, place)) = self.change(candidate, &needed, pair.component) {
                return found(slip, place.or_else(|| candidate.term.place.clone()));
            }
        }
        if let Some((slip, place)) = self.shared_change(&candidates, &lacking, pair.component) {
            return found(slip, Some(place));
        }
        if derived.is_zero() {
            return found(TermSlip::Superfluous, place);
        }
        if lacking.len() < derived.len() && *self.below[pair.component.index()] == Poly::one() {
            return found(TermSlip::PartMissing(lacking), place);
        }
        Finding { slip: None, place, term }
    }

    /// The printed terms of a product of errors.
    fn candidates<'t>(&self, pair: Pair<'_>, terms: &'t [PrintedTerm<'t>]) -> Vec<Candidate<'t>> {
        let mut candidates = Vec::new();
        for term in terms {
            let Some(value) = self.value(term, pair.component) else { continue };
            let mut parts = compare::parts(self.chain, &value);
            if let Some(factor) = parts.remove(pair.error)
                && parts.is_empty()
            {
                candidates.push(Candidate { term, factor });
            }
        }
        candidates
    }

    /// A term as it is compared: in the terms of the claim, multiplied by what its component stands over.
    fn value(&self, term: &PrintedTerm<'_>, component: Axis) -> Option<Poly> {
        let sign = Fraction::whole(if term.negative { -&Poly::one() } else { Poly::one() });
        let product = term
            .factors
            .iter()
            .try_fold(sign, |product, factor| product.product(&self.factor_fraction(factor)?).ok())?;
        let below = self.below[component.index()];
        let whole = product.product(&Fraction::whole(below.clone())).ok()?;
        whole.is_whole().then_some(whole.above)
    }

    fn factor_fraction(&self, factor: &TermFactor<'_>) -> Option<Fraction> {
        let sines = if self.claim.order == Order::Exact { Sines::Errors } else { Sines::Angles };
        let value = lowering::fraction(self.chain, factor.expression, sines).ok()?;
        let translate = |poly| self.claim.printed.translate(self.chain, poly).ok();
        let value = Fraction::new(translate(&value.above)?, translate(&value.below)?)?;
        if factor.divides { value.inverse() } else { Some(value) }
    }

    fn factor_value(&self, factor: &TermFactor<'_>) -> Option<Poly> {
        self.factor_fraction(factor).filter(Fraction::is_whole).map(|value| value.above)
    }

    /// Another component that has, too much, what this one lacks (or the reverse, with the columns exchanged).
    fn elsewhere(&self, pair: Pair<'_>, has: &Columns, should: &Columns, wanted: &Poly) -> Option<Axis> {
        compare::AXES.into_iter().filter(|&axis| axis != pair.component).find(|axis| {
            has[axis.index()].get(pair.error) == Some(wanted)
                && should[axis.index()].get(pair.error) != Some(wanted)
        })
    }

    /// The change of a term that makes its factor what is needed, and the place of the changed part.
    fn change(
        &self,
        candidate: &Candidate<'_>,
        needed: &Poly,
        component: Axis,
    ) -> Option<(TermSlip, Option<Range<usize>>)> {
        if needed.is_zero() {
            return Some((TermSlip::Superfluous, None));
        }
        if let Some(factor) = ratio(&candidate.factor, needed) {
            let slip = if factor == -&Rational::ONE { TermSlip::Sign } else { TermSlip::Factor(factor) };
            return Some((slip, None));
        }
        // The right sign first: what another sign explains, two slips have made.
        for with_sign in [false, true] {
            for (index, factor) in candidate.term.factors.iter().enumerate() {
                for change in self.changes(factor) {
                    let Some(rest) = self.without(candidate, index, component) else { continue };
                    let changed = &rest * &change.to;
                    let is_needed = if with_sign { changed == -needed } else { changed == *needed };
                    if let Some(slip) = is_needed.then(|| change.slip(with_sign)).flatten() {
                        return Some((slip, Some(factor.expression.place.clone())));
                    }
                }
            }
        }
        self.waves()
            .into_iter()
            .find(|wave| &candidate.factor * wave == *needed)
            .map(|wave| (TermSlip::MissingFactor(wave), None))
    }

    /// The change of one printed factor of a sum, and with it of all the terms that multiplying out makes of it.
    fn shared_change(
        &self,
        candidates: &[Candidate<'_>],
        lacking: &Poly,
        component: Axis,
    ) -> Option<(TermSlip, Range<usize>)> {
        let mut seen: Vec<&Range<usize>> = Vec::new();
        for factor in candidates.iter().flat_map(|candidate| &candidate.term.factors) {
            let place = &factor.expression.place;
            let is_same = |other: &TermFactor<'_>| other.expression.place == *place;
            let sharing = || {
                candidates.iter().filter_map(|candidate| {
                    Some((candidate, candidate.term.factors.iter().position(is_same)?))
                })
            };
            if seen.contains(&place) || sharing().count() < 2 {
                continue;
            }
            seen.push(place);
            let rests: Option<Vec<Poly>> =
                sharing().map(|(candidate, index)| self.without(candidate, index, component)).collect();
            let Some(rests) = rests else { continue };
            let rest = rests.iter().fold(Poly::zero(), |sum, rest| &sum + rest);
            let needed = sharing().fold(lacking.clone(), |sum, (candidate, _)| &sum + &candidate.factor);
            for with_sign in [false, true] {
                for change in self.changes(factor) {
                    let changed = &rest * &change.to;
                    let is_needed = if with_sign { changed == -&needed } else { changed == needed };
                    if let Some(slip) = is_needed.then(|| change.slip(with_sign)).flatten() {
                        return Some((slip, place.clone()));
                    }
                }
            }
        }
        None
    }

    /// What multiplies the errors in a term, without one of its factors.
    fn without(&self, candidate: &Candidate<'_>, left_out: usize, component: Axis) -> Option<Poly> {
        let mut term = candidate.term.clone();
        term.factors.remove(left_out);
        let parts = compare::parts(self.chain, &self.value(&term, component)?);
        parts.into_values().next()
    }

    /// The ways to get one factor wrong: the function, its angle, the factor at all.
    fn changes(&self, factor: &TermFactor<'_>) -> Vec<Change> {
        let mut changes = Vec::new();
        let Some(from) = self.factor_value(factor) else { return changes };
        if !compare::parts(self.chain, &from).keys().all(Vec::is_empty) {
            return changes;
        }
        let mut add = |changed: Expr<Range<usize>>, kind| {
            let changed = TermFactor { expression: &changed, divides: factor.divides };
            // Of an angle less itself nothing is left: that is a factor less.
            let is_one = |to: &Poly| matches!(kind, ChangeKind::Angle) && to.as_constant().is_some();
            if let Some(to) = self.factor_value(&changed).filter(|to| !is_one(to)) {
                changes.push(Change { from: from.clone(), to, kind });
            }
        };
        let (call, power) = match &factor.expression.node {
            Node::Pow(base, power) => (base.as_ref(), *power),
            _ => (factor.expression, 1),
        };
        let Node::Call(function, angle) = &call.node else { return changes };
        let raised = |function, angle: Expr<Range<usize>>| {
            let place = call.place.clone();
            let call = Expr { node: Node::Call(function, Box::new(angle)), place: place.clone() };
            if power == 1 { call } else { Expr { node: Node::Pow(Box::new(call), power), place } }
        };
        if let Some(other) = exchanged(*function) {
            add(raised(other, angle.as_ref().clone()), ChangeKind::Function);
        }
        for other in angles::taken_for(self.chain, angle) {
            add(raised(*function, other), ChangeKind::Angle);
        }
        changes.push(Change { from, to: Poly::one(), kind: ChangeKind::Removed });
        changes
    }

    /// The sine and cosine of every joint.
    fn waves(&self) -> Vec<Poly> {
        let joints: Vec<SymbolId> = self.chain.symbols_of(SymbolKind::Joint).collect();
        joints
            .into_iter()
            .flat_map(|joint| {
                let angle = AngleSum::symbol(joint);
                [Poly::cos(&angle), Poly::sin(&angle)]
            })
            .collect()
    }
}

/// The function that is most easily taken for this one.
fn exchanged(function: Function) -> Option<Function> {
    Some(match function {
        Function::Sin => Function::Cos,
        Function::Cos => Function::Sin,
        Function::Tan => Function::Cot,
        Function::Cot => Function::Tan,
        Function::Sec => Function::Csc,
        Function::Csc => Function::Sec,
    })
}

/// `a / b`, if it is a rational number.
pub(super) fn ratio(a: &Poly, b: &Poly) -> Option<Rational> {
    let first = |poly: &Poly| poly.terms().next().map(|term| term.coefficient);
    let factor = &first(a)? * &first(b)?.recip()?;
    (b.scale(&factor) == *a).then_some(factor)
}

/// The smallest range that holds all of them.
fn hull<'a>(places: impl Iterator<Item = &'a Range<usize>>) -> Option<Range<usize>> {
    places.cloned().reduce(|a, b| a.start.min(b.start)..a.end.max(b.end))
}
