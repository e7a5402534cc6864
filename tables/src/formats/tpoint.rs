//! TPOINT's observation files: a caption, options (`:ALTAZ`, `:EQUAT`, …), the site, and a record an observation.
//!
//! Equatorial records: right ascension and declination of the star, the same as the telescope read them, and the local
//! sidereal time (h m); alt-azimuth records: azimuth and elevation, true and as read, in degrees. A declination read
//! beyond 90° is through the pole. The columns are those of the table below, as if a header had named them.
//!
//! | option | columns |
//! |---|---|
//! | `:EQUAT` | `true_ha_deg`, `true_dec_deg`, `encoder_ha_deg`, `encoder_dec_deg`, `pier_side` |
//! | `:ALTAZ` | `true_az_deg`, `true_el_deg`, `encoder_az_deg`, `encoder_el_deg` |
//!
//! Source: the format as the manual of TPOINT describes it (P. T. Wallace, TPOINT, a telescope pointing analysis system,
//! 2011), and as mount-control programs write it.

use std::io::Read;

use super::{Cell, Cells, Chunk, ColumnName, DataError, Form, Kept, Options, TableReader, Wanted};

const EQUATORIAL: &[&str] =
    &["true_ha_deg", "true_dec_deg", "encoder_ha_deg", "encoder_dec_deg", "pier_side"];
const ALT_AZIMUTH: &[&str] = &["true_az_deg", "true_el_deg", "encoder_az_deg", "encoder_el_deg"];

/// A TPOINT file, read whole: such files have hundreds of lines.
pub struct Reader {
    source: String,
    header: Vec<ColumnName>,
    /// Line and values of each record.
    records: Vec<(u64, Vec<f64>)>,
    next: usize,
}

impl Reader {
    /// Reads the file.
    ///
    /// # Errors
    /// A line that the format does not allow, with its number; an empty file.
    pub fn new(reader: impl Read, source: &str, options: &Options) -> Result<Self, DataError> {
        let file = || source.to_string();
        let bytes = super::whole(reader, source, options)?;
        // Captions may be in any code page; only they hold anything but ASCII.
        let text = String::from_utf8_lossy(&bytes);
        let lines = text.trim_start_matches('\u{feff}').lines();
        let mut lines =
            (1..).zip(lines.map(str::trim)).filter(|(_, line)| !line.is_empty() && !line.starts_with('!'));
        let (_, _caption) = lines.next().ok_or_else(|| DataError::Empty { file: file() })?;
        let mut equatorial = true;
        let mut site = None;
        let mut records = Vec::new();
        for (line, text) in lines {
            if let Some(option) = text.strip_prefix(':') {
                match option.trim().to_ascii_uppercase().as_str() {
                    "EQUAT" => equatorial = true,
                    "ALTAZ" => equatorial = false,
                    _ => {}
                }
                continue;
            }
            if text.eq_ignore_ascii_case("END") {
                break;
            }
            let bad = |why: &str| DataError::BadLine { file: file(), line, why: why.to_string() };
            if site.is_none() {
                site = Some(
                    sexagesimal(text, 0)
                        .ok_or_else(|| bad("expected the latitude: degrees, minutes, seconds"))?,
                );
                continue;
            }
            let record = if equatorial { equatorial_record(text) } else { alt_azimuth_record(text) };
            let expected = if equatorial {
                "expected right ascension and declination of the star (h m s, d m s), the same as read, and the sidereal time (h m)"
            } else {
                "expected azimuth and elevation, true and as read, in degrees"
            };
            records.push((line, record.ok_or_else(|| bad(expected))?));
        }
        let names = if equatorial { EQUATORIAL } else { ALT_AZIMUTH };
        let header = names.iter().map(|name| ColumnName::parse(name)).collect();
        Ok(Self { source: source.to_string(), header, records, next: 0 })
    }
}

impl TableReader for Reader {
    fn source(&self) -> &str {
        &self.source
    }

    fn header(&self) -> &[ColumnName] {
        &self.header
    }

