//! Misread columns and implausible values, in words.

use super::numbers::short;
use super::step::Step;
use calibration::diagnose::{Caution, Diagnosis};
use calibration::misread::{
    ByTheClock, Heading, Implausible, Line, Misread, Reading, StatedPlaces, Strayed, Suspect,
};
use observe::SiUnit;

/// Readings that are shown where several explain the data alike.
const SHOWN: usize = 3;

/// Rows that are named.
const ROWS_SHOWN: usize = 8;

/// The misread columns of a diagnosis.
pub(super) fn misread(diagnosis: &Diagnosis) -> Option<&Misread> {
    diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::ColumnMisread(misread) => Some(misread),
        _ => None,
    })
}

/// The values that no small error has.
pub(super) fn implausible_values(diagnosis: &Diagnosis) -> Option<&[Implausible]> {
    diagnosis.cautions.iter().find_map(|caution| match caution {
        Caution::Implausible { values } => Some(values.as_slice()),
        _ => None,
    })
}

/// What is misread, and what the residual is when it is read right.
pub(super) fn told(misread: &Misread) -> String {
    let Misread { readings, before, after, needs, unit, .. } = misread;
    let residual = match needs {
        // The study's own reading leaves as little, by an error that nobody makes.
        Some(needed) => format!("As the study reads the file, {}", value(needed)),
        None => format!("Residual {} → {}.", short(*before, *unit), short(*after, *unit)),
    };
    match &readings[..] {
        [] => unreachable!("a misread column has a reading that explains it"),
        [one] => format!("{} {residual}", sentence(&one.reading)),
        several => {
            let each: Vec<String> = several.iter().take(SHOWN).map(|one| sentence(&one.reading)).collect();
            format!("One of these explains the data. {} {residual}", each.join(" Or: "))
        }
    }
}

/// What a study that is begun says of how its columns are read, and the lines that read them so, each with its table. Where several
/// readings explain the data, none is chosen.
#[must_use]
pub fn asked(misread: &Misread) -> (Vec<String>, Vec<(&str, &str)>) {
    let each = |suspect: &Suspect| {
        let (lines, headings) = (written(&suspect.lines), headings(&suspect.headings));
        format!("{} {lines}{headings}", sentence(&suspect.reading)).trim_end().to_owned()
    };
    match &misread.readings[..] {
        [one] if !one.lines.is_empty() && one.headings.is_empty() => {
            let kept = "The study is written so. If this is wrong, change these lines back.";
            let lines = one.lines.iter().map(|line| (line.table, line.text.as_str())).collect();
            (vec![told(misread), kept.to_owned()], lines)
        }
        [one] => (vec![told(misread), step(one).text], Vec::new()),
        several => {
            let asked = "One of these explains the data, and the data cannot choose. Which is true?";
            let shown = several.iter().take(SHOWN).map(each);
            (std::iter::once(asked.to_owned()).chain(shown).collect(), Vec::new())
        }
    }
}

/// What to write into the study.
pub(super) fn steps(misread: &Misread) -> Vec<Step> {
    misread.readings.iter().take(SHOWN).map(step).collect()
}

fn step(suspect: &Suspect) -> Step {
    let mut text = written(&suspect.lines);
    text.push_str(&headings(&suspect.headings));
    if matches!(suspect.reading, Reading::TwoStates { .. }) {
        text.push_str(
            "Look for two targets, two prism constants or a play. Add a column with the kind of each row, and calibrate each kind alone. ",
        );
    } else if matches!(suspect.reading, Reading::Frame { .. }) {
        text.push_str(
            "Look at how the measured directions were computed. A wrong clock, time zone or longitude turns them about the celestial pole, a \
             wrong latitude about the line from east to west. If the instrument itself is turned like this, write the turn into the declaration \
             as a position of its first body. ",
        );
    } else if let Some(places) = of_places(&suspect.reading) {
        text.push_str(places);
        text.push(' ');
    } else if matches!(suspect.reading, Reading::RightAscension { .. }) {
        text.push_str(
            "Add a column of hour angles to the file, the sidereal time less the right ascension, and name it in the study. ",
        );
    } else if matches!(suspect.reading, Reading::Doubled { .. }) {
        text.push_str("Halve these numbers in the file. ");
    } else if suspect.lines.is_empty() && suspect.headings.is_empty() {
        text.push_str("Correct these rows in the file. ");
    }
    text.push_str("Then calibrate again.");
    Step { title: title(&suspect.reading).to_owned(), text, command: None }
}

