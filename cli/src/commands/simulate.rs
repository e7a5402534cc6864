//! `trueaxis simulate`: measured data from a chain, with noise and a seed.

use std::f64::consts::PI;
use std::path::PathBuf;

use model_core::{Chain, Observable, ObservableId, ObservableKind, Quantity as Measures, SymbolId};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use service::errors_file;
use service::evaluation::{Evaluator, Exactness, Quantity, column_names};
use service::ranges::{self, Range, RangeArgument};
use service::source::observables;
use tables::formats::{Column, ColumnName};
use tables::units::{Amount, Plausible};

use super::Answer;
use crate::failure::Failure;
use crate::{output, source, table_files, terminal, whole};
use model_core::names::listed;

/// Simulate measured data.
///
/// Joints are drawn at random, turning joints from a whole turn unless --range says otherwise; what the chain shows
/// there is exact, with normal noise: for a direction along each of two directions across it, for a point along x, y
/// and z, for an angle or a range in that itself. Angles are written in rad and lengths in m. An effect that another declaration lacks comes from
/// simulating with a richer one.
///
/// Example: trueaxis simulate examples/mobile-lidar/off-centre.chain --errors
/// examples/mobile-lidar/off-centre.errors.toml --poses 400 --noise "2 arcsec" --seed 1 --out measured.csv
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration
    chain: PathBuf,
    /// Values of the errors
    #[arg(long, value_name = "E.toml")]
    errors: PathBuf,
    /// How many poses
    #[arg(long, value_name = "N", value_parser = whole::number(1..=u32::MAX), allow_negative_numbers = true)]
    poses: u32,
    /// Standard deviation of the noise, "2 arcsec" for directions, "0.1 mm" for points (give both for both)
    #[arg(long, value_name = "SIGMA", required = true, allow_hyphen_values = true)]
    noise: Vec<String>,
    /// Seed of the random numbers: the same seed gives the same data
    #[arg(long, value_name = "S", value_parser = whole::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Range of a joint or input: "beta=-30 deg..60 deg" (may be given several times)
    #[arg(long, value_name = "joint=lo..hi")]
    range: Vec<RangeArgument>,
    /// Only this observable (may be given several times); default: every one that --noise fits
    #[arg(long)]
    observable: Vec<String>,
    /// Where to write: a .csv or .parquet file, or - for standard output
    #[arg(long, value_name = "OUT")]
    out: PathBuf,
}

/// Standard deviations of the noise, where given.
#[derive(Debug, Clone, Copy, Default)]
struct Noise {
    /// Of a direction, along each of two directions across it.
    angle_rad: Option<f64>,
    /// Of a point, along each axis.
    length_m: Option<f64>,
}

/// Poses that are computed at a time.
const CHUNK: usize = 4096;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    output::refuse_to_replace(&arguments.out, [arguments.chain.as_path(), &arguments.errors])?;
    let chain = source::chain(&arguments.chain)?;
    let values = errors_file::values(&source::read(&arguments.errors)?, &chain, &terminal::warn)?;
    let given = ranges::of_chain(&chain, &arguments.range, &terminal::warn)?;
    let mut simulation =
        Simulation::new(&chain, &values, &arguments.noise, &arguments.observable, &given, arguments.seed)?;
    table_files::write(&arguments.out, |writer| {
        writer.header(&simulation.header)?;
        let mut left = arguments.poses as usize;
        while left > 0 {
            let rows = left.min(CHUNK);
            left -= rows;
            let columns = simulation.rows(rows)?;
            writer.rows(columns.into_iter().map(Column::Numbers).collect(), rows)?;
        }
        Ok(())
    })?;
    Ok(Answer::Done)
}

/// Measured data that are being made up.
pub struct Simulation<'c> {
    /// Names of the columns: readings, then components of observables.
    pub header: Vec<String>,
    chain: &'c Chain,
    evaluator: Evaluator,
    ranges: Vec<Range>,
    noise: Noise,
    poses: ChaCha8Rng,
    errors: ChaCha8Rng,
}

