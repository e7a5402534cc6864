//! `trueaxis budget`: what each error alone does to an observable, and all of them together.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use model_core::Chain;
use model_core::budget::{Budget, BudgetError, Curves, Poses, Summary};
use serde_json::{Value, json};

use super::{Answer, TextOrJson};
use crate::failure::Failure;
use crate::ranges::{self, RangeArgument};
use crate::sizes::SizesArgument;
use crate::source::{Source, observables};
use crate::terminal::{self, HEADING};
use crate::{curves, errors_file, output, poses};

/// Measure what each error alone does, and what all do together.
///
/// The influence of an error is the angle between the direction with it and the one without, or the distance of
/// the two points, on the exact form. Over the poses it is given by its largest value and its root mean square:
/// along a path of one parameter t over (0, 2π), or over ranges (joints without one make a full turn). The worst case
/// is the sum of all influences at a pose, the root sum square what to expect of independent errors.
///
/// Example: trueaxis budget examples/mobile-lidar/mobile-lidar.chain --sizes examples/mobile-lidar/box.toml
/// --observable pointing --path "alpha=t, beta=t, gamma=t" --steps 5 --out figures
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration
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
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=20))]
    steps: u32,
    /// Folder for budget.csv and, along a path, <observable>.csv and <observable>.svg with the influences against t
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Points of a curve: one every degree of a full turn, both ends included.
const POINTS: usize = 361;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let (chain, sizes) = errors_file::chain_and_sizes(&arguments.chain, arguments.sizes.needed()?)?;
    let poses = match &arguments.path {
        Some(text) => Poses::Path(poses::path(&chain, text).map_err(|mistake| {
            let source = Source { path: "--path".into(), text: text.clone() };
            source.mistake(mistake)
        })?),
        None => Poses::Ranges(poses::joint_ranges(&ranges::of_chain(&chain, &arguments.range)?)),
    };
    let budgets = measured(&chain, &sizes, &poses, &arguments.observable)?;
    if let Some(folder) = &arguments.out {
        write_files(arguments, &chain, &sizes, &poses, &budgets, folder)?;
    }
    let printed = match arguments.format {
        TextOrJson::Text => {
            let tables: Vec<String> = budgets.iter().map(|budget| as_text(&chain, budget)).collect();
            tables.join("\n")
        }
        TextOrJson::Json => {
            let budgets: Vec<Value> = budgets.iter().map(|budget| as_json(&chain, budget, &poses)).collect();
            format!("{:#}\n", json!({ "observables": budgets }))
        }
    };
    match arguments.format {
        TextOrJson::Text => terminal::print_text(&printed)?,
        TextOrJson::Json => terminal::print(&printed)?,
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
            Err(error @ BudgetError::NoValue { .. }) if names.is_empty() => {
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
        BudgetError::NotFinite { .. } | BudgetError::Form(_) | BudgetError::Units { .. } => error.to_string(),
    })
}

fn write_files(
    arguments: &Arguments,
    chain: &Chain,
    sizes: &[f64],
    poses: &Poses,
    budgets: &[Budget],
    folder: &Path,
) -> Result<(), Failure> {
    let mut files = output::Folder::new(folder)?;
    files.write_text("budget.csv", &as_csv(chain, budgets))?;
    let along = match poses {
        Poses::Path(path) => Some(path),
        _ => None,
    };
    for (budget, path) in budgets.iter().filter_map(|budget| Some((budget, along?))) {
        let curves = Curves::along(chain, budget.observable, sizes, path, POINTS, arguments.steps)
            .map_err(|error| failure(&error))?;
        let name = match chain.observable(budget.observable).name.as_str() {
            // The table of all observables has this name.
            name if name.eq_ignore_ascii_case("budget") => format!("{name}_curves"),
            name => name.to_owned(),
        };
        files.write_text(&format!("{name}.csv"), &curves::csv(chain, &curves))?;
        match curves::svg(chain, budget.observable, &curves) {
            Some(figure) => files.write_text(&format!("{name}.svg"), &figure)?,
            // An earlier run's would speak of other sizes.
            None => files.remove(&format!("{name}.svg")),
        }
    }
    files.finish()
}

