//! Rules about image points: what carries the point, and what the numbers of the camera are made of.

use proc_macro2::Span;

use super::super::Subject;
use super::super::amounts::Purpose;
use super::super::words::GROUND;
use super::bodies::unknown_body;
use crate::mistake::Mistake;
use crate::symbol::SymbolKind;

pub fn image_is_of_another_body(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        let Some(image) = &observe.image else { continue };
        if let Some(frame) = &observe.frame {
            mistakes.push(
                Mistake::new(frame.span(), "an image point is seen in the camera, and in no other frame")
                    .with_help(format!(
                        "leave `in {frame}` out; the body that carries the point is named in the parentheses: `image(px, py, pz of {frame}; …)`"
                    )),
            );
        }
        let Some(target) = image.target.as_ref().filter(|target| *target != GROUND) else { continue };
        if *target == observe.body {
            mistakes.push(
                Mistake::new(target.span(), format!("`{target}` sees its own points always at one place"))
                    .with_help("write the name of another body, or leave it out for a point of the ground"),
            );
        } else if !subject.declaration.bodies().any(|body| body.name == *target) {
            mistakes.push(unknown_body(subject, &target.to_string(), target.span()));
        }
    }
}

pub fn camera_has_numbers(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for amount in &subject.amounts {
        if !matches!(amount.purpose, Purpose::Intrinsic(_)) {
            continue;
        }
        for (name, place) in amount.written.names() {
            let kind = match subject.scope.lookup(name).map(|entry| entry.kind) {
                Some(SymbolKind::Joint) => "joint",
                Some(SymbolKind::SightAngle) => "angle of a line of sight",
                _ => continue,
            };
            mistakes.push(
                Mistake::new(place, format!("the {kind} `{name}` stands in a number of a camera"))
                    .with_help("write numbers, constants, inputs and errors: `fx + dfx`"),
            );
        }
    }
}
