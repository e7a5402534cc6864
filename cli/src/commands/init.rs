//! `trueaxis init`: a chain and a study to start from, out of a table of data.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use init::robot::Description;
use init::templates::{self, TEMPLATES};
use init::{Look, links};
use model_core::escape::line;
use report::shell_word;
use report::wrap::paragraph;
use service::beginning::{Begun, begun};
use tables::dh::{self, Dh};
use tables::formats::{Options, Site, TableReader};
use tables::ur::{self, Deltas};
use tables::urdf::Robot;

use super::Answer;
use crate::beginning::Joined;
use crate::failure::Failure;
use crate::{output, source, table_files, terminal};

/// Begin: write a chain and a study for a table of data.
///
/// Looks at the header and the rows, and writes NAME.chain, with the errors that are usual for this kind of instrument,
/// and NAME.toml, ready to run. What can be seen is not asked: which column is what, in which unit, which way angles
/// run. Where the rows contradict a header, the study reads the column as the rows ask for, with a comment. Nothing is overwritten.
///
/// Files of other programs are known by what they begin with: observations of TPOINT, models of MountWizzard4, points of AutoSlew, plate
/// solves, GSI of Leica. So are tests of machine tools: ball bars, R-tests, plates and grids. What was read and assumed is printed.
///
/// With --robot the declaration is made of a robot's description: its URDF, a table of Denavit and Hartenberg, or a calibration.conf of Universal
/// Robots. Columns of the data are named like the joints. Without data only the declaration is written.
///
/// Example: trueaxis init examples/course/secret.csv --out mount.toml
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Measured data, or a robot's description alone
    #[arg(required_unless_present_any = ["list", "robot"])]
    data: Option<PathBuf>,
    /// The trajectory of a vehicle with a scanner: an SBET file, or a table by time
    #[arg(requires = "data", conflicts_with = "robot")]
    trajectory: Option<PathBuf>,
    /// The kind of instrument, where the header does not say it plainly
    #[arg(long, value_name = "NAME", value_parser = TEMPLATES.iter().map(|template| template.name).collect::<Vec<_>>())]
    template: Option<String>,
    /// A robot's description: URDF, a table of Denavit and Hartenberg, or calibration.conf
    #[arg(long, value_name = "FILE", visible_alias = "urdf", conflicts_with = "template")]
    robot: Option<PathBuf>,
    /// The link of that robot that is measured; default: the one behind the most joints that move
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// The arm that a calibration.conf is of, such as UR10e
    #[arg(long, value_name = "NAME")]
    arm: Option<String>,
    /// Latitude of the site, degrees, for files that give times and no place
    #[arg(long, value_name = "DEG", requires = "longitude", allow_negative_numbers = true, value_parser = latitude)]
    latitude: Option<f64>,
    /// Longitude of the site, degrees, east positive
    #[arg(long, value_name = "DEG", requires = "latitude", allow_negative_numbers = true, value_parser = longitude)]
    longitude: Option<f64>,
    /// The study to write, the chain beside it; default: named like the data, beside them
    #[arg(long, value_name = "STUDY.toml")]
    out: Option<PathBuf>,
    /// Only list the kinds of instruments, with the columns that each looks for
    #[arg(long, conflicts_with_all = ["data", "template", "robot", "out"])]
    list: bool,
}

fn latitude(text: &str) -> Result<f64, String> {
    degrees(text, 90.0)
}

fn longitude(text: &str) -> Result<f64, String> {
    degrees(text, 360.0)
}

fn degrees(text: &str, most: f64) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.abs() <= most);
    number.ok_or_else(|| format!("write degrees from -{most} to {most}, such as 48.5"))
}

