//! Terms of TPOINT: their signs by mounts that were built from the published definitions, their ±, and what to do.

use crate::support::Folder;
use crate::{instrument, said};

const EQUATORIAL: &str = "chain Equatorial {
    const latitude: angle = 13*pi/60;
    input pier: side;
    body fork on ground {
        position_error: Rx(polar_elevation), Ry(polar_azimuth);
        motion: Rz(-ha);
        motion_error: Rz(-ha_index);
    }
    body tube on fork {
        position_error: Ry(pier*nonperpendicularity);
        motion: Rx(dec);
        motion_error: Rx(pier*dec_index), Rz(pier*collimation),
            Rx(droop*cos(latitude)*cos(ha)*sin(dec) - droop*sin(latitude)*cos(dec)), Rz(-droop*cos(latitude)*sin(ha)),
            Rx(wheel*sin(5*ha)), Rx(stray*temperature);
    }
    input temperature: temperature;
    gravity: (0, -cos(latitude), -sin(latitude));
    observe sight: direction(0, 1, 0) of tube;
}
";

const ALT_AZIMUTH: &str = "chain AltAzimuth {
    input face: side;
    body fork on ground {
        position_error: Rx(tilt_east), Ry(tilt_north);
        motion: Rz(-azimuth);
        motion_error: Rz(-azimuth_index);
    }
    body tube on fork {
        position_error: Ry(face*nonperpendicularity);
        motion: Rx(elevation);
        motion_error: Rx(face*elevation_index), Rz(face*collimation), Rx(droop*cos(elevation));
    }
    observe sight: direction(0, 1, 0) of tube;
}
";

const OF_EQUATORIAL: &str = "[found-over]\nha = [\"-60 deg\", \"60 deg\"]\ndec = [\"-20 deg\", \"75 deg\"]\npier = [-1.0, 1.0]\n\
                             temperature = [-5.0, 15.0]\n";
const OF_ALT_AZIMUTH: &str = "[found-over]\nelevation = [\"15 deg\", \"80 deg\"]\nface = [-1.0, 1.0]\n";

/// Each term with the error of the declaration that it is, and the sign of that error.
const TERMS: [(&str, &str, &str, f64); 14] = [
    ("equatorial", "IH", "ha_index", 1.0),
    ("equatorial", "ID", "dec_index", 1.0),
    ("equatorial", "CH", "collimation", -1.0),
    ("equatorial", "NP", "nonperpendicularity", 1.0),
    ("equatorial", "ME", "polar_elevation", 1.0),
    ("equatorial", "MA", "polar_azimuth", -1.0),
    ("equatorial", "TF", "droop", 1.0),
    ("alt-azimuth", "IA", "azimuth_index", -1.0),
    ("alt-azimuth", "IE", "elevation_index", 1.0),
    ("alt-azimuth", "CA", "collimation", 1.0),
    ("alt-azimuth", "NPAE", "nonperpendicularity", -1.0),
    ("alt-azimuth", "AN", "tilt_east", -1.0),
    ("alt-azimuth", "AW", "tilt_north", -1.0),
    ("alt-azimuth", "TF", "droop", -1.0),
];

/// Names and values in arc seconds of a file.
fn terms(text: &str) -> Vec<(String, f64)> {
    let lines = text.lines().skip(2).take_while(|line| *line != "END");
    lines
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            assert_eq!(words.len(), 3, "{line}");
            (words[0].to_owned(), words[1].parse().expect("a number"))
        })
        .collect()
}

