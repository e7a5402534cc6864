//! Places on the Earth as lengths: the ellipsoid of WGS 84, and the frame of east, north and up about a place.
//!
//! Source: National Imagery and Mapping Agency, TR8350.2 (2000), the constants of WGS 84; IOGP, Guidance Note 7-2, 4.1.1 and 4.1.2, geodetic
//! to geocentric coordinates and back, and geocentric to topocentric ones.

use nalgebra::{Matrix3, Vector3};

/// Half the longer axis, m.
const SEMI_MAJOR_M: f64 = 6_378_137.0;
/// Flattening.
const FLATTENING: f64 = 1.0 / 298.257_223_563;
/// Square of the eccentricity.
const ECCENTRICITY_2: f64 = FLATTENING * (2.0 - FLATTENING);
/// Steps in which a latitude comes back from lengths; each leaves a hundredth of a hundredth.
const STEPS: usize = 8;

/// A place by its angles on the ellipsoid and the height above it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Geodetic {
    /// North positive.
    pub latitude_rad: f64,
    /// East positive.
    pub longitude_rad: f64,
    /// Above the ellipsoid.
    pub height_m: f64,
}

impl Geodetic {
    /// From the centre of the Earth: x to the meridian of Greenwich on the equator, z to the pole.
    #[must_use]
    pub fn geocentric(&self) -> Vector3<f64> {
        let (sin, cos) = self.latitude_rad.sin_cos();
        let across = SEMI_MAJOR_M / (1.0 - ECCENTRICITY_2 * sin * sin).sqrt();
        let from_axis = (across + self.height_m) * cos;
        let (east, toward) = self.longitude_rad.sin_cos();
        Vector3::new(
            from_axis * toward,
            from_axis * east,
            (across * (1.0 - ECCENTRICITY_2) + self.height_m) * sin,
        )
    }

    /// The place of a point that is so far from the centre of the Earth.
    #[must_use]
    pub fn of_geocentric(point: &Vector3<f64>) -> Self {
        let from_axis = point.x.hypot(point.y);
        let mut latitude_rad = point.z.atan2(from_axis * (1.0 - ECCENTRICITY_2));
        for _ in 0..STEPS {
            let sin = latitude_rad.sin();
            let across = SEMI_MAJOR_M / (1.0 - ECCENTRICITY_2 * sin * sin).sqrt();
            latitude_rad = (point.z + ECCENTRICITY_2 * across * sin).atan2(from_axis);
        }
        let (sin, cos) = latitude_rad.sin_cos();
        // Near a pole as well as near the equator.
        let height_m =
            from_axis * cos + point.z * sin - SEMI_MAJOR_M * (1.0 - ECCENTRICITY_2 * sin * sin).sqrt();
        Self { latitude_rad, longitude_rad: point.y.atan2(point.x), height_m }
    }

    /// East, north and up there, a row each, as parts of geocentric directions.
    #[must_use]
    pub fn east_north_up(&self) -> Matrix3<f64> {
        let (sin_lat, cos_lat) = self.latitude_rad.sin_cos();
        let (sin_lon, cos_lon) = self.longitude_rad.sin_cos();
        Matrix3::new(
            -sin_lon,
            cos_lon,
            0.0,
            -sin_lat * cos_lon,
            -sin_lat * sin_lon,
            cos_lat,
            cos_lat * cos_lon,
            cos_lat * sin_lon,
            sin_lat,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    fn place(latitude_deg: f64, longitude_deg: f64, height_m: f64) -> Geodetic {
        let [latitude_rad, longitude_rad] = [latitude_deg, longitude_deg].map(f64::to_radians);
        Geodetic { latitude_rad, longitude_rad, height_m }
    }

    /// Source: IOGP, Guidance Note 7-2, the example of 4.1.1: WGS 84, 53°48′33.820″ N, 2°07′46.380″ E, 73.0 m.
    #[test]
    fn validate_the_published_example() {
        let given = place(53.0 + 48.0 / 60.0 + 33.820 / 3600.0, 2.0 + 7.0 / 60.0 + 46.380 / 3600.0, 73.0);
        let published = Vector3::new(3_771_793.968, 140_253.342, 5_124_304.349);
        assert_abs_diff_eq!(given.geocentric(), published, epsilon = 1e-3);
    }

    #[test]
    fn verify_there_and_back() {
        for (latitude, longitude, height) in [
            (0.0, 0.0, 0.0),
            (48.1, 11.6, 530.0),
            (-33.9, 151.2, -400.0),
            (89.9, -170.0, 9_000.0),
            (-90.0, 0.0, 20_000.0),
        ] {
            let given = place(latitude, longitude, height);
            let back = Geodetic::of_geocentric(&given.geocentric());
            assert_abs_diff_eq!(back.latitude_rad, given.latitude_rad, epsilon = 1e-15);
            assert_abs_diff_eq!(back.longitude_rad, given.longitude_rad, epsilon = 1e-15);
            assert_abs_diff_eq!(back.height_m, given.height_m, epsilon = 3e-9);
        }
    }
}