    fn read(&mut self, wanted: &[Wanted], at_most: usize) -> Result<Chunk, DataError> {
        let end = self.next.saturating_add(at_most).min(self.records.len());
        let start = std::mem::replace(&mut self.next, end);
        let records = self.records.get(start..end).unwrap_or_default();
        let column = |want: &Wanted| {
            let values = records.iter().enumerate().map(|(at, (line, values))| {
                let number = values.get(want.column).copied().unwrap_or(f64::NAN);
                if number.is_finite() {
                    return Ok(number);
                }
                let cell = Cell {
                    file: self.source.clone(),
                    line: Some(*line),
                    row: (start + at + 1) as u64,
                    column: self.header.get(want.column).map_or_else(String::new, |name| name.full.clone()),
                };
                Err(DataError::NotFinite { cell, text: number.to_string() })
            });
            let texts = |value: Result<f64, DataError>| value.map(|value| value.to_string());
            match want.form {
                Form::Number(factor) => values
                    .map(|value| value.map(|value| value * factor))
                    .collect::<Result<_, _>>()
                    .map(Cells::Numbers),
                Form::Label => values.map(texts).collect::<Result<_, _>>().map(Cells::Labels),
                Form::Kept => {
                    let texts = values.map(texts).collect::<Result<_, _>>();
                    texts.map(|texts| Cells::Kept(Kept::Texts(texts)))
                }
            }
        };
        let columns = wanted.iter().map(column).collect::<Result<_, _>>()?;
        let lines = records.iter().map(|(line, _)| *line).collect();
        Ok(Chunk { columns, rows: (start + 1..=end).map(|row| row as u64).collect(), lines })
    }
}

/// Three words from `first` on as degrees (or hours), minutes and seconds; the sign is the first word's, of zero too.
fn sexagesimal(text: &str, first: usize) -> Option<f64> {
    let mut words = text.split_whitespace().skip(first);
    let whole = words.next()?;
    let minutes: f64 = words.next()?.parse().ok()?;
    let seconds: f64 = words.next()?.parse().ok()?;
    let size = whole.parse::<f64>().ok()?.abs() + minutes / 60.0 + seconds / 3600.0;
    Some(if whole.starts_with('-') { -size } else { size })
}

fn equatorial_record(text: &str) -> Option<Vec<f64>> {
    let mut time = text.split_whitespace().skip(12);
    let hours: f64 = time.next()?.parse().ok()?;
    let minutes: f64 = time.next()?.parse().ok()?;
    let sidereal_hours = hours + minutes / 60.0;
    let ha = |right_ascension_hours: f64| 15.0 * (sidereal_hours - right_ascension_hours);
    let (true_ha, true_dec) = (ha(sexagesimal(text, 0)?), sexagesimal(text, 3)?);
    let (read_ha, read_dec) = (ha(sexagesimal(text, 6)?), sexagesimal(text, 9)?);
    let through_pole = read_dec.abs() > 90.0;
    let (read_ha, read_dec) = if through_pole {
        (read_ha + 180.0, 180f64.copysign(read_dec) - read_dec)
    } else {
        (read_ha, read_dec)
    };
    Some(vec![folded(true_ha), true_dec, folded(read_ha), read_dec, if through_pole { -1.0 } else { 1.0 }])
}

fn alt_azimuth_record(text: &str) -> Option<Vec<f64>> {
    let values: Vec<f64> = text.split_whitespace().take(4).map_while(|word| word.parse().ok()).collect();
    (values.len() == 4).then_some(values)
}

/// An angle in degrees, between −180 and 180.
fn folded(degrees: f64) -> f64 {
    degrees - 360.0 * (degrees / 360.0).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<Vec<f64>>, DataError> {
        let mut reader = Reader::new(text.as_bytes(), "run.dat", &Options::default())?;
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
    fn what_is_wrong_is_named_with_its_line() {
        let message = |text| read(text).map_err(|error| error.to_string());
        insta::assert_debug_snapshot!([
            message(""),
            message("Caption\n:EQUAT\nlatitude 48\n"),
            message("Caption\n:ALTAZ\n48 0 0\n1 2 3\n"),
            message("Caption\n48 0 0\n04 00 00 +20 30 00  04 00 04 +20 30 36\n"),
            message("Caption\n:ALTAZ\n48 0 0\n1 2 3 nan\n"),
        ]);
    }

    proptest::proptest! {
        #[test]
        fn no_bytes_panic(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
            let _ = Reader::new(bytes.as_slice(), "run.dat", &Options::default());
        }
    }
}
