//! Another reading than the one that is claimed: a print of ΔA where ΔA cos E is meant, of a zenith distance where an
//! elevation is, of an angle that turns the other way.

use super::claim::ClosedForm;
use super::compare::{AXES, Columns, Implied, multiplied};
use super::order::Order;
use super::slip::{FormSlip, FormSlipKind};
use super::verdict::Difference;
use model_core::chain::reading::{Measures, Reading, SignedAxis};
use model_core::chain::{Axis, Chain};
use model_core::forms;

/// The other readings that components of a print are, all terms of them.
pub(super) fn explain(
    chain: &Chain,
    claim: &ClosedForm,
    printed: &Columns,
    differences: &[Difference],
) -> Vec<FormSlip> {
    let Order::UpTo(order) = claim.order else { return Vec::new() };
    let shown = &chain.observable(claim.observable).shown;
    let mut slips = Vec::new();
    for (place, (&component, derived)) in AXES.iter().zip(shown).enumerate() {
        if !differences.iter().any(|difference| difference.component == component) {
            continue;
        }
        let is_printed = |other: &Reading| {
            is_printed(chain, claim, printed, (component, place), order, other).unwrap_or(false)
        };
        if let Some(found) = others(derived).into_iter().find(is_printed) {
            let kind = FormSlipKind::OtherReading { printed: found, derived: *derived };
            slips.push(FormSlip { kind, error: None });
        }
    }
    slips
}

/// Whether a component of the print is another reading of the same vector.
fn is_printed(
    chain: &Chain,
    claim: &ClosedForm,
    printed: &Columns,
    (component, place): (Axis, usize),
    order: u32,
    other: &Reading,
) -> Option<bool> {
    let read = forms::derive_reading(chain, claim.observable, order, other).ok()?;
    let mut components = vec![model_core::algebra::Fraction::whole(model_core::algebra::Poly::zero()); place];
    let mut positive = vec![Vec::new(); place];
    components.push(read.value);
    positive.push(read.positive);
    let mut other = super::claimed(chain, claim, &Implied::new(chain, &components, &positive)).ok()?;
    other.clear_but(component);
    let below = claim.printed.components.each_ref().map(|component| &component.value.below);
    let [left, right] = [multiplied(printed, other.below.each_ref()), multiplied(&other.columns, below)];
    Some(left[place] == right[place])
}

/// What is easily taken for a reading, the likelier first.
fn others(reading: &Reading) -> Vec<Reading> {
    let with = |word: &'static str, measures| Reading { word, measures };
    let back = |axis: SignedAxis| SignedAxis { is_negative: !axis.is_negative, ..axis };
    match reading.measures {
        Measures::Azimuth { zero, through } => vec![
            with("cross_elevation", Measures::CrossElevation { zero, through }),
            with(reading.word, Measures::Azimuth { zero, through: back(through) }),
            with("cross_elevation", Measures::CrossElevation { zero, through: back(through) }),
        ],
        Measures::CrossElevation { zero, through } => vec![
            with("azimuth", Measures::Azimuth { zero, through }),
            with(reading.word, Measures::CrossElevation { zero, through: back(through) }),
            with("azimuth", Measures::Azimuth { zero, through: back(through) }),
        ],
        Measures::Elevation { up } => vec![with("zenith_distance", Measures::ZenithDistance { up })],
        Measures::ZenithDistance { up } => vec![with("elevation", Measures::Elevation { up })],
        Measures::Component(_)
        | Measures::Range
        | Measures::OffAxis
        | Measures::Rotation(_)
        | Measures::Image(_) => Vec::new(),
    }
}
