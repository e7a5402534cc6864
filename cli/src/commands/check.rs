//! `trueaxis check`: whether published claims about an instrument are what its declaration implies.

use std::path::PathBuf;

use claims::checker::{Checker, Claim, Verdict};
use model_core::Mistake;
use proof::{Certificate, Declared, Refusal};
use serde_json::{Value, json};

use super::{Answer, TextOrJson};
use crate::certificates::CertificateArguments;
use crate::claims_file::{self, ClaimsFile};
use crate::failure::Failure;
use crate::terminal;
use claims::file::{Checked, NamedClaim};
use claims::show::{as_json, as_text};

/// Check published claims: is the printed formula what the chain implies?
///
/// A claims file names a declaration and claims about it: closed forms in LaTeX as printed, equalities of two formulas, total
/// errors, comparisons of influences, sizes, bounds, counts, ranks. Formulas are decided by exact algebra. What differs is shown term by term, with the
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
    let file = ClaimsFile::read_all(&arguments.claims)?;
    let (checked, undecided) = file.said.check();
    let output = match arguments.format {
        TextOrJson::Text => as_text(&file.said, &checked, &claims_file::paint()),
        TextOrJson::Json => {
            let claims: Vec<Value> = checked.iter().map(|checked| as_json(&file.said, checked)).collect();
            format!("{:#}\n", json!({ "claims": claims }))
        }
    };
    let certificate = is_certified.then(|| certify(&file, &checked)).transpose()?;
    arguments.certificate.write(certificate.as_deref())?;
    match arguments.format {
        TextOrJson::Text => terminal::print_formulas(&output)?,
        TextOrJson::Json => terminal::print(&output)?,
    }
    let all_hold = checked.iter().all(|checked| checked.verdict.holds());
    Ok(if all_hold { Answer::Done } else { Answer::No })
}

/// Every claim of a file with its verdict.
///
/// # Errors
/// A claim that has no verdict, with its place.
pub fn checked(file: &ClaimsFile) -> Result<Vec<Checked<'_>>, Failure> {
    let mut checker = Checker::new(&file.said.chain);
    let mut checked = Vec::with_capacity(file.said.claims.len());
    for claim in &file.said.claims {
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
            (Claim::ClosedForm(form), Verdict::ClosedForm(verdict)) => {
                let written = certificate.closed_form(&claim.name, form, verdict);
                note_refusal(&mut certificate, &claim.name, written);
            }
            (Claim::Equality(equality), Verdict::Equality(verdict)) => {
                let written = certificate.equality(&claim.name, equality, verdict);
                note_refusal(&mut certificate, &claim.name, written);
            }
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
        let why = "none of the claims of this file can be certified; nothing is written";
        return Err(Failure::Input(why.to_owned()));
    }
    Ok(certificate.finish(&file.source.path.display().to_string()))
}

/// A claim that cannot be certified is named in the certificate, and on the terminal, with the reason.
fn note_refusal(certificate: &mut Certificate<'_>, name: &str, written: Result<(), Refusal>) {
    if let Err(refusal) = written {
        certificate.not_certified(name, &refusal.to_string());
    }
}
