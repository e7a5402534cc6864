//! `trueaxis apply`: new data corrected with a calibrated model, and readings that point where somebody wants.

use std::path::PathBuf;

use model_core::{Chain, Quantity as Measures};
use service::Instrument;
use service::apply::{self, AsMeasured, Beside, Correction, PoseForm};
use service::ranges::{self, RangeArgument};
use service::readings::ReadingsTable;
use tables::units;

use super::Answer;
#[cfg(feature = "point-clouds")]
use crate::cloud;
use crate::failure::Failure;
use crate::over_table::{Model, Opened, OverTable};
use crate::{output, posing, solving, table_files, terminal, trajectory};

/// Correct new data with a calibrated model.
///
/// Reads any file with the headings of the study, and writes every column of it with what was observed there: where the
/// instrument with its calibrated errors really points, or where its points really are, under the headings of the study's
/// data, in their units and notation. Columns of these names in the input are replaced, and a warning names them.
///
/// With a declaration and --errors it reads columns named like the chain's joints and inputs, and writes the corrected
/// `<observable>_x`, `_y`, `_z`.
///
/// With --solve it goes the other way: it reads where the instrument is to point, under the headings that the study's data have for
/// what was observed, or in columns `<observable>_x` and so on, and writes the readings of the joints that do so, in the columns and units
/// of the study's data, with the angle or distance that remains. Columns of the joints in the input
/// are where the search starts; without any it starts from the nearest of poses spread over the ranges that the model was
/// found over.
///
/// With --solve --pose it does so for whole poses of a robot's hand, and says of each row whether the pose is reached.
///
/// With a point cloud, a .las or .laz file whose coordinates were computed without the errors, it moves every point to where the
/// errors have it and keeps every other byte. Readings stand in extra dimensions of the points, or in a table by GPS time.
///
/// With a trajectory, an SBET file, of an instrument whose study joins rows with one, it corrects every position and attitude by lever arm and
/// boresight, and keeps every other number: with the nominal mounting the corrected trajectory gives the calibrated points.
///
/// Example: trueaxis apply result/instrument.toml --data new.csv --out corrected.csv
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    table: OverTable,
    /// How directions are written, and read with --solve: angles are written in degrees; default: as the data of an instrument file
    /// have them, else vector
    #[arg(long = "as", value_enum)]
    form: Option<As>,
    /// Write the correction, too: what the calibrated errors add to each column
    #[arg(long)]
    correction: bool,
    /// Write the standard uncertainty of each column, by the covariance of an instrument file, and whether the row lies inside the measured
    /// region
    #[arg(long, conflicts_with = "solve")]
    uncertainty: bool,
    /// Find the readings of the joints that point at what the table wants
    #[arg(long)]
    solve: bool,
    /// With --solve: the table wants whole poses of a body with an observed point, `<observable>_x`, `_y`, `_z` and an orientation: quaternion
    /// (`_qw`, `_qx`, `_qy`, `_qz`), matrix (`_r11` to `_r33`), vector (`_rx`, `_ry`, `_rz`), three angles by their axes, as euler-zyx (`_e1`,
    /// `_e2`, `_e3`); or joints: a program of readings for an instrument without errors
    #[arg(long, value_name = "FORM", requires = "solve", conflicts_with_all = ["form", "correction"])]
    pose: Option<PoseForm>,
    /// With --solve: limits of a joint, as "q2=-120 deg..0 deg" (may be given several times)
    #[arg(long, value_name = "joint=lo..hi", requires = "solve")]
    range: Vec<RangeArgument>,
    /// Of a point cloud: the readings that its points have not, in a .csv or .parquet file by GPS time
    #[arg(long, value_name = "TABLE")]
    readings: Option<PathBuf>,
    /// The column of that table that has the times, s; default: `gps_time` or `time`
    #[arg(long, value_name = "COLUMN", requires = "readings")]
    time: Option<String>,
    /// Of a point cloud: how far its points may be from where the chain has them without errors, as "2 mm"; default: a step of the
    /// coordinates, and what a step of the readings moves
    #[arg(long, value_name = "LENGTH", value_parser = distance)]
    tolerance: Option<f64>,
}

/// How a direction is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum As {
    /// Components x, y and z; points are always written so
    Vector,
    /// Azimuth from y through x, and elevation above the xy plane
    AzimuthElevation,
    /// Hour angle and declination, for a chain whose x is west, y the meridian on the equator, z the pole
    HaDec,
}

impl From<As> for apply::As {
    fn from(form: As) -> Self {
        match form {
            As::Vector => Self::Vector,
            As::AzimuthElevation => Self::AzimuthElevation,
            As::HaDec => Self::HaDec,
        }
    }
}

impl Arguments {
    /// How directions are written where no data say it.
    fn form(&self) -> apply::As {
        self.form.unwrap_or(As::Vector).into()
    }
}

