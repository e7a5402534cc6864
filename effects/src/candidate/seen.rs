//! What a place in the chain sees in its own frame, without errors: directions of the ground, and what is observed.

use model_core::algebra::{AngleSum, Poly};
use model_core::{Axis, BodyId, Factor, ObservableId, ObservableKind, SymbolKind, TransformKind};

use super::{Place, Setting, whole};

/// Vectors of more terms than this are followed no further: they lie along no axis, and no formula is read off them.
const MOST_TERMS: usize = 64;

/// A vector of the ground frame as a place sees it; `None` where a rotation is by no whole multiple of angles, or the
/// vector grows too long.
pub(crate) fn from_ground(setting: &Setting<'_>, vector: &[Poly; 3], place: Place) -> Option<[Poly; 3]> {
    let mut seen = vector.clone();
    for body in setting.chain.path(place.body) {
        let factors = &setting.chain.body(body).factors;
        let end = if body == place.body { place.position(setting.chain) } else { factors.len() };
        for factor in &factors[..end] {
            if factor.kind == TransformKind::Rotation {
                seen = turned(setting, factor, &seen, true)?;
            }
        }
    }
    Some(seen)
}

/// What is observed as a place sees it: a direction, or a point from where the place is.
pub(crate) fn observed(setting: &Setting<'_>, observable: ObservableId, place: Place) -> Option<[Poly; 3]> {
    let observable = setting.chain.observable(observable);
    if observable.is_image() {
        return observed_by_camera(setting, observable, place);
    }
    let shifts = observable.kind == ObservableKind::Point;
    carried(setting, observable.components.clone(), observable.body, shifts, place)
}

/// The point that a camera sees, as a place below the camera or below the point sees it; `None` elsewhere: where the algebra
/// cannot say, a place is taken to move what is seen.
fn observed_by_camera(
    setting: &Setting<'_>,
    image: &model_core::Observable,
    place: Place,
) -> Option<[Poly; 3]> {
    let carrier = image.frame?;
    carried(setting, image.components.clone(), carrier, true, place)
}

/// The origin of a body as a place in it or below it sees it.
pub(crate) fn origin(setting: &Setting<'_>, body: BodyId, place: Place) -> Option<[Poly; 3]> {
    carried(setting, [Poly::zero(), Poly::zero(), Poly::zero()], body, true, place)
}

/// A vector of a body's frame (a point, where `shifts` count) as a place in it or below it sees it.
fn carried(
    setting: &Setting<'_>,
    vector: [Poly; 3],
    body: BodyId,
    shifts: bool,
    place: Place,
) -> Option<[Poly; 3]> {
    let chain = setting.chain;
    let path = chain.path(body);
    let from = path.iter().position(|&body| body == place.body)?;
    let mut seen = vector;
    for &body in path[from..].iter().rev() {
        let factors = &chain.body(body).factors;
        let start = if body == place.body { place.position(chain) } else { 0 };
        for factor in factors[start..].iter().rev() {
            match factor.kind {
                TransformKind::Rotation => seen = turned(setting, factor, &seen, false)?,
                TransformKind::Translation if shifts => {
                    let at = factor.axis.index();
                    seen[at] = &seen[at] + &nominal(setting, factor);
                }
                TransformKind::Translation => {}
            }
        }
    }
    Some(seen)
}

/// Whether a small motion at a place moves anything observed. A direction seen along the axis of a rotation stays, and
/// shifts move no direction; where the algebra cannot say, it is taken to move.
pub(crate) fn moves(setting: &Setting<'_>, place: Place) -> bool {
    setting.observables.iter().any(|&id| {
        let observable = setting.chain.observable(id);
        let carries = |body| setting.chain.path(body).contains(&place.body);
        // What carries the frame that it is seen in, too, moves nothing.
        if carries(observable.body) == observable.frame.is_some_and(carries) {
            return false;
        }
        match place.freedom.kind {
            TransformKind::Translation => observable.kind == ObservableKind::Point,
            // Whichever way a body is turned further, it is turned.
            TransformKind::Rotation if observable.is_orientation() => true,
            TransformKind::Rotation => observed(setting, id, place).is_none_or(|seen| {
                seen.iter().enumerate().any(|(i, s)| i != place.freedom.axis.index() && !s.is_zero())
            }),
        }
    })
}

/// The two axes that follow an axis in the cyclic order x, y, z.
pub(crate) fn others(axis: Axis) -> (Axis, Axis) {
    match axis {
        Axis::X => (Axis::Y, Axis::Z),
        Axis::Y => (Axis::Z, Axis::X),
        Axis::Z => (Axis::X, Axis::Y),
    }
}

/// The scalar product of two vectors.
pub(crate) fn dot(a: &[Poly; 3], b: &[Poly; 3]) -> Poly {
    a.iter().zip(b).fold(Poly::zero(), |sum, (a, b)| &sum + &(a * b))
}

/// The amount of a factor without errors.
pub(crate) fn nominal(setting: &Setting<'_>, factor: &Factor) -> Poly {
    let is_error = |symbol| setting.chain.symbol(symbol).kind == SymbolKind::Error;
    factor.amount.graded_part(is_error, 0)
}

/// A vector turned by a rotation without its errors, or seen from the frame that it turns (`backwards`).
fn turned(setting: &Setting<'_>, factor: &Factor, vector: &[Poly; 3], backwards: bool) -> Option<[Poly; 3]> {
    let nominal = nominal(setting, factor);
    if nominal.is_zero() {
        return Some(vector.clone());
    }
    let sign = whole(if backwards { -1 } else { 1 });
    let (cosine, sine) = AngleSum::from_poly(&(&nominal * &sign)).ok()?.cos_sin();
    let (a, b) = others(factor.axis);
    let (a, b) = (a.index(), b.index());
    let mut result = vector.clone();
    result[a] = &(&cosine * &vector[a]) - &(&sine * &vector[b]);
    result[b] = &(&sine * &vector[a]) + &(&cosine * &vector[b]);
    result.iter().all(|component| component.len() <= MOST_TERMS).then_some(result)
}
