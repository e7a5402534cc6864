//! Directions, spherical coordinates and offsets on the tangent plane.
//!
//! Convention, everywhere: azimuth A runs from y through x, elevation E from the xy plane towards z, so the
//! direction is (sin A cos E, cos A cos E, sin E). With x east, y north, z up that is azimuth and elevation; with
//! x west, y where the meridian meets the equator, z the pole it is hour angle and declination.

use nalgebra::Vector3;

/// The unit vector of an azimuth and an elevation, both in rad.
#[must_use]
pub fn direction_from_spherical(azimuth_rad: f64, elevation_rad: f64) -> Vector3<f64> {
    let (sin_a, cos_a) = azimuth_rad.sin_cos();
    let (sin_e, cos_e) = elevation_rad.sin_cos();
    Vector3::new(sin_a * cos_e, cos_a * cos_e, sin_e)
}

/// The unit vectors across (towards growing azimuth) and along (towards growing elevation) at a direction.
///
/// On the z axis itself, where azimuth means nothing, azimuth 0 is taken.
#[must_use]
pub fn tangent_frame(direction: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let horizontal = (direction.x * direction.x + direction.y * direction.y).sqrt();
    let (sin_a, cos_a) =
        if horizontal > 0.0 { (direction.x / horizontal, direction.y / horizontal) } else { (0.0, 1.0) };
    let sin_e = direction.z;
    [Vector3::new(cos_a, -sin_a, 0.0), Vector3::new(-sin_a * sin_e, -cos_a * sin_e, horizontal)]
}

/// The unit vector at an offset (across, along; rad) from a direction, on its tangent plane.
///
/// Source: gnomonic projection, the standard coordinates ξ and η of astrometry.
#[must_use]
pub fn direction_from_offset(direction: &Vector3<f64>, across_rad: f64, along_rad: f64) -> Vector3<f64> {
    let [across, along] = tangent_frame(direction);
    (direction + across * across_rad + along * along_rad).normalize()
}

/// The offset (across, along; rad) of a vector from a direction, on its tangent plane: what [`direction_from_offset`] takes.
#[must_use]
pub fn offset_of_direction(direction: &Vector3<f64>, vector: &Vector3<f64>) -> [f64; 2] {
    let towards = vector.dot(direction);
    tangent_frame(direction).map(|axis| vector.dot(&axis) / towards)
}

/// Azimuth and elevation of a vector, rad: the azimuth from −π to π.
#[must_use]
pub fn spherical_of_direction(vector: &Vector3<f64>) -> [f64; 2] {
    [vector.x.atan2(vector.y), vector.z.atan2(vector.x.hypot(vector.y))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn the_frame_is_orthonormal_and_follows_the_coordinates() {
        let step = 1e-6;
        for (a, e) in [(0.0, 0.0), (1.0, 0.5), (-2.5, -1.2), (3.0, 1.4)] {
            let u = direction_from_spherical(a, e);
            let [across, along] = tangent_frame(&u);
            let by_azimuth = (direction_from_spherical(a + step, e) - direction_from_spherical(a - step, e))
                / (2.0 * step);
            let by_elevation = (direction_from_spherical(a, e + step)
                - direction_from_spherical(a, e - step))
                / (2.0 * step);
            assert_relative_eq!(across * e.cos(), by_azimuth, epsilon = 1e-9);
            assert_relative_eq!(along, by_elevation, epsilon = 1e-9);
        }
    }

    #[test]
    fn the_pole_has_a_frame() {
        let [across, along] = tangent_frame(&Vector3::z());
        assert_eq!(across, Vector3::x());
        assert_eq!(along, -Vector3::y());
    }

    #[test]
    fn an_offset_is_its_tangent() {
        let u = direction_from_spherical(0.3, 0.8);
        let moved = direction_from_offset(&u, 0.02, 0.0);
        assert_relative_eq!(u.dot(&moved).acos().tan(), 0.02, epsilon = 1e-12);
        let back = offset_of_direction(&u, &(direction_from_offset(&u, 0.02, -0.3) * 7.0));
        assert_relative_eq!(back[0], 0.02, epsilon = 1e-14);
        assert_relative_eq!(back[1], -0.3, epsilon = 1e-14);
    }

    #[test]
    fn two_angles_come_back() {
        for (a, e) in [(0.3, 0.8), (-3.0, -1.5), (3.1, 0.0)] {
            let [azimuth, elevation] = spherical_of_direction(&(direction_from_spherical(a, e) * 3.0));
            assert_relative_eq!(azimuth, a, epsilon = 1e-14);
            assert_relative_eq!(elevation, e, epsilon = 1e-14);
        }
    }
}
