//! The elimination: each object's few numbers by a factor of their own, then the stations' from what the objects left.
//!
//! What remains is the factor of the chain's columns as if objects and stations had followed every change of the errors:
//! variable projection. A direction in which no row moves an object or station is held by a row so weak that it takes no
//! part in anything else.
//!
//! A row knows one object and one station. So the rows of one object from one station are rotated among themselves until its
//! numbers move no more than a few of them: the others go to their station's own sum, and only those few, with the columns of
//! every station that saw the object, to the sum of all. The cost grows with the rows.
//!
//! Source: G. H. Golub, V. Pereyra, Separable nonlinear least squares: the variable projection method and its
//! applications, Inverse Problems 19 (2003) R1-R26; eliminated block by block as in a bundle adjustment.

use faer::{Mat, MatRef};

use super::gathered::Gathered;
use crate::{Partial, Rows};
use observe::unknowns::{Freedom, OF_OBJECT, Unknowns, WIDTH};

/// The weight of the rows that hold what nothing else holds, in units of the column's length. Much less, and rounding would
/// move a frame that nothing holds further than a step does.
pub(super) const HOLD: f64 = 1e-6;

/// How surely a free station is where it starts: to so many rad, and to this share of how far away its objects are. It decides where
/// nothing but noise does: walls that all stand upright tell a height by how far noise tips them, to some metres.
const STARTS_WITHIN: f64 = 0.1;

/// Whether the start of free stations holds them; it does not where components are in no unit of noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Starts {
    /// It holds them.
    Hold,
    /// It does not.
    Ignore,
}

/// A direction of stations that the rows hold by less than so many times as much as their start does is none that rows determined.
const BY_START: f64 = 30.0;

/// Parts that the objects are cut into: as many whatever the number of processors, which changes no bit.
const PARTS: usize = 8;

/// A column of which less than this share is left, objects and stations aside, moved nothing else.
const NOTHING: f64 = 3e-5;

/// Whitened and weighted rows of one component each: the derivatives by object and station, those by the chain's columns,
/// and the residual.
#[derive(Debug, Clone, Default)]
pub struct Collected {
    /// The row of the observations of each component.
    pub row: Vec<u32>,
    /// `WIDTH` derivatives, the chain's columns, the residual; component after component.
    pub values: Vec<f64>,
}

/// A triangle that gives the change of some unknown numbers for a change of what comes behind them.
#[derive(Debug, Clone)]
pub(super) struct Triangle {
    /// Where the numbers stand among all.
    pub own: Vec<usize>,
    /// Where the numbers of stations stand that they hang on.
    pub stations: Vec<usize>,
    /// Rows of [own | stations | chain | residual], as many as own.
    pub factor: Mat<f64>,
}

