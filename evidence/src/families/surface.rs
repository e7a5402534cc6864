//! Functions of two joints: the product of first harmonics, and a smooth surface.

use super::{Class, Dictionary, Driver, Law, Setting, waves};
use crate::function::Function;

/// Highest order of each joint on a chain of many joints.
const MANY_JOINTS: usize = 2;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    for place in setting.chain_places() {
        for first in setting.joints() {
            for second in setting.joints() {
                let wanted = if setting.few() {
                    setting.turns(place) && first < second
                } else {
                    setting.owns(place, first) && first != second
                };
                if wanted {
                    add(setting, dictionary, place, first, second);
                }
            }
        }
    }
}

fn add(setting: &Setting, dictionary: &mut Dictionary, place: usize, first: usize, second: usize) {
    let highest = if setting.few() { setting.policy.harmonics_surface as usize } else { MANY_JOINTS };
    let driver = Driver::Joints(first, second);
    let products = |n: usize, m: usize| {
        waves(first, n).into_iter().flat_map(move |a| waves(second, m).map(move |b| Function::Product(a, b)))
    };
    let product = products(1, 1).map(|function| (function, 1.0)).collect();
    dictionary.add((Class::Simple, Law::Product), place, driver, product, setting.policy.price_product);
    let mut functions = vec![(Function::One, 1.0)];
    for joint in [first, second] {
        for order in 1..=highest {
            let deviation = (order as f64).powi(-2);
            functions.extend(waves(joint, order).map(|wave| (Function::Wave(wave), deviation)));
        }
    }
    for n in 1..=highest {
        for m in 1..=highest {
            let deviation = 2.0 / (n * n + m * m) as f64;
            functions.extend(products(n, m).map(|function| (function, deviation)));
        }
    }
    dictionary.add((Class::Surface, Law::Surface), place, driver, functions, 0.0);
}
