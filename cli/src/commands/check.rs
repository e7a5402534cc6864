//! `trueaxis check`: whether published claims about an instrument are what its declaration implies.

use std::path::PathBuf;

use claims::checker::entries::{Entries, EntriesOf};
use claims::checker::{Checker, Claim, Order, Rank, RankSaid, Verdict, extended, only_of};
use claims::file::{Checked, Unread};
use claims::show::{self, as_json, as_text, unread_as_json};
use model_core::escape::{self, Screen};
use model_core::identify::{Holds, identify};
use model_core::{Mistakes, SymbolId, SymbolKind};
use proof::{Certificate, Declared, Refusal};
use serde_json::{Value, json};
use service::claims_file::ClaimsFile;

use super::Answer;
use crate::certificates::CertificateArguments;
use crate::claims_file;
use crate::failure::Failure;
use crate::{paper, terminal};

/// Check published claims: is the printed formula what the chain implies?
///
/// A claims file names a declaration and claims about it: closed forms in LaTeX as printed, positions, frames, Jacobians, image
/// points, equalities of two formulas, total errors, comparisons of influences, sizes, bounds, counts, ranks. Formulas are
/// decided by exact algebra. What differs is shown term by term, with the place in the printed formula and the usual slip
/// behind it. A claim that cannot be read voids no other one.
///
/// Of a paper's source (.tex or .md) the equations are found and drawn up as a claims file, its guesses marked, and checked.
///
/// Exit code 1 if a claim does not hold, 2 if one cannot be read.
///
/// Example: trueaxis check examples/mobile-lidar/paper.toml
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The claims file, or a paper's source
    claims: PathBuf,
    /// The declaration that a paper is about; otherwise the one that it names, or the only one beside it
    #[arg(long, value_name = "FILE")]
    chain: Option<PathBuf>,
    /// Where the claims of a paper are written to; otherwise PAPER.claims.toml
    #[arg(long, value_name = "FILE")]
    claims_file: Option<PathBuf>,
    /// How to print the verdicts
    #[arg(long, value_enum, default_value_t = Shape::Text)]
    format: Shape,
    #[command(flatten)]
    certificate: CertificateArguments,
}

