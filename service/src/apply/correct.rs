//! A table corrected row by row: what was observed there, the correction, its uncertainty.

use model_core::{Chain, ObservableId, SymbolId};
use tables::formats::{Column, Kept, Texts};

use super::layout::{Place, numbers};
use super::{As, AsMeasured, Outside, Seen, Uncertain, in_vectors};
use crate::errors_file::FoundOver;
use crate::evaluation::{Evaluator, Exactness, Quantity, column_names};
use crate::instrument::Instrument;
use crate::readings::{ReadingsTable, Rows};
use crate::refusal::Refusal;

/// The column that says where a row lies.
const REGION: &str = "measured_region";

/// What is written beside the corrected columns.
#[derive(Debug, Clone, Copy, Default)]
pub struct Beside {
    /// What the errors add to each column.
    pub correction: bool,
    /// The standard uncertainty of each column, and whether the row lies inside the measured region.
    pub uncertainty: bool,
}

/// What corrects the rows of a table.
pub struct Correction {
    /// The names of the columns that are computed.
    pub added: Vec<String>,
    /// Where they stand.
    pub place: Place,
    chain: Chain,
    seen: SeenAs,
    beside: Beside,
    value: Evaluator,
    error: Option<Evaluator>,
    uncertain: Vec<Uncertain>,
    outside: Outside,
}

enum SeenAs {
    /// The columns of one observable, as a source of a study has them.
    Measured(Box<AsMeasured>),
    /// The columns of some observables.
    Observables(Vec<Seen>),
}

impl Correction {
    /// Writes what the instrument shows under the headings of its data, in their units and notation.
    ///
    /// # Errors
    /// The table lacks a reading, or the instrument an uncertainty.
    pub fn as_measured(
        instrument: &Instrument,
        seen: AsMeasured,
        table: &mut ReadingsTable<'_>,
        beside: Beside,
    ) -> Result<Self, Refusal> {
        let Some((chain, values)) = in_vectors(instrument) else {
            unreachable!("what is written as it was measured has headings")
        };
        let evaluator =
            |quantity| Evaluator::new(&chain, vec![seen.observable], Exactness::Exact, quantity, &values);
        let value = evaluator(Quantity::Value);
        let error = (beside.correction || seen.needs_error()).then(|| evaluator(Quantity::Error));
        table.want(&chain, &value.readings)?;
        let mut added = seen.headers(beside.correction);
        let mut uncertain = Vec::new();
        if beside.uncertainty {
            added.extend(seen.uncertainty_headers());
            added.push(REGION.to_owned());
            uncertain.push(Uncertain::of(instrument, &chain, seen.observable, &values)?);
        }
        let outside = Outside::new(instrument.found.clone());
        let seen = SeenAs::Measured(Box::new(seen));
        Ok(Self { added, place: Place::OfTheirName, chain, seen, beside, value, error, uncertain, outside })
    }

    /// Writes some observables of a chain in a form, behind what the table has; `values` of every symbol, SI. Only an instrument has
    /// uncertainties.
    ///
    /// # Errors
    /// The table lacks a reading, an observable the form, or the instrument an uncertainty.
    pub fn of_observables(
        chain: &Chain,
        (values, found): (&[f64], Vec<FoundOver>),
        instrument: Option<&Instrument>,
        (chosen, form, is_named): (Vec<ObservableId>, As, bool),
        table: &mut ReadingsTable<'_>,
        beside: Beside,
    ) -> Result<Self, Refusal> {
        let seen = chosen.iter().map(|&observable| Seen::new(chain, observable, form, is_named));
        let seen: Vec<Seen> = seen.collect::<Result<_, _>>()?;
        let evaluator = |quantity| Evaluator::new(chain, chosen.clone(), Exactness::Exact, quantity, values);
        let value = evaluator(Quantity::Value);
        let error = beside.correction.then(|| evaluator(Quantity::Error));
        table.want(chain, &value.readings)?;
        // Says if a joint has the name of a column.
        column_names(chain, &chosen)?;
        let mut added: Vec<String> =
            seen.iter().flat_map(|seen| seen.headers(chain, beside.correction)).collect();
        let mut uncertain = Vec::new();
        if let (true, Some(instrument)) = (beside.uncertainty, instrument) {
            added.extend(seen.iter().flat_map(|seen| seen.uncertainty_headers(chain)));
            added.push(REGION.to_owned());
            let of = chosen.iter().map(|&observable| Uncertain::of(instrument, chain, observable, values));
            uncertain = of.collect::<Result<_, _>>()?;
        }
        let (chain, seen) = (chain.clone(), SeenAs::Observables(seen));
        let outside = Outside::new(found);
        Ok(Self { added, place: Place::Behind, chain, seen, beside, value, error, uncertain, outside })
    }

    /// The columns of some rows.
    ///
    /// # Errors
    /// They cannot be computed.
    pub fn rows(&mut self, rows: &Rows) -> Result<Vec<Column>, Refusal> {
        let readings: Vec<(SymbolId, &[f64])> =
            rows.readings.iter().map(|(id, values)| (*id, values.as_slice())).collect();
        let is_outside = self.outside.see(&self.chain, &readings, &self.value)?;
        let values = self.value.columns(&readings, rows.count)?;
        let errors = self.error.as_ref().map(|error| error.columns(&readings, rows.count)).transpose()?;
        let uncertain = self.uncertain.iter().map(|uncertain| uncertain.columns(&readings, rows.count));
        let uncertain: Vec<Vec<Vec<f64>>> = uncertain.collect::<Result<_, _>>()?;
        let (mut columns, mut beside) = (Vec::new(), Vec::new());
        match &self.seen {
            SeenAs::Measured(seen) => {
                columns.extend(seen.columns(&values, errors.as_deref(), self.beside.correction));
                let of =
                    |covariance: &Vec<Vec<f64>>| seen.uncertainties(&values, errors.as_deref(), covariance);
                beside.extend(uncertain.iter().flat_map(of));
            }
            SeenAs::Observables(all) => {
                let mut at = 0;
                for (number, seen) in all.iter().enumerate() {
                    let own = at..at + seen.shown(&self.chain);
                    at = own.end;
                    if let Some(covariance) = uncertain.get(number) {
                        beside.extend(seen.uncertainties(&values[own.clone()], covariance));
                    }
                    let errors = errors.as_ref().map(|errors| &errors[own.clone()]);
                    columns.extend(seen.columns(&values[own.clone()], errors));
                }
            }
        }
        columns.extend(beside);
        let mut columns = numbers(columns);
        columns.extend((!self.uncertain.is_empty()).then(|| region(&is_outside)));
        Ok(columns)
    }

    /// What to warn of rows outside of what the errors were found over.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        self.outside.warning(&self.chain)
    }
}

/// The column that says where each row lies.
fn region(is_outside: &[bool]) -> Column {
    let mut texts = Texts::default();
    is_outside.iter().for_each(|is_outside| texts.push(if *is_outside { "outside" } else { "inside" }));
    Column::Kept(Kept::Texts(texts))
}
