//! The first screen: what happened, what it is, where, how much better, what to do next.

use crate::words::{self, Answers, Tone, numbers};
use calibration::diagnose::{Diagnosis, Rms};
use maud::{Markup, PreEscaped, html};
use model_core::escape::markup;
use observe::SiUnit;

use super::chain;
use crate::Reported;

/// Errors that the first screen has room for.
const ESTIMATES: usize = 8;

/// The five answers.
pub fn first_screen(reported: &Reported<'_>, answers: &Answers) -> Markup {
    let diagnosis = &reported.calibration.diagnosis;
    let (tone, sign) = match answers.tone {
        // What was found is good news; that several causes fit has a badge of its own.
        Tone::Good | Tone::Ambiguous => ("tone good", "●"),
        Tone::Careful => ("tone careful", "▲"),
        Tone::Bad => ("tone bad", "■"),
    };
    let several = diagnosis.effects.iter().filter(|effect| effect.causes.len() > 1).count();
    html! {
        section id="answer" {
            ul.badges {
                li class=(tone) { span aria-hidden="true" { (sign) " " } (answers.badge) }
                @if several > 0 && diagnosis.effects.len() > 1 {
                    li.tone.ambiguous {
                        span aria-hidden="true" { "◐ " }
                        (several) " with several possible causes"
                    }
                }
                @if let Some(chance) = &answers.chance { li { (chance) } }
            }
            h1 { (answers.what.first().map_or_else(|| coded(&answers.happened), |what| html! { (what) })) }
            p.lead {
                (coded(if answers.what.is_empty() { &answers.better } else { &answers.happened }))
            }
            @if answers.what.len() > 1 {
                ul { @for what in &answers.what[1..] { li { (what) } } }
            }
            @if !answers.causes.is_empty() {
                ul.chips aria-label="Possible causes" {
                    @for cause in answers.causes.iter().take(10) { li { (words::sentence_case(cause)) } }
                    @if answers.causes.len() > 10 { li { a href="#causes" { "and " (answers.causes.len() - 10) " more" } } }
                }
            }
            @for caution in &diagnosis.cautions {
                p.caution role="note" { b { "Caution. " } (coded(&words::caution(caution))) }
            }
            @for warning in &reported.provenance.warnings {
                p.caution role="note" { b { "Warning. " } (coded(&words::sentence_case(warning))) }
            }
            div.grid {
                @if diagnosis.effects.is_empty() && diagnosis.verdict.is_usable() {
                    (declared(diagnosis))
                } @else {
                    section.card aria-label="Where" {
                        h2 { "Where" }
                        (chain::chain(diagnosis))
                    }
                }
                section.card aria-label="How much better" {
                    h2 { @if diagnosis.effects.is_empty() { "How large it is" } @else { "How much better" } }
                    (better(diagnosis, answers))
                }
                section.card aria-label="What to do next" {
                    h2 { "What to do next" }
                    ol.steps {
                        @for step in &answers.next {
                            li {
                                b { (step.title) } br; (coded(&step.text))
                                @match &step.command {
                                    // Lines for the study are printed beside what remains.
                                    Some(lines) if lines.contains('\n') => { " " a href="#left" { "The lines to write" } }
                                    Some(command) => pre.copy tabindex="0" { @for word in command.split_inclusive(' ') { span { (word) } } },
                                    None => {}
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The declared errors, where nothing was found beside them: they are what the calibration is for.
fn declared(diagnosis: &Diagnosis) -> Markup {
    let estimates = words::estimates(diagnosis);
    let more = estimates.lines.len().saturating_sub(ESTIMATES);
    html! {
        section.card aria-label="The declared errors" {
            h2 { "The declared errors" }
            table {
                tbody {
                    @for line in estimates.lines.iter().take(ESTIMATES) {
                        tr { th scope="row" { code { (line.what) } } td.number { (line.estimate) } }
                    }
                }
            }
            @if more > 0 { p { a href="#values" { "and " (more) " more" } } }
            @for note in &estimates.notes { p.quiet { (words::sentence_case(note)) "." } }
        }
    }
}

/// A sentence with what stands in backquotes set as code.
fn coded(text: &str) -> Markup {
    html! {
        @for (at, part) in text.split('`').enumerate() {
            @if at % 2 == 1 { code { (part) } } @else { (part) }
        }
    }
}

/// Figures and bars, of one unit of residuals after the other.
fn better(diagnosis: &Diagnosis, answers: &Answers) -> Markup {
    let first = Compared {
        unit: diagnosis.unit,
        expected: diagnosis.noise.expected_rms,
        before: diagnosis.before,
        after: diagnosis.after,
    };
    let beside = diagnosis.beside.iter().map(|own| {
        let compared =
            Compared { unit: own.unit, expected: own.expected_rms, before: own.before, after: own.after };
        (own.observed.join(", "), compared)
    });
    let main = diagnosis.instrument.observed.first().map_or("", |first| &first.name);
    html! {
        (first.figure(diagnosis))
        p { (coded(&answers.better)) }
        @if !diagnosis.beside.is_empty() { h3 { (main) } }
        (first.bars(diagnosis))
        @for (observed, compared) in beside {
            h3 { (observed) }
            (compared.bars(diagnosis))
        }
    }
}

/// Residuals before and after, in one unit.
struct Compared {
    unit: SiUnit,
    /// What the noise makes.
    expected: f64,
    before: Rms,
    after: Rms,
}

impl Compared {
    fn told(&self, si: f64) -> String {
        numbers::short(si, self.unit)
    }

    /// What there is to compare, by where it was measured.
    fn pairs(&self) -> Vec<(&'static str, f64, f64)> {
        let (before, after) = (self.before, self.after);
        [
            ("Held-out data", before.held_out_rms, after.held_out_rms),
            ("Fitted data", before.rms, after.rms),
            ("Unmeasured regions of the joints", before.elsewhere_rms, after.elsewhere_rms),
        ]
        .into_iter()
        .filter_map(|(name, before, after)| Some((name, before?, after?)))
        .filter(|(_, before, after)| before.is_finite() && after.is_finite())
        .collect()
    }

    /// The first pair, large.
    fn figure(&self, diagnosis: &Diagnosis) -> Markup {
        html! {
            @if let (Some(&(_, before, after)), false) = (self.pairs().first(), diagnosis.effects.is_empty()) {
                p.figure { span.b { (self.told(before)) } " → " span.a { (self.told(after)) } }
            }
        }
    }

    fn bars(&self, diagnosis: &Diagnosis) -> Markup {
        let (pairs, noise) = (self.pairs(), self.expected);
        let most = pairs.iter().map(|pair| pair.1.max(pair.2)).fold(noise, f64::max).max(f64::MIN_POSITIVE);
        let changed = !diagnosis.effects.is_empty();
        html! {
            @for &(name, before, after) in &pairs {
                (bars(name, [before, after].map(|si| (si / most, self.told(si))), noise / most, changed))
            }
            p.quiet {
                @if changed { "Hatched: before. Filled: after. " }
                "Dotted line: the measured noise, " (self.told(noise)) ". All figures are RMS over every row."
                @if let (Some(before), Some(after), false) = (self.before.rms_kept, self.after.rms_kept, diagnosis.observations.set_aside.is_empty()) {
                    " Excluding " (crate::outliers(diagnosis.observations.set_aside.len())) ", the fitted data have "
                    (self.told(before)) " → " (self.told(after)) "."
                }
            }
        }
    }
}

/// Two bars, before above after, with the noise across them; one where nothing was added.
fn bars(name: &str, [before, after]: [(f64, String); 2], noise: f64, changed: bool) -> Markup {
    let width = |share: f64| 2.0 + 228.0 * share;
    let label = if changed {
        format!("{name}: {} before, {} after", before.1, after.1)
    } else {
        format!("{name}: {}", after.1)
    };
    let tick = 1.0 + width(noise);
    let bar = |class: &str, y: i32, (share, told): &(f64, String)| {
        let end = width(*share);
        // The dotted line does not run through a number.
        let text = if (end - 2.0..end + 60.0).contains(&tick) { tick.max(end) + 8.0 } else { end + 8.0 };
        format!(
            "<path class=\"bar {class}\" d=\"M1 {y}h{end:.1}v18h-{end:.1}z\"/><text x=\"{text:.1}\" y=\"{}\" class=\"label\">{}</text>",
            y + 14,
            markup(told)
        )
    };
    let (height, bars) =
        if changed { (50, bar("b", 4, &before) + &bar("a", 27, &after)) } else { (26, bar("a", 4, &after)) };
    let svg = format!(
        "<svg viewBox=\"0 0 310 {height}\" role=\"img\" aria-label=\"{}\">{bars}<path class=\"tick\" d=\"M{tick:.1} 0V{height}\"/></svg>",
        markup(&label)
    );
    html! {
        p.quiet style="margin:10px 0 2px" { (name) }
        (PreEscaped(svg))
    }
}
