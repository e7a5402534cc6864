//! A bound in words.

use std::fmt::Write;

use super::{Bound, Found};
use crate::chain::{Chain, ObservableKind};

/// Pairs of errors that are listed one by one.
const LISTED: usize = 10;

/// A bound, what a search found, their ratio, and the largest shares, as lines of text.
#[must_use]
pub fn text(bound: &Bound, found: Option<&Found>, chain: &Chain) -> String {
    let observable = chain.observable(bound.observable);
    let unit = match observable.kind {
        ObservableKind::Direction => "",
        ObservableKind::Point => " m",
    };
    let mut lines = format!(
        "{}: |exact - first order| is never more than {:.4e}{unit}\n  \
         products of two errors {:.4e}{unit}, of three and more {:.4e}{unit}\n",
        observable.name, bound.value, bound.second_order, bound.tail
    );
    if let Some(found) = found {
        let _ = writeln!(lines, "  largest found by search {:.4e}{unit}", found.value);
        if found.value > 0.0 {
            let _ = writeln!(lines, "  bound / found = {:.3}", bound.value / found.value);
        }
    }
    if !bound.shares.is_empty() {
        lines.push_str("  shares of pairs of errors:\n");
    }
    for pair in bound.shares.iter().take(LISTED) {
        let (one, other) = (&chain.symbol(pair.one).name, &chain.symbol(pair.other).name);
        let _ = writeln!(lines, "    {:5.1} %  {one} * {other}", 100.0 * pair.share);
    }
    let rest: f64 = bound.shares.iter().skip(LISTED).map(|pair| pair.share).sum();
    if rest > 0.0 {
        let count = bound.shares.len() - LISTED;
        let _ = writeln!(lines, "    {:5.1} %  {count} other pairs", 100.0 * rest);
    }
    lines
}
