//! What a designer says on the command line beside the sizes: distributions, costs, finest sizes, a wanted error, a campaign.

use std::path::Path;

use model_core::{Chain, ObservableKind, Quantity, SymbolId, SymbolKind};
use service::errors_file;
use service::tolerance::{Distribution, Shape, Tolerance, Written};
use tables::units::Amount;

use crate::failure::Failure;
use crate::{source, whole};

/// What a designer asks.
#[derive(Debug, clap::Args)]
#[command(next_help_heading = "For a designer")]
pub struct DesignerArguments {
    /// Draw all errors at once, so many times: percentiles, and the yield of what is wanted
    #[arg(long, value_name = "N", value_parser = whole::number(1..=100_000_000), allow_negative_numbers = true)]
    pub draws: Option<u32>,
    /// Seed of the draws
    #[arg(long, default_value_t = 1, value_parser = whole::seed, allow_negative_numbers = true)]
    pub seed: u64,
    /// Poses that tolerances are summed over
    #[arg(long, value_name = "N", default_value_t = 721, value_parser = whole::number(1..=100_000), allow_negative_numbers = true)]
    pub poses: u32,
    /// How errors are spread over their sizes: uniform (the default), "normal 2" (the size is two standard deviations),
    /// "table FILE.csv" (rows of a value from -1 to 1, in units of the size, and how often it comes); for some errors only:
    /// "delta_*=normal 2" (may be given several times)
    #[arg(long, value_name = "[errors=]SPREAD")]
    pub distribution: Vec<String>,
    /// The root sum square that is wanted, "0.5 mm": sizes that keep it, and how many draws do now
    #[arg(long, value_name = "SIZE")]
    pub wanted: Option<String>,
    /// What the present sizes of some errors cost against those of others: "da*=3" (may be given several times)
    #[arg(long, value_name = "errors=NUMBER", requires = "wanted")]
    pub cost: Vec<String>,
    /// The smallest size that some errors can be held to: "dx*=0.05 mm" (may be given several times)
    #[arg(long, value_name = "errors=SIZE", requires = "wanted")]
    pub finest: Vec<String>,
    /// What remains after a calibration: a table of the poses that will be measured, or how many are spread over the poses above
    #[arg(long, value_name = "POSES", requires = "noise")]
    pub campaign: Option<String>,
    /// Standard deviation of each component measured in the campaign: "0.1 mm"
    #[arg(long, value_name = "SIGMA", requires = "campaign")]
    pub noise: Option<String>,
    /// Where the instrument stands is found from what it sees: a common turn and shift is no error, neither in the campaign
    /// nor in use
    #[arg(long)]
    pub registered: bool,
}

impl DesignerArguments {
    /// Whether anything of it was asked.
    pub fn is_asked(&self) -> bool {
        self.draws.is_some()
            || self.wanted.is_some()
            || self.campaign.is_some()
            || self.registered
            || !self.distribution.is_empty()
    }

    /// The tolerance of each error with a size; `sizes` in SI by [`SymbolId`].
    pub fn tolerances(&self, chain: &Chain, sizes: &[f64]) -> Result<Vec<Tolerance>, Failure> {
        let spread = by_error(chain, sizes, "--distribution", &self.distribution, Some("*"), |text, _| {
            match Distribution::parse(text).map_err(|error| error.to_string())? {
                Written::Whole(distribution) => Ok(distribution),
                Written::InFile(file) => table(Path::new(&file)),
            }
        })?;
        let errors = chain.symbols_of(SymbolKind::Error).filter(|error| sizes[error.index()] != 0.0);
        let tolerance = |error: SymbolId| Tolerance {
            error,
            size: sizes[error.index()],
            distribution: spread[error.index()].clone().unwrap_or(Distribution::Uniform),
        };
        Ok(errors.map(tolerance).collect())
    }

    /// Costs and finest sizes of the errors with a tolerance.
    pub fn limits(&self, chain: &Chain, tolerances: &[Tolerance]) -> Result<(Vec<f64>, Vec<f64>), Failure> {
        let mut sizes = vec![0.0; chain.symbols.len()];
        tolerances.iter().for_each(|tolerance| sizes[tolerance.error.index()] = tolerance.size);
        let costs =
            by_error(chain, &sizes, "--cost", &self.cost, None, |text, _| match text.parse::<f64>() {
                Ok(cost) if cost.is_finite() && cost > 0.0 => Ok(cost),
                _ => Err(format!("`{text}` is no cost; write a number above zero")),
            })?;
        let finest = by_error(chain, &sizes, "--finest", &self.finest, None, |text, error| {
            positive(text, chain.symbol(error).quantity, true)
        })?;
        let of = |values: &[Option<f64>], other: f64| -> Vec<f64> {
            tolerances.iter().map(|tolerance| values[tolerance.error.index()].unwrap_or(other)).collect()
        };
        Ok((of(&costs, 1.0), of(&finest, 0.0)))
    }
}