/// How verdicts are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Shape {
    /// For reading
    Text,
    /// A table in Markdown
    Markdown,
    /// A table in LaTeX
    Latex,
    /// A page with a table
    Html,
    /// For programs
    Json,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let is_certified = arguments.certificate.is_wanted()?;
    let kind = paper::kind_of(&arguments.claims);
    if kind.is_none() {
        let given = [("--chain", &arguments.chain), ("--claims-file", &arguments.claims_file)];
        if let Some((name, _)) = given.into_iter().find(|(_, path)| path.is_some()) {
            let why = format!(
                "`{name}` is for a paper's source, .tex or .md; a claims file names its chain itself"
            );
            return Err(Failure::Input(why));
        }
    }
    let (file, mut notes) = match kind {
        Some(kind) => {
            let (file, notes) = paper::read(
                &arguments.claims,
                kind,
                arguments.chain.as_deref(),
                arguments.claims_file.as_deref(),
            )?;
            (file, notes)
        }
        None => (claims_file::read_all(&arguments.claims)?, Vec::new()),
    };
    let (checked, undecided) = file.said.check();
    let mut mistakes = file.said.mistakes();
    mistakes.extend(undecided.iter().flat_map(|unread| unread.mistakes.clone()));
    let unread: Vec<&Unread> = file.said.unread.iter().chain(&undecided).collect();
    let table = |format| {
        let mut lines = show::lines(&file.said, &checked, &undecided);
        lines.extend(notes.iter().map(|(line, equation, reason)| show::Line {
            name: format!("line {line}"),
            equation: vec![show::Piece::Formula(equation.clone())],
            verdict: "unread",
            remarks: vec![vec![show::Piece::Words(reason.clone())]],
        }));
        show::as_table(&arguments.claims.display().to_string(), &lines, format)
    };
    let output: Screen = match arguments.format {
        Shape::Text if checked.is_empty() => Screen::default(),
        Shape::Text => as_text(&file.said, &checked, &claims_file::paint()),
        Shape::Markdown => table(show::Format::Markdown).into(),
        Shape::Latex => table(show::Format::Latex).into(),
        Shape::Html => table(show::Format::Html).into(),
        Shape::Json => {
            let verdicts = checked.iter().map(|checked| as_json(&file.said, checked));
            let claims: Vec<Value> =
                verdicts.chain(unread.iter().map(|unread| unread_as_json(unread))).collect();
            let equations: Vec<Value> = notes
                .iter()
                .map(|(line, equation, reason)| json!({"line": line, "equation": equation, "reason": reason}))
                .collect();
            let mut said = json!({ "claims": claims });
            if kind.is_some() {
                said["unread"] = equations.into();
            }
            escape::json(&format!("{said:#}\n")).into()
        }
    };
    let certificate = if is_certified { Some(certify(&file, &checked)?) } else { None };
    arguments.certificate.write(certificate.as_deref())?;
    match arguments.format {
        Shape::Text => terminal::print_formulas(output)?,
        _ => terminal::print(output)?,
    }
    if arguments.format == Shape::Text {
        for (line, equation, reason) in notes.drain(..) {
            let equation = equation.lines().collect::<Vec<_>>().join("\n    ");
            let reason = escape::line(&reason);
            terminal::print_formulas(format!("unread   line {line}: {reason}\n    {equation}\n"))?;
        }
    }
    if !mistakes.is_empty() {
        let failure = file.source.mistakes(&Mistakes::locate(&file.source.text, mistakes)).into();
        if checked.is_empty() || checked.iter().all(|checked| checked.verdict.holds()) {
            return Err(failure);
        }
        terminal::report_failure(&failure);
    }
    if checked.is_empty() {
        return Err(Failure::Input(format!(
            "`{}` makes no claim that was recognised; name its letters in lines such as `% trueaxis: \\epsilon_x = ex`",
            arguments.claims.display()
        )));
    }
    let all_hold = checked.iter().all(|checked| checked.verdict.holds());
    Ok(if all_hold { Answer::Done } else { Answer::No })
}

