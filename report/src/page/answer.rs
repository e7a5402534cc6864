//! The first screen: what happened, what it is, where, how much better, what to do next.

use crate::words::{self, Answers, Stage, Tone, numbers};
use calibration::diagnose::{Diagnosis, Ladder, Rms};
use maud::{Markup, PreEscaped, html};
use model_core::escape::markup;
use observe::SiUnit;

use super::chain;
use crate::Reported;

/// Rows that no stage saw.
const HELD_OUT: &str = "Held-out data";

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
            @if let Some(goal) = &answers.goal { p.lead { b { (goal) } } }
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
                @if !diagnosis.wanted.is_empty() && diagnosis.verdict.is_usable() { (wanted(diagnosis)) }
                @if diagnosis.effects.is_empty() && diagnosis.verdict.is_usable() {
                    @if diagnosis.wanted.is_empty() { (declared(diagnosis)) }
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

/// The errors that the study wants first.
fn wanted(diagnosis: &Diagnosis) -> Markup {
    let estimates = words::estimates(diagnosis);
    html! {
        section.card aria-label="The wanted errors" {
            h2 { "The wanted errors" }
            table {
                tbody {
                    @for line in estimates.lines.iter().filter(|line| line.wanted) {
                        tr { th scope="row" { code { (line.what) } } td.number { (line.estimate) } }
                    }
                }
            }
            @if let Some(missing) = words::wanted_not_shown(diagnosis) { p.quiet { (missing) } }
            p { a href="#values" { "All errors" } }
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
            @for note in &estimates.notes { p.quiet { (coded(&words::sentence_case(note))) "." } }
        }
    }
}

/// A sentence with what stands in backquotes set as code.
pub(super) fn coded(text: &str) -> Markup {
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
        stages: words::stages(diagnosis, words::hides(&diagnosis.after)),
        goal: diagnosis.goal.map(|goal| goal.rms),
    };
    let beside = diagnosis.beside.iter().map(|own| {
        let compared = Compared {
            unit: own.unit,
            expected: own.expected_rms,
            before: own.before,
            after: own.after,
            stages: Vec::new(),
            goal: None,
        };
        (own.observed.join(", "), compared)
    });
    let main = diagnosis.instrument.observed.first().map_or("", |first| &first.name);
    html! {
        (first.figure(diagnosis))
        p { (coded(&answers.better)) }
        @if !diagnosis.beside.is_empty() { h3 { (main) } }
        (first.bars(diagnosis))
        @if let Some(ladder) = &diagnosis.ladder { (models(ladder)) }
        @for (observed, compared) in beside {
            h3 { (observed) }
            (compared.bars(diagnosis))
        }
    }
}

