//! Functions of inputs and time, of a measured range among them.

use super::{Class, Dictionary, Driver, Law, Setting};
use crate::function::{Function, Span};

/// Cosines of a smooth function of an input.
const COSINES: usize = 6;
/// Parts of the range of time at whose ends a step may be.
const DATES: usize = 48;
/// Relative standard deviation of the constant beside a linear function about its mean.
const CONSTANT_BESIDE_LINEAR: f64 = 0.316_227_766_016_837_94;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    for place in 0..setting.places.distinct.len() {
        let of_range = setting.places.distinct[place].is_range;
        if of_range {
            dictionary.add(
                (Class::Simple, Law::Constant),
                place,
                Driver::Nothing,
                vec![(Function::One, 1.0)],
                0.0,
            );
        } else if !setting.turns(place) {
            continue;
        }
        for (input, given) in setting.rows.inputs.iter().enumerate() {
            let (driver, span) = (Driver::Input(input), Span::of(setting.rows, input));
            let linear = vec![(Function::Input(span), 1.0), (Function::One, CONSTANT_BESIDE_LINEAR)];
            dictionary.add((Class::Simple, Law::Linear), place, driver, linear, 0.0);
            let mut smooth = vec![(Function::One, 1.0), (Function::Input(span), 1.0)];
            smooth.extend((1..=COSINES).map(|n| (Function::InputCosine(span, n), (n as f64).powi(-2))));
            dictionary.add((Class::Smooth, Law::Smooth(0)), place, driver, smooth, 0.0);
            if given.is_time {
                for date in 1..DATES {
                    let part = date as f64 / DATES as f64;
                    // The constant lets the declared errors be what they are on either side of the step.
                    let step = vec![(Function::InputStep(span, part), 1.0), (Function::One, 1.0)];
                    dictionary.add((Class::Step, Law::StepAt(part)), place, driver, step, 0.0);
                }
            }
        }
    }
}
