//! The study that a draft stands for, as a text to read and to mend.

use std::fmt::Write as _;

use model_core::escape::comments;
use tables::formats::Site;
use tables::trajectory::{Geodetic, Offset};

use super::look::Read;
use super::words::Part;
use super::{Draft, Look, Observed};

/// Groups are worth naming from so many on.
const GROUPS: usize = 12;

/// The paths of a study's chain and data as the study names them, and the command that runs the study.
#[derive(Debug, Clone, Copy, Default)]
pub struct Names<'a> {
    /// The chain.
    pub chain: &'a str,
    /// The data.
    pub data: &'a str,
    /// The command.
    pub command: &'a str,
    /// Where the instrument stands, if that was said.
    pub site: Option<Site>,
    /// What joins the rows by time, if something does.
    pub trajectory: Option<Joined<'a>>,
}

/// A trajectory as a study names it.
#[derive(Debug, Clone, Copy)]
pub struct Joined<'a> {
    /// The path.
    pub file: &'a str,
    /// The column of the data that has the times.
    pub time: &'a str,
    /// What is added to these times, s, and why.
    pub offset: Option<Offset>,
    /// The place that is zero.
    pub origin: Geodetic,
}

/// The study of a draft.
#[must_use]
pub fn study(draft: &Draft, look: &Look, names: Names<'_>) -> String {
    let Names { chain, data, command, site, trajectory } = names;
    let mut text = format!("# Begun by trueaxis init: {}\n", comments::line(command));
    for remark in &draft.remarks {
        let _ = writeln!(text, "# {}", comments::line(remark));
    }
    let _ = writeln!(text, "\nchain      = {}\nobservable = {}", quoted(chain), quoted(draft.observable));
    let _ = writeln!(text, "data       = {}", quoted(data));
    if let Some(Site { latitude_deg, longitude_deg }) = site {
        let _ = writeln!(
            text,
            "site       = {{ latitude = \"{latitude_deg} deg\", longitude = \"{longitude_deg} deg\" }}"
        );
    }
    if let Some(id) = named_rows(look) {
        let _ = writeln!(text, "id         = {}", quoted(&id));
    }
    if let Some(joined) = trajectory {
        text.push_str(&trajectory_table(joined));
    }
    text.push_str("\n[columns]\n");
    let width = draft.columns.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
    for (name, read) in &draft.columns {
        let _ = writeln!(text, "{name:width$} = {}", column(read));
    }
    text.push_str("\n[observed]\n");
    let (kind, columns): (&str, Vec<(&str, &Read)>) = match &draft.observed {
        Observed::Spherical(keys, read) => ("spherical", keys.iter().copied().zip(read).collect()),
        Observed::Azimuth(read) => ("spherical", vec![("azimuth", read)]),
        Observed::Direction(read) => ("direction", ["x", "y", "z"].into_iter().zip(read).collect()),
        Observed::Offset(read) => ("offset", ["cross", "along"].into_iter().zip(read).collect()),
        Observed::Point(read) => ("point", ["x", "y", "z"].into_iter().zip(read).collect()),
        Observed::Range(read) => ("range", vec![("range", read)]),
        Observed::Target(..) => ("target", Vec::new()),
        Observed::Plane(_) => ("plane", Vec::new()),
    };
    let _ = writeln!(text, "kind = \"{kind}\"");
    for (key, read) in columns {
        let _ = writeln!(text, "{key} = {}", column(read));
    }
    if let Observed::Target(object, station) = &draft.observed {
        let _ = writeln!(text, "object = {}", quoted(object));
        if let Some(station) = station {
            let _ = writeln!(text, "station = {}", quoted(station));
        }
    }
    if let Observed::Plane(object) = &draft.observed {
        let _ = writeln!(text, "object = {}", quoted(object));
    }
    let groups = groups(look);
    if !groups.is_empty() {
        text.push_str(
            "\n# Rows that have these in common are not independent: they are held out together.\n[noise]\n",
        );
        let _ = writeln!(text, "group = {}", list(groups.iter().map(String::as_str)));
    }
    if !draft.estimate.is_empty() || !draft.start.is_empty() || !draft.tolerance.is_empty() {
        text.push_str("\n[fit]\n");
        if !draft.estimate.is_empty() {
            let _ = writeln!(text, "estimate = {}", list(draft.estimate.iter().copied()));
        }
        let starts: Vec<String> =
            draft.start.iter().map(|(name, value)| format!("{name} = {}", quoted(value))).collect();
        if !starts.is_empty() {
            let _ = writeln!(text, "start = {{ {} }}", starts.join(", "));
        }
        let sizes: Vec<String> = draft
            .tolerance
            .iter()
            .map(|(name, size)| format!("{} = {}", quoted(name), quoted(size)))
            .collect();
        if !sizes.is_empty() {
            let _ = writeln!(text, "tolerance = {{ {} }} # how large these may be", sizes.join(", "));
        }
    }
    if !draft.inputs.is_empty() || draft.is_in_order {
        text.push_str("\n[search]\n");
    }
    if draft.is_in_order {
        text.push_str("sequence = true # each row follows the one before: the direction of motion is used\n");
    }
    if !draft.inputs.is_empty() {
        let _ = writeln!(text, "inputs = {}", list(draft.inputs.iter().map(String::as_str)));
    }
    let good = if matches!(
        draft.observed,
        Observed::Point(_) | Observed::Range(_) | Observed::Target(..) | Observed::Plane(_)
    ) {
        "0.1 mm"
    } else {
        "5 arcsec"
    };
    let _ = write!(
        text,
        "\n# The specification, which the report judges, and the errors that it shows first:\n# [goal]\n# rms = \"{good}\"\n\
         # [report]\n# wanted = []\n"
    );
    if let Some((observable, turned)) = &draft.turned {
        let _ = writeln!(
            text,
            "\n# How it is turned stands in the same rows.\n[[also]]\nobservable = {}",
            quoted(observable)
        );
        let _ = writeln!(text, "data = {}\n\n[also.columns]", quoted(data));
        for (name, read) in &draft.columns {
            let _ = writeln!(text, "{name:width$} = {}", column(read));
        }
        text.push_str("\n[also.observed]\nkind = \"orientation\"\n");
        if let Some(euler) = turned.euler {
            let _ = writeln!(text, "euler = {}", quoted(euler));
        }
        for (key, read) in &turned.columns {
            let _ = writeln!(text, "{key} = {}", column(read));
        }
    }
    text
}

