//! `trueaxis plan`: a first campaign of poses, and what it promises.

use std::path::{Path, PathBuf};

use model_core::names::listed;
use model_core::unit::{Measures, Unit};
use model_core::{Chain, ObservableId, Quantity, SymbolId, SymbolKind, escape};
use observe::{Measure, SiUnit};
use service::evaluation::readings_of;
use service::plan::{self, Asked, Axis, Constraint, Planned};
use service::ranges::RangeArgument;
use service::source::observables;
use service::{Instrument, errors_file};
use tables::units::{self, Amount};

use super::{Answer, TextOrJson};
use crate::budget::positive;
use crate::failure::Failure;
use crate::source::{self, Declared};
use crate::{output, terminal, whole};

/// Poses at most that may be asked for.
const MOST_POSES: u32 = 1000;

/// Propose a first campaign: how many poses, where, and what ± to expect of each wanted error.
///
/// Finds the fewest poses within the limits that determine every wanted error to the standard uncertainty that is wanted. All errors
/// that move the observable are estimated together. Poses come in whole degrees, millimetres or tenths of them.
///
/// Says which errors no number of poses determines, and with which others they are one. Exit code 1 where a wanted error is not
/// reached.
///
/// Example: trueaxis plan examples/alt-azimuth/alt-azimuth.chain --for "tilt_*" --within "2 arcsec" --observable sight --sigma "3 arcsec"
/// --range "elevation=15 deg..85 deg"
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration, or an instrument file
    chain: PathBuf,
    /// The errors to know: names, or patterns such as "da*" (may be given several times)
    #[arg(long = "for", value_name = "ERRORS", required = true)]
    errors: Vec<String>,
    /// The standard uncertainty that is wanted of each: "5 arcsec" of angles, "0.1 mm" of lengths (may be given several times)
    #[arg(long, value_name = "SIZE", required = true)]
    within: Vec<String>,
    /// What is measured; needed where the chain has several observables
    #[arg(long)]
    observable: Option<String>,
    /// Standard deviation of one measured component: "2 arcsec"; default, of an instrument file: that of its calibration
    #[arg(long, value_name = "SIZE")]
    sigma: Option<String>,
    /// Limits of a joint or input: "elevation=10 deg..80 deg" (may be given several times); default: a full turn of an angle
    #[arg(long, value_name = "joint=lo..hi")]
    range: Vec<RangeArgument>,
    /// What must hold at each pose, for visibility or cables: "elevation + 0.5*azimuth < 90 deg" (may be given several times)
    #[arg(long = "where", value_name = "EXPRESSION")]
    constraints: Vec<String>,
    /// Exactly so many poses; default: as few as do, up to 400
    #[arg(long, value_name = "N", value_parser = whole::number(1..=MOST_POSES), allow_negative_numbers = true)]
    poses: Option<u32>,
    /// Largest sizes of the errors, as what is known of them before; an error without one is no unknown. Default: nothing is known
    #[arg(long, value_name = "BOX.toml")]
    sizes: Option<PathBuf>,
    /// Folder for plan.csv with the poses, plan.svg with a picture of them, and plan.html with both
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let declared = Declared::read(&arguments.chain)?;
    let chain = &declared.chain;
    let observable = observed(chain, arguments.observable.as_ref())?;
    let (measure, sigma) = measured(&declared, observable, arguments.sigma.as_deref())?;
    let wanted = wanted(chain, arguments)?;
    let axes = axes(&declared, observable, &arguments.range)?;
    let settable: Vec<SymbolId> = axes.iter().map(|axis| axis.symbol).collect();
    let constraints = arguments.constraints.iter().map(|text| Constraint::parse(chain, &settable, text));
    let constraints = constraints.collect::<Result<Vec<_>, _>>()?;
    let prior = arguments.sizes.as_deref().map(|path| prior(chain, path)).transpose()?;
    let count = arguments.poses.map(|count| count as usize);
    let asked = Asked { chain, observable, measure, sigma, wanted, axes, constraints, prior, count };
    let planned = plan::plan(&asked)?;
    if let Some(folder) = &arguments.out {
        write_files(&asked, &planned, folder)?;
    }
    match arguments.format {
        TextOrJson::Text => terminal::print_text(plan::as_text(&asked, &planned))?,
        TextOrJson::Json => terminal::print_json(&plan::as_json(&asked, &planned))?,
    }
    Ok(if planned.is_reached() { Answer::Done } else { Answer::No })
}

/// The one that is measured.
fn observed(chain: &Chain, named: Option<&String>) -> Result<ObservableId, Failure> {
    let names: Vec<String> = named.into_iter().cloned().collect();
    match observables(chain, &names)?.as_slice() {
        [one] => Ok(*one),
        several => {
            let names = listed(several.iter().map(|&id| chain.observable(id).name.as_str()));
            Err(Failure::Input(format!("say which of {names} is measured: --observable NAME")))
        }
    }
}

/// What its numbers are, and the standard deviation of each component.
fn measured(
    declared: &Declared,
    observable: ObservableId,
    sigma: Option<&str>,
) -> Result<(Measure, Vec<f64>), Failure> {
    let chain = &declared.chain;
    let whole = plan::measure_of(chain, observable)?;
    let (measure, known) = declared
        .instrument
        .as_ref()
        .and_then(|instrument| calibrated(instrument, observable))
        .unwrap_or((whole, Vec::new()));
    let components = measure.components();
    match sigma {
        Some(text) => {
            let quantity = if measure.unit() == SiUnit::RAD { Quantity::Angle } else { Quantity::Length };
            let sigma = positive(text, quantity, false)
                .map_err(|why| Failure::Input(format!("--sigma {text}: {why}")))?;
            Ok((measure, vec![sigma; components]))
        }
        None if known.len() == components => Ok((measure, known)),
        None => {
            let name = &chain.observable(observable).name;
            let example = if measure.unit() == SiUnit::RAD { "2 arcsec" } else { "0.1 mm" };
            Err(Failure::Input(format!("how surely is `{name}` measured? say --sigma \"{example}\"")))
        }
    }
}

