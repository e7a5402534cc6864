//! Instrument files: a calibrated instrument as one text, which every command takes in place of a declaration.

mod covariance;
mod file;
mod noise;
mod written;

use std::collections::BTreeMap;

use model_core::mistake::{Mistake, Mistakes};
use model_core::unit::Unit;
use model_core::{Chain, SymbolId, SymbolKind};
use study::{Headings, Study};

use crate::errors_file::{FoundOver, Given};
use crate::refusal::Refusal;
use crate::source::Source;
use crate::warn::Warn;

pub use covariance::Covariance;
pub(crate) use covariance::errors_and_constants;
pub use file::VERSION;
pub use noise::Noise;
pub use written::instrument;

/// A calibrated instrument.
#[derive(Debug, Clone)]
pub struct Instrument {
    /// The declaration, whose constants have the values of the calibration.
    pub chain: Chain,
    /// Its text, under the name of the instrument file.
    pub declaration: Source,
    /// The value of every symbol, SI, indexed by [`SymbolId`].
    pub values: Vec<f64>,
    /// The errors and constants that the file has, with their values, SI.
    pub named: Vec<(SymbolId, f64)>,
    /// The ranges of the readings that the errors were found over.
    pub found: Vec<FoundOver>,
    /// How sure the estimates are; none where the data did not say.
    pub covariance: Option<Covariance>,
    /// How uncertain one observation of each source is; empty where the file does not say.
    pub noise: Vec<Noise>,
    /// What its study says of columns, as it is written.
    pub study: Option<Study>,
    /// What the columns of its data mean.
    pub headings: Option<Headings>,
    /// How what is observed is written, source by source, by the keys of `[observed]`.
    pub corrected: Vec<BTreeMap<String, Heading>>,
    /// The last day on which it counts, as `2027-06-30`.
    pub valid_until: Option<String>,
    /// The day of the calibration, as `2026-11-21`, if the file says so.
    pub made: Option<String>,
}

/// How a column of what is observed is written.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Its heading.
    pub text: String,
    /// Its unit, where it has one.
    pub unit: Option<Unit>,
    /// Where an angle that goes round begins, rad.
    pub from_rad: f64,
}

impl Instrument {
    /// Reads an instrument file of any version; warns of what is doubtful of it.
    ///
    /// # Errors
    /// A later version than [`VERSION`], and every mistake of its parts, with its place in the file.
    pub fn of(source: &Source, warn: Warn<'_>) -> Result<Self, Refusal> {
        let file = file::Contents::of(source)?;
        let declaration = Source { path: source.path.clone(), text: file.chain.get_ref().clone() };
        let mut chain = declared(source, &file, &declaration)?;
        for caution in model_core::caution::cautions(&chain) {
            warn(format!("{}: {caution}", source.path.display()));
        }
        let mut given = Given { source, amounts: file.errors.clone(), ranges: file.found_over.clone() };
        let errors = given.settings(&chain, &[SymbolKind::Error], warn)?;
        given.amounts = file.constants.clone();
        let constants = given.settings(&chain, &[SymbolKind::Constant], warn)?;
        let found = given.found_over(&chain)?;
        for (id, (value, _)) in &constants {
            chain.symbols[id.index()].value = Some(*value);
        }
        let mut values = chain.nominal_values();
        let named = errors.into_iter().chain(constants).map(|(id, (value, _))| (id, value));
        let named: Vec<(SymbolId, f64)> = named.collect();
        for (id, value) in &named {
            values[id.index()] = *value;
        }
        let covariance =
            file.covariance.as_ref().map(|own| Covariance::of(source, &chain, own)).transpose()?;
        let study = file.study.clone().map(|study| study.inside(&source.text));
        let headings = study.as_ref().map(|study| study.headings(&chain));
        let headings = headings.transpose().map_err(|mistakes| source.mistakes(&mistakes))?;
        let corrected = corrected(source, &file, headings.as_ref())?;
        let valid_until = file.valid_until.as_ref().and_then(|date| date.get_ref().date);
        let valid_until = valid_until.map(|date| date.to_string());
        let made = file.provenance.get("date").and_then(|date| date.as_str().map(str::to_owned));
        Ok(Self {
            noise: noise::of_sources(source, &file.noise, headings.as_ref())?,
            chain,
            declaration,
            values,
            named,
            found,
            covariance,
            study,
            headings,
            corrected,
            valid_until,
            made,
        })
    }

