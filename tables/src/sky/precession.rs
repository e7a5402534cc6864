//! Precession with the bias of the frame, and what nutation adds: the matrix from the frame of catalogues to the true equator and equinox.
//!
//! Source: N. Capitaine, P. T. Wallace, J. Chapront, Expressions for IAU 2000 precession quantities (2003), adopted as IAU 2006: the four
//! angles of Fukushima and Williams with the bias (IERS Conventions 2010, section 5.6.4; ERFA, `pfw06`).

use super::{ARCSEC, Matrix, Vector};

/// The mean obliquity at J2000.
pub(super) const OBLIQUITY_ARCSEC: f64 = 84_381.406;

/// Coefficients by powers of the centuries since J2000, arc seconds.
const GAMMA: [f64; 6] = [-0.052_928, 10.556_378, 0.493_204_4, -0.000_312_38, -0.000_002_788, 0.000_000_026_0];
const PHI: [f64; 6] =
    [84_381.412_819, -46.811_016, 0.051_126_8, 0.000_532_89, -0.000_000_440, -0.000_000_017_6];
const PSI: [f64; 6] =
    [-0.041_775, 5_038.481_484, 1.558_417_5, -0.000_185_22, -0.000_026_452, -0.000_000_014_8];
const EPSILON: [f64; 6] =
    [OBLIQUITY_ARCSEC, -46.836_769, -0.000_183_1, 0.002_003_40, -0.000_000_576, -0.000_000_043_4];

fn polynomial(coefficients: &[f64; 6], centuries: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * centuries + coefficient) * ARCSEC
}

/// The mean obliquity of date, rad.
pub(super) fn obliquity(centuries: f64) -> f64 {
    polynomial(&EPSILON, centuries)
}

/// R1(−ε − Δε) R3(−ψ − Δψ) R1(φ) R3(γ), of the nutation in longitude and obliquity, rad.
pub(super) fn matrix(centuries: f64, [in_longitude, in_obliquity]: [f64; 2]) -> Matrix {
    let [gamma, phi, psi] = [&GAMMA, &PHI, &PSI].map(|coefficients| polynomial(coefficients, centuries));
    let first = times(&about_x(phi), &about_z(gamma));
    let second = times(&about_z(-psi - in_longitude), &first);
    times(&about_x(-obliquity(centuries) - in_obliquity), &second)
}

/// Turns the frame about x.
fn about_x(angle: f64) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    [[1.0, 0.0, 0.0], [0.0, cos, sin], [0.0, -sin, cos]]
}

/// Turns the frame about z.
fn about_z(angle: f64) -> Matrix {
    let (sin, cos) = angle.sin_cos();
    [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]
}

fn times(one: &Matrix, other: &Matrix) -> Matrix {
    one.map(|row| {
        let column: Vector = std::array::from_fn(|at| (0..3).map(|axis| row[axis] * other[axis][at]).sum());
        column
    })
}
