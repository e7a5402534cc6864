//! Of models that the data fit about as well, the one that is written into the chain is the one that does least further out.
//!
//! What these data do not decide, other poses would: a wave of eight periods a turn and a sag may fit the same stretch of a
//! joint, and half a range on the wave is wrong by as much as it ever was, where the sag is still small.

use super::competing::AS_GOOD;
use super::confounded::{SetColumns, SetId};
use super::guards::Guards;
use super::state::State;

/// How much less a model has to do further out before it takes the place of a likelier one.
const LESS: f64 = 0.8;

/// What the choice reads.
pub(super) struct Modest<'a> {
    /// The columns of each set.
    pub blocks: &'a SetColumns,
    /// What sets do together further out; where nobody knows, the likeliest stay.
    pub guards: &'a Guards<'a>,
    /// Sets that do not come back.
    pub dropped: &'a [SetId],
}

impl Modest<'_> {
    /// Puts in the place of each accepted set that of those within [`AS_GOOD`] units of penalised log-likelihood of it which
    /// does least further out, all others refitted.
    pub fn written(&self, state: &mut State, accepted: &mut [SetId]) {
        for at in 0..accepted.len() {
            let own = accepted[at];
            state.remove_among(own, accepted.iter().copied(), self.blocks);
            let (gain, rank) = state.gain(&self.blocks[own]);
            let least = state.criterion(gain, rank) - AS_GOOD;
            let with = |set: SetId| -> Vec<SetId> {
                accepted.iter().map(|&other| if other == own { set } else { other }).collect()
            };
            let as_good = |&set: &SetId| {
                let (gain, rank) = state.gain(&self.blocks[set]);
                rank > 0 && state.criterion(gain, rank) >= least
            };
            let open = self.blocks.ids().filter(|set| !accepted.contains(set) && !self.dropped.contains(set));
            let best = self.guards.further_out(&with(own)).and_then(|present| {
                open.filter(as_good)
                    .filter_map(|set| Some((self.guards.further_out(&with(set))?, set)))
                    .filter(|&(does, set)| does < LESS * present && self.guards.hold(&with(set)))
                    .min_by(|a, b| a.0.total_cmp(&b.0))
            });
            accepted[at] = best.map_or(own, |(_, set)| set);
            state.add(&self.blocks[accepted[at]]);
        }
    }
}
