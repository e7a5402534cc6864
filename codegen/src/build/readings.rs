//! Readings: the numbers that an observable shows, from its vector without errors and what errors add to it.
//!
//! Errors of angles come from a cross and a dot product, those of lengths from a difference of squares that is never
//! formed, as [`model_core::readings`] has them: no digit is lost however small the errors are.

use model_core::readings::{Measures, Reading, SignedAxis};

use super::vectors::{NOTHING, Vector, add, cross};
use crate::builder::{Builder, Value};

/// What is shown with errors.
pub(super) fn value(b: &mut Builder, reading: &Reading, nominal: &Vector, error: &Vector) -> Value {
    let real = |b: &mut Builder| add(b, nominal, error);
    match reading.measures {
        Measures::Component(axis) => {
            let real = real(b);
            real[axis.index()]
        }
        Measures::Azimuth { zero, through } => {
            let real = real(b);
            b.arc_tangent(along(&real, through), along(&real, zero))
        }
        Measures::Elevation { up } => {
            let real = real(b);
            let across = length(b, &across(&real, up));
            b.arc_tangent(along(&real, up), across)
        }
        Measures::ZenithDistance { up } => {
            let real = real(b);
            let across = length(b, &across(&real, up));
            b.arc_tangent(across, along(&real, up))
        }
        Measures::Range => {
            let real = real(b);
            length(b, &real)
        }
        Measures::CrossElevation { .. } | Measures::OffAxis | Measures::Rotation(_) | Measures::Image(_) => {
            self::error(b, reading, nominal, error)
        }
    }
}

/// What errors add to it.
pub(super) fn error(b: &mut Builder, reading: &Reading, nominal: &Vector, error: &Vector) -> Value {
    match reading.measures {
        Measures::Component(axis) => error[axis.index()],
        Measures::Azimuth { zero, through } => azimuth(b, zero, through, nominal, error),
        Measures::CrossElevation { zero, through } => {
            let azimuth = azimuth(b, zero, through, nominal, error);
            let cosine = cosine(b, zero, through, nominal);
            b.mul(azimuth, cosine)
        }
        Measures::Elevation { up } => elevation(b, up, nominal, error),
        Measures::ZenithDistance { up } => -elevation(b, up, nominal, error),
        Measures::Range => growth(b, nominal, error).1,
        Measures::OffAxis => {
            let sideways = cross(b, nominal, error);
            let (sine, real) = (length(b, &sideways), add(b, nominal, error));
            let cosine = dot(b, nominal, &real);
            b.arc_tangent(sine, cosine)
        }
        Measures::Rotation(_) => unreachable!("{ORIENTATION}"),
        Measures::Image(_) => unreachable!("{IMAGE}"),
    }
}

/// How fast it grows with the vector, for a small change of that: linear in the change, except for the angle off the axis,
/// which grows with the length of the change.
pub(super) fn rate(b: &mut Builder, reading: &Reading, vector: &Vector, change: &Vector) -> Value {
    match reading.measures {
        Measures::Component(axis) => change[axis.index()],
        Measures::Azimuth { zero, through } => azimuth_rate(b, zero, through, vector, change),
        Measures::CrossElevation { zero, through } => {
            let azimuth = azimuth_rate(b, zero, through, vector, change);
            let cosine = cosine(b, zero, through, vector);
            b.mul(azimuth, cosine)
        }
        Measures::Elevation { up } => elevation_rate(b, up, vector, change),
        Measures::ZenithDistance { up } => -elevation_rate(b, up, vector, change),
        Measures::Range => {
            let (above, below) = (dot(b, vector, change), length(b, vector));
            b.div(above, below)
        }
        Measures::OffAxis => {
            let sideways = cross(b, vector, change);
            let (above, below) = (length(b, &sideways), dot(b, vector, vector));
            b.div(above, below)
        }
        Measures::Rotation(_) => unreachable!("{ORIENTATION}"),
        Measures::Image(_) => unreachable!("{IMAGE}"),
    }
}

/// Why no single vector is asked how a body is turned.
const ORIENTATION: &str = "orientations go by the three axes of their body";

/// Why no single vector is asked what a camera makes of it.
const IMAGE: &str = "image points go by the numbers of their camera";

/// The turn of a body: its small rotation vector, its angle, and the sine and cosine of that.
struct Turn {
    vector: Vector,
    angle: Value,
    sine: Value,
    cosine: Value,
}

