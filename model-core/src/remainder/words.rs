//! A bound in words.

use std::fmt::Write;

use super::{Bound, Found, PairShare, Parts};
use crate::chain::Chain;

/// Pairs of errors that are listed one by one.
const LISTED: usize = 10;

/// The unit of a bound: `1` for directions, `m` for points and ranges, `rad` for angles.
#[must_use]
pub fn unit(bound: &Bound, chain: &Chain) -> &'static str {
    let observable = chain.observable(bound.observable);
    observable.shown.first().map_or("1", |reading| reading.unit(observable.kind))
}

/// A bound, what a search found, their ratio, and the largest shares, as lines of text.
#[must_use]
pub fn text(bound: &Bound, found: Option<&Found>, chain: &Chain) -> String {
    let observable = chain.observable(bound.observable);
    let unit = match unit(bound, chain) {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    let mut lines =
        format!("{}: |exact - first order| is never more than {:.4e}{unit}\n", observable.name, bound.value);
    match &bound.parts {
        Parts::Vector { is_sum: false, .. } => {
            lines.push_str("  errors this large: the bound is what turns and shifts by them can do at all\n");
        }
        Parts::Vector { second_order, tail, .. } => {
            let _ = writeln!(
                lines,
                "  products of two errors {second_order:.4e}{unit}, of three and more {tail:.4e}{unit}"
            );
        }
        Parts::Readings(readings) => {
            for (reading, one) in observable.shown.iter().zip(readings) {
                let _ = writeln!(lines, "  {}: {one:.4e}{unit}", reading.words());
            }
        }
    }
    if bound.value == 0.0 {
        lines.push_str("  the first order is exact here: nothing is left out\n");
    } else if found.is_some_and(|found| found.value > bound.value) {
        // What is proven is never exceeded but by rounding.
        lines.push_str("  a search finds nothing above the rounding of its numbers\n");
    } else if let Some(found) = found {
        let _ = writeln!(lines, "  largest found by search {:.4e}{unit}", found.value);
        if found.value > 0.0 {
            let _ = writeln!(lines, "  bound / found = {:.3}", bound.value / found.value);
        }
    }
    if let Parts::Vector { shares, .. } = &bound.parts {
        write_shares(&mut lines, shares, chain);
    }
    lines
}

fn write_shares(lines: &mut String, shares: &[PairShare], chain: &Chain) {
    if !shares.is_empty() {
        lines.push_str("  shares of pairs of errors:\n");
    }
    for pair in shares.iter().take(LISTED) {
        let (one, other) = (&chain.symbol(pair.one).name, &chain.symbol(pair.other).name);
        let _ = writeln!(lines, "    {:5.1} %  {one} * {other}", 100.0 * pair.share);
    }
    let rest = 1.0 - shares.iter().take(LISTED).map(|pair| pair.share).sum::<f64>();
    let count = shares.len().saturating_sub(LISTED);
    if count > 0 {
        let _ = writeln!(lines, "    {:5.1} %  {count} other pairs", 100.0 * rest);
    }
}
