//! A study to begin with, whose columns are read as the data ask for.

use calibration::misread::judged;
use init::{Draft, Look, Names, NotBegun};
use study::Open;

/// A study of a draft, with what is to be said of it.
#[derive(Debug)]
pub struct Begun {
    /// The study.
    pub study: String,
    /// What was read and assumed.
    pub remarks: Vec<String>,
    /// What is doubtful of the data.
    pub doubtful: Vec<String>,
}

/// The study of a draft, held to every row of the data, which `open` gives. Where the data say that a column is not what its header says,
/// the study reads it otherwise; where they do not say which, it asks.
///
/// # Errors
/// The chain, the study or the data cannot be read again; or the true directions do not follow the readings, however they are read.
pub fn begun(draft: &Draft, look: &Look, names: Names<'_>, open: &mut Open<'_>) -> Result<Begun, NotBegun> {
    let (mut study, mut remarks) = (init::study(draft, look, names), draft.remarks.clone());
    let held = init::hold(draft, &study, open)?;
    if let Some(misread) = judged(&held.plan, &held.sample).misread {
        let (said, lines) = report::words::asked(&misread);
        study = init::otherwise(&study, &said, &lines);
        init::hold(draft, &study, open)?;
        remarks.push(said.join(" "));
    } else if let Some(why) = &draft.unfollowed {
        return Err(why.clone().into());
    }
    Ok(Begun { study, remarks, doubtful: held.doubtful })
}
