//! A budget as one page for a browser: nothing in it comes from elsewhere, and it has no script.

use claims::checker::Verdict;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use model_core::budget::Curves;
use model_core::escape;
use model_core::{Chain, Symbol};
use observe::SiUnit;
use report::letters;
use report::page::STYLE;
use report::page::svg::{Axis, Picture};
use report::words::numbers;

use super::tables::{PARTS, samples};
use super::{Designed, Measured, Shown, reading_unit, short, size};

/// Errors in the list of what to tighten first.
const FIRST: usize = 12;
/// Places at which the parts of the draws are drawn.
const STEPS: u32 = 200;
/// Against the largest influence of all: below this an error does nothing that a picture can show.
const VISIBLE: f64 = 1e-6;
/// A line of a panel takes every third point of its curve.
const EVERY: usize = 3;

/// The whole page.
#[must_use]
pub fn page(shown: &Shown<'_>) -> String {
    let chain = shown.chain;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Error budget of " (chain.name) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    strong { (chain.name) }
                    p.quiet { "error budget " (shown.poses) }
                    nav aria-label="Contents" {
                        @for one in shown.measured { a href={ "#" (name(chain, one)) } { (name(chain, one)) } }
                        @if shown.claims.is_some() { a href="#claims" { "Statements" } }
                    }
                }
                main {
                    h1 { "What the errors of " (chain.name) " come to" }
                    @for one in shown.measured { (observable(chain, one)) }
                    (claims(shown))
                }
                footer.quiet { p { "trueaxis " (env!("CARGO_PKG_VERSION")) ": " code { (shown.command) } } }
            }
        }
    };
    escape::page(&page.0).into_owned()
}

fn name<'a>(chain: &'a Chain, one: &Measured) -> &'a str {
    &chain.observable(one.budget.observable).name
}

fn unit_of(chain: &Chain, one: &Measured) -> SiUnit {
    match one.budget.unit(chain) {
        "rad" => SiUnit::RAD,
        _ => SiUnit::METRE,
    }
}

fn observable(chain: &Chain, one: &Measured) -> Markup {
    html! {
        section id=(name(chain, one)) {
            h2 { (name(chain, one)) }
            @if let Some(designed) = &one.designed {
                p.lead { (sentence(chain, one, designed)) }
                p.quiet { (assumed(designed)) }
                div.grid {
                    (first(chain, designed))
                    (over_poses(chain, one, designed))
                    (parts(chain, one, designed))
                }
                (allocation(chain, one, designed))
            }
            @if let Some(curves) = &one.curves { (panels(chain, one, curves)) }
            (influences(chain, one))
        }
    }
}

/// What comes of the tolerances, in a sentence.
fn sentence(chain: &Chain, one: &Measured, designed: &Designed) -> Markup {
    let unit = unit_of(chain, one);
    let worst = designed.worst.iter().copied().fold(0.0, f64::max);
    html! {
        "Expect " b { (numbers::told(designed.now.rms, unit)) } " (root sum square over the poses), at worst "
        b { (numbers::told(worst, unit)) } "."
        @if let Some(remaining) = &designed.remaining {
            " After a calibration with " (remaining.poses) " poses, each measured to " (numbers::told(remaining.sigma, unit)) ", "
            b { (numbers::told(remaining.after.spread.rms, unit)) } " remain."
        }
        @if let (Some((wanted, _)), Some(drawn)) = (&designed.wanted, &designed.drawn) {
            " As it is, " (short((1000.0 * drawn.rms.within(*wanted)).round() / 10.0)) " % of the instruments keep "
            (numbers::told(*wanted, unit)) "."
        }
        @if designed.registered { " Common turns and shifts are taken out by registration." }
    }
}

/// What the figures assume: others would give others.
fn assumed(designed: &Designed) -> String {
    let campaign = if designed.remaining.is_some() {
        "; after a calibration: the tolerances as what is known before, and each pose measured once in each component with \
         independent noise"
    } else {
        ""
    };
    format!(
        "Assumed: independent errors, each spread evenly over its size (standard deviation size/√3) unless the command below says \
         otherwise; first order; {} poses, counted alike{campaign}.",
        designed.worst.len()
    )
}

/// What to tighten first.
fn first(chain: &Chain, designed: &Designed) -> Markup {
    let order = designed.by_share(&designed.now.shares);
    let after = designed.remaining.as_ref().map(|remaining| &remaining.after);
    let after_of = |error| {
        let at = designed.tolerances.iter().position(|tolerance| tolerance.error == error)?;
        Some(after?.spread.shares[at])
    };
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    html! {
        div.card.half {
            h3.top { "What to tighten first: shares of the mean square" }
            div.scroll tabindex="0" role="region" aria-label="Shares of the mean square" {
                table {
                    thead { tr {
                        th scope="col" { "error" } th scope="col" { "size" } th scope="col" { "share" }
                        @if after.is_some() { th scope="col" { "after calibration" } }
                    } }
                    tbody {
                        @for &(error, share) in order.iter().take(FIRST) {
                            @let symbol = chain.symbol(error);
                            tr {
                                th scope="row" { code { (symbol.name) } }
                                td { @for t in designed.tolerances.iter().filter(|t| t.error == error) { (size(t.size, symbol.quantity.unit())) } }
                                td { (bar(*share)) " " (percent(*share)) }
                                @if let Some(share) = after_of(error) { td { (percent(share)) } }
                            }
                        }
                        @if let Some(after) = after {
                            tr { th scope="row" { "noise of the campaign" } td {} td {} td { (percent(after.share_of_noise)) } }
                        }
                    }
                }
            }
            @if order.len() > FIRST { p.quiet { "The first " (FIRST) " of " (order.len()) "; the table below has all." } }
        }
    }
}

