//! Pictures of what families of effects leave in the residuals of a mount. The commands themselves make them: a mount that
//! does more than its declaration says is simulated, and what `calibrate` leaves before it looks for the cause is drawn.
//!
//! `UPDATE_BOOK=1` writes the pictures, and what `calibrate` finds, into the page.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::support::{Folder, root};

/// One picture: how the declaration and the mount differ from the mount of the course.
struct Signature {
    name: &'static str,
    /// What the declaration lacks, or has besides: each text there is replaced by the other.
    declared: &'static [(&'static str, &'static str)],
    /// The same for the mount.
    real: &'static [(&'static str, &'static str)],
    /// Errors beside those of the course's mount.
    errors: &'static str,
    /// The range of an input.
    input: Option<&'static str>,
    /// What comes of the order of the rows, as an input of the mount: `azimuth_direction` or `time`.
    order: Option<&'static str>,
    /// What the study adds.
    search: &'static str,
}

const NONE: Signature =
    Signature { name: "noise", declared: &[], real: &[], errors: "", input: None, order: None, search: "" };
const TEMPERATURE: (&str, &str) = ("chain Mount {", "chain Mount {\n    input temperature: temperature;");
const AZIMUTH: &str = "Rz(azimuth_index)";
const ELEVATION: &str = "Rx(elevation_index)";

const SIGNATURES: [Signature; 13] = [
    NONE,
    Signature {
        name: "tilt",
        declared: &[("position_error: Rx(tilt_x), Ry(tilt_y);", "")],
        errors: "tilt_x = \"15 arcsec\"\ntilt_y = \"-7 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "perpendicularity",
        declared: &[("position_error: Ry(nonperpendicularity);", "")],
        errors: "nonperpendicularity = \"60 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "collimation",
        declared: &[("position_error: Rz(collimation);", "")],
        errors: "collimation = \"90 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "eccentricity",
        real: &[(AZIMUTH, "Rz(azimuth_index), Rz(a*cos(azimuth) + b*sin(azimuth))")],
        errors: "a = \"12 arcsec\"\nb = \"-9 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "ellipticity",
        real: &[(AZIMUTH, "Rz(azimuth_index), Rz(a*cos(2*azimuth) + b*sin(2*azimuth))")],
        errors: "a = \"9 arcsec\"\nb = \"7 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "whirl",
        real: &[(AZIMUTH, "Rz(azimuth_index), Rx(w*cos(3*azimuth)), Ry(w*sin(3*azimuth))")],
        errors: "w = \"9 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "gravity",
        real: &[(ELEVATION, "Rx(elevation_index), Rx(-sag*cos(elevation))")],
        errors: "sag = \"26 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "refraction",
        real: &[(ELEVATION, "Rx(elevation_index), Rx(refraction*cot(elevation))")],
        errors: "refraction = \"12 arcsec\"\n",
        ..NONE
    },
    Signature {
        name: "thermal",
        declared: &[TEMPERATURE],
        real: &[TEMPERATURE, (ELEVATION, "Rx(elevation_index), Rx(growth*temperature)")],
        errors: "growth = \"2 arcsec\"\n",
        input: Some("temperature=-5..20"),
        order: None,
        search: "[search]\ninputs = [\"temperature\"]\n",
    },
    Signature {
        name: "step",
        real: &[(ELEVATION, "Rx(elevation_index), Rx(jump*ramp(azimuth, 200 deg, 200 deg))")],
        errors: "jump = \"15 arcsec\"\n",
        search: "[search]\nfunctions = true\n",
        ..NONE
    },
    Signature {
        name: "backlash",
        real: &[
            ("chain Mount {", "chain Mount {\n    input azimuth_direction;"),
            (AZIMUTH, "Rz(azimuth_index), Rz(lag*azimuth_direction)"),
        ],
        errors: "lag = \"8 arcsec\"\n",
        order: Some("azimuth_direction"),
        search: "[search]\nsequence = true\n",
        ..NONE
    },
    Signature {
        name: "drift",
        real: &[
            ("chain Mount {", "chain Mount {\n    input time;"),
            (ELEVATION, "Rx(elevation_index), Rx(creep*time)"),
        ],
        errors: "creep = \"0.1 arcsec\"\n",
        order: Some("time"),
        search: "[search]\nsequence = true\n[noise]\norder = \"time\"\n",
        ..NONE
    },
];

