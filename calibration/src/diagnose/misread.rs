//! Cautions that a mistake in reading the data would bring about all at once: where there is one, it is told in their stead.

use super::caution::Caution;
use super::ended::Ended;
use super::rms::BeforeAfter;
use crate::misread::{Misread, by_the_clock, implausible, strayed};
use crate::search::context::Context;
use crate::search::fitted::Fitted;

/// Residuals where no search was made, and the misread columns that are why, if they are.
pub(crate) struct Unsearched {
    /// One for each unit of residuals.
    pub rms: Vec<BeforeAfter>,
    pub misread: Option<Misread>,
}

/// The cautions, with what no small error explains before them and stations that come out elsewhere behind. Beside misread columns there are
/// no others: they would bring them about.
pub(super) fn misread(
    whole: &Context<'_>,
    last: &Fitted,
    ended: &Ended,
    mut cautions: Vec<Caution>,
    columns: Option<&Misread>,
) -> Vec<Caution> {
    if let Some(columns) = columns {
        return vec![Caution::ColumnMisread(columns.clone())];
    }
    let (request, fit) = (whole.request, &last.fit);
    if matches!(ended, Ended::Converged { .. })
        && let Some(unknowns) = &request.observations.unknowns
    {
        let own = strayed(&request.plan.places.stations, unknowns, &fit.values);
        cautions.extend(own.map(Caution::StationsStrayed));
    }
    cautions.extend(by_the_clock(request.plan, request.observations, fit).map(Caution::ByTheClock));
    let values = implausible(&last.chain, request.observations, fit, &request.plan.plausible);
    if !values.is_empty() {
        cautions.insert(0, Caution::Implausible { values });
    }
    cautions
}
