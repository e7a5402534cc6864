//! `trueaxis budget`: what each error alone does to an observable, all of them together, and what tolerances come to.

use std::path::{Path, PathBuf};

use claims::checker::{Checker, Claim};
use model_core::Chain;
use model_core::budget::{Budget, BudgetError, Curves, Poses};
use model_core::escape::{self, Screen};
use model_core::mistake::Mistake;
use model_core::remainder::DomainError;
use serde_json::{Value, json};
use service::budget::{self, Measured, Shown, curves};
use service::claims_file::ClaimsFile;
use service::ranges::RangeArgument;
use service::source::observables;
use service::{Source, poses};

use super::{Answer, TextOrJson};
use crate::budget::{DesignerArguments, designed};
use crate::claims_file;
use crate::expected::{self, Work};
use crate::failure::Failure;
use crate::sizes::SizesArgument;
use crate::source::Declared;
use crate::{output, terminal, whole};
use claims::file::Checked;

/// Measure what each error alone does, what all do together, and what tolerances come to.
///
/// The influence of an error is the angle between the direction with it and the one without, or the distance of
/// the two points, on the exact form. Over the poses it is given by its largest value and its root mean square:
/// along a path of one parameter t over (0, 2π), or over ranges (joints without one make a full turn). The worst case
/// is the sum of all influences at a pose, the root sum square what to expect of independent errors of these sizes.
///
/// For a designer the sizes are tolerances: how errors are spread over them, percentiles of draws of all at once, which to
/// tighten first, sizes for a wanted error, and what remains after a calibration.
///
/// Example: trueaxis budget examples/mobile-lidar/mobile-lidar.chain --sizes examples/mobile-lidar/box.toml
/// --observable pointing --path "alpha=t, beta=t, gamma=t" --steps 5 --out figures
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration, or an instrument file
    chain: PathBuf,
    #[command(flatten)]
    sizes: SizesArgument,
    /// Only this observable (may be given several times); default: every one
    #[arg(long)]
    observable: Vec<String>,
    /// Joints and inputs as functions of t: "alpha=t, beta=t/2, range=10 m"
    #[arg(long, value_name = "joint=amount, …", conflicts_with = "range")]
    path: Option<String>,
    /// Range of a joint or input: "elevation=10 deg..80 deg" (may be given several times)
    #[arg(long, value_name = "joint=lo..hi")]
    range: Vec<RangeArgument>,
    /// Curves for each error along a path, at sizes in equal steps up to its own
    #[arg(long, default_value_t = 1, value_parser = whole::number(1..=20), allow_negative_numbers = true)]
    steps: u32,
    /// Folder for budget.html, budget.csv and, along a path, <observable>.csv and <observable>.svg with the influences against t
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// A claims file whose comparisons of influences stand in budget.html beside the curves
    #[arg(long, value_name = "CLAIMS.toml", requires = "out")]
    claims: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
    #[command(flatten)]
    designer: DesignerArguments,
}

/// Points of a curve: one every degree of a full turn, both ends included.
const POINTS: usize = 361;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let declared = Declared::read(&arguments.chain)?;
    let sizes = declared.sizes(&arguments.sizes)?;
    let ranges = declared.ranges(&arguments.range)?;
    let chain = declared.chain;
    let poses = match &arguments.path {
        Some(text) => Poses::Path(poses::path(&chain, text, &terminal::warn).map_err(|mistake| {
            let source = Source::of_text("--path", text);
            source.mistake(mistake)
        })?),
        None => Poses::Ranges(poses::joint_ranges(&ranges)),
    };
    let waiting = expected::announce(&chain, Work::Budget);
    let is_named = !arguments.observable.is_empty();
    let mut all = Vec::new();
    for budget in measured(&chain, &sizes, &poses, &arguments.observable)? {
        let designer = &arguments.designer;
        let designed = match designer.is_asked() || arguments.out.is_some() {
            true => designed(&chain, budget.observable, &sizes, &poses, designer, is_named)?,
            false => None,
        };
        let curves = match (&poses, &arguments.out) {
            (Poses::Path(path), Some(_)) => Some(
                Curves::along(&chain, budget.observable, &sizes, path, POINTS, arguments.steps)
                    .map_err(|error| failure(&error))?,
            ),
            _ => None,
        };
        all.push(Measured { budget, designed, curves });
    }
    let mut measured = all;
    if arguments.designer.wanted.is_some() && measured.iter().all(|one| one.designed.is_none()) {
        let why = "--wanted is of no kind that an observable shows: write an angle for a direction, a length for a point";
        return Err(Failure::Input(why.to_owned()));
    }
    if let Some(folder) = &arguments.out {
        write_files(arguments, &chain, &measured, folder)?;
    }
    drop(waiting);
    if !arguments.designer.is_asked() {
        measured.iter_mut().for_each(|one| one.designed = None);
    }
    match arguments.format {
        TextOrJson::Text => {
            let mut tables = Screen::default();
            for (at, one) in measured.iter().enumerate() {
                tables.append(&if at > 0 { "\n".into() } else { Screen::default() });
                tables.append(&budget::as_text(&chain, one));
            }
            terminal::print_text(tables)?;
        }
        TextOrJson::Json => {
            let budgets: Vec<Value> =
                measured.iter().map(|one| budget::as_json(&chain, one, &poses)).collect();
            terminal::print_json(&json!({ "observables": budgets }))?;
        }
    }
    Ok(Answer::Done)
}

