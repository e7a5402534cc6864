//! What rows observe without anybody knowing where it is: planes, targets, sockets, wires, and the stations from which they
//! were seen; and which row has to do with which.

mod believed;
mod frame;
mod pose;
mod state;

use faer::Mat;
use nalgebra::Vector3;

use super::tangent_frame;

pub use believed::OfStation;
pub use pose::Pose;
pub use pose::right_jacobian;
pub use state::State;

/// The most numbers of one object.
pub const OF_OBJECT: usize = 6;

/// The numbers of an object and of a station that a residual component can hang on.
pub const WIDTH: usize = OF_OBJECT + 6;

/// The numbers of a station that tilt it.
const TILTS: [usize; 2] = [3, 4];

/// What an object is, and with that which numbers it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// A plane n·x = d: two numbers tilt n, one shifts d.
    Plane,
    /// A point: a target, the centre of a ball.
    Point,
    /// A wire from an anchor to the observed point, wound off a drum: the anchor, and the length that the reading lacks.
    Wire,
    /// A circle: two numbers tilt its axis, three shift its centre, one is its radius.
    Circle,
    /// A circle whose radius is known.
    Ring,
}

impl Shape {
    /// How many numbers it has.
    #[must_use]
    pub fn numbers(self) -> usize {
        match self {
            Self::Plane | Self::Point => 3,
            Self::Wire => 4,
            Self::Ring => 5,
            Self::Circle => 6,
        }
    }
}

/// What is known of where something is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Freedom {
    /// Nothing: the data say where.
    Free,
    /// It is there.
    Given,
    /// It is there, but for these standard uncertainties: of each coordinate in m, of each turn in rad.
    Within {
        /// Of each coordinate, m.
        shift_m: f64,
        /// Of each turn, rad.
        turn_rad: f64,
    },
}

impl Freedom {
    /// Whether it is stated to within an uncertainty.
    pub fn is_within(self) -> bool {
        matches!(self, Self::Within { .. })
    }
}

/// How the place came about that the numbers of an object or station count from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// Nobody has said or found one yet.
    No,
    /// The study says it, or `network::place` found it.
    Yes,
}

/// The numbers of one thing, as far as they are estimated.
pub fn own_numbers<const N: usize>(state: &[f64], first: usize, count: usize) -> [f64; N] {
    let mut own = [0.0; N];
    own.iter_mut().zip(state.iter().skip(first).take(count)).for_each(|(own, value)| *own = *value);
    own
}

/// The normal of a plane at its two numbers of tilt, and its derivative by each.
pub fn tilted(normal: &Vector3<f64>, tilt: [f64; 2]) -> (Vector3<f64>, [Vector3<f64>; 2]) {
    let [first, second] = tangent_frame(normal);
    let long = normal + first * tilt[0] + second * tilt[1];
    let length = long.norm();
    let n = long / length;
    (n, [first, second].map(|axis| (axis - n * n.dot(&axis)) / length))
}

/// Something that rows observe.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// What the data file calls it.
    pub label: String,
    /// What it is.
    pub shape: Shape,
    /// Whether the data are to say where it is.
    pub freedom: Freedom,
    /// Whether `place` and `normal` mean anything yet.
    pub known: Known,
    /// A point of the plane, the point, the anchor, or the centre, in the objects' frame, m; the numbers count from it.
    pub place: Vector3<f64>,
    /// The normal of a plane, the axis of a circle; else zero.
    pub normal: Vector3<f64>,
    /// What a wire's reading lacks, or the radius of a circle as far as no reading says it, m; else zero.
    pub offset: f64,
}

impl Object {
    /// One of which nothing is known.
    #[must_use]
    pub fn unknown(label: String, shape: Shape) -> Self {
        let (place, normal) = (Vector3::zeros(), Vector3::zeros());
        Self { label, shape, freedom: Freedom::Free, known: Known::No, place, normal, offset: 0.0 }
    }

    /// How many numbers are estimated.
    #[must_use]
    pub fn numbers(&self) -> usize {
        if self.freedom == Freedom::Given { 0 } else { self.shape.numbers() }
    }