/// A bar of a share.
fn bar(share: f64) -> Markup {
    let width = (80.0 * share).clamp(0.0, 80.0);
    html! {
        svg viewBox="0 0 80 10" role="presentation" style="display:inline-block;width:80px;height:10px" {
            rect.bar width={ (format!("{width:.1}")) } height="10" {}
        }
    }
}

/// What to expect, the worst and what remains, pose by pose.
fn over_poses(chain: &Chain, one: &Measured, designed: &Designed) -> Markup {
    let t = &designed.sensitivity.t;
    if t.is_empty() {
        return html! {};
    }
    let (unit, factor) = reading_unit(one.budget.unit(chain));
    let remaining = designed.remaining.as_ref().map(|remaining| &remaining.after.spread.by_pose);
    let all = designed.worst.iter().chain(&designed.now.by_pose).copied();
    let y = Axis::around(
        format!("{} error, {unit}", name(chain, one)),
        all.map(|value| value * factor).chain([0.0]),
        false,
    );
    let mut picture = Picture::new(560.0, 330.0, Axis::around("t, rad", t.iter().copied(), false), y);
    let mut line = |class: &str, values: &[f64]| {
        picture.line(class, t.iter().copied().zip(values.iter().map(|value| value * factor)));
    };
    line("outline", &designed.worst);
    line("curve", &designed.now.by_pose);
    if let Some(remaining) = remaining {
        line("normal", remaining);
    }
    let told = "Worst combination, expected error and what remains, along the path";
    html! {
        div.card.half {
            h3.top { "Along the path" }
            (PreEscaped(picture.finish(told)))
            p.quiet {
                "Dashed: worst combination. Thick: to expect (root sum square)."
                @if remaining.is_some() { " Thin: after calibration." }
            }
        }
    }
}

