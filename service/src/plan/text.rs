//! A campaign in words, and for programs.

use std::fmt::Write as _;

use calibration::design::campaign::MOST;
use model_core::escape::Screen;
use report::style::{BAD, GOOD, HEADING};
use report::words::numbers;
use serde_json::{Map, Value, json};

use super::{Asked, Planned, unit_of};

/// Poses that the terminal lists; the table has all.
const LISTED: usize = 40;

/// The headline and the sentences behind it.
pub(super) fn headline(asked: &Asked<'_>, planned: &Planned) -> (String, Vec<String>) {
    let count = planned.poses.len();
    let poses = if count == 1 { "1 pose".to_owned() } else { format!("{count} poses") };
    let lost = planned.errors.iter().filter(|own| own.lost.is_some()).count();
    let all = planned.errors.len();
    let mut more = Vec::new();
    let title = if planned.is_reached() {
        more.push("Every wanted error reaches its limit with these poses.".to_owned());
        format!("{} DO", poses.to_uppercase())
    } else if lost == all {
        "NO CAMPAIGN DOES".to_owned()
    } else if let Some(needed) = planned.needed.filter(|needed| needed.is_finite()) {
        more.push(format!(
            "{MOST} poses are not enough. About {} would be. Measure each pose with less noise, or more often.",
            numbers_up(needed)
        ));
        "TOO MUCH NOISE".to_owned()
    } else {
        let short = planned.errors.iter().filter(|own| own.lost.is_none() && !own.is_reached()).count();
        if short > 0 {
            more.push(format!(
                "{short} of {all} wanted errors need more poses. Leave --poses out, or raise it."
            ));
        }
        format!("{} DO NOT REACH ALL", poses.to_uppercase())
    };
    if lost > 0 {
        let what = if lost == 1 { "1 wanted error".to_owned() } else { format!("{lost} wanted errors") };
        more.push(format!("No number of poses shows {what} well enough, see below."));
    }
    if asked.prior.is_none() {
        more.push(format!(
            "All {} errors of `{}` are estimated, and nothing is known of them before.",
            estimated(asked),
            asked.chain.observable(asked.observable).name
        ));
    }
    (title, more)
}

fn estimated(asked: &Asked<'_>) -> usize {
    let way = asked.chain.symbols_of_way(asked.observable);
    way.iter().filter(|id| asked.chain.symbol(**id).kind == model_core::SymbolKind::Error).count()
}

/// Two digits, rounded up; beyond a million nobody counts.
fn numbers_up(value: f64) -> String {
    if value > 1e6 {
        return "more than a million".to_owned();
    }
    let power = 10_f64.powf(value.log10().floor() - 1.0).max(1.0);
    format!("{:.0}", (value / power).ceil() * power)
}

/// What a campaign promises, in words.
#[must_use]
pub fn as_text(asked: &Asked<'_>, planned: &Planned) -> Screen {
    let chain = asked.chain;
    let mut out = Screen::default();
    let (title, more) = headline(asked, planned);
    let style = if planned.is_reached() { GOOD } else { BAD };
    out.styled([&style, &format_args!("{style:#}")], &title);
    let _ = writeln!(out, ". {}\n", more.join(" "));
    let heading = |out: &mut Screen, text: &str| {
        out.styled([&HEADING, &format_args!("{HEADING:#}")], text);
        let _ = writeln!(out);
    };
    let name_of = |own: &super::Expected| chain.symbol(own.error).name.clone();
    let width = planned.errors.iter().map(|own| name_of(own).chars().count()).max().unwrap_or(0).max(5);
    heading(&mut out, &format!("{:width$}  {:>14}  {:>14}", "error", "expected ±", "wanted ±"));
    for own in &planned.errors {
        let unit = unit_of(chain, own.error);
        let expected = own.expected.map_or_else(|| "-".to_owned(), |value| numbers::told(value, unit));
        let mark = match (own.is_reached(), &own.lost) {
            (true, _) => "",
            (false, Some(_)) => "  cannot be reached",
            (false, None) => "  not reached",
        };
        let wanted = numbers::told(own.wanted, unit);
        let _ = writeln!(out, "{:width$}  {expected:>14}  {wanted:>14}{mark}", name_of(own));
    }
    let mut reasons: Vec<&str> = planned.errors.iter().filter_map(|own| own.lost.as_deref()).collect();
    reasons.dedup();
    if !reasons.is_empty() {
        let _ = writeln!(out);
        reasons.iter().for_each(|why| {
            let _ = writeln!(out, "- {why}");
        });
    }
    if !planned.poses.is_empty() {
        let _ = writeln!(out);
        let headings: Vec<String> = asked.axes.iter().map(|axis| axis.heading(chain)).collect();
        let widths: Vec<usize> = headings.iter().map(|own| own.chars().count().max(10)).collect();
        let line = |cells: &[String]| {
            let cells = cells.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}"));
            format!("{:>4}  {}", "", cells.collect::<Vec<_>>().join("  "))
        };
        heading(&mut out, &line(&headings));
        for (at, pose) in planned.poses.iter().take(LISTED).enumerate() {
            let cells: Vec<String> =
                asked.axes.iter().zip(pose).map(|(axis, &si)| axis.written(si)).collect();
            let _ = writeln!(out, "{:>4}{}", at + 1, &line(&cells)[4..]);
        }
        if planned.poses.len() > LISTED {
            let _ =
                writeln!(out, "{} more poses: --out DIR writes all of them.", planned.poses.len() - LISTED);
        }
    }
    out
}

/// The same for programs, in SI.
#[must_use]
pub fn as_json(asked: &Asked<'_>, planned: &Planned) -> Value {
    let chain = asked.chain;
    let errors = planned.errors.iter().map(|own| {
        let symbol = chain.symbol(own.error);
        json!({
            "name": symbol.name,
            "unit": symbol.quantity.unit(),
            "wanted": own.wanted,
            "expected": own.expected,
            "reached": own.is_reached(),
            "reachable": own.lost.is_none(),
            "why": own.lost,
        })
    });
    let poses = planned.poses.iter().map(|pose| {
        let values = asked.axes.iter().zip(pose);
        let named = values.map(|(axis, si)| (chain.symbol(axis.symbol).name.clone(), json!(si)));
        Value::Object(named.collect::<Map<_, _>>())
    });
    json!({
        "reached": planned.is_reached(),
        "observable": chain.observable(asked.observable).name,
        "sigma": asked.sigma,
        "count": planned.poses.len(),
        "needed": planned.needed.filter(|needed| needed.is_finite()),
        "compared": planned.candidates,
        "errors": errors.collect::<Vec<_>>(),
        "poses": poses.collect::<Vec<_>>(),
    })
}
