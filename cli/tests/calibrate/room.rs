//! A room for simulators of tests: targets, three stations, and what a tracker without errors reads of it, so that all has a closed form.

use std::f64::consts::PI;
use std::fmt::Write;

use crate::random::Random;

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
        let mut rows = String::from("station,object,azimuth [rad],elevation [rad],range [m]\n");
        for (number, (from, heading)) in self.stations.iter().enumerate() {
            for (target, place) in self.targets.iter().enumerate() {
                let away: Point = std::array::from_fn(|axis| place[axis] - from[axis]);
                let level = away[0].hypot(away[1]);
                let (azimuth, elevation) = (away[0].atan2(away[1]) + heading, away[2].atan2(level));
                for (azimuth, elevation) in [(azimuth, elevation), (azimuth + PI, PI - elevation)] {
                    let [across, up, along] = [(); 3].map(|()| random.normal());
                    let [azimuth, elevation, range] = read([azimuth, elevation, level.hypot(away[2])]);
                    let (azimuth, elevation) = (azimuth + 1e-5 * across, elevation + 1e-5 * up);
                    let range = range + 20e-6 * along;
                    writeln!(rows, "S{number},T{target},{azimuth:.9},{elevation:.9},{range:.7}")
                        .expect("a string");
                }
            }
        }
        rows
    }
}
