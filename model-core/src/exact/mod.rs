//! The exact form in numbers: the reference that generated code is compared with.
//!
//! What the errors add is carried through the chain beside the vector itself, with sin ε and −2 sin²(ε/2) in place of
//! R − 1, so that it keeps full relative precision however small the errors are. Its first order and the rest are kept
//! apart, so that the remainder keeps full relative precision too.

mod each;
mod image;
mod reading;

use std::borrow::Cow;

use nalgebra::Vector3;

use crate::algebra::Poly;
use crate::chain::image::ImageAxis;
use crate::chain::reading::Reading;
use crate::chain::sight::SightAngle;
use crate::chain::{Axis, Chain, ObservableId, ObservableKind, TransformKind};
use crate::forms::error_table;
use crate::ramp::Ramp;
use crate::symbol::{SymbolId, SymbolKind};
use image::{Graded, Intrinsics};

pub use each::Each;

/// The factors of one observable, with every amount split by degree in the errors.
#[derive(Debug, Clone)]
pub struct Path {
    /// From the device to the frame that it is seen in.
    steps: Vec<Step>,
    vector: [Split; 3],
    /// The numbers of the camera, where an image point is observed.
    camera: Option<Box<Intrinsics>>,
    /// What is shown of the vector.
    shown: Vec<Reading>,
    /// The ramps that the amounts use.
    ramps: Vec<Ramp>,
    /// The angles of lines of sight that they use.
    angles: Vec<SightAngle>,
}

#[derive(Debug, Clone)]
struct Step {
    kind: TransformKind,
    axis: Axis,
    amount: Split,
}

#[derive(Debug, Clone)]
struct Split {
    nominal: Poly,
    /// Of degree one in the errors.
    linear: Poly,
    /// Of higher degree; nearly always zero.
    beyond: Poly,
}

/// A vector without errors, what the errors add to it in first order, and what else they add.
#[derive(Debug, Clone, Copy)]
struct Parts {
    nominal: Vector3<f64>,
    first: Vector3<f64>,
    rest: Vector3<f64>,
}

impl Path {
    /// The way from an observable to the frame that it is seen in.
    #[must_use]
    pub fn new(chain: &Chain, id: ObservableId) -> Self {
        let is_error = error_table(chain);
        let split = |amount: &Poly| {
            let grade = |degree| amount.graded_part(|symbol| is_error[symbol.index()], degree);
            let (nominal, linear) = (grade(0), grade(1));
            Split { beyond: &(amount - &nominal) - &linear, nominal, linear }
        };
        let observable = chain.observable(id);
        let moves = |motion| motion == TransformKind::Rotation || observable.kind == ObservableKind::Point;
        let steps = chain
            .way(id)
            .into_iter()
            .rev()
            .map(|passed| passed.factor)
            .filter(|factor| moves(factor.kind))
            .map(|factor| Step { kind: factor.kind, axis: factor.axis, amount: split(&factor.amount) })
            .collect();
        let mut path = Self {
            steps,
            vector: observable.components.each_ref().map(split),
            camera: observable.image.as_ref().map(|image| Box::new(image::split(image, split))),
            shown: observable.shown.clone(),
            ramps: Vec::new(),
            angles: Vec::new(),
        };
        let own = path.own_symbols();
        path.ramps = own.iter().filter_map(|&id| chain.ramp(id).cloned()).collect();
        path.angles = own.iter().filter_map(|&id| chain.sight_angle(id).cloned()).collect();
        path
    }

