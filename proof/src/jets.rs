//! Powers of t, where every error is multiplied by t: what the observable's vector is after each factor, by degree.

use super::Refusal;
use super::passage::{Jet, Passage};
use model_core::algebra::{AngleSum, Poly, Rational};
use model_core::chain::{ObservableKind, TransformKind};
use model_core::forms::FormError;
use model_core::symbol::SymbolId;

/// Terms that a vector may have on its way: with 400 Coq takes half a minute for a chain of six joints; with 4,000 it did not get
/// through the first component in that time.
const TERMS_LIMIT: usize = 1_000;

/// x, y and z by powers of t.
pub(super) type VectorJet = [Jet; 3];

/// A component of the observable: it has no errors.
pub(super) fn constant(value: &Poly, order: u32) -> Jet {
    let mut jet = vec![Poly::zero(); order as usize + 1];
    jet[0] = value.clone();
    jet
}

/// The vector after one more factor.
pub(super) fn moved(
    before: &VectorJet,
    kind: ObservableKind,
    factor: &Passage,
    body: &str,
) -> Result<VectorJet, Refusal> {
    let amount = &factor.jet;
    let mut vector = before.clone();
    match factor.kind {
        TransformKind::Translation if kind == ObservableKind::Direction => {}
        TransformKind::Translation => {
            let component = &mut vector[factor.axis.index()];
            *component = component.iter().zip(amount).map(|(a, b)| a + b).collect();
        }
        TransformKind::Rotation => {
            let angle = AngleSum::from_poly(&amount[0]).map_err(|error| FormError::Factor {
                body: body.to_owned(),
                axis: factor.axis,
                error,
            })?;
            let (cosine, sine) = waves(&angle, amount);
            let (a, b) = ((factor.axis.index() + 1) % 3, (factor.axis.index() + 2) % 3);
            vector[a] = combined(&product(&before[a], &cosine), &product(&before[b], &sine), true);
            vector[b] = combined(&product(&before[a], &sine), &product(&before[b], &cosine), false);
        }
    }
    let terms: usize = vector.iter().flatten().map(Poly::len).sum();
    if terms > TERMS_LIMIT { Err(Refusal::TooLarge { terms, limit: TERMS_LIMIT }) } else { Ok(vector) }
}

/// An amount by powers of t: its degrees in the errors that are kept; the others are zero.
pub(super) fn amount(
    amount: &Poly,
    order: u32,
    is_error: impl Fn(SymbolId) -> bool,
    is_kept: impl Fn(SymbolId) -> bool,
) -> Jet {
    let kept = amount.graded_part(|symbol| is_error(symbol) && !is_kept(symbol), 0);
    let highest = kept.degree_in(&is_error).max(order);
    (0..=highest).map(|degree| kept.graded_part(&is_error, degree)).collect()
}

/// Cosine and sine of an amount whose part without t is `angle`.
///
/// Source: k·cₖ = −Σ j·aⱼ·sₖ₋ⱼ and k·sₖ = Σ j·aⱼ·cₖ₋ⱼ, from cos′ = −sin · a′ and sin′ = cos · a′.
pub(super) fn waves(angle: &AngleSum, amount: &Jet) -> (Jet, Jet) {
    let (cosine, sine) = angle.cos_sin();
    let (mut cosines, mut sines) = (vec![cosine], vec![sine]);
    for k in 1..amount.len() {
        let sum = |other: &Jet| {
            let terms = (1..=k).map(|j| (&amount[j] * &other[k - j]).scale(&whole(j)));
            let total = terms.fold(Poly::zero(), |sum, term| &sum + &term);
            match whole(k).recip() {
                Some(inverse) => total.scale(&inverse),
                None => unreachable!("k counts from one"),
            }
        };
        let (next_cosine, next_sine) = (-&sum(&sines), sum(&cosines));
        cosines.push(next_cosine);
        sines.push(next_sine);
    }
    (cosines, sines)
}

fn whole(n: usize) -> Rational {
    match i64::try_from(n) {
        Ok(n) => Rational::from(n),
        Err(_) => unreachable!("an order in the errors is a small number"),
    }
}

fn product(a: &Jet, b: &Jet) -> Jet {
    (0..a.len())
        .map(|degree| {
            let parts = (0..=degree).filter(|&j| degree - j < b.len());
            parts.fold(Poly::zero(), |sum, j| &sum + &(&a[j] * &b[degree - j]))
        })
        .collect()
}

fn combined(a: &Jet, b: &Jet, subtract: bool) -> Jet {
    a.iter().zip(b).map(|(a, b)| if subtract { a - b } else { a + b }).collect()
}

/// The derivatives at t = 0 from the powers of t: times 1, 1, 2, 6.
pub(super) fn derivatives(jet: &Jet) -> Vec<Poly> {
    let mut factorial = Rational::ONE;
    (0..)
        .zip(jet)
        .map(|(k, part): (usize, &Poly)| {
            if k > 0 {
                factorial = &factorial * &whole(k);
            }
            part.scale(&factorial)
        })
        .collect()
}