    /// Moves it by its numbers.
    fn move_by(&mut self, own: [f64; OF_OBJECT]) {
        match self.shape {
            Shape::Plane => {
                (self.normal, _) = tilted(&self.normal, [own[0], own[1]]);
                self.place += self.normal * own[2];
            }
            Shape::Point | Shape::Wire => {
                self.place += Vector3::new(own[0], own[1], own[2]);
                self.offset += own[3];
            }
            Shape::Circle | Shape::Ring => {
                (self.normal, _) = tilted(&self.normal, [own[0], own[1]]);
                self.place += Vector3::new(own[2], own[3], own[4]);
                self.offset += own[5];
            }
        }
    }
}

/// Where the instrument stood.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// What the data file calls it; empty where no rows name one and the chain's ground is the frame.
    pub label: String,
    /// Whether the data are to say where it is.
    pub freedom: Freedom,
    /// Whether `pose` means anything yet.
    pub known: Known,
    /// The pose that its six numbers count from.
    pub pose: Pose,
    /// The standard uncertainty of each tilt where it was levelled, rad; its pose is upright then.
    pub level_rad: Option<f64>,
}

impl Station {
    /// One of which nothing is known.
    #[must_use]
    pub fn unknown(label: String) -> Self {
        Self { label, freedom: Freedom::Free, known: Known::No, pose: Pose::default(), level_rad: None }
    }

    /// The chain's own ground, where rows name no station.
    #[must_use]
    pub fn ground() -> Self {
        Self { freedom: Freedom::Given, known: Known::Yes, ..Self::unknown(String::new()) }
    }

    /// How many numbers are estimated.
    #[must_use]
    pub fn numbers(&self) -> usize {
        if self.freedom == Freedom::Given { 0 } else { 6 }
    }

    /// The standard uncertainty that is stated of one of its numbers, m for a shift and rad for a turn; none where nothing is.
    pub fn stated(&self, number: usize) -> Option<f64> {
        let of_level = self.level_rad.filter(|_| TILTS.contains(&number));
        of_level.or(match self.freedom {
            Freedom::Within { shift_m, turn_rad } => Some(if number < 3 { shift_m } else { turn_rad }),
            Freedom::Free | Freedom::Given => None,
        })
    }

    /// Whether a study writes where it stood, be it roughly.
    pub fn is_written(&self) -> bool {
        self.known == Known::Yes && !self.label.is_empty()
    }
}

/// Where things are as far as the study says.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Places {
    /// Stations by their labels.
    pub stations: Vec<Station>,
    /// Objects by their labels.
    pub objects: Vec<Object>,
    /// The standard uncertainty of each tilt of the stations that are not among them, where all were levelled, rad.
    pub level_rad: Option<f64>,
}

impl Places {
    /// The station of a label: as the study says, or unknown.
    pub fn station(&self, label: &str) -> Station {
        let known = self.stations.iter().find(|station| station.label == label);
        let unknown = || Station { level_rad: self.level_rad, ..Station::unknown(label.to_owned()) };
        known.cloned().unwrap_or_else(unknown)
    }

    /// The object of a label: as the study says, or unknown.
    pub fn object(&self, label: &str, shape: Shape) -> Object {
        let known = self.objects.iter().find(|object| object.label == label && object.shape == shape);
        known.cloned().unwrap_or_else(|| Object::unknown(label.to_owned(), shape))
    }
}

/// What the rows of some observations have to do with.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Unknowns {
    /// The objects.
    pub objects: Vec<Object>,
    /// The stations.
    pub stations: Vec<Station>,
    /// The object of each row; none where a row observes nothing unknown.
    pub object: Vec<Option<u32>>,
    /// The station of each row.
    pub station: Vec<u32>,
}

