//! The names that ISO 230-1 has for the errors of a slide: E, the letter of what moves (X, Y, Z shifts, A, B, C rotations), the
//! letter of the slide.
//!
//! Source: ISO 230-1:2012, 3.4. A slide has a letter where its joint is called after the axis that it moves along.

use model_core::{Axis, TransformKind};

use super::Name;
use crate::candidate::{Effect, Setting};
use crate::families::{linear_scale, slide};

/// The name of an effect of one slide.
pub(super) fn name(setting: &Setting<'_>, effect: &Effect) -> Option<Name> {
    if ![slide::FAMILY.name, linear_scale::FAMILY.name].contains(&effect.family) {
        return None;
    }
    let joint = setting.joints().into_iter().find(|joint| setting.name(joint.symbol) == effect.driver)?;
    let axis = joint.freedom.axis_name();
    if !effect.driver.eq_ignore_ascii_case(axis) {
        return None;
    }
    let letter = match (effect.place.freedom.kind, effect.place.freedom.axis) {
        (TransformKind::Translation, Axis::X) => 'X',
        (TransformKind::Translation, Axis::Y) => 'Y',
        (TransformKind::Translation, Axis::Z) => 'Z',
        (TransformKind::Rotation, Axis::X) => 'A',
        (TransformKind::Rotation, Axis::Y) => 'B',
        (TransformKind::Rotation, Axis::Z) => 'C',
    };
    Some(Name { field: "ISO 230-1", name: format!("E{letter}{}", axis.to_uppercase()) })
}
