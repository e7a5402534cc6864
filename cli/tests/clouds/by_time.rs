//! Readings from a table by GPS time.

use crate::support::Folder;
use crate::whole::Whole;
use crate::{applied, assert_steps, bytes, folder, refused, steps};

fn timed(name: &str) -> (Folder, String) {
    let folder = folder(name, &["timed.las", "timed.csv"]);
    (folder, String::from_utf8(bytes("timed.csv")).expect("a text"))
}

/// The head turns through zero between two rows: the short way round is the right one.
#[test]
fn angles_between_rows_go_the_short_way_round() {
    let (folder, table) = timed("cloud_timed");
    let file = applied(&folder, "timed.las", "out.laz", &["--readings", "timed.csv"]);
    let whole = Whole::of(&file);
    assert_steps("timed", &whole.steps(), &steps("timed"));
    assert_eq!(whole.without_coordinates(), Whole::of(&bytes("timed.las")).without_coordinates());
    // Another name for the times, another separator, comments.
    let other = table.replace("gps_time [s]", "clock").replace("row 7", "row 7\n# a break");
    folder.write("other.csv", other);
    let other = ["--readings", "other.csv", "--time", "clock", "--comment", "#"];
    assert_eq!(applied(&folder, "timed.las", "other.laz", &other), file);
    // A table that has a range, too, leaves open which is meant.
    let both = table.replace("note", "range").replace("row ", "");
    folder.write("both.csv", both);
    let said = refused(&folder, "timed.las", "no.laz", &["--readings", "both.csv"]);
    assert!(
        said.contains("its points have a dimension `range`, and both.csv a column of that name"),
        "{said}"
    );
}

#[test]
fn a_table_that_cannot_serve_every_point_is_refused() {
    let (folder, table) = timed("cloud_timed_wrong");
    let lines: Vec<&str> = table.lines().collect();
    let without = |from: usize, to: usize| [&lines[..from], &lines[to..]].concat().join("\n");
    let swapped = {
        let mut lines = lines.clone();
        lines.swap(5, 6);
        lines.join("\n")
    };
    let twice = [&lines[..9], &lines[8..]].concat().join("\n");
    for (name, table, wanted) in [
        (
            "late",
            without(1, 5),
            &["point 1: its time is 5000", "seconds of the GPS week", "5000.4 s to 5004 s"][..],
        ),
        ("short", without(30, 42), &["of 5000 s to 5002.8 s"]),
        ("gap", without(12, 26), &["a gap there, from 5001 s to 5002.5 s", "every 1.000e-1 s"]),
        ("swapped", swapped, &["swapped.csv: row 6: its time 5000.4 is not after 5000.5", "sort the table"]),
        ("twice", twice, &["twice.csv: row 9: its time 5000.7 is not after 5000.7"]),
        (
            "unnamed",
            table.replace("gps_time [s]", "clock"),
            &["no column `gps_time` or `time`", "--time", "`clock`"],
        ),
        (
            "milli",
            table.replace("gps_time [s]", "gps_time [ms]"),
            &["GPS times are seconds", "`gps_time [s]`"],
        ),
        (
            "two",
            table.replace("note", "time").replace("row ", ""),
            &["both `gps_time`, `time` may have the times"],
        ),
        ("nan", table.replace("5002.0,", "NaN,"), &["row 21", "NaN"]),
        (
            "angle",
            table.replace("azimuth [deg]", "turn"),
            &["no dimension `azimuth`", "`range`", "angle.csv has", "`turn`"],
        ),
        ("unit", table.replace("azimuth [deg]", "azimuth"), &["`azimuth` reaches 359", "taken as rad"]),
        ("empty", lines[0].to_owned(), &["no rows"]),
    ] {
        let file = format!("{name}.csv");
        folder.write(&file, table);
        let said = refused(&folder, "timed.las", "out.laz", &["--readings", &file]);
        for wanted in wanted {
            assert!(said.contains(wanted), "{name}: {wanted}: {said}");
        }
    }
    for (more, wanted) in [
        (&["--readings", "timed.csv", "--time", "cloc"][..], "no column `cloc` has the times"),
        (&["--readings", "missing.csv"], "there is no such file"),
        (&["--readings", "timed.las"], "is a point cloud, which `trueaxis apply` corrects"),
        (&["--time", "gps_time"], "--readings"),
        (&[], "no dimension `azimuth`: its points have `intensity`, `gps_time`, `range`; --readings brings"),
    ] {
        let said = refused(&folder, "timed.las", "out.laz", more);
        assert!(said.contains(wanted), "{more:?}: {said}");
    }
    // Points that have all readings need no table, and points without a time can use none.
    folder.write("v12f1.las", bytes("v12f1.las")).write("v14f0.las", bytes("v14f0.las"));
    let said = refused(&folder, "v12f1.las", "out.laz", &["--readings", "timed.csv"]);
    assert!(said.contains("a dimension `azimuth [rad]`, and timed.csv a column of that name"), "{said}");
    folder.write("extra.csv", "gps_time,humidity\n5000,1\n5004,2\n");
    let said = refused(&folder, "v12f1.las", "out.laz", &["--readings", "extra.csv"]);
    assert!(said.contains("extra.csv: no reading is missing"), "{said}");
}
