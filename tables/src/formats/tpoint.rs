//! TPOINT's observation files: a caption, options (`:ALTAZ`, `:EQUAT`, …), the site, and a record an observation.
//!
//! What a line says is the business of `lines`. A declination read beyond 90° is through the pole. The columns are those of the table
//! below, as if a header had named them.
//!
//! | option | columns |
//! |---|---|
//! | `:EQUAT` | `true_ha_deg`, `true_dec_deg`, `encoder_ha_deg`, `encoder_dec_deg`, `pier_side` |
//! | `:ALTAZ` | `true_az_deg`, `true_el_deg`, `encoder_az_deg`, `encoder_el_deg`; right ascensions are turned into these |

mod lines;

use super::held::Held;
use super::{DataError, Options, WholeFile};
use lines::{Mount, latitude_deg, record};

pub(super) const FORM: WholeFile = WholeFile { name: "observations of TPOINT", looks, read };

const EQUATORIAL: &[&str] =
    &["true_ha_deg", "true_dec_deg", "encoder_ha_deg", "encoder_dec_deg", "pier_side"];
const ALT_AZIMUTH: &[&str] = &["true_az_deg", "true_el_deg", "encoder_az_deg", "encoder_el_deg"];

/// Options by which a file is known.
///
/// Source: P. T. Wallace, TPOINT, a telescope pointing analysis system (2011): `INDAT`.
const OPTIONS: [&str; 4] = ["EQUAT", "ALTAZ", "NODA", "ALLSKY"];

/// Whether one of the first lines below a caption is an option.
fn looks(text: &str) -> bool {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('!'));
    let mut below = lines.skip(1).take(10).filter_map(|line| line.strip_prefix(':'));
    below.any(|option| OPTIONS.iter().any(|known| option.trim().eq_ignore_ascii_case(known)))
}

/// Reads a file.
///
/// # Errors
/// A line that the format does not allow, with its number; an empty file.
fn read(text: &str, source: &str, _: &Options) -> Result<Held, DataError> {
    let file = || source.to_string();
    let mut lines =
        (1..).zip(text.lines().map(str::trim)).filter(|(_, line)| !line.is_empty() && !line.starts_with('!'));
    let (first, caption) = lines.next().ok_or_else(|| DataError::Empty { file: file() })?;
    let bad = |line: u64, why: String| DataError::BadLine { file: file(), line, why };
    if caption.starts_with(':') {
        return Err(bad(
            first,
            "the first line is the caption, and this is an option: write a caption above it".into(),
        ));
    }
    // The line that says it, if one does.
    let mut mount: Option<(Mount, Option<u64>)> = None;
    let (mut site, mut records) = (None, Vec::new());
    for (line, text) in lines {
        if let Some(option) = text.strip_prefix(':') {
            let Some(own) = Mount::of_option(option.trim()) else { continue };
            match mount {
                Some((other, said)) if other != own => {
                    let where_said = said.map_or_else(
                        || "the records above are equatorial".to_owned(),
                        |said| format!("line {said} says `:{}`", other.option()),
                    );
                    let why = format!("`:{}`, while {where_said}: write a file for each mount", own.option());
                    return Err(bad(line, why));
                }
                Some(_) => {}
                None => mount = Some((own, Some(line))),
            }
            continue;
        }
        if text.eq_ignore_ascii_case("END") {
            break;
        }
        let words: Vec<&str> = text.split_whitespace().collect();
        let Some(latitude) = site else {
            site = Some(latitude_deg(&words).map_err(|why| bad(line, why))?);
            continue;
        };
        let (own, _) = *mount.get_or_insert((Mount::Equatorial, None));
        records.push((line, record(own, latitude, &words).map_err(|why| bad(line, why))?));
    }
    let names = match mount {
        Some((Mount::AltAzimuth, _)) => ALT_AZIMUTH,
        _ => EQUATORIAL,
    };
    let mut held = Held::new(source, names);
    held.latitude_deg = site;
    if names == EQUATORIAL && never_changes_sides(&records) {
        held.remarks.push(format!(
            "{source}: no row is on the far side of the pier, as no declination is read beyond the pole. If the mount changed sides at the \
             meridian, give the rows as a table with a column for the side."
        ));
    }
    for (line, values) in records {
        held.push(Some(line), values.iter().map(f64::to_string));
    }
    Ok(held)
}

