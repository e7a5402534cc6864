//! `trueaxis calibrate`: fit, residual, trace, amend, report.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use calibration::calibrate::{Calibration, Request, calibrate_telling};
use calibration::formats::DataError;
use calibration::study::{Loaded, Plan, Study};
use model_core::Mistakes;

use super::{Answer, TextOrJson};
use crate::failure::Failure;
use crate::report::{self, FileRead, Layout, Provenance, Reported};
use crate::source::Source;
use crate::{date, output, sha256, source, tables, terminal};

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
    /// Folder for report.html, report.json, amended.chain, errors.toml and residuals.csv
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Only print how the declaration would change (with --format json: the whole report, the change in it); write nothing
    #[arg(long, conflicts_with = "out")]
    dry_run: bool,
    /// Tell everything: evidence, noise, poses to measure, what these data could not have shown
    #[arg(long)]
    verbose: bool,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let study_source = Source::read(&arguments.study)?;
    let in_study = |mistakes: Mistakes| study_source.mistakes(&mistakes);
    let study = Study::from_text(&study_source.text).map_err(in_study)?;
    let chain_source = study_source.read_beside(Path::new(study.chain.get_ref()))?;
    let plan = study.plan(&chain_source.chain()?).map_err(in_study)?;
    if let Some(folder) = &arguments.out {
        refuse_to_replace(folder, &plan, [&study_source, &chain_source])?;
    }

    let mut open = |path: &str| open_beside(&study_source, path);
    let Loaded { observations, held_out: second, doubtful } =
        plan.load(&mut open).map_err(tables::failure)?;
    doubtful.iter().for_each(terminal::warn);
    terminal::note(format_args!("{}", what_is_done(&plan, observations.rows())));

    let date = date::today();
    let request = Request {
        text: &chain_source.text,
        plan: &plan,
        observations: &observations,
        second: second.as_ref(),
        when: &date,
    };
    let progress = terminal::progress();
    let calibration = calibrate_telling(request, &|stage| progress.set_message(stage.to_string()));
    progress.finish_and_clear();
    let calibration = calibration.map_err(|error| Failure::Input(error.to_string()))?;
    let folder = arguments.out.as_ref().map(|folder| folder.display().to_string());
    let reported = Reported {
        calibration: &calibration,
        observations: &observations,
        chain_file: study.chain.get_ref(),
        chain_text: &chain_source.text,
        folder: folder.as_deref(),
        provenance: Provenance {
            version: env!("CARGO_PKG_VERSION"),
            command: command_line(),
            date: date.clone(),
            study: study_source.text.clone(),
            files: files_read(arguments, &study_source, study.chain.get_ref(), &plan)?,
        },
    };
    if arguments.dry_run {
        terminal::print(&match arguments.format {
            TextOrJson::Text => report::diff(&reported),
            TextOrJson::Json => report::json(&reported)?,
        })?;
        return Ok(answer(&calibration));
    }
    if let Some(folder) = &arguments.out {
        report::write_all(&reported, folder)?;
        terminal::note(format_args!("the report is in {}", folder.join("report.html").display()));
    }
    let layout = Layout { width: terminal::width(), verbose: arguments.verbose };
    terminal::print(&match arguments.format {
        TextOrJson::Text => report::as_text(&reported, layout),
        TextOrJson::Json => report::json(&reported)?,
    })?;
    Ok(answer(&calibration))
}

/// The command as it was typed; a letter that is none is shown as such.
fn command_line() -> String {
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    words.collect::<Vec<_>>().join(" ")
}

/// No, where no usable model came out.
fn answer(calibration: &Calibration) -> Answer {
    if calibration.diagnosis.verdict.is_usable() { Answer::Done } else { Answer::No }
}

/// The study, the declaration and the data with their checksums.
fn files_read(
    arguments: &Arguments,
    study: &Source,
    chain: &str,
    plan: &Plan,
) -> Result<Vec<FileRead>, Failure> {
    let data = plan.sources.iter().flat_map(|source| &source.paths).chain(&plan.hold_out.file);
    let mut files = vec![(arguments.study.display().to_string(), arguments.study.clone())];
    // What is no file, a pipe say, has been read already.
    for path in std::iter::once(chain).chain(data.map(String::as_str)) {
        files.push((path.to_owned(), study.beside(Path::new(path))));
    }
    let read = |(path, place): (String, PathBuf)| {
        if !fs::metadata(&place).is_ok_and(|metadata| metadata.is_file()) {
            return Ok(FileRead { path, sha256: None });
        }
        let bytes = fs::read(&place).map_err(|error| source::not_readable(&place, &error))?;
        Ok(FileRead { path, sha256: Some(sha256::hex(&bytes)) })
    };
    files.into_iter().map(read).collect()
}

/// Refuses to write the results over what the study reads.
fn refuse_to_replace(folder: &Path, plan: &Plan, [study, chain]: [&Source; 2]) -> Result<(), Failure> {
    let data = plan.sources.iter().flat_map(|source| &source.paths).chain(&plan.hold_out.file);
    let read: Vec<PathBuf> = data
        .map(|path| study.beside(Path::new(path)))
        .chain([study.path.clone(), chain.path.clone()])
        .collect();
    report::NAMES
        .iter()
        .try_for_each(|name| output::refuse_to_replace(&folder.join(name), read.iter().map(PathBuf::as_path)))
}

/// `400 observations; fitting 30 errors, searching, and repeating the search in 10 folds`
fn what_is_done(plan: &Plan, rows: usize) -> String {
    let folds = match (&plan.hold_out.file, plan.hold_out.folds) {
        (Some(file), _) => format!("judging on {file}"),
        (None, folds) => format!("repeating the search in {folds} folds"),
    };
    format!("{rows} observations; fitting {} errors, searching, and {folds}", plan.fit.estimate.len())
}

/// Opens a data file that the study names.
fn open_beside(study: &Source, path: &str) -> Result<Box<dyn Read>, DataError> {
    let beside = study.beside(Path::new(path));
    let unreadable = |error: &io::Error| {
        let why = match source::not_readable(&beside, error) {
            Failure::Read { why, .. } => why,
            other => other.to_string(),
        };
        DataError::Unreadable { file: beside.display().to_string(), why }
    };
    let file = File::open(&beside).map_err(|error| unreadable(&error))?;
    if file.metadata().is_ok_and(|metadata| metadata.is_dir()) {
        return Err(unreadable(&io::ErrorKind::IsADirectory.into()));
    }
    Ok(Box::new(file))
}
