//! `trueaxis calibrate`: fit, residual, trace, amend, report.

use std::io;
use std::path::PathBuf;

use calibration::calibrate::Calibration;
use calibration::diagnose::Diagnosis;
use model_core::escape::Screen;
use model_core::names::nearest;
use report::Layout;
use study::Plan;
use tables::formats;

use super::{Answer, TextOrJson};
use crate::failure::Failure;
use crate::table_files::Files;
use crate::waiting::Waiting;
use crate::{calibrating, date, many, report_files, source, terminal};

/// Fit the errors to measured data, and find what the declaration lacks.
///
/// Fits the declared errors, looks for structure in the residual, names the effect that explains it, amends the
/// declaration, and judges the error before and after on data that nobody fitted. The study file names the chain,
/// the data, their columns and what was observed.
///
/// Exit code 1, and no amended declaration, where no usable model came out.
///
/// Example: trueaxis calibrate examples/mobile-lidar/study.toml --out result
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The study file
    study: PathBuf,
    /// Folder for report.html, report.json, instrument.toml, amended.chain, errors.toml and residuals.csv, and beside unknown objects
    /// objects.csv and stations.csv
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Rows that the search holds at most; of more it reads so many, drawn from all, and a fit reads every row
    #[arg(long, value_name = "N", default_value_t = 1_000_000, value_parser = at_least_one)]
    search_rows: usize,
    /// Write every row into residuals.csv; of more than 100,000 rows, a part is written otherwise
    #[arg(long, requires = "out")]
    all_residuals: bool,
    /// The last day on which the instrument file is to count, as 2027-06-30; behind it, commands that read it warn
    #[arg(long, value_name = "DATE", requires = "out", value_parser = date::day)]
    valid_until: Option<String>,
    /// Only print how the declaration would change (with --format json: the whole report, the change in it); write nothing
    #[arg(long, conflicts_with = "out")]
    dry_run: bool,
    /// Tell why a suspected cause is, or is not, told: words of its name, as "gravity flexure"
    #[arg(long, value_name = "NAME")]
    explain: Option<String>,
    /// Tell everything: evidence, noise, poses to measure, what these data could not have shown
    #[arg(long)]
    verbose: bool,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let studied = calibrating::studied(source::read(&arguments.study)?)?;
    if let Some(folder) = &arguments.out {
        if folder.is_file() {
            return Err(Failure::write(folder, &io::Error::other("a file has this name; name a folder")));
        }
        calibrating::refuse_to_replace(&studied, folder)?;
    }
    let files = Files::of(&studied);
    let progress = terminal::progress();
    let (reading, opened) = (progress.clone(), files.clone());
    let mut open = move |path: &str, options: &formats::Options| {
        reading.say(&format!("reading {path}"));
        opened.open(path, options)
    };
    let read = many::read(studied, arguments.search_rows, &mut open);
    progress.finish_and_clear();
    let (measured, others) = read?;
    let rows = measured.loaded.observations.rows();
    if let Some(others) = &others {
        terminal::note(format_args!(
            "{} observations; the search reads {rows} of them, drawn from all, and a fit every one (--search-rows)",
            others.all()
        ));
    }
    terminal::note(format_args!("{}", what_is_done(&measured.studied.plan, rows)));

    let (progress, waiting) = (terminal::progress(), Waiting::default());
    let calibrated = calibrating::calibrate(measured, &files, terminal::command_line(), &|stage| {
        progress.say(&waiting.told(stage));
    });
    let completed = calibrated.and_then(|mut calibrated| {
        if let Some(others) = others {
            others.complete(&mut calibrated, &mut open, &|told| progress.say(&told))?;
        }
        Ok(calibrated)
    });
    progress.finish_and_clear();
    let calibrated = completed?;
    let folder = arguments.out.as_ref().map(|folder| folder.display().to_string());
    let reported = calibrated.reported(folder.as_deref());
    let layout = Layout { width: terminal::width(), verbose: arguments.verbose };
    let explained = arguments.explain.as_ref().map(|name| why(&reported.calibration.diagnosis, name, layout));
    let explained = explained.transpose()?;
    if arguments.dry_run {
        let change = report::diff(&reported);
        if change.is_empty() {
            terminal::note(format_args!("the declaration would not change"));
        }
        terminal::print(match arguments.format {
            TextOrJson::Text => change,
            TextOrJson::Json => report::json(&reported)?,
        })?;
        return Ok(answer(reported.calibration));
    }
    if let Some(folder) = &arguments.out {
        let shown = report::rows_written(&reported, arguments.all_residuals);
        let instrument = calibrated.instrument(arguments.valid_until.as_deref());
        report_files::write_all(&reported, &shown, instrument, folder)?;
        let rows = reported.observations.rows();
        if shown.is_part_of(rows) {
            terminal::note(format_args!(
                "residuals.csv has {} of {rows} rows: those set aside, those with the largest residuals, and others by lot; \
                 `stands_for` says for how many each stands. --all-residuals writes every row",
                shown.rows.len()
            ));
        }
        terminal::note(format_args!("the report is in {}", folder.join("report.html").display()));
    }
    terminal::print(match arguments.format {
        TextOrJson::Text => report::as_text(&reported, layout),
        TextOrJson::Json => report::json(&reported)?.into(),
    })?;
    // The whole contest stands in the JSON.
    if let (TextOrJson::Text, Some(explained)) = (arguments.format, explained) {
        terminal::print(explained)?;
    }
    terminal::note_how_to_begin();
    Ok(answer(reported.calibration))
}

/// What is said of a suspected cause.
fn why(diagnosis: &Diagnosis, name: &str, layout: Layout) -> Result<Screen, Failure> {
    report::why(diagnosis, name, layout).ok_or_else(|| {
        let known = diagnosis.contest.iter().map(|own| own.name.as_str());
        let near = nearest(name, known.clone()).map_or_else(String::new, |near| format!("; nearest is \"{near}\""));
        let some: Vec<&str> = known.take(3).collect();
        Failure::Input(format!(
            "--explain: no explanation that competed has the words \"{name}\" in its name{near}. There are {} and {} more; report.json lists \
             them under `contest`",
            some.join(", "),
            diagnosis.contest.len() - some.len()
        ))
    })
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.replace('_', "").parse() {
        Ok(0) => Err("the search needs rows to read".to_owned()),
        Ok(rows) => Ok(rows),
        Err(_) => Err("write a whole number, such as 1000000".to_owned()),
    }
}

/// No, where no usable model came out.
fn answer(calibration: &Calibration) -> Answer {
    if calibration.diagnosis.verdict.is_usable() { Answer::Done } else { Answer::No }
}

/// `400 observations; fitting 30 errors, searching, and repeating the search in 10 folds`
fn what_is_done(plan: &Plan, rows: usize) -> String {
    let folds = match (&plan.hold_out.file, plan.hold_out.folds) {
        (Some(file), _) => format!("judging on {file}"),
        (None, folds) => format!("repeating the search in {folds} folds"),
    };
    let errors = match plan.fit.estimate.len() {
        1 => "1 error".to_owned(),
        count => format!("{count} errors"),
    };
    format!("{rows} observations; fitting {errors}, searching, and {folds}")
}
