//! Stations that moved while they measured: a tripod that sinks or twists, in the order of its rows, looks like errors of the instrument,
//! most of all where one face was measured after the other.

use faer::Mat;
use serde::Serialize;

use super::rivals::{Winner, contest};
use crate::search::context::Context;
use crate::search::round::Round;
use observe::unknowns::{OF_OBJECT, Unknowns};

/// Rows of a station from which on a motion can be told.
const FEWEST: usize = 12;

/// Numbers of a station: three shifts, three turns.
const NUMBERS: usize = 6;

/// Those by which it sinks and twists, as tripods do.
const SINKS: [usize; 2] = [2, 5];

/// A motion that explains the data better than what was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moved {
    /// The station; absent where all of several did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub station: Option<String>,
    /// How far the one that moved most did from its first row to its last, m.
    pub shift_m: f64,
    /// How far the one that turned most did, rad.
    pub turn_rad: f64,
    /// What was found, and would not be.
    pub instead_of: Vec<String>,
}

/// The motion, uniform from row to row, that explains the data better than the effects that were accepted; `None` where none does.
pub(super) fn moved(whole: &Context<'_>, last: &Round<'_>) -> Option<Moved> {
    let rows = &last.search.rows;
    let unknowns = rows.observations.unknowns.as_ref()?;
    let times = times(unknowns);
    // What no station carries may be on a vehicle, whose trajectory drifts by its own right.
    let stands = |at: &usize| times[*at].len() >= FEWEST && !unknowns.stations[*at].label.is_empty();
    let stations: Vec<usize> = (0..unknowns.stations.len()).filter(stands).collect();
    if stations.is_empty() {
        return None;
    }
    let columns_of = |station: usize| -> Vec<Vec<f64>> {
        let mut time = vec![0.0; unknowns.station.len()];
        let count = times[station].len() as f64 - 1.0;
        times[station].iter().enumerate().for_each(|(at, &row)| time[row] = at as f64 / count - 0.5);
        let own = rows.columns.unknown.iter().zip(&rows.columns.row);
        let number = |number: usize| {
            let moved = own.clone().map(|(unknown, &row)| unknown[OF_OBJECT + number] * time[row as usize]);
            rows.whiten(&moved.collect::<Vec<f64>>())
        };
        (0..NUMBERS).map(number).collect()
    };
    let each: Vec<Vec<Vec<f64>>> = stations.iter().map(|&station| columns_of(station)).collect();

    // One of them in any way, or all: in any way, or as tripods do, each by itself or alike.
    let whole_motion: Vec<usize> = (0..NUMBERS).collect();
    let all: Vec<usize> = (0..stations.len()).collect();
    let mut tried: Vec<(Vec<usize>, &[usize], bool)> =
        all.iter().map(|&at| (vec![at], &whole_motion[..], false)).collect();
    tried.push((all.clone(), &SINKS, false));
    if all.len() > 1 {
        tried.push((all.clone(), &SINKS, true));
        tried.push((all, &whole_motion, false));
    }
    let height = each[0][0].len();
    let rivals = tried.iter().map(|(some, numbers, alike)| {
        let one = |at: usize, number: usize, i: usize| each[at][number][i];
        let count = numbers.len();
        match alike {
            true => Mat::from_fn(height, count, |i, j| some.iter().map(|&at| one(at, numbers[j], i)).sum()),
            false => {
                Mat::from_fn(height, count * some.len(), |i, j| one(some[j / count], numbers[j % count], i))
            }
        }
    });
    let Winner { rival, coefficients, instead_of } = contest(whole, last, &rivals.collect::<Vec<_>>())?;
    let (some, moving, _) = &tried[rival];
    let most = |from: usize| {
        let of_station = |own: &[f64]| {
            let own = moving.iter().zip(own).filter(|(number, _)| (from..from + 3).contains(*number));
            own.map(|(_, value)| value * value).sum::<f64>().sqrt()
        };
        coefficients.chunks_exact(moving.len()).map(of_station).fold(0.0, f64::max)
    };
    let label = |at: usize| unknowns.stations[stations[at]].label.clone();
    Some(Moved {
        station: if let [one] = some[..] { Some(label(one)) } else { None },
        shift_m: most(0),
        turn_rad: most(3),
        instead_of,
    })
}

/// The rows of each station, in order.
fn times(unknowns: &Unknowns) -> Vec<Vec<usize>> {
    let mut of_station = vec![Vec::new(); unknowns.stations.len()];
    for (row, &station) in unknowns.station.iter().enumerate() {
        of_station[station as usize].push(row);
    }
    of_station
}
