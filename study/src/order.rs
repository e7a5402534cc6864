//! The order of acquisition, by a column of whatever says it: numbers, points in time, or names that are counted on.

use std::cmp::Ordering;

use chrono::{FixedOffset, NaiveDate};

use tables::formats::numbers;

/// The rows by their labels, equal ones as they stand: by number if all are numbers, by the moment if all are points in time, else
/// as names are counted on (`IMG_2` before `IMG_10`).
pub(super) fn order_of(labels: &[String]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..labels.len()).collect();
    if let Some(numbers) = numbers(labels) {
        order.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b]));
    } else if let Some(moments) = moments(labels) {
        order.sort_by(|&a, &b| moments[a].seconds.total_cmp(&moments[b].seconds));
    } else {
        order.sort_by(|&a, &b| counted(&labels[a], &labels[b]));
    }
    order
}

/// The labels as numbers that grow with time, of points in time the seconds; or the first that says nothing of it.
pub(super) fn times(labels: &[String]) -> Result<Vec<f64>, usize> {
    let all_finite = |numbers: Vec<f64>| match numbers.iter().position(|number| !number.is_finite()) {
        Some(row) => Err(row),
        None => Ok(numbers),
    };
    if let Some(numbers) = numbers(labels) {
        return all_finite(numbers);
    }
    if let Some(moments) = moments(labels) {
        return all_finite(moments.iter().map(|moment| moment.seconds).collect());
    }
    // Where each alone says something, they do not together: one of those that begin otherwise than the first is shown.
    let is_number = |label: &String| numbers(std::slice::from_ref(label)).is_some();
    let first = labels.first().is_some_and(is_number);
    let says_nothing = |label: &String| !is_number(label) && moment(label).is_err();
    let row = labels.iter().position(says_nothing);
    Err(row.or_else(|| labels.iter().position(|label| is_number(label) != first)).unwrap_or(0))
}

/// The first label that is a point in time in a way that is not understood, and why: one that no calendar or clock has, or one
/// where names would be all that is left to go by, as `31.01.2026` comes behind `01.02.2026` then.
pub(super) fn not_understood(labels: &[String]) -> Option<(usize, &'static str)> {
    if numbers(labels).is_some() || moments(labels).is_some() {
        return None;
    }
    let impossible = |label: &String| match moment(label) {
        Err(NoMoment::Impossible(why)) => Some(why),
        _ => None,
    };
    let found = labels.iter().enumerate().find_map(|(row, label)| Some((row, impossible(label)?)));
    if found.is_some() {
        return found;
    }
    if labels.iter().all(|label| moment(label).is_ok()) {
        let bare = labels.iter().position(|label| moment(label).is_ok_and(|moment| !moment.has_zone));
        return bare.map(|row| {
            (row, "says nothing of its zone, while other rows do: write it everywhere, or nowhere")
        });
    }
    let row = labels.iter().position(|label| moment(label).is_err() && looks_like_time(label))?;
    Some((row, "is a point in time that is not understood: write it as 2026-01-31T18:01:00"))
}

/// Seconds by which a clock goes back where summer time ends: an hour, less the time between two rows.
const SET_BACK: std::ops::RangeInclusive<f64> = 1_800.0..=3_660.0;

/// The row at which local times go back by about an hour, once and without a zone, and by how many seconds: the end of summer time,
/// most likely, so that one hour comes twice.
pub(super) fn set_back(labels: &[String]) -> Option<(usize, f64)> {
    let moments = moments(labels).filter(|moments| moments.iter().all(|moment| !moment.has_zone))?;
    let back = moments.windows(2).map(|pair| pair[0].seconds - pair[1].seconds).enumerate();
    let mut back = back.filter(|(_, seconds)| *seconds > 0.0 && seconds <= SET_BACK.end());
    let (at, seconds) = back.next().filter(|(_, seconds)| SET_BACK.contains(seconds))?;
    back.next().is_none().then_some((at + 1, seconds))
}

