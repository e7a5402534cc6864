//! Cautions that a mistake in reading the data would bring about all at once: where there is one, it is told in their stead.

use super::caution::Caution;
use super::ended::Ended;
use super::otherwise::{Doubt, otherwise};
use super::rms::BeforeAfter;
use super::strayed::strayed;
use crate::misread::{Misread, implausible};
use crate::search::context::Context;
use crate::search::fitted::Fitted;

/// Residuals where no search was made, and the misread columns that are why, if they are.
pub(crate) struct Unsearched {
    /// One for each unit of residuals.
    pub rms: Vec<BeforeAfter>,
    pub misread: Option<Misread>,
}

/// The cautions, with the mistake that explains them first where there is one; behind them that stations come out elsewhere. Beside
/// misread columns there are no others: they would bring them about.
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
    let has_failed =
        matches!(ended, Ended::NotConverged { .. } | Ended::FarOff { .. } | Ended::NoRest { .. });
    if let Some(mistake) = doubt(&cautions, has_failed).and_then(|doubt| otherwise(whole, doubt)) {
        cautions.retain(|caution| !follows(caution));
        cautions.insert(0, Caution::FitsOtherwise(mistake));
    } else if !has_failed {
        cautions.extend(strayed(whole, fit).map(Caution::StationsStrayed));
    }
    let values = implausible(&last.chain, request.observations, fit, &request.plan.plausible);
    if !values.is_empty() && !cautions.iter().any(|own| matches!(own, Caution::FitsOtherwise(_))) {
        cautions.insert(0, Caution::Implausible { values });
    }
    cautions
}

/// What raises a doubt among cautions.
fn doubt(cautions: &[Caution], has_failed: bool) -> Option<Doubt> {
    let count = |is: fn(&&Caution) -> bool| cautions.iter().filter(is).count();
    let is_far = count(|caution| matches!(caution, Caution::OutOfPlace { .. })) > 0;
    let are_aside = count(|caution| matches!(caution, Caution::NotWhereStated { sigmas: None, .. })) > 1;
    if has_failed || is_far || are_aside {
        return Some(Doubt::Residual);
    }
    let is_large = count(|caution| matches!(caution, Caution::ErrorNotSmall { .. })) > 0;
    is_large.then_some(Doubt::Error)
}

/// Whether a mistake in reading the data would bring a caution about.
fn follows(caution: &Caution) -> bool {
    matches!(
        caution,
        Caution::OutOfPlace { .. }
            | Caution::ErrorNotSmall { .. }
            | Caution::NotWhereStated { .. }
            | Caution::Scatters { .. }
            | Caution::SetAsideShare { .. }
            | Caution::OffAlike { .. }
            | Caution::TwoPlaces(_)
    )
}