/// How many draws stay within a limit.
fn parts(chain: &Chain, one: &Measured, designed: &Designed) -> Markup {
    let Some(drawn) = &designed.drawn else { return html! {} };
    let (unit, factor) = reading_unit(one.budget.unit(chain));
    let most = drawn.largest.percentile(0.999);
    let limits: Vec<f64> = (0..=STEPS).map(|at| most * f64::from(at) / f64::from(STEPS)).collect();
    let x = Axis::around(format!("limit, {unit}"), [0.0, most * factor].into_iter(), false);
    let y = Axis::around("draws within it, %", [0.0, 100.0].into_iter(), false);
    let mut picture = Picture::new(560.0, 330.0, x, y);
    for (class, (_, sample)) in ["normal", "curve", "outline"].into_iter().zip(samples(drawn)) {
        picture.line(class, limits.iter().map(|&limit| (limit * factor, 100.0 * sample.within(limit))));
    }
    if let Some((wanted, _)) = &designed.wanted {
        picture.line("limit", [(wanted * factor, 0.0), (wanted * factor, 100.0)].into_iter());
    }
    html! {
        div.card.half {
            h3.top { "Draws of all errors at once" }
            (PreEscaped(picture.finish("Part of the draws within a limit")))
            p.quiet {
                "Thin: at one pose. Thick: root mean square over the poses. Dashed: largest over the poses."
                @if designed.wanted.is_some() { " Dotted: what is wanted." }
            }
            div.scroll tabindex="0" role="region" aria-label="Percentiles of the draws" {
                table {
                    thead { tr { th scope="col" { (unit) } @for part in PARTS { th.number scope="col" { (short(100.0 * part)) " %" } } } }
                    tbody {
                        @for (label, (_, sample)) in ["at one pose", "rms", "largest"].into_iter().zip(samples(drawn)) {
                            tr {
                                th scope="row" { (label) }
                                @for part in PARTS { td.number { (format!("{:.3}", sample.percentile(part) * factor)) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn allocation(chain: &Chain, one: &Measured, designed: &Designed) -> Markup {
    let Some((wanted, allocation)) = &designed.wanted else { return html! {} };
    html! {
        details open {
            summary { "Sizes for " (numbers::told(*wanted, unit_of(chain, one))) }
            p { "At " (short((1e3 * allocation.costs.1 / allocation.costs.0).round() / 1e3)) " times the cost, where half a size costs twice as much." }
            div.scroll tabindex="0" role="region" aria-label="Sizes for the wanted error" {
                table {
                    thead { tr { th scope="col" { "error" } th.number scope="col" { "now" } th.number scope="col" { "then" } } }
                    tbody {
                        @for (tolerance, then) in designed.tolerances.iter().zip(&allocation.sizes) {
                            @let symbol = chain.symbol(tolerance.error);
                            tr {
                                th scope="row" { code { (symbol.name) } }
                                td.number { (size(tolerance.size, symbol.quantity.unit())) }
                                td.number { (then.map_or_else(|| "any".to_owned(), |then| size(then, symbol.quantity.unit()))) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// The influence of each error along the path, a panel each.
fn panels(chain: &Chain, one: &Measured, curves: &Curves) -> Markup {
    let (unit, factor) = reading_unit(one.budget.unit(chain));
    let largest = |influence: &[f64]| influence.iter().copied().fold(0.0, f64::max);
    let most = curves.curves.iter().map(|curve| largest(&curve.influence)).fold(0.0, f64::max);
    let mut errors: Vec<_> = curves
        .curves
        .iter()
        .filter(|curve| largest(&curve.influence) > VISIBLE * most)
        .map(|curve| curve.error)
        .collect();
    errors.dedup();
    html! {
        @if !errors.is_empty() {
            h3 style="margin-top:24px" { "Influence of each error alone on " (name(chain, one)) }
            p.quiet { "One line a size, the thick one the largest. Errors without a panel do nothing here." }
            div.grid {
                @for error in errors {
                    @let of: Vec<_> = curves.curves.iter().filter(|curve| curve.error == error).collect();
                    @let symbol = chain.symbol(error);
                    @let sizes: Vec<String> = of.iter().map(|curve| size(curve.size, symbol.quantity.unit())).collect();
                    div.card {
                        h3.top { (printed(symbol)) " at " (sizes.join(", ")) }
                        @let highest = Axis::around(format!("influence, {unit}"), [0.0, most * factor].into_iter(), false);
                        @let mut picture = Picture::new(360.0, 220.0, Axis::around("t, rad", curves.t.iter().copied(), false), highest);
                        @for (at, curve) in of.iter().enumerate() {
                            @let points = curves.t.iter().zip(&curve.influence).step_by(EVERY);
                            (drawn(&mut picture, at + 1 == of.len(), points.map(|(&t, &value)| (t, value * factor))))
                        }
                        (PreEscaped(picture.finish(&format!("Influence of {} along the path", printed(symbol)))))
                    }
                }
            }
        }
    }
}

/// An error as it is printed, with its name where that is another.
fn printed(symbol: &Symbol) -> String {
    let letters = letters::plain(&symbol.latex);
    if letters == symbol.name { letters } else { format!("{letters} ({})", symbol.name) }
}

/// Draws a line where markup is made.
fn drawn(picture: &mut Picture, is_largest: bool, points: impl Iterator<Item = (f64, f64)>) -> Markup {
    picture.line(if is_largest { "curve" } else { "normal" }, points);
    html! {}
}

/// All influences as a table.
fn influences(chain: &Chain, one: &Measured) -> Markup {
    let (unit, factor) = reading_unit(one.budget.unit(chain));
    let rows = one.budget.influences.iter().map(|influence| {
        let symbol = chain.symbol(influence.error);
        (symbol.name.as_str(), size(influence.size, symbol.quantity.unit()), &influence.summary)
    });
    let together = [("sum of all", &one.budget.worst_case), ("root sum square", &one.budget.root_sum_square)];
    let rows = rows.chain(together.map(|(label, summary)| (label, String::new(), summary)));
    html! {
        details {
            summary { "Every error alone, and the sums of all" }
            div.scroll tabindex="0" role="region" aria-label="Influences" {
                table {
                    thead { tr {
                        th scope="col" { "error" } th.number scope="col" { "size" }
                        th.number scope="col" { "largest, " (unit) } th.number scope="col" { "rms, " (unit) }
                    } }
                    tbody {
                        @for (label, size, summary) in rows {
                            tr {
                                th scope="row" { (label) }
                                td.number { (size) }
                                td.number { (short(summary.sup * factor)) }
                                td.number { (short(summary.rms * factor)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// What was stated of the influences, with what they are.
fn claims(shown: &Shown<'_>) -> Markup {
    let Some((file, checked)) = &shown.claims else { return html! {} };
    html! {
        section id="claims" {
            h2 { "What was stated of them" }
            p.quiet { "Compared influences of " (file) ", measured." }
            div.scroll tabindex="0" role="region" aria-label="Statements and what was measured" {
                table {
                    thead { tr { th scope="col" { "statement" } th scope="col" { "verdict" } th.number scope="col" { "ratio" } } }
                    tbody {
                        @for one in *checked {
                            tr {
                                th scope="row" { (one.claim.name) }
                                td { @if one.verdict.holds() { "✓ holds" } @else { "✗ does not hold" } }
                                td.number { @match &one.verdict {
                                    Verdict::Comparison(measured) => @match measured.ratio {
                                        Some(ratio) => { (format!("{ratio:.4}")) }
                                        None => { "–" }
                                    },
                                    _ => {}
                                } }
                            }
                        }
                    }
                }
            }
        }
    }
}
