//! The registry of forms that an instrument is written in: one file each, one line each in the table below.

mod calibration_conf;
mod dh;
mod iso230;
mod table;
mod tpoint;
mod urdf;

use super::Made;
use super::subject::{Shown, Subject};
use crate::refusal::Refusal;
use crate::source::Source;

/// A form.
#[derive(Debug)]
pub struct Form {
    /// Its name: `tpoint`.
    pub name: &'static str,
    /// What it is, in a line.
    pub what: &'static str,
    /// What file it is a change of, if it is no whole file.
    pub template: Option<&'static str>,
    pub(super) write: fn(&Subject, Option<&Source>) -> Result<Made, Refusal>,
    /// What the observable shows by a file, at the poses of the subject.
    pub(super) read: fn(&Subject, &str, Option<&Source>) -> Result<Shown, Refusal>,
}

/// Every form.
pub const FORMS: &[Form] =
    &[tpoint::FORM, dh::FORM, urdf::FORM, calibration_conf::FORM, table::FORM, iso230::FORM];