/// `reference.py` builds a mount with one fault; the declaration with the error that is written as this term points there, too. So the
/// signs are right, on both sides of the pier.
#[test]
fn each_term_is_the_fault_that_its_field_means() {
    let folder = Folder::new("export-terms");
    let reference = include_str!("reference.txt");
    for (mount, term, error, sign) in TERMS {
        let rows: Vec<Vec<&str>> = reference
            .lines()
            .map(|line| line.split(' ').collect::<Vec<_>>())
            .filter(|row| row[0] == mount && row[1] == term)
            .collect();
        assert_eq!(rows.len(), 6, "{mount} {term}");
        let value: f64 = rows[0][2].parse().expect("a number");
        let (chain, more, header) = match mount {
            "equatorial" => (EQUATORIAL, OF_EQUATORIAL, "ha [deg],dec [deg],pier,temperature"),
            _ => (ALT_AZIMUTH, OF_ALT_AZIMUTH, "azimuth [deg],elevation [deg],face,temperature"),
        };
        let errors = format!("{error} = \"{} arcsec\"", sign * value);
        folder.write("instrument.toml", instrument(chain, &errors, more));
        let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "mount.mod"]);
        assert!(said(&run).contains("The form carries every error"), "{mount} {term}: {run}");
        let written = terms(&folder.read("mount.mod"));
        assert_eq!(written.len(), 1, "{mount} {term}: {written:?}");
        assert_eq!(written[0].0, term, "{mount} {error}: {written:?}");
        assert!((written[0].1 - value).abs() < 1e-5, "{mount} {term}: {written:?}");
        // Where the fault has it, to second order in an angle of a minute.
        let poses: String = rows.iter().map(|row| format!("{},{},{},0\n", row[3], row[4], row[5])).collect();
        folder.write("poses.csv", format!("{header}\n{poses}"));
        let run = folder.trueaxis(&["apply", "instrument.toml", "--data", "poses.csv", "--out", "-"]);
        assert_eq!(run.code, 0, "{run}");
        for (line, row) in run.stdout.lines().skip(1).zip(&rows) {
            let cells: Vec<f64> =
                line.split(',').skip(4).map(|cell| cell.parse().expect("a number")).collect();
            for axis in 0..3 {
                let expected: f64 = row[6 + axis].parse().expect("a number");
                assert!((cells[axis] - expected).abs() < 2e-7, "{mount} {term}: {line}; {row:?}");
            }
        }
    }
}

/// Read back, terms of a minute are the instrument but for products of them: some hundredths of a second.
#[test]
fn terms_together_are_the_instrument_to_first_order() {
    let folder = Folder::new("export-together");
    let errors = "polar_elevation = \"60 arcsec\"\npolar_azimuth = \"-40 arcsec\"\nha_index = \"100 arcsec\"\nnonperpendicularity = \"30 arcsec\"\n\
                  dec_index = \"-20 arcsec\"\ncollimation = \"50 arcsec\"\ndroop = \"-15 arcsec\"\nwheel = \"3 arcsec\"";
    folder.write("instrument.toml", instrument(EQUATORIAL, errors, OF_EQUATORIAL));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "mount.mod"]);
    let said = said(&run);
    let names: Vec<String> = terms(&folder.read("mount.mod")).into_iter().map(|(name, _)| name).collect();
    // sin 5h in declination is a harmonic that changes with the side, and this one does not.
    assert_eq!(names, ["IH", "ID", "CH", "NP", "MA", "ME", "TF", "HDSH5"], "{run}");
    let (_, differs) = said.split_once("differs from the instrument by ").expect("a difference");
    let rms: f64 = differs.split('″').next().and_then(|number| number.parse().ok()).expect("seconds");
    assert!(rms > 0.0 && rms < 0.05, "{run}");
}

#[test]
fn what_is_no_term_is_listed_with_its_size() {
    let folder = Folder::new("export-lost");
    folder.write(
        "instrument.toml",
        instrument(EQUATORIAL, "stray = 1e-5\nha_index = \"10 arcsec\"", OF_EQUATORIAL),
    );
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "mount.mod"]);
    let said = said(&run);
    // Of temperatures from −5 to 15 the mean square is 58.3 K².
    let (_, size) = said.split_once("over the measured region: stray ").expect("a list");
    let size: f64 = size.split('″').next().and_then(|number| number.parse().ok()).expect("seconds");
    assert!((size - 1e-5 * (175.0_f64 / 3.0).sqrt() * 206_264.806).abs() < 0.2, "{run}");
    assert!(said.contains(&format!("differs from the instrument by {size}″ RMS")), "{run}");
}

