//! A chain and a study to start from, out of what a table of data shows: its header, and the numbers below it.
//!
//! What can be seen is not asked: which column is which joint (`words`), in which unit (`look`), how the truth was
//! observed (`observed`), which way axes turn and from where angles count (`frame`). Each kind of instrument is one of the
//! `templates`; what it makes of a table is a [`Draft`], and `study` writes it down.

mod frame;
pub mod links;
mod look;
mod machine_tools;
mod mounting;
mod observed;
mod otherwise;
mod placed;
pub mod robot;
mod study;
pub mod templates;
mod turned;
mod words;

pub use look::Look;
pub use otherwise::otherwise;
pub use study::{Joined, Names, study};
pub use templates::Template;

use ::study::{Open, Plan, Sample, Study};
use model_core::Chain;
use model_core::escape::message;

use frame::Frame;
use look::Read;
use observed::Observed;
use turned::Turned;

/// Why nothing can be begun, in words that say what to mend.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{}", message(why), offered.iter().map(|one| format!("\n  {}", message(one))).collect::<String>())]
pub struct NotBegun {
    /// Why, in words that say what to do instead.
    pub why: String,
    /// What is offered instead, a line each.
    pub offered: Vec<String>,
}

impl From<String> for NotBegun {
    fn from(why: String) -> Self {
        Self { why, offered: Vec::new() }
    }
}

/// What a template makes of a table.
pub struct Draft {
    /// The declaration.
    pub chain: String,
    /// Its observable.
    pub observable: &'static str,
    /// Joints and inputs with the columns that hold their readings.
    columns: Vec<(String, Read)>,
    /// What was observed.
    observed: Observed,
    /// How the body was turned, by the observable of this name.
    turned: Option<(&'static str, Turned)>,
    /// What is estimated, where that is more than every error.
    estimate: Vec<&'static str>,
    /// Where the fit starts: an error, and its value as the study writes it.
    start: Vec<(&'static str, String)>,
    /// How large errors may be, where these are larger than those of an instrument usually are: patterns of names, with their sizes.
    tolerance: &'static [(&'static str, &'static str)],
    /// Side quantities that effects may use.
    inputs: Vec<String>,
    /// Whether the rows follow each other as they were taken, so that the sense of a motion is seen.
    is_in_order: bool,
    /// Why these rows begin nothing as the headers have them; a reading that explains them may.
    pub unfollowed: Option<String>,
    /// What the user should know of it.
    pub remarks: Vec<String>,
}

/// A draft by a template, or by the one that the table plainly asks for.
///
/// # Errors
/// The template does not fit the table; no template does, or several do.
pub fn draft(
    look: &Look,
    template: Option<&'static Template>,
) -> Result<(&'static Template, Draft), NotBegun> {
    let template = template.map_or_else(|| choose(look), Ok)?;
    let mut draft = (template.draft)(look).map_err(NotBegun::from)?;
    draft.remarks.splice(0..0, look.remarks.iter().cloned());
    Ok((template, draft))
}

/// What was begun, as it is read again.
#[derive(Debug)]
pub struct Held {
    /// The study.
    pub plan: Plan,
    /// Some of its rows as the file has them, to be read otherwise.
    pub sample: Sample,
    /// What is doubtful of the data.
    pub doubtful: Vec<String>,
}

/// Holds what was begun to what it is read with: the chain, the study, and every row of the data, which `open` gives.
///
/// # Errors
/// One of them cannot be read.
pub fn hold(draft: &Draft, study: &str, open: &mut Open<'_>) -> Result<Held, NotBegun> {
    let ours = |what: &str, why: String| {
        NotBegun::from(format!("{what} cannot be read again, and nothing is written: {why}"))
    };
    let chain = Chain::from_text(&draft.chain)
        .map_err(|mistakes| ours("the chain that was made of these data", mistakes.to_string()))?;
    let plan = Study::from_text(study)
        .and_then(|study| study.plan(&chain))
        .map_err(|mistakes| ours("the study that was made of these data", mistakes.to_string()))?;
    let loaded = plan.load(open).map_err(|error| NotBegun::from(error.to_string()))?;
    let doubtful = loaded.doubtful.iter().map(ToString::to_string).collect();
    Ok(Held { plan, sample: loaded.sample, doubtful })
}

/// The template that a table plainly asks for.
///
/// # Errors
/// None does, or several do; the message lists the templates.
fn choose(look: &Look) -> Result<&'static Template, NotBegun> {
    let fitting: Vec<_> = templates::TEMPLATES.iter().filter(|template| (template.fits)(look)).collect();
    match fitting.as_slice() {
        [one] => Ok(one),
        several => {
            let found = if several.is_empty() {
                "the header does not say which kind of instrument this is"
            } else {
                "several kinds of instrument have columns of these names"
            };
            let offered =
                if several.is_empty() { templates::TEMPLATES.iter().collect() } else { several.to_vec() };
            let lines = offered.iter().map(|one| format!("--template {:14} {}", one.name, one.looks_for));
            // What the file lacks comes first.
            let said = look.remarks.iter().cloned();
            Err(NotBegun {
                why: format!("{}: {found}; say which, and name the columns as it looks for them:", look.file),
                offered: said.chain(lines).collect(),
            })
        }
    }
}
