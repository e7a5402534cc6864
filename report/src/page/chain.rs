//! The chain drawn from the ground up, with the places of what was found marked.

use crate::words::{self, numbers};
use calibration::diagnose::{BodyShown, Diagnosis, EffectFound, ErrorState};
use maud::{Markup, PreEscaped, html};
use model_core::escape::markup;

/// Effects of one body that the drawing names.
const NAMED: usize = 3;

/// The bodies, the uppermost first, as a list.
pub fn chain(diagnosis: &Diagnosis) -> Markup {
    let bodies = &diagnosis.instrument.bodies;
    html! {
        div role="list" aria-label="Bodies, the uppermost first" {
            @for body in bodies.iter().rev() { (row(body, diagnosis)) }
            div.body role="listitem" {
                (PreEscaped("<svg viewBox=\"0 0 44 40\" aria-hidden=\"true\"><path d=\"M4 14H40M8 14l-5 9M17 14l-5 9M26 14l-5 9M35 14l-5 9\"/></svg>"))
                p { b { "ground" } }
            }
        }
        p.quiet { "Declared errors: ● measured alone, ◐ in a sum only, ○ not shown by these data, ▪ fixed." }
    }
}

fn row(body: &BodyShown, diagnosis: &Diagnosis) -> Markup {
    let mut here: Vec<&EffectFound> =
        diagnosis.effects.iter().filter(|effect| effect.body == body.name).collect();
    here.sort_by(|a, b| b.standing.total_cmp(&a.standing));
    let left =
        diagnosis.remaining.as_ref().and_then(|left| left.place.as_ref()).filter(|p| p.body == body.name);
    let class = if here.is_empty() && left.is_none() { "body" } else { "body here" };
    html! {
        div class=(class) role="listitem" {
            (PreEscaped(glyph(body, !here.is_empty())))
            div {
                p {
                    b { (body.name) }
                    span.quiet {
                        @if let Some(lower) = &body.lower { " on " (lower) }
                        @for joint in &body.joints { ", " (motion(&joint.dof)) " by " (symbol(&joint.symbol, &joint.name)) }
                        @if body.joints.is_empty() { ", fixed" }
                    }
                }
                @if !body.documentation.is_empty() { p.quiet { (body.documentation.lines().next().unwrap_or_default()) } }
                @for effect in here.iter().take(NAMED) { p.tag { "◆ Here: " (tag(effect)) } }
                @if here.len() > NAMED { p.tag { a href="#causes" { "and " (here.len() - NAMED) " more here" } } }
                @if let Some(place) = left { p.tag { "◇ Remains: " (motion(&place.dof)) " with " (place.driver) } }
                @if !body.errors.is_empty() { (dots(body)) }
            }
        }
    }
}

/// `turns about x, once per turn of β, up to 10.1″`
fn tag(effect: &EffectFound) -> String {
    let form = words::form(&effect.form, &effect.driver);
    format!(
        "{}, {form}, up to {}",
        motion(&effect.dof),
        numbers::short(effect.amplitude, effect.amplitude_unit)
    )
}

fn dots(body: &BodyShown) -> Markup {
    let sign = |state: ErrorState| match state {
        ErrorState::Alone => "●",
        ErrorState::InASum => "◐",
        ErrorState::NotShown => "○",
        ErrorState::Held => "▪",
    };
    let count = |state: ErrorState| body.errors.iter().filter(|error| error.state == state).count();
    let told = format!(
        "{} errors measured alone, {} in a sum only, {} not shown",
        count(ErrorState::Alone),
        count(ErrorState::InASum),
        count(ErrorState::NotShown)
    );
    html! {
        p.dots role="img" aria-label=(told) {
            @for error in &body.errors { span title={ (error.name) ", " (error.dof) } { (sign(error.state)) } }
        }
    }
}

/// `turns about x`, `slides along z`, `turns about x and y`.
fn motion(dof: &str) -> String {
    let axes: Vec<&str> = dof.split(", ").map(|one| one.trim_start_matches(['R', 'T'])).collect();
    format!("{} {}", if dof.starts_with('R') { "turns about" } else { "slides along" }, axes.join(" and "))
}

/// A joint's printed form where it is one Greek letter, else its name.
pub fn symbol(latex: &str, name: &str) -> String {
    const GREEK: [(&str, &str); 14] = [
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("delta", "δ"),
        ("epsilon", "ε"),
        ("zeta", "ζ"),
        ("eta", "η"),
        ("theta", "θ"),
        ("kappa", "κ"),
        ("lambda", "λ"),
        ("phi", "φ"),
        ("varphi", "φ"),
        ("psi", "ψ"),
        ("omega", "ω"),
    ];
    let plain = latex.trim_start_matches('\\');
    GREEK
        .iter()
        .find(|(word, _)| *word == plain)
        .map_or_else(|| name.to_owned(), |(_, letter)| (*letter).to_owned())
}

/// What moves a body: a drum for a turn, a slide for a shift, a box for neither; a diamond where something was found.
fn glyph(body: &BodyShown, marked: bool) -> String {
    let letter = body.joints.first().map(|joint| symbol(&joint.symbol, &joint.name)).unwrap_or_default();
    let letter = letter.chars().next().map_or_else(String::new, |letter| letter.to_string());
    let shape = match body.joints.first().map(|joint| joint.dof.as_str()) {
        Some("Rz") => {
            "<path d=\"M8 12v18a14 5 0 0 0 28 0V12\"/><ellipse cx=\"22\" cy=\"12\" rx=\"14\" ry=\"5\"/>"
        }
        Some(dof) if dof.starts_with('R') => {
            "<path d=\"M10 8h24a5 13 0 0 1 0 26H10\"/><ellipse cx=\"10\" cy=\"21\" rx=\"5\" ry=\"13\"/>"
        }
        Some(_) => "<path d=\"M4 33H40M12 12h20v16H12zM4 36H40\"/>",
        None => "<path d=\"M9 10h26v22H9z\"/>",
    };
    let mark = if marked { "<path class=\"solid\" d=\"M36 1l6 6-6 6-6-6z\"/>" } else { "" };
    format!(
        "<svg viewBox=\"0 0 44 40\" aria-hidden=\"true\">{shape}<text x=\"23\" y=\"27\" text-anchor=\"middle\">{}</text>{mark}</svg>",
        markup(&letter)
    )
}
