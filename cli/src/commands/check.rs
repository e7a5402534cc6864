//! `trueaxis check`: whether published claims about an instrument are what its declaration implies.

use std::path::PathBuf;

use model_core::Mistake;
use model_core::certificate::{Certificate, Declared};
use model_core::checker::{Checker, Claim, Verdict};
use serde_json::{Value, json};

use super::{Answer, TextOrJson};
use crate::certificates::CertificateArguments;
use crate::claims::{Checked, ClaimsFile, NamedClaim, as_json, as_text};
use crate::failure::Failure;
use crate::terminal;

/// Check published claims: is the printed formula what the chain implies?
///
/// A claims file names a declaration and claims about it: closed forms in LaTeX as printed, total errors, comparisons
/// of influences, sizes, bounds, counts, ranks. Formulas are decided by exact algebra. What differs is shown term by term, with the
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

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let is_certified = arguments.certificate.is_wanted()?;
    let file = ClaimsFile::read(&arguments.claims)?;
    let checked = checked(&file)?;
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

/// Every claim of a file with its verdict.
///
/// # Errors
/// A claim that has no verdict, with its place.
pub fn checked(file: &ClaimsFile) -> Result<Vec<Checked<'_>>, Failure> {
    let mut checker = Checker::new(&file.chain);
    let mut checked = Vec::with_capacity(file.claims.len());
    for claim in &file.claims {
        let NamedClaim { claim: asked, place, .. } = claim;
        let verdict = checker
            .check(asked)
            .map_err(|error| file.source.mistake(Mistake::new(place.clone(), error.to_string())))?;
        checked.push(Checked { claim, verdict });
    }
    Ok(checked)
}

/// The verdicts as a certificate.
fn certify(file: &ClaimsFile, checked: &[Checked<'_>]) -> Result<String, Failure> {
    let declaration = &file.declaration;
    let declared =
        Declared::from_text(&declaration.text).map_err(|mistakes| declaration.mistakes(&mistakes))?;
    let mut certificate = Certificate::new(&declared);
    for Checked { claim, verdict } in checked {
        match (&claim.claim, verdict) {
            (Claim::ClosedForm(form), Verdict::ClosedForm(verdict)) if form.is_plain() => {
                certificate.closed_form(&claim.name, form, verdict).map_err(|refusal| {
                    let message = format!("no certificate of this claim: {refusal}; nothing is written");
                    file.source.mistake(Mistake::new(claim.place.clone(), message))
                })?;
            }
            (Claim::ClosedForm(_), _) => certificate.not_certified(
                &claim.name,
                "certificates speak of whole vectors to an order, of one face, without quotients by sums, half angles and roots",
            ),
            (_, Verdict::Comparison(_) | Verdict::Size(_)) => {
                certificate
                    .not_certified(&claim.name, "influences are measured in floating point, not proved");
            }
            (_, Verdict::Bound(_)) => {
                certificate.not_certified(&claim.name, "the bound is proved in rounded numbers, not in Coq");
            }
            (_, Verdict::Rank(_) | Verdict::Total(_)) => {
                certificate.not_certified(&claim.name, "certificates speak of closed forms");
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
