//! `trueaxis check`: whether published claims about an instrument are what its declaration implies.

use std::fmt::Write as _;
use std::path::PathBuf;

use model_core::certificate::{Certificate, Declared};
use model_core::checker::{Checker, Claim, Counted, Difference, FormVerdict, Measured, Verdict};
use model_core::{Chain, Mistake, budget, print};
use serde_json::{Value, json};

use super::{Answer, TextOrJson};
use crate::certificates::CertificateArguments;
use crate::claims::{ClaimsFile, NamedClaim};
use crate::failure::Failure;
use crate::terminal::{self, BAD, GOOD, HEADING};

/// Check published claims: is the printed formula what the chain implies?
///
/// A claims file names a declaration and claims about it: closed forms in LaTeX as printed, comparisons of
/// influences, counts. Formulas are decided by exact algebra. What differs is shown term by term, with the
/// place in the printed formula and the usual slip behind it. Exit code 1 if a claim does not hold.
///
/// Example: trueaxis check examples/mobile-lidar/paper.toml
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The claims file
    claims: PathBuf,
    /// How to print the verdicts
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
    #[command(flatten)]
    certificate: CertificateArguments,
}

/// A claim and what is said of it.
struct Checked<'a> {
    claim: &'a NamedClaim,
    verdict: Verdict,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let is_certified = arguments.certificate.is_wanted()?;
    let file = ClaimsFile::read(&arguments.claims)?;
    let mut checker = Checker::new(&file.chain);
    let mut checked = Vec::with_capacity(file.claims.len());
    for claim in &file.claims {
        let verdict = checker
            .check(&claim.claim)
            .map_err(|error| file.source.mistake(Mistake::new(claim.place.clone(), error.to_string())))?;
        checked.push(Checked { claim, verdict });
    }
    let output = match arguments.format {
        TextOrJson::Text => as_text(&file, &checked),
        TextOrJson::Json => {
            let claims: Vec<Value> = checked.iter().map(|checked| as_json(&file, checked)).collect();
            format!("{:#}\n", json!({ "claims": claims }))
        }
    };
    let certificate = is_certified.then(|| certify(&file, &checked)).transpose()?;
    arguments.certificate.write(certificate.as_deref())?;
    terminal::print(&output)?;
    let all_hold = checked.iter().all(|checked| checked.verdict.holds());
    Ok(if all_hold { Answer::Done } else { Answer::No })
}

