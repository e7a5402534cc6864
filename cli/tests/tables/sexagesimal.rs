//! Minutes and seconds in cells: read where the unit of the column is a degree or an hour, refused elsewhere.

use crate::support::Folder;
use crate::{column, words};

const CHAIN: &str = "chain Sky {
    body fork on ground { position_error: Rx(tilt); motion: Rz(-ha); motion_error: Rz(-index); }
    body tube on fork { motion: Rx(dec); }
    input clock: time;
    observe sight: direction(0, 1, 0) of tube;
}
";

fn folder(name: &str, data: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("sky.chain", CHAIN).write("e.toml", "tilt = \"0 arcsec\"\n").write("sky.csv", data);
    folder
}

const EVAL: &str =
    "eval sky.chain --errors e.toml --quantity value --data sky.csv --observable sight --out -";

/// The same angles, written in many ways.
#[test]
fn every_way_of_writing_an_angle_is_the_same_angle() {
    let written = folder(
        "sexagesimal-written",
        "star,ha [hour],dec [deg]\na,1 30 45.0,-00:30:36\nb,1:30:45,−0 30 36\nc,+1h30m45s,-0° 30′ 36″\nd,1.5125,-0.51\n",
    );
    let run = words(&written, EVAL);
    assert_eq!(run.code, 0, "{run}");
    for name in ["sight_x", "sight_y", "sight_z"] {
        let column = column(&run.stdout, name);
        let numbers: Vec<f64> = column.iter().map(|cell| cell.parse().expect("a number")).collect();
        assert!(numbers.iter().all(|number| (number - numbers[3]).abs() < 1e-14), "{name}: {numbers:?}");
    }
    // What is not computed leaves as it came.
    assert_eq!(column(&run.stdout, "dec [deg]")[1], "−0 30 36");
}

#[test]
fn what_is_no_angle_is_refused_with_its_place() {
    for (name, cell) in
        [("minutes", "12 75 00"), ("parts", "1 2 3 4"), ("marks", "30m15s"), ("letters", "1 x 3")]
    {
        let folder = folder(&format!("sexagesimal-{name}"), &format!("ha [hour],dec [deg]\n1,2\n{cell},2\n"));
        let run = words(&folder, EVAL);
        assert_eq!(run.code, 2, "{cell}: {run}");
        assert!(run.stderr.contains("line 3") && run.stderr.contains("ha [hour]"), "{cell}: {run}");
    }
    // In rad there are no minutes.
    let folder = folder("sexagesimal-rad", "ha [rad],dec [deg]\n0 30 00,2\n");
    let run = words(&folder, EVAL);
    assert_eq!(run.code, 2, "{run}");
}

#[test]
fn init_reads_them_too() {
    let folder = Folder::new("sexagesimal-init");
    let mut data = "encoder_az [deg],encoder_el [deg],true_az [deg],true_el [deg]\n".to_owned();
    let cell = |degrees: f64| {
        let seconds = (degrees * 36_000.0).round() as i64;
        format!("{} {:02} {:02}.{}", seconds / 36_000, seconds / 600 % 60, seconds / 10 % 60, seconds % 10)
    };
    for row in 0..40 {
        let (azimuth, elevation) = (f64::from((row * 47) % 360), 15.0 + f64::from((row * 31) % 60));
        // An index of 30″, and a tenth of a second of noise.
        let noise = f64::from(row * 7 % 5 - 2) / 36_000.0;
        let seen = [azimuth, elevation, azimuth + noise, elevation + 30.0 / 3600.0 - noise]
            .map(|own| cell(own.max(0.0)));
        data += &format!("{}\n", seen.join(","));
    }
    folder.write("stars.csv", data);
    let run = words(&folder, "init stars.csv");
    assert_eq!(run.code, 0, "{run}");
    let run = words(&folder, "calibrate stars.toml --out result");
    assert_eq!(run.code, 0, "{run}");
    let run = words(&folder, "export result/instrument.toml --form tpoint --out mount.mod");
    assert_eq!(run.code, 0, "{run}");
    let index =
        folder.read("mount.mod").lines().find(|line| line.trim().starts_with("IE")).map(str::to_owned);
    let value: f64 =
        index.as_deref().and_then(|line| line.split_whitespace().nth(1)?.parse().ok()).expect("an index");
    assert!((value - 30.0).abs() < 0.5, "{index:?}");
}
