//! The columns of an observable at a place: what each error adds to each number that is shown, to first order.
//!
//! They are carried along the chain, as numbers, so that no form is ever multiplied out. A row may be stretched: an elevation
//! and a range leave out their root, which is the same for all errors.

use super::image::{self, Camera};
use super::pair::{Pair, Vector};
use super::place::Place;
use crate::algebra::{AngleSum, Poly};
use crate::chain::reading::{Measures, Reading, SignedAxis};
use crate::chain::{Chain, Observable, ObservableId, ObservableKind, TransformKind};
use crate::forms::{FormError, error_table};
use crate::symbol::SymbolId;

/// One factor on the way to an observable, taken apart by degree in the errors.
struct Step {
    kind: TransformKind,
    axis: usize,
    /// Of a rotation.
    angle: AngleSum,
    /// Of a shift.
    shift: Poly,
    /// What multiplies each error, which is given as an index.
    errors: Vec<(usize, Poly)>,
}

/// An observable, ready to be evaluated.
pub(super) struct Evaluator {
    steps: Vec<Step>,
    /// Each component without errors, and what multiplies each error in it.
    vector: [(Poly, Vec<(usize, Poly)>); 3],
    /// The numbers of the camera likewise, where an image point is observed.
    camera: Option<Camera>,
    is_point: bool,
    shown: Vec<Reading>,
    errors: usize,
}

impl Evaluator {
    /// For an observable and some errors, in their order.
    pub(super) fn new(chain: &Chain, id: ObservableId, errors: &[SymbolId]) -> Result<Self, FormError> {
        let observable = chain.observable(id);
        if let Some(reading) = observable.shown.iter().find(|reading| reading.measures == Measures::OffAxis) {
            return Err(not_smooth(observable, reading));
        }
        let is_error = error_table(chain);
        let grade = |poly: &Poly, degree| poly.graded_part(|symbol| is_error[symbol.index()], degree);
        let linear = |poly: &Poly| -> Vec<(usize, Poly)> {
            let parts = grade(poly, 1).collect_by(|symbol| is_error[symbol.index()]);
            let place = |symbol: SymbolId| errors.iter().position(|error| *error == symbol);
            parts
                .into_iter()
                .filter_map(|(monomial, part)| Some((place(monomial.first()?.0)?, part)))
                .collect()
        };
        let step = |passed: crate::chain::Passed| {
            let factor = &passed.factor;
            let nominal = grade(&factor.amount, 0);
            let angle = match factor.kind {
                TransformKind::Rotation => AngleSum::from_poly(&nominal)
                    .map_err(|error| FormError::new(&chain.body(passed.body).name, factor.axis, error))?,
                TransformKind::Translation => AngleSum::default(),
            };
            let errors = linear(&factor.amount);
            Ok(Step { kind: factor.kind, axis: factor.axis.index(), angle, shift: nominal, errors })
        };
        Ok(Self {
            steps: chain.way(id).into_iter().map(step).collect::<Result<_, FormError>>()?,
            vector: observable.components.each_ref().map(|poly| (grade(poly, 0), linear(poly))),
            camera: observable
                .image
                .as_ref()
                .map(|image| image.intrinsics.each_ref().map(|poly| (grade(poly, 0), linear(poly)))),
            is_point: observable.kind == ObservableKind::Point,
            shown: observable.shown.clone(),
            errors: errors.len(),
        })
    }

