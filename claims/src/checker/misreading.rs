//! The chain misread: what the closed form would be with two transforms in the wrong order, one left out, or one
//! reversed. A printed formula that equals one of these tells where its author went astray.

use super::claim::ClosedForm;
use super::compare::{self, AXES, Columns, Implied, Monomial};
use super::order::Order;
use super::slip::{FormSlip, FormSlipKind, factor_name};
use model_core::algebra::Poly;
use model_core::chain::{BodyId, Chain, Factor, ObservableId, Role, TransformKind};

/// One misreading and the form that follows from it.
#[derive(Debug, Clone)]
pub(super) struct Misreading {
    kind: FormSlipKind,
    implied: Implied,
}

/// Every misreading of the way to an observable, the likelier kinds first.
pub(super) fn of_chain(chain: &Chain, observable: ObservableId, order: Order) -> Vec<Misreading> {
    // Each body on the way, with the places of its factors, from the ground up.
    let mut bodies: Vec<BodyId> = chain.way(observable).iter().map(|passed| passed.body).collect();
    bodies.sort_unstable();
    bodies.dedup();
    let places: Vec<(usize, usize)> = bodies
        .into_iter()
        .flat_map(|body| (0..chain.body(body).factors.len()).map(move |factor| (usize::from(body.0), factor)))
        .collect();
    let name = |(body, factor): (usize, usize)| {
        let body = &chain.bodies[body];
        factor_name(chain, &body.name, &body.factors[factor])
    };
    let mut misread: Vec<(FormSlipKind, Chain)> = Vec::new();
    let motions = || places.iter().filter(|&&place| factor_at(chain, place).role == Role::Motion);
    let neighbours = places.iter().zip(places.iter().skip(1)).chain(motions().zip(motions().skip(1)));
    for (&first, &second) in neighbours {
        if commute(factor_at(chain, first), factor_at(chain, second)) {
            continue;
        }
        let mut other = chain.clone();
        other.bodies[first.0].factors[first.1] = factor_at(chain, second).clone();
        other.bodies[second.0].factors[second.1] = factor_at(chain, first).clone();
        misread.push((FormSlipKind::WrongOrder { first: name(first), second: name(second) }, other));
    }
    let designed = || {
        places.iter().filter(|&&place| matches!(factor_at(chain, place).role, Role::Position | Role::Motion))
    };
    for &place in designed() {
        let mut other = chain.clone();
        other.bodies[place.0].factors[place.1].amount = Poly::zero();
        misread.push((FormSlipKind::LeftOut(name(place)), other));
    }
    for &place in designed() {
        let mut other = chain.clone();
        other.bodies[place.0].factors[place.1].amount = -&factor_at(chain, place).amount;
        misread.push((FormSlipKind::Reversed(name(place)), other));
    }
    misread
        .into_iter()
        .filter_map(|(kind, other)| {
            Some(Misreading { kind, implied: super::derived(&other, observable, order).ok()? })
        })
        .collect()
}

fn factor_at(chain: &Chain, (body, factor): (usize, usize)) -> &Factor {
    &chain.bodies[body].factors[factor]
}

/// Whether the order of two transforms makes no difference.
fn commute(a: &Factor, b: &Factor) -> bool {
    a.axis == b.axis || (a.kind == TransformKind::Translation && b.kind == TransformKind::Translation)
}

/// What explains several differences at once: exchanged components first, then a misreading of the chain for the whole
/// formula, then for all terms of one error.
pub(super) fn explain(
    claim: &ClosedForm,
    printed: &Columns,
    derived: &Columns,
    misreadings: &[Misreading],
    prepare: impl Fn(&Implied) -> Option<Columns>,
) -> Vec<FormSlip> {
    let whole = |kind| vec![FormSlip { kind, error: None }];
    if let Some(kind) = components(printed, derived) {
        return whole(kind);
    }
    let misread: Vec<(&FormSlipKind, Columns)> = misreadings
        .iter()
        .filter_map(|misreading| Some((&misreading.kind, prepare(&misreading.implied)?)))
        .collect();
    if let Some((kind, _)) = misread.iter().find(|(_, columns)| columns == printed) {
        return whole((*kind).clone());
    }
    let mut slips = Vec::new();
    for &error in &claim.kept {
        let monomial = vec![(error, 1)];
        let [print, truth] = [printed, derived].map(|columns| column(columns, &monomial));
        let differing = (0..3).filter(|&axis| print[axis] != truth[axis]).count();
        // One differing term is the affair of its own diagnosis, and a missing column is just missing.
        if differing < 2 || print.iter().all(Poly::is_zero) {
            continue;
        }
        let kind = if print == truth.each_ref().map(|part| -part) {
            Some(FormSlipKind::OppositeSign)
        } else {
            misread
                .iter()
                .find(|(_, columns)| column(columns, &monomial) == print)
                .map(|(kind, _)| (*kind).clone())
        };
        slips.extend(kind.map(|kind| FormSlip { kind, error: Some(error) }));
    }
    slips
}

/// What multiplies a product of errors in x, y and z.
fn column(columns: &Columns, monomial: &Monomial) -> [Poly; 3] {
    columns.each_ref().map(|parts| parts.get(monomial).cloned().unwrap_or_default())
}

/// Slips that concern whole components.
fn components(printed: &Columns, derived: &Columns) -> Option<FormSlipKind> {
    let differs = |axis: usize| printed[axis] != derived[axis];
    for (a, b) in [(0, 1), (1, 2), (0, 2)] {
        let exchanged = printed[a] == derived[b] && printed[b] == derived[a];
        if exchanged && differs(a) && !differs(3 - a - b) {
            return Some(FormSlipKind::SwappedComponents(AXES[a], AXES[b]));
        }
    }
    if (1..3).any(|by| (0..3).all(|axis| printed[axis] == derived[(axis + by) % 3])) && differs(0) {
        return Some(FormSlipKind::ShiftedComponents);
    }
    let [sum, truth] = [printed, derived].map(|columns| columns.each_ref().map(compare::total));
    for (a, b) in [(0, 1), (1, 2)] {
        let together = sum[a] == &truth[a] + &truth[b];
        if together && differs(a) && differs(b) {
            return Some(FormSlipKind::RunTogether(AXES[a], AXES[b]));
        }
    }
    let opposite = (0..3).all(|axis| sum[axis] == -&truth[axis]);
    (opposite && (0..3).any(differs)).then_some(FormSlipKind::OppositeSign)
}