    /// The symbols that the observable depends on, in order; in place of ramps and of angles of lines of sight those that they follow
    /// from.
    #[must_use]
    pub fn symbols(&self) -> Vec<SymbolId> {
        let mut symbols = self.own_symbols();
        let derived = self.ramps.iter().map(|ramp| ramp.symbol);
        let derived: Vec<SymbolId> = derived.chain(self.angles.iter().map(|angle| angle.symbol)).collect();
        symbols.retain(|id| !derived.contains(id));
        symbols.extend(self.ramps.iter().flat_map(Ramp::depends_on));
        symbols.extend(self.angles.iter().flat_map(SightAngle::depends_on));
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    fn own_symbols(&self) -> Vec<SymbolId> {
        let camera = self.camera.iter().flat_map(|camera| camera.iter());
        let amounts = self.steps.iter().map(|step| &step.amount).chain(&self.vector).chain(camera);
        let mut symbols: Vec<SymbolId> = amounts
            .flat_map(|split| [&split.nominal, &split.linear, &split.beyond])
            .flat_map(Poly::symbols)
            .collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    /// The vector of the observable with errors, in the frame that it is seen in. `values` is indexed by
    /// [`SymbolId`], in SI units, π included; ramps follow from the others.
    #[must_use]
    pub fn value(&self, values: &[f64]) -> Vector3<f64> {
        let parts = self.parts(values);
        parts.nominal + (parts.first + parts.rest)
    }

    /// What the errors add to the vector of the observable: exact, with full relative precision.
    #[must_use]
    pub fn error(&self, values: &[f64]) -> Vector3<f64> {
        let parts = self.parts(values);
        parts.first + parts.rest
    }

    /// The error of the vector less its first order: with full relative precision, far below the rounding of the error itself.
    #[must_use]
    pub fn remainder(&self, values: &[f64]) -> Vector3<f64> {
        self.parts(values).rest
    }

    /// What the observable shows, with errors: one number for each reading.
    #[must_use]
    pub fn shown(&self, values: &[f64]) -> Vec<f64> {
        if self.is_orientation() {
            return self.turned(values);
        }
        if let Some(image) = self.image(values) {
            return image.iter().map(|number| number.value()).collect();
        }
        let parts = self.parts(values);
        let error = parts.first + parts.rest;
        self.shown.iter().map(|reading| reading.value(&parts.nominal, &error)).collect()
    }

    /// What the errors add to what the observable shows: exact, with full relative precision.
    #[must_use]
    pub fn shown_error(&self, values: &[f64]) -> Vec<f64> {
        if self.is_orientation() {
            return self.turned(values);
        }
        if let Some(image) = self.image(values) {
            return image.iter().map(|number| number.error()).collect();
        }
        let parts = self.parts(values);
        let error = parts.first + parts.rest;
        self.shown.iter().map(|reading| reading.error(&parts.nominal, &error)).collect()
    }

    /// What the errors add to what the observable shows, less its first order.
    #[must_use]
    pub fn shown_remainder(&self, values: &[f64]) -> Vec<f64> {
        if self.is_orientation() {
            let axes = self.axes(values);
            let first = reading::rotation_to_first_order(&axes.map(|parts| (parts.nominal, parts.first)));
            let axes = self.shown.iter().filter_map(Reading::rotation);
            return axes
                .zip(self.turned(values))
                .map(|(axis, turned)| turned - first[axis.index()])
                .collect();
        }
        if let Some(image) = self.image(values) {
            return image.iter().map(|number| number.rest).collect();
        }
        let parts = self.parts(values);
        let error = parts.first + parts.rest;
        self.shown
            .iter()
            .map(|reading| match reading.component() {
                Some(axis) => parts.rest[axis.index()],
                None => reading.error(&parts.nominal, &error) - reading.slope(&parts.nominal, &parts.first),
            })
            .collect()
    }

    /// What is shown of an image point, by degree in the errors; `None` for anything else.
    fn image(&self, values: &[f64]) -> Option<Vec<Graded>> {
        let camera = self.camera.as_ref()?;
        let point = self.parts(values);
        let seen = image::seen(&point, camera, &self.with_derived(values));
        let shown = |reading: &Reading| {
            let component = |axis: Axis| image::component(&point, axis.index());
            let number = |axis: ImageAxis| seen[axis.index()];
            reading.image().map(number).or_else(|| reading.component().map(component))
        };
        Some(self.shown.iter().filter_map(shown).collect())
    }

    fn is_orientation(&self) -> bool {
        self.shown.iter().any(|reading| reading.rotation().is_some())
    }

    /// What is shown of the small rotation vector, from the three axes of the body.
    fn turned(&self, values: &[f64]) -> Vec<f64> {
        let axes = self.axes(values).map(|parts| (parts.nominal, parts.first + parts.rest));
        let turned = reading::rotation_vector(&axes);
        let axes = self.shown.iter().filter_map(Reading::rotation);
        axes.map(|axis| turned[axis.index()]).collect()
    }

    /// The three axes of the body.
    fn axes(&self, values: &[f64]) -> [Parts; 3] {
        std::array::from_fn(|axis| {
            let start =
                |nominal: Vector3<f64>| Parts { nominal, first: Vector3::zeros(), rest: Vector3::zeros() };
            self.carried(values, |_| start(Vector3::ith(axis, 1.0)))
        })
    }

    fn parts(&self, values: &[f64]) -> Parts {
        self.carried(values, |values| {
            let start =
                |part: fn(&Split) -> &Poly| Vector3::from_fn(|axis, _| part(&self.vector[axis]).eval(values));
            Parts {
                nominal: start(|split| &split.nominal),
                first: start(|split| &split.linear),
                rest: start(|split| &split.beyond),
            }
        })
    }

    /// The values with those of ramps and of angles of lines of sight, which follow from the others.
    fn with_derived<'v>(&self, values: &'v [f64]) -> Cow<'v, [f64]> {
        let mut values = Cow::Borrowed(values);
        for angle in &self.angles {
            let value = angle.value(&values);
            if let Some(slot) = values.to_mut().get_mut(angle.symbol.index()) {
                *slot = value;
            }
        }
        for ramp in &self.ramps {
            let value = ramp.value(&values);
            if let Some(slot) = values.to_mut().get_mut(ramp.symbol.index()) {
                *slot = value;
            }
        }
        values
    }

