//! Truncating while multiplying: the observable's vector is carried from the device to the ground, sorted by degree
//! in the errors, and no product beyond the order is ever formed.

use super::{FormError, error_table};
use crate::algebra::{AlgebraError, AngleSum, Poly, Rational};
use crate::chain::{Axis, Chain, ObservableId, ObservableKind, TransformKind};

type Vector = [Poly; 3];

/// The vector of an observable in the frame that it is seen in, by degree in the errors, from 0 to `order`;
/// refused if it has more than so many terms on its way.
pub(super) fn parts_up_to(
    chain: &Chain,
    id: ObservableId,
    order: u32,
    terms: usize,
) -> Result<Vec<Vector>, FormError> {
    let is_error = error_table(chain);
    let grade = |poly: &Poly, degree| poly.graded_part(|symbol| is_error[symbol.index()], degree);
    let start = chain.observable(id).components.each_ref();
    let parts = (0..=order).map(|degree| start.map(|poly| grade(poly, degree))).collect();
    carried(chain, id, parts, terms)
}

/// The three axes of the body that an observable belongs to in the frame that it is seen in, each as [`parts_up_to`] has it.
pub(super) fn axes_up_to(
    chain: &Chain,
    id: ObservableId,
    order: u32,
    terms: usize,
) -> Result<[Vec<Vector>; 3], FormError> {
    let axis = |axis: usize| {
        let mut parts = vec![Vector::default(); order as usize + 1];
        parts[0][axis] = Poly::one();
        carried(chain, id, parts, terms)
    };
    Ok([axis(0)?, axis(1)?, axis(2)?])
}

/// A vector of the body that carries an observable, by degree in the errors, in the frame that the observable is seen in.
fn carried(
    chain: &Chain,
    id: ObservableId,
    mut parts: Vec<Vector>,
    terms: usize,
) -> Result<Vec<Vector>, FormError> {
    let is_error = error_table(chain);
    let grade = |poly: &Poly, degree| poly.graded_part(|symbol| is_error[symbol.index()], degree);
    let observable = chain.observable(id);
    for passed in chain.way(id).into_iter().rev() {
        let factor = &passed.factor;
        let refuse = |error| FormError::new(&chain.body(passed.body).name, factor.axis, error);
        let amount: Vec<Poly> =
            (0u32..).take(parts.len()).map(|degree| grade(&factor.amount, degree)).collect();
        match factor.kind {
            TransformKind::Translation if observable.kind == ObservableKind::Direction => {}
            TransformKind::Translation => {
                for (part, shift) in parts.iter_mut().zip(&amount) {
                    if !shift.is_zero() {
                        let component = &mut part[factor.axis.index()];
                        *component = &*component + shift;
                    }
                }
            }
            TransformKind::Rotation => {
                rotate_by_error(&mut parts, factor.axis, &amount);
                if parts.iter().flatten().map(Poly::len).sum::<usize>() > terms {
                    return Err(refuse(AlgebraError::TooLarge));
                }
                let angle = AngleSum::from_poly(&amount[0]).map_err(refuse)?;
                if !angle.is_zero() {
                    let (cosine, sine) = angle.cos_sin();
                    for part in &mut parts {
                        rotate(part, factor.axis, &cosine, &sine);
                    }
                }
            }
        }
    }
    Ok(parts)
}

/// The two axes that a rotation mixes, in right-handed order.
fn others(axis: Axis) -> (usize, usize) {
    ((axis.index() + 1) % 3, (axis.index() + 2) % 3)
}

/// The exact rotation of a vector.
pub(super) fn rotate(vector: &mut Vector, axis: Axis, cosine: &Poly, sine: &Poly) {
    let (a, b) = others(axis);
    let rotated_a = &(&vector[a] * cosine) - &(&vector[b] * sine);
    let rotated_b = &(&vector[a] * sine) + &(&vector[b] * cosine);
    vector[a] = rotated_a;
    vector[b] = rotated_b;
}

/// The rotation by a small amount, given by degrees, of a vector given by degrees:
/// R(e) = 1 + sin e · (axis ×) + (cos e − 1) · (projection on the plane across the axis).
fn rotate_by_error(parts: &mut [Vector], axis: Axis, amount: &[Poly]) {
    let order = parts.len() - 1;
    if amount.iter().skip(1).all(Poly::is_zero) {
        return;
    }
    let (sine, cosine_less_one) = expand(amount);
    let (a, b) = others(axis);
    // From the highest degree down: what is added to a part comes from lower parts only.
    for degree in (1..=order).rev() {
        let (lower, this) = parts.split_at_mut(degree);
        let this = &mut this[0];
        for (factor_degree, from) in (1..=degree).map(|m| (m, &lower[degree - m])) {
            let (s, c) = (&sine[factor_degree], &cosine_less_one[factor_degree]);
            if !s.is_zero() {
                this[a] = &this[a] - &(&from[b] * s);
                this[b] = &this[b] + &(&from[a] * s);
            }
            if !c.is_zero() {
                this[a] = &this[a] + &(&from[a] * c);
                this[b] = &this[b] + &(&from[b] * c);
            }
        }
    }
}

/// sin e and cos e − 1 by degree, for an amount `e` given by degree (its degree 0 is not looked at).
fn expand(amount: &[Poly]) -> (Vec<Poly>, Vec<Poly>) {
    let order = amount.len() - 1;
    let mut sine = vec![Poly::zero(); order + 1];
    let mut cosine_less_one = vec![Poly::zero(); order + 1];
    // eⁿ/n! by degree
    let mut power = amount.to_vec();
    power[0] = Poly::zero();
    let mut inverse = Rational::ONE;
    for n in 1..=order {
        let negative = n % 4 >= 2;
        let target = if n % 2 == 1 { &mut sine } else { &mut cosine_less_one };
        for (sum, term) in target.iter_mut().zip(&power) {
            *sum = if negative { &*sum - term } else { &*sum + term };
        }
        inverse = i64::try_from(n + 1).ok().and_then(|n| Rational::new(1, n)).unwrap_or(inverse);
        power = (0..=order)
            .map(|degree| (1..degree).fold(Poly::zero(), |sum, m| &sum + &(&power[degree - m] * &amount[m])))
            .map(|term| term.scale(&inverse))
            .collect();
    }
    (sine, cosine_less_one)
}
