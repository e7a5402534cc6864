//! What the program says of a simulated file, against what was done to it.

use calibration::misread::{Judgement, Reading, implausible, judged};
use fit::{FitOptions, FitResult, fit};
use model_core::Chain;
use study::{Loaded, Plan, Study};
use tables::formats::{self, DataError};

use crate::data::Data;
use crate::traps::Names;

/// The failure of a run: a simulated study that cannot be read or fitted.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// The mistake is named first.
    First,
    /// It is one of several that are named.
    Among,
    /// Of two mistakes one is named; with it mended, the file shows the other or cannot show it.
    Part,
    /// Something else is named.
    Other,
    /// The file is refused with the row that is impossible, and what may be wrong.
    Refused,
    /// Nothing is named, and the correction is withheld.
    Withheld,
    /// Nothing is said, and these data could show it.
    Silent,
    /// Nothing is said, and these data show nothing.
    Hidden,
}

impl Answer {
    /// Every answer, in the order of the page.
    pub const ALL: [Self; 8] = [
        Self::First,
        Self::Among,
        Self::Part,
        Self::Other,
        Self::Refused,
        Self::Withheld,
        Self::Silent,
        Self::Hidden,
    ];

    /// What the page calls it.
    pub fn words(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Among => "among",
            Self::Part => "one of two",
            Self::Other => "another",
            Self::Refused => "refused",
            Self::Withheld => "withheld",
            Self::Silent => "silent",
            Self::Hidden => "cannot be seen",
        }
    }
}

/// How much likelier the data must be without the mistake before silence counts: a ratio of 20.
const SHOWN_NATS: f64 = 3.0;

struct Measured {
    plan: Plan,
    loaded: Loaded,
}

fn measured(data: &Data) -> Result<Measured, Failure> {
    let chain = Chain::from_text(data.instrument.chain).map_err(|mistakes| mistakes.to_string())?;
    let written: Study = toml::from_str(&data.study())?;
    let plan = written.plan(&chain).map_err(|mistakes| mistakes.to_string())?;
    let bytes = data.table().into_bytes();
    let loaded = plan.load_tables(&mut |name, options| formats::open(bytes.clone(), name, options))?;
    Ok(Measured { plan, loaded })
}

/// The study's own reading, fitted from where `calibrate` starts.
fn fitted(measured: &Measured, start: Option<Vec<f64>>) -> Result<FitResult, Failure> {
    let own = measured.plan.fit.clone();
    let (start, noise) = (start.unwrap_or_else(|| own.start.clone()), own.noise.by_residuals());
    let options = FitOptions { start, noise, ..own };
    Ok(fit(&measured.plan.chain, &measured.loaded.observations, &options)?)
}

/// What is said of a file in which nothing is wrong: the readings that are named; withheld or not.
pub fn of_clean(data: &Data) -> Result<(Names, bool), Failure> {
    let own = measured(data)?;
    let Judgement { misread: named, start } = judged(&own.plan, &own.loaded.sample);
    let withheld = named.is_none() && is_withheld(&own, &fitted(&own, start)?);
    Ok((
        named.map(|told| told.readings.iter().map(|own| words(&own.reading)).collect()).unwrap_or_default(),
        withheld,
    ))
}

/// What is said of a file in which one mistake was made; `clean` is the same without it.
pub fn of_spoiled(data: &Data, clean: &Data, right: &Names) -> Result<(Answer, Names), Failure> {
    let own = match measured(data) {
        Err(failure) if failure.is::<DataError>() => return Ok((Answer::Refused, Vec::new())),
        other => other?,
    };
    let Judgement { misread: named, start } = judged(&own.plan, &own.loaded.sample);
    let said: Names =
        named.iter().flat_map(|told| &told.readings).map(|suspect| words(&suspect.reading)).collect();
    let answer = match said.iter().position(|name| right.contains(name)) {
        Some(0) => Answer::First,
        Some(_) => Answer::Among,
        None if said.iter().any(|name| is_part(name, right)) => Answer::Part,
        None if !said.is_empty() => Answer::Other,
        None => {
            let as_read = fitted(&own, start)?;
            if is_withheld(&own, &as_read) {
                Answer::Withheld
            } else {
                let other = measured(clean)?;
                let without = fitted(&other, None)?;
                let numbers = without.residuals.raw.len() as f64;
                let unit = rms(&as_read) / rms(&without) / scale_of(data, clean);
                if numbers * unit.ln() > SHOWN_NATS { Answer::Silent } else { Answer::Hidden }
            }
        }
    };
    Ok((answer, said))
}

/// Whether what is named is one of two mistakes that were made.
fn is_part(name: &str, right: &Names) -> bool {
    right.iter().any(|both| both.split(" and ").any(|one| one == name))
}

/// How much larger the numbers of what was observed are by the mistake: what shrinks the data explains nothing.
fn scale_of(data: &Data, clean: &Data) -> f64 {
    let size = |data: &Data| {
        let of = |column: &crate::data::Column| {
            let unit = column.unit.map_or(1.0, crate::data::unit_si);
            column.numbers.iter().map(|number| (number * unit).powi(2)).sum::<f64>()
        };
        data.observed.iter().map(of).sum::<f64>().sqrt()
    };
    size(data) / size(clean)
}

fn rms(fit: &FitResult) -> f64 {
    let mut squares: Vec<f64> = fit.residuals.raw.iter().map(|value| value * value).collect();
    squares.sort_by(f64::total_cmp);
    squares.truncate((squares.len() as f64 * 0.98).ceil() as usize);
    (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
}

fn is_withheld(own: &Measured, fit: &FitResult) -> bool {
    !fit.outcome.is_usable()
        || !implausible(&own.plan.chain, &own.loaded.observations, fit, &own.plan.plausible).is_empty()
}

/// A reading in the words of the traps.
fn words(reading: &Reading) -> String {
    match reading {
        Reading::Unit { columns, is, .. } => format!("{is}: {}", columns.join(" ")),
        Reading::Counts { column, .. } => format!("counts: {column}"),
        Reading::Packed { columns, notation } => format!("{notation}: {}", columns.join(" ")),
        Reading::Reversed { column } => format!("reversed: {column}"),
        Reading::FromZenith { column } => format!("zenith: {column}"),
        Reading::Turned { column, .. } => format!("turned: {column}"),
        Reading::FromRow { reading, .. } => format!("from a row, {}", words(reading)),
        Reading::Exchanged { columns } => format!("exchanged: {}", columns.join(" ")),
        Reading::Order { order, .. } => format!("order: {order}"),
        Reading::Inverse { .. } => "inverse".to_owned(),
        Reading::Frame { .. } => "another frame".to_owned(),
        Reading::Both { readings: [one, other] } => format!("{} and {}", words(one), words(other)),
        Reading::TwoStates { errors, .. } => format!("two kinds: {}", errors.join(" ")),
        Reading::RightAscension { columns, .. } => format!("right ascension: {}", columns.join(" ")),
        Reading::Doubled { column } => format!("doubled: {column}"),
        Reading::PlacesExchanged { .. }
        | Reading::PlacesUnit { .. }
        | Reading::HeadingsReversed
        | Reading::HeadingsFromY { .. } => "stated places".to_owned(),
        Reading::OfStation { reading, .. } => format!("of a station, {}", words(reading)),
        Reading::Shifted { columns, by } => format!("rows {by}: {}", columns.join(" ")),
    }
}
