//! Standard deviations that a study states: one for all, or columns with one for each row.
//!
//! Columns under `[noise]` are those of the first series and of others whose residuals are angles, or lengths, as its are;
//! `[[also]]` may name its own. A series without any is weighed by what its residuals show.

use std::ops::Range;

use model_core::Quantity;
use toml::Spanned;

use super::amount::si;
use super::column_plan::{ColumnPlan, column_plan};
use super::mistakes::{Outcome, every, mistake};
use super::plan::SourcePlan;
use super::written::{Column, Sigma, Study};
use observe::{Measure, SiUnit};

impl Study {
    /// The standard deviation of every residual component, SI, if the study states one.
    pub(super) fn stated_sigma(&self, sources: &[SourcePlan]) -> Outcome<Option<f64>> {
        let Some(written) = &self.noise.sigma else { return Ok(None) };
        let (Sigma::Amount(amount), place) = (written.get_ref(), written.span()) else { return Ok(None) };
        let mut quantities = sources.iter().map(|source| quantity(source.measure));
        let quantity = quantities.next().unwrap_or(Quantity::Angle);
        if quantities.any(|other| other != quantity) {
            return Err(mistake(
                place,
                "one standard deviation cannot stand for angles, lengths and pixels",
                "leave `sigma` out to have each estimated, or write it into a column of each file",
            ));
        }
        let sigma = si(amount, quantity, &place)?;
        if sigma > 0.0 {
            return Ok(Some(sigma));
        }
        Err(mistake(place, "a standard deviation is positive", "leave `sigma` out to have it estimated"))
    }

    /// The columns with the standard deviations of a series: its `own`, or those of the study where its residuals measure
    /// what those of the `first` series do.
    pub(super) fn sigma_columns(
        &self,
        own: Option<&Spanned<Sigma>>,
        measure: Measure,
        first: Measure,
    ) -> Outcome<Vec<ColumnPlan>> {
        let of_all = self.noise.sigma.as_ref().filter(|_| quantity(measure) == quantity(first));
        let Some(written) = own.or(of_all) else { return Ok(Vec::new()) };
        match written.get_ref() {
            Sigma::Columns(_) if matches!(&self.noise.sigma, Some(all) if is_amount(all)) => Err(mistake(
                written.span(),
                "`[noise]` states one standard deviation for every row already",
                "leave one of the two out",
            )),
            Sigma::Columns(columns) => planned(columns, &written.span(), measure),
            Sigma::Amount(_) if own.is_some() => Err(mistake(
                written.span(),
                "`sigma` under `[[also]]` is a column of its file",
                "write `sigma = { column = \"…\", unit = \"…\" }`, or leave it out to have it estimated",
            )),
            Sigma::Amount(_) => Ok(Vec::new()),
        }
    }
}

fn is_amount(sigma: &Spanned<Sigma>) -> bool {
    matches!(sigma.get_ref(), Sigma::Amount(_))
}

/// What residuals measure.
pub(super) fn quantity(measure: Measure) -> Quantity {
    match measure.unit() {
        SiUnit::RAD => Quantity::Angle,
        SiUnit::PIXEL => Quantity::Number,
        _ => Quantity::Length,
    }
}

fn planned(columns: &[Column], place: &Range<usize>, measure: Measure) -> Outcome<Vec<ColumnPlan>> {
    if columns.len() != 1 && columns.len() != measure.components() {
        let message = format!("{} columns for {} residual components", columns.len(), measure.components());
        return Err(mistake(place.clone(), message, "name one column for all, or one for each"));
    }
    every(columns.iter().map(|column| column_plan(column, quantity(measure).into(), place, false)))
}