/// A size at an observable: an angle for a direction, a length for a point.
pub fn at_observable(flag: &str, text: &str, name: &str, kind: ObservableKind) -> Result<f64, Failure> {
    let quantity = match kind {
        ObservableKind::Direction => Quantity::Angle,
        ObservableKind::Point => Quantity::Length,
    };
    positive(text, quantity, false).map_err(|why| {
        let instead = "name the observable that it is meant for with --observable";
        Failure::Input(format!("{flag} {text}: {why}; {name} is what it is taken for here: {instead}"))
    })
}

/// A quantity above zero, SI; with a unit, so that nobody takes arc seconds for radians.
pub fn positive(text: &str, quantity: Quantity, zero: bool) -> Result<f64, String> {
    let amount = Amount::parse(text).map_err(|error| error.to_string())?;
    if amount.unit.is_none() && quantity != Quantity::Number {
        return Err(format!("`{text}` has no unit; write one, as in `{text} {}`", likely(quantity)));
    }
    let value = amount.to_si(quantity).map_err(|error| error.to_string())?;
    match value {
        value if value > 0.0 || (zero && value == 0.0) => Ok(value),
        _ => Err(format!("`{text}` is no size; write one above zero")),
    }
}

fn likely(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Angle => "arcsec",
        Quantity::Length => "mm",
        other => other.unit(),
    }
}

/// What `errors=value` arguments say, by [`SymbolId`]: a plain name wins over a pattern, one with more letters over one with
/// fewer. `alone` is the pattern of an argument without one.
fn by_error<T: Clone>(
    chain: &Chain,
    sizes: &[f64],
    flag: &str,
    texts: &[String],
    alone: Option<&str>,
    read: impl Fn(&str, SymbolId) -> Result<T, String>,
) -> Result<Vec<Option<T>>, Failure> {
    let mut found: Vec<Option<(usize, T)>> = vec![None; chain.symbols.len()];
    for text in texts {
        let wrong = |why: String| Failure::Input(format!("{flag} \"{text}\": {why}"));
        let (pattern, value) = match (text.split_once('='), alone) {
            (Some((pattern, value)), _) => (pattern.trim(), value.trim()),
            (None, Some(pattern)) => (pattern, text.trim()),
            (None, None) => return Err(wrong("write errors=value, as in \"da*=2\"".to_owned())),
        };
        let mut matched = errors_file::errors_named(chain, pattern).map_err(wrong)?;
        matched.retain(|error| sizes[error.index()] != 0.0);
        if matched.is_empty() {
            return Err(wrong(format!("the sizes leave `{pattern}` out: give it one in --sizes")));
        }
        let rank = errors_file::rank(pattern);
        for error in matched {
            let value = read(value, error).map_err(wrong)?;
            match &mut found[error.index()] {
                Some((other, _)) if *other > rank => {}
                Some((other, _)) if *other == rank => {
                    let name = &chain.symbol(error).name;
                    return Err(wrong(format!("`{name}` is said twice; a plain name wins over a pattern")));
                }
                slot => *slot = Some((rank, value)),
            }
        }
    }
    Ok(found.into_iter().map(|slot| slot.map(|(_, value)| value)).collect())
}

/// A distribution from a file: two numbers a line, and at most one line of names above.
fn table(path: &Path) -> Result<Distribution, String> {
    let source = source::read(path).map_err(|failure| failure.to_string())?;
    let mut rows: Vec<(f64, f64)> = Vec::new();
    for (at, line) in source.text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let cells: Vec<&str> = line.split([',', ';', '\t', ' ']).filter(|cell| !cell.is_empty()).collect();
        let numbers: Vec<f64> = cells.iter().filter_map(|cell| cell.parse().ok()).collect();
        match (cells.as_slice(), numbers.as_slice()) {
            ([_, _], &[value, frequency]) => rows.push((value, frequency)),
            ([_, _], []) if rows.is_empty() && at == 0 => {}
            _ => {
                let place = format!("{}:{}", path.display(), at + 1);
                return Err(format!(
                    "{place}: `{line}` is not two numbers; write a value and how often it comes"
                ));
            }
        }
    }
    let shape = Shape::new(&rows).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(Distribution::Table(shape))
}

/// Whether a text is a unit of what an observable shows.
pub fn is_meant_for(text: &str, kind: ObservableKind) -> bool {
    let unit = Amount::parse(text).ok().and_then(|amount| amount.unit);
    !matches!(
        (unit.map(|unit| unit.measures().quantity()), kind),
        (Some(Quantity::Angle), ObservableKind::Point) | (Some(Quantity::Length), ObservableKind::Direction)
    )
}
