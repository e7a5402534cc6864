//! Why this and not that: the contest as one picture, a bar of evidence beside a bar of price for each hypothesis.

use crate::words::contest::{MEANING, percent, reason};
use calibration::diagnose::{Diagnosis, Hypothesis};
use maud::{Markup, html};

/// Hypotheses that the picture shows.
const SHOWN: usize = 12;

/// Width of the longest bar.
const WIDTH: f64 = 160.0;

/// The picture, behind a fold; nothing where no contest was held.
pub fn contest(diagnosis: &Diagnosis) -> Markup {
    let gains = |own: &&Hypothesis| own.told || own.share > 0.0 || own.gain.is_some();
    let shown: Vec<&Hypothesis> = diagnosis.contest.iter().filter(gains).take(SHOWN).collect();
    let most = shown.iter().filter_map(|own| own.gain).fold(1.0, f64::max);
    html! {
        @if !shown.is_empty() {
            details id="contest" {
                summary { "Why this and not that" }
                p.quiet {
                    (diagnosis.contest.len()) " explanations competed. The upper bar shows the gain of each, the lower bar its price. "
                    (MEANING)
                }
                div.scroll tabindex="0" role="region" aria-label="Explanations that competed" {
                    table {
                        thead {
                            tr {
                                th scope="col" { "explanation" }
                                th scope="col" { "gain over price" }
                                th.number scope="col" { "share" }
                                th scope="col" { "why" }
                            }
                        }
                        tbody {
                            @for own in &shown {
                                tr {
                                    th scope="row" { (own.name) }
                                    td { (bars(own, most)) }
                                    td.number { @if own.share > 0.0 { (percent(own.share)) } }
                                    td { (reason(own, diagnosis)) }
                                }
                            }
                        }
                    }
                }
                p.quiet { "All are listed in report.json under " code { "contest" } "." }
            }
        }
    }
}

fn bars(own: &Hypothesis, most: f64) -> Markup {
    let width = |nats: f64| format!("{:.1}", (WIDTH * nats.max(0.0) / most).min(WIDTH));
    let gain = own.gain.unwrap_or(0.0);
    let told = format!("gain {gain:.1} nats, price {:.1} nats", own.price);
    html! {
        svg width=(WIDTH) height="18" viewBox=(format!("0 0 {WIDTH} 18")) role="img" aria-label=(told) {
            rect.fillbar x="0" y="2" width=(width(gain)) height="6" {}
            rect.outline x="0.5" y="10" width=(width(own.price)) height="5" fill="none" {}
        }
    }
}
