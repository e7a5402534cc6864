//! Which of the stated places are believed: what moved many times further than is stated, and than the others did, is somewhere else.

use std::borrow::Cow;

use super::{Freedom, Unknowns, WIDTH};

/// What moved this many times further than is stated, and than half of the others did, is not where it is stated.
const ELSEWHERE: f64 = 4.0;

/// What is stated of one number of a station: an observation of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OfStation {
    /// The station's place among all.
    pub station: u32,
    /// The number's place among those of all stations.
    pub at: usize,
    /// Its standard uncertainty, m or rad.
    pub sigma: f64,
    /// Stated minus where it came to stand, m or rad.
    pub away: f64,
}

/// Beyond how many of its standard uncertainties something is elsewhere, where these moved so far.
fn most(mut in_sigmas: Vec<f64>) -> f64 {
    in_sigmas.sort_by(f64::total_cmp);
    ELSEWHERE * in_sigmas.get(in_sigmas.len().saturating_sub(1) / 2).map_or(1.0, |half| half.max(1.0))
}

impl Unknowns {
    /// What is stated of stations that are where these numbers do not contradict it. Of one alone nothing else tells whether an effect or
    /// its place is to blame, and it is not believed beyond its own uncertainty.
    pub fn stated_of_stations(&self, numbers: &[f64]) -> Vec<OfStation> {
        let stations = (0_u32..).zip(&self.stations).zip(self.first_of_stations());
        let of_station = stations.map(|((number, station), first)| {
            let stated = (0..station.numbers()).filter_map(|at| Some((first + at, station.stated(at)?)));
            stated.map(|(at, sigma)| OfStation { station: number, at, sigma, away: -numbers[at] }).collect()
        });
        let of_station: Vec<Vec<OfStation>> = of_station.filter(|own: &Vec<_>| !own.is_empty()).collect();
        let in_sigmas =
            |own: &[OfStation]| own.iter().map(|one| one.away.abs() / one.sigma).fold(0.0, f64::max);
        let most = match &of_station[..] {
            [_] => ELSEWHERE,
            several => most(several.iter().map(|own| in_sigmas(own)).collect()),
        };
        of_station.into_iter().filter(|own| in_sigmas(own) <= most).flatten().collect()
    }

    /// The same, but what is stated of an object that turned out to be somewhere else altogether does not count: it moved by these
    /// numbers many times further than is stated, and than the others did.
    pub fn believed(&self, numbers: &[f64]) -> Cow<'_, Self> {
        let firsts = self.first_of_objects();
        let in_sigmas = self.objects.iter().zip(firsts).map(|(object, first)| match object.freedom {
            Freedom::Within { shift_m, .. } => {
                let own = numbers[first..][..object.numbers()].iter();
                own.map(|value| value.abs() / shift_m).reduce(f64::max)
            }
            Freedom::Free | Freedom::Given => None,
        });
        let in_sigmas: Vec<Option<f64>> = in_sigmas.collect();
        let most = most(in_sigmas.iter().flatten().copied().collect());
        let is_elsewhere = |of_object: &Option<f64>| of_object.is_some_and(|sigmas| sigmas > most);
        if !in_sigmas.iter().any(is_elsewhere) {
            return Cow::Borrowed(self);
        }
        let mut believed = self.clone();
        for (object, own) in believed.objects.iter_mut().zip(&in_sigmas) {
            object.freedom = if is_elsewhere(own) { Freedom::Free } else { object.freedom };
        }
        Cow::Owned(believed)
    }

    /// Residuals of components, each of a row, as they would be with the objects of which a place is stated there, and not where
    /// these numbers have them.
    pub fn as_if_stated(&self, numbers: &[f64], row: &[u32], unknown: &[[f64; WIDTH]], residual: &mut [f64]) {
        let first = self.first_of_objects();
        for ((residual, &row), unknown) in residual.iter_mut().zip(row).zip(unknown) {
            let Some(object) = self.object[row as usize].map(|object| object as usize) else { continue };
            if self.objects[object].freedom.is_within() {
                let own = &numbers[first[object]..][..self.objects[object].numbers()];
                *residual += unknown.iter().zip(own).map(|(by, value)| by * value).sum::<f64>();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unknowns::Station;

    /// Of stations whose numbers are all off alike each is believed, whatever is behind it; of one that is off by far more, none of them.
    #[test]
    fn a_station_that_is_elsewhere_is_not_believed() {
        let station = |label: &str| Station {
            freedom: Freedom::Within { shift_m: 1e-3, turn_rad: 1e-4 },
            ..Station::unknown(label.to_owned())
        };
        let of = |labels: &[&str], shifts_m: &[f64]| {
            let stations: Vec<Station> = labels.iter().map(|label| station(label)).collect();
            let unknowns = Unknowns { stations, ..Unknowns::default() };
            let numbers: Vec<f64> =
                shifts_m.iter().flat_map(|shift| [*shift, 0.0, 0.0, 0.0, 0.0, 0.0]).collect();
            let stated = unknowns.stated_of_stations(&numbers);
            assert!(stated.iter().all(|own| own.away.to_bits() == (-numbers[own.at]).to_bits()));
            stated.chunk_by(|a, b| a.station == b.station).map(|own| own[0].station).collect::<Vec<_>>()
        };
        assert_eq!(of(&["A", "B", "C"], &[8e-3, -9e-3, 7e-3]), [0, 1, 2]);
        assert_eq!(of(&["A", "B", "C"], &[1e-3, 9e-3, -0.5e-3]), [0, 2]);
        assert_eq!(of(&["A"], &[3e-3]), [0]);
        assert!(of(&["A"], &[9e-3]).is_empty());
    }
}
