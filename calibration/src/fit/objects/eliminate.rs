//! The elimination: each object's few numbers by a factor of their own, then the stations' from what the objects left.
//!
//! What remains is the factor of the chain's columns as if objects and stations had followed every change of the errors:
//! variable projection. A direction in which no row moves an object or station is held by a row so weak that it takes no
//! part in anything else.
//!
//! Source: G. H. Golub, V. Pereyra, Separable nonlinear least squares: the variable projection method and its
//! applications, Inverse Problems 19 (2003) R1-R26; eliminated block by block as in a bundle adjustment.

use faer::Mat;
use rayon::prelude::*;

use crate::data::unknowns::{Freedom, Unknowns, WIDTH};
use crate::fit::{Partial, Rows};

/// The weight of the rows that hold what nothing else holds, in units of the column's length. Much less, and rounding would
/// move a frame that nothing holds further than a step does.
const HOLD: f64 = 1e-6;

/// A column of which less than this share is left, objects and stations aside, moved nothing else.
const NOTHING: f64 = 3e-5;

/// Whitened and weighted rows of one component each: the derivatives by object and station, those by the chain's columns,
/// and the residual.
#[derive(Debug, Clone, Default)]
pub(crate) struct Collected {
    /// The row of the observations of each component.
    pub row: Vec<u32>,
    /// `WIDTH` derivatives, the chain's columns, the residual; component after component.
    pub values: Vec<f64>,
}

/// A triangle that gives the change of some unknown numbers for a change of what comes behind them.
#[derive(Debug, Clone)]
struct Triangle {
    /// Where the numbers stand among all.
    own: Vec<usize>,
    /// Where the numbers of stations stand that they hang on.
    stations: Vec<usize>,
    /// Rows of [own | stations | chain | residual], as many as own.
    factor: Mat<f64>,
}

/// What is left of rows once the objects and stations are eliminated.
#[derive(Debug, Clone)]
pub(crate) struct Eliminated {
    /// The factor of the chain's columns.
    pub partial: Partial,
    /// Numbers of objects and stations that the data determined.
    pub taken: f64,
    /// What their stated places add to the objective.
    pub objective: f64,
    /// First the stations', then the objects'.
    triangles: Vec<Triangle>,
}

impl Eliminated {
    /// Eliminates from all rows; `components` is how many there are, `columns` how many the chain has, `state` the numbers
    /// of objects and stations where the rows were made.
    pub fn of(
        unknowns: &Unknowns,
        parts: &[Collected],
        state: &[f64],
        columns: usize,
        components: u64,
    ) -> Self {
        let width = WIDTH + columns + 1;
        let mut rows_of_object: Vec<Vec<(usize, &[f64])>> = vec![Vec::new(); unknowns.objects.len()];
        let mut others: Vec<&[f64]> = Vec::new();
        let mut lengths = vec![0.0; columns];
        for part in parts {
            for (&row, values) in part.row.iter().zip(part.values.chunks_exact(width)) {
                lengths.iter_mut().zip(&values[WIDTH..]).for_each(|(sum, value)| *sum += value * value);
                match unknowns.object[row as usize] {
                    Some(object) => rows_of_object[object as usize].push((row as usize, values)),
                    None => others.push(values),
                }
            }
        }
        let [first_of_station, first_of_object] = [unknowns.first_of_stations(), unknowns.first_of_objects()];
        let of_stations = unknowns.of_stations();
        let one = |(at, rows): (usize, &Vec<(usize, &[f64])>)| {
            let own = first_of_object[at]..first_of_object[at] + unknowns.objects[at].numbers();
            one_object(
                unknowns,
                &first_of_station,
                rows,
                own.collect(),
                unknowns.objects[at].freedom,
                state,
                columns,
            )
        };
        let objects: Vec<OneObject> = rows_of_object.par_iter().enumerate().map(one).collect();

        let mut whole = Partial::new(of_stations + columns);
        let mut taken = 0.0;
        let mut objective = 0.0;
        let mut triangles = Vec::with_capacity(objects.len() + 1);
        for OneObject { triangle, rest, taken: own, objective: prior } in objects {
            let places: Vec<usize> =
                triangle.stations.iter().copied().chain(of_stations..of_stations + columns + 1).collect();
            let mut rows = Rows::zeros(rest.nrows(), of_stations + columns + 1);
            let mut targets: Vec<&mut [f64]> = rows.columns_mut().collect();
            for (column, &place) in places.iter().enumerate() {
                targets[place].iter_mut().zip(rest.col(column).iter()).for_each(|(to, from)| *to = *from);
            }
            drop(targets);
            whole = whole.with(rows);
            taken += own;
            objective += prior;
            triangles.push(triangle);
        }
        let mut rows = Rows::zeros(others.len(), of_stations + columns + 1);
        for (column, target) in rows.columns_mut().skip(of_stations).enumerate() {
            target.iter_mut().zip(&others).for_each(|(to, from)| *to = from[WIDTH + column]);
        }
        whole = whole.with(rows);
        let free = held(unknowns, &first_of_station, state, &mut whole, &mut objective);

        let factor = whole.factor();
        for (at, free) in free.iter().enumerate() {
            let length = whole.length(at);
            taken += f64::from(u8::from(*free && factor[(at, at)].abs() > NOTHING * length));
        }
        let stations = Triangle {
            own: (0..of_stations).collect(),
            stations: Vec::new(),
            factor: factor.subrows(0, of_stations).to_owned(),
        };
        triangles.insert(0, stations);
        let mut rest = factor.submatrix(of_stations, of_stations, columns + 1, columns + 1).to_owned();
        for (column, square) in lengths.iter().enumerate() {
            if rest.col(column).norm_l2() <= NOTHING * square.sqrt() {
                rest.col_mut(column).fill(0.0);
            }
        }
        let mut partial = Partial::new(columns).with_rows(rest.as_ref());
        partial.components = components;
        Self { partial, taken, objective, triangles }
    }

