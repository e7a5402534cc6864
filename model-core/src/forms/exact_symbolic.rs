//! The untruncated form, for chains whose errors are angles and shifts themselves.

use super::FormError;
use super::graded::rotate;
use crate::algebra::{AngleSum, Poly};
use crate::chain::{Axis, Chain, ObservableId, ObservableKind, TransformKind};
use crate::forms::error_table;

/// What the errors add to the components that an observable shows, without approximation: the transform with errors minus
/// the transform without, times its vector.
///
/// # Errors
/// [`FormError`] if a rotation is by anything but whole multiples of symbols and quarter turns: the sine of
/// `sag*cos(beta)` is no trigonometric polynomial; or if something else than components is shown. Truncated forms
/// ([`super::derive`]) exist all the same.
pub fn exact_symbolic(chain: &Chain, observable: ObservableId) -> Result<Vec<Poly>, FormError> {
    let is_error = error_table(chain);
    let shown = &chain.observable(observable).shown;
    let axes: Vec<Axis> = shown
        .iter()
        .map(|reading| {
            let (observable, name) = (chain.observable(observable).name.clone(), reading.words());
            let why = if reading.image().is_some() {
                FormError::Image { observable, reading: name }
            } else {
                FormError::NotExact { observable, reading: name }
            };
            reading.component().ok_or(why)
        })
        .collect::<Result<_, _>>()?;
    let with_errors = transformed(chain, observable, Clone::clone)?;
    let without =
        transformed(chain, observable, |poly| poly.graded_part(|symbol| is_error[symbol.index()], 0))?;
    Ok(axes.into_iter().map(|axis| &with_errors[axis.index()] - &without[axis.index()]).collect())
}

fn transformed(
    chain: &Chain,
    id: ObservableId,
    amount_of: impl Fn(&Poly) -> Poly,
) -> Result<[Poly; 3], FormError> {
    let observable = chain.observable(id);
    let mut vector = observable.components.each_ref().map(&amount_of);
    for passed in chain.way(id).into_iter().rev() {
        let factor = &passed.factor;
        let amount = amount_of(&factor.amount);
        match factor.kind {
            TransformKind::Translation if observable.kind == ObservableKind::Direction => {}
            TransformKind::Translation => {
                let component = &mut vector[factor.axis.index()];
                *component = &*component + &amount;
            }
            TransformKind::Rotation => {
                let angle = AngleSum::from_poly(&amount)
                    .map_err(|error| FormError::new(&chain.body(passed.body).name, factor.axis, error))?;
                let (cosine, sine) = angle.cos_sin();
                rotate(&mut vector, factor.axis, &cosine, &sine);
            }
        }
    }
    Ok(vector)
}
