//! Tests of machine tools: `init`, `calibrate` and `apply` with nothing edited, and what was planted is found within its ±.
//!
//! `write_machines.py` wrote the samples, by matrices that are written out there.

use serde_json::Value;

use super::{column, folder, read_as_table, rms};

/// A sample, and what was planted in it.
struct Machine {
    file: &'static str,
    template: &'static str,
    /// What `init` says.
    says: &'static str,
    /// What was planted, in rad, m or 1, each found within a few of its standard uncertainties.
    planted: &'static [(&'static str, f64)],
    /// The columns that `apply` corrects, and how far they may be from what was measured, RMS, mm.
    corrected: (&'static [&'static str], f64),
}

const BAR: (&[&str], f64) = (&["bar_length [mm]"], 0.0006);
const TRUE: (&[&str], f64) = (&["true_x [mm]", "true_y [mm]", "true_z [mm]"], 0.0012);
const PLATE: &[(&str, f64)] = &[
    ("square_xy", 33e-6),
    ("square_xz", 21e-6),
    ("square_yz", -27e-6),
    ("scale_x", 14e-6),
    ("scale_y", -8e-6),
    ("scale_z", 19e-6),
];
const GRID: &[(&str, f64)] = &[
    ("square_xy", -29e-6),
    ("square_xz", 38e-6),
    ("square_yz", 12e-6),
    ("scale_x", -13e-6),
    ("scale_y", 22e-6),
    ("scale_z", 6e-6),
];

const MACHINES: &[Machine] = &[
    Machine {
        file: "bar-xy.csv",
        template: "ball-bar",
        says: "z does not move in these rows",
        planted: &[("square_xy", 48e-6), ("scale_x", 11e-6), ("scale_y", -17e-6)],
        corrected: BAR,
    },
    Machine {
        file: "bar-both-ways.csv",
        template: "ball-bar",
        says: "backlash is looked for",
        planted: &[("square_xy", 44e-6), ("scale_x", 9e-6), ("scale_y", 21e-6), ("backlash_y", 3e-6)],
        corrected: BAR,
    },
    Machine {
        file: "bar-zx.csv",
        template: "ball-bar",
        says: "assumed: x carries z",
        planted: &[("square_xz", -35e-6), ("scale_x", -9e-6), ("scale_z", 14e-6)],
        corrected: BAR,
    },
    Machine {
        file: "bar-space.csv",
        template: "ball-bar",
        says: "x carries y, which carries z",
        planted: &[
            ("square_xy", 28e-6),
            ("square_xz", -41e-6),
            ("square_yz", 19e-6),
            ("scale_x", 8e-6),
            ("scale_y", -12e-6),
            ("scale_z", 5e-6),
        ],
        corrected: (&["bar length [mm]"], 0.0006),
    },
    Machine {
        file: "r-test-c.csv",
        template: "r-test",
        says: "of the tool against the table",
        planted: &[
            ("square_xy", 26e-6),
            ("c_shift_x", 12.1e-6),
            ("c_shift_y", -8.3e-6),
            ("c_tilt_x", 31e-6),
            ("c_tilt_y", -18e-6),
        ],
        corrected: TRUE,
    },
    Machine {
        file: "r-test-ac.csv",
        template: "r-test",
        says: "the table turns by a, then c",
        planted: &[("square_xy", 22e-6), ("square_xz", -16e-6), ("square_yz", 13e-6)],
        corrected: TRUE,
    },
    Machine {
        file: "plate-1.csv",
        template: "machine",
        says: "is estimated too",
        planted: PLATE,
        corrected: (&["nominal x [mm]", "nominal y [mm]", "nominal z [mm]"], 0.0012),
    },
    Machine {
        file: "plate-2.csv",
        template: "machine",
        says: "machine minus calibrated",
        planted: PLATE,
        corrected: (&["calibrated x [mm]", "calibrated y [mm]", "calibrated z [mm]"], 0.0012),
    },
    Machine {
        file: "grid-1.csv",
        template: "machine",
        says: "is estimated too",
        planted: GRID,
        corrected: (&["tracker x [mm]", "tracker y [mm]", "tracker z [mm]"], 0.0016),
    },
    Machine {
        file: "grid-2.csv",
        template: "machine",
        says: "actual minus commanded",
        planted: GRID,
        corrected: TRUE,
    },
];

