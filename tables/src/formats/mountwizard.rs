//! Models of MountWizzard4: a JSON list of points, each with what the mount said and what the plate solve found.
//!
//! Source: M. Würtenberger, MountWizzard4, `generateSaveData`: right ascensions and the sidereal time in hours, declinations in degrees,
//! all of date (`raJNowM`, `decJNowM` of the mount, `raJNowS`, `decJNowS` solved), `pierside` E or W, and the latitude in degrees. Its
//! `decJ2000S` was written in radians by some versions, in degrees by others: it is not read.

use serde_json::Value;

use super::held::Held;
use super::sights::{NAMES, PIER_REMARK, Sight, ha_deg, pier};
use super::{DataError, Options, WholeFile, clipped};

pub(super) const FORM: WholeFile = WholeFile { name: "a model of MountWizzard4", looks, read };

/// Keys of a point by which a model is known.
const KEYS: [&str; 2] = ["\"raJNowM\"", "\"siderealTime\""];

fn looks(text: &str) -> bool {
    text.trim_start().starts_with('[') && KEYS.iter().all(|key| text.contains(key))
}

/// Reads a file.
///
/// # Errors
/// It is no JSON, with the line; or a point lacks something, with its number.
fn read(text: &str, source: &str, _: &Options) -> Result<Held, DataError> {
    let file = || source.to_owned();
    let points: Vec<Value> = serde_json::from_str(text).map_err(|error| DataError::BadLine {
        file: file(),
        line: error.line() as u64,
        why: format!(
            "this is no JSON list, as MountWizzard4 writes its models: {}",
            clipped(&error.to_string())
        ),
    })?;
    let mut held = Held::new(source, &NAMES);
    for (row, point) in (1..).zip(&points) {
        let bad = |why: String| DataError::Impossible { file: file(), line: None, row, why };
        let number = |key: &str, most: f64| {
            let value = point.get(key).and_then(Value::as_f64).filter(|value| value.abs() <= most);
            value.ok_or_else(|| {
                bad(format!(
                    "`{key}` is no number from -{most} to {most}: was the model saved by MountWizzard4?"
                ))
            })
        };
        let sidereal_hours = number("siderealTime", 24.0)?;
        let place = |ra: &str, dec: &str| {
            Ok::<_, DataError>(Some([ha_deg(sidereal_hours, number(ra, 24.0)?), number(dec, 90.0)?]))
        };
        let side = point.get("pierside").and_then(Value::as_str).unwrap_or_default();
        let side = pier(side)
            .ok_or_else(|| bad(format!("`pierside` is `{}`: write \"E\" or \"W\"", clipped(side))))?;
        let sight = Sight {
            truth_deg: place("raJNowS", "decJNowS")?,
            read_deg: place("raJNowM", "decJNowM")?,
            pier: Some(side),
        };
        held.push(None, sight.cells().map(|cell| cell.map_or_else(String::new, |cell| cell.to_string())));
        let latitude = point.get("latitude").and_then(Value::as_f64).filter(|degrees| degrees.abs() <= 90.0);
        held.latitude_deg = held.latitude_deg.or(latitude);
    }
    if held.rows() == 0 {
        return Err(DataError::NoRows { file: file() });
    }
    held.remarks.push(format!(
        "{source} is a model of MountWizzard4: {} points, all coordinates of date{}",
        held.rows(),
        if held.latitude_deg.is_some() { ", with the latitude of the site" } else { "" }
    ));
    held.remarks.push(PIER_REMARK.to_owned());
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::TableReader as _;

    const POINT: &str = "[{\"raJNowM\": 4.0, \"decJNowM\": 20.0, \"raJNowS\": 4.001, \"decJNowS\": 20.01, \"siderealTime\": 6.0,\n\
                         \"pierside\": \"W\", \"latitude\": 48.5}]";

    #[test]
    fn points_become_sights() {
        assert!(looks(POINT) && !looks("{}") && !looks("[1]"));
        let held = read(POINT, "m.model", &Options::default());
        assert_eq!(held.map(|held| (held.rows(), held.latitude_deg())), Ok((1, Some(48.5))));
    }

    #[test]
    fn what_is_wrong_has_its_place() {
        for (from, to, why) in [
            ("\"W\"", "\"up\"", "row 1: `pierside` is `up`"),
            ("4.001", "\"x\"", "row 1: `raJNowS` is no number"),
            ("20.0,", "120.0,", "row 1: `decJNowM` is no number from -90 to 90"),
            ("}]", "", "line 2: this is no JSON list"),
        ] {
            let text = POINT.replace(from, to);
            let said = read(&text, "m.model", &Options::default()).map_err(|error| error.to_string());
            assert!(said.as_ref().is_err_and(|said| said.contains(why)), "{said:?}");
        }
        assert!(read("[]", "m.model", &Options::default()).is_err());
    }
}
