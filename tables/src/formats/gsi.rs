//! GSI, the lines that instruments of Leica write: GSI-8 and GSI-16, directions and distances to points.
//!
//! A line with a horizontal and a vertical angle (words 21 and 22) is a row. A line that gives a point's coordinates (81 to 83) without
//! angles places that point, and one that gives a station's (84 to 86) begins a station. Coordinates beside angles were computed of these by
//! the instrument: they are no truth, and are not read.

mod words;

use std::collections::BTreeMap;

use super::error::clipped;
use super::held::Held;
use super::{DataError, Options, WholeFile};
use words::Word;

pub(super) const FORM: WholeFile = WholeFile { name: "GSI of Leica", looks, read };

/// A row before it is known whether all points are placed.
struct Row {
    line: u64,
    point: String,
    station: String,
    hz_deg: f64,
    zenith_deg: f64,
    distance_m: Option<f64>,
}

/// The words that are read.
const READ: [&str; 11] = ["11", "16", "21", "22", "31", "81", "82", "83", "84", "85", "86"];

/// Whether a word is one that is read, by its index.
fn is_read(word: &str) -> bool {
    word.get(..2).is_some_and(|index| READ.contains(&index))
}

/// Whether the first line begins with a word.
fn looks(text: &str) -> bool {
    let line = text.lines().map(str::trim).find(|line| !line.is_empty()).unwrap_or_default();
    let word = line.strip_prefix('*').unwrap_or(line).split_whitespace().next().unwrap_or_default();
    let letters = word.as_bytes();
    matches!(letters.get(..2), Some(index) if index.iter().all(u8::is_ascii_digit))
        && letters
            .get(2..6)
            .is_some_and(|info| info.iter().all(|letter| letter.is_ascii_digit() || *letter == b'.'))
        && matches!(letters.get(6), Some(b'+' | b'-'))
        && word.len() > 7
}

