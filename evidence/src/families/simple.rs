//! Simple laws: a constant, a scale, the cotangent or tangent of a joint measured from the horizon.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Class, Dictionary, Driver, Law, Setting};
use crate::function::Function;

/// Relative standard deviation of the constant beside a scale: the scale's zero need not be the joint's.
const CONSTANT_BESIDE_SCALE: f64 = 0.547_722_557_505_166_1;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    for place in setting.chain_places() {
        dictionary.add(
            (Class::Simple, Law::Constant),
            place,
            Driver::Nothing,
            vec![(Function::One, 1.0)],
            0.0,
        );
        for joint in setting.joints().filter(|&joint| setting.owns(place, joint)) {
            let driver = Driver::Joint(joint);
            let scale = vec![(Function::Linear(joint), 1.0), (Function::One, CONSTANT_BESIDE_SCALE)];
            dictionary.add((Class::Simple, Law::Scale), place, driver, scale, 0.0);
            match from_horizon(setting, joint) {
                Some(Law::Cot) => {
                    let functions = vec![(Function::Cot(joint), 1.0), (Function::One, 1.0)];
                    dictionary.add((Class::Simple, Law::Cot), place, driver, functions, 0.0);
                }
                Some(law) => {
                    dictionary.add(
                        (Class::Simple, law),
                        place,
                        driver,
                        vec![(Function::Tan(joint), 1.0)],
                        0.0,
                    );
                }
                None => {}
            }
        }
    }
}

/// Cotangent or tangent: whichever has no pole in the rows.
fn from_horizon(setting: &Setting, joint: usize) -> Option<Law> {
    let joint = &setting.rows.joints[joint];
    let margin = setting.policy.cot_margin;
    if !joint.from_horizon {
        None
    } else if joint.values.iter().all(|&at| at > margin && at < PI - margin) {
        Some(Law::Cot)
    } else if joint.values.iter().all(|at| at.abs() < FRAC_PI_2 - margin) {
        Some(Law::Tan)
    } else {
        None
    }
}
