//! A check in words.

use std::fmt::Write as _;

use model_core::escape::Screen;
use observe::SiUnit;
use report::style::{BAD, CAREFUL, GOOD, HEADING};
use report::words::numbers;

use super::{OfError, Verdict, Verified, policy};

/// Rows and errors that a sentence names.
const NAMED: usize = 5;

/// A check as text.
#[must_use]
pub fn as_text(verified: &Verified) -> Screen {
    let mut out = Screen::default();
    let (headline, style) = match verified.verdict {
        Verdict::StillValid | Verdict::BelowGoal => ("STILL VALID.", GOOD),
        Verdict::Recalibrate => ("RECALIBRATE.", BAD),
        Verdict::Misread => ("CHECK THE COLUMNS.", BAD),
        Verdict::CannotSay | Verdict::NoRows => ("CANNOT SAY.", CAREFUL),
    };
    out.styled([&style, &format_args!("{style:#}")], headline);
    let sentences = [reasons(verified), rows_left_out(verified)].concat();
    let _ = writeln!(out, " {}", sentences.join(" "));
    if !matches!(verified.verdict, Verdict::NoRows) {
        let _ = writeln!(out);
        out.append(&table(verified));
    }
    if let Some(added) = &verified.added {
        let _ = writeln!(out);
        let heading = if added.is_enough { "Rows to add" } else { "Rows that help most, and are not enough" };
        out.styled([&HEADING, &format_args!("{HEADING:#}")], heading);
        let _ = writeln!(out);
        for pose in &added.poses {
            let named = added
                .names
                .iter()
                .zip(pose)
                .map(|(name, value)| format!("{name} {}", told(verified, name, *value)));
            let _ = writeln!(out, "  {}", named.collect::<Vec<_>>().join(", "));
        }
    }
    let _ = write!(out, "\n{}", notes(verified));
    out
}

/// What the verdict rests on.
fn reasons(verified: &Verified) -> Vec<String> {
    let size = |value: f64| numbers::told(value, verified.unit);
    let rows = counted(verified.judged.len());
    let chance = numbers::chance(verified.p_value);
    let goal = size(verified.goal);
    let agree = if verified.judged.len() == 1 { "agrees" } else { "agree" };
    match verified.verdict {
        Verdict::StillValid => vec![
            format!("{rows} {agree} with the calibration ({chance})."),
            format!(
                "A change of any one error by {} RMS would have shown (goal {goal}).",
                size(largest(verified))
            ),
        ],
        Verdict::BelowGoal => vec![
            format!("The instrument changed by {} RMS, which is below the goal of {goal}.", change(verified)),
            hint(verified),
        ],
        Verdict::Recalibrate => {
            let verb = if verified.judged.len() == 1 { "disagrees" } else { "disagree" };
            let disagree = format!("{rows} {verb} with the calibration ({chance}).");
            match verified.one_row {
                Some(row) => vec![
                    disagree,
                    format!("Row {row} alone explains the difference. Measure row {row} again first."),
                ],
                None => vec![disagree, hint(verified)],
            }
        }
        Verdict::CannotSay => vec![
            format!(
                "{rows} {agree} with the calibration ({chance}), but could not have shown every change of {goal} RMS."
            ),
            missed(verified),
            advice(verified),
        ],
        Verdict::NoRows => {
            vec!["No row lies inside the measured region of the calibration.".to_owned(), advice(verified)]
        }
        Verdict::Misread => vec![
            format!(
                "The residuals are {} RMS, {:.0} times the goal.",
                size(verified.rms),
                verified.rms / verified.goal
            ),
            "No instrument moves that far. Compare unit, sign and offset of each column with the study."
                .to_owned(),
        ],
    }
}

fn change(verified: &Verified) -> String {
    numbers::estimate(verified.change[0], verified.change[1], verified.unit)
}

/// Which errors explain the rows alone.
fn hint(verified: &Verified) -> String {
    let named = |at: &usize| {
        let error = &verified.errors[*at];
        let [by, uncertainty] = error.change.unwrap_or_default();
        format!("{} by {}", error.name, numbers::estimate(by, uncertainty, error.unit))
    };
    match verified.explaining.as_slice() {
        [] if verified.rest.p_value < verified.explained.p_value => {
            "No change of the declared errors explains the rows. Look for something loose or another noise.".to_owned()
        }
        [] => "No single error explains the rows. Several errors changed, or something that the model does not contain."
            .to_owned(),
        [one] => format!("A change of {} explains the rows best.", named(one)),
        several => {
            let names: Vec<String> = several.iter().take(NAMED).map(named).collect();
            format!("Each of these changes alone explains the rows: {}.", names.join(", "))
        }
    }
}

