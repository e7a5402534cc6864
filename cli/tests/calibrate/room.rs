//! A room for simulators of tests: targets, three stations, and what a tracker without errors reads of it, so that all has a closed form.

use std::f64::consts::PI;
use std::fmt::Write;

use testkit::Random;

/// A tracker in two faces.
pub const TRACKER: &str = "chain Tracker {
    body alidade on ground { motion: Rz(-azimuth); }
    body tube on alidade { position_error: Ry(trunnion); motion: Rx(elevation); motion_error: Rx(index); }
    body beam on tube { position_error: Tx(beam_aside), Rz(collimation), Ty(longer*range); }
    input range: length;
    observe hit: point(0, range, 0) of beam;
}
";
/// A study of its targets, of which nothing is known.
pub const STUDY: &str = "chain = \"tracker.chain\"\ndata = \"rows.csv\"\n[observed]\nkind = \"target\"\nobject = \"object\"\n\
                     station = \"station\"\n";
const TARGETS: usize = 30;

pub type Point = [f64; 3];

/// Targets in a room, and where three stations stood: place and heading.
pub struct Room {
    pub targets: Vec<Point>,
    pub stations: [(Point, f64); 3],
}

impl Room {
    pub fn new(random: &mut Random) -> Self {
        let mut within = |low: f64, high: f64| low + (high - low) * random.even();
        let targets = (0..TARGETS).map(|_| [within(-8.0, 8.0), within(-8.0, 8.0), within(-1.0, 4.0)]);
        let targets = targets.collect();
        let mut station = |x: f64, y: f64| ([x, y, within(1.2, 1.8)], within(-PI, PI));
        Self { targets, stations: [station(0.0, 0.0), station(4.0, -3.0), station(-3.0, 4.0)] }
    }

    /// Every target in two faces from every station; ranges are read short by a share.
    pub fn rows(&self, random: &mut Random, longer: f64) -> String {
        self.rows_read(random, |[azimuth, elevation, range]| [azimuth, elevation, range / (1.0 + longer)])
    }

    /// The same as something reads them: azimuth and elevation, rad, and range, m.
    pub fn rows_read(&self, random: &mut Random, read: impl Fn([f64; 3]) -> [f64; 3]) -> String {
        let mut rows = String::from(HEADER);
        for (number, station) in self.stations.iter().enumerate() {
            for (target, place) in self.targets.iter().enumerate() {
                for reading in faces(*place, *station) {
                    write_row(&mut rows, random, [number, target], read(reading));
                }
            }
        }
        rows
    }

    /// Every target in one face and then in the other, while each station sinks by so many m and twists by so many rad.
    pub fn rows_moving(&self, random: &mut Random, sinks_m: f64, twists_rad: f64) -> String {
        let mut rows = String::from(HEADER);
        for (number, ([x, y, z], heading)) in self.stations.iter().enumerate() {
            for face in 0..2 {
                for (target, place) in self.targets.iter().enumerate() {
                    let share = (face * TARGETS + target) as f64 / (2 * TARGETS) as f64;
                    let station = ([*x, *y, z - sinks_m * share], heading + twists_rad * share);
                    write_row(&mut rows, random, [number, target], faces(*place, station)[face]);
                }
            }
        }
        rows
    }
}

const HEADER: &str = "station,object,azimuth [rad],elevation [rad],range [m]\n";

/// What is read of a place in each face.
fn faces(place: Point, (from, heading): (Point, f64)) -> [[f64; 3]; 2] {
    let away: Point = std::array::from_fn(|axis| place[axis] - from[axis]);
    let level = away[0].hypot(away[1]);
    let (azimuth, elevation) = (away[0].atan2(away[1]) + heading, away[2].atan2(level));
    let range = level.hypot(away[2]);
    [[azimuth, elevation, range], [azimuth + PI, PI - elevation, range]]
}

fn write_row(rows: &mut String, random: &mut Random, [station, target]: [usize; 2], reading: [f64; 3]) {
    let [across, up, along] = [(); 3].map(|()| random.normal());
    let [azimuth, elevation, range] = reading;
    let (azimuth, elevation) = (azimuth + 1e-5 * across, elevation + 1e-5 * up);
    let range = range + 20e-6 * along;
    writeln!(rows, "S{station},T{target},{azimuth:.9},{elevation:.9},{range:.7}").expect("a string");
}
