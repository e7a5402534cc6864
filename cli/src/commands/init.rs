//! `trueaxis init`: a chain and a study to start from, out of a table of data.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use init::Look;
use init::templates::{self, TEMPLATES};
use model_core::escape::line;
use report::shell_word;
use report::wrap::paragraph;
use tables::formats::{self, DataError, Input, Options};
use tables::urdf::Robot;

use super::Answer;
use crate::failure::Failure;
use crate::{output, source, table_files, terminal};

/// Begin: write a chain and a study for a table of data.
///
/// Looks at the header and the rows, and writes NAME.chain, with the errors that are usual for this kind of instrument,
/// and NAME.toml, ready to run. What can be seen is not asked: which column is what, in which unit, which way angles
/// run. Nothing is overwritten.
///
/// With --urdf the declaration is made of a robot's URDF: its joints with origins, axes and limits. Columns of the data are named like the
/// joints. Without data only the declaration is written.
///
/// Example: trueaxis init examples/course/secret.csv --out mount.toml
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Measured data: a table with a header
    #[arg(required_unless_present_any = ["list", "urdf"])]
    data: Option<PathBuf>,
    /// The kind of instrument, where the header does not say it plainly
    #[arg(long, value_name = "NAME", value_parser = TEMPLATES.iter().map(|template| template.name).collect::<Vec<_>>())]
    template: Option<String>,
    /// A robot's description in URDF: the declaration is made of it
    #[arg(long, value_name = "R.urdf", conflicts_with = "template")]
    urdf: Option<PathBuf>,
    /// The link of that robot that is measured; default: the one behind the most joints that move
    #[arg(long, value_name = "LINK", requires = "urdf")]
    tip: Option<String>,
    /// The study to write, the chain beside it; default: named like the data, beside them
    #[arg(long, value_name = "STUDY.toml")]
    out: Option<PathBuf>,
    /// Only list the kinds of instruments, with the columns that each looks for
    #[arg(long, conflicts_with_all = ["data", "template", "urdf", "out"])]
    list: bool,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let robot = arguments.urdf.as_deref().map(robot).transpose()?;
    if let (Some(robot), Some(file), None) = (&robot, &arguments.urdf, &arguments.data) {
        return describe(arguments, robot, file);
    }
    let Some(data) = arguments.data.as_ref().filter(|_| !arguments.list) else {
        let mut list = String::new();
        for one in TEMPLATES {
            paragraph(&mut list, &format!("{:15}", one.name), one.what, terminal::width());
            paragraph(&mut list, "                 columns: ", one.looks_for, terminal::width());
        }
        terminal::print(&list)?;
        return Ok(Answer::Done);
    };
    if data == Path::new("-") {
        return Err(Failure::Input(
            "name a file with the data: the study has to say where they are".to_owned(),
        ));
    }
    let look = look(data)?;
    let (name_of, what, draft) = match &robot {
        Some(robot) => (
            "robot",
            "a robot as its URDF describes it",
            init::robot::draft(robot, arguments.tip.as_deref(), &look)?,
        ),
        None => {
            let named = arguments.template.as_deref().and_then(templates::named);
            let (template, draft) = init::draft(&look, named)?;
            (template.name, template.what, draft)
        }
    };
    let study_file = arguments.out.clone().unwrap_or_else(|| data.with_extension("toml"));
    let chain_file = study_file.with_extension("chain");
    let written = [&study_file, &chain_file];
    if study_file == chain_file {
        return Err(Failure::Input(format!(
            "`{}` is where the chain goes: name the study with --out, as `{}`",
            study_file.display(),
            study_file.with_extension("toml").display()
        )));
    }
    not_there(written)?;
    let names = init::Names {
        chain: &name(&chain_file)?,
        data: &beside(&study_file, data)?,
        command: &format!("trueaxis calibrate {}", shell_word(&text(&study_file)?)),
    };
    let study = init::study(&draft, &look, names);
    init::hold(&draft, &study, &mut |_| open(data))?.into_iter().for_each(terminal::warn);
    let mut batch = output::Batch::default();
    batch.write_text(&chain_file, &draft.chain)?;
    batch.write_text(&study_file, &study)?;
    batch.finish()?;
    for remark in &draft.remarks {
        terminal::note(format_args!("note: {remark}"));
    }
    terminal::print_text(format!(
        "{}: {}\n  the declaration: {}\n  the study: {}\nnext: trueaxis calibrate {}\n",
        name_of,
        what,
        line(&chain_file.to_string_lossy()),
        line(&study_file.to_string_lossy()),
        shell_word(&study_file.display().to_string())
    ))?;
    Ok(Answer::Done)
}

