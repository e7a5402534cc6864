//! The rules of the language: one function each, one line each in [`RULES`].

mod amounts;
mod bodies;
mod factors;
mod images;
mod names;
mod observables;
mod quantities;
mod ramps;
mod readings;
mod sight;

use proc_macro2::Span;

use super::Subject;
use crate::mistake::Mistake;

/// A rule looks at the whole declaration and reports every place that breaks it.
pub type Rule = fn(&Subject<'_>, &mut Vec<Mistake<Span>>);

/// Every rule of the language, with the sentence that it enforces.
pub const RULES: &[(&str, Rule)] = &[
    ("a name is not a word that means something else", names::not_reserved),
    ("a name is declared once", names::declared_once),
    ("a printed form is given to a name that exists", names::printed_names_exist),
    ("a body hangs on a body that exists", bodies::lower_body_exists),
    ("no body hangs on itself", bodies::hangs_on_ground),
    ("a list of factors has one of the four roles", factors::role_is_known),
    ("a factor is one of the six elementary transforms", factors::axis_is_known),
    ("an amount uses declared names", amounts::names_are_declared),
    ("sines and cosines are taken of angles", amounts::functions_of_angles),
    ("a ramp is of a joint or input, between thresholds", ramps::ramp_has_its_parts),
    ("a position is made of constants", amounts::position_is_constant),
    ("a position turns by angles", amounts::position_turns_by_angles),
    ("a motion is moved by joints, linearly", amounts::motion_is_linear),
    ("an error vanishes with its symbols", amounts::error_vanishes),
    ("a quantity is an angle or a length, a meaning one of a list", quantities::quantity_is_known),
    ("a direction is of a joint, a phase of a length", quantities::meaning_is_of_what_it_can_be_of),
    ("a constant has a finite value", quantities::constant_has_a_value),
    ("a symbol measures one thing", quantities::one_quantity_each),
    ("an observable is a direction or a point", observables::kind_is_known),
    ("an observable belongs to a body that exists", observables::body_exists),
    ("an observable shows readings that fit it, each once", readings::readings_are_known),
    ("an observable is seen in the frame of another body", readings::frame_exists),
    ("an observable is made of constants and inputs", observables::components_are_known),
    ("a camera has numbers of its own, and sees what it does not carry", images::image_is_of_another_body),
    ("a camera's numbers are constants, inputs and errors", images::camera_has_numbers),
    ("a direction has a length", observables::direction_is_not_zero),
    ("an angle is between an observed direction and up", sight::angle_is_from_up),
    ("what is bent up is a direction, by errors", sight::direction_is_bent_by_errors),
    ("gravity is declared once, as a direction", observables::gravity_is_a_direction),
];
