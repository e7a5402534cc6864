//! Smooth fall-backs: where a function of one joint or input could sit that no formula of the catalogue is.

use model_core::{Role, SymbolId};

use crate::candidate::{Freedom, Place, Setting};

/// A place in the chain, and what drives the function there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SmoothPlace {
    /// Where.
    pub place: Place,
    /// The joint or input.
    pub driver: SymbolId,
}

/// Every such place of a chain, the likelier first: a joint's own freedom, the others of the body that it moves, the
/// rotations of the other bodies; then ranges along themselves, and inputs at all rotations.
#[must_use]
pub fn smooth(setting: &Setting<'_>) -> Vec<SmoothPlace> {
    let rotations =
        |body| Freedom::rotations().map(move |freedom| Place { body, role: Role::MotionError, freedom });
    let mut all = Vec::new();
    let mut add = |place, driver| {
        let smooth = SmoothPlace { place, driver };
        if setting.moves(place) && !all.contains(&smooth) {
            all.push(smooth);
        }
    };
    for joint in setting.joints() {
        let own = Freedom::ALL.into_iter().map(|freedom| joint.place().with(freedom));
        let others = setting.bodies().into_iter().flat_map(rotations);
        for place in [joint.place()].into_iter().chain(own).chain(others) {
            add(place, joint.symbol);
        }
    }
    for (body, axis, range) in setting.ranges() {
        add(Place { body, role: Role::MotionError, freedom: Freedom::along(axis) }, range);
    }
    for &driver in setting.inputs {
        let places = setting.bodies().into_iter().flat_map(rotations).filter(|&place| setting.moves(place));
        all.extend(places.map(|place| SmoothPlace { place, driver }));
    }
    all
}