/// What the study of an instrument measured of it, and the noise of that.
fn calibrated(instrument: &Instrument, observable: ObservableId) -> Option<(Measure, Vec<f64>)> {
    let sources = &instrument.headings.as_ref()?.sources;
    let at = sources.iter().position(|own| {
        own.observable == observable && own.measure == own.measure.bare() && !own.measure.observes_object()
    })?;
    let noise = instrument.noise.get(at).map_or_else(Vec::new, |noise| noise.sigma.clone());
    Some((sources[at].measure, noise))
}

/// The wanted errors with the uncertainty that is wanted of each, SI.
fn wanted(chain: &Chain, arguments: &Arguments) -> Result<Vec<(SymbolId, f64)>, Failure> {
    let wrong = |text: &str, why: String| Failure::Input(format!("--within {text}: {why}"));
    let mut limits: Vec<(Quantity, f64, &str)> = Vec::new();
    for text in &arguments.within {
        let amount = Amount::parse(text).map_err(|why| wrong(text, why.to_string()))?;
        let quantity = amount.unit.map_or(Quantity::Number, |unit| unit.measures().quantity());
        let size = positive(text, quantity, false).map_err(|why| wrong(text, why))?;
        if limits.iter().any(|(other, ..)| *other == quantity) {
            return Err(wrong(
                text,
                "one of this kind is given already: give one of angles and one of lengths".to_owned(),
            ));
        }
        limits.push((quantity, size, text));
    }
    let errors = plan::errors_named(chain, &arguments.errors)?;
    let wanted = errors.iter().map(|&error| {
        let symbol = chain.symbol(error);
        let own = limits.iter().find(|(quantity, ..)| *quantity == symbol.quantity);
        own.map(|&(_, size, _)| (error, size)).ok_or_else(|| {
            let example = units::example(symbol.quantity);
            Failure::Input(format!("how surely is `{}` wanted? say --within {example}, too", symbol.name))
        })
    });
    let wanted = wanted.collect::<Result<Vec<_>, _>>()?;
    let is_used = |quantity: Quantity| errors.iter().any(|id| chain.symbol(*id).quantity == quantity);
    if let Some((_, _, text)) = limits.iter().find(|(quantity, ..)| !is_used(*quantity)) {
        return Err(wrong(
            text,
            "no wanted error is of this kind: leave it out, or name more with --for".to_owned(),
        ));
    }
    Ok(wanted)
}

/// What can be set, with its limits.
fn axes(
    declared: &Declared,
    observable: ObservableId,
    typed: &[RangeArgument],
) -> Result<Vec<Axis>, Failure> {
    let chain = &declared.chain;
    let ranges = declared.ranges(typed)?;
    let needed = readings_of(chain, observable);
    if let Some(other) = ranges.iter().find(|range| !needed.contains(&range.symbol))
        && typed.iter().any(|range| range.name() == chain.symbol(other.symbol).name)
    {
        let [name, seen] = [&chain.symbol(other.symbol).name, &chain.observable(observable).name];
        terminal::warn(format_args!("`{name}` does not move `{seen}`: its limits count for nothing"));
    }
    let axis = |symbol: SymbolId| {
        let own = chain.symbol(symbol);
        let written = typed.iter().find(|range| range.name() == own.name).and_then(RangeArgument::unit);
        let unit = written.or_else(|| match Measures::of(own).quantity() {
            Quantity::Angle => Unit::find("deg"),
            Quantity::Length => Unit::find("mm"),
            Quantity::Number => None,
        });
        if let Some(range) = ranges.iter().find(|range| range.symbol == symbol) {
            let turns =
                own.quantity == Quantity::Angle && range.high - range.low > std::f64::consts::TAU - 1e-9;
            return Ok(Axis::new(chain, symbol, [range.low, range.high], unit, turns));
        }
        if own.kind == SymbolKind::Joint && own.quantity == Quantity::Angle {
            return Ok(Axis::new(chain, symbol, [0.0, std::f64::consts::TAU], unit, true));
        }
        let name = &own.name;
        Err(Failure::Input(format!("between which values is `{name}`? say --range \"{name}=lo..hi\"")))
    };
    needed.into_iter().map(axis).collect()
}

/// What is known of each error before: it lies anywhere within its size, as `budget` takes it.
fn prior(chain: &Chain, path: &Path) -> Result<Vec<f64>, Failure> {
    let file = source::read(path)?;
    let sizes = errors_file::largest_sizes(&file, chain, &terminal::warn)?;
    Ok(sizes.into_iter().map(|size| size / 3.0_f64.sqrt()).collect())
}

fn write_files(asked: &Asked<'_>, planned: &Planned, folder: &Path) -> Result<(), Failure> {
    let mut files = output::Folder::new(folder)?;
    files.write_text("plan.csv", &plan::as_csv(asked, planned))?;
    files.write_text("plan.html", &plan::page(asked, planned, &terminal::command_line()))?;
    match plan::svg(asked, planned) {
        Some(figure) => files.write_text("plan.svg", &escape::page(&figure))?,
        // An earlier run's would show other poses.
        None => files.remove("plan.svg"),
    }
    files.finish()
}
