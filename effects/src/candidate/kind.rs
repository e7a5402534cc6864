//! What kind of side quantity an input is, as its statement says, so that each family takes those that are its own. Nothing is
//! guessed from names: a renamed column changes no result.

use model_core::{Meaning, SymbolId, SymbolKind};

use super::Setting;

/// What an input measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Which way a joint moved last, +1 or −1.
    Direction(SymbolId),
    /// How fast a joint moves.
    Rate(SymbolId),
    /// How many times a joint passed its index.
    Turns(SymbolId),
    /// The phase of a modulation over a measured range.
    Phase(SymbolId),
    /// One over a measured range.
    Inverse(SymbolId),
    /// A temperature.
    Temperature,
    /// A time.
    Time,
    /// The side of the pier, or the face: +1 or −1.
    Side,
    /// The angle of a rotator.
    Rotator,
    /// 1 in one session, 0 in the others.
    Session,
    /// Anything else.
    Other,
}

impl Kind {
    /// The kind of an input.
    pub fn of(setting: &Setting<'_>, input: SymbolId) -> Self {
        let symbol = setting.chain.symbol(input);
        match (symbol.meaning, symbol.of) {
            (Some(Meaning::Direction), Some(joint)) => Self::Direction(joint),
            (Some(Meaning::Rate), Some(joint)) => Self::Rate(joint),
            (Some(Meaning::Turns), Some(joint)) => Self::Turns(joint),
            (Some(Meaning::Phase), Some(range)) => Self::Phase(range),
            (Some(Meaning::Inverse), Some(range)) => Self::Inverse(range),
            (Some(Meaning::Temperature), _) => Self::Temperature,
            (Some(Meaning::Time), _) => Self::Time,
            (Some(Meaning::Side), _) => Self::Side,
            (Some(Meaning::Rotator), _) => Self::Rotator,
            (Some(Meaning::Session), _) => Self::Session,
            (
                Some(Meaning::Direction | Meaning::Rate | Meaning::Turns | Meaning::Phase | Meaning::Inverse),
                None,
            )
            | (
                Some(
                    Meaning::Angle | Meaning::Length | Meaning::Range | Meaning::Pressure | Meaning::Humidity,
                )
                | None,
                _,
            ) => Self::Other,
        }
    }

    /// The first input of this kind that effects may use.
    pub(crate) fn input(self, setting: &Setting<'_>) -> Option<SymbolId> {
        self.inputs(setting).first().copied()
    }

    /// Every input of this kind that effects may use.
    pub(crate) fn inputs(self, setting: &Setting<'_>) -> Vec<SymbolId> {
        let is_input = |input: &SymbolId| setting.chain.symbol(*input).kind == SymbolKind::Input;
        let own = setting.inputs.iter().copied().filter(is_input);
        own.filter(|&input| Self::of(setting, input) == self).collect()
    }
}
