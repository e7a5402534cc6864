//! Rules about the amounts of factors.

use std::collections::BTreeSet;

use proc_macro2::Span;

use super::super::Subject;
use super::super::amounts::{Amount, Purpose};
use super::super::words::is_reserved;
use super::names::unknown_name;
use crate::algebra::{AngleSum, Poly};
use crate::chain::{Role, TransformKind};
use crate::mistake::Mistake;
use crate::names::nearest;
use crate::symbol::{Quantity, SymbolId, SymbolKind};

pub fn names_are_declared(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for amount in &subject.amounts {
        let mut arguments = Vec::new();
        amount.written.arguments(&mut arguments);
        let turned: BTreeSet<&str> =
            arguments.iter().flat_map(|argument| argument.names()).map(|(name, _)| name).collect();
        let turns = matches!(amount.purpose, Purpose::Factor { kind: TransformKind::Rotation, .. });
        for (name, place) in amount.written.names() {
            if subject.scope.find(name).is_none() && !is_reserved(name) {
                let value = if turns || turned.contains(name) { "angle = pi/6" } else { "length = 0.25" };
                let otherwise = format!("declare it: `const {name}: {value};` or `input {name};`");
                mistakes.push(unknown_name(subject, name, place, &otherwise));
            }
        }
    }
}

pub fn functions_of_angles(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for amount in &subject.amounts {
        let mut arguments = Vec::new();
        amount.written.arguments(&mut arguments);
        for argument in arguments {
            for (name, place) in argument.names() {
                let Some(id) = subject.scope.find(name) else { continue };
                if !subject.scope.is_angle(id) {
                    mistakes.push(no_angle(subject, id, place));
                }
            }
        }
    }
}

fn no_angle(subject: &Subject<'_>, id: SymbolId, place: Span) -> Mistake<Span> {
    let entry = subject.scope.entry(id);
    let name = &entry.name;
    let angles = subject
        .scope
        .entries()
        .iter()
        .filter(|other| other.kind != SymbolKind::Error && other.quantity == Some(Quantity::Angle));
    match entry.kind {
        SymbolKind::Error => {
            let help = match nearest(name, angles.map(|angle| angle.name.as_str())) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "write a phase as two errors: `a*cos(q) + b*sin(q)`".to_owned(),
            };
            Mistake::new(place, format!("the error `{name}` stands inside a sine or cosine")).with_help(help)
        }
        SymbolKind::Joint => {
            Mistake::new(place, format!("the joint `{name}` is a length, and stands inside a sine or cosine"))
                .with_help("take sines and cosines of angles")
        }
        SymbolKind::Constant => {
            Mistake::new(place, format!("`{name}` is no angle, and stands inside a sine or cosine"))
                .with_help(format!("declare it as an angle: `const {name}: angle = …;`"))
        }
        SymbolKind::Pi | SymbolKind::Input | SymbolKind::Ramp | SymbolKind::SightAngle => {
            Mistake::new(place, format!("`{name}` is no angle, and stands inside a sine or cosine"))
                .with_help(format!("declare it as an angle: `input {name}: angle;`"))
        }
    }
}

/// The amounts of factors of one role.
fn factors_of<'a, 's>(
    subject: &'s Subject<'a>,
    wanted: impl Fn(Role) -> bool,
) -> impl Iterator<Item = (&'s Amount<'a>, TransformKind)> {
    subject.amounts.iter().filter_map(move |amount| match amount.purpose {
        Purpose::Factor { role, kind, .. } if wanted(role) => Some((amount, kind)),
        _ => None,
    })
}

pub fn position_is_constant(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for (amount, kind) in factors_of(subject, |role| role == Role::Position) {
        for (name, place) in amount.written.names() {
            let Some(entry) = subject.scope.lookup(name) else { continue };
            let (what, help) = match entry.kind {
                SymbolKind::Pi | SymbolKind::Constant => continue,
                SymbolKind::Ramp => unreachable!("no name that can be written is that of a ramp"),
                SymbolKind::Joint => {
                    ("joint", "write factors with joints in `motion`, or in `motion_error`".to_owned())
                }
                SymbolKind::Input => {
                    ("input", "write factors with inputs in `position_error` or `motion_error`".to_owned())
                }
                SymbolKind::SightAngle => {
                    ("angle of a line of sight", "write factors with it in `motion_error`".to_owned())
                }
                SymbolKind::Error => {
                    let quantity = match kind {
                        TransformKind::Rotation => "angle",
                        TransformKind::Translation => "length",
                    };
                    (
                        "error",
                        format!(
                            "write the factor in `position_error`, or declare `const {name}: {quantity} = …;`"
                        ),
                    )
                }
            };
            mistakes.push(
                Mistake::new(place, format!("the {what} `{name}` stands in a position")).with_help(help),
            );
        }
    }
}

