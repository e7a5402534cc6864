//! Smooth functions of a joint: a constant and harmonics as one family, one for each spectrum.

use super::{Class, Dictionary, Driver, Law, Setting, waves};
use crate::function::Function;
use crate::policy::LENGTHS_RAD;

/// Highest order of a smooth function on a chain of many joints.
const MANY_JOINTS: usize = 10;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    let highest = if setting.few() { setting.policy.harmonics_smooth as usize } else { MANY_JOINTS };
    for place in setting.chain_places() {
        for joint in setting.joints() {
            let near = setting.turns(place) && (setting.few() || setting.beside(place, joint));
            if near || (!setting.few() && setting.is_axis(place)) {
                let steep = spectrum(joint, highest, |n| n.max(1.0).powi(-2));
                dictionary.add((Class::Smooth, Law::Smooth(0)), place, Driver::Joint(joint), steep, 0.0);
            }
            if near {
                let flat = spectrum(joint, highest, |n| n.max(1.0).powi(-1));
                dictionary.add((Class::Rough, Law::Smooth(1)), place, Driver::Joint(joint), flat, 0.0);
                for (length, number) in LENGTHS_RAD.into_iter().zip(2..) {
                    let bell = spectrum(joint, highest, |n| (-0.25 * (n * length).powi(2)).exp());
                    dictionary.add(
                        (Class::Rough, Law::Smooth(number)),
                        place,
                        Driver::Joint(joint),
                        bell,
                        0.0,
                    );
                }
            }
        }
    }
}

/// A constant (order 0) and waves with the standard deviation of each order.
fn spectrum(joint: usize, highest: usize, deviation: impl Fn(f64) -> f64) -> Vec<(Function, f64)> {
    let mut functions = vec![(Function::One, deviation(0.0))];
    for order in 1..=highest {
        functions.extend(waves(joint, order).map(|wave| (Function::Wave(wave), deviation(order as f64))));
    }
    functions
}
