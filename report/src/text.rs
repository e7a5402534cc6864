//! A calibration for the terminal: the five answers first, then values; everything else with `--verbose`.

mod answer;

use std::fmt::Write as _;

use crate::words::{self, EstimateLine, numbers, sentence_case};
use anstyle::Style;
use calibration::diagnose::{Diagnosis, EffectFound, Rms};
use model_core::escape::{Screen, line};
use observe::SiUnit;
use similar::TextDiff;

use crate::style::HEADING;
use crate::wrap::paragraph;
use crate::{Reported, outliers};

/// Lines of a list that the terminal shows.
const LINES: usize = 5;

/// Most influential rows that the terminal names.
const INFLUENTIAL: usize = 12;

/// How much to print, and how wide.
#[derive(Debug, Clone, Copy)]
pub struct Layout {
    /// Letters a line at most.
    pub width: usize,
    /// Whether to print everything.
    pub verbose: bool,
}

/// The whole summary.
#[must_use]
pub fn as_text(reported: &Reported<'_>, layout: Layout) -> Screen {
    let diagnosis = &reported.calibration.diagnosis;
    let answers = words::answers(diagnosis, reported.folder, &reported.provenance.command);
    let mut page = Page { text: Screen::default(), layout };
    page.answer(&answers, diagnosis);
    page.in_full(&answers);
    page.residuals(diagnosis);
    page.models(diagnosis);
    page.values(diagnosis);
    page.frozen(diagnosis);
    if layout.verbose {
        page.effects(diagnosis);
        page.list("noise", &words::noise(diagnosis));
        page.list("what remains", &words::remaining(diagnosis));
        page.poses(diagnosis);
        page.leverage(diagnosis);
        page.set_aside(diagnosis, usize::MAX);
        page.not_shown(diagnosis);
        page.amended(reported);
    } else {
        page.set_aside(diagnosis, LINES);
        page.amended(reported);
        page.heading("");
        paragraph(
            &mut page.text,
            "",
            "For the evidence, the noise, poses to measure and effects that could not show, add `--verbose`.",
            layout.width,
        );
    }
    page.text
}

/// Hypotheses that one answer explains.
const EXPLAINED: usize = 12;

/// Why suspected causes whose names contain the words of `name` are, or are not, reported; `None` where no explanation of the contest is called so.
#[must_use]
pub fn why(diagnosis: &Diagnosis, name: &str, layout: Layout) -> Option<Screen> {
    let mut page = Page { text: Screen::default(), layout };
    let called = words::contest::called(diagnosis, name);
    page.heading("Why, or why not");
    if diagnosis.contest.is_empty() {
        page.say("  ", words::contest::NONE_HELD);
        return Some(page.text);
    }
    for own in called.iter().take(EXPLAINED) {
        page.say("  - ", &words::contest::why(own, diagnosis));
    }
    if called.len() > EXPLAINED {
        page.say("  - ", &format!("and {} more of this name", called.len() - EXPLAINED));
    }
    page.say("  ", words::contest::MEANING);
    (!called.is_empty()).then_some(page.text)
}

/// The difference between the declaration and the amended one, as a unified diff; empty if there is none.
#[must_use]
pub fn diff(reported: &Reported<'_>) -> String {
    let Some(amended) = &reported.calibration.amended else { return String::new() };
    let file = line(reported.chain_file);
    TextDiff::from_lines(reported.chain_text, amended.as_str())
        .unified_diff()
        .context_radius(2)
        .header(&file, &format!("{file} (amended)"))
        .to_string()
}

/// Text that grows.
struct Page {
    text: Screen,
    layout: Layout,
}

impl Page {
    fn heading(&mut self, title: &str) {
        let _ = writeln!(self.text);
        if !title.is_empty() {
            self.styled(HEADING, title);
            let _ = writeln!(self.text);
        }
    }

    fn styled(&mut self, style: Style, words: &str) {
        self.text.styled([&style, &format_args!("{style:#}")], words);
    }

    fn say(&mut self, first: &str, sentence: &str) {
        paragraph(&mut self.text, first, sentence, self.layout.width);
    }

    fn list(&mut self, title: &str, lines: &[String]) {
        if !lines.is_empty() {
            self.heading(title);
            lines.iter().for_each(|line| self.say("  ", line));
        }
    }

