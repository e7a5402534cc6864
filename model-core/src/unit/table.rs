//! The table of units: what each is called, what it measures, and how large it is, exactly.

use super::Measures::{self, Angle, Length, Number, Pressure, Temperature, Time};
use super::{TwoMeanings, Unit};

const fn plain(
    measures: Measures,
    name: &'static str,
    words: &'static [&'static str],
    signs: &'static [&'static str],
    [numerator, denominator]: [i64; 2],
) -> Unit {
    Unit { name, measures, words, signs, numerator, denominator, of_pi: false, zero_is_shifted: false }
}

const fn of_pi(
    name: &'static str,
    words: &'static [&'static str],
    signs: &'static [&'static str],
    [numerator, denominator]: [i64; 2],
) -> Unit {
    Unit { of_pi: true, ..plain(Angle, name, words, signs, [numerator, denominator]) }
}

/// Every unit that a person may write: its name, the same in words, by signs and short forms, and its size in SI.
///
/// Source: SI Brochure, 9th edition (2019), with table 8 of units accepted for use with it; NIST SP 811, appendix B.8, for feet,
/// inches, miles, yards, atmospheres and millimetres of mercury.
pub(super) const UNITS: &[Unit] = &[
    plain(Angle, "rad", &["rads", "radian", "radians"], &[], [1, 1]),
    plain(Angle, "mrad", &["milliradian", "milliradians"], &[], [1, 1_000]),
    plain(Angle, "urad", &["microradian", "microradians"], &["µrad", "μrad"], [1, 1_000_000]),
    plain(Angle, "nrad", &["nanoradian", "nanoradians"], &[], [1, 1_000_000_000]),
    of_pi("deg", &["degs", "degree", "degrees"], &["°", "º"], [1, 180]),
    of_pi("arcmin", &["arcmins", "arcminute", "arcminutes"], &["′", "amin"], [1, 10_800]),
    of_pi("arcsec", &["arcsecs", "arcsecond", "arcseconds"], &["″", "asec", "as"], [1, 648_000]),
    of_pi("mas", &["milliarcsec", "milliarcsecond", "milliarcseconds"], &[], [1, 648_000_000]),
    of_pi(
        "uas",
        &["microarcsec", "microarcsecond", "microarcseconds"],
        &["µas", "μas"],
        [1, 648_000_000_000],
    ),
    of_pi("gon", &["gons", "gradian", "gradians"], &[], [1, 200]),
    of_pi("cgon", &["centigon"], &[], [1, 20_000]),
    of_pi("mgon", &["milligon"], &[], [1, 200_000]),
    of_pi("hour", &["hours", "hourangle"], &[], [1, 12]),
    of_pi("turn", &[], &["turns", "rev", "revolution", "revolutions"], [2, 1]),
    of_pi("mil6400", &[], &[], [1, 3_200]),
    of_pi("mil6000", &[], &[], [1, 3_000]),
    plain(Length, "m", &["metre", "metres", "meter", "meters"], &[], [1, 1]),
    plain(Length, "km", &["kilometre", "kilometres", "kilometer", "kilometers"], &[], [1_000, 1]),
    plain(Length, "dm", &["decimetre", "decimetres", "decimeter", "decimeters"], &[], [1, 10]),
    plain(Length, "cm", &["centimetre", "centimetres", "centimeter", "centimeters"], &[], [1, 100]),
    plain(Length, "mm", &["millimetre", "millimetres", "millimeter", "millimeters"], &[], [1, 1_000]),
    plain(
        Length,
        "um",
        &["micron", "microns", "micrometre", "micrometres", "micrometer", "micrometers"],
        &["µm", "μm"],
        [1, 1_000_000],
    ),
    plain(Length, "nm", &["nanometre", "nanometres", "nanometer", "nanometers"], &[], [1, 1_000_000_000]),
    plain(Length, "inch", &["inches"], &["in"], [254, 10_000]),
    plain(Length, "ft", &["foot", "feet"], &[], [3_048, 10_000]),
    plain(Length, "yd", &["yard", "yards"], &[], [9_144, 10_000]),
    plain(Length, "thou", &[], &[], [254, 10_000_000]),
    plain(Length, "mile", &["miles"], &["mi"], [1_609_344, 1_000]),
    plain(Length, "nmi", &[], &[], [1_852, 1]),
    plain(Number, "1", &[], &[], [1, 1]),
    plain(Number, "px", &["pixel", "pixels"], &[], [1, 1]),
    plain(Number, "%", &["percent"], &[], [1, 100]),
    plain(Number, "ppm", &[], &[], [1, 1_000_000]),
    plain(Number, "ppb", &[], &[], [1, 1_000_000_000]),
    plain(Temperature, "K", &["kelvin", "kelvins"], &[], [1, 1]),
    plain(Temperature, "°C", &["degC", "celsius"], &["ºC", "℃", "C"], [1, 1]),
    Unit {
        zero_is_shifted: true,
        ..plain(Temperature, "°F", &["degF", "fahrenheit"], &["ºF", "℉", "F"], [5, 9])
    },
    plain(Time, "s", &["second", "seconds"], &["sec", "secs"], [1, 1]),
    plain(Time, "ms", &["millisecond", "milliseconds"], &["msec"], [1, 1_000]),
    plain(Time, "us", &["microsecond", "microseconds"], &["µs", "μs"], [1, 1_000_000]),
    plain(Time, "ns", &["nanosecond", "nanoseconds"], &[], [1, 1_000_000_000]),
    plain(Time, "min", &["minute", "minutes"], &["mins"], [60, 1]),
    plain(Time, "h", &["hour", "hours"], &["hr", "hrs"], [3_600, 1]),
    plain(Time, "day", &["days"], &["d"], [86_400, 1]),
    plain(Pressure, "Pa", &["pascal", "pascals"], &[], [1, 1]),
    plain(Pressure, "hPa", &["hectopascal"], &[], [100, 1]),
    plain(Pressure, "kPa", &["kilopascal"], &[], [1_000, 1]),
    plain(Pressure, "mbar", &["millibar", "millibars"], &["mb"], [100, 1]),
    plain(Pressure, "bar", &[], &[], [100_000, 1]),
    plain(Pressure, "atm", &[], &[], [101_325, 1]),
    plain(Pressure, "mmHg", &[], &[], [133_322_387_415, 1_000_000_000]),
];

