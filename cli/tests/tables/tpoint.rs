//! TPOINT's files, dates and places through the commands: what is malformed is refused, and what nothing says is remarked on.

use crate::support::Folder;
use crate::words;

const ALT_AZIMUTH: &str = "chain Alt {
    body base on ground { position_error: Rx(tn), Ry(te); motion: Rz(-encoder_az); motion_error: Rz(-ia); }
    body tube on base { position_error: Ry(np); motion: Rx(encoder_el); motion_error: Rx(ie); }
    observe sight: azimuth(y, x), elevation of direction(0, 1, 0) of tube;
}
";
const EVAL: &str = "eval alt.chain --errors e.toml --quantity value --data run.dat --out -";

fn evaluated(name: &str, data: &str) -> crate::support::Run {
    let folder = Folder::new(name);
    folder.write("alt.chain", ALT_AZIMUTH).write("e.toml", "tn = \"0 arcsec\"\n").write("run.dat", data);
    words(&folder, EVAL)
}

#[test]
fn alt_azimuth_records_in_degrees_minutes_seconds_are_read() {
    let run = evaluated("tpoint-dms", "Caption\n:ALTAZ\n31 41 19.6\n10 30 00 40 15 00 10 30 36 40 15 36\n");
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.contains("10.5,40.25,10.51,40.26"), "{run}");
}

/// What is wrong with each line is a test of the reader; here, that a command says so and ends.
#[test]
fn malformed_files_are_refused_with_line_and_reason() {
    for (name, data, why) in [
        ("nosite", "Caption\n:ALTAZ\n10.5 40.25 10.51 40.26\n", "line 3: the site stands before the records"),
        (
            "mixed",
            "Caption\n:ALTAZ\n48 0 0\n1 2 3 4\n:EQUAT\n",
            "line 5: `:EQUAT`, while line 2 says `:ALTAZ`",
        ),
        ("minutes", "Caption\n:ALTAZ\n48 75 0\n1 2 3 4\n", "line 3: `75` minutes"),
    ] {
        let run = evaluated(&format!("tpoint-{name}"), data);
        assert_eq!(run.code, 2, "{name}: {run}");
        assert!(run.stderr.contains(&format!("run.dat: {why}")), "{name}: {run}");
    }
}

/// Records of stars on both sides of the meridian, read without an error.
fn equatorial() -> String {
    let mut data = "Caption\n:EQUAT\n-33 30 00 2026 03 14\n".to_owned();
    for at in 0..12 {
        let place = format!("{:02} 00 00 {:+03} 00 00", at % 12, 5 * at - 30);
        data += &format!("{place} {place} 06 00.00\n");
    }
    data
}

#[test]
fn init_takes_the_latitude_of_the_file_and_asks_for_the_side_of_the_pier() {
    let folder = Folder::new("tpoint-init");
    folder.write("run.dat", equatorial());
    let run = words(&folder, "init run.dat --template equatorial");
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stderr.contains("no row is on the far side of the pier"), "{run}");
    assert!(!run.stderr.contains("guess"), "{run}");
    assert!(
        folder.read("run.chain").contains("const latitude: angle = -33.5 deg;"),
        "{}",
        folder.read("run.chain")
    );
    let run = words(&folder, "calibrate run.toml");
    assert!(run.stderr.contains("no row is on the far side of the pier"), "{run}");
}

#[test]
fn an_hour_that_comes_twice_is_told_and_no_day_of_the_calendar_is_refused() {
    let study = "chain = \"alt.chain\"\ndata = \"data.csv\"\n[columns]\nencoder_az = { column = \"enc_az [deg]\" }\n\
                 encoder_el = { column = \"enc_el [deg]\" }\n[observed]\nkind = \"spherical\"\nazimuth = { column = \"az [deg]\" }\n\
                 elevation = { column = \"el [deg]\" }\n[noise]\norder = \"time\"\n";
    let rows = |times: [&str; 12]| {
        let row = |(at, time): (usize, &str)| {
            let (az, el) = (30 * at, 10 + 5 * at);
            format!("{az},{el},{az}.00{},{el}.00{},{time}\n", at % 3, at % 5)
        };
        let rows: String = times.into_iter().enumerate().map(row).collect();
        format!("enc_az [deg],enc_el [deg],az [deg],el [deg],time\n{rows}")
    };
    let clock = |minutes: [&'static str; 12]| minutes.map(|clock| format!("2026-10-25T{clock}"));
    let night = [
        "01:40", "01:50", "02:10", "02:30", "02:50", "02:58", "02:05", "02:15", "02:30", "02:50", "03:10",
        "03:20",
    ];
    let folder = Folder::new("summer-time");
    folder.write("alt.chain", ALT_AZIMUTH).write("study.toml", study);
    folder.write("data.csv", rows(clock(night).each_ref().map(String::as_str)));
    let run = words(&folder, "calibrate study.toml");
    assert!(run.code < 2, "{run}");
    assert!(run.stderr.contains("row 7: `time` goes back by 53 min"), "{run}");
    for (clock, why) in [
        ("2026-02-30T02:15", "is no day of the calendar"),
        ("2026-10-25T25:00", "is no time of day"),
        ("2026-10-25T00:75", "is no time of day"),
        ("2026-10-25T02:15+99:00", "is in no zone"),
    ] {
        let mut times = clock_of_zones();
        clock.clone_into(&mut times[4]);
        folder.write("data.csv", rows(times.each_ref().map(String::as_str)));
        let run = words(&folder, "calibrate study.toml");
        assert_eq!(run.code, 2, "{clock}: {run}");
        assert!(run.stderr.contains(why) && run.stderr.contains("row 5"), "{clock}: {run}");
    }
}

/// Twelve times of one night that say their zone.
fn clock_of_zones() -> [String; 12] {
    std::array::from_fn(|at| format!("2026-10-24T20:{:02}+02:00", 5 * at))
}