impl<'c> Simulation<'c> {
    /// Poses within ranges (a whole turn where none is given), seen with errors and noise.
    ///
    /// # Errors
    /// Noise that cannot be read or fits no observable, a name that the chain does not declare, a range that is missing.
    pub fn new(
        chain: &'c Chain,
        values: &[f64],
        noise: &[String],
        names: &[String],
        given: &[Range],
        seed: u64,
    ) -> Result<Self, Failure> {
        let noise = Noise::parse(chain, noise)?;
        let chosen = measured(chain, names, noise)?;
        let evaluator = Evaluator::new(chain, chosen, Exactness::Exact, Quantity::Value, values);
        let ranges = ranges_of(chain, &evaluator.readings, given)?;
        let header = ranges
            .iter()
            .map(|range| heading(chain, range))
            .chain(column_names(chain, &evaluator.observables)?)
            .collect();
        let (poses, errors) = (stream(seed, 0), stream(seed, 1));
        Ok(Self { header, chain, evaluator, ranges, noise, poses, errors })
    }

    /// The next rows, column by column, in SI.
    ///
    /// # Errors
    /// A broken invariant of ours: columns of the wrong shape.
    pub fn rows(&mut self, rows: usize) -> Result<Vec<Vec<f64>>, Failure> {
        let mut readings: Vec<(SymbolId, Vec<f64>)> =
            self.ranges.iter().map(|range| (range.symbol, Vec::with_capacity(rows))).collect();
        for _ in 0..rows {
            for (range, (_, column)) in self.ranges.iter().zip(&mut readings) {
                column.push(range.low + (range.high - range.low) * self.poses.random::<f64>());
            }
        }
        let columns: Vec<_> = readings.iter().map(|(id, column)| (*id, column.as_slice())).collect();
        let mut shown = self.evaluator.columns(&columns, rows)?;
        for row in 0..rows {
            let mut rest = shown.as_mut_slice();
            for &observable in &self.evaluator.observables {
                let observable = self.chain.observable(observable);
                let (own, behind) = std::mem::take(&mut rest).split_at_mut(observable.shown.len());
                rest = behind;
                let plain: Vec<f64> = own.iter().map(|column| column[row]).collect();
                let moved = self.noise.add(observable, &plain, &mut self.errors);
                for (column, component) in own.iter_mut().zip(moved) {
                    column[row] = component;
                }
            }
        }
        Ok(readings.into_iter().map(|(_, column)| column).chain(shown).collect())
    }
}

/// The name of a column of readings, with its unit where readers would doubt that it is in SI.
fn heading(chain: &Chain, range: &Range) -> String {
    let symbol = chain.symbol(range.symbol);
    let plausible = Plausible::readings(chain, range.symbol);
    if [range.low, range.high].iter().any(|&reading| plausible.refuses(symbol.quantity, reading)) {
        return format!("{} [{}]", symbol.name, symbol.quantity.unit());
    }
    ColumnName::of_si(&symbol.name, symbol.quantity)
}

/// A stream of random numbers of its own for each purpose: more noise does not move the poses.
fn stream(seed: u64, purpose: u64) -> ChaCha8Rng {
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    stream.set_stream(purpose);
    stream
}

/// The observables that are to be measured: those asked for, or all whose noise was given.
fn measured(chain: &Chain, names: &[String], noise: Noise) -> Result<Vec<ObservableId>, Failure> {
    let (images, all): (Vec<_>, Vec<_>) =
        observables(chain, names)?.into_iter().partition(|&id| chain.observable(id).is_image());
    if let Some(&image) = images.first() {
        let why = format!("`{}` shows pixels, which are not simulated", chain.observable(image).name);
        if !names.is_empty() || all.is_empty() {
            return Err(Failure::Input(format!("{why}: name a direction or point with --observable")));
        }
        terminal::warn(format_args!("{why}; left out"));
    }
    let (chosen, silent): (Vec<_>, Vec<_>) =
        all.into_iter().partition(|&id| measures_of(chain.observable(id)).all(|one| noise.of(one).is_some()));
    let silent: Vec<&str> = silent.into_iter().map(|id| chain.observable(id).name.as_str()).collect();
    if silent.is_empty() {
        return Ok(chosen);
    }
    let (show, verb) = match (noise.angle_rad, silent.len()) {
        (Some(_), 1) => ("a point, whose noise is a length: say --noise \"0.1 mm\" too", "shows"),
        (Some(_), _) => ("points, whose noise is a length: say --noise \"0.1 mm\" too", "show"),
        (None, 1) => ("a direction, whose noise is an angle: say --noise \"2 arcsec\" too", "shows"),
        (None, _) => ("directions, whose noise is an angle: say --noise \"2 arcsec\" too", "show"),
    };
    let message = format!("{} {verb} {show}", listed(silent.into_iter()));
    if !names.is_empty() || chosen.is_empty() {
        return Err(Failure::Input(message));
    }
    terminal::warn(format_args!("{message}; left out"));
    Ok(chosen)
}