/// Whether a text has a date that does not begin with the year, a month by its name, or a clock of twelve hours.
fn looks_like_time(label: &str) -> bool {
    const MONTHS: [&str; 12] =
        ["jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"];
    let lower = label.trim().to_ascii_lowercase();
    let words: Vec<&str> = lower.split(|letter: char| !letter.is_alphanumeric()).collect();
    let digits = |word: &&str| !word.is_empty() && word.bytes().all(|letter| letter.is_ascii_digit());
    let is_month = |word: &&str| {
        word.get(..3).is_some_and(|start| MONTHS.contains(&start)) && !word.contains(char::is_numeric)
    };
    let of_twelve = ["am", "pm"].iter().any(|half| {
        lower
            .strip_suffix(half)
            .is_some_and(|clock| clock.trim_end().ends_with(|last: char| last.is_ascii_digit()))
    });
    let by_numbers = match words[..] {
        [day, month, year, ..] => {
            let is_date = [day, month, year].iter().all(digits)
                && day.len() <= 2
                && month.len() <= 2
                && (year.len() == 4 || [day, month, year].iter().all(|word| word.len() == 2));
            // Not where blanks or colons part them.
            is_date && lower[day.len()..].starts_with(['.', '/', '-'])
        }
        _ => false,
    };
    let by_name = words.iter().any(is_month) && words.iter().filter(|word| digits(word)).count() >= 2;
    by_numbers || by_name || of_twelve
}

/// A point in time.
struct Moment {
    /// Since the year 1970 began, of what the label says of the zone.
    seconds: f64,
    has_zone: bool,
}

/// Why a label is no point in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NoMoment {
    /// It is something else.
    Other,
    /// It is written as one, but there is no such day, time of day or zone.
    Impossible(&'static str),
}

/// All labels as points in time by ISO 8601; none where some have a zone and others do not, which nothing can put in order.
fn moments(labels: &[String]) -> Option<Vec<Moment>> {
    let moments: Vec<Moment> = labels.iter().map(|label| moment(label)).collect::<Result<_, _>>().ok()?;
    let zoned = moments.iter().filter(|moment| moment.has_zone).count();
    (zoned == 0 || zoned == moments.len()).then_some(moments)
}

/// `2026-10-25`, or with a time of day behind `T` or a blank, `02:59:30.25`, and with `Z` or `+02:00` behind that.
fn moment(label: &str) -> Result<Moment, NoMoment> {
    let (date, clock) = match label.split_once(['T', 't', ' ']) {
        Some((date, clock)) => (date, Some(clock)),
        None => (label, None),
    };
    let mut parts = date.splitn(3, '-');
    let mut next = |digits| parts.next().ok_or(NoMoment::Other).and_then(|part| digits_of(part, digits));
    let (year, month, day) = (next(4)?, next(2)?, next(2)?);
    let date = i32::try_from(year).ok().and_then(|year| NaiveDate::from_ymd_opt(year, month, day));
    let date = date.ok_or(NoMoment::Impossible("is no day of the calendar: correct the date"));
    let Some(clock) = clock else {
        return Ok(Moment { seconds: f64::from(date?.to_epoch_days()) * 86_400.0, has_zone: false });
    };
    let clock = clock.trim();
    let (clock, zone) = match clock.find(['Z', 'z', '+', '-']) {
        Some(at) => (clock[..at].trim_end(), Some(&clock[at..])),
        None => (clock, None),
    };
    let mut parts = clock.splitn(3, ':');
    let mut next = |digits| parts.next().ok_or(NoMoment::Other).and_then(|part| digits_of(part, digits));
    let (hour, minute) = (next(2)?, next(2)?);
    let second: f64 = match parts.next() {
        Some(second) if second.bytes().all(|letter| letter.is_ascii_digit() || letter == b'.') => {
            second.parse().map_err(|_| NoMoment::Other)?
        }
        Some(_) => return Err(NoMoment::Other),
        None => 0.0,
    };
    let ahead = zone.map_or(Ok(0), ahead_of_utc)?;
    // A leap second is the 61st of its minute.
    let seconds_of_minute = if minute == 59 { 61.0 } else { 60.0 };
    if hour > 23 || minute > 59 || second >= seconds_of_minute {
        return Err(NoMoment::Impossible("is no time of day: correct the hour, the minute or the second"));
    }
    let own = f64::from(hour * 3600 + minute * 60) + second - f64::from(ahead);
    Ok(Moment { seconds: f64::from(date?.to_epoch_days()) * 86_400.0 + own, has_zone: zone.is_some() })
}