/// The noise, in each of two directions.
const NOISE_ARCSEC: f64 = 2.0;
const STUDY: &str = "chain = \"declared.chain\"\nobservable = \"pointing\"\ndata = \"measured.csv\"\n\
                     [observed]\nkind = \"direction\"\nx = \"pointing_x\"\ny = \"pointing_y\"\nz = \"pointing_z\"\n[hold_out]\nfolds = 2\n";

fn edited(edits: &[(&str, &str)]) -> String {
    let mount = fs::read_to_string(root().join("examples/course/mount.chain")).expect("the course's mount");
    edits.iter().fold(mount, |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    })
}

/// The picture, and what is found.
fn made(signature: &Signature) -> (String, String) {
    let folder = Folder::new(&format!("signature-{}", signature.name));
    let ours = ["tilt_x", "tilt_y", "nonperpendicularity", "collimation"];
    let mut errors = "azimuth_index = \"40 arcsec\"\nelevation_index = \"-12 arcsec\"\n".to_owned();
    for name in ours.into_iter().filter(|name| !signature.errors.contains(name)) {
        let _ = writeln!(errors, "{name} = \"10 arcsec\"");
    }
    folder.write("declared.chain", edited(signature.declared)).write("real.chain", edited(signature.real));
    folder
        .write("declared.toml", &errors)
        .write("truth.toml", errors + signature.errors)
        .write("study.toml", format!("{STUDY}{}", signature.search));
    let simulate = match signature.order {
        None => "simulate real.chain --errors truth.toml --poses 200 --seed 7 --out measured.csv",
        Some(_) => "simulate declared.chain --errors declared.toml --poses 200 --seed 7 --out noisy.csv",
    };
    let mut simulate: Vec<&str> = simulate.split(' ').collect();
    let noise = format!("{NOISE_ARCSEC} arcsec");
    simulate.extend([
        "--noise",
        &noise,
        "--range",
        "azimuth=0 deg..360 deg",
        "--range",
        "elevation=12 deg..82 deg",
    ]);
    simulate.extend(signature.input.iter().flat_map(|range| ["--range", range]));
    let done = |arguments: &[&str]| {
        let run = folder.trueaxis(arguments);
        assert_eq!(run.code, 0, "{}: {}", signature.name, run.stderr);
    };
    done(&simulate);
    if let Some(order) = signature.order {
        in_order(&folder, order, &done);
    }
    done(&["calibrate", "study.toml", "--out", "result"]);
    let report: Value = serde_json::from_str(&folder.read("result/report.json")).expect("a report");
    (picture(signature, &folder.read("result/residuals.csv")), found(&report))
}

/// What the order of the rows gives: +1 or −1 as the azimuth came, or the number of the row.
fn of_order(order: &str, azimuth: &[f64]) -> Vec<f64> {
    if order == "time" {
        return (0..azimuth.len()).map(|row| row as f64).collect();
    }
    let came = azimuth.windows(2).map(|two| (two[1] - two[0]).signum());
    std::iter::once(0.0).chain(came).collect()
}

/// Rows of a mount that knows their order: the simulated ones, moved by what the mount does more than its declaration says.
fn in_order(folder: &Folder, order: &str, done: &impl Fn(&[&str])) {
    let noisy = folder.read("noisy.csv");
    let [azimuth, elevation] = ["azimuth", "elevation"].map(|name| column(&noisy, name));
    let driven = of_order(order, &azimuth);
    let mut poses = format!("azimuth,elevation,{order}\n");
    for ((azimuth, elevation), driven) in azimuth.iter().zip(&elevation).zip(&driven) {
        let _ = writeln!(poses, "{azimuth:?},{elevation:?},{driven}");
    }
    folder.write("poses.csv", poses);
    for (chain, errors, out) in
        [("declared.chain", "declared.toml", "0.csv"), ("real.chain", "truth.toml", "1.csv")]
    {
        done(&[
            "eval",
            chain,
            "--errors",
            errors,
            "--data",
            "poses.csv",
            "--quantity",
            "value",
            "--out",
            out,
        ]);
    }
    let [declared, real] = ["0.csv", "1.csv"].map(|file| folder.read(file));
    let names = ["pointing_x", "pointing_y", "pointing_z"];
    let moved = names.map(|name| -> Vec<f64> {
        let pairs = column(&noisy, name).into_iter().zip(column(&declared, name)).zip(column(&real, name));
        pairs.map(|((noisy, declared), real)| noisy + (real - declared)).collect()
    });
    let mut rows = format!("time,azimuth,elevation,{}\n", names.join(","));
    for (row, (azimuth, elevation)) in azimuth.iter().zip(&elevation).enumerate() {
        let _ = writeln!(
            rows,
            "{row},{azimuth:?},{elevation:?},{:?},{:?},{:?}",
            moved[0][row], moved[1][row], moved[2][row]
        );
    }
    folder.write("measured.csv", rows);
}

