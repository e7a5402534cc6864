//! Where objects and stations are as a fit has them now: what is known of them, and the numbers that are estimated.

use nalgebra::Vector3;

use super::{OF_OBJECT, Object, Pose, Unknowns, own_numbers};

/// Objects and stations with their numbers.
#[derive(Debug, Clone)]
pub struct State<'a> {
    unknowns: &'a Unknowns,
    numbers: &'a [f64],
    first_of_stations: Vec<usize>,
    first_of_objects: Vec<usize>,
}

impl<'a> State<'a> {
    /// With all numbers that are estimated, in the order of [`Unknowns::numbers`].
    #[must_use]
    pub fn new(unknowns: &'a Unknowns, numbers: &'a [f64]) -> Self {
        let (first_of_stations, first_of_objects) =
            (unknowns.first_of_stations(), unknowns.first_of_objects());
        Self { unknowns, numbers, first_of_stations, first_of_objects }
    }

    /// What a row observes, and its numbers; `None` if it observes nothing unknown.
    #[must_use]
    pub fn object(&self, row: usize) -> Option<(&'a Object, [f64; OF_OBJECT])> {
        let at = (*self.unknowns.object.get(row)?)? as usize;
        let object = self.unknowns.objects.get(at)?;
        Some((object, own_numbers(self.numbers, self.first_of_objects[at], object.numbers())))
    }

    /// Where a row was observed from, and the numbers of that station.
    #[must_use]
    pub fn station(&self, row: usize) -> Option<(Pose, [f64; 6])> {
        let at = *self.unknowns.station.get(row)? as usize;
        let station = self.unknowns.stations.get(at)?;
        let by = own_numbers(self.numbers, self.first_of_stations[at], station.numbers());
        Some((station.pose.moved(&by), by))
    }

    /// How far the point that a row observes is from `origin`, which is in the chain's frame, m.
    #[must_use]
    pub fn distance_m(&self, row: usize, origin: &Vector3<f64>) -> Option<f64> {
        let (object, own) = self.object(row)?;
        let (pose, _) = self.station(row)?;
        Some((pose.back(&(object.place + Vector3::new(own[0], own[1], own[2]))) - origin).norm())
    }
}
