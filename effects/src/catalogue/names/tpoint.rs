//! TPOINT terms, the names of telescope pointing models.
//!
//! Source: P. T. Wallace, TPOINT; its terms are listed in Software Bisque, TheSky help, appendix L "The pointing
//! terms". On the sky: azimuth and hour angle corrections times the cosine of elevation or declination. TPOINT
//! counts azimuth from south through east; ours, from north through east, differs in signs only. TX of an
//! equatorial mount has the cosine of the zenith distance below, which declarations cannot say; it is left out.

use super::Published;
use super::mount::Kind;

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
    }
}

/// Generic harmonics `H` + result + `S` or `C` + coordinate + order (left out if 1). `result` is its letter and what
/// the harmonic is multiplied by across and along.
fn harmonics(
    kind: Kind,
    result: (&str, &str, &str),
    (letter, angle): (&str, &str),
    meaning: &'static str,
) -> impl Iterator<Item = Published> {
    let (result, across, along) = (result.0.to_owned(), result.1.to_owned(), result.2.to_owned());
    let (letter, angle) = (letter.to_owned(), angle.to_owned());
    ORDERS.flat_map(move |order| {
        let (result, across, along) = (result.clone(), across.clone(), along.clone());
        let (letter, angle) = (letter.clone(), angle.clone());
        [("S", "sin"), ("C", "cos")].into_iter().map(move |(initial, wave)| {
            let number = if order == 1 { String::new() } else { order.to_string() };
            let times = |factor: &str| match factor {
                "" => String::new(),
                factor => format!("{factor}*{wave}({order}*({angle}))"),
            };
            term(
                kind,
                format!("H{result}{initial}{letter}{number}"),
                meaning,
                &times(&across),
                &times(&along),
            )
        })
    })
}

/// Of alt-azimuth mounts.
pub(super) fn alt_azimuth() -> Vec<Published> {
    let kind = Kind::AltAzimuth;
    let mut terms = vec![
        term(kind, "IA", "index of azimuth", "cos(E)", ""),
        term(kind, "IE", "index of elevation", "", "1"),
        term(kind, "CA", "collimation", "1", ""),
        term(kind, "NPAE", "axes not perpendicular", "sin(E)", ""),
        term(kind, "AN", "azimuth axis tilted to the north", "sin(A)*sin(E)", "cos(A)"),
        term(kind, "AW", "azimuth axis tilted to the west", "cos(A)*sin(E)", "-sin(A)"),
        term(kind, "TF", "flexure of the tube", "", "cos(E)"),
        term(kind, "TX", "flexure or refraction as the tangent of the zenith distance", "", "cot(E)"),
        term(kind, "ACES", "centring of the azimuth circle, sine", "sin(A)*cos(E)", ""),
        term(kind, "ACEC", "centring of the azimuth circle, cosine", "cos(A)*cos(E)", ""),
        term(kind, "ECES", "centring of the elevation circle, sine", "", "sin(E)"),
        term(kind, "ECEC", "centring of the elevation circle, cosine", "", "cos(E)"),
    ];
    let a = ("A", "A");
    let e = ("E", "E");
    terms.extend(harmonics(kind, ("A", "cos(E)", ""), a, "harmonic of azimuth in azimuth"));
    terms.extend(harmonics(kind, ("E", "", "1"), e, "harmonic of elevation in elevation"));
    terms.extend(harmonics(kind, ("E", "", "1"), a, "harmonic of azimuth in elevation"));
    terms.extend(harmonics(kind, ("S", "1", ""), a, "harmonic of azimuth, left-right on the sky"));
    terms.extend(harmonics(kind, ("S", "1", ""), e, "harmonic of elevation, left-right on the sky"));
    terms.extend(harmonics(kind, ("Z", "", "1"), ("Z", "pi/2 - E"), "harmonic of zenith distance in it"));
    terms
}

/// Of equatorial mounts.
pub(super) fn equatorial() -> Vec<Published> {
    let kind = Kind::Equatorial;
    let fall = "cos(latitude)*cos(h)*sin(d) - sin(latitude)*cos(d)";
    let lift = "cos(latitude)*cos(h)*cos(d) + sin(latitude)*sin(d)";
    let mut terms = vec![
        term(kind, "IH", "index of hour angle", "cos(d)", ""),
        term(kind, "ID", "index of declination", "", "1"),
        term(kind, "CH", "collimation", "1", ""),
        term(kind, "NP", "axes not perpendicular", "sin(d)", ""),
        term(kind, "MA", "polar axis off in azimuth", "-cos(h)*sin(d)", "sin(h)"),
        term(kind, "ME", "polar axis off in elevation", "sin(h)*sin(d)", "cos(h)"),
        term(kind, "TF", "flexure of the tube", "cos(latitude)*sin(h)", fall),
        term(kind, "FO", "flexure of the fork", "", "cos(h)"),
        term(kind, "DAF", "flexure of the declination axis", lift, ""),
        term(kind, "HCES", "centring of the hour circle, sine", "sin(h)*cos(d)", ""),
        term(kind, "HCEC", "centring of the hour circle, cosine", "cos(h)*cos(d)", ""),
        term(kind, "DCES", "centring of the declination circle, sine", "", "sin(d)"),
        term(kind, "DCEC", "centring of the declination circle, cosine", "", "cos(d)"),
        term(kind, "PHH", "scale of hour angle", "h*cos(d)", ""),
        term(kind, "PDD", "scale of declination", "", "d"),
    ];
    let h = ("H", "h");
    let d = ("D", "d");
    terms.extend(harmonics(kind, ("H", "cos(d)", ""), h, "harmonic of hour angle in hour angle"));
    terms.extend(harmonics(kind, ("D", "", "1"), d, "harmonic of declination in declination"));
    terms.extend(harmonics(kind, ("D", "", "1"), h, "harmonic of hour angle in declination"));
    terms.extend(harmonics(kind, ("X", "1", ""), h, "harmonic of hour angle, east-west on the sky"));
    terms.extend(harmonics(kind, ("X", "1", ""), d, "harmonic of declination, east-west on the sky"));
    terms
}
