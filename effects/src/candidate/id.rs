//! The number of an effect in the catalogue of one chain.

use std::ops::Index;

use super::Effect;

/// Where an effect stands in a catalogue, which is never reordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EffectId(pub usize);

impl Index<EffectId> for Vec<Effect> {
    type Output = Effect;

    fn index(&self, id: EffectId) -> &Effect {
        &self[id.0]
    }
}