/// Seconds that a zone is ahead: `Z`, `+02:00`, `-0330`, `+02`.
fn ahead_of_utc(zone: &str) -> Result<i32, NoMoment> {
    if zone.eq_ignore_ascii_case("z") {
        return Ok(0);
    }
    let digits = zone.get(1..).ok_or(NoMoment::Other)?.replace(':', "");
    let (hours, minutes) = digits.split_at_checked(2).ok_or(NoMoment::Other)?;
    let hours = digits_of(hours, 2)?;
    let minutes = if minutes.is_empty() { 0 } else { digits_of(minutes, 2)? };
    let ahead = i32::try_from(hours * 3600 + minutes * 60).map_err(|_| NoMoment::Other)?;
    let ahead = if zone.starts_with('-') { -ahead } else { ahead };
    let offset = FixedOffset::east_opt(ahead).filter(|_| minutes < 60);
    let offset = offset.ok_or(NoMoment::Impossible("is in no zone: correct what follows the time of day"))?;
    Ok(offset.local_minus_utc())
}

/// A number of so many digits.
fn digits_of(text: &str, digits: usize) -> Result<u32, NoMoment> {
    let is_one = text.len() == digits && text.bytes().all(|letter| letter.is_ascii_digit());
    if is_one { text.parse().map_err(|_| NoMoment::Other) } else { Err(NoMoment::Other) }
}

/// Two names by their parts: digits by the number that they are, all else as text.
fn counted(one: &str, other: &str) -> Ordering {
    let (mut one, mut other) = (one, other);
    while let (Some(a), Some(b)) = (one.chars().next(), other.chars().next()) {
        let ordering = if a.is_ascii_digit() && b.is_ascii_digit() {
            let (left, right) = (digits_ahead(&mut one), digits_ahead(&mut other));
            // Of the same number, that with fewer zeros ahead is first.
            let value = |digits: &str| digits.trim_start_matches('0').len();
            let by_value = value(left).cmp(&value(right));
            by_value
                .then_with(|| left.trim_start_matches('0').cmp(right.trim_start_matches('0')))
                .then(left.len().cmp(&right.len()))
        } else {
            (one, other) = (&one[a.len_utf8()..], &other[b.len_utf8()..]);
            a.cmp(&b)
        };
        if ordering.is_ne() {
            return ordering;
        }
    }
    one.len().cmp(&other.len())
}

