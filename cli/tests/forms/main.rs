//! Files in the forms of other programs: `init`, `calibrate` and `apply` with nothing edited, and what was planted is corrected.
//!
//! `write.py` wrote the samples from the public description of each form.

#[path = "../support/mod.rs"]
mod support;

mod drives;
mod machines;
mod spoiled;

use support::Folder;

/// A sample on its way.
struct Sample {
    /// The file.
    name: &'static str,
    /// What is given to `init` beside it.
    with: &'static [&'static str],
    /// Other files that these name.
    beside: &'static [&'static str],
    /// The template that begins it.
    template: &'static str,
    /// What `init` says.
    says: &'static [&'static str],
    /// The verdict and the exit code are those of a usable correction inside the measured region.
    compared: Compared,
}

/// By what a corrected file is judged.
enum Compared {
    /// Columns that were true in the file, degrees, and how far the corrected ones may be off, RMS, arc seconds; the first turns by the cosine
    /// of the second.
    Angles([&'static str; 2], f64),
    /// Columns of points in the file, mm, and how far corrected ones may be off, RMS.
    Points([&'static str; 3], f64),
    /// What was seen had no place: it is written.
    Written(&'static str),
    /// It is begun, which reads every row by the study: a calibration of many joints takes a minute, and is that of another sample.
    Begun,
}

const HA_DEC: [&str; 2] = ["true_ha_deg", "true_dec_deg"];
const AZ_EL: [&str; 2] = ["true_az_deg", "true_el_deg"];
const POINT_MM: [&str; 3] = ["x [mm]", "y [mm]", "z [mm]"];
const POINT_M: [&str; 3] = ["x [m]", "y [m]", "z [m]"];

const SAMPLES: &[Sample] = &[
    sample("radio-1.dat", "alt-azimuth", &[], Compared::Angles(AZ_EL, 4.0)),
    sample("radio-2.pnt", "alt-azimuth", &[], Compared::Angles(AZ_EL, 4.0)),
    sample("mount-1.dat", "equatorial", &[], Compared::Angles(HA_DEC, 7.0)),
    sample("mount-2.txt", "equatorial", &[], Compared::Angles(HA_DEC, 7.0)),
    sample(
        "north.model",
        "equatorial",
        &["a model of MountWizzard4: 50 points"],
        Compared::Angles(HA_DEC, 6.0),
    ),
    sample("south.model", "equatorial", &["with the latitude of the site"], Compared::Angles(HA_DEC, 6.0)),
    Sample {
        with: &["--latitude", "48.1", "--longitude", "11.25"],
        ..sample("asa-1.pox", "equatorial", &["1 points only set the mount"], Compared::Angles(HA_DEC, 6.0))
    },
    Sample {
        with: &["--latitude", "-30", "--longitude", "-70.5"],
        ..sample("asa-2.pox", "equatorial", &["IAU 2006"], Compared::Angles(HA_DEC, 6.0))
    },
    sample("solves-1.csv", "equatorial", &["no column says an equinox"], Compared::Angles(HA_DEC, 6.0)),
    sample(
        "solves-2.csv",
        "equatorial",
        &["of date of the mount, J2000 of the plate solve"],
        Compared::Angles(HA_DEC, 6.0),
    ),
    sample("stations.gsi", "total-station", &["not read as the truth"], Compared::Written("target_x")),
    sample("control.gsi", "total-station", &["whose coordinates it gives"], Compared::Points(POINT_M, 0.6)),
    sample("points-1.csv", "total-station", &[], Compared::Points(POINT_M, 0.6)),
    sample("points-2.csv", "total-station", &[], Compared::Points(POINT_M, 0.6)),
    Sample {
        with: &["--robot", "puma.dh.csv"],
        beside: &["puma.dh.csv"],
        ..sample(
            "puma.poses.csv",
            "robot",
            &["modified: Rx(alpha) Tx(a) Rz(theta) Tz(d)"],
            Compared::Points(POINT_MM, 0.1),
        )
    },
    Sample {
        with: &["--robot", "three-axis.dh.csv"],
        beside: &["three-axis.dh.csv"],
        ..sample("three-axis.poses.csv", "robot", &["standard: Rz(theta)"], Compared::Points(POINT_MM, 0.1))
    },
    Sample {
        with: &["--robot", "ur10e.conf", "--arm", "UR10e"],
        beside: &["ur10e.conf"],
        ..sample(
            "ur10e.poses.csv",
            "robot",
            &["the nominal sizes are those of a UR10e"],
            Compared::Points(POINT_MM, 0.1),
        )
    },
    Sample {
        with: &["--robot", "ur5e.conf", "--arm", "ur5e"],
        beside: &["ur5e.conf"],
        ..sample("ur5e.poses.csv", "robot", &["UR5e"], Compared::Begun)
    },
    whole("quaternion-1.csv", PUMA, &["a unit quaternion"], Compared::Points(POINT_MM, 0.1)),
    whole("quaternion-2.csv", THREE_AXIS, &["a unit quaternion"], Compared::Begun),
    whole("euler-kuka.csv", THREE_AXIS, &["as KUKA has them"], Compared::Begun),
    whole("euler-ros.csv", PUMA, &["as ROS has them"], Compared::Begun),
    whole("matrix-12.csv", PUMA, &["a matrix of 3 × 4 or 4 × 4 entries"], Compared::Begun),
    whole("matrix-16.csv", THREE_AXIS, &["a matrix of 3 × 4 or 4 × 4 entries"], Compared::Begun),
];

const PUMA: &[&str] = &["--robot", "puma.dh.csv"];
const THREE_AXIS: &[&str] = &["--robot", "three-axis.dh.csv"];

/// Places with orientations.
const fn whole(
    name: &'static str,
    with: &'static [&'static str],
    says: &'static [&'static str],
    compared: Compared,
) -> Sample {
    Sample { with, beside: &["puma.dh.csv", "three-axis.dh.csv"], ..sample(name, "robot", says, compared) }
}

const fn sample(
    name: &'static str,
    template: &'static str,
    says: &'static [&'static str],
    compared: Compared,
) -> Sample {
    Sample { name, with: &[], beside: &[], template, says, compared }
}

/// A folder with files of the samples.
fn folder(name: &str, files: &[&str]) -> Folder {
    let folder = Folder::new(&format!("forms-{}", name.replace('.', "-")));
    for file in files {
        folder.copy(&format!("cli/tests/forms/samples/{file}"));
    }
    folder
}

/// The cells of a line; a decimal comma stands within quotes.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut is_quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            letter => {
                let last = cells.len() - 1;
                cells[last].push(if letter == ',' { '.' } else { letter });
            }
        }
    }
    cells
}