/// Every model of the ladder, behind a fold.
fn models(ladder: &Ladder) -> Markup {
    html! {
        details {
            summary { "All models, judged on held-out data" }
            table {
                thead { tr { th scope="col" { "model" } th scope="col" { "errors" } th scope="col" { "RMS" } } }
                tbody {
                    @for line in words::models(ladder) {
                        tr {
                            th scope="row" { (line.what) @if line.is_simplest { " ✓" } }
                            td.number { (line.errors) }
                            td.number { (line.held_out) }
                        }
                    }
                }
            }
            p.quiet { (words::SIMPLEST) }
            @if let Some(missing) = words::missing_models(ladder) { p.quiet { (missing) } }
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
    /// The error on held-out rows, from delivery on.
    stages: Vec<Stage>,
    /// The specification, SI.
    goal: Option<f64>,
}

impl Compared {
    fn told(&self, si: f64) -> String {
        numbers::short(si, self.unit)
    }

    /// What there is to compare, by where it was measured.
    fn pairs(&self) -> Vec<(&'static str, f64, f64)> {
        let (before, after) = (self.before, self.after);
        [
            (HELD_OUT, before.held_out_rms, after.held_out_rms),
            ("Fitted data", before.rms, after.rms),
            ("Unmeasured regions of the joints", before.elsewhere_rms, after.elsewhere_rms),
        ]
        .into_iter()
        .filter_map(|(name, before, after)| Some((name, before?, after?)))
        .filter(|(_, before, after)| before.is_finite() && after.is_finite())
        .collect()
    }

    /// The figures from delivery on, or the first pair, large.
    fn figure(&self, diagnosis: &Diagnosis) -> Markup {
        if let [others @ .., last] = self.stages.as_slice()
            && !others.is_empty()
        {
            return html! {
                p.figure {
                    @for stage in others { span.b title=(stage.what) { (self.told(stage.rms)) } " → " }
                    span.a title=(last.what) { (self.told(last.rms)) }
                }
            };
        }
        html! {
            @if let (Some(&(_, before, after)), false) = (self.pairs().first(), diagnosis.effects.is_empty()) {
                p.figure { span.b { (self.told(before)) } " → " span.a { (self.told(after)) } }
            }
        }
    }

    fn bars(&self, diagnosis: &Diagnosis) -> Markup {
        let mut pairs = self.pairs();
        // The stages show the held-out data.
        if !self.stages.is_empty() {
            pairs.retain(|(name, ..)| *name != HELD_OUT);
        }
        let changed = !diagnosis.effects.is_empty();
        let figures = pairs.iter().flat_map(|pair| [pair.1, pair.2]);
        let later = self.stages.iter().skip(1).map(|stage| stage.rms);
        let most = figures.chain(later).chain(self.goal).fold(self.expected, f64::max).max(f64::MIN_POSITIVE);
        let scale = Scale { most, noise: self.expected, goal: self.goal };
        html! {
            @if !self.stages.is_empty() { (stages(&self.stages, scale, |si| self.told(si))) }
            @for &(name, before, after) in &pairs {
                (bars(name, [before, after].map(|si| (si, self.told(si))), scale, changed))
            }
            p.quiet {
                @if changed { "Hatched: before the effect. Filled: after. " }
                "Dotted line: the measured noise, " (self.told(self.expected)) "."
                @if let Some(goal) = self.goal { " Solid line: the goal, " (self.told(goal)) "." }
                " All figures are RMS."
                @if let (Some(before), Some(after), false) = (self.before.rms_kept, self.after.rms_kept, diagnosis.observations.set_aside.is_empty()) {
                    " Excluding " (crate::outliers(diagnosis.observations.set_aside.len())) ", the fitted data have "
                    (self.told(before)) " → " (self.told(after)) "."
                }
            }
        }
    }
}

/// What is drawn across all bars, and the largest bar, SI.
#[derive(Clone, Copy)]
struct Scale {
    most: f64,
    noise: f64,
    goal: Option<f64>,
}

impl Scale {
    /// Where a bar of some size ends.
    fn end(self, si: f64) -> f64 {
        2.0 + 200.0 * (si / self.most).min(BROKEN)
    }

    /// The lines across bars of some height.
    fn lines(self, height: i32) -> String {
        let noise = 1.0 + self.end(self.noise);
        let mut lines = format!("<path class=\"tick\" d=\"M{noise:.1} 0V{height}\"/>");
        if let Some(goal) = self.goal {
            lines += &format!("<path class=\"goal\" d=\"M{:.1} 0V{height}\"/>", 1.0 + self.end(goal));
        }
        lines
    }

    /// Where the number of a bar begins: no line runs through it.
    fn number(self, end: f64, letters: usize) -> f64 {
        let lines = [Some(self.noise), self.goal].into_iter().flatten().map(|si| 1.0 + self.end(si));
        let mut sorted: Vec<f64> = lines.collect();
        sorted.sort_by(f64::total_cmp);
        sorted.into_iter().fold(end + 8.0, |text, line| {
            if (text - 10.0..text + 6.0 * letters as f64).contains(&line) {
                text.max(line + 8.0)
            } else {
                text
            }
        })
    }

    /// One bar and its number; a broken one where the error is far larger than what it is compared with.
    fn bar(self, class: &str, y: i32, si: f64, told: &str) -> String {
        let end = self.end(si);
        let broken = if si > BROKEN * self.most {
            format!("<path class=\"gap\" d=\"M{:.1} {}l8 -22\"/>", end - 24.0, y + 20)
        } else {
            String::new()
        };
        format!(
            "<path class=\"bar {class}\" d=\"M1 {y}h{end:.1}v18h-{end:.1}z\"/>{broken}<text x=\"{:.1}\" y=\"{}\" class=\"label\">{}</text>",
            self.number(end, told.chars().count()),
            y + 14,
            markup(told)
        )
    }
}

/// A bar this many times the largest that it is compared with is broken.
const BROKEN: f64 = 1.15;

/// The error on held-out rows, a bar for each model.
fn stages(stages: &[Stage], scale: Scale, told: impl Fn(f64) -> String) -> Markup {
    let count = i32::try_from(stages.len()).unwrap_or(1);
    let height = 23 * count + 4;
    let one = |(at, stage): (i32, &Stage)| {
        let class = if at + 1 == count { "a" } else { "b" };
        scale.bar(class, 4 + 23 * at, stage.rms, &format!("{} {}", told(stage.rms), stage.what))
    };
    let drawn: String = (0..).zip(stages).map(one).collect();
    let label: Vec<String> =
        stages.iter().map(|stage| format!("{} {}", told(stage.rms), stage.what)).collect();
    let svg = format!(
        "<svg viewBox=\"0 0 370 {height}\" role=\"img\" aria-label=\"{}\">{drawn}{}</svg>",
        markup(&format!("{HELD_OUT}: {}", label.join(", "))),
        scale.lines(height)
    );
    html! {
        p.quiet style="margin:10px 0 2px" { (HELD_OUT) }
        (PreEscaped(svg))
    }
}

/// Two bars, before above after, with the noise across them; one where nothing was added.
fn bars(name: &str, [before, after]: [(f64, String); 2], scale: Scale, changed: bool) -> Markup {
    let label = if changed {
        format!("{name}: {} before, {} after", before.1, after.1)
    } else {
        format!("{name}: {}", after.1)
    };
    let bar = |class: &str, y: i32, (si, told): &(f64, String)| scale.bar(class, y, *si, told);
    let (height, bars) =
        if changed { (50, bar("b", 4, &before) + &bar("a", 27, &after)) } else { (26, bar("a", 4, &after)) };
    let svg = format!(
        "<svg viewBox=\"0 0 370 {height}\" role=\"img\" aria-label=\"{}\">{bars}{}</svg>",
        markup(&label),
        scale.lines(height)
    );
    html! {
        p.quiet style="margin:10px 0 2px" { (name) }
        (PreEscaped(svg))
    }
}
