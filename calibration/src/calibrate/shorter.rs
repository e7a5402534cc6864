//! Fewer effects, where all of them together do worse elsewhere than none.
//!
//! Each effect is accepted where the data lie. If all of them, fitted to two thirds of a joint's range, foretell the third far
//! worse than the declaration as it was, and the first few of them do not, those are kept, and the others are told but not
//! written. Where it is but somewhat worse, or where already the first one makes it worse, a caution has to do: where the data lie the
//! effects help.

use super::CalibrateError;
use crate::search::context::Context;
use crate::search::elsewhere::along_the_way;
use crate::search::fitted::Fitted;
use crate::search::round::Round;

/// Root mean square elsewhere with all effects over that with none, from which on it is far worse.
const FAR: f64 = 1.5;

/// The last round, or one with its first effects alone; and the numbers of those that were left out.
pub(super) fn shortened<'a>(
    whole: &Context<'a>,
    last: Round<'a>,
) -> Result<(Round<'a>, Vec<usize>), CalibrateError> {
    let squares = along_the_way(whole, &last);
    let (Some(before), Some(after)) = (squares.first(), squares.last()) else {
        return Ok((last, Vec::new()));
    };
    if *after <= FAR * FAR * before || squares.len() != last.fitted.found.len() + 1 {
        return Ok((last, Vec::new()));
    }
    let best = (0..squares.len()).min_by(|&a, &b| squares[a].total_cmp(&squares[b]));
    let Some(best) = best.filter(|&first| first > 0) else { return Ok((last, Vec::new())) };
    let (kept, left_out) = last.fitted.found.split_at(best);
    let left_out: Vec<usize> = left_out.iter().map(|found| found.effect).collect();
    let fitted = Fitted::with(whole, kept.to_vec(), &last.fitted)?;
    if !fitted.fit.outcome.is_usable() {
        return Ok((last, Vec::new()));
    }
    Ok((Round::at(whole, fitted)?, left_out))
}