/// The verdicts as a certificate.
fn certify(file: &ClaimsFile, checked: &[Checked<'_>]) -> Result<String, Failure> {
    let declaration = &file.declaration;
    let declared =
        Declared::from_text(&declaration.text).map_err(|mistakes| declaration.mistakes(&mistakes))?;
    let mut certificate = Certificate::new(&declared);
    for Checked { claim, verdict } in checked {
        match (&claim.claim, verdict) {
            (Claim::ClosedForm(form), Verdict::ClosedForm(verdict)) => {
                certificate.closed_form(&claim.name, form, verdict).map_err(|refusal| {
                    let message = format!("no certificate of this claim: {refusal}; nothing is written");
                    file.source.mistake(Mistake::new(claim.place.clone(), message))
                })?;
            }
            (_, Verdict::Comparison(_)) => {
                certificate
                    .not_certified(&claim.name, "influences are measured in floating point, not proved");
            }
            _ => certificate
                .not_certified(&claim.name, "a count is of names in the declaration, and no formula"),
        }
    }
    for note in certificate.notes() {
        terminal::note(format_args!("not certified: {note}"));
    }
    if certificate.is_empty() {
        let why = "no claim of this file is a formula; there is nothing to certify, and nothing is written";
        return Err(Failure::Input(why.to_owned()));
    }
    Ok(certificate.finish(&file.source.path.display().to_string()))
}

fn as_text(file: &ClaimsFile, checked: &[Checked<'_>]) -> String {
    let mut out = String::new();
    for Checked { claim, verdict } in checked {
        let word =
            if verdict.holds() { format!("{GOOD}holds{GOOD:#}  ") } else { format!("{BAD}differs{BAD:#}") };
        let _ = writeln!(out, "{word}  {HEADING}{}{HEADING:#}", claim.name);
        match verdict {
            Verdict::ClosedForm(form) => {
                let style = if claim.is_plain { print::Style::Text } else { print::Style::Latex };
                write_form(&mut out, &file.printed, claim, form, style);
            }
            Verdict::Comparison(measured) => write_measured(&mut out, &file.chain, &claim.claim, measured),
            Verdict::Count(counted) => write_counted(&mut out, counted),
        }
    }
    let held = checked.iter().filter(|checked| checked.verdict.holds()).count();
    let _ = writeln!(out, "\n{held} of {} claims hold", checked.len());
    out
}

/// The differences of a formula, in the symbols of the print.
fn write_form(out: &mut String, chain: &Chain, claim: &NamedClaim, form: &FormVerdict, style: print::Style) {
    if form.differences.is_empty() {
        return;
    }
    for difference in &form.differences {
        let show = |poly| print::poly(poly, chain, style);
        let _ = writeln!(
            out,
            "    {}, {}: printed {}, derived {}",
            difference.component,
            show(&difference.error_product()),
            show(&difference.printed),
            show(&difference.derived),
        );
        if let Some((text, before, width)) = place_in_text(claim, difference) {
            let carets = "^".repeat(width);
            let _ = writeln!(out, "        {text}\n        {}{BAD}{carets}{BAD:#}", " ".repeat(before));
        }
        if let Some(slip) = &difference.slip {
            let _ = writeln!(out, "        {}", slip.describe(chain, style));
        }
    }
    for slip in &form.slips {
        let _ = writeln!(out, "    {}", slip.describe(chain));
    }
    let _ = writeln!(out, "    what the chain implies:");
    for (axis, component) in ["x", "y", "z"].iter().zip(&form.derived) {
        let _ = writeln!(out, "        {axis}: {}", print::poly(component, chain, style));
    }
}

/// The line of the printed text that a difference stands on, and where on it: characters before, and width.
fn place_in_text<'a>(claim: &'a NamedClaim, difference: &Difference) -> Option<(&'a str, usize, usize)> {
    let Claim::ClosedForm(form) = &claim.claim else { return None };
    let component = &form.printed.components[difference.component.index()];
    let text = claim.texts.get(component.text_index)?;
    let place = difference.place.clone()?;
    let start = text.get(..place.start)?.rfind('\n').map_or(0, |newline| newline + 1);
    let line = text[start..].lines().next()?;
    let before = text.get(start..place.start)?.chars().count();
    let inside = text.get(place)?.lines().next()?;
    Some((line, before, inside.chars().count().max(1)))
}

fn write_measured(out: &mut String, chain: &Chain, claim: &Claim, measured: &Measured) {
    let Claim::Comparison(comparison) = claim else { return };
    let unit = budget::unit(chain, comparison.observable);
    let name = |id| &chain.symbol(id).name;
    let ratio = measured.ratio.map_or("no ratio".to_owned(), |ratio| format!("ratio {}", short(ratio)));
    let _ = writeln!(
        out,
        "    {} {} {unit}, {} {} {unit}: {ratio}, claimed at most {}",
        name(comparison.error),
        short(measured.error),
        name(comparison.against),
        short(measured.against),
        measured.at_most
    );
}

fn write_counted(out: &mut String, counted: &Counted) {
    if counted.found != counted.claimed {
        let _ = writeln!(
            out,
            "    {} are declared, {} are claimed: {}",
            counted.found,
            counted.claimed,
            counted.names.join(", ")
        );
    }
}

/// Four digits are enough for a reader.
fn short(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        0.01..1e4 => format!("{number:.4}"),
        _ => format!("{number:.3e}"),
    }
}

fn as_json(file: &ClaimsFile, checked: &Checked<'_>) -> Value {
    let verdict = if checked.verdict.holds() { "holds" } else { "differs" };
    let mut claim = json!({"name": checked.claim.name, "verdict": verdict, "differences": []});
    match &checked.verdict {
        Verdict::ClosedForm(form) => {
            claim["differences"] = form
                .differences
                .iter()
                .map(|difference| difference_as_json(file, checked.claim, difference))
                .collect();
            if !form.differences.is_empty() {
                claim["diagnosis"] =
                    form.slips.iter().map(|slip| Value::from(slip.describe(&file.chain))).collect();
                claim["corrected"] = form.corrected(&file.printed).to_vec().into();
            }
        }
        Verdict::Comparison(measured) => {
            claim["measured"] =
                json!({"error": measured.error, "against": measured.against, "ratio": measured.ratio});
        }
        Verdict::Count(counted) => {
            claim["counted"] = json!({"found": counted.found, "errors": counted.names});
        }
    }
    claim
}

/// Coefficients in the plain syntax of amounts, for programs, and in LaTeX.
fn difference_as_json(file: &ClaimsFile, claim: &NamedClaim, difference: &Difference) -> Value {
    let (chain, printed) = (&file.chain, &file.printed);
    let mut value = json!({
        "component": difference.component.to_string(),
        "error": difference.error_name(chain),
        "printed": print::text(&difference.printed, chain),
        "derived": print::text(&difference.derived, chain),
        "latex": {
            "error": print::latex(&difference.error_product(), printed),
            "printed": print::latex(&difference.printed, printed),
            "derived": print::latex(&difference.derived, printed),
        },
    });
    if let Some(slip) = &difference.slip {
        value["slip"] = slip.describe(chain, print::Style::Text).into();
    }
    if let Some((_, before, width)) = place_in_text(claim, difference) {
        // Characters of the component as printed.
        value["place"] = json!({"column": before + 1, "width": width});
    }
    value
}