/// The range of every reading that is needed: as given, or a whole turn.
fn ranges_of(chain: &Chain, readings: &[SymbolId], given: &[Range]) -> Result<Vec<Range>, Failure> {
    for range in given {
        if !readings.contains(&range.symbol) {
            let name = &chain.symbol(range.symbol).name;
            terminal::warn(format_args!("--range {name}: no observable here depends on it"));
        }
    }
    readings
        .iter()
        .map(|&symbol| {
            let name = &chain.symbol(symbol).name;
            let turns = chain.symbol(symbol).quantity == Measures::Angle;
            let whole_turn = turns.then_some(Range { symbol, low: -PI, high: PI });
            given.iter().copied().find(|range| range.symbol == symbol).or(whole_turn).ok_or_else(|| {
                let example = match chain.symbol(symbol).quantity {
                    Measures::Length => "1 m..100 m",
                    _ => "0..30",
                };
                Failure::Input(format!("`{name}` has no natural range: say --range \"{name}={example}\""))
            })
        })
        .collect()
}

impl Noise {
    /// Reads every `--noise`; a number without a unit holds for directions (rad) and points (m).
    fn parse(chain: &Chain, texts: &[String]) -> Result<Self, Failure> {
        let mut noise = Self::default();
        let plausible = Plausible::noise(chain);
        for text in texts {
            let wrong = |why: String| Failure::Input(format!("--noise: {why}"));
            let amount = Amount::parse(text).map_err(|error| wrong(error.to_string()))?;
            if amount.number < 0.0 {
                return Err(wrong(format!("`{text}` is negative: write the standard deviation")));
            }
            let measures = amount.unit.map(|unit| unit.measures().quantity());
            if measures == Some(Measures::Number) {
                return Err(wrong(format!("`{text}` is neither an angle nor a length")));
            }
            for (quantity, sigma) in
                [(Measures::Angle, &mut noise.angle_rad), (Measures::Length, &mut noise.length_m)]
            {
                if measures.is_none_or(|measured| measured == quantity) {
                    let si = amount.to_si(quantity).map_err(|error| wrong(error.to_string()))?;
                    let mut shown = chain.observables.iter().flat_map(measures_of);
                    let meant = |unit: &str| format!("--noise \"{text} {unit}\"");
                    let doubt = plausible.doubt(quantity, &[amount], &format!("--noise {text}"), meant);
                    doubt.filter(|_| shown.any(|q| q == quantity)).iter().for_each(terminal::warn);
                    if sigma.replace(si).is_some() {
                        return Err(wrong(format!("`{text}`: the noise of one kind is given twice")));
                    }
                }
            }
        }
        Ok(noise)
    }

    /// The standard deviation of what measures something, SI.
    fn of(self, measures: Measures) -> Option<f64> {
        match measures {
            Measures::Angle => self.angle_rad,
            Measures::Length => self.length_m,
            Measures::Number => unreachable!("noise is of angles and lengths"),
        }
    }

    /// What is measured where the instrument shows `shown`.
    fn add(self, observable: &Observable, shown: &[f64], chance: &mut ChaCha8Rng) -> Vec<f64> {
        let mut draw = |measures: Measures| -> f64 {
            self.of(measures).unwrap_or_default() * chance.sample::<f64, _>(StandardNormal)
        };
        match (observable.kind, shown) {
            (ObservableKind::Direction, &[x, y, z]) if observable.is_vector() => {
                // Normal noise along x, y and z, projected off the direction, is normal along any two directions
                // across it.
                let noise = [0; 3].map(|_| draw(Measures::Angle));
                let shown = of_length_one([x, y, z]);
                let along: f64 = noise.iter().zip(shown).map(|(n, s)| n * s).sum();
                of_length_one([0, 1, 2].map(|axis| shown[axis] + noise[axis] - along * shown[axis])).to_vec()
            }
            _ => {
                measures_of(observable).zip(shown).map(|(measures, number)| number + draw(measures)).collect()
            }
        }
    }
}

/// What the noise of each number of an observable measures; a component of a direction moves as an angle does.
fn measures_of(observable: &Observable) -> impl Iterator<Item = Measures> + '_ {
    observable.shown.iter().map(|reading| match reading.unit(observable.kind) {
        "m" => Measures::Length,
        _ => Measures::Angle,
    })
}

/// The direction of a vector.
fn of_length_one(vector: [f64; 3]) -> [f64; 3] {
    let length = vector.iter().map(|component| component * component).sum::<f64>().sqrt();
    vector.map(|component| component / length)
}