    /// The values of all symbols of a chain that has the declaration's and others behind them, SI.
    #[must_use]
    pub fn values_in(&self, chain: &Chain) -> Vec<f64> {
        let mut values = chain.nominal_values();
        values[..self.values.len()].copy_from_slice(&self.values);
        values
    }

    /// How large each error may be by this calibration, SI, indexed by [`SymbolId`]: its value and two standard uncertainties. Of those
    /// that the data did not determine by themselves the value alone.
    #[must_use]
    pub fn sizes(&self) -> Vec<f64> {
        let mut sizes = vec![0.0; self.chain.symbols.len()];
        for error in self.chain.symbols_of(SymbolKind::Error) {
            let uncertainty = self.covariance.as_ref().and_then(|own| own.standard_uncertainty(error));
            sizes[error.index()] = self.values[error.index()].abs() + 2.0 * uncertainty.unwrap_or(0.0);
        }
        sizes
    }

    /// What to say on a day, as `2026-11-21`, behind the last one on which it counts.
    #[must_use]
    pub fn expired(&self, today: &str) -> Option<String> {
        // Dates of this form are ordered as texts are.
        let last = self.valid_until.as_deref().filter(|last| *last < today)?;
        let file = self.declaration.path.display();
        Some(format!("{file}: this calibration was valid until {last}: measure again, and calibrate again"))
    }
}

/// The declaration in the file; a mistake of it is shown in the line of the file.
fn declared(source: &Source, file: &file::Contents, declaration: &Source) -> Result<Chain, Refusal> {
    Chain::from_text(&declaration.text).map_err(|mistakes| {
        let Some(within) = file.place_of_chain(source) else {
            let name = format!("chain in {}", source.path.display());
            return Source::of_text(name, &declaration.text).mistakes(&mistakes);
        };
        let moved = mistakes.iter().map(|mistake| Mistake {
            place: mistake.place.bytes.start + within.start..mistake.place.bytes.end + within.start,
            message: mistake.message.clone(),
            help: mistake.help.clone(),
        });
        source.mistakes(&Mistakes::locate(&source.text, moved))
    })
}

/// How what is observed is written, source by source.
fn corrected(
    source: &Source,
    file: &file::Contents,
    headings: Option<&Headings>,
) -> Result<Vec<BTreeMap<String, Heading>>, Refusal> {
    let sources = headings.map_or(&[][..], |headings| &headings.sources);
    let mut all = Vec::new();
    for (at, columns) in file.corrected.iter().enumerate() {
        let mut own = BTreeMap::new();
        for (key, column) in columns {
            let wrong = |place, message: String, help: String| {
                Err(source.mistake(Mistake::new(place, message).with_help(help)))
            };
            let observed = sources.get(at).into_iter().flat_map(study::SourcePlan::observed_columns);
            let Some(observed) = observed.into_iter().find(|column| column.key == key.get_ref()) else {
                let message = format!("the study has no column `{}` of what is observed", key.get_ref());
                return wrong(key.span(), message, "leave it out".to_owned());
            };
            let unit = match &column.unit {
                None => None,
                Some(unit) => match Unit::read(unit.get_ref(), None) {
                    Ok(known) if known.measures() == observed.quantity.into() => Some(known),
                    Ok(known) => {
                        let message = format!("`{}` is no unit of `{}`", known.name(), key.get_ref());
                        let help = format!("write a unit such as {}", observed.quantity.unit());
                        return wrong(unit.span(), message, help);
                    }
                    Err(why) => return Err(source.mistake(Mistake::new(unit.span(), why.to_string()))),
                },
            };
            let from_deg = match &column.from_deg {
                None => 0.0,
                Some(from) if from.get_ref().is_finite() => *from.get_ref(),
                Some(from) => {
                    return wrong(from.span(), "this is no angle".to_owned(), "write 0 or -180".to_owned());
                }
            };
            let text = column.heading.clone();
            own.insert(key.get_ref().clone(), Heading { text, unit, from_rad: from_deg.to_radians() });
        }
        all.push(own);
    }
    Ok(all)
}
