//! Where a study asks to be told to measure next.

use model_core::{Chain, SymbolKind};

use super::mistakes::{Gathered, Outcome, every, mistake, unknown, within};
use super::plan::{NextPoses, si};
use super::written::Study;

impl Study {
    /// Where to propose to measure next.
    pub(super) fn next(&self, chain: &Chain) -> Outcome<Option<NextPoses>> {
        let Some(next) = &self.next else { return Ok(None) };
        let mut mistakes = Gathered::default();
        mistakes.take(within(next.poses.span(), "poses", *next.poses.get_ref(), 1..=10_000));
        let joints = || chain.symbols_of(SymbolKind::Joint);
        let ranges = mistakes.take(every(next.range.iter().map(|(name, range)| {
            let id = joints().find(|&id| chain.symbol(id).name == *name.get_ref()).ok_or_else(|| {
                let names: Vec<&str> = joints().map(|id| chain.symbol(id).name.as_str()).collect();
                unknown(name.span(), "joint", name.get_ref(), names.iter().copied())
            })?;
            let [low, high] = range.get_ref();
            let quantity = chain.symbol(id).quantity;
            let (low, high) = (si(low, quantity, &range.span())?, si(high, quantity, &range.span())?);
            if low > high {
                return Err(mistake(range.span(), "the range ends before it starts", "swap the two"));
            }
            Ok((id, low..high))
        })));
        mistakes.none()?;
        let count = usize::try_from(*next.poses.get_ref()).unwrap_or(usize::MAX);
        Ok(ranges.map(|ranges| NextPoses { count, ranges }))
    }
}