pub fn position_turns_by_angles(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for (amount, _) in factors_of(subject, |role| role == Role::Position)
        .filter(|(_, kind)| *kind == TransformKind::Rotation)
    {
        let Some(value) = &amount.value else { continue };
        let is_constant = value
            .symbols()
            .iter()
            .all(|&id| matches!(subject.scope.entry(id).kind, SymbolKind::Pi | SymbolKind::Constant));
        if is_constant && !is_angle_sum(subject, value) {
            mistakes.push(
                Mistake::new(
                    amount.written.place,
                    "a position turns by numbers and by whole multiples of constant angles only",
                )
                .with_help("declare any other angle: `const tilt: angle = pi/6;`, and write `tilt` here"),
            );
        }
    }
}

/// Whether a sine can be taken of an amount.
fn is_angle_sum(subject: &Subject<'_>, value: &Poly) -> bool {
    AngleSum::from_poly(value)
        .is_ok_and(|sum| sum.multiples().iter().all(|&(id, _)| subject.scope.is_angle(id)))
}

pub fn motion_is_linear(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for (amount, kind) in factors_of(subject, |role| role == Role::Motion) {
        let mut is_moved = false;
        let mut has_input = false;
        for (name, place) in amount.written.names() {
            match subject.scope.lookup(name).map(|entry| entry.kind) {
                Some(SymbolKind::Joint) => is_moved = true,
                Some(SymbolKind::SightAngle) => {
                    has_input = true;
                    let message = format!("the angle of a line of sight `{name}` stands in a motion");
                    mistakes.push(
                        Mistake::new(place, message).with_help("write factors with it in `motion_error`"),
                    );
                }
                Some(SymbolKind::Input) => {
                    has_input = true;
                    mistakes.push(
                        Mistake::new(place, format!("the input `{name}` stands in a motion")).with_help(format!(
                            "a motion makes a joint of the names in it: remove `input {name};`, or write the factor in `motion_error`"
                        )),
                    );
                }
                _ => {}
            }
        }
        let place = amount.written.place;
        if has_input {
            continue;
        }
        if !is_moved {
            mistakes.push(
                Mistake::new(place, "nothing moves this motion")
                    .with_help("write a joint in it: `Rz(alpha)`; or write the factor in `position`"),
            );
            continue;
        }
        let Some(value) = &amount.value else { continue };
        let is_joint = |id: SymbolId| subject.scope.entry(id).kind == SymbolKind::Joint;
        let is_linear = match kind {
            TransformKind::Rotation => is_angle_sum(subject, value),
            TransformKind::Translation => {
                let joints = value.symbols().into_iter().filter(|&id| is_joint(id));
                value.degree_in(is_joint) <= 1
                    && value.symbols().iter().all(|&id| subject.scope.entry(id).kind != SymbolKind::Ramp)
                    && joints.into_iter().all(|joint| value.derivative(joint).as_constant().is_some())
            }
        };
        if !is_linear {
            let (what, help) = match kind {
                TransformKind::Rotation => (
                    "a motion turns by whole multiples of joints, by constant angles and by numbers only",
                    "write `Rz(alpha)`, `Rz(-alpha)` or `Rx(alpha - pi/2)`; what depends on a joint otherwise belongs in `motion_error`",
                ),
                TransformKind::Translation => (
                    "a motion shifts by numbers times joints, and constants, only",
                    "write `Tx(travel)` or `Tx(travel + offset)`; what depends on a joint otherwise belongs in `motion_error`",
                ),
            };
            mistakes.push(Mistake::new(place, what).with_help(help));
        }
    }
}

pub fn error_vanishes(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    let is_error_role = |role| matches!(role, Role::PositionError | Role::MotionError);
    for (amount, _) in factors_of(subject, is_error_role) {
        let Some(value) = &amount.value else { continue };
        let without_errors = value.graded_part(|id| subject.scope.is_error(id), 0);
        if !without_errors.is_zero() {
            mistakes.push(
                Mistake::new(amount.written.place, "this amount does not vanish when every error is zero")
                    .with_help("multiply every term by an error: `sag*cos(beta)`; write what is there by design in `position` or `motion`"),
            );
        }
    }
}