/// Standard uncertainties that an estimate may be off.
const WITHIN: f64 = 4.5;

#[test]
fn what_was_planted_in_a_machine_is_found_within_its_uncertainty() {
    for Machine { file, template, says, planted, corrected: (columns, most_mm) } in MACHINES {
        let folder = folder(file, &[file]);
        let init = folder.trueaxis(&["init", file, "--out", "study.toml"]);
        assert_eq!(init.code, 0, "{file}: {init}");
        assert!(init.stdout.starts_with(template), "{file}: {init}");
        assert!(init.stderr.contains(says), "{file}: {says}: {init}");
        let calibrate = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
        assert_eq!(calibrate.code, 0, "{file}: {calibrate}");
        let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("JSON");
        let errors = report["errors"].as_array().expect("errors");
        for (name, truth) in *planted {
            let error = errors.iter().find(|error| error["name"] == *name).expect("a declared error");
            let number = |key: &str| error[key].as_f64().unwrap_or_else(|| panic!("{file}, {name}: {error}"));
            let (value, sigma) = (number("value"), number("standard_uncertainty"));
            assert!(
                (value - truth).abs() < WITHIN * sigma,
                "{file}, {name}: {value} ± {sigma}, planted {truth}"
            );
            assert!(sigma < 0.3 * truth.abs(), "{file}, {name}: {value} ± {sigma}");
        }
        let apply =
            folder.trueaxis(&["apply", "result/instrument.toml", "--data", file, "--out", "corrected.csv"]);
        assert_eq!(apply.code, 0, "{file}: {apply}");
        let (table, corrected) = (read_as_table(file), folder.read("corrected.csv"));
        for name in *columns {
            let off = column(&table, name)
                .into_iter()
                .zip(column(&corrected, name))
                .map(|(one, other)| one - other);
            let found = rms(off);
            assert!(found < *most_mm, "{file}, {name}: {found} mm");
        }
    }
}

/// A table with one thing changed, and what is said then.
#[test]
fn what_a_table_of_a_machine_lacks_is_said_in_one_sentence() {
    let folder = folder(
        "machines-spoiled",
        &["bar-xy.csv", "bar-zx.csv", "r-test-c.csv", "plate-1.csv", "grid-2.csv"],
    );
    for (file, from, to, says) in [
        ("bar-xy.csv", "# radius = 150 mm\n", "", "write `# radius = 150 mm`"),
        ("bar-xy.csv", "# radius = 150 mm", "# radius = 150", "is no length"),
        ("bar-xy.csv", "# radius = 150 mm", "# radius = 150 m", "the circle has a radius of 150.0000 mm"),
        ("bar-xy.csv", "deviation [um]", "deviation", "has no unit of a length"),
        ("bar-xy.csv", "360.0000,-85.0000", "360.0000,85.0000", "on no circle"),
        ("bar-zx.csv", "# plane = ZX", "# plane = Q", "is no plane"),
        ("bar-zx.csv", "radius [mm]", "radius [deg]", "`radius [deg]`"),
        ("r-test-c.csv", "# displacement = table\n", "", "write `# displacement = table`"),
        ("r-test-c.csv", "C [deg]", "B [deg]", "do not go round with the table"),
        ("r-test-c.csv", "dZ [um]", "note", "no column has the deviation of z"),
        ("plate-1.csv", "ball,", "number,", "write `calibrated x` and `machine x`"),
        ("plate-1.csv", ",measured z [mm]", ",height", "no column has the z"),
        ("grid-2.csv", "X_mm,", "X,", "has no unit of a length"),
        ("grid-2.csv", "X_mm,Y_mm", "X_mm,x_mm", "have the same meaning"),
        ("grid-2.csv", "-4.21,", ",", "line 2, row 1, column `deviation X (µm)`"),
        ("grid-2.csv", "-4.21,", "much,", "line 2, row 1, column `deviation X (µm)`"),
    ] {
        let text = folder.read(file);
        assert!(text.contains(from), "{file}: {from}");
        folder.write("spoiled.csv", text.replacen(from, to, 1));
        let init = folder.trueaxis(&["init", "spoiled.csv", "--out", "spoiled.toml"]);
        assert_eq!((init.code, init.stdout.as_str()), (2, ""), "{file}: {to}: {init}");
        assert!(init.stderr.contains(says), "{file}: {says}: {init}");
        assert!(
            !folder.0.join("spoiled.toml").exists() && !folder.0.join("spoiled.chain").exists(),
            "{file}"
        );
    }
}