/// What is left of rows once the objects and stations are eliminated.
#[derive(Debug, Clone)]
pub struct Eliminated {
    /// The factor of the chain's columns.
    pub partial: Partial,
    /// Numbers of objects and stations that the data determined.
    pub taken: f64,
    /// What their stated places add to the objective.
    pub objective: f64,
    /// First the stations', then the objects'.
    pub(super) triangles: Vec<Triangle>,
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
        starts: Starts,
    ) -> Self {
        let width = WIDTH + columns + 1;
        // Behind the objects' rows come those that observe none.
        let mut of_object: Vec<Vec<(u32, &[f64])>> = vec![Vec::new(); unknowns.objects.len() + 1];
        for part in parts {
            for (&row, values) in part.row.iter().zip(part.values.chunks_exact(width)) {
                let object = unknowns.object[row as usize].map_or(unknowns.objects.len(), |at| at as usize);
                of_object[object].push((row, values));
            }
        }
        let layout = Layout::new(unknowns, state, columns);
        let all: Vec<usize> = (0..of_object.len()).collect();
        let parts = parallel::each_of(all.chunks(of_object.len().div_ceil(PARTS)), |objects| {
            let mut sums = Sums::new(&layout);
            for &object in objects {
                if object == unknowns.objects.len() {
                    sums.take_bare(&layout, &of_object[object]);
                } else {
                    sums.take(&layout, object, &of_object[object]);
                }
            }
            sums
        });
        let mut sums = Sums::new(&layout);
        parts.into_iter().for_each(|part| sums.merge(part));
        let Sums { mut whole, of_station, bare, mut taken, mut objective, mut triangles, lengths } = sums;
        let of_stations = layout.of_stations;
        for (station, own) in of_station.into_iter().enumerate() {
            if let Some(own) = own {
                let start = layout.first_of_station[station];
                let places = (start..start + OF_STATION).chain(of_stations..of_stations + columns + 1);
                let own = own.into_whole().factor();
                whole.add(spread(own.nrows(), self::columns(&own), places, of_stations + columns + 1));
            }
        }
        let bare = bare.into_whole().factor();
        let places = of_stations..of_stations + columns + 1;
        whole.add(spread(bare.nrows(), self::columns(&bare), places, of_stations + columns + 1));
        let mut whole = whole.into_whole();
        let free = held(&layout, starts, &mut whole, &mut objective);

        let factor = whole.factor();
        for (at, free) in free.iter().enumerate() {
            let least = free.map(|by_start| (NOTHING * whole.length(at)).max(BY_START * by_start));
            taken += f64::from(u8::from(least.is_some_and(|least| factor[(at, at)].abs() > least)));
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

    /// The triangle of the stations' numbers, with the chain's columns and the residual behind them.
    pub(super) fn of_stations(&self) -> MatRef<'_, f64> {
        match self.triangles.first() {
            Some(stations) => stations.factor.as_ref(),
            None => unreachable!("the stations' triangle comes first, be it empty"),
        }
    }

    /// Where objects and stations come to stand when the chain's columns change so, and all goes `stride` times as far as
    /// the rows say.
    pub fn moved(&self, state: &[f64], change: &[f64], stride: f64) -> Vec<f64> {
        let mut by = vec![0.0; state.len()];
        for Triangle { own, stations, factor } in &self.triangles {
            let k = own.len();
            let step = divided_out(factor.as_ref(), k, |row| {
                let behind = |from: usize, values: &mut dyn Iterator<Item = f64>| -> f64 {
                    values.enumerate().map(|(at, value)| factor[(row, from + at)] * value).sum()
                };
                let mut right = stride * factor[(row, factor.ncols() - 1)];
                right -= behind(k, &mut stations.iter().map(|&at| by[at]));
                right -= behind(k + stations.len(), &mut change.iter().copied());
                right
            });
            own.iter().zip(step).for_each(|(&at, step)| by[at] = step);
        }
        state.iter().zip(by).map(|(value, step)| value + step).collect()
    }
}

/// The numbers whose product with the triangle of the first so many columns is `right`, zero where the triangle has no corner.
///
/// Not `faer`'s substitution, which divides by the corner whatever it is.
pub(super) fn divided_out(factor: MatRef<'_, f64>, count: usize, right: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut numbers = vec![0.0; count];
    for row in (0..count).rev() {
        let behind: f64 = (row + 1..count).map(|at| factor[(row, at)] * numbers[at]).sum();
        let corner = factor[(row, row)];
        numbers[row] = if corner == 0.0 { 0.0 } else { (right(row) - behind) / corner };
    }
    numbers
}

/// What the elimination reads throughout.
struct Layout<'a> {
    unknowns: &'a Unknowns,
    state: &'a [f64],
    columns: usize,
    of_stations: usize,
    first_of_station: Vec<usize>,
    first_of_object: Vec<usize>,
}

impl<'a> Layout<'a> {
    fn new(unknowns: &'a Unknowns, state: &'a [f64], columns: usize) -> Self {
        Self {
            unknowns,
            state,
            columns,
            of_stations: unknowns.of_stations(),
            first_of_station: unknowns.first_of_stations(),
            first_of_object: unknowns.first_of_objects(),
        }
    }

    /// The station of a row if its numbers are estimated.
    fn station_of(&self, row: u32) -> Option<usize> {
        let station = self.unknowns.station[row as usize] as usize;
        (self.unknowns.stations[station].numbers() > 0).then_some(station)
    }
}

/// What some objects leave of their rows.
struct Sums {
    /// Over the columns of all stations and the chain.
    whole: Gathered,
    /// Over the columns of one station and the chain; none where nothing came of it.
    of_station: Vec<Option<Gathered>>,
    /// Over the chain's columns, of rows that move no station.
    bare: Gathered,
    taken: f64,
    objective: f64,
    triangles: Vec<Triangle>,
    /// Sum of squares of each of the chain's columns.
    lengths: Vec<f64>,
}

impl Sums {
    fn new(layout: &Layout<'_>) -> Self {
        Self {
            whole: Gathered::new(layout.of_stations + layout.columns),
            of_station: vec![None; layout.unknowns.stations.len()],
            bare: Gathered::new(layout.columns),
            taken: 0.0,
            objective: 0.0,
            triangles: Vec::new(),
            lengths: vec![0.0; layout.columns],
        }
    }

