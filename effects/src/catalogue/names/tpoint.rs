//! TPOINT terms, the names of telescope pointing models.
//!
//! Source: P. T. Wallace, TPOINT; its terms are listed in Software Bisque, TheSky help, appendix L "The pointing
//! terms", and their formulas, with the rules of an instrument that points through the pole, in the notes of his
//! routines `tptPterms`, `tptPtermg`, `tptPtappl` and `tptPtpre`. A formula is what a unit of the term adds to the
//! reading so that it becomes the true place, on the sky: azimuth and hour angle corrections times the cosine of
//! elevation or declination. TPOINT counts azimuth inside from south through east and corrections of it to the left;
//! here both are written for an azimuth from north through east. A positive zenith distance correction lowers the
//! elevation. `z` is the zenith distance.

use super::mount::Kind;
use super::{Published, Sides};

/// Orders of the generic harmonics that have names here.
const ORDERS: std::ops::RangeInclusive<u32> = 1..=8;

fn term(kind: Kind, name: impl Into<String>, meaning: &'static str, across: &str, along: &str) -> Published {
    Published {
        field: "TPOINT",
        name: name.into(),
        meaning,
        kind,
        across: across.to_owned(),
        along: along.to_owned(),
        radial: String::new(),
        sides: Sides::Same,
    }
}

/// A term that changes its sign where the instrument points through the pole.
fn reversed(term: Published) -> Published {
    Published { sides: Sides::Reversed, ..term }
}

/// A term whose rule there declarations cannot say.
fn unsaid(term: Published) -> Published {
    Published { sides: Sides::Unsaid, ..term }
}

/// What a generic harmonic changes: its letter, and what a unit is across and along.
#[derive(Clone, Copy)]
struct Result(char, &'static str, &'static str);