fn turn(b: &mut Builder, axes: &[(Vector, Vector); 3]) -> Turn {
    /// Far below the square of any turn, it keeps θ/sin θ a number where there is none; single precision has it too.
    const LEAST: f64 = 1e-36;
    let along = sine(b, axes);
    let half = b.constant(0.5);
    let mut cosine = Builder::ONE;
    for (nominal, error) in axes {
        let along = dot(b, nominal, error);
        let part = b.mul(along, half);
        cosine = b.add(cosine, part);
    }
    let square = dot(b, &along, &along);
    let least = b.constant(LEAST);
    let square = b.add(square, least);
    let sine = b.root(square);
    let angle = b.arc_tangent(sine, cosine);
    let stretch = b.div(angle, sine);
    Turn { vector: along.map(|component| b.mul(component, stretch)), angle, sine, cosine }
}

/// The small rotation vector from the axes of a body without errors and what the errors add to each.
///
/// Source: as [`model_core`] has it, from the sine and the cosine of the turn.
pub(super) fn rotation(b: &mut Builder, axes: &[(Vector, Vector); 3]) -> Vector {
    turn(b, axes).vector
}

/// How the small rotation vector changes where the axes change, without errors and with them.
///
/// Source: ω′ = ψ − ½ ω × ψ + (1 − θ (1 + cos θ) / (2 sin θ)) / θ² · ω × (ω × ψ), the inverse of the left Jacobian of the
/// exponential map, with ψ = φ − E φ₀ for rates of turning φ with errors and φ₀ without, and E = R R₀ᵀ.
pub(super) fn rotation_rate(
    b: &mut Builder,
    axes: &[(Vector, Vector); 3],
    changes: &[(Vector, Vector); 3],
) -> Vector {
    let real = axes.each_ref().map(|(nominal, error)| add(b, nominal, error));
    let mut with_errors = Vec::new();
    let mut without = Vec::new();
    for ((real, (nominal, _)), (designed, change)) in real.iter().zip(axes).zip(changes) {
        with_errors.push((*real, *change));
        without.push((*nominal, *designed));
    }
    let (Ok(with_errors), Ok(without)) =
        (<[(Vector, Vector); 3]>::try_from(with_errors), <[(Vector, Vector); 3]>::try_from(without))
    else {
        unreachable!("a body has three axes")
    };
    let (mut rate, designed) = (sine(b, &with_errors), sine(b, &without));
    for (real, (nominal, _)) in real.iter().zip(axes) {
        let along = dot(b, nominal, &designed);
        let carried = real.map(|component| b.mul(component, along));
        rate = std::array::from_fn(|i| b.sub(rate[i], carried[i]));
    }
    let Turn { vector, angle, sine, cosine } = turn(b, axes);
    let half = b.constant(0.5);
    let once = cross(b, &vector, &rate);
    let twice = cross(b, &vector, &once);
    let grown = b.add(Builder::ONE, cosine);
    let above = b.mul(angle, grown);
    let ratio = b.div(above, sine);
    let ratio = b.mul(ratio, half);
    let rest = b.sub(Builder::ONE, ratio);
    let square = b.mul(angle, angle);
    let factor = b.div(rest, square);
    std::array::from_fn(|i| {
        let bent = b.mul(once[i], half);
        let straight = b.sub(rate[i], bent);
        let curved = b.mul(factor, twice[i]);
        b.add(straight, curved)
    })
}

/// The axis of the turn times its sine: to first order the small rotation vector.
pub(super) fn sine(b: &mut Builder, axes: &[(Vector, Vector); 3]) -> Vector {
    let half = b.constant(0.5);
    let mut sum = NOTHING;
    for (nominal, error) in axes {
        let crossed = cross(b, nominal, error);
        sum = add(b, &sum, &crossed);
    }
    sum.map(|component| b.mul(component, half))
}

/// The derivative of the value of a reading with respect to a symbol. `nominal` is the vector without errors and how it
/// changes with the symbol, `real` the one with errors.
pub(super) fn derivative(
    b: &mut Builder,
    reading: &Reading,
    nominal: (&Vector, &Vector),
    error: &Vector,
    real: (&Vector, &Vector),
) -> Value {
    let Measures::CrossElevation { zero, through } = reading.measures else {
        return rate(b, reading, real.0, real.1);
    };
    // ΔA cos E₀, both of which may change.
    let turned = azimuth(b, zero, through, nominal.0, error);
    let cosine = cosine(b, zero, through, nominal.0);
    let (there, here) = (
        azimuth_rate(b, zero, through, real.0, real.1),
        azimuth_rate(b, zero, through, nominal.0, nominal.1),
    );
    let turning = b.sub(there, here);
    let cosine_rate = cosine_rate(b, zero, through, nominal.0, nominal.1);
    b.dot([(turning, cosine), (turned, cosine_rate)])
}

