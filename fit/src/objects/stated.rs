//! What a study states of places, as observations of its own: each number of an object or a station that is known to within a
//! standard uncertainty is observed to be zero.

use observe::unknowns::{Freedom, OF_OBJECT, Unknowns, WIDTH};

/// Beside the rows of data, what is stated: rows of their own, a component each.
pub(crate) struct Stated {
    /// The objects and stations, with such a row behind those of data for each number that is stated.
    pub unknowns: Unknowns,
    /// The derivatives of each by what is unknown.
    pub unknown: Vec<[f64; WIDTH]>,
    /// One over the standard uncertainty of each.
    pub scale: Vec<f64>,
}

impl Stated {
    /// All that is stated; none where nothing is.
    pub fn of(unknowns: &Unknowns) -> Option<Self> {
        let mut stated = Self { unknowns: unknowns.clone(), unknown: Vec::new(), scale: Vec::new() };
        for (number, object) in (0..).zip(&unknowns.objects) {
            if let Freedom::Within { shift_m, .. } = object.freedom {
                (0..object.numbers()).for_each(|place| stated.push(Some(number), 0, place, shift_m));
            }
        }
        for (number, station) in (0..).zip(&unknowns.stations) {
            for place in 0..station.numbers() {
                if let Some(sigma) = station.stated(place) {
                    stated.push(None, number, OF_OBJECT + place, sigma);
                }
            }
        }
        (!stated.scale.is_empty()).then_some(stated)
    }

    fn push(&mut self, object: Option<u32>, station: u32, place: usize, sigma: f64) {
        self.unknowns.object.push(object);
        self.unknowns.station.push(station);
        self.unknown.push(std::array::from_fn(|at| f64::from(u8::from(at == place))));
        self.scale.push(1.0 / sigma);
    }
}