/// What to do about stated places.
fn of_places(reading: &Reading) -> Option<&'static str> {
    match reading {
        Reading::PlacesExchanged { .. } => Some("Exchange x and y where the study states these places."),
        Reading::PlacesUnit { .. } => Some("Correct the unit where the study states these places."),
        Reading::HeadingsReversed => Some("Change the sign of each heading in the study."),
        Reading::HeadingsFromY { exchanged: false } => {
            Some("Write 90 deg − heading for each heading in the study.")
        }
        Reading::HeadingsFromY { exchanged: true } => {
            Some("Exchange x and y of the places in the study, and write 90 deg − heading for each heading.")
        }
        _ => None,
    }
}

/// Lines to write, by their tables.
fn written(lines: &[Line]) -> String {
    let mut text = String::new();
    for table in ["columns", "observed", "also.columns", "also.observed"] {
        let own = lines.iter().filter(|line| line.table == table);
        let own: Vec<&str> = own.map(|line| line.text.as_str()).collect();
        if !own.is_empty() {
            text.push_str(&format!("Write under [{table}]: `{}`. ", own.join("`, `")));
        }
    }
    text
}

/// Headings to be mended in the file.
fn headings(headings: &[Heading]) -> String {
    let each = headings
        .iter()
        .map(|own| format!("The heading `{}` states another unit. Write {} there. ", own.heading, own.is));
    each.collect()
}

/// Values that no small error has, and what to do.
pub(super) fn implausible(values: &[Implausible]) -> String {
    let each: Vec<String> = values.iter().take(SHOWN).map(value).collect();
    format!(
        "{} The model or a column is wrong. Compare the units, signs and order of the columns with the file. Where a value is right, raise its \
         limit (`[fit] plausible`).",
        each.join(" ")
    )
}

fn value(value: &Implausible) -> String {
    match value {
        Implausible::Error { name, value, limit, unit } => {
            format!("`{name}` is {}. At most {} is plausible.", short(*value, *unit), short(*limit, *unit))
        }
        Implausible::Residual { rms, size: _, unit } if *unit == SiUnit::RAD => {
            format!("The residual is {}, too large for a small error.", short(*rms, *unit))
        }
        Implausible::Residual { rms, size, unit } => format!(
            "The residual is {}, {:.0} % of the measured size.",
            short(*rms, *unit),
            100.0 * rms / size
        ),
    }
}

fn title(reading: &Reading) -> &'static str {
    match reading {
        Reading::Unit { .. } | Reading::Counts { .. } => "Correct the unit",
        Reading::Packed { .. } => "State the notation",
        Reading::Reversed { .. } => "Reverse the sign",
        Reading::FromZenith { .. } => "Count from the horizon",
        Reading::Turned { .. } => "Move the zero",
        Reading::FromRow { .. } | Reading::OfStation { .. } => "Correct these rows",
        Reading::Doubled { .. } => "Halve the lengths",
        Reading::RightAscension { .. } => "Compute the hour angle",
        Reading::PlacesExchanged { .. } => "Exchange x and y",
        Reading::PlacesUnit { .. } => "Correct the unit of the places",
        Reading::HeadingsReversed | Reading::HeadingsFromY { .. } => "Correct the headings",
        Reading::Exchanged { .. } => "Exchange the columns",
        Reading::Order { .. } => "Change the order of the columns",
        Reading::Inverse { .. } => "Turn the rotation round",
        Reading::Both { .. } => "Correct both",
        Reading::TwoStates { .. } => "Separate the two kinds of rows",
        Reading::Frame { .. } => "Find the other frame",
        Reading::Shifted { .. } => "Shift the rows",
    }
}

