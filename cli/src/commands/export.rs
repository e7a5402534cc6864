//! `trueaxis export`: a calibrated instrument in the form that a field's own programs read.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use service::export;

use super::Answer;
use crate::failure::Failure;
use crate::source::{self, Declared};
use crate::{output, terminal};

/// Write a calibrated instrument in the form that another program reads.
///
/// The file is read back after it was written. What the form cannot carry is listed with its size, and so is the difference of the
/// file to the instrument, both over the measured region.
///
/// Example: trueaxis export result/instrument.toml --form tpoint --out mount.mod
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The instrument file, as `calibrate` writes it
    instrument: PathBuf,
    /// The form
    #[arg(long, value_parser = forms(), value_name = "FORM")]
    form: &'static export::Form,
    /// Of a form that changes another file: that file
    #[arg(long, value_name = "FILE")]
    template: Option<PathBuf>,
    /// What is exported of an instrument that observes several; default: what its study measured
    #[arg(long)]
    observable: Option<String>,
    /// Where to write; - is standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// Every form by its name.
fn forms() -> impl TypedValueParser<Value = &'static export::Form> {
    let known = export::FORMS.iter().map(|form| PossibleValue::new(form.name).help(form.what));
    PossibleValuesParser::new(known).map(|name| {
        let named = export::FORMS.iter().find(|form| form.name == name);
        named.unwrap_or_else(|| unreachable!("only names of forms are possible"))
    })
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let read = [Some(arguments.instrument.as_path()), arguments.template.as_deref()];
    output::refuse_to_replace(&arguments.out, read.into_iter().flatten())?;
    let Some(instrument) = Declared::read(&arguments.instrument)?.instrument else {
        return Err(Failure::Input(format!(
            "`{}` is a declaration; needed here is a calibrated instrument: give `instrument.toml`, which `calibrate` writes",
            arguments.instrument.display()
        )));
    };
    let template = arguments.template.as_deref().map(source::read).transpose()?;
    let exported = export::export(&instrument, arguments.form, arguments.observable.as_deref(), template)?;
    output::write_text(&arguments.out, &exported.text)?;
    // A pipe or a device gives nothing back.
    let is_file = arguments.out.is_file();
    let written = if is_file { source::read(&arguments.out)?.text } else { exported.text.clone() };
    let said = format!("{}\n{}", exported.said, exported.read_back(&written)?);
    if is_file {
        terminal::print_text(said)?;
    } else {
        // Standard output may have the file.
        said.lines().filter(|line| !line.is_empty()).for_each(terminal::note);
    }
    Ok(Answer::Done)
}