fn azimuth(
    b: &mut Builder,
    zero: SignedAxis,
    through: SignedAxis,
    nominal: &Vector,
    error: &Vector,
) -> Value {
    let [x, y] = [zero, through].map(|axis| along(nominal, axis));
    let [dx, dy] = [zero, through].map(|axis| along(error, axis));
    let sine = b.dot([(x, dy), (-y, dx)]);
    let (x1, y1) = (b.add(x, dx), b.add(y, dy));
    let cosine = b.dot([(x, x1), (y, y1)]);
    b.arc_tangent(sine, cosine)
}

fn azimuth_rate(
    b: &mut Builder,
    zero: SignedAxis,
    through: SignedAxis,
    v: &Vector,
    change: &Vector,
) -> Value {
    let [x, y] = [zero, through].map(|axis| along(v, axis));
    let [dx, dy] = [zero, through].map(|axis| along(change, axis));
    let above = b.dot([(x, dy), (-y, dx)]);
    let below = b.dot([(x, x), (y, y)]);
    b.div(above, below)
}

fn elevation(b: &mut Builder, up: SignedAxis, nominal: &Vector, error: &Vector) -> Value {
    let (height, rise) = (along(nominal, up), along(error, up));
    let (level, growth) = growth(b, &across(nominal, up), &across(error, up));
    let sine = b.dot([(level, rise), (-height, growth)]);
    let (level1, height1) = (b.add(level, growth), b.add(height, rise));
    let cosine = b.dot([(level, level1), (height, height1)]);
    b.arc_tangent(sine, cosine)
}

fn elevation_rate(b: &mut Builder, up: SignedAxis, v: &Vector, change: &Vector) -> Value {
    let (height, rise) = (along(v, up), along(change, up));
    let (flat, moved) = (across(v, up), across(change, up));
    let level = length(b, &flat);
    let outwards = dot(b, &flat, &moved);
    let growth = b.div(outwards, level);
    let above = b.dot([(level, rise), (-height, growth)]);
    let below = dot(b, v, v);
    b.div(above, below)
}

/// The cosine of the elevation above the plane of two axes.
fn cosine(b: &mut Builder, zero: SignedAxis, through: SignedAxis, v: &Vector) -> Value {
    let [x, y] = [zero, through].map(|axis| along(v, axis));
    let square = b.dot([(x, x), (y, y)]);
    let (level, length) = (b.root(square), length(b, v));
    b.div(level, length)
}

fn cosine_rate(b: &mut Builder, zero: SignedAxis, through: SignedAxis, v: &Vector, change: &Vector) -> Value {
    let [x, y] = [zero, through].map(|axis| along(v, axis));
    let [dx, dy] = [zero, through].map(|axis| along(change, axis));
    let square = b.dot([(x, x), (y, y)]);
    let (level, length) = (b.root(square), length(b, v));
    let outwards = b.dot([(x, dx), (y, dy)]);
    let level_rate = b.div(outwards, level);
    let along = dot(b, v, change);
    let length_rate = b.div(along, length);
    let cosine = b.div(level, length);
    let shrinking = b.mul(cosine, length_rate);
    let above = b.sub(level_rate, shrinking);
    b.div(above, length)
}

/// The length of a vector, and |v + δ| − |v| = δ·(2v + δ) / (|v + δ| + |v|).
fn growth(b: &mut Builder, nominal: &Vector, error: &Vector) -> (Value, Value) {
    let real = add(b, nominal, error);
    let (before, after) = (length(b, nominal), length(b, &real));
    let both = add(b, nominal, &real);
    let above = dot(b, error, &both);
    let below = b.add(before, after);
    (before, b.div(above, below))
}

fn along(v: &Vector, axis: SignedAxis) -> Value {
    let component = v[axis.axis.index()];
    if axis.is_negative { -component } else { component }
}

/// The part of a vector across an axis.
fn across(v: &Vector, axis: SignedAxis) -> Vector {
    let mut across = *v;
    across[axis.axis.index()] = Builder::ZERO;
    across
}

fn dot(b: &mut Builder, u: &Vector, v: &Vector) -> Value {
    b.dot(u.iter().copied().zip(v.iter().copied()))
}

fn length(b: &mut Builder, v: &Vector) -> Value {
    let square = dot(b, v, v);
    b.root(square)
}
