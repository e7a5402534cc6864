//! The instrument file as it is written: version, declaration, errors, covariance, columns and where all that came from.

use std::collections::BTreeMap;
use std::ops::Range;

use model_core::mistake::Mistake;
use serde::Deserialize;
use study::Study;
use toml::Spanned;
use toml::value::Datetime;

use crate::errors_file::{Entries, Ranges};
use crate::refusal::Refusal;
use crate::source::Source;

/// The version that is written; every earlier one is read.
pub const VERSION: i64 = 1;

/// An instrument file of version 1.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Contents {
    #[serde(rename = "instrument")]
    _version: i64,
    /// The text of the declaration.
    pub chain: Spanned<String>,
    /// The last day on which it counts.
    pub valid_until: Option<Spanned<Datetime>>,
    /// Estimates, and errors that were held at a value.
    #[serde(default)]
    pub errors: Entries,
    /// Constants, declared or estimated.
    #[serde(default)]
    pub constants: Entries,
    /// The readings that the errors were found over.
    #[serde(default)]
    pub found_over: Ranges,
    /// How sure the estimates are.
    pub covariance: Option<Covariance>,
    /// How uncertain one observation of each source is.
    #[serde(default)]
    pub noise: Vec<Noise>,
    /// What the columns of the data mean, as a study says it.
    pub study: Option<Study>,
    /// How `apply` writes what is observed, source by source.
    #[serde(default)]
    pub corrected: Vec<BTreeMap<Spanned<String>, Corrected>>,
    /// Where it came from: for people, and for other programs.
    #[serde(default)]
    pub provenance: toml::Table,
}

/// `[covariance]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Covariance {
    /// The estimates, in the order of the rows.
    pub of: Spanned<Vec<Spanned<String>>>,
    /// Those of them that the data do not determine by themselves.
    #[serde(default)]
    pub undetermined: Vec<Spanned<String>>,
    /// SI, row by row.
    pub rows: Spanned<Vec<Spanned<Vec<Spanned<f64>>>>>,
}

/// A source of `[[noise]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Noise {
    /// The residual components: for people.
    #[serde(rename = "components")]
    pub _components: Option<Vec<String>>,
    /// The standard deviation of each, SI.
    pub sigma: Spanned<Vec<Spanned<f64>>>,
    /// The degrees of freedom that they were estimated with; none where they are known.
    pub degrees_of_freedom: Option<Spanned<f64>>,
}

/// A column of `[[corrected]]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Corrected {
    /// Its heading in the data.
    pub heading: String,
    /// Its unit, where it has one.
    pub unit: Option<Spanned<String>>,
    /// Where an angle that goes round begins, in degrees: 0 or −180.
    pub from_deg: Option<Spanned<f64>>,
}

/// The version alone, whatever else a file has.
#[derive(Deserialize)]
struct Version {
    instrument: Spanned<toml::Value>,
}

impl Contents {
    /// Reads it.
    pub fn of(source: &Source) -> Result<Self, Refusal> {
        let Version { instrument } = source.toml()?;
        let at = instrument.span();
        match instrument.get_ref().as_integer() {
            Some(VERSION) => {}
            Some(later) if later > VERSION => {
                let message = format!(
                    "this instrument file is of version {later}, and this program reads versions up to {VERSION}"
                );
                let help = "read it with a later trueaxis, or calibrate again with this one";
                return Err(source.mistake(Mistake::new(at, message).with_help(help)));
            }
            _ => {
                let message = "the version of an instrument file is a whole number from 1";
                return Err(source.mistake(Mistake::new(at, message).with_help("write instrument = 1")));
            }
        }
        let file: Self = source.toml()?;
        if let Some(date) = &file.valid_until
            && date.get_ref().date.is_none()
        {
            let mistake = Mistake::new(date.span(), "this is no date");
            return Err(source.mistake(mistake.with_help("write the last day, as valid-until = 2027-06-30")));
        }
        Ok(file)
    }

    /// The bytes of the file that the text of the declaration stands in, where it stands there letter by letter.
    pub fn place_of_chain(&self, source: &Source) -> Option<Range<usize>> {
        let within = self.chain.span();
        let start = within.start + source.text.get(within.clone())?.find(self.chain.get_ref().as_str())?;
        Some(start..start + self.chain.get_ref().len())
    }
}