    fn residuals(&mut self, diagnosis: &Diagnosis) {
        let all = "Residual (RMS)".to_owned();
        let of = |observed: &str| format!("Residual of {observed} (RMS)");
        let first = diagnosis.instrument.observed.first().filter(|_| !diagnosis.beside.is_empty());
        let title = first.map_or(all, |first| of(&first.name));
        self.residuals_of(diagnosis, &title, diagnosis.unit, [diagnosis.before, diagnosis.after]);
        for own in &diagnosis.beside {
            self.residuals_of(diagnosis, &of(&own.observed.join(", ")), own.unit, [own.before, own.after]);
        }
    }

    fn residuals_of(&mut self, diagnosis: &Diagnosis, title: &str, unit: SiUnit, [before, after]: [Rms; 2]) {
        let told =
            |si: Option<f64>| si.map_or_else(|| "not measured".to_owned(), |si| numbers::told(si, unit));
        let names = self.layout.width.saturating_sub(28).clamp(24, 36);
        self.heading(&format!("{title:0$} {1:>12} {2:>12}", names + 2, "before", "after"));
        let mut row = |name: &str, before: Option<f64>, after: Option<f64>| {
            let _ = writeln!(self.text, "  {name:names$} {:>12} {:>12}", told(before), told(after));
        };
        let aside = diagnosis.observations.set_aside.len();
        row("fitted data", before.rms, after.rms);
        if aside > 0 {
            let name = format!("  excluding {}", outliers(aside));
            row(&name, before.rms_kept, after.rms_kept);
        }
        row("held-out data", before.held_out_rms, after.held_out_rms);
        let out = after.held_out_rows - after.held_out_rows_kept;
        if out > 0 {
            let name = format!("  excluding {}", outliers(out));
            row(&name, before.held_out_rms_kept, after.held_out_rms_kept);
        }
        if after.elsewhere_rms.is_some() {
            row("unmeasured regions", before.elsewhere_rms, after.elsewhere_rms);
        }
    }

    /// The models, each judged on held-out rows.
    fn models(&mut self, diagnosis: &Diagnosis) {
        let Some(ladder) = diagnosis.ladder.as_ref().filter(|_| diagnosis.verdict.is_usable()) else {
            return;
        };
        let lines = words::models(ladder);
        let names = lines.iter().map(|line| line.what.chars().count()).max().unwrap_or_default();
        self.heading(&format!("{0:1$} errors   held-out data (RMS)", "Models", names + 2));
        for line in &lines {
            let mark = if line.is_simplest { " ✓" } else { "" };
            let _ =
                writeln!(self.text, "  {:names$} {:>6}   {}{mark}", line.what, line.errors, line.held_out);
        }
        if lines.iter().any(|line| line.is_simplest) {
            self.say("  ", words::SIMPLEST);
        }
        if let Some(missing) = words::missing_models(ladder).filter(|_| self.layout.verbose) {
            self.say("  ", &missing);
        }
    }

    /// The errors that the study wants first.
    fn wanted(&mut self, diagnosis: &Diagnosis) {
        if diagnosis.wanted.is_empty() || !diagnosis.verdict.is_usable() {
            return;
        }
        self.title("Wanted errors, with standard uncertainties");
        let estimates = words::estimates(diagnosis);
        self.estimates(estimates.lines.iter().filter(|line| line.wanted));
        if let Some(missing) = words::wanted_not_shown(diagnosis) {
            self.say("  ", &missing);
        }
    }