fn sentence(reading: &Reading) -> String {
    match reading {
        Reading::Unit { columns, is, read } => {
            let not = read.map_or_else(String::new, |read| format!(", not {read}"));
            format!("{} in {is}{not}.", are(columns))
        }
        Reading::Counts { column, per_turn } => {
            format!("Column `{column}` is in counts of its encoder, {per_turn} per turn.")
        }
        Reading::Packed { columns, notation } => {
            format!("{} in degrees, minutes and seconds ({notation}), not in decimal degrees.", are(columns))
        }
        Reading::Reversed { column } => format!("Column `{column}` counts the other way."),
        Reading::FromZenith { column } => {
            format!("Column `{column}` is the angle from the zenith, not from the horizon.")
        }
        Reading::Turned { column, by_deg } => {
            format!("Column `{column}` has another zero. The joint reads {by_deg}° more.")
        }
        Reading::FromRow { reading, row, before } => {
            let which = if *before { "before" } else { "from" };
            let on = if *before { "" } else { " on" };
            format!("{} This applies only to the rows {which} row {row}{on}.", sentence(reading))
        }
        Reading::OfStation { reading, station } => {
            format!("{} This applies only to the rows of station `{station}`.", sentence(reading))
        }
        Reading::RightAscension { columns, sidereal } => {
            let what = if columns.len() == 1 { "a right ascension" } else { "right ascensions" };
            format!("{} {what}, not an hour angle. Column `{sidereal}` is the sidereal time.", are(columns))
        }
        Reading::Doubled { column } => {
            format!(
                "The numbers of column `{column}` are twice what the study takes them for, such as diameters for radii."
            )
        }
        Reading::PlacesExchanged { of } => format!("x and y of {} are exchanged.", places(*of)),
        Reading::PlacesUnit { of, is, read } => {
            format!("The coordinates of {} are in {is}, not {read}.", places(*of))
        }
        Reading::HeadingsReversed => "The headings of the stations run the other way.".to_owned(),
        Reading::HeadingsFromY { exchanged: false } => {
            "The headings of the stations are bearings from y to x.".to_owned()
        }
        Reading::HeadingsFromY { exchanged: true } => {
            "x and y of the places are northing and easting, and the headings are bearings.".to_owned()
        }
        Reading::Order { columns, order } => {
            format!(
                "Columns {} are the {order} of the quaternion. The study takes them for w, x, y, z.",
                listed(columns)
            )
        }
        Reading::Inverse { columns } => {
            format!("Columns {} are the inverse rotation, which turns the other way.", listed(columns))
        }
        Reading::Both { readings: [one, other] } => format!("{} {}", sentence(one), sentence(other)),
        Reading::TwoStates { errors, by, units, rows, of } => {
            let each = errors.iter().zip(by.iter().zip(units));
            let each: Vec<String> =
                each.map(|(name, (by, unit))| format!("{} in `{name}`", short(*by, *unit))).collect();
            format!(
                "The rows are of two kinds that differ by {}. {} of {of} rows are of the smaller kind{}.",
                each.join(" and "),
                rows.len(),
                some(rows)
            )
        }
        Reading::Frame { by_deg, axis: [x, y, z], hours } => {
            format!(
                "The measured directions are those of another frame. They fit once they are turned by {by_deg:.2}° about the axis \
                 ({x:.3}, {y:.3}, {z:.3}).{}",
                hours.map(by_as_much).unwrap_or_default()
            )
        }
        Reading::Exchanged { columns: [one, other] } => {
            format!("The columns `{one}` and `{other}` are exchanged.")
        }
        Reading::Shifted { columns, by } => {
            let what = if columns.len() == 1 { "Column" } else { "Columns" };
            let are = if columns.len() == 1 { "is" } else { "are" };
            // Where a row needs the reading of the row before it, readings are one row too early.
            let row = if *by > 0 { "one row too early" } else { "one row too late" };
            format!("{what} {} {are} {row} compared with the observations.", listed(columns))
        }
    }
}

/// That stations are fitted away from their rough places.
pub(super) fn strayed(Strayed { station, away_m, turn_rad }: &Strayed) -> String {
    let (away, turn) = (short(*away_m, SiUnit::METRE), turn_rad.to_degrees());
    format!(
        "The fitted stations are not where the study roughly places them, `{station}` by {away} and {turn:.0}°. Check their names, x and y, \
         headings, and which way angles run."
    )
}

fn places(of: StatedPlaces) -> &'static str {
    match of {
        StatedPlaces::Objects => "the stated objects",
        StatedPlaces::Stations => "the stated stations",
        StatedPlaces::Both => "the stated objects and stations",
    }
}

/// A zero that a wrong clock explains as well.
pub(super) fn by_the_clock(ByTheClock { error, value_rad, hours }: &ByTheClock) -> String {
    format!(
        "`{error}` is {}.{} Check the clock, the time zone and the longitude. If they are right, the zero is real.",
        short(*value_rad, SiUnit::RAD),
        by_as_much(*hours)
    )
}

/// That the sky turns by as much in whole hours.
fn by_as_much(hours: u8) -> String {
    let plural = if hours > 1 { "s" } else { "" };
    format!(" The sky turns by as much in {hours} hour{plural}.")
}

/// Some of the rows by their numbers.
fn some(rows: &[u64]) -> String {
    let shown: Vec<String> = rows.iter().take(ROWS_SHOWN).map(u64::to_string).collect();
    let more = if rows.len() > ROWS_SHOWN { ", …" } else { "" };
    format!(" (rows {}{more})", shown.join(", "))
}

fn are(columns: &[String]) -> String {
    match columns {
        [one] => format!("Column `{one}` is"),
        several => format!("Columns {} are", listed(several)),
    }
}

fn listed(columns: &[String]) -> String {
    let named: Vec<String> = columns.iter().map(|column| format!("`{column}`")).collect();
    match named.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
        None => unreachable!("a reading is that of a column"),
    }
}