/// Reads a file.
///
/// # Errors
/// A line that is none of GSI, with its number; no line with angles.
fn read(text: &str, source: &str, _: &Options) -> Result<Held, DataError> {
    let mut rows: Vec<Row> = Vec::new();
    let mut placed: BTreeMap<String, [f64; 3]> = BTreeMap::new();
    let (mut station, mut is_in_feet, mut is_computed, mut alone) = (String::new(), false, false, 0);
    for (line, text) in (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty()) {
        let bad = |why: String| DataError::BadLine { file: source.to_owned(), line, why };
        let words: Vec<Word<'_>> = text
            .strip_prefix('*')
            .unwrap_or(text)
            .split_whitespace()
            .map(Word::of)
            .zip(text.split_whitespace())
            // Codes and remarks may hold blanks and letters of any kind, and nothing of them is read.
            .filter(|(word, text)| word.is_ok() || is_read(text.trim_start_matches('*')))
            .map(|(word, _)| word)
            .collect::<Result<_, _>>()
            .map_err(bad)?;
        if words.first().is_some_and(|word| word.index == "41") {
            continue;
        }
        let word = |index: &str| words.iter().find(|word| word.index == index);
        let length = |index: &str| word(index).map(|word| word.length_m().map_err(bad)).transpose();
        is_in_feet |= words.iter().any(|word| {
            matches!(word.index, "31" | "81" | "82" | "83" | "84" | "85" | "86") && word.is_in_feet()
        });
        let point = word("11").map(|word| word.label().to_owned());
        if let Some(own) = word("16") {
            own.label().clone_into(&mut station);
        } else if let (Some(point), Some(_)) = (&point, word("84")) {
            station.clone_from(point);
        }
        let place = match [length("81")?, length("82")?, length("83")?] {
            [Some(east), Some(north), Some(height)] => Some([east, north, height]),
            _ => None,
        };
        match (word("21"), word("22")) {
            (Some(hz), Some(zenith)) => {
                is_computed |= place.is_some();
                rows.push(Row {
                    line,
                    point: point.unwrap_or_default(),
                    station: station.clone(),
                    hz_deg: hz.angle_deg().map_err(bad)?,
                    zenith_deg: zenith.angle_deg().map_err(bad)?,
                    distance_m: length("31")?,
                });
            }
            (None, None) => {
                if let (Some(point), Some(place)) = (point, place) {
                    placed.insert(point, place);
                }
            }
            (Some(_), None) | (None, Some(_)) => alone += 1,
        }
    }
    if rows.is_empty() {
        let why = "no line has a horizontal and a vertical angle (words 21 and 22): coordinates alone, and readings of a level, hold nothing \
                   to calibrate an instrument of angles with";
        return Err(DataError::Unreadable { file: source.to_owned(), why: why.to_owned() });
    }
    let is_placed = rows.iter().all(|row| placed.contains_key(&row.point));
    let has_stations = rows.iter().any(|row| !row.station.is_empty());
    let mut names = vec!["point", "hz_deg", "zenith_deg", "distance [m]"];
    names.extend(has_stations.then_some("station"));
    names.extend(["x [m]", "y [m]", "z [m]"].into_iter().filter(|_| is_placed));
    let mut held = Held::new(source, &names);
    for row in &rows {
        let mut cells = vec![
            row.point.clone(),
            row.hz_deg.to_string(),
            row.zenith_deg.to_string(),
            row.distance_m.map_or_else(String::new, |distance| distance.to_string()),
        ];
        cells.extend(has_stations.then(|| row.station.clone()));
        if is_placed && let Some(place) = placed.get(&row.point) {
            cells.extend(place.iter().map(f64::to_string));
        }
        held.push(Some(row.line), cells);
    }
    let measured = rows.len();
    held.remarks.push(format!(
        "{source} is GSI of Leica: {measured} lines with angles, from north clockwise and from the zenith{}",
        if is_placed { ", to points whose coordinates it gives" } else { "" }
    ));
    if alone > 0 {
        held.remarks.push(format!("{alone} lines have one angle of the two, and are left out"));
    }
    if is_computed {
        held.remarks.push(
            "coordinates beside angles (words 81 to 83) were computed of these angles by the instrument, and are not read as the truth"
                .to_owned(),
        );
    }
    if !is_placed
        && let Some(row) =
            rows.iter().find(|row| !placed.contains_key(&row.point)).filter(|_| !placed.is_empty())
    {
        held.remarks.push(format!(
            "the file gives coordinates of {} points, but none of point `{}`: all points count as unknown",
            placed.len(),
            clipped(&row.point)
        ));
    }
    if is_in_feet {
        held.remarks.push("feet are taken as international feet of 0.3048 m".to_owned());
    }
    Ok(held)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::{Form as As, TableReader as _, Wanted};

    fn table(text: &str) -> Result<(Vec<String>, Vec<String>), String> {
        let mut held = read(text, "f.gsi", &Options::default()).map_err(|error| error.to_string())?;
        let names: Vec<String> = held.header().iter().map(|name| name.full.clone()).collect();
        let wanted: Vec<Wanted> = (0..names.len()).map(|column| Wanted { column, form: As::Label }).collect();
        let chunk = held.read(&wanted, usize::MAX).map_err(|error| error.to_string())?;
        let cells = chunk.columns.into_iter().flat_map(|cells| match cells {
            crate::formats::Cells::Labels(labels) => labels,
            _ => Vec::new(),
        });
        Ok((names, cells.collect()))
    }

    #[test]
    fn lines_become_rows_with_stations_and_places() {
        let text = "410001+00000012 42....+00001810\r\n\
                    110002+0000S001 84..10+00000000 85..10+00000000 86..10+00000000 88..10+00001500\r\n\
                    110003+0000A001 81..00+00010000 82..00+00020000 83..00-00001000\r\n\
                    110004+0000A001 21.102+10000000 22.102+09000000 31..00+00022383 51....+0000+000\r\n";
        assert!(looks(text));
        let names = ["point", "hz_deg", "zenith_deg", "distance [m]", "station", "x [m]", "y [m]", "z [m]"];
        let cells = ["A001", "90.00000000000001", "81", "22.383", "S001", "10", "20", "-1"];
        let (found, rows) = table(text).unwrap_or_default();
        assert_eq!(found, names);
        assert_eq!(rows.len(), cells.len());
        for (found, expected) in rows.iter().zip(cells) {
            let near = |one: &str| one.parse::<f64>().ok();
            let same = match (near(found), near(expected)) {
                (Some(one), Some(other)) => (one - other).abs() < 1e-9,
                _ => found == expected,
            };
            assert!(same, "{rows:?}");
        }
    }

    #[test]
    fn wide_words_are_read_alike_and_points_without_places_are_unknown() {
        let text = "*110001+000000000PNC0055 21.002+0000000013384650 22.002+0000000005371500 81..00+0000000000012000 \
                    82..00+0000000000012000 83..00+0000000000012000\n";
        assert!(looks(text));
        let (names, rows) = table(text).unwrap_or_default();
        assert_eq!(names, ["point", "hz_deg", "zenith_deg", "distance [m]"]);
        assert_eq!(rows[0], "PNC0055");
        assert_eq!(rows[3], "");
    }

    #[test]
    fn codes_with_blanks_and_other_letters_are_passed_over() {
        let text = "110001+0000A001 21.102+10000000 22.102+09000000 31..00+00022383 71....+00B\u{e4}um 3\n\
                    410002+0000TREE big one\n110003+0000A001 21.102+10000000\n";
        let (_, rows) = table(text).unwrap_or_default();
        assert_eq!((rows.len(), rows.first().map(String::as_str)), (4, Some("A001")));
        let held = read(text, "f.gsi", &Options::default());
        assert!(
            held.is_ok_and(|held| held
                .remarks
                .iter()
                .any(|remark| remark.contains("1 lines have one angle")))
        );
    }

    #[test]
    fn what_is_wrong_has_its_line() {
        for (text, why) in [
            ("110001+00000001 21.102+1000", "line 1: `21.102+1000` is no word of GSI"),
            (
                "110001+00000001\n110002+00000001 21.104+12360000 22.104+09000000\n",
                "line 2: `12360000` has 60 minutes",
            ),
            ("110001+00000001 81..00+00010000 82..00+00020000 83..00-00001000\n", "no line has a horizontal"),
        ] {
            assert!(table(text).is_err_and(|said| said.contains(why)), "{text}");
        }
        for text in ["", "point,hz\n", "11,12\n", "+1\n", "12345678\n", "2026-11-27 23:00:00\n"] {
            assert!(!looks(text), "{text}");
        }
    }
}
