//! Image points: what a camera makes of a point of its frame, exactly, to first order, and as derivatives.

use model_core::image::{Field, INTRINSICS, project};
use model_core::{Chain, SymbolId};

use super::amount::lower;
use super::path::{Camera, Path};
use super::vectors::Vector;
use super::{exact, first_order, jacobian};
use crate::builder::{Builder, Value};

/// What is shown, with errors.
pub(super) fn value(b: &mut Builder, path: &Path, camera: &Camera) -> Vec<Value> {
    let point = exact::value(b, path);
    let intrinsics = camera.each_ref().map(|amount| lower(b, &(&amount.nominal + &amount.error)));
    let seen = project(point, &intrinsics, b);
    shown(path, seen, point)
}

/// What errors add to it.
pub(super) fn error(b: &mut Builder, path: &Path, camera: &Camera) -> Vec<Value> {
    let (nominal, error) = exact::both(b, path);
    let point: [Both; 3] = std::array::from_fn(|i| Both { nominal: nominal[i], error: error[i] });
    let intrinsics = camera
        .each_ref()
        .map(|amount| Both { nominal: lower(b, &amount.nominal), error: lower(b, &amount.error) });
    let seen = project(point, &intrinsics, b);
    shown(path, seen, point).into_iter().map(|both| both.error).collect()
}

/// The part of that which is linear in the errors.
pub(super) fn first_order(
    b: &mut Builder,
    chain: &Chain,
    path: &Path,
    camera: &Camera,
    meeting: usize,
) -> Vec<Value> {
    let (nominal, change) = (exact::both(b, path).0, first_order::error(b, chain, path, meeting));
    let intrinsics = camera.each_ref().map(|amount| Moving {
        value: lower(b, &amount.nominal),
        rate: lower(b, &first_order::linear(chain, &amount.error)),
    });
    rates(b, path, (&nominal, &change), &intrinsics)
}

/// The rows of a Jacobian, one behind the other.
pub(super) fn jacobian_rows(
    b: &mut Builder,
    chain: &Chain,
    path: &Path,
    camera: &Camera,
    at: jacobian::At,
    wrt: &[SymbolId],
) -> Vec<Value> {
    let point = match at {
        jacobian::At::Errors => exact::value(b, path),
        jacobian::At::Nominal => exact::both(b, path).0,
    };
    let columns = jacobian::columns(b, chain, path, at, wrt);
    let mut by_symbol = Vec::with_capacity(wrt.len());
    for (&symbol, column) in wrt.iter().zip(&columns) {
        let intrinsics = camera.each_ref().map(|amount| {
            let value = match at {
                jacobian::At::Errors => lower(b, &(&amount.nominal + &amount.error)),
                jacobian::At::Nominal => lower(b, &amount.nominal),
            };
            Moving { value, rate: jacobian::Varying::new(b, symbol).derivative(b, chain, amount, at) }
        });
        by_symbol.push(rates(b, path, (&point, column), &intrinsics));
    }
    (0..path.shown.len()).flat_map(|row| by_symbol.iter().map(move |rates| rates[row])).collect()
}

fn rates(
    b: &mut Builder,
    path: &Path,
    (point, change): (&Vector, &Vector),
    intrinsics: &[Moving; INTRINSICS],
) -> Vec<Value> {
    let point: [Moving; 3] = std::array::from_fn(|i| Moving { value: point[i], rate: change[i] });
    let seen = project(point, intrinsics, b);
    shown(path, seen, point).into_iter().map(|moving| moving.rate).collect()
}

/// What of the image and of the point itself is shown.
fn shown<T: Copy>(path: &Path, image: [T; 2], point: [T; 3]) -> Vec<T> {
    let one = |reading: &model_core::readings::Reading| {
        let component = || reading.component().map(|axis| point[axis.index()]);
        reading.image().map(|axis| image[axis.index()]).or_else(component)
    };
    path.shown.iter().filter_map(one).collect()
}

impl Field for Value {
    type With<'a> = Builder;

    fn plus(self, other: Self, b: &mut Builder) -> Self {
        b.add(self, other)
    }

    fn times(self, other: Self, b: &mut Builder) -> Self {
        b.mul(self, other)
    }

    fn over(self, other: Self, b: &mut Builder) -> Self {
        b.div(self, other)
    }
}

/// A number without errors, and what errors add to it.
#[derive(Clone, Copy)]
struct Both {
    nominal: Value,
    error: Value,
}

impl Field for Both {
    type With<'a> = Builder;

    fn plus(self, other: Self, b: &mut Builder) -> Self {
        Self { nominal: b.add(self.nominal, other.nominal), error: b.add(self.error, other.error) }
    }

    /// (a + δ)(b + ε) = ab + (aε + δ(b + ε))
    fn times(self, other: Self, b: &mut Builder) -> Self {
        let real = b.add(other.nominal, other.error);
        Self {
            nominal: b.mul(self.nominal, other.nominal),
            error: b.dot([(self.nominal, other.error), (self.error, real)]),
        }
    }

    /// With q = a/b, (a + δ)/(b + ε) = q + (δ − qε)/(b + ε).
    fn over(self, other: Self, b: &mut Builder) -> Self {
        let nominal = b.div(self.nominal, other.nominal);
        let real = b.add(other.nominal, other.error);
        let above = b.dot([(Builder::ONE, self.error), (-nominal, other.error)]);
        Self { nominal, error: b.div(above, real) }
    }
}

/// A number and how fast it changes.
#[derive(Clone, Copy)]
struct Moving {
    value: Value,
    rate: Value,
}

impl Field for Moving {
    type With<'a> = Builder;

    fn plus(self, other: Self, b: &mut Builder) -> Self {
        Self { value: b.add(self.value, other.value), rate: b.add(self.rate, other.rate) }
    }

    fn times(self, other: Self, b: &mut Builder) -> Self {
        Self {
            value: b.mul(self.value, other.value),
            rate: b.dot([(self.value, other.rate), (self.rate, other.value)]),
        }
    }

    fn over(self, other: Self, b: &mut Builder) -> Self {
        let value = b.div(self.value, other.value);
        let above = b.dot([(Builder::ONE, self.rate), (-value, other.rate)]);
        Self { value, rate: b.div(above, other.value) }
    }
}
