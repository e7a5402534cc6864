//! What is observed as the data of a study have it: their headings, units and notation.

use std::f64::consts::{PI, TAU};

use model_core::{Chain, ObservableId, Quantity};
use nalgebra::Vector3;
use observe::kinds::{Filled, Shows};
use study::{Conversion, SourcePlan};
use tables::formats::ColumnName;

use super::uncertain::along;
use crate::instrument::Instrument;

const ARCSEC: f64 = PI / 648_000.0;

/// Steps of slopes against the length of the vector.
///
/// Source: the cube root of the rounding unit, at which truncation and rounding of a central difference are alike.
const STEP: f64 = 6e-6;

/// The columns of one observable, as a source of a study has them.
#[derive(Clone)]
pub struct AsMeasured {
    /// What is observed; the chain of the study's headings shows it as a vector.
    pub observable: ObservableId,
    source: SourcePlan,
    filled: Filled,
    columns: Vec<Written>,
}

#[derive(Clone)]
struct Written {
    heading: String,
    quantity: Quantity,
    conversion: Conversion,
    /// The size of its unit, rad, m or 1, and its name.
    unit: (f64, &'static str),
    /// Where an angle that goes round begins, rad.
    from_rad: Option<f64>,
}

impl AsMeasured {
    /// As a source of the study of an instrument has them; `None` where no study says it, or where its rows hold what a chain alone does not
    /// show.
    #[must_use]
    pub fn of(instrument: &Instrument, source: usize) -> Option<Self> {
        let headings = instrument.headings.as_ref()?;
        let plan = headings.sources.get(source)?.clone();
        let filled = plan.filled()?;
        let known = instrument.corrected.get(source);
        let columns = plan.observed_columns().enumerate().map(|(at, column)| {
            let known = known.and_then(|known| known.get(column.key));
            let of_data = known.and_then(|known| known.unit).map(|unit| (unit.in_si(), unit.name()));
            let unit = column.unit.or(of_data).unwrap_or((1.0, column.quantity.unit()));
            let from_rad = (filled.turns && at == 0).then(|| known.map_or(0.0, |known| known.from_rad));
            let heading = known
                .map_or_else(|| ColumnName::of_si(column.name, column.quantity), |known| known.text.clone());
            let (quantity, conversion) = (column.quantity, column.conversion);
            Written { heading, quantity, conversion, unit, from_rad }
        });
        let columns = columns.collect();
        Some(Self { observable: plan.observable, filled, columns, source: plan })
    }

    /// Whether what the errors add is needed even without the correction.
    #[must_use]
    pub fn needs_error(&self) -> bool {
        self.filled.beside_nominal
    }

    /// The direction or point that columns as the study has them say, SI; none where they say none by themselves.
    #[must_use]
    pub fn target(&self, columns: &[&[f64]], row: usize) -> Option<[f64; 3]> {
        let numbers: Vec<f64> = columns.iter().map(|column| column[row]).collect();
        self.source.target(&numbers).map(Into::into)
    }

    /// Whether such columns say a direction or point by themselves.
    #[must_use]
    pub fn has_targets(&self) -> bool {
        !self.filled.beside_nominal
    }

    /// Headings of the columns that are written; with the correction if that is wanted.
    #[must_use]
    pub fn headers(&self, correction: bool) -> Vec<String> {
        let own = self.columns.iter().map(|column| column.heading.clone());
        let corrections =
            self.columns.iter().filter(|_| correction).map(|column| column.beside("correction"));
        own.chain(corrections).collect()
    }

    /// Headings of the standard uncertainties of the columns.
    #[must_use]
    pub fn uncertainty_headers(&self) -> Vec<String> {
        self.columns.iter().map(|column| column.beside("uncertainty")).collect()
    }