#[test]
fn uncertainties_are_those_of_the_sum() {
    let folder = Folder::new("export-uncertain");
    // Two errors that only act together: the second is another index.
    let chain = ALT_AZIMUTH.replace("Rz(-azimuth_index)", "Rz(-azimuth_index), Rz(-second)");
    let more = format!(
        "{OF_ALT_AZIMUTH}[covariance]\nof = [\"azimuth_index\", \"second\", \"tilt_east\", \"droop\"]\nundetermined = [\"droop\"]\nrows = [\n\
         [4e-10, -3e-10, 0.0, 0.0],\n[-3e-10, 4e-10, 0.0, 0.0],\n[0.0, 0.0, 1e-12, 0.0],\n[0.0, 0.0, 0.0, 1e-8],\n]\n"
    );
    let errors = "azimuth_index = 1e-4\nsecond = 2e-4\ntilt_east = 1e-6\ndroop = 1e-4";
    folder.write("instrument.toml", instrument(&chain, errors, &more));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "mount.mod"]);
    let said = said(&run);
    let text = folder.read("mount.mod");
    let index = text.lines().find(|line| line.trim().starts_with("IA")).expect("the index");
    let words: Vec<f64> =
        index.split_whitespace().skip(1).map(|word| word.parse().expect("a number")).collect();
    assert!((words[0] + 3e-4 * 206_264.806).abs() < 1e-3, "{index}");
    // √(4 + 4 − 6) · 1e-5
    assert!((words[1] - 2e-10_f64.sqrt() * 206_264.806).abs() < 1e-3, "{index}");
    assert!(
        said.contains("AN −0.21 ± 0.21″, azimuth axis tilted to the north It is too small to be sure of"),
        "{run}"
    );
    assert!(said.contains("TF −21 ± 21″, flexure of the tube The data do not determine it"), "{run}");
    assert!(said.contains("The zero of the azimuth is off. Add 1.0 arcmin to its readings"), "{run}");
}

#[test]
fn a_sentence_says_which_screw_and_which_way() {
    let folder = Folder::new("export-acts");
    for (latitude, errors, sentence) in [
        (
            "13*pi/60",
            "polar_elevation = \"84 arcsec\"",
            "Raise the polar axis by 1.4 arcmin: turn the altitude screw. It points below",
        ),
        (
            "13*pi/60",
            "polar_elevation = \"-84 arcsec\"",
            "Lower the polar axis by 1.4 arcmin: turn the altitude screw. It points above",
        ),
        (
            "-13*pi/60",
            "polar_elevation = \"84 arcsec\"",
            "Lower the polar axis by 1.4 arcmin: turn the altitude screw. It points above",
        ),
        // On a circle of the cosine of 39° the pole goes a way of 84″ in 108″.
        (
            "13*pi/60",
            "polar_azimuth = \"-84 arcsec\"",
            "Turn the mount 1.8 arcmin to the west with the azimuth screws. The polar axis points 1.4 arcmin east",
        ),
        (
            "-13*pi/60",
            "polar_azimuth = \"-84 arcsec\"",
            "Turn the mount 1.8 arcmin to the east with the azimuth screws. The polar axis points 1.4 arcmin west",
        ),
    ] {
        let chain = EQUATORIAL.replace("13*pi/60", latitude);
        folder.write("instrument.toml", instrument(&chain, errors, OF_EQUATORIAL));
        let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "mount.mod"]);
        assert!(said(&run).contains(sentence), "{latitude} {errors}: {run}");
    }
}

#[test]
fn standard_output_has_the_file_alone() {
    let folder = Folder::new("export-stdout");
    folder.write("instrument.toml", instrument(ALT_AZIMUTH, "tilt_east = \"30 arcsec\"", OF_ALT_AZIMUTH));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "-"]);
    assert_eq!(run.code, 0, "{run}");
    assert!(run.stdout.starts_with("AltAzimuth\nT") && run.stdout.ends_with("END\n"), "{run}");
    assert!(run.stderr.contains("Raise the south foot"), "{run}");
}

/// Without an error there is no term, and the file says nothing.
#[test]
fn no_error_makes_no_term() {
    let folder = Folder::new("export-none");
    folder.write("instrument.toml", instrument(ALT_AZIMUTH, "", OF_ALT_AZIMUTH));
    let run = folder.trueaxis(&["export", "instrument.toml", "--form", "tpoint", "--out", "mount.mod"]);
    assert!(said(&run).contains("none: no error of this instrument is a term"), "{run}");
    assert!(terms(&folder.read("mount.mod")).is_empty());
}
