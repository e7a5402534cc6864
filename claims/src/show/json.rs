//! Verdicts for programs.

use crate::checker::{Claim, Difference, Means, Outcome, Verdict};
use model_core::{Axis, print};
use serde_json::{Value, json};

use super::text::{place_in_text, product};
use crate::file::{Checked, Claims, NamedClaim, Unread};

/// One verdict.
pub fn as_json(file: &Claims, checked: &Checked<'_>) -> Value {
    let verdict = match checked.verdict.outcome() {
        Outcome::Holds => "holds",
        Outcome::Differs => "differs",
        Outcome::Undecided => "open",
    };
    let means = match checked.verdict.means() {
        Means::Decided => "decided",
        Means::Computed => "computed",
        Means::Sampled => "sampled",
        Means::Proven => "proven",
    };
    let mut claim = json!({"name": checked.claim.name, "equation": checked.claim.texts, "verdict": verdict, "means": means, "differences": []});
    let names = |ids: &[model_core::SymbolId]| -> Vec<Value> {
        ids.iter().map(|&id| Value::from(file.chain.symbol(id).name.as_str())).collect()
    };
    match &checked.verdict {
        Verdict::ClosedForm(form) => {
            claim["differences"] = form
                .differences
                .iter()
                .map(|difference| difference_as_json(file, checked.claim, difference))
                .collect();
            if !form.differences.is_empty() {
                let mut only = None;
                if let Claim::ClosedForm(claimed) = &checked.claim.claim {
                    only = claimed.only.map(Axis::index);
                    let slips = form.slips.iter();
                    claim["diagnosis"] = slips
                        .map(|slip| Value::from(slip.describe(&file.chain, claimed.observable)))
                        .collect();
                }
                // Of components that nobody claimed nothing is said.
                let corrected = form.corrected(&file.printed).into_iter().enumerate();
                claim["corrected"] =
                    corrected.map(|(at, text)| only.is_none_or(|only| only == at).then_some(text)).collect();
            }
        }
        Verdict::Equality(equality) => {
            claim["difference"] = json!({
                "text": equality.difference.show(&file.chain, print::Style::Text),
                "latex": equality.difference.show(&file.printed, print::Style::Latex),
            });
        }
        Verdict::Total(total) => {
            let text = |value: &crate::checker::Fraction| value.show(&file.chain, print::Style::Text);
            claim["differences"] = total
                .differences
                .iter()
                .map(|(error, printed, derived)| {
                    json!({
                        "component": "total",
                        "error": print::text(&product(error), &file.chain),
                        "printed": text(printed),
                        "derived": text(derived),
                    })
                })
                .collect();
        }
        Verdict::Comparison(measured) => {
            claim["measured"] =
                json!({"error": measured.error, "against": measured.against, "ratio": measured.ratio});
        }
        Verdict::Count(counted) => {
            claim["counted"] = json!({"found": counted.found, "errors": counted.names});
        }
        Verdict::Rank(rank) => {
            claim["rank"] =
                json!({"found": rank.rank, "errors": rank.errors, "exceptions": names(&rank.exceptions)});
        }
        Verdict::Size(size) => {
            claim["size"] = json!({"found": size.found, "between": size.between, "poses": size.poses});
        }
        Verdict::Entries(entries) => {
            claim["differences"] = entries
                .differences
                .iter()
                .map(|difference| {
                    json!({
                        "entry": difference.label,
                        "printed": difference.printed.show(&file.chain, print::Style::Text),
                        "derived": difference.derived.show(&file.chain, print::Style::Text),
                        "latex": {
                            "printed": difference.printed.show(&file.printed, print::Style::Latex),
                            "derived": difference.derived.show(&file.printed, print::Style::Latex),
                        },
                    })
                })
                .collect();
        }
        Verdict::Values(values) => {
            claim["values"] = values
                .iter()
                .map(|value| {
                    json!({"of": value.label, "found": value.found, "claimed": value.claimed, "within": value.within, "holds": value.holds()})
                })
                .collect();
        }
        Verdict::Bound(bound) => {
            claim["bound"] = json!({"proven": bound.proven, "found": bound.found});
        }
    }
    claim
}

/// A claim without a verdict.
#[must_use]
pub fn unread_as_json(unread: &Unread) -> Value {
    let mistakes: Vec<Value> = unread
        .mistakes
        .iter()
        .map(|mistake| json!({"message": mistake.message, "help": mistake.help}))
        .collect();
    json!({"name": unread.name, "verdict": "unread", "mistakes": mistakes})
}

/// Coefficients in the plain syntax of amounts, for programs, and in LaTeX.
fn difference_as_json(file: &Claims, claim: &NamedClaim, difference: &Difference) -> Value {
    let (chain, printed) = (&file.chain, &file.printed);
    let Claim::ClosedForm(claimed) = &claim.claim else {
        unreachable!("only printed formulas have differences of components")
    };
    let shown = chain.observable(claimed.observable);
    let mut value = json!({
        "component": shown.label(difference.component.index()),
        "error": difference.error_name(chain),
        "printed": difference.printed.show(chain, print::Style::Text),
        "derived": difference.derived.show(chain, print::Style::Text),
        "latex": {
            "error": print::latex(&difference.error_product(), printed),
            "printed": difference.printed.show(printed, print::Style::Latex),
            "derived": difference.derived.show(printed, print::Style::Latex),
        },
    });
    if let Some(slip) = &difference.slip {
        value["slip"] = slip.describe(chain, claimed.observable, print::Style::Text).into();
    }
    if let Some((_, before, width)) = place_in_text(claim, difference) {
        // Characters of the component as printed.
        value["place"] = json!({"column": before + 1, "width": width});
    }
    value
}
