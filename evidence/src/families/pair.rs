//! Harmonics of a joint at a place, each order by itself, and tilts that whirl with a joint.

use super::{Class, Dictionary, Driver, Family, Law, Setting, Where, waves};
use crate::function::Function;

/// Orders at a place beside the joint or on another axis, of a chain of many joints.
const BESIDE: usize = 4;
/// Orders at any other rotation of such a chain.
const FAR: usize = 2;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    for place in setting.chain_places() {
        for joint in setting.joints() {
            for order in 1..=orders(setting, place, joint) {
                let functions = waves(joint, order).map(|wave| (Function::Wave(wave), 1.0)).to_vec();
                let law = (Class::Pair, Law::Harmonic(order));
                let extra = setting.policy.of_order(order);
                dictionary.add(law, place, Driver::Joint(joint), functions, extra);
            }
        }
    }
    whirls(setting, dictionary);
}

fn orders(setting: &Setting, place: usize, joint: usize) -> usize {
    if setting.owns(place, joint) {
        setting.policy.harmonics_own as usize
    } else if setting.few() {
        if setting.turns(place) { setting.policy.harmonics as usize } else { 0 }
    } else if setting.beside(place, joint) || setting.is_axis(place) {
        BESIDE
    } else if setting.turns(place) {
        FAR
    } else {
        0
    }
}

fn whirls(setting: &Setting, dictionary: &mut Dictionary) {
    let orders = if setting.few() { BESIDE } else { FAR };
    for frame in &setting.places.frames {
        let Some((joint, [x, y])) = frame.whirl else { continue };
        for order in 1..=orders {
            let [cos, sin] = waves(joint, order);
            for backward in [false, true] {
                let signed =
                    |wave, minus: bool| if minus { Function::MinusWave(wave) } else { Function::Wave(wave) };
                let first = vec![(x, Function::Wave(cos)), (y, signed(sin, backward))];
                let second = vec![(x, signed(sin, !backward)), (y, Function::Wave(cos))];
                let sense = if backward { -(order as i32) } else { order as i32 };
                let columns = vec![dictionary.column(first), dictionary.column(second)];
                dictionary.push(Family {
                    class: Class::Pair,
                    place: Where::Tilts(frame.frame),
                    driver: Driver::Joint(joint),
                    law: Law::Whirl(sense),
                    columns,
                    relative: vec![1.0; 2],
                    extra: setting.policy.harmonic_low * (order as f64).ln(),
                    price: 0.0,
                });
            }
        }
    }
}
