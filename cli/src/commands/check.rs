//! `trueaxis check`: whether published claims about an instrument are what its declaration implies.

use std::path::PathBuf;

use claims::file::{Checked, Unread};
use claims::show::{self, as_json, as_text, unread_as_json};
use model_core::Mistakes;
use model_core::escape::{self, Screen};
use proof::{Certificate, Declared};
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
    // Where no claim was read, what is wrong with them is the answer.
    let certificate =
        if is_certified && !checked.is_empty() { Some(certify(&file, &checked)?) } else { None };
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

/// The verdicts as a certificate; a claim that cannot be certified is named in it, and on the terminal, with the reason.
fn certify(file: &ClaimsFile, checked: &[Checked<'_>]) -> Result<String, Failure> {
    let declaration = &file.declaration;
    let declared =
        Declared::from_text(&declaration.text).map_err(|mistakes| declaration.mistakes(&mistakes))?;
    let declared = declared.with_changes_of(checked.iter().map(|checked| &checked.claim.claim));
    let mut certificate = Certificate::new(&declared);
    for Checked { claim, verdict } in checked {
        certificate.printed_as(&claim.texts);
        if let Err(refusal) = certificate.claim(&claim.name, &claim.claim, verdict) {
            certificate.not_certified(&claim.name, &refusal.to_string());
        }
    }
    for note in certificate.notes() {
        terminal::note(format_args!("not certified: {note}"));
    }
    if certificate.is_empty() {
        let why = "none of the claims of this file can be certified. Nothing is written";
        return Err(Failure::Input(why.to_owned()));
    }
    Ok(certificate.finish(&file.source.path.display().to_string()))
}