/// A distance above zero, in m.
fn distance(text: &str) -> Result<f64, String> {
    match units::parse(text, Measures::Length) {
        Ok(metres) if metres > 0.0 => Ok(metres),
        Ok(_) => Err("write a distance above zero, as \"2 mm\"".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    #[cfg(feature = "point-clouds")]
    if table_files::is_point_cloud(&arguments.table.data) {
        correct_cloud(arguments)?;
        return Ok(Answer::Done);
    }
    if trajectory::is_one_of(&arguments.table.data) {
        correct_trajectory(arguments)?;
        return Ok(Answer::Done);
    }
    let of_clouds =
        [("--readings", arguments.readings.is_some()), ("--tolerance", arguments.tolerance.is_some())];
    if let Some((option, _)) = of_clouds.iter().find(|(_, is_given)| *is_given)
        && !table_files::is_point_cloud(&arguments.table.data)
    {
        return Err(Failure::Input(format!(
            "{option} is for point clouds, and `{}` is a table: leave it out, or name a .las or .laz file with --data",
            arguments.table.data.display()
        )));
    }
    if arguments.solve {
        let opened = arguments.table.open()?;
        let limits = ranges::of_chain(&opened.chain, &arguments.range, &terminal::warn)?;
        match arguments.pose {
            Some(pose) => posing::solve(&arguments.table, pose, &limits, opened)?,
            None => {
                let form = arguments.form.map(apply::As::from);
                solving::solve(&arguments.table, form, arguments.correction, &limits, opened)?;
            }
        }
    } else {
        correct(arguments)?
    }
    Ok(Answer::Done)
}

/// Refuses what only tables have.
fn no_table(arguments: &Arguments, what: &str) -> Result<(), Failure> {
    let of_tables = [
        ("--as", arguments.form.is_some()),
        ("--correction", arguments.correction),
        ("--uncertainty", arguments.uncertainty),
        ("--solve", arguments.solve),
    ];
    match of_tables.iter().find(|(_, is_given)| *is_given) {
        Some((option, _)) => Err(Failure::Input(format!("{option} is for tables, and {what}: leave it out"))),
        None => Ok(()),
    }
}

fn correct_trajectory(arguments: &Arguments) -> Result<(), Failure> {
    no_table(arguments, "a trajectory keeps the numbers that it has")?;
    let table = &arguments.table;
    output::refuse_to_replace(&table.out, [table.data.as_path()])?;
    let Model { instrument, .. } = table.model()?;
    let instrument = instrument.ok_or_else(|| {
        Failure::Input(format!(
            "`{}` is a declaration, and a trajectory is corrected by the instrument file that `calibrate` writes: give that one",
            table.chain().display()
        ))
    })?;
    let said = trajectory::correct(&instrument, &table.data, &table.out)?;
    if table.out.is_file() {
        terminal::print_text(said)
    } else {
        said.lines().for_each(terminal::note);
        Ok(())
    }
}

#[cfg(feature = "point-clouds")]
fn correct_cloud(arguments: &Arguments) -> Result<(), Failure> {
    let table = &arguments.table;
    no_table(arguments, "the points of a cloud keep the dimensions that they have")?;
    let read = [&table.data].into_iter().chain(&arguments.readings);
    output::refuse_to_replace(&table.out, read.map(PathBuf::as_path))?;
    let Model { chain, values, found, .. } = table.model()?;
    cloud::correct(cloud::Correction {
        chain: &chain,
        values: &values,
        found,
        named: &table.observable,
        data: &table.data,
        readings: arguments.readings.as_deref(),
        time: arguments.time.as_deref(),
        comment: table.comment,
        tolerance_m: arguments.tolerance,
        out: &table.out,
    })
}

fn correct(arguments: &Arguments) -> Result<(), Failure> {
    let Opened { chain, values, found, instrument, mut table } = arguments.table.open()?;
    if arguments.uncertainty && instrument.is_none() {
        return Err(no_instrument(arguments));
    }
    let beside = Beside { correction: arguments.correction, uncertainty: arguments.uncertainty };
    let named = &arguments.table.observable;
    let mut correction = match as_measured(arguments, &chain, instrument.as_ref(), &table) {
        Some((instrument, seen)) => Correction::as_measured(instrument, seen, &mut table, beside)?,
        None => {
            let chosen = table.with_readings(&chain, named)?;
            let asked = (chosen, arguments.form(), !named.is_empty());
            let of = (values.as_slice(), found);
            Correction::of_observables(&chain, of, instrument.as_ref(), asked, &mut table, beside)?
        }
    };
    let (added, place) = (correction.added.clone(), correction.place);
    arguments.table.write(table, &added, place, |rows| Ok(correction.rows(rows)?))?;
    correction.warning().iter().for_each(terminal::warn);
    Ok(())
}

/// How the data of an instrument have what was observed, unless another form or observable is asked for.
fn as_measured<'i>(
    arguments: &Arguments,
    chain: &Chain,
    instrument: Option<&'i Instrument>,
    table: &ReadingsTable<'_>,
) -> Option<(&'i Instrument, AsMeasured)> {
    let instrument = instrument.filter(|_| arguments.form.is_none())?;
    let seen = AsMeasured::of(instrument, table.source_of_study()?)?;
    let is_asked = |name: &String| chain.observable(seen.observable).name == *name;
    arguments.table.observable.iter().all(is_asked).then_some((instrument, seen))
}

/// Where uncertainties are asked of what has none.
fn no_instrument(arguments: &Arguments) -> Failure {
    Failure::Input(format!(
        "--uncertainty needs the covariance of an instrument file, and `{}` is a declaration: give the instrument file that `calibrate` writes",
        arguments.table.chain().display()
    ))
}
