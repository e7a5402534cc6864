//! Set-ups that leave a direction of the stations open: nothing but noise says where they are along it, and the errors come out all the
//! same.

use std::f64::consts::PI;
use std::fmt::Write;

use crate::figures::{calibrated, holds};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::Folder;
use testkit::Random;

const NONE: [(&str, f64); 4] = [("trunnion", 0.0), ("index", 0.0), ("beam_aside", 0.0), ("collimation", 0.0)];

/// The scale of the ranges is nowhere held here.
fn tracker() -> String {
    TRACKER.replace(", Ty(longer*range)", "")
}

/// A ball in sockets that stations share: nothing holds the frame, and each coordinate has a noise of its own.
#[test]
fn sockets_seen_from_unknown_stations_show_the_errors() {
    let folder = Folder::new("unheld-sockets");
    folder.write("tracker.chain", tracker());
    folder.write("study.toml", STUDY.replace("\"target\"", "\"fixed\""));
    for seed in 1..=4 {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        folder.write("rows.csv", room.rows(random, 0.0));
        holds(&calibrated(&folder, "study.toml"), &NONE);
    }
}

/// A line of targets, about which every station may turn.
#[test]
fn targets_in_a_line_show_what_they_can() {
    let folder = Folder::new("unheld-line");
    folder.write("tracker.chain", tracker()).write("study.toml", STUDY);
    for seed in 1..=4 {
        let random = &mut Random::new(seed);
        let mut room = Room::new(random);
        for (number, target) in (0..).zip(&mut room.targets) {
            let along = f64::from(number);
            *target = [0.5 * along - 7.0, 5.0, 0.1 * along];
        }
        folder.write("rows.csv", room.rows(random, 0.0));
        holds(&calibrated(&folder, "study.toml"), &NONE);
    }
}

/// Walls that all stand upright, seen from places that are known to some centimetres: every station may rise and sink.
#[test]
fn upright_walls_show_the_errors_from_stations_of_any_height() {
    let walls = [
        ("north", [0.0, 1.0], 7.0),
        ("south", [0.0, -1.0], 5.5),
        ("east", [1.0, 0.0], 8.0),
        ("west", [-1.0, 0.0], 6.5),
    ];
    let folder = Folder::new("unheld-walls");
    folder.write("tracker.chain", tracker());
    for seed in 1..=4 {
        let random = &mut Random::new(seed);
        let room = Room::new(random);
        let mut rows = String::from("station,object,azimuth [rad],elevation [rad],range [m]\n");
        let mut study = STUDY.replace("\"target\"", "\"plane\"") + "[stations]\n";
        for (number, ([x, y, z], heading)) in room.stations.iter().enumerate() {
            for _ in 0..100 {
                let (azimuth, elevation) = (PI * (2.0 * random.even() - 1.0), 0.8 * random.even() - 0.3);
                let level = [(azimuth - heading).sin(), (azimuth - heading).cos()];
                let hits = walls.map(|(name, [a, b], away)| {
                    let range = (away - a * x - b * y) / (a * level[0] + b * level[1]) / elevation.cos();
                    (if range > 0.0 { range } else { f64::INFINITY }, name)
                });
                let nearest = hits.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
                let (range, name) = nearest.expect("four walls stand all around");
                let is_second = random.even() < 0.5;
                let (azimuth, elevation) =
                    if is_second { (azimuth + PI, PI - elevation) } else { (azimuth, elevation) };
                let [across, up] = [(); 2].map(|()| 4e-5 * random.normal());
                let range = range + 0.5e-3 * random.normal();
                writeln!(rows, "S{number},{name},{:.9},{:.9},{range:.6}", azimuth + across, elevation + up)
                    .expect("a string");
            }
            let [x, y, z] = [*x, *y, *z].map(|place| place + 0.2 * (2.0 * random.even() - 1.0));
            writeln!(study, "S{number} = {{ x = \"{x} m\", y = \"{y} m\", z = \"{z} m\", heading = \"{heading} rad\", rough = true }}")
                .expect("a string");
        }
        folder.write("rows.csv", rows).write("study.toml", study);
        // The others are told only together.
        holds(&calibrated(&folder, "study.toml"), &NONE[1..2]);
    }
}