/// The verdicts as a certificate.
fn certify(file: &ClaimsFile, checked: &[Checked<'_>]) -> Result<String, Failure> {
    let declaration = &file.declaration;
    let declared =
        Declared::from_text(&declaration.text).map_err(|mistakes| declaration.mistakes(&mistakes))?;
    let varied: Vec<SymbolId> = checked
        .iter()
        .filter_map(|checked| match &checked.claim.claim {
            Claim::Entries(entries) => Some(&entries.of),
            _ => None,
        })
        .filter_map(|of| match of {
            EntriesOf::Jacobian { by, .. } => Some(by),
            _ => None,
        })
        .flatten()
        .copied()
        .collect();
    let declared = declared.with_changes(&varied);
    let mut certificate = Certificate::new(&declared);
    for Checked { claim, verdict } in checked {
        certificate.printed_as(&claim.texts);
        match (&claim.claim, verdict) {
            (Claim::ClosedForm(form), Verdict::ClosedForm(verdict)) => {
                let written = certificate.closed_form(&claim.name, form, verdict);
                note_refusal(&mut certificate, &claim.name, written);
            }
            (Claim::Equality(equality), Verdict::Equality(verdict)) => {
                let written = certificate.equality(&claim.name, equality, verdict);
                note_refusal(&mut certificate, &claim.name, written);
            }
            (Claim::Entries(entries), Verdict::Entries(_)) => {
                let written = of_entries(&mut certificate, &declared, &claim.name, entries, verdict.holds());
                if let Err(why) = written {
                    certificate.not_certified(&claim.name, &why);
                }
            }
            (Claim::Rank(rank), Verdict::Rank(verdict)) if verdict.holds => {
                let written = of_rank(&mut certificate, &declared, rank);
                if let Err(why) = written {
                    certificate.not_certified(&claim.name, &why);
                }
            }
            (_, Verdict::Comparison(_) | Verdict::Size(_)) => {
                certificate
                    .not_certified(&claim.name, "influences are measured in floating point, not proved");
            }
            (_, Verdict::Bound(_)) => {
                certificate.not_certified(&claim.name, "the bound is proved by interval arithmetic in rounded numbers, which Coq's library does not have");
            }
            (_, Verdict::Values(_)) => {
                certificate.not_certified(&claim.name, "numbers are computed in floating point; Coq's library has no sines of decimal angles. Claim the formula");
            }
            (_, Verdict::Rank(_) | Verdict::Total(_) | Verdict::Entries(_)) => {
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

/// What is shown without errors, or a Jacobian.
fn of_entries(
    certificate: &mut Certificate<'_>,
    declared: &Declared,
    name: &str,
    entries: &Entries,
    holds: bool,
) -> Result<(), String> {
    match (&entries.of, entries.order) {
        (EntriesOf::Shown(observable), Order::UpTo(0)) => certificate
            .shown(name, *observable, &entries.printed, holds)
            .map_err(|refusal| refusal.to_string()),
        (EntriesOf::Shown(_), _) => {
            Err("certificates speak of what is shown without errors; claim what the errors add by `components`".to_owned())
        }
        (EntriesOf::Frame { .. }, _) => Err(
            "certificates speak of vectors, not of matrices; claim each column by `shows`, as a direction of the body".to_owned(),
        ),
        _ => jacobian(certificate, declared, name, entries),
    }
}

/// A Jacobian, column by column.
fn jacobian(
    certificate: &mut Certificate<'_>,
    declared: &Declared,
    name: &str,
    entries: &Entries,
) -> Result<(), String> {
    let chain = extended(declared.chain());
    let is_error = |id: SymbolId| chain.symbol(id).kind == SymbolKind::Error;
    let standing = |id: SymbolId| if is_error(id) { Some(id) } else { declared.change_of(id) };
    let columns = entries
        .columns(&chain, standing)
        .ok_or("certificates speak of Jacobians of points and directions, by errors and joints")?;
    let mut checker = Checker::new(&chain);
    for column in columns {
        let verdict = checker.closed_form(&column.form).map_err(|error| error.to_string())?;
        let title = format!(
            "{name}, {} by {}",
            chain.observable(column.observable).name,
            chain.symbol(column.by).name
        );
        certificate.closed_form(&title, &column.form, &verdict).map_err(|refusal| refusal.to_string())?;
    }
    Ok(())
}

/// A rank, from above by errors without influence and combinations of others, and from below by independent errors.
fn of_rank(certificate: &mut Certificate<'_>, declared: &Declared, rank: &Rank) -> Result<(), String> {
    let errors = &rank.errors;
    if let RankSaid::Separable(others) = &rank.said {
        return certificate
            .independent(&rank.observables, others, errors)
            .map_err(|refusal| refusal.to_string());
    }
    let chain = only_of(declared.chain(), errors).map_err(|error| error.to_string())?;
    let found = identify(&chain, &rank.observables).map_err(|error| error.to_string())?;
    if found.holds != Holds::Everywhere {
        return Err("the answer is at the declared values of the constants".to_owned());
    }
    certificate.identifiability(&found, |error| errors.contains(&error));
    Ok(())
}

/// A claim that cannot be certified is named in the certificate, and on the terminal, with the reason.
fn note_refusal(certificate: &mut Certificate<'_>, name: &str, written: Result<(), Refusal>) {
    if let Err(refusal) = written {
        certificate.not_certified(name, &refusal.to_string());
    }
}