/// Whether hour angles are on both sides of the meridian, and no declination is read through the pole: a mount that changes sides
/// there would have done so.
fn never_changes_sides(records: &[(u64, Vec<f64>)]) -> bool {
    let column = |at: usize| records.iter().filter_map(move |(_, values)| values.get(at).copied());
    column(4).all(|side| side > 0.0) && column(2).any(|ha| ha < 0.0) && column(2).any(|ha| ha > 0.0)
}

#[cfg(test)]
mod tests {
    use crate::formats::{Cells, Form, TableReader, Wanted, open};

    use super::{DataError, Options};

    fn opened(text: &str) -> Result<Box<dyn TableReader + '_>, DataError> {
        open(text.as_bytes(), "run.dat", &Options::default())
    }

    fn read(text: &str) -> Result<Vec<Vec<f64>>, DataError> {
        let mut reader = opened(text)?;
        let wanted: Vec<Wanted> =
            (0..reader.header().len()).map(|column| Wanted { column, form: Form::Number(1.0) }).collect();
        let chunk = reader.read(&wanted, usize::MAX)?;
        let numbers = chunk.columns.into_iter().map(|cells| match cells {
            Cells::Numbers(numbers) => numbers,
            Cells::Labels(_) | Cells::Kept(_) => Vec::new(),
        });
        Ok(numbers.collect())
    }

    #[test]
    fn equatorial_records_become_hour_angles() {
        // Sidereal time 6 h: a star at right ascension 4 h has passed the meridian by 30°.
        let columns = read(
            "! made by hand\nCaption\n:NODA\n:EQUAT\n+48 30 00 2026 1 1\n\
             04 00 00 +20 30 00  04 00 04 +20 30 36  6 00\n\
             08 00 00 -00 30 00  20 00 00 -179 30 00  6 0.0\nEND\nnot read\n",
        );
        let expected = [[30.0, -30.0], [20.5, -0.5], [30.0 - 1.0 / 60.0, -30.0], [20.51, -0.5], [1.0, -1.0]];
        let columns = columns.unwrap_or_default();
        assert_eq!(columns.len(), 5);
        for (column, expected) in columns.iter().zip(expected) {
            for (value, expected) in column.iter().zip(expected) {
                assert!((value - expected).abs() < 1e-9, "{columns:?}");
            }
        }
    }

    #[test]
    fn alt_azimuth_records_are_degrees() {
        let columns = read("Caption\n: ALLSKY\n: ALTAZ\n 31 41 19.6\n 10.5 40.25 10.51 40.26\n");
        assert_eq!(columns, Ok(vec![vec![10.5], vec![40.25], vec![10.51], vec![40.26]]));
    }

    #[test]
    fn alt_azimuth_records_may_be_degrees_minutes_seconds() {
        let columns = read("Caption\n:ALTAZ\n31 41 19.6\n10 30 00 40 15 00 10 30 36 -40 15 36\n");
        assert_eq!(columns, Ok(vec![vec![10.5], vec![40.25], vec![10.51], vec![-40.26]]));
    }

    /// A star on the meridian is as high as it is there; six hours later it is where the pole's height has it.
    #[test]
    fn right_ascensions_of_an_alt_azimuth_mount_become_azimuths_and_elevations() {
        let columns = read(
            "Caption\n: ALTAZ\n30 00 00 2026 01 10 1.63 629.68 4111.00 0.422 850.000\n\
             06 00 00 +20 00 00 06 00 00 +20 00 00 06 0.00000 85.342 56.197 SCUBA 0.00\n\
             00 00 00 +20 00 00 00 00 00 -20 00 00 06 00.0\n",
        );
        let columns = columns.unwrap_or_default();
        let rise = (20f64.to_radians().sin() * 0.5).asin().to_degrees();
        // tan A = cos δ / (sin δ cos φ), westwards of north.
        let west =
            360.0 - (20f64.to_radians().cos()).atan2(20f64.to_radians().sin() * 0.75f64.sqrt()).to_degrees();
        let south =
            360.0 - (20f64.to_radians().cos()).atan2(-20f64.to_radians().sin() * 0.75f64.sqrt()).to_degrees();
        let expected = [[180.0, west], [80.0, rise], [180.0, south], [80.0, -rise]];
        assert_eq!(columns.len(), 4);
        for (column, expected) in columns.iter().zip(expected) {
            for (value, expected) in column.iter().zip(expected) {
                assert!((value - expected).abs() < 1e-9, "{columns:?}");
            }
        }
    }

    #[test]
    fn the_site_is_kept_and_what_stands_behind_the_sidereal_time_is_not_read() {
        let text = "Caption\n:EQUAT\n-19 49 30.0 2009 01 29 -2.25 621.00 4120.00 0.827 866.963\n\
                    09 48 29.174 +13 14 02.63 09 48 35.756 +13 15 09.01 08 12.04958 4.760 108.775 HARPB 0.00\n";
        assert_eq!(opened(text).map(|reader| reader.latitude_deg()).ok(), Some(Some(-19.825)));
        assert!(read(text).is_ok());
    }

    #[test]
    fn a_side_of_the_pier_that_nothing_says_is_remarked_on() {
        let remarks = |records: &str| {
            let text = format!("Caption\n48 0 0\n{records}");
            opened(&text).map_or(0, |reader| reader.remarks().len())
        };
        let east = "08 00 00 +20 00 00 08 00 00 +20 00 00 06 00.0\n";
        let west = "04 00 00 +20 00 00 04 00 00 +20 00 00 06 00.0\n";
        let through = "16 00 00 +20 00 00 04 00 00 +160 00 00 06 00.0\n";
        assert_eq!(remarks(&format!("{east}{west}")), 1);
        assert_eq!(remarks(&format!("{east}{west}{through}")), 0);
        assert_eq!(remarks(east), 0);
        assert_eq!(remarks(""), 0);
    }

    #[test]
    fn each_malformed_file_is_refused_with_line_and_reason() {
        const SITE: &str = "48 30 00 2026 03 14\n";
        const RECORD: &str = "04 00 00 +20 30 00 04 00 04 +20 30 36 06 00.00\n";
        let equatorial = |record: &str| format!("Caption\n:EQUAT\n{SITE}{RECORD}{record}\n");
        let alt_azimuth = |record: &str| format!("Caption\n:ALTAZ\n{SITE}{record}\n");
        let site = |site: &str| format!("Caption\n:EQUAT\n{site}\n{RECORD}");
        let cases = [
            (String::new(), "is empty"),
            (":ALTAZ\n48 0 0\n".to_owned(), "line 1: the first line is the caption"),
            // No site.
            (
                "Caption\n:ALTAZ\n10.5 40.25 10.51 40.26\n".to_owned(),
                "line 3: the site stands before the records",
            ),
            ("Caption\n:ALTAZ\n12 42 12.01 42.01\n".to_owned(), "line 3: the site stands before the records"),
            ("Caption\n:ALTAZ\n10 30 00 40 15 00 10 30 36 40 15 36\n".to_owned(), "line 3: `40 15 00`"),
            (format!("Caption\n:EQUAT\n{RECORD}"), "line 3: `+20 30 00`"),
            (site("latitude 48"), "line 3: the site stands before the records"),
            (site("48.5 0 0"), "line 3: `48.5` is no whole number"),
            (site("98 0 0"), "line 3: the latitude is 98"),
            (site("48 75 0"), "line 3: `75` minutes"),
            (site("48 30 0 2026 02 30"), "line 3: `2026 02 30`"),
            // Sexagesimal numbers.
            (equatorial("04 60 00 +20 30 00 04 00 04 +20 30 36 06 00.00"), "line 5: `60` minutes"),
            (equatorial("04 00 00 +20 -30 00 04 00 04 +20 30 36 06 00.00"), "line 5: `-30` minutes"),
            (equatorial("04 00 00 +20 30 -1 04 00 04 +20 30 36 06 00.00"), "line 5: `-1` seconds"),
            (equatorial("04 00 61 +20 30 00 04 00 04 +20 30 36 06 00.00"), "line 5: `61` seconds"),
            (equatorial("04 00 nan +20 30 00 04 00 04 +20 30 36 06 00.00"), "line 5: `nan` seconds"),
            (
                equatorial("4.5 00 00 +20 30 00 04 00 04 +20 30 36 06 00.00"),
                "line 5: `4.5` is no whole number",
            ),
            // What no sky has.
            (
                equatorial("40 00 00 +20 30 00 04 00 04 +20 30 36 06 00.00"),
                "line 5: the right ascension is 40",
            ),
            (
                equatorial("04 00 00 +20 30 00 204 00 04 +20 30 36 06 00.00"),
                "line 5: the right ascension as read is 204",
            ),
            (
                equatorial("-4 00 00 +20 30 00 04 00 04 +20 30 36 06 00.00"),
                "line 5: the right ascension is -4",
            ),
            (equatorial("04 00 00 +99 30 00 04 00 04 +20 30 36 06 00.00"), "line 5: the declination is 99"),
            (
                equatorial("04 00 00 +20 30 00 04 00 04 +181 0 0 06 00.00"),
                "line 5: the declination as read is 181",
            ),
            // The sidereal time.
            (
                equatorial("04 00 00 +20 30 00 04 00 04 +20 30 36"),
                "line 5: a record of right ascensions has 14 numbers",
            ),
            (
                equatorial("04 00 00 +20 30 00 04 00 04 +20 30 36 06 36 12"),
                "line 5: the sidereal time `06 36 12` has seconds",
            ),
            (equatorial("04 00 00 +20 30 00 04 00 04 +20 30 36 26 36.2"), "line 5: the sidereal time is 26"),
            (equatorial("04 00 00 +20 30 00 04 00 04 +20 30 36 06 60.0"), "line 5: `60.0` minutes"),
            (equatorial("04 00 00 +20 30 00 04 00 04 +20 30 36 06 -1.0"), "line 5: `-1.0` minutes"),
            // Azimuth and elevation.
            (alt_azimuth("04 00 00 +20 30 00 04 00 04 +20 30 36 06 60.0"), "line 4: `60.0` minutes"),
            (alt_azimuth("1 2 3"), "line 4: a record of `:ALTAZ` has 4 numbers"),
            (alt_azimuth("1 2 3 4 5"), "line 4: a record of `:ALTAZ` has 4 numbers"),
            (alt_azimuth("1 2 3 nan"), "line 4: `nan` is no number"),
            (alt_azimuth("1 95 3 4"), "line 4: the elevation is 95"),
            (alt_azimuth("1 2 400 4"), "line 4: the azimuth as read is 400"),
            (alt_azimuth("10 61 00 40 15 00 10 30 36 40 15 36"), "line 4: `61` minutes"),
            // Both mounts.
            (
                format!("Caption\n:EQUAT\n:ALTAZ\n{SITE}1 2 3 4\n"),
                "line 3: `:ALTAZ`, while line 2 says `:EQUAT`",
            ),
            (
                format!("Caption\n:ALTAZ\n{SITE}1 2 3 4\n:EQUAT\n{RECORD}"),
                "line 5: `:EQUAT`, while line 2 says",
            ),
            (
                format!("Caption\n{SITE}{RECORD}:ALTAZ\n1 2 3 4\n"),
                "line 4: `:ALTAZ`, while the records above are",
            ),
        ];
        for (text, said) in cases {
            let refused = read(&text).map_err(|error| error.to_string());
            assert!(refused.as_ref().is_err_and(|why| why.contains(said)), "{text}{said}: {refused:?}");
        }
    }

    proptest::proptest! {
        #[test]
        fn no_bytes_panic(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
            let _ = open(bytes.as_slice(), "run.dat", &Options::default());
        }

        /// Written out and read back, angles are what they were, and rows with other words are refused.
        #[test]
        fn degrees_minutes_seconds_are_read_as_written(
            azimuth in 0_u32..360 * 3600, elevation in -90 * 3600_i32..90 * 3600, spoiled in 0_usize..24, by in "[-a-z]{1,3}"
        ) {
            let dms = |seconds: i64| {
                let (sign, size) = (if seconds < 0 { "-" } else { "" }, seconds.abs());
                format!("{sign}{:02} {:02} {:02}", size / 3600, size / 60 % 60, size % 60)
            };
            let (azimuth, elevation) = (i64::from(azimuth), i64::from(elevation));
            let record = format!("{0} {1} {0} {1}", dms(azimuth), dms(elevation));
            let file = |record: &str| format!("Caption\n:ALTAZ\n48 0 0\n{record}\n");
            let columns = read(&file(&record)).unwrap_or_default();
            proptest::prop_assert_eq!(columns.len(), 4);
            for (column, seconds) in columns.iter().zip([azimuth, elevation, azimuth, elevation]) {
                proptest::prop_assert!((column[0] - seconds as f64 / 3600.0).abs() < 1e-12);
            }
            let mut words: Vec<&str> = record.split(' ').collect();
            if let Some(word) = words.get_mut(spoiled) {
                *word = &by;
                proptest::prop_assert!(read(&file(&words.join(" "))).is_err());
            }
        }
    }
}
