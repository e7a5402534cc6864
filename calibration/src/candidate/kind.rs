//! What kind of side quantity an input is, so that each family takes those that are its own: as its statement says, and told by
//! its name where it says nothing.

use model_core::{Meaning, SymbolId, SymbolKind};

use super::Setting;

/// What an input measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `beta_direction`: which way a joint moved last, +1 or −1.
    Direction(SymbolId),
    /// `beta_rate`: how fast a joint moves.
    Rate(SymbolId),
    /// `beta_turns`: how many times a joint passed its index.
    Turns(SymbolId),
    /// `range_phase`: the phase of a modulation over a measured range.
    Phase(SymbolId),
    /// `range_inverse`: one over a measured range.
    Inverse(SymbolId),
    /// `temperature`, `temp_mirror`
    Temperature,
    /// `time`, `elapsed`
    Time,
    /// `face`, `pier`: +1 or −1.
    Side,
    /// `rotator`, an angle.
    Rotator,
    /// `session_2`: 1 in one session, 0 in the others.
    Session,
    /// Anything else.
    Other,
}

/// Words in names, and what they say.
const WORDS: &[(&str, Kind)] = &[
    ("temp", Kind::Temperature),
    ("temperature", Kind::Temperature),
    ("celsius", Kind::Temperature),
    ("kelvin", Kind::Temperature),
    ("time", Kind::Time),
    ("elapsed", Kind::Time),
    ("hours", Kind::Time),
    ("days", Kind::Time),
    ("mjd", Kind::Time),
    ("face", Kind::Side),
    ("pier", Kind::Side),
    ("side", Kind::Side),
    ("rotator", Kind::Rotator),
    ("derotator", Kind::Rotator),
    ("session", Kind::Session),
    ("night", Kind::Session),
    ("setup", Kind::Session),
];

impl Kind {
    /// The kind of an input.
    pub(crate) fn of(setting: &Setting<'_>, input: SymbolId) -> Self {
        match setting.chain.symbol(input).meaning {
            Some(Meaning::Temperature) => Self::Temperature,
            Some(Meaning::Time) => Self::Time,
            Some(Meaning::Side) => Self::Side,
            Some(Meaning::Pressure | Meaning::Humidity) => Self::Other,
            // Of which joint, of what range and whether it is a rotator's angle a statement does not say.
            None
            | Some(Meaning::Direction | Meaning::Rate | Meaning::Angle | Meaning::Length | Meaning::Range) => {
                Self::by_name(setting, input)
            }
        }
    }

    fn by_name(setting: &Setting<'_>, input: SymbolId) -> Self {
        let name = setting.name(input);
        let of_joint = setting.joints().into_iter().find_map(|joint| {
            let rest = name.strip_prefix(setting.name(joint.symbol))?;
            match rest {
                "_direction" => Some(Self::Direction(joint.symbol)),
                "_rate" => Some(Self::Rate(joint.symbol)),
                "_turns" => Some(Self::Turns(joint.symbol)),
                _ => None,
            }
        });
        let of_range = setting.ranges().into_iter().find_map(|(_, _, range)| {
            let rest = name.strip_prefix(setting.name(range))?;
            match rest {
                "_phase" => Some(Self::Phase(range)),
                "_inverse" => Some(Self::Inverse(range)),
                _ => None,
            }
        });
        let by_word = || name.split('_').find_map(|word| WORDS.iter().find(|(known, _)| *known == word));
        of_joint.or(of_range).or_else(|| by_word().map(|&(_, kind)| kind)).unwrap_or(Self::Other)
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