/// The budget of one observable as a table.
pub fn as_text(chain: &Chain, budget: &Budget) -> String {
    let (unit, factor) = reading_unit(budget.unit(chain));
    let name = &chain.observable(budget.observable).name;
    let width = budget.influences.iter().map(|influence| chain.symbol(influence.error).name.len());
    let width = width.max().unwrap_or(0).max("root sum square".len());
    let mut out = format!("{HEADING}{name}, influences in {unit}{HEADING:#}\n");
    let mut row = |name: &str, size: String, summary: &Summary| {
        let [sup, rms] = [summary.sup, summary.rms].map(|value| short(value * factor));
        let _ = writeln!(out, "  {name:width$}  {size:>14}  {sup:>12}  {rms:>12}");
    };
    for influence in &budget.influences {
        let symbol = chain.symbol(influence.error);
        let (unit, factor) = reading_unit(symbol.quantity.unit());
        let size = format!("{} {unit}", short(influence.size * factor));
        row(&symbol.name, size, &influence.summary);
    }
    row("worst case", String::new(), &budget.worst_case);
    row("root sum square", String::new(), &budget.root_sum_square);
    let heading = format!("  {:width$}  {:>14}  {:>12}  {:>12}\n", "error", "size", "largest", "rms");
    let title_end = out.find('\n').map_or(0, |end| end + 1);
    out.insert_str(title_end, &heading);
    if budget.is_sampled {
        out.push_str("  some rms comes from scattered poses and is right to about a percent\n");
    }
    out
}

/// The unit that people read, and how many of it one SI unit makes.
fn reading_unit(unit: &'static str) -> (&'static str, f64) {
    match unit {
        "rad" => ("arcsec", 3600.0 * 180.0 / std::f64::consts::PI),
        "m" => ("mm", 1e3),
        other => (other, 1.0),
    }
}

/// Five digits; what is below any sense is nothing.
fn short(value: f64) -> String {
    match value.abs() {
        size if size < 1e-12 => "0".to_owned(),
        0.01..1e6 => {
            let text = format!("{value:.4}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => format!("{value:.3e}"),
    }
}

/// All budgets as one table, in SI.
fn as_csv(chain: &Chain, budgets: &[Budget]) -> String {
    let mut out = "observable,error,size,size_unit,sup,rms,unit\n".to_owned();
    for budget in budgets {
        let (name, unit) = (&chain.observable(budget.observable).name, budget.unit(chain));
        for influence in &budget.influences {
            let symbol = chain.symbol(influence.error);
            let Summary { sup, rms, .. } = influence.summary;
            let _ = writeln!(
                out,
                "{name},{},{:?},{},{sup:?},{rms:?},{unit}",
                symbol.name,
                influence.size,
                symbol.quantity.unit()
            );
        }
        for (label, summary) in
            [("worst case", &budget.worst_case), ("root sum square", &budget.root_sum_square)]
        {
            let _ = writeln!(out, "{name},{label},,,{:?},{:?},{unit}", summary.sup, summary.rms);
        }
    }
    out
}

/// The budget of one observable for programs.
pub fn as_json(chain: &Chain, budget: &Budget, poses: &Poses) -> Value {
    let summary = |summary: &Summary| json!({"sup": summary.sup, "rms": summary.rms, "at": place(chain, budget, poses, summary)});
    let errors: Vec<Value> = budget
        .influences
        .iter()
        .map(|influence| {
            let symbol = chain.symbol(influence.error);
            let mut value = summary(&influence.summary);
            value["name"] = symbol.name.clone().into();
            value["size"] = influence.size.into();
            value["size_unit"] = symbol.quantity.unit().into();
            value
        })
        .collect();
    json!({
        "is_sampled": budget.is_sampled,
        "name": chain.observable(budget.observable).name,
        "unit": budget.unit(chain),
        "errors": errors,
        "worst_case": summary(&budget.worst_case),
        "root_sum_square": summary(&budget.root_sum_square),
    })
}

/// Where the largest value is taken, by name.
fn place(chain: &Chain, budget: &Budget, poses: &Poses, summary: &Summary) -> Value {
    let names: Vec<&str> = match poses {
        Poses::Path(_) => vec!["t"],
        Poses::Ranges(_) => budget.parameters.iter().map(|&id| chain.symbol(id).name.as_str()).collect(),
    };
    names.into_iter().map(str::to_owned).zip(summary.at.iter().map(|&value| Value::from(value))).collect()
}
