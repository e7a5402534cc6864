//! `trueaxis identify`: what no data can tell apart, before any data exist.

use std::path::PathBuf;

use model_core::forms::{self, FormError};
use model_core::identify::{self, Candidate, Holds, Identifiability, Mistaken, Ratio, Verdict};
use model_core::{BodyId, Chain, Mistakes, ObservableId, Role, names, print};
use proof::{Certificate, Declared, Refusal};
use serde_json::{Value, json};
use service::Source;
use service::source::observables;

use super::{Answer, TextOrJson};
use crate::certificates::CertificateArguments;
use crate::failure::Failure;
use crate::set_up::SetUpSeen;
use crate::source;
use crate::table_files::open_beside;
use crate::terminal;
use model_core::names::listed;

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
        identified(&chain, &arguments.observable, arguments.candidate.as_deref())?;
    let certificate = is_certified.then(|| certify(&source, &certified)).transpose()?;
    arguments.certificate.write(certificate.as_deref())?;
    match arguments.format {
        TextOrJson::Text => terminal::print_text(texts.join("\n"))?,
        TextOrJson::Json => terminal::print_json(&json!({ "identifiability": answers }))?,
    }
    Ok(Answer::Done)
}

/// The answers for each set of observables.
#[derive(Default)]
pub struct Identified {
    /// For reading.
    pub texts: Vec<String>,
    /// For programs.
    pub answers: Vec<Value>,
    found: Vec<Identifiability>,
}

/// What no data of the named observables can tell apart: of those together; if none is named, of each alone and of all.
///
/// # Errors
/// A name that the chain does not declare, a candidate that cannot be read, or a chain that is too large.
pub fn identified(
    chain: &Chain,
    names: &[String],
    candidate_text: Option<&str>,
) -> Result<Identified, Failure> {
    let mut chosen = observables(chain, names)?;
    if names.is_empty() && chosen.len() > 1 {
        // Nobody asked for these in particular; the others still have an answer.
        chosen.retain(|&observable| match forms::derive(chain, observable, 1) {
            Err(error @ FormError::NotSmooth { .. }) => {
                let name = &chain.observable(observable).name;
                terminal::warn(format_args!("{name} is left out: {error}"));
                false
            }
            _ => true,
        });
    }
    if chosen.is_empty() {
        return Err(Failure::Input("no observable of this chain has a closed form".to_owned()));
    }
    let sets = if names.is_empty() && chosen.len() > 1 {
        chosen.iter().map(|&id| vec![id]).chain([chosen.clone()]).collect()
    } else {
        vec![chosen]
    };
    let candidate = candidate_text.map(|text| candidate(chain, text)).transpose()?;
    let mut all = Identified::default();
    for set in &sets {
        let failure = |error: identify::IdentifyError| Failure::Input(error.to_string());
        let found = identify::identify(chain, set).map_err(failure)?;
        let mut text = identify::text(&found, chain);
        let mut answer = as_json(chain, set, &found);
        if let Some(candidate) = &candidate {
            let mistaken = identify::mistaken_for(candidate, set).map_err(failure)?;
            text.push_str("  the candidate:\n");
            text.extend(identify::mistaken_text(&mistaken).lines().map(|line| format!("    {line}\n")));
            answer["candidate"] = mistaken_json(&mistaken);
        }
        all.texts.push(text);
        all.answers.push(answer);
        all.found.push(found);
    }
    Ok(all)
}

/// What has no influence, and what is one and the same, as a certificate.
fn certify(source: &Source, certified: &[Identifiability]) -> Result<String, Failure> {
    let declared = Declared::from_text(&source.text).map_err(|mistakes| source.mistakes(&mistakes))?;
    let mut certificate = Certificate::new(&declared);
    let refused = |refusal: Refusal| Failure::Input(format!("no certificate: {refusal}; nothing is written"));
    for found in certified {
        if found.holds != Holds::Everywhere {
            let why = "the answer is at the declared values of the constants";
            certificate.not_certified(&named(declared.chain(), &found.observables), why);
            continue;
        }
        for &observable in &found.observables {
            for &error in &found.invisible {
                certificate.without_influence(observable, error).map_err(refused)?;
            }
            for group in &found.alike {
                let Some((first, others)) = group.split_first() else { continue };
                for other in others {
                    certificate.alike(observable, first.error, other.error, &other.ratio).map_err(refused)?;
                }
            }
        }
    }
    if certificate.is_empty() {
        let why =
            "every error has an influence of its own; there is nothing to certify, and nothing is written";
        return Err(Failure::Input(why.to_owned()));
    }
    certificate
        .not_certified("which combinations can be estimated", "that needs more than a formula for each");
    for note in certificate.notes() {
        terminal::note(format_args!("not certified: {note}"));
    }
    Ok(certificate.finish(&source.path.display().to_string()))
}

