//! The terms of TPOINT for one chain: what a unit of each adds to a direction, with its sign.

use model_core::algebra::Poly;
use model_core::{Chain, Meaning, ObservableId, SymbolId, SymbolKind};

use super::mount::{Kind, Mount};
use super::{Sides, published};
use crate::candidate::{Setting, seen};

/// The terms for a mount whose line of sight runs as their formulas have it.
#[derive(Debug, Clone, PartialEq)]
pub struct PointingTerms {
    /// Which formulas apply.
    pub kind: Kind,
    /// What is observed: a direction.
    pub observable: ObservableId,
    /// The latitude, of an equatorial mount.
    pub latitude: Option<SymbolId>,
    /// Each term, the usual ones first.
    pub terms: Vec<PointingTerm>,
    /// Unit vectors across and along, in the ground frame.
    frame: [[Poly; 3]; 2],
}

/// A term.
#[derive(Debug, Clone, PartialEq)]
pub struct PointingTerm {
    /// `ME`
    pub name: String,
    /// `polar axis off in elevation`
    pub meaning: &'static str,
    /// What a unit adds to the reading so that it becomes the true place: on the sky, towards growing azimuth (or hour angle) and
    /// growing elevation (or declination).
    pub change: [Poly; 2],
}

impl PointingTerms {
    /// The terms for what is observed first; `None` where the line of sight runs in another way.
    #[must_use]
    pub fn of(setting: &Setting<'_>) -> Option<Self> {
        let mount = Mount::of(setting)?;
        if mount.kind == Kind::Scanner {
            return None;
        }
        let side = side(setting.chain);
        let terms = published().into_iter().filter(|term| term.field == "TPOINT" && term.kind == mount.kind);
        let terms = terms.filter_map(|term| {
            let [across, along, _] = mount.formula(&term)?;
            let sign = match (side, term.sides) {
                (None, _) | (Some(_), Sides::Same) => Poly::one(),
                (Some(side), Sides::Reversed) => Poly::symbol(side),
                (Some(_), Sides::Unsaid) => return None,
            };
            let change = [&across * &sign, &along * &sign];
            Some(PointingTerm { name: term.name, meaning: term.meaning, change })
        });
        let terms = terms.collect();
        let Mount { kind, observable, latitude, frame: [across, along, _], .. } = mount;
        Some(Self { kind, observable, latitude, terms, frame: [across, along] })
    }

    /// Unit vectors across and along, in the ground frame.
    #[must_use]
    pub fn frame(&self) -> &[[Poly; 3]; 2] {
        &self.frame
    }

    /// A small change of the direction as its parts across and along.
    #[must_use]
    pub fn parts(&self, change: &[Poly; 3]) -> [Poly; 2] {
        self.frame.each_ref().map(|direction| seen::dot(direction, change))
    }
}

/// The side of the pier, or the face: 1, and -1 where the instrument points through the pole.
fn side(chain: &Chain) -> Option<SymbolId> {
    chain.symbols_of(SymbolKind::Input).find(|id| chain.symbol(*id).meaning == Some(Meaning::Side))
}
