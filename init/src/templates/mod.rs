//! The registry of templates: one kind of instrument a file, one line each in the table below.
//!
//! A template knows which columns it looks for, which errors its field usually declares, and how they act.

mod alt_azimuth;
mod arm;
mod ball_bar;
mod encoder;
mod equatorial;
mod gimbal;
mod machine;
mod r_test;
mod scanner;
mod total_station;
mod turntable;
mod vehicle;

use crate::look::{Look, Read};
use crate::words::Part;
use crate::{Draft, Frame};

/// One kind of instrument.
pub struct Template {
    /// As it is asked for.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// The columns that it looks for.
    pub looks_for: &'static str,
    /// Whether a header plainly means it.
    pub(crate) fits: fn(&Look) -> bool,
    /// The chain and what the study says, from a table.
    pub(crate) draft: fn(&Look) -> Result<Draft, String>,
}

/// Every template.
pub const TEMPLATES: &[Template] = &[
    alt_azimuth::TEMPLATE,
    equatorial::TEMPLATE,
    scanner::TEMPLATE,
    total_station::TEMPLATE,
    gimbal::TEMPLATE,
    turntable::TEMPLATE,
    vehicle::TEMPLATE,
    arm::TEMPLATE,
    encoder::TEMPLATE,
    machine::TEMPLATE,
    ball_bar::TEMPLATE,
    r_test::TEMPLATE,
];

/// The template of a name.
#[must_use]
pub fn named(name: &str) -> Option<&'static Template> {
    TEMPLATES.iter().find(|template| template.name == name)
}

/// Whether a table has a reading of each of these parts.
fn has(look: &Look, parts: &[Part]) -> bool {
    parts.iter().all(|part| look.reading(&[*part]).is_ok_and(|found| found.is_some()))
}

/// A side quantity that the declaration names and effects may use: its statement, its column, its name.
#[derive(Default)]
struct Beside {
    statements: String,
    columns: Vec<(String, Read)>,
    names: Vec<String>,
}

impl Beside {
    /// The temperature, if exactly one column tells it.
    fn of(look: &Look) -> Self {
        match look.reading(&[Part::Temperature]) {
            Ok(Some(column)) => Self {
                statements:
                    "    /// Temperature, in the unit of the data.\n    input temperature: temperature;\n\n"
                        .to_owned(),
                columns: vec![("temperature".to_owned(), column.plain())],
                names: vec!["temperature".to_owned()],
            },
            _ => Self::default(),
        }
    }
}

/// A frame that the rows show, else the usual one, and why they show none.
fn shown(look: &Look, frame: Option<Frame>, what: &str) -> (Frame, Option<String>) {
    let why = || {
        format!(
            "{}: the true directions do not follow the readings of {what}: are the columns, their units and the template \
             right?",
            look.file
        )
    };
    (frame.unwrap_or(Frame::USUAL), frame.is_none().then(why))
}
