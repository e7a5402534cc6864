//! Gravity: sag of a place with the direction of down in its frame, and compliance of joints under the masses behind them.

use super::{Class, Dictionary, Driver, Law, Setting};
use crate::function::Function;

pub(super) fn offer(setting: &Setting, dictionary: &mut Dictionary) {
    for place in setting.chain_places() {
        if setting.gravity[place] && setting.turns(place) {
            let down = (0..3).map(|component| (Function::Gravity(component), 1.0)).collect();
            dictionary.add((Class::Simple, Law::Gravity), place, Driver::Gravity, down, 0.0);
        }
        let loads = &setting.loads[place];
        for &load in loads {
            let torque = vec![(Function::Torque(load), 1.0)];
            dictionary.add((Class::Simple, Law::Compliance(load)), place, Driver::Gravity, torque, 0.0);
        }
        if loads.len() > 1 {
            let torques = loads.iter().map(|&load| (Function::Torque(load), 1.0)).collect();
            let all = (Class::Simple, Law::AllLoads);
            dictionary.add(all, place, Driver::Gravity, torques, setting.policy.price_order);
        }
    }
}