    fn merge(&mut self, other: Self) {
        self.whole.add(rows(&other.whole.into_whole().factor()));
        for (own, other) in self.of_station.iter_mut().zip(other.of_station) {
            match (own.as_mut(), other) {
                (Some(own), Some(other)) => own.add(rows(&other.into_whole().factor())),
                (None, other) => *own = other,
                (Some(_), None) => {}
            }
        }
        self.bare.add(rows(&other.bare.into_whole().factor()));
        self.taken += other.taken;
        self.objective += other.objective;
        self.triangles.extend(other.triangles);
        self.lengths.iter_mut().zip(other.lengths).for_each(|(own, other)| *own += other);
    }

    /// Takes in rows that observe no object.
    fn take_bare(&mut self, layout: &Layout<'_>, rows: &[(u32, &[f64])]) {
        self.measure(rows);
        let mut matrix = Rows::zeros(rows.len(), layout.columns + 1);
        fill(&mut matrix, rows, WIDTH..WIDTH + layout.columns + 1);
        self.bare.add(matrix);
    }

    fn measure(&mut self, rows: &[(u32, &[f64])]) {
        for (_, values) in rows {
            self.lengths.iter_mut().zip(&values[WIDTH..]).for_each(|(sum, value)| *sum += value * value);
        }
    }

    /// Eliminates the numbers of one object from its rows.
    fn take(&mut self, layout: &Layout<'_>, object: usize, rows: &[(u32, &[f64])]) {
        self.measure(rows);
        let (columns, thing) = (layout.columns, &layout.unknowns.objects[object]);
        let k = thing.numbers();
        let own = layout.first_of_object[object]..layout.first_of_object[object] + k;
        let mut lengths = vec![0.0_f64; k];
        for (_, values) in rows {
            lengths.iter_mut().zip(*values).for_each(|(sum, value)| *sum += value * value);
        }
        lengths.iter_mut().for_each(|square| *square = square.sqrt());

        // From each station what moves the object, and the rest to the station's sum.
        let mut order: Vec<(Option<usize>, u32, &[f64])> =
            rows.iter().map(|&(row, values)| (layout.station_of(row), row, values)).collect();
        order.sort_by_key(|&(station, row, _)| (station, row));
        let mut telling: Vec<(Option<usize>, Mat<f64>)> = Vec::new();
        for seen in order.chunk_by(|a, b| a.0 == b.0) {
            let station = seen[0].0;
            let rows: Vec<(u32, &[f64])> = seen.iter().map(|&(_, row, values)| (row, values)).collect();
            // The derivatives by the station stand right before those by the chain.
            let of_station = if station.is_some() { OF_STATION } else { 0 };
            let behind = WIDTH - of_station..WIDTH + columns + 1;
            let mut matrix = Rows::zeros(rows.len(), k + behind.len());
            fill(&mut matrix, &rows, (0..k).chain(behind));
            if rows.len() <= k {
                telling.push((station, matrix.to_matrix()));
                continue;
            }
            let (few, rest) = matrix.split(k);
            telling.push((station, few));
            match station {
                None => self.bare.add(rest),
                Some(station) => {
                    let sum = &mut self.of_station[station];
                    sum.get_or_insert_with(|| Gathered::new(OF_STATION + columns)).add(rest);
                }
            }
        }

        if k == 0 {
            // All has gone to the stations: where the object is, is known.
            return;
        }
        let stations: Vec<usize> = telling.iter().filter_map(|(station, _)| *station).collect();
        let behind = k + OF_STATION * stations.len();
        let width = behind + columns + 1;
        let count: usize = telling.iter().map(|(_, few)| few.nrows()).sum();
        let mut matrix = Rows::zeros(count + k, width);
        let mut targets: Vec<&mut [f64]> = matrix.columns_mut().collect();
        let mut at = 0;
        for (station, few) in &telling {
            let place = station.and_then(|station| stations.iter().position(|&other| other == station));
            let of_station = place.map_or(0..0, |place| k + OF_STATION * place..k + OF_STATION * (place + 1));
            for (from, to) in few.col_iter().zip((0..k).chain(of_station).chain(behind..width)) {
                targets[to][at..at + few.nrows()]
                    .iter_mut()
                    .zip(from.iter())
                    .for_each(|(to, from)| *to = *from);
            }
            at += few.nrows();
        }
        for (number, &length) in lengths.iter().enumerate() {
            if let Freedom::Within { shift_m, .. } = thing.freedom {
                let state = layout.state[own.start + number];
                targets[number][count + number] = 1.0 / shift_m;
                targets[width - 1][count + number] = -state / shift_m;
                self.objective += (state / shift_m).powi(2);
            } else {
                targets[number][count + number] = HOLD * if length > 0.0 { length } else { 1.0 };
            }
        }
        drop(targets);
        let (factor, mut rest) = matrix.split(k);
        let determined = |&number: &usize| {
            factor[(number, number)].abs() > NOTHING * lengths[number] && lengths[number] > 0.0
        };
        // Stated places are as many observations as they are numbers.
        if !thing.freedom.is_within() {
            self.taken += (0..k).filter(determined).count() as f64;
        }
        let of_stations = layout.of_stations;
        let numbers: Vec<usize> = stations
            .iter()
            .map(|&station| layout.first_of_station[station])
            .flat_map(|start| start..start + OF_STATION)
            .collect();
        let places = numbers.iter().copied().chain(of_stations..of_stations + columns + 1);
        let rest = rest.columns_mut().map(|column| &*column);
        self.whole.add(spread(count + k, rest, places, of_stations + columns + 1));
        self.triangles.push(Triangle { own: own.collect(), stations: numbers, factor });
    }
}

