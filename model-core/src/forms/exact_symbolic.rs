//! The untruncated form, for chains whose errors are angles and shifts themselves.

use super::FormError;
use super::graded::rotate;
use crate::algebra::{AngleSum, Poly};
use crate::chain::{Chain, Motion, ObservableId, ObservableKind};
use crate::forms::error_table;

/// The error of an observable without approximation: the transform with errors minus the transform without, times
/// its vector.
///
/// # Errors
/// [`FormError`] if a rotation is by anything but whole multiples of symbols and quarter turns: the sine of
/// `sag*cos(beta)` is no trigonometric polynomial. Truncated forms ([`super::derive`]) exist all the same.
pub fn exact_symbolic(chain: &Chain, observable: ObservableId) -> Result<[Poly; 3], FormError> {
    let is_error = error_table(chain);
    let with_errors = transformed(chain, observable, Clone::clone)?;
    let without =
        transformed(chain, observable, |poly| poly.graded_part(|symbol| is_error[symbol.index()], 0))?;
    let [[x, y, z], [x0, y0, z0]] = [with_errors, without];
    Ok([&x - &x0, &y - &y0, &z - &z0])
}

fn transformed(
    chain: &Chain,
    id: ObservableId,
    amount_of: impl Fn(&Poly) -> Poly,
) -> Result<[Poly; 3], FormError> {
    let observable = chain.observable(id);
    let mut vector = observable.components.each_ref().map(&amount_of);
    for body in chain.path(observable.body).into_iter().rev().map(|id| chain.body(id)) {
        for factor in body.factors.iter().rev() {
            let amount = amount_of(&factor.amount);
            match factor.motion {
                Motion::Translation if observable.kind == ObservableKind::Direction => {}
                Motion::Translation => {
                    let component = &mut vector[factor.axis.index()];
                    *component = &*component + &amount;
                }
                Motion::Rotation => {
                    let angle = AngleSum::from_poly(&amount)
                        .map_err(|error| FormError::new(&body.name, factor.axis, error))?;
                    let (cosine, sine) = angle.cos_sin();
                    rotate(&mut vector, factor.axis, &cosine, &sine);
                }
            }
        }
    }
    Ok(vector)
}
