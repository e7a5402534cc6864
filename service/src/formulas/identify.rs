//! What no data can tell apart, before any data exist, in words and for programs.

use model_core::forms::{self, FormError};
use model_core::identify::{self, Candidate, Holds, Identifiability, Mistaken, Ratio, Verdict};
use model_core::names::listed;
use model_core::{BodyId, Chain, Mistakes, ObservableId, Role, names, print};
use serde_json::{Value, json};

use crate::refusal::Refusal;
use crate::source::{Source, observables};
use crate::warn::Warn;

/// The answers for each set of observables.
#[derive(Default)]
pub struct Identified {
    /// For reading.
    pub texts: Vec<String>,
    /// For programs.
    pub answers: Vec<Value>,
    /// As they were found, for certificates.
    pub found: Vec<Identifiability>,
}

/// What no data of the named observables can tell apart: of those together; if none is named, of each alone and of all. Warns of
/// observables that have no closed form.
///
/// # Errors
/// A name that the chain does not declare, a candidate that cannot be read, or a chain that is too large.
pub fn identified(
    chain: &Chain,
    names: &[String],
    candidate_text: Option<&str>,
    warn: Warn<'_>,
) -> Result<Identified, Refusal> {
    let mut chosen = observables(chain, names)?;
    if names.is_empty() && chosen.len() > 1 {
        // Nobody asked for these in particular; the others still have an answer.
        chosen.retain(|&observable| match forms::derive(chain, observable, 1) {
            Err(error @ FormError::NotSmooth { .. }) => {
                let name = &chain.observable(observable).name;
                warn(format!("{name} is left out: {error}"));
                false
            }
            _ => true,
        });
    }
    if chosen.is_empty() {
        return Err(Refusal::Input("no observable of this chain has a closed form".to_owned()));
    }
    let sets = if names.is_empty() && chosen.len() > 1 {
        chosen.iter().map(|&id| vec![id]).chain([chosen.clone()]).collect()
    } else {
        vec![chosen]
    };
    let candidate = candidate_text.map(|text| candidate(chain, text)).transpose()?;
    let mut all = Identified::default();
    for set in &sets {
        let failure = |error: identify::IdentifyError| Refusal::Input(error.to_string());
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

/// Reads `middle Rx(x*cos(beta))`.
fn candidate(chain: &Chain, text: &str) -> Result<Candidate, Refusal> {
    let wrong = |why: String| Refusal::Input(format!("--candidate: {why}"));
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
        .map_err(|mistakes: Mistakes| Source::of_text("--candidate", factor).mistakes(&mistakes))
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
