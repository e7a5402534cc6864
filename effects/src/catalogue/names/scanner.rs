//! Parameters of laser scanners, total stations and trackers: a point at a measured range.
//!
//! Source: D. D. Lichti, "Error modelling, calibration and analysis of an AM-CW terrestrial laser scanner system",
//! ISPRS J. Photogramm. Remote Sens. 61 (2007) 307 (additional parameters A, B, C); B. Muralikrishnan et al.,
//! "Volumetric performance evaluation of a laser scanner based on geometric error model", Precision Engineering 40
//! (2015) 139 (x2 to x12, with zenith angle V = π/2 − E; the beam's own offset and tilt, x1 and x5, depend on the optical
//! train and are left out). Angles are times the range, and times cos E for horizontal ones: lengths at the target.

use super::mount::Kind;
use super::{Published, Sides};

fn parameter(
    field: &'static str,
    name: &str,
    meaning: &'static str,
    [across, along, radial]: [&str; 3],
) -> Published {
    Published {
        field,
        name: name.to_owned(),
        meaning,
        kind: Kind::Scanner,
        across: across.to_owned(),
        along: along.to_owned(),
        radial: radial.to_owned(),
        sides: Sides::Same,
    }
}

/// Additional parameters of terrestrial laser scanners.
pub(super) fn additional() -> Vec<Published> {
    let ap = |name, meaning, parts| parameter("scanner", name, meaning, parts);
    vec![
        ap("A0", "rangefinder offset", ["", "", "1"]),
        ap("A1", "rangefinder scale", ["", "", "R"]),
        ap("B1", "scale of the horizontal circle", ["A*R*cos(E)", "", ""]),
        ap("B2", "eccentricity of the horizontal circle, sine", ["R*cos(E)*sin(A)", "", ""]),
        ap("B3", "eccentricity of the horizontal circle, cosine", ["R*cos(E)*cos(A)", "", ""]),
        ap("B4", "horizontal circle not across its axis, sine", ["R*cos(E)*sin(2*A)", "", ""]),
        ap("B5", "horizontal circle not across its axis, cosine", ["R*cos(E)*cos(2*A)", "", ""]),
        ap("B6", "collimation axis error", ["R", "", ""]),
        ap("B7", "trunnion axis error", ["R*sin(E)", "", ""]),
        ap("C0", "vertical circle index", ["", "R", ""]),
        ap("C1", "scale of the vertical circle", ["", "E*R", ""]),
        ap("C2", "eccentricity of the vertical circle, sine", ["", "R*sin(E)", ""]),
    ]
}

/// Geometric parameters of scanners and trackers after NIST.
pub(super) fn nist() -> Vec<Published> {
    let x = |name, meaning, parts| parameter("NIST", name, meaning, parts);
    vec![
        x("x2", "transit offset: the axes do not meet", ["", "-sin(E)", "cos(E)"]),
        x("x3", "mirror offset, across", ["1", "", ""]),
        x("x4", "vertical index", ["", "R", ""]),
        x("x6", "mirror tilt", ["2*R", "", ""]),
        x("x7", "transit tilt: the axes are not perpendicular", ["R*sin(E)", "", ""]),
        x("x8x", "eccentricity of the horizontal circle, sine", ["R*cos(E)*sin(A)", "", ""]),
        x("x8y", "eccentricity of the horizontal circle, cosine", ["R*cos(E)*cos(A)", "", ""]),
        x("x9n", "eccentricity of the vertical circle, cosine of V", ["", "R*sin(E)", ""]),
        x("x9z", "eccentricity of the vertical circle, sine of V", ["", "R*cos(E)", ""]),
        x("x10", "zero of the range", ["", "", "1"]),
        x("x11a", "second order of the horizontal circle, cosine", ["R*cos(E)*cos(2*A)", "", ""]),
        x("x11b", "second order of the horizontal circle, sine", ["R*cos(E)*sin(2*A)", "", ""]),
        x("x12a", "second order of the vertical circle, cosine", ["", "R*cos(2*E)", ""]),
        x("x12b", "second order of the vertical circle, sine", ["", "R*sin(2*E)", ""]),
    ]
}