/// Positions in the frame of a table stand still, and those of a head turn the other way.
#[test]
fn positions_that_do_not_follow_a_table_are_refused() {
    let folder = folder("machines-path", &["r-test-ac.csv"]);
    let text = folder.read("r-test-ac.csv");
    let rows = |change: &dyn Fn(&mut Vec<String>)| {
        let rows = text.lines().enumerate().map(|(at, line)| {
            let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
            if at > 1 {
                change(&mut cells);
            }
            cells.join(",") + "\n"
        });
        rows.collect::<String>()
    };
    let still =
        rows(&|cells| ["88", "0", "61"].iter().zip(cells).for_each(|(new, cell)| *cell = (*new).to_owned()));
    let opposite = rows(&|cells| cells[4] = (-cells[4].parse::<f64>().expect("an angle")).to_string());
    for (name, text, says) in [
        ("still.csv", still, "not those in the frame of the table"),
        ("opposite.csv", opposite, "heads are not known"),
    ] {
        let init = folder.write(name, text).trueaxis(&["init", name]);
        assert_eq!(init.code, 2, "{name}: {init}");
        assert!(init.stderr.contains(says), "{name}: {init}");
    }
}

/// The opposite sign of deviations, stated above the header, is the opposite of every error.
#[test]
fn deviations_of_the_opposite_sign_are_read_as_a_line_defines_them() {
    let folder = folder("machines-opposite", &["bar-xy.csv"]);
    let table: String = (0..24)
        .flat_map(|row| (0..24).map(move |column| (row, column)))
        .enumerate()
        .map(|(at, (row, column))| {
            let [x, y, z] =
                [10.0 * f64::from(row), 10.0 * f64::from(column), f64::from(at as u32 % 7) * 20.0];
            let noise = |step: usize| ((at * step) % 101) as f64 / 505.0 - 0.1;
            let [dx, dy, dz] = [-0.03 * y + noise(37), noise(53), noise(71)];
            format!("{x},{y},{z},{dx:.3},{dy:.3},{dz:.3}\n")
        })
        .collect();
    let header = "x [mm],y [mm],z [mm],dx [um],dy [um],dz [um]\n";
    let mut found = Vec::new();
    for (name, line) in [("as", ""), ("opposite", "# deviation = commanded - actual\n")] {
        let (data, study, result) = (format!("{name}.csv"), format!("{name}.toml"), format!("{name}.result"));
        folder.write(&data, format!("{line}{header}{table}"));
        for arguments in [&["init", &data][..], &["calibrate", &study, "--out", &result]] {
            let run = folder.trueaxis(arguments);
            assert_eq!(run.code, 0, "{name}: {run}");
        }
        let report: Value =
            serde_json::from_str(&folder.read(&format!("{result}/report.json"))).expect("JSON");
        let errors = report["errors"].as_array().expect("errors");
        let own = errors.iter().find(|error| error["name"] == "square_xy").expect("a declared error");
        found.push(own["value"].as_f64().expect("a number"));
    }
    assert!((found[0] - 30e-6).abs() < 1e-6 && (found[0] + found[1]).abs() < 1e-7, "{found:?}");
}
