//! The words of the language, and what each stands for.

use proc_macro2::Ident;

use crate::chain::reading::{Reading, SignedAxis};
use crate::chain::{Axis, ObservableKind, Role, TransformKind};
use crate::names::nearest;
use crate::symbol::Quantity;
use crate::syntax::declaration::{AxisTerm, ReadingTerm};

/// The body that is not declared: what the instrument stands on.
pub const GROUND: &str = "ground";

/// The roles of factors.
pub const ROLES: [(&str, Role); 4] = [
    ("position", Role::Position),
    ("position_error", Role::PositionError),
    ("motion", Role::Motion),
    ("motion_error", Role::MotionError),
];

/// The elementary transforms.
pub const TRANSFORMS: [(&str, (TransformKind, Axis)); 6] = [
    ("Rx", (TransformKind::Rotation, Axis::X)),
    ("Ry", (TransformKind::Rotation, Axis::Y)),
    ("Rz", (TransformKind::Rotation, Axis::Z)),
    ("Tx", (TransformKind::Translation, Axis::X)),
    ("Ty", (TransformKind::Translation, Axis::Y)),
    ("Tz", (TransformKind::Translation, Axis::Z)),
];

/// The kinds of observables; like a direction, an orientation is not moved by shifts. An image is of a point.
pub const OBSERVABLE_KINDS: [(&str, ObservableKind); 4] = [
    ("direction", ObservableKind::Direction),
    ("point", ObservableKind::Point),
    (crate::syntax::ORIENTATION, ObservableKind::Direction),
    (crate::syntax::IMAGE, ObservableKind::Point),
];

/// The axes that readings are told by.
pub const AXES: [(&str, Axis); 3] = [("x", Axis::X), ("y", Axis::Y), ("z", Axis::Z)];

/// What a reading as written means; `None` if its word, or its axes, mean nothing.
pub fn reading(written: &ReadingTerm) -> Option<Reading> {
    let reading = Reading::of_word(&written.word.to_string())?;
    let Some(axes) = &written.axes else { return Some(reading) };
    let axis = |term: &AxisTerm| {
        meaning(&AXES, &term.axis).map(|axis| SignedAxis { axis, is_negative: term.is_negative })
    };
    reading.with_axes(&axes.iter().map(axis).collect::<Option<Vec<_>>>()?)
}

/// The quantities that constants may state.
pub const QUANTITIES: [(&str, Quantity); 2] = [("angle", Quantity::Angle), ("length", Quantity::Length)];

/// What a word stands for.
pub fn meaning<T: Copy>(words: &[(&str, T)], word: &Ident) -> Option<T> {
    words.iter().find(|(known, _)| word == known).map(|(_, meaning)| *meaning)
}

/// The role that a word stands for, or most likely should.
pub fn likely_role(word: &Ident) -> Option<Role> {
    meaning(&ROLES, word).or_else(|| {
        let near = nearest(&word.to_string(), ROLES.map(|(known, _)| known))?;
        ROLES.iter().find(|(known, _)| *known == near).map(|(_, role)| *role)
    })
}

/// The elementary transform that a word stands for.
pub fn transform(word: &Ident) -> Option<(TransformKind, Axis)> {
    meaning(&TRANSFORMS, word)
}

/// What the amount of a transform measures.
pub fn quantity_moved(kind: TransformKind) -> Quantity {
    match kind {
        TransformKind::Rotation => Quantity::Angle,
        TransformKind::Translation => Quantity::Length,
    }
}

/// What a constant measures: as stated, and a number otherwise.
pub fn stated_quantity(word: Option<&Ident>) -> Quantity {
    word.and_then(|word| meaning(&QUANTITIES, word)).unwrap_or(Quantity::Number)
}

/// Advice on a word that is not one of those known: the nearest, or all of them.
pub fn advice<T>(words: &[(&str, T)], word: &Ident) -> String {
    let known = || words.iter().map(|(known, _)| *known);
    match nearest(&word.to_string(), known()) {
        Some(near) if words.len() > 1 && word.to_string().len() > 2 => format!("did you mean `{near}`?"),
        _ => format!("write one of {}", known().collect::<Vec<_>>().join(", ")),
    }
}

/// Whether a text can be a declared name: letters, digits and underscores, not a digit first, and no reserved word.
#[must_use]
pub fn is_name(text: &str) -> bool {
    let is_word = syn::parse_str::<Ident>(text).is_ok_and(|word| word == text);
    is_word && !text.starts_with("r#") && !is_reserved(text)
}

/// Whether a word cannot be a name: it means something in an amount, or in Rust, into which chains are expanded.
pub fn is_reserved(word: &str) -> bool {
    const RUST: [&str; 52] = [
        "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do",
        "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let",
        "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self",
        "Self", "static", "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized",
        "use", "virtual", "where", "while", "yield",
    ];
    // As a constant is called whose angle is written as a number.
    let is_of_number = word.strip_prefix("angle_").is_some_and(|rest| {
        rest.starts_with(|c: char| c.is_ascii_digit()) && (rest.ends_with("_deg") || rest.ends_with("_rad"))
    });
    word == "_"
        || is_of_number
        || word == "pi"
        || word == GROUND
        || word == crate::syntax::RAMP
        || crate::syntax::FUNCTIONS.iter().any(|(function, _)| *function == word)
        || RUST.contains(&word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_one_word_that_means_nothing_else() {
        for name in ["q", "mirror_temp", "x1", "_x", "Δ"] {
            assert!(is_name(name), "{name}");
        }
        for name in [
            "",
            "mirror-temp",
            "fn",
            "temp x",
            "1x",
            "pi",
            "sin",
            "ground",
            "_",
            "r#fn",
            " q",
            "q ",
            "q\n",
            "q//",
        ] {
            assert!(!is_name(name), "{name}");
        }
    }
}