/// The budgets of the named observables, or of all.
///
/// # Errors
/// A name that the chain does not declare, or a joint or input without a value.
pub fn measured(
    chain: &Chain,
    sizes: &[f64],
    poses: &Poses,
    names: &[String],
) -> Result<Vec<Budget>, Failure> {
    let mut budgets = Vec::new();
    for observable in observables(chain, names)? {
        match Budget::measure(chain, observable, sizes, poses) {
            Ok(budget) => budgets.push(budget),
            // Nobody asked for this observable in particular; the others still have an answer.
            Err(error @ (BudgetError::NoValue { .. } | BudgetError::Pole(DomainError::Lost { .. })))
                if names.is_empty() =>
            {
                terminal::warn(format_args!("{} is left out: {error}", chain.observable(observable).name));
            }
            Err(error) => return Err(failure(&error)),
        }
    }
    Ok(budgets)
}

/// A value that is missing is given on the command line.
fn failure(error: &BudgetError) -> Failure {
    Failure::Input(match error {
        BudgetError::NoValue { name, .. } => {
            format!("{error}: name {name} in --path, or say --range \"{name}=lo..hi\"")
        }
        BudgetError::NotFinite { .. }
        | BudgetError::Pole(_)
        | BudgetError::AtPose { .. }
        | BudgetError::Form(_)
        | BudgetError::Units { .. }
        | BudgetError::NotVector { .. } => error.to_string(),
    })
}

fn write_files(
    arguments: &Arguments,
    chain: &Chain,
    measured: &[Measured],
    folder: &Path,
) -> Result<(), Failure> {
    let claims = arguments.claims.as_deref().map(claims_file::read).transpose()?;
    let checked = claims.as_ref().map(comparisons).transpose()?;
    let shown = Shown {
        chain,
        poses: in_words(arguments),
        command: terminal::command_line(),
        measured,
        claims: claims.as_ref().map(|file| file.source.path.display().to_string()).zip(checked.as_deref()),
    };
    let mut files = output::Folder::new(folder)?;
    files.write_text("budget.csv", &budget::as_csv(chain, measured))?;
    files.write_text("budget.html", &budget::page(&shown))?;
    for (budget, curves) in measured.iter().filter_map(|one| Some((&one.budget, one.curves.as_ref()?))) {
        let name = match chain.observable(budget.observable).name.as_str() {
            // The table of all observables has this name.
            name if name.eq_ignore_ascii_case("budget") => format!("{name}_curves"),
            name => name.to_owned(),
        };
        files.write_text(&format!("{name}.csv"), &curves::csv(chain, curves))?;
        match curves::svg(chain, budget.observable, curves) {
            Some(figure) => files.write_text(&format!("{name}.svg"), &escape::page(&figure))?,
            // An earlier run's would speak of other sizes.
            None => files.remove(&format!("{name}.svg")),
        }
    }
    files.finish()
}

/// The poses as the user wrote them.
fn in_words(arguments: &Arguments) -> String {
    match &arguments.path {
        Some(path) => format!("along {path}, with t over (0, 2π)"),
        None if arguments.range.is_empty() => "over full turns of every joint".to_owned(),
        None => {
            let ranges: Vec<String> = arguments.range.iter().map(ToString::to_string).collect();
            format!("over {}; full turns of the other joints", ranges.join(", "))
        }
    }
}

/// The verdicts on what somebody stated of the size of influences.
fn comparisons(file: &ClaimsFile) -> Result<Vec<Checked<'_>>, Failure> {
    let mut checker = Checker::new(&file.said.chain);
    let compared = file.said.claims.iter().filter(|named| matches!(named.claim, Claim::Comparison(_)));
    compared
        .map(|claim| match checker.check(&claim.claim) {
            Ok(verdict) => Ok(Checked { claim, verdict }),
            Err(error) => {
                Err(file.source.mistake(Mistake::new(claim.place.clone(), error.to_string())).into())
            }
        })
        .collect()
}