    /// A vector of the body in the frame that the observable is seen in.
    fn carried(&self, values: &[f64], start: impl Fn(&[f64]) -> Parts) -> Parts {
        let values = &*self.with_derived(values);
        let mut parts = start(values);
        for step in &self.steps {
            let [nominal, linear, beyond] = [&step.amount.nominal, &step.amount.linear, &step.amount.beyond]
                .map(|part| part.eval(values));
            match step.kind {
                TransformKind::Translation => {
                    parts.nominal[step.axis.index()] += nominal;
                    parts.first[step.axis.index()] += linear;
                    parts.rest[step.axis.index()] += beyond;
                }
                TransformKind::Rotation => parts.rotate(step.axis, nominal, linear, beyond),
            }
        }
        parts
    }
}

impl Parts {
    /// R(nominal) R(ε) with ε = linear + beyond. With v the nominal vector and d all that the errors add, d becomes
    /// R(nominal) (d + (R(ε) − 1)(v + d)); of that, R(nominal) (first + linear · axis × v) is the first order.
    fn rotate(&mut self, axis: Axis, nominal_rad: f64, linear_rad: f64, beyond_rad: f64) {
        let (a, b) = ((axis.index() + 1) % 3, (axis.index() + 2) % 3);
        let error_rad = linear_rad + beyond_rad;
        if error_rad != 0.0 || linear_rad != 0.0 {
            let sine = error_rad.sin();
            let sine_less_linear = sine_less_angle(error_rad) + beyond_rad;
            let half = (error_rad / 2.0).sin();
            let cosine_less_one = -2.0 * half * half;
            let added = self.first + self.rest;
            let all = self.nominal + added;
            let v = self.nominal;
            self.rest[a] += cosine_less_one * all[a] - sine * added[b] - sine_less_linear * v[b];
            self.rest[b] += cosine_less_one * all[b] + sine * added[a] + sine_less_linear * v[a];
            self.first[a] -= linear_rad * v[b];
            self.first[b] += linear_rad * v[a];
        }
        if nominal_rad != 0.0 {
            let (sine, cosine) = nominal_rad.sin_cos();
            for vector in [&mut self.nominal, &mut self.first, &mut self.rest] {
                let (x, y) = (vector[a], vector[b]);
                vector[a] = cosine * x - sine * y;
                vector[b] = sine * x + cosine * y;
            }
        }
    }
}

/// sin x − x without cancellation.
fn sine_less_angle(angle_rad: f64) -> f64 {
    /// Below this the series of seven terms is good to the last digit.
    const SMALL_RAD: f64 = 0.5;
    if angle_rad.abs() > SMALL_RAD {
        return angle_rad.sin() - angle_rad;
    }
    let square = angle_rad * angle_rad;
    // −x³/6 (1 − x²/20 (1 − x²/42 (1 − …))), each divisor (2k)(2k + 1)
    let series = (2..8).rev().fold(1.0, |inner, k| 1.0 - square / f64::from((2 * k) * (2 * k + 1)) * inner);
    -angle_rad * square / 6.0 * series
}

/// The vector of the observable with errors: see [`Path::value`].
#[must_use]
pub fn value(chain: &Chain, observable: ObservableId, values: &[f64]) -> Vector3<f64> {
    Path::new(chain, observable).value(values)
}

/// What the errors add to the vector of the observable: see [`Path::error`].
#[must_use]
pub fn error(chain: &Chain, observable: ObservableId, values: &[f64]) -> Vector3<f64> {
    Path::new(chain, observable).error(values)
}

impl Chain {
    /// A value for every symbol, in SI units, indexed by [`SymbolId`]: π, constants at their declared
    /// value, everything else (joints, errors, inputs) at zero.
    #[must_use]
    pub fn nominal_values(&self) -> Vec<f64> {
        let value = |symbol: &crate::Symbol| match symbol.kind {
            SymbolKind::Pi => std::f64::consts::PI,
            // A constant without a value makes whatever depends on it no number.
            SymbolKind::Constant => symbol.value.unwrap_or(f64::NAN),
            _ => symbol.value.unwrap_or(0.0),
        };
        self.symbols.iter().map(value).collect()
    }
}
