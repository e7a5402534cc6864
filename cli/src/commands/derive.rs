//! `trueaxis derive`: the closed form of each observable's error, as a paper would print it.

use std::path::PathBuf;

use model_core::certificate::{Certificate, Declared};
use model_core::forms::{self, Form};
use model_core::{Chain, ObservableId, ObservableKind, print};
use serde_json::json;

use super::Answer;
use crate::certificates::CertificateArguments;
use crate::failure::Failure;
use crate::source::{Source, observables};
use crate::terminal::{self, HEADING};

/// Derive the closed form of the error of each observable.
///
/// The error is the transform with errors minus the one without, times the observable, kept up to the given
/// order in the errors. Nothing is typed in: every coefficient follows from the declaration.
///
/// Example: trueaxis derive examples/mobile-lidar/mobile-lidar.chain --observable pointing --format latex
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration
    chain: PathBuf,
    /// Only this observable (may be given several times); default: every observable
    #[arg(long)]
    observable: Vec<String>,
    /// Keep products of up to this many errors
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=3))]
    order: u32,
    /// How to print the formulas
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    certificate: CertificateArguments,
}

/// How a formula is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// Plain text in the language of amounts
    Text,
    /// LaTeX, in the printed symbols
    Latex,
    /// Markdown with formulas between dollar signs
    Markdown,
    /// For programs: both the plain text and the LaTeX of each component
    Json,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let is_certified = arguments.certificate.is_wanted()?;
    let source = Source::read(&arguments.chain)?;
    let chain = source.chain()?;
    let chosen = observables(&chain, &arguments.observable)?;
    let forms: Vec<Form> = chosen
        .iter()
        .copied()
        .map(|observable| forms::derive(&chain, observable, arguments.order))
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::Input(error.to_string()))?;
    let printed = match arguments.format {
        Format::Json => format!("{:#}\n", as_json(&chain, &forms, arguments.order)),
        Format::Text => {
            sections(&chain, &forms, print::Style::Text, |title| format!("{HEADING}{title}{HEADING:#}"))
        }
        Format::Latex => sections(&chain, &forms, print::Style::Latex, |title| format!("% {title}")),
        Format::Markdown => sections(&chain, &forms, print::Style::Markdown, |title| format!("## {title}\n")),
    };
    let certificate = is_certified.then(|| certify(&source, &chosen, arguments.order)).transpose()?;
    arguments.certificate.write(certificate.as_deref())?;
    terminal::print(&printed)?;
    Ok(Answer::Done)
}

/// What is derived, as a certificate.
fn certify(source: &Source, chosen: &[ObservableId], order: u32) -> Result<String, Failure> {
    let declared = Declared::from_text(&source.text).map_err(|mistakes| source.mistakes(&mistakes))?;
    let mut certificate = Certificate::new(&declared);
    for &observable in chosen {
        certificate.derived(observable, order).map_err(|refusal| {
            let name = &declared.chain().observable(observable).name;
            Failure::Input(format!("no certificate of `{name}`: {refusal}; nothing is written"))
        })?;
    }
    Ok(certificate.finish(&source.path.display().to_string()))
}

/// The forms one after the other, each below its title.
fn sections(chain: &Chain, forms: &[Form], style: print::Style, title: impl Fn(&str) -> String) -> String {
    let sections: Vec<String> = forms
        .iter()
        .map(|form| format!("{}\n{}", title(&title_of(chain, form)), print::form(form, chain, style)))
        .collect();
    sections.join("\n")
}

/// `pointing: error of the direction of device, to first order in the errors`
pub fn title_of(chain: &Chain, form: &Form) -> String {
    let observable = chain.observable(form.observable);
    let (kind, unit) = match observable.kind {
        ObservableKind::Direction => ("direction", ""),
        ObservableKind::Point => ("point", ", in m"),
    };
    let order = ["first", "second", "third"].get(form.order as usize - 1).copied().unwrap_or("higher");
    let body = &chain.body(observable.body).name;
    format!("{}: error of the {kind} of {body}, to {order} order in the errors{unit}", observable.name)
}

fn as_json(chain: &Chain, forms: &[Form], order: u32) -> serde_json::Value {
    let observables: Vec<serde_json::Value> = forms
        .iter()
        .map(|form| {
            let [x, y, z] = form.components.each_ref().map(|component| {
                json!({"text": print::text(component, chain), "latex": print::latex(component, chain)})
            });
            json!({"name": chain.observable(form.observable).name, "components": {"x": x, "y": y, "z": z}})
        })
        .collect();
    json!({"chain": chain.name, "order": order, "observables": observables})
}