impl Arguments {
    /// Where the instrument stands.
    fn site(&self) -> Option<Site> {
        let (latitude_deg, longitude_deg) = (self.latitude?, self.longitude?);
        Some(Site { latitude_deg, longitude_deg })
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let robot = match &arguments.robot {
        Some(file) => Some(described(file, arguments.arm.as_deref())?.ok_or_else(|| no_robot(file))?),
        None => None,
    };
    if let (Some(robot), Some(file), None) = (&robot, &arguments.robot, &arguments.data) {
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
    if robot.is_none()
        && let Some(robot) = described(data, arguments.arm.as_deref())?
    {
        return describe(arguments, &robot, data);
    }
    let open = || table(data, arguments.site());
    let joined = arguments.trajectory.as_deref().map(|file| Joined::read(file, &mut *open()?)).transpose()?;
    let look = match &joined {
        Some(joined) => Look::at(&mut *joined.table(open()?)?)?,
        None => Look::at(&mut *open()?)?,
    };
    let (name_of, what, draft) = match &robot {
        Some(robot) => (
            "robot",
            format!("a robot as {} describes it", robot.what),
            init::robot::draft(robot, arguments.tip.as_deref(), &look)?,
        ),
        None => {
            let named = arguments.template.as_deref().or(joined.as_ref().map(|_| "vehicle"));
            let named = named.and_then(templates::named);
            let (template, draft) = init::draft(&look, named)?;
            (template.name, template.what.to_owned(), draft)
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
    let data_named = beside(&study_file, data)?;
    let trajectory_named = joined.as_ref().map(|joined| beside(&study_file, &joined.file)).transpose()?;
    let trajectory =
        joined.as_ref().zip(trajectory_named.as_deref()).map(|(joined, file)| joined.named(file));
    let names = init::Names {
        chain: &name(&chain_file)?,
        data: &data_named,
        command: &format!("trueaxis calibrate {}", shell_word(&text(&study_file)?)),
        site: arguments.site(),
        trajectory,
    };
    let mut again = |name: &str| {
        let trajectory = arguments.trajectory.as_deref().filter(|_| name != data_named);
        table_files::open_named(trajectory.unwrap_or(data), None)
    };
    let Begun { study, remarks, doubtful } = begun(&draft, &look, names, &mut again)?;
    doubtful.into_iter().for_each(terminal::warn);
    let mut batch = output::Batch::default();
    batch.write_text(&chain_file, &draft.chain)?;
    batch.write_text(&study_file, &study)?;
    batch.finish()?;
    let of_times = joined.as_ref().and_then(Joined::said);
    for remark in remarks.iter().chain(&of_times) {
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
    terminal::note_how_to_begin();
    Ok(Answer::Done)
}

/// How much of a file is looked at for a robot's description.
const BEGINNING: u64 = 64 * 1024;

/// The robot that a file describes; none of another file.
fn described(file: &Path, arm: Option<&str>) -> Result<Option<Description>, Failure> {
    let mut head = Vec::new();
    // What cannot be read is said where it is read as data.
    if File::open(file).and_then(|own| own.take(BEGINNING).read_to_end(&mut head)).is_err() {
        return Ok(None);
    }
    let head = String::from_utf8_lossy(&head);
    let is_xml = head.trim_start_matches('\u{feff}').trim_start().starts_with('<');
    if !is_xml && !dh::looks(&head) && !ur::looks(&head) {
        return Ok(None);
    }
    let text = source::read(file)?;
    let named = file.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    if is_xml {
        let robot = Robot::of(&text.text).map_err(|mistake| text.mistake(mistake))?;
        return Ok(Some(Description::urdf(robot)));
    }
    let shown = file.display().to_string();
    if dh::looks(&text.text) {
        let table = Dh::of(&text.text, &shown).map_err(table_files::failure)?;
        return Ok(Some(links::dh(&named, &table)));
    }
    let deltas = Deltas::of(&text.text).map_err(|error| Failure::Input(format!("{shown}: {error}")))?;
    Ok(Some(links::ur(&named, &deltas, arm)?))
}

/// Where a file was named as a robot's description and is none.
fn no_robot(file: &Path) -> Failure {
    Failure::Input(format!(
        "`{}` describes no robot: name a URDF, a table with theta, d, a and alpha, or a calibration.conf with [mounting]",
        file.display()
    ))
}

/// Writes the declaration of a robot alone.
fn describe(arguments: &Arguments, robot: &Description, file: &Path) -> Result<Answer, Failure> {
    let chain_file = arguments.out.as_deref().unwrap_or(file).with_extension("chain");
    not_there([&chain_file])?;
    let described = init::robot::described(robot, arguments.tip.as_deref())?;
    output::write_text(&chain_file, &described.chain)?;
    for remark in &described.remarks {
        terminal::note(format_args!("note: {remark}"));
    }
    if arguments.robot.is_none() {
        terminal::note(
            "note: a description has no measured poses: with a table of them, give both, as in `trueaxis init poses.csv --robot` and this file",
        );
    }
    terminal::print_text(format!(
        "robot: a robot as {} describes it\n  the declaration: {}\nnext: trueaxis identify {}\n",
        robot.what,
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

/// The data, opened to be looked at.
fn table(data: &Path, site: Option<Site>) -> Result<Box<dyn TableReader>, Failure> {
    if data.extension().is_some_and(|ending| ending == "chain" || ending == "toml") {
        return Err(Failure::Input(format!(
            "`{}` is no table: give the table of measured data, as in `trueaxis init data.csv`",
            data.display()
        )));
    }
    let options = Options { site, ..Options::default() };
    table_files::open_table(data, &options).map_err(table_files::failure)
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