impl Unknowns {
    /// The numbers that are estimated: first six for each station that is not given, then those of each object.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.of_stations() + self.objects.iter().map(Object::numbers).sum::<usize>()
    }

    /// The numbers that are estimated among the values of a fit: they stand behind those of the chain.
    ///
    /// # Panics
    /// Where the values are not those of a fit of these.
    #[must_use]
    pub fn state<'a>(&self, values: &'a [f64]) -> &'a [f64] {
        &values[values.len() - self.numbers()..]
    }

    /// How many of them are the stations'.
    #[must_use]
    pub fn of_stations(&self) -> usize {
        self.stations.iter().map(Station::numbers).sum()
    }

    /// Of how many objects the study says nothing but a start at most; none where it says something of all.
    #[must_use]
    pub fn unknown_objects(&self) -> Option<usize> {
        let unknown = self.objects.iter().filter(|object| object.freedom == Freedom::Free).count();
        (unknown > 0).then_some(unknown)
    }

    /// Where the numbers of each station begin.
    #[must_use]
    pub fn first_of_stations(&self) -> Vec<usize> {
        first(self.stations.iter().map(Station::numbers), 0)
    }

    /// Where the numbers of each object begin.
    #[must_use]
    pub fn first_of_objects(&self) -> Vec<usize> {
        first(self.objects.iter().map(Object::numbers), self.of_stations())
    }

    /// How far from each station the objects of its rows start, on average, m; zero where it has none.
    #[must_use]
    pub fn away_m(&self) -> Vec<f64> {
        let mut sums = vec![(0.0, 0.0); self.stations.len()];
        for (object, &station) in self.object.iter().zip(&self.station) {
            if let Some(object) = *object {
                let from = self.stations[station as usize].pose.shift;
                let (sum, count) = &mut sums[station as usize];
                *sum += (self.objects[object as usize].place - from).norm();
                *count += 1.0;
            }
        }
        sums.into_iter().map(|(sum, count)| if count > 0.0 { sum / count } else { 0.0 }).collect()
    }

    /// The labels of the station and of the object of a row; none where it has none.
    #[must_use]
    pub fn labels(&self, row: usize) -> [Option<&str>; 2] {
        let station = self.station.get(row).map(|&own| self.stations[own as usize].label.as_str());
        let object = self.object.get(row).copied().flatten();
        let object = object.map(|own| self.objects[own as usize].label.as_str());
        [station, object].map(|label| label.filter(|label| !label.is_empty()))
    }

    /// The same with objects and stations where these numbers have them: the numbers count from there.
    #[must_use]
    pub fn at(&self, numbers: &[f64]) -> Self {
        let mut there = self.clone();
        let firsts = self.first_of_stations();
        for (station, first) in there.stations.iter_mut().zip(firsts).filter(|(own, _)| own.numbers() > 0) {
            station.pose = station.pose.moved(&own_numbers(numbers, first, station.numbers()));
        }
        for (object, first) in there.objects.iter_mut().zip(self.first_of_objects()) {
            if object.numbers() > 0 {
                object.move_by(own_numbers(numbers, first, object.numbers()));
            }
        }
        there
    }

    /// The same for some of the rows; objects and stations that no row of them has to do with stay.
    #[must_use]
    pub fn select(&self, rows: &[usize]) -> Self {
        Self {
            object: rows.iter().filter_map(|&row| self.object.get(row).copied()).collect(),
            station: rows.iter().filter_map(|&row| self.station.get(row).copied()).collect(),
            ..self.clone()
        }
    }

    /// Removes objects that no row has to do with.
    pub(crate) fn remove_objects(&mut self, is_removed: impl Fn(usize) -> bool) {
        let kept: Vec<usize> = (0..self.objects.len()).filter(|&object| !is_removed(object)).collect();
        let place = |object: u32| kept.partition_point(|own| *own < object as usize) as u32;
        self.object.iter_mut().for_each(|own| *own = own.map(place));
        self.objects = kept.iter().map(|&object| self.objects[object].clone()).collect();
    }

    /// The derivatives of components, each of a row, by the stations' numbers that are estimated: one column a number.
    pub fn station_columns(&self, row: &[u32], unknown: &[[f64; WIDTH]]) -> Mat<f64> {
        let first = self.first_of_stations();
        let mut columns = Mat::zeros(row.len(), self.of_stations());
        for (component, &row) in row.iter().enumerate() {
            let station = self.station[row as usize] as usize;
            for number in 0..self.stations[station].numbers() {
                columns[(component, first[station] + number)] = unknown[component][WIDTH - 6 + number];
            }
        }
        columns
    }
}

fn first(numbers: impl Iterator<Item = usize>, start: usize) -> Vec<usize> {
    let mut next = start;
    numbers
        .map(|own| {
            next += own;
            next - own
        })
        .collect()
}
