//! Instants, days and times of day, which Parquet holds as whole numbers: no numbers to compute with, and texts of any size.

use ::parquet::basic::{ConvertedType, LogicalType, TimeUnit};
use ::parquet::schema::types::Type;

use super::cells::Values;

const SECONDS_OF_DAY: i64 = 86_400;

/// What the whole numbers of a column count.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Time {
    /// Days since 1970-01-01.
    Day,
    /// Parts of a second since midnight, so many a second.
    OfDay { parts: i64 },
    /// Parts of a second since 1970-01-01, of a clock that shows UTC or of nobody knows which.
    Moment { parts: i64, is_utc: bool },
}

impl Time {
    /// What a column counts, if it is time.
    pub fn of(column: &Type) -> Option<Self> {
        let info = column.get_basic_info();
        let parts = |unit: &TimeUnit| match unit {
            TimeUnit::MILLIS => 1_000,
            TimeUnit::MICROS => 1_000_000,
            TimeUnit::NANOS => 1_000_000_000,
        };
        match (info.logical_type_ref(), info.converted_type()) {
            (Some(LogicalType::Timestamp(own)), _) => {
                Some(Self::Moment { parts: parts(&own.unit), is_utc: own.is_adjusted_to_u_t_c })
            }
            (Some(LogicalType::Time(own)), _) => Some(Self::OfDay { parts: parts(&own.unit) }),
            (Some(LogicalType::Date), _) | (_, ConvertedType::DATE) => Some(Self::Day),
            (_, ConvertedType::TIMESTAMP_MILLIS) => Some(Self::Moment { parts: 1_000, is_utc: true }),
            (_, ConvertedType::TIMESTAMP_MICROS) => Some(Self::Moment { parts: 1_000_000, is_utc: true }),
            (_, ConvertedType::TIME_MILLIS) => Some(Self::OfDay { parts: 1_000 }),
            (_, ConvertedType::TIME_MICROS) => Some(Self::OfDay { parts: 1_000_000 }),
            _ => None,
        }
    }

    /// `2026-11-21 20:00:00.123 +00:00`; the offset only where the clock is known to show UTC.
    pub fn text(self, count: i64) -> String {
        match self {
            Self::Day => day(count),
            Self::OfDay { parts } => of_day(count, parts),
            Self::Moment { parts, is_utc } => {
                let of_a_day = SECONDS_OF_DAY * parts;
                let (days, rest) = (count.div_euclid(of_a_day), count.rem_euclid(of_a_day));
                let offset = if is_utc { " +00:00" } else { "" };
                format!("{} {}{offset}", day(days), of_day(rest, parts))
            }
        }
    }

    /// The whole number at a place, if values are some.
    pub fn count(values: &Values, at: usize) -> Option<i64> {
        match values {
            Values::Int32(values) => values.get(at).map(|&count| count.into()),
            Values::Int64(values) => values.get(at).copied(),
            _ => None,
        }
    }
}

/// Whether a column holds intervals: months, days and milliseconds, which have no common unit.
pub(super) fn is_interval(column: &Type) -> bool {
    column.get_basic_info().converted_type() == ConvertedType::INTERVAL
}

/// The interval at a place as ISO 8601 writes it: `P2M3DT1.500S`; nothing where the file holds fewer bytes than one has.
///
/// Source: Parquet, Logical Types, INTERVAL: three unsigned whole numbers of 32 bits, the lowest byte first.
pub(super) fn interval(values: &Values, at: usize) -> String {
    let Values::Fixed(values) = values else { return String::new() };
    let parts = values.get(at).map(|value| value.data().as_chunks::<4>().0).unwrap_or_default();
    let &[months, days, milliseconds] = parts else { return String::new() };
    let [months, days, milliseconds] = [months, days, milliseconds].map(u32::from_le_bytes);
    format!("P{months}M{days}DT{}.{:03}S", milliseconds / 1000, milliseconds % 1000)
}

/// A time of day, with as many digits as there are parts.
fn of_day(count: i64, parts: i64) -> String {
    let (seconds, rest) = (count.div_euclid(parts), count.rem_euclid(parts));
    let digits = parts.ilog10() as usize;
    format!("{:02}:{:02}:{:02}.{rest:0digits$}", seconds / 3600, seconds / 60 % 60, seconds % 60)
}

