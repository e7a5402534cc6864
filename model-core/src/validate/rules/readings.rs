//! Rules about what is read of an observable, and in whose frame.

use proc_macro2::Span;

use super::super::Subject;
use super::super::words::{self, AXES, GROUND, OBSERVABLE_KINDS, meaning};
use super::bodies::unknown_body;
use crate::chain::ObservableKind;
use crate::chain::reading::{Measures, Reading, WORDS};
use crate::mistake::Mistake;
use crate::names::nearest;
use crate::syntax::ORIENTATION;
use crate::syntax::declaration::{ObserveStatement, ReadingTerm};

/// As many numbers as a vector has.
const MOST_READINGS: usize = 3;

pub fn readings_are_known(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        for (index, written) in observe.readings.iter().enumerate() {
            let again = observe.readings[..index].iter().any(|other| other.word == written.word);
            if again {
                mistakes.push(
                    Mistake::new(written.word.span(), format!("`{}` is read twice", written.word))
                        .with_help("its word names it in every output: declare a second observable"),
                );
            } else if let Some(mistake) = mistake_in(observe, written) {
                mistakes.push(mistake);
            }
        }
        if let Some(fourth) = observe.readings.get(MOST_READINGS) {
            mistakes.push(
                Mistake::new(fourth.word.span(), "an observable shows at most three numbers")
                    .with_help("declare a second observable for the others"),
            );
        }
    }
}

/// What is wrong with one reading.
fn mistake_in(observe: &ObserveStatement, written: &ReadingTerm) -> Option<Mistake<Span>> {
    let word = written.word.to_string();
    let place = written.word.span();
    let Some(reading) = Reading::of_word(&word) else {
        let known = || WORDS.iter().map(|reading| reading.word);
        let help = match nearest(&word, known()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("write one of {}", known().collect::<Vec<_>>().join(", ")),
        };
        return Some(Mistake::new(place, format!("unknown reading `{word}`")).with_help(help));
    };
    match (reading.rotation().is_some(), observe.kind == ORIENTATION) {
        (true, false) => {
            return Some(
                Mistake::new(place, format!("a {} has no `{word}`", observe.kind))
                    .with_help(format!("write `{word} of orientation of body`")),
            );
        }
        (false, true) => {
            return Some(
                Mistake::new(place, format!("an orientation has no `{word}`")).with_help(
                    "write `rotation_x, rotation_y, rotation_z`, or observe a direction: `direction(0, 0, 1) of body`",
                ),
            );
        }
        _ => {}
    }
    let is_direction = meaning(&OBSERVABLE_KINDS, &observe.kind) == Some(ObservableKind::Direction);
    if reading.measures == Measures::Range && is_direction {
        return Some(
            Mistake::new(place, "a direction has no range")
                .with_help("write `range of point(0, 0, 0) of body`"),
        );
    }
    let axes = written.axes.as_ref()?;
    if reading.axes() == 0 {
        return Some(
            Mistake::new(place, format!("`{word}` takes no axes")).with_help(format!("write `{word}`")),
        );
    }
    if let Some(unknown) = axes.iter().find(|axis| meaning(&AXES, &axis.axis).is_none()) {
        let message = format!("unknown axis `{}`", unknown.axis);
        return Some(
            Mistake::new(unknown.axis.span(), message).with_help("write one of x, y, z, -x, -y, -z"),
        );
    }
    if words::reading(written).is_some() {
        return None;
    }
    Some(match reading.axes() {
        1 => Mistake::new(place, format!("`{word}` takes one axis, where it points to"))
            .with_help(format!("write `{word}(z)`")),
        _ => Mistake::new(
            place,
            format!("`{word}` takes two different axes: where it is zero, and which way it turns"),
        )
        .with_help(format!("write `{word}(x, y)`: 0 along x, a quarter turn along y")),
    })
}

pub fn frame_exists(subject: &Subject<'_>, mistakes: &mut Vec<Mistake<Span>>) {
    for observe in subject.declaration.observables() {
        let Some(frame) = &observe.frame else { continue };
        if *frame == GROUND {
            continue;
        }
        if *frame == observe.body {
            mistakes.push(
                Mistake::new(frame.span(), format!("`{frame}` never moves in its own frame"))
                    .with_help("write the name of another body"),
            );
        } else if !subject.declaration.bodies().any(|body| body.name == *frame) {
            mistakes.push(unknown_body(subject, &frame.to_string(), frame.span()));
        }
    }
}