    /// A row for each number that is shown; `None` where a denominator vanishes.
    pub(super) fn rows(&self, place: &Place) -> Option<Vec<Vec<Pair>>> {
        let vector = |parts: &[(Poly, Vec<(usize, Poly)>); 3]| -> Option<Vector> {
            Some([place.value(&parts[0].0)?, place.value(&parts[1].0)?, place.value(&parts[2].0)?])
        };
        // The vector as it is seen behind each factor, from the device to the ground.
        let mut seen = vec![vector(&self.vector)?];
        for step in self.steps.iter().rev() {
            let last = *seen.last()?;
            seen.push(match step.kind {
                TransformKind::Rotation => turned(last, step.axis, place.cosine_and_sine(&step.angle)),
                TransformKind::Translation if self.is_point => {
                    shifted(last, step.axis, place.value(&step.shift)?)
                }
                TransformKind::Translation => last,
            });
        }
        let nominal = seen.pop()?;
        // What each error adds to the vector, and how it turns the body, from the ground to the device.
        let mut added = vec![[Pair::ZERO; 3]; self.errors];
        let mut turns = vec![[Pair::ZERO; 3]; self.errors];
        let mut axes: [Vector; 3] = std::array::from_fn(unit);
        let add = |sum: &mut Vector, direction: Vector, factor: Pair| {
            for (sum, part) in sum.iter_mut().zip(direction) {
                *sum = sum.plus(part.times(factor));
            }
        };
        for step in &self.steps {
            let after = seen.pop()?;
            match step.kind {
                TransformKind::Rotation => {
                    let [cosine, sine] = place.cosine_and_sine(&step.angle);
                    let (b, c) = ((step.axis + 1) % 3, (step.axis + 2) % 3);
                    let (old_b, old_c) = (axes[b], axes[c]);
                    axes[b] = scaled_sum(old_b, cosine, old_c, sine);
                    axes[c] = scaled_sum(old_c, cosine, old_b, sine.negated());
                    // The amount's error turns beside what the amount itself turns, about the same axis.
                    let moved = combined(&axes, cross(unit(step.axis), after));
                    for (error, part) in &step.errors {
                        let factor = place.value(part)?;
                        add(&mut added[*error], moved, factor);
                        add(&mut turns[*error], axes[step.axis], factor);
                    }
                }
                TransformKind::Translation if self.is_point => {
                    for (error, part) in &step.errors {
                        add(&mut added[*error], axes[step.axis], place.value(part)?);
                    }
                }
                TransformKind::Translation => {}
            }
        }
        for (axis, (_, parts)) in axes.iter().zip(&self.vector) {
            for (error, part) in parts {
                add(&mut added[*error], *axis, place.value(part)?);
            }
        }
        if let Some(camera) = &self.camera {
            return image::rows(camera, &self.shown, nominal, &added, place);
        }
        let row = |reading: &Reading| -> Vec<Pair> {
            added.iter().zip(&turns).map(|(&added, &turn)| slope(reading, nominal, added, turn)).collect()
        };
        Some(self.shown.iter().map(row).collect())
    }
}

/// What an error adds to a reading, but for a factor that all errors share.
fn slope(reading: &Reading, nominal: Vector, added: Vector, turn: Vector) -> Pair {
    let of = |axis: SignedAxis, vector: Vector| {
        let component = vector[axis.axis.index()];
        if axis.is_negative { component.negated() } else { component }
    };
    match reading.measures {
        Measures::Component(axis) => added[axis.index()],
        Measures::Azimuth { zero, through } | Measures::CrossElevation { zero, through } => {
            let (a, b) = (of(zero, nominal), of(through, nominal));
            a.times(of(through, added)).minus(b.times(of(zero, added)))
        }
        // (v·v) dz − z (v·dv), over what the errors do not change.
        Measures::Elevation { up } | Measures::ZenithDistance { up } => {
            let (height, rise) = (of(up, nominal), of(up, added));
            dot(nominal, nominal).times(rise).minus(height.times(dot(nominal, added)))
        }
        Measures::Range => dot(nominal, added),
        Measures::Rotation(axis) => turn[axis.index()],
        Measures::OffAxis => unreachable!("it has no slope, and no evaluator"),
        Measures::Image(_) => unreachable!("image points have slopes of their own"),
    }
}

fn not_smooth(observable: &Observable, reading: &Reading) -> FormError {
    FormError::NotSmooth { observable: observable.name.clone(), reading: reading.words() }
}

fn unit(axis: usize) -> Vector {
    std::array::from_fn(|i| if i == axis { Pair::ONE } else { Pair::ZERO })
}

fn dot(a: Vector, b: Vector) -> Pair {
    a.into_iter().zip(b).fold(Pair::ZERO, |sum, (a, b)| sum.plus(a.times(b)))
}

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j].times(b[k]).minus(a[k].times(b[j]))
    })
}

fn scaled_sum(a: Vector, factor: Pair, b: Vector, other: Pair) -> Vector {
    std::array::from_fn(|i| a[i].times(factor).plus(b[i].times(other)))
}

/// Components along three axes, put together.
fn combined(axes: &[Vector; 3], components: Vector) -> Vector {
    std::array::from_fn(|i| {
        axes.iter().zip(components).fold(Pair::ZERO, |sum, (axis, part)| sum.plus(axis[i].times(part)))
    })
}

fn turned(vector: Vector, axis: usize, [cosine, sine]: [Pair; 2]) -> Vector {
    let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut result = vector;
    result[a] = vector[a].times(cosine).minus(vector[b].times(sine));
    result[b] = vector[a].times(sine).plus(vector[b].times(cosine));
    result
}

fn shifted(vector: Vector, axis: usize, amount: Pair) -> Vector {
    let mut result = vector;
    result[axis] = result[axis].plus(amount);
    result
}
