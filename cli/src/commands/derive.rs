//! `trueaxis derive`: the closed form of each observable's error, as a paper would print it.

use std::path::PathBuf;

use model_core::algebra::Fraction;
use model_core::escape::{self, Screen};
use model_core::forms::{self, Form, TableError};
use model_core::{Chain, ObservableId, print};
use proof::{Certificate, Declared};
use report::style::HEADING;
use serde_json::json;
use service::Source;
use service::formulas::{closed_forms, title_of, unique_roots};
use service::source::observables;

use super::Answer;
use crate::certificates::CertificateArguments;
use crate::expected::{self, Work};
use crate::failure::Failure;
use crate::{source, terminal, whole};

/// Derive the closed form of the error of each observable.
///
/// The error is the transform with errors minus the one without, times the observable, kept up to the given
/// order in the errors. Nothing is typed in: every coefficient follows from the declaration.
///
/// Angles are in radians. Unless the declaration names other axes, an azimuth is 0 along x and a quarter turn along y, an
/// hour angle or a horizontal circle turns the other way, an elevation is above the plane across z, a zenith distance from z.
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
    #[arg(long, default_value_t = 1, value_parser = whole::number(1..=3), allow_negative_numbers = true)]
    order: u32,
    /// A table: what each error adds, in named common parts (short sines and cosines, rotations, lever arms)
    #[arg(long, conflicts_with_all = ["order", "steps"])]
    table: bool,
    /// The derivation step by step, as at the board: expand, drop products of errors, use the transpose, collect
    #[arg(long, conflicts_with = "order")]
    steps: bool,
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
    let source = source::read(&arguments.chain)?;
    let chain = source.symbolic_chain(&terminal::warn)?;
    let waiting = expected::announce(&chain, Work::Derive { order: arguments.order });
    let chosen = observables(&chain, &arguments.observable)?;
    if arguments.table || arguments.steps {
        if is_certified {
            let why = "a certificate is of the form itself: ask for it without --table and --steps";
            return Err(Failure::Input(why.to_owned()));
        }
        return show_parts(arguments, &chain, &chosen, waiting);
    }
    let forms = closed_forms(&chain, &arguments.observable, arguments.order, &terminal::warn)?;
    let printed = match arguments.format {
        Format::Json => escape::json(&format!("{:#}\n", as_json(&chain, &forms, arguments.order))).into(),
        Format::Text => sections(&chain, &forms, print::Style::Text),
        Format::Latex => sections(&chain, &forms, print::Style::Latex),
        Format::Markdown => sections(&chain, &forms, print::Style::Markdown),
    };
    let certificate = is_certified.then(|| certify(&source, &chosen, arguments.order)).transpose()?;
    arguments.certificate.write(certificate.as_deref())?;
    drop(waiting);
    match arguments.format {
        Format::Text => terminal::print_formulas(printed)?,
        Format::Latex | Format::Markdown | Format::Json => terminal::print(printed)?,
    }
    Ok(Answer::Done)
}

/// The columns as tables, or the derivations in steps; observables that show single readings have neither.
fn show_parts(
    arguments: &Arguments,
    chain: &Chain,
    chosen: &[ObservableId],
    waiting: Option<terminal::Progress>,
) -> Result<Answer, Failure> {
    let style = match arguments.format {
        Format::Text => print::Style::Text,
        Format::Latex => print::Style::Latex,
        Format::Markdown => print::Style::Markdown,
        Format::Json => {
            let why = "--format json prints whole formulas: leave out --table and --steps, or choose text, latex or markdown";
            return Err(Failure::Input(why.to_owned()));
        }
    };
    let what = if arguments.table { "what a unit of each error adds" } else { "its error in steps" };
    let mut screen = Screen::default();
    for &observable in chosen {
        let name = &chain.observable(observable).name;
        let printed = if arguments.table {
            forms::table(chain, observable, print::is_short).map(|table| print::table(&table, style))
        } else {
            forms::steps(chain, observable).map(|steps| print::steps(&steps, chain, style))
        };
        match printed {
            Ok(printed) => add_section(&mut screen, style, &format!("{name}: {what}"), &printed),
            // Nobody asked for this observable in particular; the others still have an answer.
            Err(error @ TableError::Readings(_)) if arguments.observable.is_empty() && chosen.len() > 1 => {
                terminal::warn(format_args!("{name} is left out: {error}"));
            }
            Err(error) => return Err(Failure::Input(error.to_string())),
        }
    }
    drop(waiting);
    match style {
        print::Style::Text => terminal::print_formulas(screen)?,
        print::Style::Latex | print::Style::Markdown => terminal::print(screen)?,
    }
    Ok(Answer::Done)
}

/// What is derived, as a certificate.
fn certify(source: &Source, chosen: &[ObservableId], order: u32) -> Result<String, Failure> {
    let declared = Declared::from_text(&source.text).map_err(|mistakes| source.mistakes(&mistakes))?;
    let mut certificate = Certificate::new(&declared);
    for &observable in chosen {
        if let Err(refusal) = certificate.derived(observable, order) {
            let name = &declared.chain().observable(observable).name;
            certificate.not_certified(name, &refusal.to_string());
        }
    }
    if certificate.is_empty() {
        let why = certificate.notes().join("; ");
        return Err(Failure::Input(format!("no certificate of {why}. Nothing is written")));
    }
    for note in certificate.notes() {
        terminal::note(format_args!("not certified: {note}"));
    }
    Ok(certificate.finish(&source.path.display().to_string()))
}

/// The forms one after the other, each below its title.
fn sections(chain: &Chain, forms: &[Form], style: print::Style) -> Screen {
    let mut screen = Screen::default();
    for form in forms {
        add_section(&mut screen, style, &title_of(chain, form), &print::form(form, chain, style));
    }
    screen
}

/// Adds what was printed below its title.
fn add_section(screen: &mut Screen, style: print::Style, title: &str, printed: &str) {
    if !screen.as_str().is_empty() {
        screen.append(&"\n".into());
    }
    match style {
        print::Style::Text => screen.styled([&HEADING, &format_args!("{HEADING:#}")], title),
        print::Style::Latex => screen.append(&format!("% {title}").into()),
        print::Style::Markdown => screen.append(&format!("## {}\n", escape::markdown(title)).into()),
    }
    screen.append(&format!("\n{printed}").into());
}

fn as_json(chain: &Chain, forms: &[Form], order: u32) -> serde_json::Value {
    let observables: Vec<serde_json::Value> = forms
        .iter()
        .map(|form| {
            let observable = chain.observable(form.observable);
            let shown = |style| move |component: &Fraction| component.show(chain, style);
            let (text, latex) = (shown(print::Style::Text), shown(print::Style::Latex));
            let components: serde_json::Map<String, serde_json::Value> = observable
                .labels()
                .zip(&form.components)
                .map(|(label, component)| {
                    (label.to_owned(), json!({"text": text(component), "latex": latex(component)}))
                })
                .collect();
            let positive: Vec<String> = unique_roots(form).map(|root| print::text(root, chain)).collect();
            json!({"name": observable.name, "components": components, "positive": positive})
        })
        .collect();
    json!({"chain": chain.name, "order": order, "observables": observables})
}