/// A column of a table.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let at = header.iter().position(|own| own.trim_matches('"') == name);
    let at = at.unwrap_or_else(|| panic!("no column {name} in {header:?}"));
    let number = |cell: &str| cell.parse().unwrap_or_else(|_| panic!("{name}: `{cell}` is no number"));
    lines.map(|line| number(&cells(line)[at])).collect()
}

/// The table of a file as it is read: `eval` of nothing would do, but `apply` keeps only what it does not replace.
fn read_as_table(file: &str) -> String {
    let path = support::root().join("cli/tests/forms/samples").join(file);
    let bytes = std::fs::read(path).expect("a sample");
    let site = tables::formats::Site {
        latitude_deg: 0.0,
        longitude_deg: if file == "asa-1.pox" { 11.25 } else { -70.5 },
    };
    let options = tables::formats::Options { site: Some(site), ..Default::default() };
    let mut reader = tables::formats::open(bytes, file, &options).expect("a sample is read");
    let names: Vec<String> = reader.header().iter().map(|name| name.full.clone()).collect();
    let wanted: Vec<tables::formats::Wanted> = (0..names.len())
        .map(|column| tables::formats::Wanted { column, form: tables::formats::Form::Label })
        .collect();
    let chunk = reader.read(&wanted, usize::MAX).expect("rows");
    let labels: Vec<Vec<String>> = chunk
        .columns
        .into_iter()
        .map(|cells| match cells {
            tables::formats::Cells::Labels(labels) => labels,
            _ => unreachable!("labels were wanted"),
        })
        .collect();
    let mut text = names.join(",") + "\n";
    for row in 0..chunk.rows.len() {
        let cells: Vec<String> = labels.iter().map(|column| column[row].replace(',', ".")).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}

fn rms(off: impl Iterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = off.map(|off| off * off).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn judged(sample: &Sample, corrected: &str) {
    let name = sample.name;
    match sample.compared {
        Compared::Angles([turn, rise], most_arcsec) => {
            let table = read_as_table(name);
            let [turned, raised] = [turn, rise].map(|column_name| {
                let pairs = column(&table, column_name).into_iter().zip(column(corrected, column_name));
                pairs
                    .map(|(truth, found)| (found - truth + 540.0).rem_euclid(360.0) - 180.0)
                    .collect::<Vec<_>>()
            });
            let heights = column(&table, rise);
            let off = turned.iter().zip(&raised).zip(heights).map(|((turned, raised), height)| {
                3600.0 * (turned * height.to_radians().cos()).hypot(*raised)
            });
            let found = rms(off);
            assert!(found < most_arcsec, "{name}: {found} arcsec");
        }
        Compared::Points(columns, most_mm) => {
            let table = read_as_table(name);
            let scale = if columns[0].contains("mm") { 1.0 } else { 1e3 };
            let off: Vec<Vec<f64>> = columns
                .iter()
                .map(|axis| {
                    let pairs = column(&table, axis).into_iter().zip(column(corrected, axis));
                    pairs.map(|(truth, found)| scale * (found - truth)).collect()
                })
                .collect();
            let rows = 0..off[0].len();
            let found =
                rms(rows.map(|row| (off[0][row].powi(2) + off[1][row].powi(2) + off[2][row].powi(2)).sqrt()));
            assert!(found < most_mm, "{name}: {found} mm");
        }
        Compared::Begun => unreachable!("it was only begun"),
        Compared::Written(heading) => {
            assert!(column(corrected, heading).iter().all(|cell| cell.is_finite()), "{name}");
        }
    }
}

fn goes_through(sample: &Sample) {
    let Sample { name, with, beside, template, says, .. } = sample;
    let folder = folder(name, &[&[*name], *beside].concat());
    let init = folder.trueaxis(&[&["init", name], *with, &["--out", "study.toml"]].concat());
    assert_eq!(init.code, 0, "{name}: {init}");
    assert!(init.stdout.starts_with(template), "{name}: {init}");
    for says in *says {
        assert!(init.stderr.contains(says), "{name}: {says}: {init}");
    }
    if matches!(sample.compared, Compared::Begun) {
        return;
    }
    let calibrate = folder.trueaxis(&["calibrate", "study.toml", "--out", "result"]);
    assert_eq!(calibrate.code, 0, "{name}: {calibrate}");
    let apply =
        folder.trueaxis(&["apply", "result/instrument.toml", "--data", name, "--out", "corrected.csv"]);
    assert_eq!(apply.code, 0, "{name}: {apply}");
    judged(sample, &folder.read("corrected.csv"));
}

/// The targets of a file, and the readings that point at them in the file's own columns: near those that did.
#[test]
fn readings_to_set_come_out_in_the_columns_of_the_file() {
    let folder = folder("solved", &["mount-1.dat", "points-1.csv"]);
    for (file, columns) in [
        ("mount-1.dat", ["encoder_ha_deg", "encoder_dec_deg"]),
        ("points-1.csv", ["Hz [DDD.MMSS]", "V [DDD.MMSS]"]),
    ] {
        let study = format!("{file}.toml");
        let result = format!("{file}.result");
        let told = |arguments: &[&str]| {
            let run = folder.trueaxis(arguments);
            assert_eq!(run.code, 0, "{file}: {run}");
        };
        told(&["init", file, "--out", &study]);
        told(&["calibrate", &study, "--out", &result]);
        let instrument = format!("{result}/instrument.toml");
        told(&["apply", &instrument, "--data", file, "--solve", "--out", "set.csv"]);
        let (table, set) = (read_as_table(file), folder.read("set.csv"));
        for name in columns {
            let (before, after) = (column(&table, name), column(&set, name));
            // Readings as digits of degrees, minutes and seconds differ by little where those do.
            let off = before.iter().zip(&after).map(|(before, after)| {
                let off = (after - before).abs();
                off.min((off - 360.0).abs())
            });
            let near = off.filter(|off| *off < 0.02).count();
            assert!(near * 10 >= before.len() * 9, "{file}, {name}: {near} of {}: {set}", before.len());
        }
    }
}

#[test]
fn every_form_goes_from_init_to_a_corrected_file() {
    for sample in SAMPLES {
        goes_through(sample);
    }
}