/// What `calibrate` finds, in a line.
fn found(report: &Value) -> String {
    let arcsec = |value: &Value| value["rms"].as_f64().unwrap_or(f64::NAN).to_degrees() * 3600.0;
    let (before, after) = (arcsec(&report["before"]), arcsec(&report["after"]));
    let effects: Vec<String> = report["effects"]
        .as_array()
        .map_or(&[][..], Vec::as_slice)
        .iter()
        .map(|effect| {
            let causes = effect["causes"].as_array().map_or(0, Vec::len);
            let others = match causes {
                0 | 1 => String::new(),
                2 => " or one other cause".to_owned(),
                more => format!(" or one of {} other causes", more - 1),
            };
            format!("**{}**{others}", effect["names"][0].as_str().unwrap_or_default())
        })
        .collect();
    if effects.is_empty() {
        return format!(
            "`calibrate` finds nothing missing; the residual is {before:.1}″ (RMS of both directions)."
        );
    }
    format!(
        "`calibrate` finds {}; the residual goes from {before:.1}″ to {after:.1}″.",
        effects.join(" and ")
    )
}

/// A column of a table by the beginning of its name.
fn column(table: &str, name: &str) -> Vec<f64> {
    let mut lines = table.lines();
    let header = lines.next().expect("a header");
    let at = header
        .split(',')
        .position(|column| column == name || column.starts_with(&format!("{name} [")))
        .unwrap_or_else(|| panic!("no {name} in {header}"));
    lines.map(|line| line.split(',').nth(at).expect("a cell").parse().expect("a number")).collect()
}

