//! A part of many rows that shows about what all show.

use super::{Observations, golden};

/// Rows that an object keeps at least, if it has as many.
const ENOUGH: f64 = 12.0;

impl Observations {
    /// About so many of the rows, evenly spread; of each object some from every station that saw it.
    #[must_use]
    pub fn sample(&self, rows: usize) -> Self {
        let share = rows as f64 / self.rows() as f64;
        let mut order: Vec<usize> = (0..self.rows()).collect();
        let mut chosen: Vec<usize> = match &self.unknowns {
            None => of_these(&order, share),
            Some(unknowns) => {
                let (object, station) = (&unknowns.object, &unknowns.station);
                order.sort_by_key(|&row| (object[row], station[row], row));
                let of_one = order.chunk_by(|&a, &b| object[a] == object[b]);
                of_one.flat_map(|own| of_these(own, share.max(ENOUGH / own.len() as f64))).collect()
            }
        };
        chosen.sort_unstable();
        self.select(&chosen)
    }
}

/// About this share of some rows.
fn of_these(rows: &[usize], share: f64) -> Vec<usize> {
    let chosen = rows.iter().enumerate().filter(|&(at, _)| golden::share(at) < share);
    chosen.map(|(_, &row)| row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unknowns::{Object, Shape, Station, Unknowns};

    fn rows(count: usize) -> Observations {
        Observations { row_numbers: (0..count as u64).collect(), ..observed(count) }
    }

    fn observed(count: usize) -> Observations {
        Observations {
            measured: vec![crate::Measured::Length { length_m: 1.0 }; count],
            ..Observations::default()
        }
    }

    proptest::proptest! {
        /// About as many as asked for, from everywhere.
        #[test]
        fn rows_are_spread_evenly(count in 1000usize..5000, wanted in 200usize..900) {
            let sample = rows(count).sample(wanted);
            assert!(sample.rows().abs_diff(wanted) <= 3, "{} of {wanted}", sample.rows());
            for part in 0..10 {
                let own = part * count / 10..(part + 1) * count / 10;
                let in_it = (0..sample.rows()).filter_map(|row| sample.row_numbers.get(row));
                let found = in_it.filter(|&row| own.contains(&(row as usize))).count();
                assert!(found.abs_diff(wanted / 10) <= 5, "{found} of {wanted} in part {part}");
            }
        }

        /// Whatever the order of the file, every object is seen from each of its stations, an object of few rows by all of them.
        #[test]
        fn every_object_keeps_its_stations(order in 0usize..50, often in 40usize..80) {
            // A prime permutes the rows.
            let of_row = |row: usize| (row * 7919 + order) % (9 * often);
            let mut observations = rows(9 * often + 5);
            let things = ["A", "B", "few"].map(|label| Object::unknown(label.to_owned(), Shape::Point));
            let object = (0..9 * often).map(|row| Some((of_row(row) % 2) as u32)).chain([Some(2); 5]);
            let station = (0..9 * often).map(|row| (of_row(row) / 2 % 3) as u32).chain([0; 5]);
            observations.unknowns = Some(Unknowns {
                objects: things.to_vec(),
                stations: vec![Station::ground(); 3],
                object: object.collect(),
                station: station.collect(),
            });
            let sample = observations.sample(30);
            let unknowns = sample.unknowns.unwrap_or_else(|| unreachable!("there were some"));
            for (object, from) in [(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (1, 2)] {
                let seen = unknowns.object.iter().zip(&unknowns.station);
                assert!(seen.filter(|&(own, station)| (*own, *station) == (Some(object), from)).count() >= 3);
            }
            assert_eq!(unknowns.object.iter().filter(|own| **own == Some(2)).count(), 5);
        }
    }
}