/// The numbers of a station.
pub(super) const OF_STATION: usize = WIDTH - OF_OBJECT;

/// Fills a matrix with some numbers of some rows.
fn fill(matrix: &mut Rows, rows: &[(u32, &[f64])], chosen: impl Iterator<Item = usize>) {
    for (target, number) in matrix.columns_mut().zip(chosen) {
        target.iter_mut().zip(rows).for_each(|(to, (_, values))| *to = values[number]);
    }
}

/// So many rows whose columns stand at some places among `width`.
fn spread<'a>(
    count: usize,
    columns: impl Iterator<Item = &'a [f64]>,
    places: impl Iterator<Item = usize>,
    width: usize,
) -> Rows {
    let mut spread = Rows::zeros(count, width);
    let mut targets: Vec<&mut [f64]> = spread.columns_mut().collect();
    for (from, to) in columns.zip(places) {
        targets[to].copy_from_slice(from);
    }
    drop(targets);
    spread
}

/// The columns of a matrix.
fn columns(matrix: &Mat<f64>) -> impl Iterator<Item = &[f64]> {
    (0..matrix.ncols()).map(|column| matrix.col_as_slice(column))
}

/// A matrix as rows.
fn rows(matrix: &Mat<f64>) -> Rows {
    spread(matrix.nrows(), columns(matrix), 0..matrix.ncols(), matrix.ncols())
}

/// Adds what is stated of stations, and rows that hold the others where nothing else does; per number that is free how much its start
/// holds it.
fn held(layout: &Layout<'_>, starts: Starts, whole: &mut Partial, objective: &mut f64) -> Vec<Option<f64>> {
    let count = layout.of_stations;
    if count == 0 {
        return Vec::new();
    }
    let mut rows = Rows::zeros(count, whole.parameters + 1);
    let mut free = vec![None; count];
    let mut columns: Vec<&mut [f64]> = rows.columns_mut().collect();
    let last = columns.len() - 1;
    let stations = layout.unknowns.stations.iter().zip(layout.unknowns.away_m());
    for ((station, away_m), &start) in stations.zip(&layout.first_of_station) {
        for number in 0..station.numbers() {
            let at = start + number;
            match station.stated(number) {
                Some(sigma) => {
                    columns[at][at] = 1.0 / sigma;
                    columns[last][at] = -layout.state[at] / sigma;
                    *objective += (layout.state[at] / sigma).powi(2);
                }
                None => {
                    let length = whole.length(at);
                    let held = HOLD * if length > 0.0 { length } else { 1.0 };
                    let within = STARTS_WITHIN * if number < 3 { away_m } else { 1.0 };
                    let by_start = if within > 0.0 && starts == Starts::Hold { 1.0 / within } else { 0.0 };
                    let weight = held.hypot(by_start);
                    columns[at][at] = weight;
                    columns[last][at] = -layout.state[at] * by_start * by_start / weight;
                    *objective += (layout.state[at] * by_start).powi(2);
                    free[at] = Some(by_start);
                }
            }
        }
    }
    drop(columns);
    whole.add(rows);
    free
}