/// An axis of a panel: column, label, range, marks; turned into degrees for angles.
type Reading = (&'static str, &'static str, [f64; 2], &'static [f64], bool);

const READINGS: [Reading; 5] = [
    ("azimuth", "azimuth", [0.0, 360.0], &[0.0, 90.0, 180.0, 270.0, 360.0], true),
    ("elevation", "elevation", [10.0, 84.0], &[15.0, 45.0, 75.0], true),
    ("temperature", "temperature", [-5.0, 20.0], &[0.0, 10.0, 20.0], false),
    ("azimuth_direction", "azimuth came falling (−1), rising (+1)", [-1.6, 1.6], &[-1.0, 1.0], false),
    ("time", "row", [0.0, 200.0], &[0.0, 100.0, 200.0], false),
];
const PANEL: [f64; 2] = [250.0, 112.0];
const LEFT: f64 = 92.0;
const GAP: f64 = 28.0;

/// What is left before the search: upwards and sideways, over each reading.
fn picture(signature: &Signature, table: &str) -> String {
    let third = signature.order.or(signature.input.and_then(|range| range.split('=').next()));
    let readings: Vec<&Reading> = READINGS
        .iter()
        .enumerate()
        .filter(|(at, one)| *at < 2 || Some(one.0) == third)
        .map(|(_, one)| one)
        .collect();
    let readings = readings.as_slice();
    let values_of = |name: &str| match signature.order {
        Some(order) if order == name => of_order(order, &column(table, "azimuth")),
        _ => column(table, name),
    };
    let arcsec = |name| -> Vec<f64> {
        column(table, name).into_iter().map(|rad: f64| rad.to_degrees() * 3600.0).collect()
    };
    let rows = [("up", arcsec("along_before")), ("sideways", arcsec("across_before"))];
    let largest = rows.iter().flat_map(|(_, values)| values).fold(0.0, |a: f64, b| a.max(b.abs()));
    let scale = [8.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 80.0]
        .into_iter()
        .find(|scale| *scale >= largest)
        .expect("arc seconds, few");
    let width = LEFT + readings.len() as f64 * (PANEL[0] + GAP);
    let height = 10.0 + 2.0 * (PANEL[1] + GAP) + 20.0;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"16\" role=\"img\">\n\
         <title>Residuals over each joint: {}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        signature.name
    );
    for (row, (direction, values)) in rows.iter().enumerate() {
        let top = 10.0 + row as f64 * (PANEL[1] + GAP);
        let middle = top + PANEL[1] / 2.0;
        let band = 2.0 * NOISE_ARCSEC / scale * PANEL[1] / 2.0;
        for (at, &&(name, _, [low, high], marks, is_angle)) in readings.iter().enumerate() {
            let left = LEFT + at as f64 * (PANEL[0] + GAP);
            let x = |value: f64| left + (value - low) / (high - low) * PANEL[0];
            let _ = writeln!(
                out,
                "<rect x=\"{left}\" y=\"{:.1}\" width=\"{}\" height=\"{:.1}\" fill=\"#e6edf5\"/>\
                 <path d=\"M{left} {middle}h{}\" stroke=\"#8899aa\"/>\
                 <rect x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#999999\"/>",
                middle - band,
                PANEL[0],
                2.0 * band,
                PANEL[0],
                PANEL[0],
                PANEL[1]
            );
            for mark in marks {
                let _ = write!(out, "<path d=\"M{:.0} {}v5\" stroke=\"#999999\"/>", x(*mark), top + PANEL[1]);
            }
            let mut dots = String::new();
            for (reading, value) in values_of(name).into_iter().zip(values) {
                let reading = if is_angle { reading.to_degrees().rem_euclid(360.0) } else { reading };
                let _ = write!(dots, "M{:.0} {:.0}h0", x(reading), middle - value / scale * PANEL[1] / 2.0);
            }
            let _ = writeln!(
                out,
                "<path d=\"{dots}\" stroke=\"#b5473c\" stroke-width=\"3.4\" stroke-linecap=\"round\" opacity=\"0.8\"/>"
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{0}\" y=\"{1}\" text-anchor=\"end\">+{scale}″</text><text x=\"{0}\" y=\"{2}\" text-anchor=\"end\">−{scale}″</text>\
             <text x=\"{0}\" y=\"{3}\" text-anchor=\"end\" font-weight=\"bold\">{direction}</text>",
            LEFT - 5.0,
            top + 14.0,
            top + PANEL[1],
            middle + 5.0
        );
    }
    let base = 10.0 + 2.0 * (PANEL[1] + GAP);
    for (at, &&(_, label, [low, high], marks, is_angle)) in readings.iter().enumerate() {
        let left = LEFT + at as f64 * (PANEL[0] + GAP);
        let unit = if is_angle { "°" } else { "" };
        for mark in marks {
            let x = left + (mark - low) / (high - low) * PANEL[0];
            let _ = write!(
                out,
                "<text x=\"{x:.0}\" y=\"{}\" text-anchor=\"middle\" fill=\"#555555\">{mark}{unit}</text>",
                base - 7.0
            );
        }
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-weight=\"bold\">{label}</text>",
            left + PANEL[0] / 2.0,
            base + 13.0
        );
    }
    out + "</svg>\n"
}

fn is_updated() -> bool {
    std::env::var_os("UPDATE_BOOK").is_some()
}

#[test]
fn pictures_of_residuals_are_what_the_commands_make() {
    let results: Vec<(String, String)> = std::thread::scope(|scope| {
        let runs: Vec<_> = SIGNATURES.iter().map(|signature| scope.spawn(move || made(signature))).collect();
        runs.into_iter().map(|run| run.join().expect("a picture")).collect()
    });
    let diagnosis = root().join("docs/src/diagnosis");
    let page: PathBuf = diagnosis.join("signatures.md");
    let mut lines: Vec<String> =
        fs::read_to_string(&page).expect("the page").lines().map(str::to_owned).collect();
    let mut stale = Vec::new();
    for (signature, (svg, said)) in SIGNATURES.iter().zip(results) {
        let name = signature.name;
        let file = diagnosis.join(format!("signatures/{name}.svg"));
        if fs::read_to_string(&file).ok().as_deref() != Some(&svg) {
            stale.push(format!("the picture of {name}"));
            if is_updated() {
                fs::create_dir_all(file.parent().expect("in a folder")).expect("a folder");
                fs::write(&file, &svg).expect("a picture");
            }
        }
        let marker = format!("<!-- said: {name} -->");
        let at = lines.iter().position(|line| *line == marker).unwrap_or_else(|| panic!("no {marker}"));
        if lines[at + 1] != said {
            stale.push(format!("{name}: `{}` where it is\n{said}", lines[at + 1]));
            lines[at + 1] = said;
        }
    }
    if is_updated() {
        fs::write(&page, lines.iter().map(|line| format!("{line}\n")).collect::<String>()).expect("the page");
    } else {
        assert!(stale.is_empty(), "write them anew with UPDATE_BOOK=1:\n{}", stale.join("\n"));
    }
}
