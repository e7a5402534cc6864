//! Direction of motion: backlash, and play that depends on the angle.

use super::{Class, Dictionary, Driver, Law, Setting, waves};
use crate::function::Function;

/// Highest order of play that is a smooth function of the angle.
const ORDERS: usize = 4;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    for place in setting.chain_places() {
        for joint in setting.joints().filter(|&joint| setting.rows.joints[joint].direction.is_some()) {
            let driver = Driver::Joint(joint);
            if !setting.turns(place) || !(setting.few() || setting.beside(place, joint)) {
                continue;
            }
            let sense = (Function::Direction(joint), 1.0);
            dictionary.add((Class::Simple, Law::Direction), place, driver, vec![sense.clone()], 0.0);
            if setting.owns(place, joint) {
                let first = waves(joint, 1).map(|wave| (Function::DirectionWave(wave), 1.0)).to_vec();
                let play = (Class::Simple, Law::DirectionHarmonic);
                dictionary.add(play, place, driver, first, setting.policy.price_step);
                if setting.few() {
                    let mut functions = vec![sense];
                    for order in 1..=ORDERS {
                        let deviation = (order as f64).powi(-2);
                        functions.extend(
                            waves(joint, order).map(|wave| (Function::DirectionWave(wave), deviation)),
                        );
                    }
                    dictionary.add((Class::Smooth, Law::DirectionSmooth), place, driver, functions, 0.0);
                }
            }
        }
    }
}