    /// Where objects and stations come to stand when the chain's columns change so, and all goes `stride` times as far as
    /// the rows say.
    pub fn moved(&self, state: &[f64], change: &[f64], stride: f64) -> Vec<f64> {
        let mut by = vec![0.0; state.len()];
        for Triangle { own, stations, factor } in &self.triangles {
            let k = own.len();
            let mut step = vec![0.0; k];
            for row in (0..k).rev() {
                let behind = |from: usize, values: &mut dyn Iterator<Item = f64>| -> f64 {
                    values.enumerate().map(|(at, value)| factor[(row, from + at)] * value).sum()
                };
                let mut left = stride * factor[(row, factor.ncols() - 1)];
                left -= behind(k, &mut stations.iter().map(|&at| by[at]));
                left -= behind(k + stations.len(), &mut change.iter().copied());
                left -= behind(row + 1, &mut step[row + 1..].iter().copied());
                let corner = factor[(row, row)];
                step[row] = if corner == 0.0 { 0.0 } else { left / corner };
            }
            own.iter().zip(step).for_each(|(&at, step)| by[at] = step);
        }
        state.iter().zip(by).map(|(value, step)| value + step).collect()
    }
}

/// What one object leaves of its rows.
struct OneObject {
    triangle: Triangle,
    /// Rows of [its stations | chain | residual].
    rest: Mat<f64>,
    taken: f64,
    objective: f64,
}

/// Eliminates the numbers of one object from its rows.
fn one_object(
    unknowns: &Unknowns,
    first_of_station: &[usize],
    rows: &[(usize, &[f64])],
    own: Vec<usize>,
    freedom: Freedom,
    state: &[f64],
    columns: usize,
) -> OneObject {
    let station_of = |row: usize| unknowns.station[row] as usize;
    let mut seen_from: Vec<usize> = rows.iter().map(|&(row, _)| station_of(row)).collect();
    seen_from.sort_unstable();
    seen_from.dedup();
    seen_from.retain(|&station| unknowns.stations[station].numbers() > 0);
    let k = own.len();
    let width = k + 6 * seen_from.len() + columns + 1;
    let object_part = WIDTH - 6;
    let mut matrix = Rows::zeros(rows.len() + k, width);
    let mut targets: Vec<&mut [f64]> = matrix.columns_mut().collect();
    for (at, (row, values)) in rows.iter().enumerate() {
        (0..k).for_each(|number| targets[number][at] = values[number]);
        if let Some(place) = seen_from.iter().position(|&station| station == station_of(*row)) {
            (0..6).for_each(|number| targets[k + 6 * place + number][at] = values[object_part + number]);
        }
        let behind = k + 6 * seen_from.len();
        (0..=columns).for_each(|number| targets[behind + number][at] = values[WIDTH + number]);
    }
    let mut objective = 0.0;
    let mut lengths = vec![0.0; k];
    for number in 0..k {
        let length = targets[number].iter().map(|value| value * value).sum::<f64>().sqrt();
        lengths[number] = length;
        let at = rows.len() + number;
        if let Freedom::Within { shift_m, .. } = freedom {
            targets[number][at] = 1.0 / shift_m;
            targets[width - 1][at] = -state[own[number]] / shift_m;
            objective += (state[own[number]] / shift_m).powi(2);
        } else {
            targets[number][at] = HOLD * if length > 0.0 { length } else { 1.0 };
        }
    }
    drop(targets);
    let factor = Partial::new(width - 1).with(matrix).factor();
    let determined = |number: usize| factor[(number, number)].abs() > NOTHING * lengths[number];
    let taken = match freedom {
        // Stated places are as many observations as they are numbers.
        Freedom::Within { .. } => 0,
        _ => (0..k).filter(|&number| determined(number) && lengths[number] > 0.0).count(),
    };
    let stations =
        seen_from.iter().flat_map(|&station| first_of_station[station]..first_of_station[station] + 6);
    OneObject {
        rest: factor.submatrix(k, k, width - k, width - k).to_owned(),
        triangle: Triangle { own, stations: stations.collect(), factor: factor.subrows(0, k).to_owned() },
        taken: taken as f64,
        objective,
    }
}

/// Adds what is stated of stations, and rows that hold the others where nothing else does; per number whether it is free.
fn held(
    unknowns: &Unknowns,
    first_of_station: &[usize],
    state: &[f64],
    whole: &mut Partial,
    objective: &mut f64,
) -> Vec<bool> {
    let count = unknowns.of_stations();
    if count == 0 {
        return Vec::new();
    }
    let mut rows = Rows::zeros(count, whole.parameters + 1);
    let mut free = vec![false; count];
    let mut columns: Vec<&mut [f64]> = rows.columns_mut().collect();
    let last = columns.len() - 1;
    for (station, &start) in unknowns.stations.iter().zip(first_of_station) {
        for number in 0..station.numbers() {
            let at = start + number;
            match station.freedom {
                Freedom::Within { shift_m, turn_rad } => {
                    let sigma = if number < 3 { shift_m } else { turn_rad };
                    columns[at][at] = 1.0 / sigma;
                    columns[last][at] = -state[at] / sigma;
                    *objective += (state[at] / sigma).powi(2);
                }
                Freedom::Free | Freedom::Given => {
                    let length = whole.length(at);
                    columns[at][at] = HOLD * if length > 0.0 { length } else { 1.0 };
                    free[at] = true;
                }
            }
        }
    }
    drop(columns);
    *whole = whole.clone().with(rows);
    free
}