/// `pointing and position`
fn named(chain: &Chain, observables: &[ObservableId]) -> String {
    observables.iter().map(|&id| chain.observable(id).name.as_str()).collect::<Vec<_>>().join(" and ")
}

/// Reads `middle Rx(x*cos(beta))`.
fn candidate(chain: &Chain, text: &str) -> Result<Candidate, Failure> {
    let wrong = |why: String| Failure::Input(format!("--candidate: {why}"));
    let (body, factor) = text.trim().split_once(char::is_whitespace).ok_or_else(|| {
        wrong("write a body and a factor, for example \"middle Rx(x*cos(beta))\"".to_owned())
    })?;
    let bodies = || chain.bodies.iter().map(|body| body.name.as_str());
    let index = bodies().position(|name| name == body).ok_or_else(|| {
        let instead = names::nearest(body, bodies())
            .map_or_else(|| format!("it has {}", listed(bodies())), |near| format!("did you mean `{near}`?"));
        wrong(format!("chain {} has no body `{body}`; {instead}", chain.name))
    })?;
    let body = u16::try_from(index).map(BodyId).map_err(|error| wrong(error.to_string()))?;
    let factor = factor.trim();
    Candidate::parse(chain, body, Role::MotionError, factor)
        .map_err(|mistakes: Mistakes| Source::of_text("--candidate", factor).mistakes(&mistakes).into())
}

fn as_json(chain: &Chain, set: &[ObservableId], found: &Identifiability) -> Value {
    let name = |id: &_| Value::from(chain.symbol(*id).name.as_str());
    let alike: Vec<Value> = found
        .alike
        .iter()
        .map(|group| {
            let members: Vec<Value> = group
                .iter()
                .map(|member| json!({"error": name(&member.error), "ratio": ratio(chain, &member.ratio)}))
                .collect();
            Value::from(members)
        })
        .collect();
    let combinations: Vec<Value> = found
        .combinations
        .iter()
        .map(|dependence| {
            let others: Vec<Value> = dependence
                .others
                .iter()
                .map(|(error, factor)| json!({"error": name(error), "ratio": ratio(chain, factor)}))
                .collect();
            json!({"error": name(&dependence.error), "acts_as": others})
        })
        .collect();
    let estimable: Vec<Value> = found
        .estimable
        .iter()
        .map(|combination| {
            let terms: Vec<Value> = combination
                .iter()
                .map(|(error, factor)| json!({"error": name(error), "factor": print::text(factor, chain)}))
                .collect();
            Value::from(terms)
        })
        .collect();
    json!({
        "observables": set.iter().map(|&id| chain.observable(id).name.as_str()).collect::<Vec<_>>(),
        "constants": match found.holds {
            Holds::Everywhere => json!({"values": "any"}),
            Holds::AtDeclaredValues { poses } => json!({"values": "declared", "poses": poses}),
        },
        "declared": found.declared,
        "invisible": found.invisible.iter().map(name).collect::<Vec<_>>(),
        "alike": alike,
        "combinations": combinations,
        "estimable": estimable,
    })
}

fn mistaken_json(mistaken: &Mistaken) -> Value {
    let chain = &mistaken.chain;
    let name = |id: &_| chain.symbol(*id).name.as_str();
    let unknowns: Vec<Value> = mistaken
        .unknowns
        .iter()
        .map(|(unknown, verdict)| match verdict {
            Verdict::Invisible => json!({"unknown": name(unknown), "verdict": "invisible"}),
            Verdict::Separable => json!({"unknown": name(unknown), "verdict": "separable"}),
            Verdict::MistakenFor(groups) => {
                let groups: Vec<Value> = groups
                    .iter()
                    .map(|group| {
                        let errors: Vec<&str> = group.errors.iter().map(name).collect();
                        json!({"errors": errors, "ratio": ratio(chain, &group.ratio)})
                    })
                    .collect();
                json!({"unknown": name(unknown), "verdict": "mistaken", "for": groups})
            }
        })
        .collect();
    Value::from(unknowns)
}

/// A ratio as text: `1`, `arm`, `(a + b)/c`.
fn ratio(chain: &Chain, ratio: &Ratio) -> String {
    let above = print::text(&ratio.numerator, chain);
    if ratio.denominator == model_core::algebra::Poly::one() {
        return above;
    }
    format!("({above})/({})", print::text(&ratio.denominator, chain))
}
