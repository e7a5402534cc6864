//! `trueaxis identify`: what no data can tell apart, before any data exist.

use std::path::PathBuf;

use model_core::identify::{Holds, Identifiability};
use model_core::{Chain, ObservableId};
use proof::{Certificate, Declared};
use serde_json::json;
use service::Source;
use service::formulas::{Identified, identified};

use super::{Answer, TextOrJson};
use crate::certificates::CertificateArguments;
use crate::failure::Failure;
use crate::set_up::SetUpSeen;
use crate::source;
use crate::table_files::open_beside;
use crate::terminal;

/// Say what no data can tell apart.
///
/// Where formulas for all values of the constants are too large, the answer is that at their declared values.
///
/// Follows from the declaration alone, exactly: which errors are one, which have no influence, and which combinations
/// data can determine, for each observable by itself and for all together; with --observable, for those together.
///
/// Of a study, what its rows, from their stations to their objects, can see of the errors, and what would show more.
///
/// Example: trueaxis identify examples/mobile-lidar/mobile-lidar.chain --observable pointing
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration, an instrument file, or a study (.toml)
    chain: PathBuf,
    /// This observable (may be given several times: seen together); default: each alone, then all together
    #[arg(long)]
    observable: Vec<String>,
    /// For an effect that the declaration lacks, which declared errors it would be mistaken for: "middle
    /// Rx(x*cos(beta))"
    #[arg(long, value_name = "BODY FACTOR")]
    candidate: Option<String>,
    /// How to print
    #[arg(long, value_enum, default_value_t = TextOrJson::Text)]
    format: TextOrJson,
    #[command(flatten)]
    certificate: CertificateArguments,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let is_certified = arguments.certificate.is_wanted()?;
    let source = source::read(&arguments.chain)?;
    if !source.is_instrument() && arguments.chain.extension().is_some_and(|ending| ending == "toml") {
        if is_certified || !arguments.observable.is_empty() || arguments.candidate.is_some() {
            let why = "of a study, only --format can be asked for: name the declaration for --observable, --candidate and \
                       certificates";
            return Err(Failure::Input(why.to_owned()));
        }
        let seen = SetUpSeen::of_study(&source, &mut |path, from| open_beside(&source, path, from))?;
        match arguments.format {
            TextOrJson::Text => terminal::print(seen.text())?,
            TextOrJson::Json => terminal::print_json(&seen.json())?,
        }
        return Ok(Answer::Done);
    }
    let (source, chain) = if source.is_instrument() {
        let source::Declared { source, chain, .. } = source::Declared::read(&arguments.chain)?;
        (source, chain)
    } else {
        let chain = source.symbolic_chain(&terminal::warn)?;
        (source, chain)
    };
    let Identified { texts, answers, found: certified } =
        identified(&chain, &arguments.observable, arguments.candidate.as_deref(), &terminal::warn)?;
    let certificate = is_certified.then(|| certify(&source, &certified)).transpose()?;
    arguments.certificate.write(certificate.as_deref())?;
    match arguments.format {
        TextOrJson::Text => terminal::print_text(texts.join("\n"))?,
        TextOrJson::Json => terminal::print_json(&json!({ "identifiability": answers }))?,
    }
    Ok(Answer::Done)
}

/// What has no influence, what is one and the same, and what is independent, as a certificate.
fn certify(source: &Source, certified: &[Identifiability]) -> Result<String, Failure> {
    let declared = Declared::from_text(&source.text).map_err(|mistakes| source.mistakes(&mistakes))?;
    let mut certificate = Certificate::new(&declared);
    for found in certified {
        if found.holds != Holds::Everywhere {
            let why = "the answer is at the declared values of the constants";
            certificate.not_certified(&named(declared.chain(), &found.observables), why);
            continue;
        }
        certificate.identifiability(found, |_| true);
    }
    for note in certificate.notes() {
        terminal::note(format_args!("not certified: {note}"));
    }
    if certificate.is_empty() {
        let message = "nothing of this can be certified. Nothing is written";
        return Err(Failure::Input(message.to_owned()));
    }
    Ok(certificate.finish(&source.path.display().to_string()))
}

/// `pointing and position`
fn named(chain: &Chain, observables: &[ObservableId]) -> String {
    observables.iter().map(|&id| chain.observable(id).name.as_str()).collect::<Vec<_>>().join(" and ")
}