/// `[trajectory]`
fn trajectory_table(Joined { file, time, offset, origin }: Joined<'_>) -> String {
    let mut text = format!(
        "\n[trajectory] # gives each row east, north, up, heading, pitch and roll by its time; the origin is east, north and up zero\n\
         file   = {}\ntime   = {}\n",
        quoted(file),
        quoted(time)
    );
    if let Some(Offset { seconds, what }) = offset {
        let _ = writeln!(text, "offset = \"{seconds} s\" # {what}");
    }
    let [latitude, longitude] = [origin.latitude_rad, origin.longitude_rad].map(f64::to_degrees);
    let _ = writeln!(
        text,
        "origin = {{ latitude = \"{latitude:.5} deg\", longitude = \"{longitude:.5} deg\", height = \"{:.1} m\" }}",
        origin.height_m
    );
    text
}

fn column(read: &Read) -> String {
    let name = quoted(&read.column);
    match (read.unit, read.notation) {
        (Some(unit), _) => format!("{{ column = {name}, unit = {} }}", quoted(unit)),
        (None, Some(notation)) => format!("{{ column = {name}, notation = {} }}", quoted(notation.name())),
        (None, None) => format!("{{ column = {name} }}"),
    }
}

fn list<'a>(texts: impl Iterator<Item = &'a str>) -> String {
    format!("[{}]", texts.map(quoted).collect::<Vec<_>>().join(", "))
}

/// A text as TOML has it.
fn quoted(text: &str) -> String {
    toml::Value::String(text.to_owned()).to_string()
}

/// The column whose cells are names of the rows.
fn named_rows(look: &Look) -> Option<String> {
    let names =
        look.columns.iter().find(|column| column.part() == Some(Part::Name) && column.tells_rows_apart());
    names.map(|column| column.name.full.clone())
}

/// The columns that say which rows belong together, where they make enough groups.
fn groups(look: &Look) -> Vec<String> {
    let named = look.columns.iter().filter(|column| column.part() == Some(Part::Group));
    let enough = named.filter(|column| column.different >= GROUPS && !column.tells_rows_apart());
    enough.map(|column| column.name.full.clone()).collect()
}