/// The errors whose change would not have shown.
fn missed(verified: &Verified) -> String {
    let mut missed: Vec<&OfError> =
        verified.errors.iter().filter(|error| error.shown > verified.goal).collect();
    missed.sort_by(|a, b| b.shown.total_cmp(&a.shown));
    let names: Vec<&str> = missed.iter().take(NAMED).map(|error| error.name.as_str()).collect();
    let more = missed.len().saturating_sub(NAMED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    format!("They could have missed a change of {}{more}.", names.join(", "))
}

/// What to do where nothing can be said.
fn advice(verified: &Verified) -> String {
    let least = verified.errors.iter().map(|error| error.least).fold(0.0, f64::max);
    match &verified.added {
        _ if least > verified.goal => {
            let least = numbers::told(least, verified.unit);
            format!(
                "No number of rows can show it: the calibration itself shows no change below {least}. Set a larger goal."
            )
        }
        Some(added) if added.is_enough => {
            format!("Measure {} as listed below.", more(added.poses.len()))
        }
        Some(added) => {
            format!("Even {} are not enough. Set a larger goal, or calibrate again.", more(added.poses.len()))
        }
        None => "Measure more rows, spread over the measured region.".to_owned(),
    }
}

/// The rows that were not judged.
fn rows_left_out(verified: &Verified) -> Vec<String> {
    let told = |rows: &[u64], why: &str| {
        let numbers: Vec<String> = rows.iter().take(NAMED).map(u64::to_string).collect();
        let more = if rows.len() > NAMED { ", …" } else { "" };
        format!("Not judged: {} {why} ({}{more}).", counted(rows.len()), numbers.join(", "))
    };
    let mut all = Vec::new();
    if !verified.outside.is_empty() && !verified.judged.is_empty() {
        all.push(told(&verified.outside, "outside the measured region"));
    }
    if !verified.undefined.is_empty() {
        all.push(told(&verified.undefined, "at a pole of the chain"));
    }
    all
}

/// A reading of a joint or input.
fn told(verified: &Verified, name: &str, value: f64) -> String {
    match verified.units.iter().find(|(own, _)| own == name).map(|(_, unit)| *unit) {
        Some(SiUnit::RAD) => format!("{:.1}°", value.to_degrees()),
        Some(SiUnit::METRE) => format!("{value:.3} m"),
        _ => format!("{value:.3}"),
    }
}

fn table(verified: &Verified) -> Screen {
    let heads = ["error", "changed, if alone", "change that would show, RMS"];
    let rows = verified.errors.iter().map(|error| {
        let change = error.change.map_or_else(
            || "not seen".to_owned(),
            |[by, uncertainty]| numbers::estimate(by, uncertainty, error.unit),
        );
        let shown = if error.shown.is_finite() {
            numbers::told(error.shown, verified.unit)
        } else {
            "none".to_owned()
        };
        [error.name.clone(), change, shown]
    });
    let rows: Vec<[String; 3]> = rows.collect();
    let width = |at: usize| {
        let cells = rows.iter().map(|row| row[at].chars().count());
        cells.chain([heads[at].chars().count()]).max().unwrap_or(0)
    };
    let widths = [width(0), width(1)];
    let line = |cells: [&str; 3]| {
        format!("  {:<a$}  {:<b$}  {}", cells[0], cells[1], cells[2], a = widths[0], b = widths[1])
    };
    let mut out = Screen::default();
    out.styled([&HEADING, &format_args!("{HEADING:#}")], &line(heads));
    let lines = rows.iter().map(|[a, b, c]| format!("\n{}", line([a, b, c])));
    out.append(&lines.collect::<String>().into());
    out.append(&"\n".into());
    out
}

fn notes(verified: &Verified) -> String {
    let goal = if verified.goal_is_asked {
        ""
    } else {
        " The goal is the noise of one observation, as --goal is not given."
    };
    format!(
        "At most {} % of unchanged instruments get RECALIBRATE (--false-alarm). \"Would show\" means with a chance of {:.0} %.{goal}\n",
        100.0 * verified.false_alarm,
        100.0 * policy::POWER
    )
}

fn largest(verified: &Verified) -> f64 {
    verified.errors.iter().map(|error| error.shown).fold(0.0, f64::max)
}

fn more(rows: usize) -> String {
    format!("{rows} more row{}", if rows == 1 { "" } else { "s" })
}

fn counted(rows: usize) -> String {
    format!("{rows} row{}", if rows == 1 { "" } else { "s" })
}
