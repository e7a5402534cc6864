//! Functions of a row that a family multiplies a place's column with.

use std::f64::consts::PI;

use crate::problem::{Place, Rows};
use crate::shape::Shape;

/// Sine or cosine of a whole multiple of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// The joint.
    pub joint: usize,
    /// How often it repeats in a turn.
    pub order: usize,
    /// Sine, not cosine.
    pub sine: bool,
}

/// The range of an input in the rows that a dictionary was made for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The input.
    pub input: usize,
    /// Its mean.
    pub mean: f64,
    /// The middle of its range.
    pub middle: f64,
    /// Half of its range.
    pub half: f64,
}

/// A function of a row.
#[derive(Debug, Clone, PartialEq)]
pub enum Function {
    /// One in each row.
    One,
    /// The joint itself.
    Linear(usize),
    /// A wave of a joint.
    Wave(Wave),
    /// A wave with its sign turned.
    MinusWave(Wave),
    /// The product of waves of two joints.
    Product(Wave, Wave),
    /// Cotangent of a joint measured from the horizon.
    Cot(usize),
    /// Tangent of a joint measured from the horizon.
    Tan(usize),
    /// Direction of motion of a joint.
    Direction(usize),
    /// Direction of motion of a joint times a wave.
    DirectionWave(Wave),
    /// An input, less its mean, over half of its range.
    Input(Span),
    /// A cosine of so many half periods over the range of an input.
    InputCosine(Span, usize),
    /// One behind a part of the range of an input.
    InputStep(Span, f64),
    /// One behind a part of the order of the rows, with mean zero over the rows.
    OrderStep(f64),
    /// One in the rows of a session, less the mean over all rows.
    Label(usize),
    /// One in the rows of a stretch of the order (from, to), less the mean over all rows.
    Stretch(usize, usize),
    /// A component of gravity in the place's frame.
    Gravity(usize),
    /// The torque of a load of the place.
    Torque(usize),
    /// A shape over a joint.
    Shape(usize, Shape),
    /// Change of a shape by its position: the joint, the shape, half of the step.
    ShapeMoved(usize, Shape, f64),
    /// Change of a shape by its width.
    ShapeWidened(usize, Shape),
    /// A function that came with the rows, times a factor.
    Given(usize, f64),
}

impl Function {
    /// Whether the function is known only for the rows that it was made for.
    #[must_use]
    pub fn of_these_rows(&self) -> bool {
        matches!(self, Self::OrderStep(_) | Self::Label(_) | Self::Stretch(..))
    }

    /// Whether its values differ from place to place.
    #[must_use]
    pub fn of_the_place(&self) -> bool {
        matches!(self, Self::Gravity(_) | Self::Torque(_))
    }

    /// The value in each row. Zero where the rows lack what the function reads.
    #[must_use]
    pub fn values(&self, rows: &Rows, place: &Place) -> Vec<f64> {
        let over = |joint: usize, value: &dyn Fn(f64) -> f64| -> Vec<f64> {
            rows.joints[joint].values.iter().map(|&at| value(at)).collect()
        };
        let directed =
            |joint: usize| rows.joints[joint].direction.clone().unwrap_or_else(|| vec![0.0; rows.count]);
        let scaled = |span: &Span, value: &dyn Fn(f64) -> f64| -> Vec<f64> {
            rows.inputs[span.input].values.iter().map(|&at| value(at)).collect()
        };
        match self {
            Self::One => vec![1.0; rows.count],
            Self::Linear(joint) => rows.joints[*joint].values.clone(),
            Self::Wave(wave) => over(wave.joint, &|at| wave.at(at)),
            Self::MinusWave(wave) => over(wave.joint, &|at| -wave.at(at)),
            Self::Product(first, second) => {
                let (a, b) = (&rows.joints[first.joint].values, &rows.joints[second.joint].values);
                a.iter().zip(b).map(|(&a, &b)| first.at(a) * second.at(b)).collect()
            }
            Self::Cot(joint) => over(*joint, &|at| at.tan().recip()),
            Self::Tan(joint) => over(*joint, &f64::tan),
            Self::Direction(joint) => directed(*joint),
            Self::DirectionWave(wave) => {
                let values = &rows.joints[wave.joint].values;
                directed(wave.joint).iter().zip(values).map(|(sign, &at)| sign * wave.at(at)).collect()
            }
            Self::Input(span) => scaled(span, &|at| (at - span.mean) / span.half),
            Self::InputCosine(span, order) => scaled(span, &|at| {
                // Beyond a fifth of the half range the function stays as it is there.
                let within = ((at - span.middle) / span.half).clamp(-1.2, 1.2);
                (PI * *order as f64 * (within + 1.0) / 2.0).cos()
            }),
            Self::InputStep(span, part) => {
                scaled(span, &|at| f64::from((at - span.middle) / span.half > 2.0 * part - 1.0))
            }
            Self::OrderStep(part) => {
                let count = rows.count as f64;
                let step: Vec<f64> =
                    (0..rows.count).map(|row| f64::from(row as f64 / count >= *part)).collect();
                let mean = step.iter().sum::<f64>() / count;
                step.iter().map(|value| value - mean).collect()
            }
            // About their mean: what all rows share is no difference between set-ups.
            Self::Label(label) => match &rows.labels {
                Some(labels) => about_mean(labels.iter().map(|own| own == label).collect()),
                None => vec![0.0; rows.count],
            },
            Self::Stretch(from, to) => {
                about_mean((0..rows.count).map(|row| (*from..*to).contains(&row)).collect())
            }
            Self::Gravity(component) => {
                place.gravity.as_ref().map_or_else(|| vec![0.0; rows.count], |down| down[*component].clone())
            }
            Self::Torque(load) => {
                place.loads.get(*load).map_or_else(|| vec![0.0; rows.count], |load| load.torque.clone())
            }
            Self::Given(number, factor) => match rows.given.get(*number) {
                Some(values) => values.iter().map(|value| factor * value).collect(),
                None => vec![0.0; rows.count],
            },
            Self::Shape(joint, shape) => over(*joint, &|at| shape.at(at)),
            Self::ShapeMoved(joint, shape, step) => {
                let (ahead, behind) = (shape.moved(*step), shape.moved(-step));
                over(*joint, &|at| (ahead.at(at) - behind.at(at)) / 2.0)
            }
            Self::ShapeWidened(joint, shape) => {
                let (wide, narrow) = (shape.widened(1.2), shape.widened(1.0 / 1.2));
                over(*joint, &|at| (wide.at(at) - narrow.at(at)) / 2.0)
            }
        }
    }
}

/// One where it holds and zero elsewhere, less the mean.
fn about_mean(holds: Vec<bool>) -> Vec<f64> {
    let share = holds.iter().filter(|own| **own).count() as f64 / holds.len().max(1) as f64;
    holds.into_iter().map(|own| f64::from(own) - share).collect()
}

impl Wave {
    fn at(self, angle: f64) -> f64 {
        let phase = self.order as f64 * angle;
        if self.sine { phase.sin() } else { phase.cos() }
    }
}

impl Span {
    /// The range of an input over some rows.
    #[must_use]
    pub fn of(rows: &Rows, input: usize) -> Self {
        let values = &rows.inputs[input].values;
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        // A constant input has no range; its functions come out constant and are absorbed.
        let half = if high > low { (high - low) / 2.0 } else { 1.0 };
        Self { input, mean, middle: f64::midpoint(low, high), half }
    }
}
