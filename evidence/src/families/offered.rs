//! Effects of the caller's catalogue: functions that came with the rows, at one place or several at once.

use super::{Class, Dictionary, Family, Law, Where};
use crate::function::Function;
use crate::places::Places;
use crate::policy::Policy;
use crate::problem::Problem;

pub(super) fn offer(problem: &Problem, places: &Places, policy: &Policy, dictionary: &mut Dictionary) {
    for (number, effect) in problem.offered.iter().enumerate() {
        let Some(place) = places.stands_for[effect.place] else { continue };
        let mut columns = Vec::with_capacity(effect.columns.len());
        for terms in &effect.columns {
            let seen = terms.iter().filter_map(|&(at, function)| {
                Some((places.stands_for[at]?, Function::Given(function, places.factor[at])))
            });
            let terms: Vec<(usize, Function)> = seen.collect();
            if !terms.is_empty() {
                columns.push(dictionary.column(terms));
            }
        }
        if columns.is_empty() {
            continue;
        }
        let (class, extra) = match effect.order {
            None => (Class::Simple, 0.0),
            Some(order) => (Class::Pair, policy.of_order(order)),
        };
        dictionary.push(Family {
            class,
            place: Where::Place(place),
            driver: effect.driver,
            law: Law::Offered(number),
            relative: vec![1.0; columns.len()],
            columns,
            extra,
            price: 0.0,
        });
    }
}