    fn estimates<'a>(&mut self, lines: impl Iterator<Item = &'a EstimateLine> + Clone) {
        let width = lines.clone().map(|line| line.what.chars().count()).max().unwrap_or_default().min(40);
        for line in lines {
            let found = if line.found { " (found)" } else { "" };
            self.say(&format!("  {:width$}  ", line.what), &format!("{}{found}", line.estimate));
        }
    }

    fn values(&mut self, diagnosis: &Diagnosis) {
        if !diagnosis.verdict.is_usable() {
            return;
        }
        let estimates = words::estimates(diagnosis);
        let others = estimates.lines.iter().filter(|line| !line.wanted);
        let which = if estimates.lines.iter().any(|line| line.wanted) { "Other errors" } else { "Errors" };
        if others.clone().next().is_some() || !estimates.notes.is_empty() {
            self.heading(&format!("{which}, with standard uncertainties"));
        }
        self.estimates(others);
        estimates.notes.iter().for_each(|note| self.say("  ", &format!("{}.", sentence_case(note))));
    }

    /// The terms of a frozen model, and what one less or more does.
    fn frozen(&mut self, diagnosis: &Diagnosis) {
        let Some(model) = diagnosis.frozen.as_ref().filter(|_| diagnosis.verdict.is_usable()) else { return };
        let (terms, others) = (words::frozen::terms(model), words::frozen::others(model));
        self.trials("Terms, with the held-out RMS without each", &terms);
        let notes = [words::frozen::as_it_is(model), words::frozen::held(model)];
        notes.iter().flatten().for_each(|note| self.say("  ", note));
        if self.layout.verbose && !others.is_empty() {
            self.trials("Other effects, with the held-out RMS with each", &others);
        }
        words::frozen::gains(model).iter().for_each(|note| self.say("  ", note));
    }

    fn trials(&mut self, title: &str, trials: &[words::frozen::Trial]) {
        self.heading(title);
        let longest = |of: fn(&words::frozen::Trial) -> &String| {
            trials.iter().map(|own| of(own).chars().count()).max().unwrap_or_default()
        };
        let (what, is) = (longest(|own| &own.what), longest(|own| &own.is));
        for own in trials {
            let _ = writeln!(self.text, "  {:what$}  {:is$}  {:>8}", own.what, own.is, own.held_out);
        }
    }

    fn effects(&mut self, diagnosis: &Diagnosis) {
        let mut effects: Vec<&EffectFound> = diagnosis.effects.iter().collect();
        effects.sort_by(|a, b| b.standing.total_cmp(&a.standing));
        for (number, effect) in (1..).zip(effects) {
            self.heading(&format!("effect {number}: {}", effect.names[0]));
            self.say("  ", &format!("{} in body {}", effect.text, effect.body));
            if effect.names.len() > 1 {
                self.say("  ", &format!("also called {}", effect.names[1..].join(", ")));
            }
            words::evidence(effect, diagnosis).iter().for_each(|line| self.say("  ", line));
            for cause in &effect.causes {
                self.say("  - ", &format!("{}: {}", words::cause(cause), cause.check));
            }
        }
    }

    /// Rows that carry more than their share, those that carry most first.
    fn leverage(&mut self, diagnosis: &Diagnosis) {
        let rows = &diagnosis.precision.leverage;
        if rows.is_empty() {
            return;
        }
        self.heading("most influential rows (leverage)");
        let told = rows.iter().take(INFLUENTIAL).map(|(row, leverage)| format!("row {row} ({leverage:.2})"));
        let more = rows.len().saturating_sub(INFLUENTIAL);
        let more = if more > 0 { format!(", and {more} more in report.json") } else { String::new() };
        self.say(
            "  ",
            &format!(
                "the leverage of a row is at most its number of components: {}{more}",
                told.collect::<Vec<_>>().join(", ")
            ),
        );
    }

    fn poses(&mut self, diagnosis: &Diagnosis) {
        for table in words::pose_tables(diagnosis) {
            self.heading("measure next");
            self.say("  ", &table.title);
            if !table.poses.is_empty() {
                let rows = || std::iter::once(&table.joints).chain(&table.poses);
                let widths: Vec<usize> = (0..table.joints.len())
                    .map(|at| 2 + rows().map(|row| row[at].chars().count()).max().unwrap_or(0))
                    .collect();
                for row in rows() {
                    let cells = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}"));
                    let _ = writeln!(self.text, "{}", cells.collect::<String>());
                }
            }
            table.notes.iter().for_each(|note| self.say("  ", note));
        }
    }

    fn set_aside(&mut self, diagnosis: &Diagnosis, most: usize) {
        let used = &diagnosis.observations;
        if used.set_aside.is_empty() {
            return;
        }
        self.heading(&format!("{} of {} rows excluded as outliers", used.set_aside.len(), used.rows));
        for aside in used.set_aside.iter().take(most) {
            self.say("  ", &format!("{}: {}", words::row(aside), aside.why));
        }
        if used.set_aside.len() > most {
            self.say("  ", &format!("and {} more, all listed in report.json", used.set_aside.len() - most));
        }
    }

    /// The effects that these data could not have shown: first those that would show if they were large enough.
    fn not_shown(&mut self, diagnosis: &Diagnosis) {
        let mut hidden: Vec<_> = diagnosis.not_shown.iter().filter(|effect| effect.absorbed > 0.0).collect();
        if hidden.is_empty() {
            return;
        }
        hidden.sort_by_key(|effect| effect.smallest.is_none());
        self.heading("effects that these data could not show");
        for effect in &hidden {
            self.say("  ", &format!("{} {}: {}", effect.name, words::size(effect), words::fate(effect)));
        }
    }

    fn amended(&mut self, reported: &Reported<'_>) {
        if !reported.calibration.diagnosis.effects.is_empty() && reported.calibration.amended.is_some() {
            self.heading("The declaration, amended");
            let _ = writeln!(self.text, "{}", diff(reported).trim_end());
        }
    }
}
