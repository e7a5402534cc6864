//! What the lines of a TPOINT file say: the site, and a record of either mount.
//!
//! The site is the latitude (d m s), the date (y m d) and the weather; all but the latitude may be left out. A record of an equatorial
//! mount has right ascension and declination of the star, the same as the telescope read them, the local sidereal time in hours and
//! minutes with decimals, and readings of other instruments behind that. One of an alt-azimuth mount is the same, or has azimuth and
//! elevation, true and as read, in degrees or in d m s.
//!
//! Source: the format as the manual of TPOINT describes it (P. T. Wallace, TPOINT, a telescope pointing analysis system,
//! 2011), and as mount-control programs and observatories write it (JCMT, "Pointing data format under TPOINT", whose records under
//! `:ALTAZ` have right ascensions).

use chrono::NaiveDate;

/// What the records of a file are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mount {
    Equatorial,
    AltAzimuth,
}

impl Mount {
    /// The mount that an option names, if it names one.
    pub fn of_option(option: &str) -> Option<Self> {
        [Self::Equatorial, Self::AltAzimuth]
            .into_iter()
            .find(|mount| option.eq_ignore_ascii_case(mount.option()))
    }

    /// Its option, without the colon.
    pub fn option(self) -> &'static str {
        match self {
            Self::Equatorial => "EQUAT",
            Self::AltAzimuth => "ALTAZ",
        }
    }
}

/// The latitude of the site, degrees.
///
/// # Errors
/// The line is none of a site: a record, say, where the site was left out.
pub(super) fn latitude_deg(words: &[&str]) -> Result<f64, String> {
    let (Some(latitude), false) = (words.get(..3), matches!(words.len(), 4 | 5)) else {
        return Err(
            "the site stands before the records: write its latitude (48 30 00), and the date if it is known \
                    (2026 03 14)"
                .to_owned(),
        );
    };
    if let Some(date) = words.get(3..6) {
        let part = |at: usize| date.get(at).and_then(|word: &&str| word.parse::<u32>().ok());
        let day = match (date.first().map(|year| year.len()), part(0), part(1), part(2)) {
            (Some(4), Some(year), Some(month), Some(day)) => {
                i32::try_from(year).ok().and_then(|year| NaiveDate::from_ymd_opt(year, month, day))
            }
            _ => None,
        };
        if day.is_none() {
            return Err(format!(
                "`{}` is no date, as the site has it behind the latitude: write the site before the records, and the date as 2026 \
                 03 14",
                date.join(" ")
            ));
        }
    }
    within("latitude", sexagesimal(latitude)?, -90.0, 90.0)
}

/// The numbers of a record, by the columns of its mount at a latitude in degrees.
///
/// # Errors
/// What no record of this mount has.
pub(super) fn record(mount: Mount, latitude_deg: f64, words: &[&str]) -> Result<Vec<f64>, String> {
    match mount {
        Mount::Equatorial => equatorial(words),
        Mount::AltAzimuth if words.len() >= 14 => {
            let sky = equatorial(words)?;
            let [true_place, read_place] = [[sky[0], sky[1]], [sky[2], sky[3]]]
                .map(|[ha_deg, dec_deg]| horizontal(ha_deg, dec_deg, latitude_deg));
            Ok([true_place, read_place].concat())
        }
        Mount::AltAzimuth => alt_azimuth(words),
    }
}

/// Azimuth from north through east and elevation of an hour angle and a declination, degrees.
///
/// Source: Explanatory Supplement to the Astronomical Almanac (2013), section 7.1.
fn horizontal(ha_deg: f64, dec_deg: f64, latitude_deg: f64) -> [f64; 2] {
    let [(sin_ha, cos_ha), (sin_dec, cos_dec), (sin_lat, cos_lat)] =
        [ha_deg, dec_deg, latitude_deg].map(|degrees| degrees.to_radians().sin_cos());
    let (west, south) = (cos_dec * sin_ha, cos_dec * cos_ha * sin_lat - sin_dec * cos_lat);
    let up = sin_dec * sin_lat + cos_dec * cos_ha * cos_lat;
    let azimuth_deg = (-west).atan2(-south).to_degrees().rem_euclid(360.0);
    [azimuth_deg, up.atan2(west.hypot(south)).to_degrees()]
}

