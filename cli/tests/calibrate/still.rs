//! Joints that stand still while rows are read: each row has another noise of the same turn, and a residual that is that noise.

use std::f64::consts::PI;
use std::fmt::Write;

use crate::figures::{calibrated, first_effect};
use crate::room::{Room, STUDY, TRACKER};
use crate::support::Folder;
use testkit::Random;

/// Of reports on data that hold nothing but noise, no more than one sees anything.
fn see_nothing(verdicts: &[String]) {
    let others = verdicts.iter().filter(|verdict| *verdict != "nothing detectable");
    assert!(others.count() <= 1, "{verdicts:?}");
}

fn verdict(folder: &Folder) -> String {
    calibrated(folder, "study.toml")["verdict"].as_str().expect("a text").to_owned()
}

/// Sets of angles, as surveyors read them: every target ten times in each face from each station.
#[test]
fn sightings_that_are_repeated_are_no_structure() {
    let folder = Folder::new("still-sets");
    folder.write("tracker.chain", TRACKER.replace(", Ty(longer*range)", "")).write("study.toml", STUDY);
    let verdicts: Vec<String> = (1..=6)
        .map(|seed| {
            let random = &mut Random::new(seed);
            let room = Room::new(random);
            let sets: Vec<String> = (0..10).map(|_| room.rows(random, 0.0)).collect();
            let (header, _) = sets[0].split_once('\n').expect("a header");
            let rows: Vec<&str> = sets.iter().flat_map(|set| set.lines().skip(1)).collect();
            folder.write("rows.csv", format!("{header}\n{}\n", rows.join("\n")));
            verdict(&folder)
        })
        .collect();
    see_nothing(&verdicts);
}

/// A turret that stops at so many marks, whose directions are known, and is read so often at each; its pan is read wrongly by so many
/// rad once a turn.
fn stops(folder: &Folder, seed: u64, [marks, times]: [usize; 2], eccentric_rad: f64) {
    let random = &mut Random::new(seed);
    let mut rows = String::from("pan [rad],tilt [rad],x,y,z\n");
    for _ in 0..marks {
        let (pan, tilt) = (2.0 * PI * random.even() - PI, 1.2 * random.even() - 0.2);
        let [x, y, z] = [-pan.sin() * tilt.cos(), pan.cos() * tilt.cos(), tilt.sin()];
        let read = pan - eccentric_rad * pan.cos();
        for _ in 0..times {
            let [a, b] = [(); 2].map(|()| 5e-5 * random.normal());
            writeln!(rows, "{:.9},{:.9},{x:.12},{y:.12},{z:.12}", read + a, tilt + b).expect("a string");
        }
    }
    folder.write("rows.csv", rows);
}

/// A turret, and a study of known directions.
fn turret(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write(
        "pan.chain",
        "chain Pan {
            body head on ground { position_error: Rx(tilt_x), Ry(tilt_y); motion: Rz(pan); motion_error: Rz(zero); }
            body cradle on head { position_error: Ry(square); motion: Rx(tilt); motion_error: Rx(index); }
            observe sight: direction(0, 1, 0) of cradle;
        }",
    );
    folder.write(
        "study.toml",
        "chain = \"pan.chain\"\ndata = \"rows.csv\"\n[observed]\nkind = \"direction\"\nx = \"x\"\ny = \"y\"\nz = \"z\"\n",
    );
    folder
}

/// Few marks read often, and many that are read three times each.
#[test]
fn stops_that_are_read_several_times_are_no_structure() {
    let folder = turret("still-stops");
    for of in [[12, 30], [40, 3]] {
        let verdicts: Vec<String> = (1..=6)
            .map(|seed| {
                stops(&folder, seed, of, 0.0);
                verdict(&folder)
            })
            .collect();
        see_nothing(&verdicts);
    }
}

/// What is there is found all the same.
#[test]
fn an_encoder_off_centre_is_found_at_stops() {
    let folder = turret("still-eccentric");
    for seed in 1..=3 {
        stops(&folder, seed, [40, 10], 1e-4);
        let report = calibrated(&folder, "study.toml");
        assert!(first_effect(&report).contains("encoder eccentricity of pan"), "{report}");
    }
}