/// Takes the digits with which a text begins.
fn digits_ahead<'t>(text: &mut &'t str) -> &'t str {
    let end = text.find(|letter: char| !letter.is_ascii_digit()).unwrap_or(text.len());
    let (digits, left) = text.split_at(end);
    *text = left;
    digits
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The labels in their order.
    fn ordered<'t>(labels: &[&'t str]) -> Vec<&'t str> {
        let own: Vec<String> = labels.iter().map(|label| (*label).to_owned()).collect();
        order_of(&own).into_iter().map(|at| labels[at]).collect()
    }

    #[test]
    fn numbers_go_by_their_size_with_a_point_or_a_comma() {
        assert_eq!(ordered(&["10", "9", "-1e3", "9.5"]), ["-1e3", "9", "9.5", "10"]);
        assert_eq!(ordered(&["10,5", "9", "0,25"]), ["0,25", "9", "10,5"]);
        // Of both marks nobody knows which parts thousands.
        assert_eq!(ordered(&["1,234", "10.5", "9"]), ["1,234", "9", "10.5"]);
    }

    #[test]
    fn points_in_time_go_by_the_instant_across_zones() {
        // Half past two comes twice as summer ends.
        let told = [
            "2026-10-25T02:30:00+01:00",
            "2026-10-25T02:30:00+02:00",
            "2026-10-25 01:00:00Z",
            "2026-10-25T02:59:59.5+02:00",
        ];
        assert_eq!(ordered(&told), [told[1], told[3], told[2], told[0]]);
        assert_eq!(
            ordered(&["2026-03-01", "2024-02-29T23:59", "2024-03-01"]),
            ["2024-02-29T23:59", "2024-03-01", "2026-03-01"]
        );
    }

    /// What Python's `datetime(…).timestamp()` says of these, in UTC.
    #[test]
    fn an_instant_is_that_of_the_calendar() {
        let of = |label: &str| moment(label).map(|moment| moment.seconds);
        assert_eq!(of("1970-01-01"), Ok(0.0));
        assert_eq!(of("2000-02-29T12:30:15.25Z"), Ok(951_827_415.25));
        assert_eq!(of("1969-12-31T19:00:00-05:00"), Ok(0.0));
        assert_eq!(of("2026-11-24T22:33:00+0330"), Ok(1_795_546_980.0));
        for wrong in
            ["2026-1-1", "25.10.2026", "2026-10-25T2:30", "2026-10-25T02:30+2", "2026-10-25T02:30:xx"]
        {
            assert_eq!(of(wrong), Err(NoMoment::Other), "{wrong}");
        }
    }

    /// Python's `datetime.fromisoformat` refuses each, but for the leap second.
    #[test]
    fn what_no_calendar_or_clock_has_is_refused() {
        for wrong in [
            "2026-02-30",
            "2026-02-30T00:00:00",
            "2025-02-29",
            "1900-02-29",
            "2026-13-01",
            "2026-00-01",
            "2026-01-00",
            "2026-10-25T25:00",
            "2026-10-25T24:00:00",
            "2026-10-25T00:75",
            "2026-10-25T00:00:60",
            "2026-10-25T02:30+99:00",
            "2026-10-25T02:30+02:60",
        ] {
            assert!(matches!(moment(wrong), Err(NoMoment::Impossible(_))), "{wrong}");
            let labels = ["2026-01-30T18:01", wrong].map(str::to_owned);
            assert_eq!(not_understood(&labels).map(|(row, _)| row), Some(1), "{wrong}");
        }
        assert!(moment("2016-12-31T23:59:60Z").is_ok());
        assert!(moment("2000-02-29T23:59:59.999-12:00").is_ok());
    }

    #[test]
    fn labels_that_say_when_are_numbers() {
        let times =
            |labels: &[&str]| times(&labels.iter().map(|label| (*label).to_owned()).collect::<Vec<_>>());
        assert_eq!(times(&["1,5", "2"]), Ok(vec![1.5, 2.0]));
        assert_eq!(times(&["1970-01-02", "1970-01-01T00:00:00.25"]), Ok(vec![86_400.0, 0.25]));
        assert_eq!(times(&["1970-01-01 02:00 +02:00"]), Ok(vec![0.0]));
        assert_eq!(times(&["2026-01-01", "IMG_2"]), Err(1));
        assert_eq!(times(&["5", "2026-01-01"]), Err(1));
        assert_eq!(times(&["1", "inf"]), Err(1));
        assert_eq!(times(&[]), Ok(Vec::new()));
    }

    #[test]
    fn points_in_time_that_are_not_understood_are_not_names() {
        let of = |labels: &[&str]| {
            not_understood(&labels.iter().map(|label| (*label).to_owned()).collect::<Vec<_>>())
                .map(|(row, _)| row)
        };
        for wrong in [
            "31.01.2026 18:01",
            "31/01/2026",
            "1/31/2026",
            "31-01-26",
            "31-Jan-2026",
            "31 January 2026 18:01:02",
            "Jan 31, 2026",
            "Sat Jan 31 18:01:00 2026",
            "06:15:00 PM",
            "2026-01-31 06:15 pm",
        ] {
            assert_eq!(of(&["2026-01-30T18:01", wrong]), Some(1), "{wrong}");
            assert_eq!(of(&[wrong, wrong]), Some(0), "{wrong}");
        }
        assert_eq!(of(&["2026-10-25T02:30:00Z", "2026-10-25T02:30:00"]), Some(1));
        for right in
            ["IMG_2", "1.2.3", "run 2 row 11", "march", "2026/01/31", "a.m.", "May 3", "exam", "12:30:15", ""]
        {
            assert_eq!(of(&["x", right]), None, "{right}");
        }
        assert_eq!(of(&["2026-10-25T02:30:00", "2026-10-25"]), None);
        assert_eq!(of(&["1", "2.5"]), None);
    }

    #[test]
    fn an_hour_that_comes_twice_is_seen() {
        let of =
            |labels: &[&str]| set_back(&labels.iter().map(|label| (*label).to_owned()).collect::<Vec<_>>());
        let summer = ["2026-10-25T02:30", "2026-10-25T02:59", "2026-10-25T02:01", "2026-10-25T02:30"];
        assert_eq!(of(&summer), Some((2, 3_480.0)));
        assert_eq!(of(&summer.map(|label| [label, "+02:00"].concat()).each_ref().map(String::as_str)), None);
        assert_eq!(of(&["2026-10-25T02:30", "2026-10-25T02:31", "2026-10-25T02:30"]), None);
        // Rows in no order, and those of another night.
        assert_eq!(
            of(&["2026-10-25T02:30", "2026-10-25T01:31", "2026-10-25T01:45", "2026-10-25T01:40"]),
            None
        );
        assert_eq!(of(&["2026-10-25T02:30", "2026-10-24T01:31"]), None);
        assert_eq!(of(&["7200", "3600"]), None);
        assert_eq!(of(&["IMG_2", "IMG_1"]), None);
        assert_eq!(of(&[]), None);
    }

    #[test]
    fn names_are_counted_on() {
        assert_eq!(
            ordered(&["IMG_10", "IMG_9", "IMG_2b", "IMG_2", "IMG"]),
            ["IMG", "IMG_2", "IMG_2b", "IMG_9", "IMG_10"]
        );
        assert_eq!(
            ordered(&["run 2 row 11", "run 10 row 1", "run 2 row 9"]),
            ["run 2 row 9", "run 2 row 11", "run 10 row 1"]
        );
    }

    proptest! {
        /// What a calendar and a clock have is the instant that they say, and what they do not have is refused.
        #[test]
        fn any_date_is_an_instant_or_is_refused(
            year in 1900_i32..2100, month in 0_u32..15, day in 0_u32..34, hour in 0_u32..27, minute in 0_u32..70, zone in -15_i32..16
        ) {
            const LENGTHS: [u32; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
            let is_leap = |year: i32| year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
            let length = |year: i32, month: usize| LENGTHS[month] + u32::from(month == 1 && is_leap(year));
            let sign = if zone < 0 { '-' } else { '+' };
            let label = format!("{year}-{month:02}-{day:02}T{hour:02}:{minute:02}{sign}{:02}:30", zone.abs());
            let exists = (1..=12).contains(&month)
                && (1..=length(year, month.clamp(1, 12) as usize - 1)).contains(&day)
                && hour < 24
                && minute < 60;
            let read = moment(&label).map(|moment| moment.seconds);
            prop_assert_eq!(read.is_ok(), exists, "{}", label);
            if let Ok(seconds) = read {
                // Days counted one year and one month at a time.
                let years = if year < 1970 { year..1970 } else { 1970..year };
                let of_years: i64 = years.map(|year| if is_leap(year) { 366 } else { 365 }).sum();
                let of_years = if year < 1970 { -of_years } else { of_years };
                let of_months: u32 = (0..month as usize - 1).map(|month| length(year, month)).sum();
                let days = of_years + i64::from(of_months + day - 1);
                let ahead = i64::from(zone.abs() * 60 + 30) * if zone < 0 { -60 } else { 60 };
                let expected = days * 86_400 + i64::from(hour * 3600 + minute * 60) - ahead;
                prop_assert_eq!(seconds, expected as f64, "{}", label);
            }
        }

        /// Any texts have one order: sorting fails on what is none.
        #[test]
        fn whatever_is_written_has_an_order(labels in prop::collection::vec("[0-9aé._ :TZ+-]{0,8}", 0..60)) {
            let order = order_of(&labels);
            for pair in order.windows(2) {
                prop_assert!(counted(&labels[pair[0]], &labels[pair[1]]).is_le() || numbers(&labels).is_some() || moments(&labels).is_some());
            }
        }
    }
}
