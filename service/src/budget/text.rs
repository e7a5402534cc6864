//! Budgets for reading in a terminal.

use std::fmt::Write as _;

use model_core::Chain;
use model_core::budget::{Budget, Summary};
use model_core::escape::Screen;

use super::tables::{PARTS, samples};
use super::{Designed, Measured, reading_unit, short, size};
use report::style::HEADING;

/// Errors that are named as those to tighten first.
const FIRST: usize = 5;

/// One observable.
pub fn as_text(chain: &Chain, measured: &Measured) -> Screen {
    let mut out = influences(chain, &measured.budget);
    if let Some(designed) = &measured.designed {
        out.append(&"\n".into());
        out.append(&tolerances(chain, &measured.budget, designed));
    }
    out
}

/// Lines below their heading.
fn below(heading: &str, lines: &str) -> Screen {
    let mut out = Screen::default();
    out.styled([&HEADING, &format_args!("{HEADING:#}")], heading);
    out.append(&format!("\n{lines}").into());
    out
}

fn influences(chain: &Chain, budget: &Budget) -> Screen {
    let (unit, factor) = reading_unit(budget.unit(chain));
    let name = &chain.observable(budget.observable).name;
    let width = budget.influences.iter().map(|influence| chain.symbol(influence.error).name.len());
    let width = width.max().unwrap_or(0).max("root sum square".len());
    let mut out = format!("  {:width$}  {:>14}  {:>12}  {:>12}\n", "error", "size", "largest", "rms");
    let mut row = |name: &str, size: String, summary: &Summary| {
        let [sup, rms] = [summary.sup, summary.rms].map(|value| short(value * factor));
        let _ = writeln!(out, "  {name:width$}  {size:>14}  {sup:>12}  {rms:>12}");
    };
    for influence in &budget.influences {
        let symbol = chain.symbol(influence.error);
        row(&symbol.name, size(influence.size, symbol.quantity.unit()), &influence.summary);
    }
    row("worst case", String::new(), &budget.worst_case);
    row("root sum square", String::new(), &budget.root_sum_square);
    if budget.is_sampled {
        out.push_str("  some rms comes from scattered poses and is right to about a percent\n");
    }
    below(&format!("{name}, influences in {unit}"), &out)
}

fn tolerances(chain: &Chain, budget: &Budget, designed: &Designed) -> Screen {
    let (unit, factor) = reading_unit(budget.unit(chain));
    let name = &chain.observable(budget.observable).name;
    let told = |value: f64| format!("{:.4}", value * factor);
    let registered = if designed.registered { ", after registration" } else { "" };
    let mut out = String::new();
    let mut line = |label: &str, cells: &[String]| {
        let _ = write!(out, "  {label:22}");
        cells.iter().for_each(|cell| {
            let _ = write!(out, "  {cell:>9}");
        });
        out.push('\n');
    };
    line("", &["rms".to_owned(), "largest".to_owned()]);
    line("to expect of all", &[told(designed.now.rms), told(designed.now.largest().1)]);
    line("worst combination", &["".to_owned(), told(designed.worst.iter().copied().fold(0.0, f64::max))]);
    if let Some(remaining) = &designed.remaining {
        let spread = &remaining.after.spread;
        line("after calibration", &[told(spread.rms), told(spread.largest().1)]);
    }
    let drawn = [("drawn", &designed.drawn)];
    let after = designed.remaining.as_ref().map(|remaining| ("drawn, after calibration", &remaining.drawn));
    for (title, drawn) in drawn.into_iter().chain(after) {
        let Some(drawn) = drawn else { continue };
        let wanted = designed.wanted.as_ref().map(|(wanted, _)| *wanted);
        line(title, &PARTS.map(|part| format!("{} %", short(100.0 * part))));
        for (label, (_, sample)) in
            ["  at one pose", "  rms over the poses", "  largest over them"].into_iter().zip(samples(drawn))
        {
            line(label, &PARTS.map(|part| told(sample.percentile(part))));
        }
        if let Some(wanted) = wanted {
            let cells = samples(drawn).map(|(_, sample)| format!("{:.1} %", 100.0 * sample.within(wanted)));
            line("  within what is wanted", &[]);
            for (label, cell) in
                ["    at one pose", "    rms over the poses", "    largest over them"].into_iter().zip(cells)
            {
                line(label, &[cell]);
            }
        }
    }
    let first = |shares: &[f64], noise: f64| -> String {
        let named = designed.by_share(shares).into_iter().take(FIRST).filter(|(_, share)| **share > 0.005);
        let mut parts: Vec<String> = named
            .map(|(error, share)| format!("{} {:.0} %", chain.symbol(error).name, 100.0 * share))
            .collect();
        if noise > 0.005 {
            parts.push(format!("the noise of the campaign {:.0} %", 100.0 * noise));
        }
        parts.join(", ")
    };
    let _ = writeln!(out, "  Tighten first: {}.", first(&designed.now.shares, 0.0));
    if let Some(remaining) = &designed.remaining {
        let after = &remaining.after;
        let _ = writeln!(
            out,
            "  After {} poses with noise of {}, what remains comes from: {}.",
            remaining.poses,
            size(remaining.sigma, budget.unit(chain)),
            first(&after.spread.shares, after.share_of_noise)
        );
    }
    if let Some((wanted, allocation)) = &designed.wanted {
        let ratio = allocation.costs.1 / allocation.costs.0;
        let _ = writeln!(
            out,
            "  Sizes for {}, at {} times the cost:",
            size(*wanted, budget.unit(chain)),
            short((1e3 * ratio).round() / 1e3)
        );
        for (tolerance, then) in designed.tolerances.iter().zip(&allocation.sizes) {
            let symbol = chain.symbol(tolerance.error);
            let unit = symbol.quantity.unit();
            let then = then.map_or_else(|| "any".to_owned(), |then| size(then, unit));
            let _ = writeln!(out, "    {:20}  {:>16}  now {}", symbol.name, then, size(tolerance.size, unit));
        }
    }
    below(&format!("{name}, what the tolerances come to, in {unit}{registered}"), &out)
}
