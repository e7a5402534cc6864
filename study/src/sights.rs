//! Sights from points of the chain: their beams end where the objects are, and no column says how far that is.

use model_core::{Chain, ObservableId, SymbolId};
use toml::Spanned;

use super::kind::observes;
use super::mistakes::{Outcome, Several, mistake};
use super::written::{Kind, Observed};
use fit::range_of;
use observe::kinds::BeamUse;

/// Whether the rows of an observation are sights from a point of the chain.
fn is_from_a_point(chain: &Chain, id: ObservableId, kind: Kind) -> bool {
    kind.ways_of(observes(chain.observable(id))).any(|measure| measure.kind().beam == BeamUse::Whole)
}

/// Holds a sight from a point of the chain to a point that lies on a beam.
pub(super) fn check_sight(chain: &Chain, id: ObservableId, written: &Spanned<Observed>) -> Outcome<()> {
    if !is_from_a_point(chain, id, written.get_ref().kind) || range_of(chain, id).is_some() {
        return Ok(());
    }
    let name = &chain.observable(id).name;
    let message = format!("`{name}` has no beam: no input of length, or more than one, moves it");
    let help =
        "observe a point on the beam, as `input range: length; observe sight: point(0, range, 0) of camera;`";
    Err(mistake(written.span(), message, help))
}

/// The range of a sight from a point of the chain, which nobody measures.
pub(super) fn sighted(chain: &Chain, id: ObservableId, kind: Kind) -> Option<SymbolId> {
    if is_from_a_point(chain, id, kind) { range_of(chain, id) } else { None }
}

/// A column is named for the range of a sight.
pub(super) fn no_range(name: &Spanned<String>) -> Several {
    let message = format!("a sight reads no `{}`: it ends where its object is", name.get_ref());
    mistake(name.span(), message, "leave the column out, or write kind = \"target\"")
}
