//! An instrument in the form that a field's own programs read.
//!
//! A form is written, and read back: what its numbers come to at the observable is compared with what the instrument shows. What it
//! cannot carry is listed with its size there.

mod forms;
mod grid;
mod links;
mod said;
mod subject;

use crate::Instrument;
use crate::refusal::Refusal;
use crate::source::Source;

pub use forms::{FORMS, Form};
pub(crate) use said::size;
pub use subject::Difference;
pub(crate) use subject::Subject;

/// An instrument in some form.
pub struct Exported {
    /// What goes into the file.
    pub text: String,
    /// What the form says, and what it cannot carry, for people.
    pub said: String,
    form: &'static Form,
    subject: Subject,
    template: Option<Source>,
    /// What the form cannot carry, if it goes error by error.
    lost: Option<Vec<Lost>>,
}

/// What a form makes of an instrument.
struct Made {
    /// What goes into the file.
    text: String,
    /// What it says, for people.
    said: String,
    /// Errors that it cannot carry, if it goes error by error.
    lost: Option<Vec<Lost>>,
}

/// What a form cannot carry.
#[derive(Debug, Clone, PartialEq)]
struct Lost {
    /// The error, or what else it is.
    what: String,
    /// Its size at the observable, RMS over the measured region, rad or m.
    rms: f64,
}

/// Writes an instrument in a form: of the observable that is named, or of the one that its study measured.
///
/// # Errors
/// The form needs a template or takes none, the template has a mistake, or the instrument is none of the kind that the form describes.
pub fn export(
    instrument: &Instrument,
    form: &'static Form,
    observable: Option<&str>,
    template: Option<Source>,
) -> Result<Exported, Refusal> {
    match (form.template, &template) {
        (Some(what), None) => {
            return Err(Refusal::Input(format!(
                "the form `{}` is a change of {what}: name that file with --template",
                form.name
            )));
        }
        (None, Some(_)) => {
            let why =
                format!("the form `{}` is a whole file and takes no --template: leave it out", form.name);
            return Err(Refusal::Input(why));
        }
        _ => {}
    }
    let subject = Subject::of(instrument, observable)?;
    let Made { text, said, lost } = (form.write)(&subject, template.as_ref())?;
    Ok(Exported { text, said, form, subject, template, lost })
}

impl Exported {
    /// What was written, read back: what its numbers come to against the instrument, and what the form cannot carry.
    ///
    /// # Errors
    /// The text is no longer what was written.
    pub fn read_back(&self, text: &str) -> Result<String, Refusal> {
        let shown = (self.form.read)(&self.subject, text, self.template.as_ref())?;
        let difference = self.subject.difference(&shown)?;
        Ok(said::read_back(&self.subject, self.lost.as_deref(), &difference))
    }
}