fn equatorial(words: &[&str]) -> Result<Vec<f64>, String> {
    let (Some(star), Some(read), Some(&[hours, minutes])) =
        (words.get(..6), words.get(6..12), words.get(12..14))
    else {
        return Err("a record of right ascensions has 14 numbers: right ascension and declination of the star (h m s, d m s), the same as \
                    read, and the sidereal time (h m)"
            .to_owned());
    };
    let sidereal_hours = sidereal_hours(hours, minutes, words.get(14).copied())?;
    let ha = |right_ascension_hours: f64| 15.0 * (sidereal_hours - right_ascension_hours);
    let place = |words: &[&str], as_read: &str, farthest_deg: f64| {
        let (right_ascension, declination) = words.split_at(3);
        let hours = within(&format!("right ascension{as_read}"), sexagesimal(right_ascension)?, 0.0, 24.0)?;
        let degrees =
            within(&format!("declination{as_read}"), sexagesimal(declination)?, -farthest_deg, farthest_deg)?;
        Ok::<_, String>((ha(hours), degrees))
    };
    let (true_ha, true_dec) = place(star, "", 90.0)?;
    let (read_ha, read_dec) = place(read, " as read", 180.0)?;
    let through_pole = read_dec.abs() > 90.0;
    let (read_ha, read_dec) = if through_pole {
        (read_ha + 180.0, 180f64.copysign(read_dec) - read_dec)
    } else {
        (read_ha, read_dec)
    };
    Ok(vec![folded(true_ha), true_dec, folded(read_ha), read_dec, if through_pole { -1.0 } else { 1.0 }])
}

/// Whole minutes with a third number that could be seconds are ambiguous: readings of other instruments may follow too.
fn sidereal_hours(hours: &str, minutes: &str, next: Option<&str>) -> Result<f64, String> {
    let seconds =
        next.and_then(|word| word.parse::<f64>().ok()).filter(|number| (0.0..60.0).contains(number));
    if let (Some(seconds), false, Some(next)) = (seconds, minutes.contains('.'), next) {
        let decimal = minutes_of(minutes)? + seconds / 60.0;
        return Err(format!(
            "the sidereal time `{hours} {minutes} {next}` has seconds, and the format has none: write `{hours} {decimal:07.4}`"
        ));
    }
    let time = whole(hours)? + minutes_of(minutes)? / 60.0;
    within("sidereal time", time, 0.0, 24.0)
}

fn alt_azimuth(words: &[&str]) -> Result<Vec<f64>, String> {
    let degrees = match words.len() {
        4 => words.iter().map(|word| number(word)).collect::<Result<Vec<f64>, _>>()?,
        12 => words.chunks(3).map(sexagesimal).collect::<Result<Vec<f64>, _>>()?,
        other => {
            return Err(format!(
                "a record of `:ALTAZ` has 4 numbers (azimuth and elevation, true and as read, in degrees), 12 (the same in d m s) or 14 \
                 (right ascensions and declinations with the sidereal time), and this line has {other}"
            ));
        }
    };
    let limits = [
        ("azimuth", 360.0),
        ("elevation", 90.0),
        ("azimuth as read", 360.0),
        // Beyond the zenith, with the tube turned over.
        ("elevation as read", 180.0),
    ];
    let held = degrees.into_iter().zip(limits).map(|(value, (what, most))| within(what, value, -most, most));
    held.collect()
}

/// Degrees (or hours), minutes and seconds; the sign is the first word's, of zero too.
fn sexagesimal(words: &[&str]) -> Result<f64, String> {
    let &[first, minutes, seconds] = words else { unreachable!("three words were taken") };
    // 60.0 seconds are what rounding makes of 59.96.
    let seconds = part(seconds, "seconds", |value| (0.0..=60.0).contains(&value))?;
    let rest = minutes_of(minutes)? / 60.0 + seconds / 3600.0;
    let size = whole(first)?.abs() + rest;
    Ok(if first.starts_with('-') { -size } else { size })
}

/// The number before minutes.
fn whole(word: &str) -> Result<f64, String> {
    let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
    let is_whole = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    let value = word.parse::<f64>().ok().filter(|_| is_whole);
    value.ok_or_else(|| {
        format!("`{word}` is no whole number of degrees or hours before minutes: write it as 48 30 00")
    })
}

fn minutes_of(word: &str) -> Result<f64, String> {
    part(word, "minutes", |value| (0.0..60.0).contains(&value))
}

/// Minutes or seconds.
fn part(word: &str, what: &str, fits: impl Fn(f64) -> bool) -> Result<f64, String> {
    let value = word.parse::<f64>().ok().filter(|value| !word.starts_with('-') && fits(*value));
    value.ok_or_else(|| format!("`{word}` {what}: write a number from 0 to 59 without a sign"))
}

fn number(word: &str) -> Result<f64, String> {
    let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| format!("`{word}` is no number: write degrees"))
}

fn within(what: &str, value: f64, least: f64, most: f64) -> Result<f64, String> {
    if (least..=most).contains(&value) {
        return Ok(value);
    }
    Err(format!("the {what} is {value}, which is not from {least} to {most}: correct the line"))
}

/// An angle in degrees, between −180 and 180.
fn folded(degrees: f64) -> f64 {
    degrees - 360.0 * (degrees / 360.0).round()
}