/// A robot's description.
fn robot(file: &Path) -> Result<Robot, Failure> {
    let text = source::read(file)?;
    Ok(Robot::of(&text.text).map_err(|mistake| text.mistake(mistake))?)
}

/// Writes the declaration of a robot alone.
fn describe(arguments: &Arguments, robot: &Robot, file: &Path) -> Result<Answer, Failure> {
    let chain_file = arguments.out.as_deref().unwrap_or(file).with_extension("chain");
    not_there([&chain_file])?;
    let described = init::robot::described(robot, arguments.tip.as_deref())?;
    output::write_text(&chain_file, &described.chain)?;
    for remark in &described.remarks {
        terminal::note(format_args!("note: {remark}"));
    }
    terminal::print_text(format!(
        "robot: a robot as its URDF describes it\n  the declaration: {0}\nnext: trueaxis identify {1}\n",
        line(&chain_file.to_string_lossy()),
        shell_word(&chain_file.display().to_string())
    ))?;
    Ok(Answer::Done)
}

/// Nothing is overwritten.
fn not_there<'p>(files: impl IntoIterator<Item = &'p PathBuf>) -> Result<(), Failure> {
    let there = files.into_iter().find(|file| fs::symlink_metadata(file).is_ok());
    there.map_or(Ok(()), |there| {
        Err(Failure::Input(format!(
            "`{}` is there already, and nothing is overwritten: name another study with --out",
            there.display()
        )))
    })
}

/// The data as they are looked at.
fn look(data: &Path) -> Result<Look, Failure> {
    let file = open(data).map_err(|error| Failure::Input(error.to_string()))?;
    let mut reader = formats::open(file, &data.display().to_string(), &Options::default())
        .map_err(|error| Failure::Input(error.to_string()))?;
    Ok(Look::at(&mut *reader)?)
}

fn open(data: &Path) -> Result<Input<'static>, DataError> {
    let unreadable = |error: &io::Error| DataError::Unreadable {
        file: data.display().to_string(),
        why: source::not_readable(data, error).to_string(),
    };
    table_files::open(data).map_err(|error| unreadable(&error))
}

/// A path as a study says it.
fn text(path: &Path) -> Result<String, Failure> {
    let text = path.to_str().map(str::to_owned);
    text.ok_or_else(|| {
        Failure::Input(format!("`{}` is no UTF-8, and no study could name it: rename it", path.display()))
    })
}

/// The last part of a path.
fn name(path: &Path) -> Result<String, Failure> {
    text(Path::new(path.file_name().unwrap_or_default()))
}

/// Where the data are, as seen from the study's folder.
fn beside(study: &Path, data: &Path) -> Result<String, Failure> {
    let folder = |path: &Path| match path.parent() {
        Some(parent) if parent != Path::new("") => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    let own = folder(study);
    let from = fs::canonicalize(&own).map_err(|error| Failure::write(study, &error))?;
    let to = fs::canonicalize(folder(data)).map_err(|error| Failure::read(data, &error))?;
    let common = from.components().zip(to.components()).take_while(|(one, other)| one == other).count();
    let up = from.components().skip(common).map(|_| Path::new("..").to_owned());
    let down = to.components().skip(common).map(|part| PathBuf::from(part.as_os_str()));
    let mut path: PathBuf = up.chain(down).collect();
    path.push(data.file_name().unwrap_or_default());
    Ok(text(&path)?.replace(std::path::MAIN_SEPARATOR, "/"))
}