/// The day of the Gregorian calendar so many days after 1970-01-01, before it and before there was one too.
///
/// Counted from the first of March of a year 0, so that a leap day is the last of its year, in spans of 400 years. The calendar of
/// `chrono` ends in the year 262142, and columns do not.
fn day(since_1970: i64) -> String {
    let days = i128::from(since_1970) + 719_468;
    let (span, day) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year_of_span = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day_of_year = day - (365 * year_of_span + year_of_span / 4 - year_of_span / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day_of_month = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    let year = year_of_span + 400 * span + i128::from(month <= 2);
    let sign = if year < 0 { "-" } else { "" };
    format!("{sign}{:04}-{month:02}-{day_of_month:02}", year.abs())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use std::sync::Arc;

    use ::parquet::data_type::Int64Type;
    use ::parquet::file::writer::SerializedFileWriter;
    use ::parquet::schema::parser::parse_message_type;

    use super::super::Reader;
    use super::*;
    use crate::formats::{Cells, Form, Options, TableReader as _, Wanted};

    /// Days by Python's `datetime.date(y, m, d).toordinal() - 719163`, and beyond its years by NumPy's `datetime64`:
    /// `int(numpy.datetime64("262144-01-01", "D").astype(int))`.
    #[test]
    fn days_are_those_of_the_calendar() {
        for (count, text) in [
            (0, "1970-01-01"),
            (-1, "1969-12-31"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_782, "2026-11-25"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
            (-719_162, "0001-01-01"),
            (-719_528, "0000-01-01"),
            (-719_529, "-0001-12-31"),
            (95_026_602, "262144-01-01"),
        ] {
            assert_eq!(Time::Day.text(count), text);
        }
    }

    #[test]
    fn an_instant_of_any_size_is_a_text() {
        let of = |parts, is_utc| Time::Moment { parts, is_utc };
        assert_eq!(of(1_000, true).text(-1), "1969-12-31 23:59:59.999 +00:00");
        assert_eq!(of(1_000_000_000, false).text(10_000_000_001), "1970-01-01 00:00:10.000000001");
        assert_eq!(of(1_000_000_000, false).text(i64::MAX), "2262-04-11 23:47:16.854775807");
        for parts in [1_000, 1_000_000, 1_000_000_000] {
            for count in [i64::MIN, i64::MAX] {
                assert!(of(parts, true).text(count).ends_with(" +00:00"));
                let _ = Time::OfDay { parts }.text(count);
                let _ = Time::Day.text(count);
            }
        }
    }

    /// A file of one column, whose values are whole numbers of some kind of time.
    fn times(of_type: &str, values: &[i64]) -> Vec<u8> {
        let schema =
            parse_message_type(&format!("message t {{ required int64 clock ({of_type}); }}")).unwrap();
        let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::default()).unwrap();
        let mut group = writer.next_row_group().unwrap();
        let mut column = group.next_column().unwrap().unwrap();
        column.typed::<Int64Type>().write_batch(values, None, None).unwrap();
        column.close().unwrap();
        group.close().unwrap();
        writer.into_inner().unwrap()
    }

    #[test]
    fn times_are_no_numbers_and_are_texts_of_any_size() {
        for (unit, offset) in [("MILLIS,true", " +00:00"), ("MICROS,false", ""), ("NANOS,false", "")] {
            let file = times(&format!("TIMESTAMP({unit})"), &[1, i64::MAX, i64::MIN]);
            let read = |form| {
                Reader::new(file.as_slice().into(), "run.parquet", &Options::default())
                    .and_then(|mut reader| reader.read(&[Wanted { column: 0, form }], 9))
            };
            let refused = read(Form::Number(1.0)).unwrap_err().to_string();
            assert_eq!(
                refused,
                "run.parquet: column `clock` holds times, which are no numbers: write seconds since some instant"
            );
            let Cells::Labels(texts) = read(Form::Label).unwrap().columns.remove(0) else { panic!("labels") };
            assert!(
                texts[0].starts_with("1970-01-01 00:00:00.00") && texts[0].ends_with(offset),
                "{texts:?}"
            );
            assert_eq!(texts.len(), 3);
        }
    }
}