    /// The standard uncertainty of each column in the unit of its correction, from the vector with the errors, what the errors add to it, and the
    /// [covariance](super::Uncertain::columns) of the vector.
    #[must_use]
    pub fn uncertainties(
        &self,
        value: &[Vec<f64>],
        error: Option<&[Vec<f64>]>,
        covariance: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let rows = value.first().map_or(0, Vec::len);
        let mut out = vec![Vec::with_capacity(rows); self.columns.len()];
        for row in 0..rows {
            let at = |columns: &[Vec<f64>]| Vector3::from_fn(|axis, _| columns[axis][row]);
            let vector = at(value);
            let nominal = error.map_or(vector, |error| vector - at(error));
            let step = STEP * vector.norm().max(f64::MIN_POSITIVE);
            let sides = [0, 1, 2].map(|axis| {
                let moved = |by: f64| {
                    let mut vector = vector;
                    vector[axis] += by;
                    (self.filled.of)(&Shown { source: &self.source, vector, nominal })
                };
                [moved(step), moved(-step)]
            });
            for (place, (column, own)) in self.columns.iter().zip(&mut out).enumerate() {
                let slope = |[above, below]: &[[f64; 3]; 2]| {
                    column.correction(above[place], below[place]) / (2.0 * step)
                };
                own.push(along(&[slope(&sides[0]), slope(&sides[1]), slope(&sides[2])], covariance, row));
            }
        }
        out
    }

    /// The columns that are written, from the vector with the errors and what the errors add to it.
    #[must_use]
    pub fn columns(&self, value: &[Vec<f64>], error: Option<&[Vec<f64>]>, correction: bool) -> Vec<Vec<f64>> {
        let rows = value.first().map_or(0, Vec::len);
        let count = self.columns.len();
        let mut out = vec![Vec::with_capacity(rows); if correction { 2 * count } else { count }];
        for row in 0..rows {
            let at = |columns: &[Vec<f64>]| Vector3::from_fn(|axis, _| columns[axis][row]);
            let vector = at(value);
            let nominal = error.map_or(vector, |error| vector - at(error));
            let with = (self.filled.of)(&Shown { source: &self.source, vector, nominal });
            let without = (self.filled.of)(&Shown { source: &self.source, vector: nominal, nominal });
            for (place, column) in self.columns.iter().enumerate() {
                out[place].push(column.number(with[place]));
                if correction {
                    out[count + place].push(column.correction(with[place], without[place]));
                }
            }
        }
        out
    }
}

impl Written {
    /// The heading of what is written beside it in the unit of its correction.
    fn beside(&self, what: &str) -> String {
        let name = format!("{}_{what}", ColumnName::parse(&self.heading).stem);
        match self.quantity {
            Quantity::Angle => format!("{name} [arcsec]"),
            Quantity::Length => format!("{name} [{}]", self.unit.1),
            Quantity::Number => name,
        }
    }

    /// What stands in the file for a number in SI.
    fn number(&self, si: f64) -> f64 {
        let mut plain = self.conversion.plain(si);
        if let Some(from_rad) = self.from_rad {
            plain = from_rad + (plain - from_rad).rem_euclid(TAU);
        }
        self.conversion.packed(plain, self.unit.0)
    }

    /// By how much that number grows by the errors: in arc seconds, or in its own unit.
    fn correction(&self, with: f64, without: f64) -> f64 {
        let grown = self.conversion.plain(with) - self.conversion.plain(without);
        match (self.quantity, self.from_rad) {
            (Quantity::Angle, Some(_)) => (grown - TAU * (grown / TAU).round()) / ARCSEC,
            (Quantity::Angle, None) => grown / ARCSEC,
            (Quantity::Length | Quantity::Number, _) => grown / self.unit.0,
        }
    }
}

/// A row.
struct Shown<'a> {
    source: &'a SourcePlan,
    vector: Vector3<f64>,
    nominal: Vector3<f64>,
}

impl Shows for Shown<'_> {
    fn vector(&self) -> Vector3<f64> {
        self.vector
    }

    fn nominal(&self) -> Vector3<f64> {
        self.nominal
    }

    fn angles(&self, direction: &Vector3<f64>) -> [f64; 2] {
        self.source.angles(direction)
    }
}

/// The chain by which these columns are computed: that of the study, whose observables show vectors, with the constants of the
/// calibration; and the value of every symbol of it.
#[must_use]
pub fn in_vectors(instrument: &Instrument) -> Option<(Chain, Vec<f64>)> {
    let chain = instrument.headings.as_ref()?.chain.clone();
    // The study's own inputs stand behind the symbols of the declaration.
    let values = instrument.values_in(&chain);
    Some((chain, values))
}