/// What a generic harmonic is of: its letter, and its angle; whether the sine and the cosine of each order keep their sign if the angle
/// is counted as TPOINT does.
#[derive(Clone, Copy)]
struct Coordinate(char, &'static str, fn(bool, u32) -> bool);

impl Coordinate {
    /// Azimuth from south through east: half a turn less that from north.
    const A: Self = Self('A', "A", |sine, order| sine == order.is_multiple_of(2));
    const E: Self = Self('E', "E", |_, _| false);
    const Z: Self = Self('Z', "pi/2 - E", |_, _| false);
    const H: Self = Self('H', "h", |_, _| false);
    const D: Self = Self('D', "d", |_, _| false);

    /// Whether a harmonic changes its sign where the instrument points through the pole: the first angle differs by half a turn there,
    /// and the second is beyond a quarter. Zenith distances are those of the sky on both sides.
    fn through_the_pole(&self, sine: bool, order: u32) -> bool {
        match self.0 {
            'Z' => false,
            'H' | 'A' => !order.is_multiple_of(2),
            _ => sine == order.is_multiple_of(2),
        }
    }
}

impl Result {
    /// Whether the correction itself is the other way round there, as that of the second angle is, and that across the line of sight.
    fn through_the_pole(&self) -> bool {
        !matches!(self.0, 'H' | 'A' | 'Z')
    }
}

/// Generic harmonics `H` + result + `S` or `C` + coordinate + order (left out if 1).
fn harmonics(
    kind: Kind,
    result: Result,
    coordinate: Coordinate,
    meaning: &'static str,
) -> impl Iterator<Item = Published> {
    let (Result(letter, across, along), Coordinate(of, angle, reverses)) = (result, coordinate);
    ORDERS.flat_map(move |order| {
        [("S", "sin", true), ("C", "cos", false)].into_iter().map(move |(initial, wave, sine)| {
            let number = if order == 1 { String::new() } else { order.to_string() };
            let sign = if reverses(sine, order) { "-" } else { "" };
            let times = |factor: &str| match factor {
                "" => String::new(),
                factor => format!("{sign}({factor})*{wave}({order}*({angle}))"),
            };
            let own =
                term(kind, format!("H{letter}{initial}{of}{number}"), meaning, &times(across), &times(along));
            let flips = result.through_the_pole() != coordinate.through_the_pole(sine, order);
            if flips { reversed(own) } else { own }
        })
    })
}

/// Of alt-azimuth mounts.
pub(super) fn alt_azimuth() -> Vec<Published> {
    let kind = Kind::AltAzimuth;
    let mut terms = vec![
        term(kind, "IA", "index of azimuth", "-cos(E)", ""),
        reversed(term(kind, "IE", "index of elevation", "", "1")),
        reversed(term(kind, "CA", "collimation", "-1", "")),
        reversed(term(kind, "NPAE", "axes not perpendicular", "-sin(E)", "")),
        term(kind, "AN", "azimuth axis tilted to the north", "-sin(A)*sin(E)", "-cos(A)"),
        term(kind, "AW", "azimuth axis tilted to the west", "-cos(A)*sin(E)", "sin(A)"),
        term(kind, "TF", "flexure of the tube", "", "-cos(E)"),
        term(kind, "TX", "flexure or refraction as the tangent of the zenith distance", "", "-cot(E)"),
        reversed(term(kind, "ACES", "centring of the azimuth circle, sine", "-sin(A)*cos(E)", "")),
        reversed(term(kind, "ACEC", "centring of the azimuth circle, cosine", "cos(A)*cos(E)", "")),
        reversed(term(kind, "ECES", "centring of the elevation circle, sine", "", "sin(E)")),
        term(kind, "ECEC", "centring of the elevation circle, cosine", "", "cos(E)"),
    ];
    // Corrections of azimuth are to the left, those of zenith distance downwards.
    let (azimuth, left) = (Result('A', "-cos(E)", ""), Result('S', "-1", ""));
    let (elevation, zenith) = (Result('E', "", "1"), Result('Z', "", "-1"));
    let (a, e, z) = (Coordinate::A, Coordinate::E, Coordinate::Z);
    terms.extend(harmonics(kind, azimuth, a, "harmonic of azimuth in azimuth"));
    terms.extend(harmonics(kind, elevation, e, "harmonic of elevation in elevation"));
    terms.extend(harmonics(kind, elevation, a, "harmonic of azimuth in elevation"));
    terms.extend(harmonics(kind, left, a, "harmonic of azimuth, left-right on the sky"));
    terms.extend(harmonics(kind, left, e, "harmonic of elevation, left-right on the sky"));
    terms.extend(harmonics(kind, zenith, z, "harmonic of zenith distance in it"));
    terms
}

/// Of equatorial mounts.
pub(super) fn equatorial() -> Vec<Published> {
    let kind = Kind::Equatorial;
    let fall = "cos(latitude)*cos(h)*sin(d) - sin(latitude)*cos(d)";
    let sink = "-cos(latitude)*cos(h)*cos(d) - sin(latitude)*sin(d)";
    let (across_tx, along_tx) = ("cos(latitude)*sin(h)*sec(z)", format!("({fall})*sec(z)"));
    let mut terms = vec![
        term(kind, "IH", "index of hour angle", "cos(d)", ""),
        reversed(term(kind, "ID", "index of declination", "", "1")),
        reversed(term(kind, "CH", "collimation", "1", "")),
        reversed(term(kind, "NP", "axes not perpendicular", "sin(d)", "")),
        term(kind, "MA", "polar axis off in azimuth", "-cos(h)*sin(d)", "sin(h)"),
        term(kind, "ME", "polar axis off in elevation", "sin(h)*sin(d)", "cos(h)"),
        term(kind, "TF", "flexure of the tube", "cos(latitude)*sin(h)", fall),
        term(kind, "TX", "flexure or refraction as the tangent of the zenith distance", across_tx, &along_tx),
        term(kind, "FO", "flexure of the fork", "", "cos(h)"),
        reversed(term(kind, "DAF", "flexure of the declination axis", sink, "")),
        reversed(term(kind, "HCES", "centring of the hour circle, sine", "sin(h)*cos(d)", "")),
        reversed(term(kind, "HCEC", "centring of the hour circle, cosine", "cos(h)*cos(d)", "")),
        reversed(term(kind, "DCES", "centring of the declination circle, sine", "", "sin(d)")),
        term(kind, "DCEC", "centring of the declination circle, cosine", "", "cos(d)"),
        unsaid(term(kind, "PHH", "scale of hour angle", "h*cos(d)", "")),
        unsaid(term(kind, "PDD", "scale of declination", "", "d")),
    ];
    let (hour, declination, west) = (Result('H', "cos(d)", ""), Result('D', "", "1"), Result('X', "1", ""));
    let (h, d) = (Coordinate::H, Coordinate::D);
    terms.extend(harmonics(kind, hour, h, "harmonic of hour angle in hour angle"));
    terms.extend(harmonics(kind, declination, d, "harmonic of declination in declination"));
    terms.extend(harmonics(kind, declination, h, "harmonic of hour angle in declination"));
    terms.extend(harmonics(kind, west, h, "harmonic of hour angle, east-west on the sky"));
    terms.extend(harmonics(kind, west, d, "harmonic of declination, east-west on the sky"));
    terms
}
