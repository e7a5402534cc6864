//! What a table of plate solves states of itself: equinoxes, units, and the site above its header.

use model_core::unit::Measures;

use super::roles::{Place, Roles, equinox};
use super::rows::Rows;
use crate::formats::decimal::parse;
use crate::formats::sexagesimal::sexagesimal;
use crate::formats::sights::Equinox;
use crate::formats::{ColumnName, clipped};

/// A degree and an hour of angle, rad.
pub(super) const DEGREE: f64 = std::f64::consts::PI / 180.0;
pub(super) const HOUR: f64 = 15.0 * DEGREE;

/// What a table does not say.
pub(super) struct Lack(pub String);

/// The equinox of what was read and of what was seen.
pub(super) fn equinoxes(
    roles: &Roles,
    rows: &Rows,
    comments: &str,
    remarks: &mut Vec<String>,
) -> Result<[Equinox; 2], Lack> {
    let common = match roles.equinox {
        None => said(comments, &["equinox", "epoch"]),
        Some(at) => {
            let own = rows.column(at);
            if own.iter().any(|cell| Some(cell) != own.first()) {
                return Err(Lack(format!("column `{}` has several equinoxes", rows.names[at])));
            }
            own.first().cloned()
        }
    };
    let common =
        match &common {
            None => None,
            Some(text) => Some(equinox(text).ok_or_else(|| {
                Lack(format!("the equinox `{}` is neither J2000 nor of date", clipped(text)))
            })?),
        };
    let of = |place: Place| place.equinox.or(common);
    let (read, seen) = (of(roles.read), roles.seen.map_or(of(roles.read), of));
    match (read, seen) {
        (Some(read), Some(seen)) => {
            remarks.push(format!(
                "equinox: {} of the mount, {} of the plate solve",
                read.name(),
                seen.name()
            ));
            if [read, seen].contains(&Equinox::J2000) {
                remarks.push("J2000 becomes the apparent place of date by precession (IAU 2006), nutation and aberration".to_owned());
            }
            Ok([read, seen])
        }
        (None, None) => {
            remarks.push("no column says an equinox: both sides are taken as of date; if they are of J2000, write J2000 into their names".to_owned());
            Ok([Equinox::Date; 2])
        }
        (read, _) => {
            let place = if read.is_none() { roles.read } else { roles.seen.unwrap_or(roles.read) };
            let name = &rows.names[place.ra];
            Err(Lack(format!(
                "the equinox of `{}` is not said, and that of the other side is: write J2000 or JNow into its name",
                clipped(name)
            )))
        }
    }
}

/// The unit of right ascensions, rad: what the header says, hours where cells have minutes, degrees where they reach beyond 24.
pub(super) fn unit(rows: &Rows, column: usize) -> Result<f64, Lack> {
    if let Some(unit) = stated(rows, column)? {
        return Ok(unit);
    }
    let cells = rows.column(column);
    let numbers: Vec<f64> = cells.iter().filter_map(|cell| parse(cell.trim(), b'\n')).collect();
    if numbers.len() < cells.len() {
        return Ok(HOUR);
    }
    if numbers.iter().any(|number| number.abs() > 24.0) {
        return Ok(DEGREE);
    }
    let name = clipped(&rows.names[column]);
    Err(Lack(format!(
        "are the numbers of `{name}` hours or degrees? write `{name} [hour]` or `{name} [deg]`"
    )))
}

/// The unit of sidereal times: hours, unless the header says something else.
pub(super) fn sidereal_unit(rows: &Rows, column: usize) -> Result<f64, Lack> {
    Ok(stated(rows, column)?.unwrap_or(HOUR))
}

/// The unit of an angle that the header says; `h` is the hour of right ascensions.
fn stated(rows: &Rows, column: usize) -> Result<Option<f64>, Lack> {
    let name = &rows.names[column];
    let lower = name.to_lowercase();
    if ["[h]", "(h)", "[hours]", "(hours)", "[hms]", "(hms)"].iter().any(|unit| lower.ends_with(unit)) {
        return Ok(Some(HOUR));
    }
    let unit = ColumnName::parse(name)
        .said(Some(Measures::Angle))
        .map_err(|why| Lack(format!("`{}`: {why}", clipped(name))))?;
    Ok(unit.filter(|unit| unit.measures() == Measures::Angle).map(|unit| unit.in_si()))
}

/// What a comment says of one of some names: `# latitude = 48.5`.
pub(super) fn said(comments: &str, names: &[&str]) -> Option<String> {
    comments.lines().find_map(|line| {
        let (name, value) = line.trim_start_matches('#').split_once(['=', ':'])?;
        let name = name.trim().to_lowercase();
        names.contains(&name.as_str()).then(|| value.trim().to_owned())
    })
}

/// Degrees of a latitude or a longitude, with a letter of the side behind it or without.
pub(super) fn degrees(text: &str) -> Option<f64> {
    let text = text.trim().trim_end_matches("deg").trim();
    let (text, sign) = match text.chars().last()? {
        'N' | 'E' | 'n' | 'e' => (text.get(..text.len() - 1)?, 1.0),
        'S' | 'W' | 'w' => (text.get(..text.len() - 1)?, -1.0),
        _ => (text, 1.0),
    };
    let text = text.trim().trim_end_matches('°');
    let number = parse(text, b'\n').or_else(|| sexagesimal(text, DEGREE))?;
    (number.abs() <= 360.0).then_some(sign * number)
}
