//! A calibration of texts and tables that a page holds: every file that the command writes.

use report::Layout;
use service::report_files::{self, PAGE, RESIDUALS};
use service::{Made, Refusal, Source, Studied};

use crate::{Answered, Message, Refused, Tell};

/// Columns of the text that a terminal would show.
const WIDTH: usize = 96;

/// Calibrates: `study` of `study-name`, the `chain` that it names, every table that it names as `table:NAME`, and the `date`. Answers with
/// each file as `file:NAME`, the text of the terminal, and in a word or two what happened.
pub fn calibrate(asked: &Message, tell: Tell<'_>, warn: &dyn Fn(String)) -> Answered {
    let study = Source::of_text(asked.text("study-name")?, asked.text("study")?);
    let chain = asked.text("chain")?;
    let studied = Studied::read(study, warn, |_, name| Ok::<_, Refusal>(Source::of_text(name, chain)))?;
    let command = format!("in a browser, as `trueaxis calibrate {}` does", studied.study.path.display());
    let made = Made { version: env!("CARGO_PKG_VERSION"), command, date: asked.text("date")?.to_owned() };
    let named: Vec<String> = studied.tables().map(str::to_owned).collect();
    let tables: Vec<(&str, &[u8])> =
        named.iter().filter_map(|name| Some((name.as_str(), table(asked, name)?))).collect();
    tell("reading the table");
    let calibrated = studied.calibrate_texts(&tables, made, warn, &|stage| tell(&stage.to_string()))?;
    tell("writing the report");
    // Who keeps the files has them in one folder.
    let reported = calibrated.reported(Some("."));
    let diagnosis = &reported.calibration.diagnosis;
    let answers = report::words::answers(diagnosis, None, "");
    let text = report::as_text(&reported, Layout { width: WIDTH, verbose: false });
    let mut answer = Message::default()
        .with("badge", answers.badge)
        .with("happened", answers.happened)
        .with("text", plain(text.as_str()))
        .with(&file(PAGE), report::page(&reported));
    for (name, text) in report_files::texts(&reported, calibrated.instrument(None))? {
        if let Some(text) = text {
            answer = answer.with(&file(name), text);
        }
    }
    for (name, columns) in report_files::tables_of_places(&reported) {
        if let Some(columns) = columns {
            answer = answer.with(&file(name), separated(&columns)?);
        }
    }
    let shown = report::rows_written(&reported, false);
    answer = answer.with(&file(RESIDUALS), separated(&report::table(&reported, &shown))?);
    Ok((diagnosis.verdict.is_usable(), answer))
}

/// The table that a study names, by that name or, as a page knows no folders, by its end.
fn table<'m>(asked: &'m Message, name: &str) -> Option<&'m [u8]> {
    let end = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let of = |own: &str| asked.beginning("table:").find(|(given, _)| *given == own).map(|(_, bytes)| bytes);
    of(name).or_else(|| of(end))
}

fn file(name: &str) -> String {
    format!("file:{name}")
}

fn separated(columns: &report_files::Columns<'_>) -> Result<Vec<u8>, Refused> {
    let mut bytes = Vec::new();
    report::write_csv(columns, &mut bytes)?;
    Ok(bytes)
}

/// A text without the colours of a terminal.
fn plain(text: &str) -> String {
    anstream::adapter::strip_str(text).to_string()
}
