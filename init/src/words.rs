//! What the name of a column says: which part of an instrument it is of, and whether it is the truth or a reading.

use observe::kinds::headers;
pub use tables::formats::words;

/// What a column is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    Azimuth,
    Elevation,
    Zenith,
    HourAngle,
    Declination,
    Horizontal,
    Pan,
    Tilt,
    Roll,
    Alpha,
    Beta,
    Gamma,
    /// A joint of an arm, counted from 1.
    Joint(u32),
    /// An angle of no axis in particular.
    Turn,
    Range,
    X,
    Y,
    Z,
    /// Off the nominal direction, across and along.
    Cross,
    Along,
    Temperature,
    Pier,
    /// What rows have in common that are not independent: a night, a session.
    Group,
    /// What names a row.
    Name,
    /// What names where the instrument stood.
    Station,
}

/// Whether a column tells what was true, or what the instrument said.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    True,
    Reading,
    Unsaid,
}

const TRUE: &[&str] = &[
    "true",
    "truth",
    "reference",
    "ref",
    "catalogue",
    "catalog",
    "cat",
    "star",
    "sky",
    "apparent",
    "actual",
    "known",
    "solved",
    "astrometric",
];
const READING: &[&str] =
    &["encoder", "enc", "raw", "reading", "read", "mount", "instrument", "commanded", "cmd", "axis"];
/// Columns that speak of other columns, or of how good they are.
const ABOUT: &[&str] = &[
    "std",
    "sd",
    "sigma",
    "stddev",
    "uncertainty",
    "rms",
    "snr",
    "fwhm",
    "weight",
    "count",
    "offset",
    "error",
    "err",
    "residual",
    "delta",
    "diff",
    "difference",
    "correction",
    "rate",
    "velocity",
    "speed",
    "quat",
    "quaternion",
    "orientation",
    "ori",
];
const OFFSETS: &[&str] = &["offset", "error", "err", "residual", "delta", "diff", "difference", "correction"];

/// By which words a part is known.
enum Known {
    /// By these.
    By(&'static [&'static str]),
    /// By those of a column that a kind of observation reads by this key.
    As(&'static str),
}

const PARTS: &[(Part, Known)] = &[
    (Part::Azimuth, Known::As("azimuth")),
    (Part::Elevation, Known::As("elevation")),
    (Part::Zenith, Known::By(&["zenith", "zd", "za", "vertical", "v", "va", "vz"])),
    (Part::HourAngle, Known::As("ha")),
    (Part::Declination, Known::As("dec")),
    (Part::Horizontal, Known::By(&["horizontal", "hz"])),
    (Part::Pan, Known::By(&["pan", "yaw"])),
    (Part::Tilt, Known::By(&["tilt", "pitch"])),
    (Part::Roll, Known::By(&["roll"])),
    (Part::Alpha, Known::By(&["alpha"])),
    (Part::Beta, Known::By(&["beta"])),
    (Part::Gamma, Known::By(&["gamma"])),
    (Part::Range, Known::As("range")),
    (Part::Temperature, Known::By(&["temperature", "temp", "ambient", "celsius", "kelvin"])),
    (Part::Pier, Known::By(&["pier", "pierside"])),
    (Part::Group, Known::By(&["day", "night", "session", "run", "source", "date", "campaign"])),
    (Part::Turn, Known::By(&["angle", "turn", "table", "rotation", "theta", "position"])),
    (Part::Station, Known::By(&["station", "stations", "setup", "standpoint"])),
    (Part::X, Known::As("x")),
    (Part::Y, Known::As("y")),
    (Part::Z, Known::As("z")),
    (
        Part::Name,
        Known::By(&[
            "id", "row", "name", "nr", "no", "number", "label", "star", "object", "target", "prism", "point",
            "pose",
        ]),
    ),
];

impl Known {
    fn words(&self) -> &'static [&'static str] {
        match self {
            Self::By(words) => words,
            Self::As(key) => headers(key),
        }
    }
}

fn any(words: &[String], of: &[&str]) -> bool {
    words.iter().any(|word| of.contains(&word.as_str()))
}

/// What a column of these words is of; `is_angle` where its unit says that it is an angle.
pub fn part(words: &[String], is_angle: bool) -> Option<Part> {
    let alone = |text: &str| words.len() == 1 && words.iter().any(|word| word == text);
    if any(words, OFFSETS) {
        return match () {
            () if any(words, headers("cross")) => Some(Part::Cross),
            () if any(words, headers("along")) => Some(Part::Along),
            () => None,
        };
    }
    // `sd` by itself is a slope distance; the axes of a map may be written with one letter.
    if alone("sd") {
        return Some(Part::Range);
    }
    if any(words, ABOUT) {
        return None;
    }
    for (part, letter) in [(Part::X, "e"), (Part::Y, "n"), (Part::Z, "u")] {
        if alone(letter) {
            return Some(part);
        }
    }
    if words.windows(2).any(|pair| pair == ["hour", "angle"]) {
        return Some(Part::HourAngle);
    }
    if let Some(number) = joint(words) {
        return Some(Part::Joint(number));
    }
    let named = PARTS.iter().find(|(_, known)| any(words, known.words())).map(|(part, _)| *part);
    named.or_else(|| is_angle.then_some(Part::Turn))
}

/// `q3`, `joint_3`, `j3`, `theta3`
fn joint(words: &[String]) -> Option<u32> {
    let stems = ["q", "j", "joint", "theta"];
    words.iter().enumerate().find_map(|(at, word)| {
        let stem = word.trim_end_matches(|letter: char| letter.is_ascii_digit());
        let digits = if stem.len() == word.len() { words.get(at + 1)? } else { &word[stem.len()..] };
        (stems.contains(&stem) && digits.len() == 1).then(|| digits.parse().ok())?
    })
}

/// Which side a column of these words is on.
pub fn side(words: &[String]) -> Side {
    match (any(words, TRUE), any(words, READING)) {
        (true, false) => Side::True,
        (false, true) => Side::Reading,
        _ => Side::Unsaid,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_parts_and_sides() {
        for (name, expected, on) in [
            ("true_az", Some(Part::Azimuth), Side::True),
            ("encoderEl", Some(Part::Elevation), Side::Reading),
            ("offset_cross_el", Some(Part::Cross), Side::Unsaid),
            ("offset_dec", Some(Part::Along), Side::Unsaid),
            ("joint_3", Some(Part::Joint(3)), Side::Unsaid),
            ("q6", Some(Part::Joint(6)), Side::Unsaid),
            ("sd", Some(Part::Range), Side::Unsaid),
            ("ha_sd", None, Side::Unsaid),
            ("std_x", None, Side::Unsaid),
            ("pier_side", Some(Part::Pier), Side::Unsaid),
            ("ambient_celsius", Some(Part::Temperature), Side::Unsaid),
            ("north", Some(Part::Y), Side::Unsaid),
            ("rx", None, Side::Unsaid),
            ("", None, Side::Unsaid),
        ] {
            let words = words(name);
            assert_eq!((part(&words, false), side(&words)), (expected, on), "{name}");
        }
    }
}
