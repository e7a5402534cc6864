//! Physical causes, plainly: the words that a person at the instrument would use for what the catalogue names.

use crate::candidate::Dependence;
use crate::diagnose::Cause;

/// A cause as one would say it: `the encoder of beta sits off centre`.
#[must_use]
pub fn cause(cause: &Cause) -> String {
    let name = cause.name.as_str();
    let rest = |prefix: &str| name.strip_prefix(prefix).map(str::trim);
    if let Some(joint) = rest("encoder eccentricity of ") {
        return format!("the encoder of {joint} sits off centre");
    }
    if let Some(joint) = rest("encoder ellipticity of ") {
        return format!("the encoder disc of {joint} is oval or tilted");
    }
    if let Some(joint) = rest("encoder scale of ") {
        return format!("the encoder of {joint} has a wrong scale");
    }
    if let Some(joint) = rest("backlash of ") {
        return format!("{joint} has backlash");
    }
    if let Some(body) = rest("gravity flexure of ") {
        return format!("{body}: it sags under its own weight");
    }
    if let Some(joint) = rest("wind-up of ").and_then(|joint| joint.strip_suffix(" under gravity")) {
        return format!("{joint} winds up under gravity");
    }
    if let Some(joint) =
        rest("beam not along the ").and_then(|joint| joint.strip_suffix(" axis before its mirror"))
    {
        return format!("the beam comes in askew to the axis of {joint}, before its mirror");
    }
    name.to_owned()
}

/// How an effect follows what drives it: `once per turn of beta`, `in proportion to temperature`.
#[must_use]
pub fn form(form: &Dependence, driver: &str) -> String {
    match form {
        Dependence::Harmonic { order: 1 } => format!("once per turn of {driver}"),
        Dependence::Harmonic { order: 2 } => format!("twice per turn of {driver}"),
        Dependence::Harmonic { order } => format!("{order} times per turn of {driver}"),
        Dependence::Linear => format!("in proportion to {driver}"),
        Dependence::Constant => "always the same".to_owned(),
        Dependence::Described(other) if driver.is_empty() || other.contains(driver) => format!("as {other}"),
        Dependence::Described(other) => format!("with {driver} ({other})"),
    }
}

/// A sentence's start.
#[must_use]
pub fn sentence_case(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