/// What has two meanings where an angle, a length or a number is wanted. A time that is declared as one knows its own.
pub(super) const TWO_MEANINGS: &[TwoMeanings] = &[
    TwoMeanings {
        spellings: &["h", "hr", "hrs"],
        meanings: "an hour of angle or an hour of time",
        instead: "write `hour` for the angle, of which a turn has 24",
    },
    TwoMeanings {
        spellings: &["min", "mins", "minute", "minutes"],
        meanings: "a minute of arc or a minute of time",
        instead: "write `arcmin` for the minute of arc; a minute of time turns by 15 arcmin",
    },
    TwoMeanings {
        spellings: &["s", "sec", "secs", "second", "seconds"],
        meanings: "a second of arc or a second of time",
        instead: "write `arcsec` for the second of arc; a second of time turns by 15 arcsec",
    },
    TwoMeanings { spellings: &["d"], meanings: "a degree or a day", instead: "write `deg` for the angle" },
    TwoMeanings {
        spellings: &["grad", "grads"],
        meanings: "a gon, of which a turn has 400, or the German word for a degree",
        instead: "write `gon` or `deg`",
    },
    TwoMeanings { spellings: &["r"], meanings: "a radian or a revolution", instead: "write `rad` or `turn`" },
    TwoMeanings {
        spellings: &["mil", "mils"],
        meanings: "an angle, of which a turn has 6400 or 6000, or a thousandth of an inch",
        instead: "write `mil6400`, `mil6000` or `thou`",
    },
    TwoMeanings {
        spellings: &["'", "’"],
        meanings: "a minute of arc or a foot",
        instead: "write `arcmin` or `ft`",
    },
    TwoMeanings {
        spellings: &["\"", "''", "”"],
        meanings: "a second of arc or an inch",
        instead: "write `arcsec` or `inch`",
    },
    TwoMeanings {
        spellings: &["NM"],
        meanings: "a nautical mile or a nanometre",
        instead: "write `nmi` or `nm`",
    },
];
