//! Pictures of reference pages, as `budget` and `calibrate` draw them. A page shows its picture and names the command.
//!
//! `UPDATE_BOOK=1` draws them anew.

use std::fs;

use super::page::{Step, steps};
use super::support::{Folder, root};

/// What draws a picture.
enum Drawn {
    /// `budget CHAIN --path … --observable …`, for errors of these sizes in how many steps.
    Budget {
        chain: &'static str,
        path: &'static str,
        observable: &'static str,
        sizes: &'static str,
        steps: &'static str,
    },
    /// The report of a study: the picture whose words begin so.
    Report { study: &'static str, words: &'static str },
}

use Drawn::{Budget, Report};

/// `examples/course/box.toml`, in short.
const SIZES: &str = "\"*\" = \"10 arcsec\"\n";
const ALT_AZIMUTH: &str = "examples/alt-azimuth/alt-azimuth.chain";
const MOUNT: &str = "examples/course/mount.chain";
const OVER_THE_SKY: &str = "azimuth=t, elevation=t/4";
const COURSE: &str = "examples/course/study.toml";
const TARGETS: &str = "examples/objects/targets.toml";
const WALLS: &str = "examples/objects/walls.toml";
const TURNTABLE: &str = "examples/turntable/turntable.toml";

const fn budget(chain: &'static str, path: &'static str, observable: &'static str) -> Drawn {
    Budget { chain, path, observable, sizes: SIZES, steps: "1" }
}

const fn report(study: &'static str, words: &'static str) -> Drawn {
    Report { study, words }
}

/// Pages, and what draws the picture of each: `docs/src/PAGE.svg`.
const PICTURES: [(&str, Drawn); 53] = [
    ("algebra/canonical-form", budget("examples/turntable/turntable.chain", "azimuth=t", "pointing")),
    (
        "algebra/exact-difference",
        Budget {
            chain: MOUNT,
            path: OVER_THE_SKY,
            observable: "pointing",
            sizes: "\"*\" = \"0.000001 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "algebra/first-order",
        Budget {
            chain: MOUNT,
            path: OVER_THE_SKY,
            observable: "pointing",
            sizes: "tilt_x = \"10 arcsec\"\nnonperpendicularity = \"10 arcsec\"\ncollimation = \"10 arcsec\"\n",
            steps: "5",
        },
    ),
    (
        "algebra/identifiability",
        Budget {
            chain: "docs/src/interactive/knobs.chain",
            path: OVER_THE_SKY,
            observable: "pointing",
            sizes: "foundation = \"10 arcsec\"\nazimuth_index = \"10 arcsec\"\nnonperpendicularity = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "algebra/remainder",
        Budget {
            chain: MOUNT,
            path: OVER_THE_SKY,
            observable: "pointing",
            sizes: "tilt_x = \"40 deg\"\nnonperpendicularity = \"40 deg\"\ncollimation = \"40 deg\"\n",
            steps: "5",
        },
    ),
    ("browser", report("examples/phone-lab/lab.toml", "Held-out data")),
    ("calibration/fit", report(COURSE, "Lengthwise against sideways residual")),
    (
        "calibration/instruments",
        budget("examples/auxtel/auxtel.chain", "azimuth=t, elevation=0.3+t/6", "sight"),
    ),
    ("calibration/noise", report(COURSE, "Histogram, sideways residual")),
    ("calibration/objects", report(WALLS, "Rz of alidade")),
    ("calibration/observations", report(TURNTABLE, "Over the sky.")),
    ("calibration/report", report(COURSE, "Rx of elevation_axis")),
    ("calibration/troubles", report(COURSE, "Normal Q-Q plot, lengthwise residual")),
    ("calibration/what-the-data-say", report(COURSE, "Over the sky, after.")),
    (
        "certificates/README",
        Budget {
            chain: "examples/mobile-lidar/mobile-lidar.chain",
            path: "alpha=t, beta=t, gamma=t",
            observable: "pointing",
            sizes: "\"dtheta*\" = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    ("checker/README", budget(MOUNT, OVER_THE_SKY, "pointing")),
    ("checker/kinds", budget("examples/gallery/total-station.chain", "hz=t, v=t/4+0.5", "sight")),
    ("codegen/README", budget(ALT_AZIMUTH, OVER_THE_SKY, "sight")),
    (
        "codegen/calibrated",
        Budget {
            chain: ALT_AZIMUTH,
            path: OVER_THE_SKY,
            observable: "sight",
            sizes: "tilt_east = \"30 arcsec\"\ncollimation = \"60 arcsec\"\nelevation_index = \"20 arcsec\"\n",
            steps: "1",
        },
    ),
    ("codegen/program", budget("examples/gallery/gimbal.chain", "psi=t, phi=t/3, theta=t/2", "sight")),
    ("commands/README", report(TURNTABLE, "Sideways residual over azimuth")),
    ("commands/apply", report(COURSE, "Over the sky, before.")),
    ("commands/compare", report(COURSE, "sideways residual row by row")),
    (
        "commands/derive",
        Budget {
            chain: "examples/two-links/two-links.chain",
            path: "q1=t, q2=t/2, q3=t/3",
            observable: "tip",
            sizes: "\"*\" = \"10 arcsec\"\n\"length*\" = \"0.1 mm\"\n",
            steps: "1",
        },
    ),
    ("commands/export", report(COURSE, "Sideways residual over azimuth")),
    ("commands/files", report(COURSE, "Histogram, lengthwise residual")),
    ("commands/read", report(TARGETS, "Lengthwise residual over range")),
    ("commands/verify", report(COURSE, "lengthwise residual row by row")),
    (
        "commands/years",
        Budget {
            chain: ALT_AZIMUTH,
            path: OVER_THE_SKY,
            observable: "sight",
            sizes: "elevation_index = \"12 arcsec\"\ntilt_east = \"12 arcsec\"\n",
            steps: "1",
        },
    ),
    ("diagnosis/README", report(COURSE, "Lengthwise residual over elevation")),
    ("diagnosis/blind", report("examples/eye-in-hand/marks.toml", "Rx of fore")),
    ("diagnosis/evaluation", report("examples/mobile-lidar/study.toml", "Held-out data")),
    ("diagnosis/misread", report(COURSE, "Sideways residual over elevation")),
    ("diagnosis/own", report(TARGETS, "Rz of alidade")),
    ("diagnosis/thresholds", report(WALLS, "Held-out data")),
    ("gallery/alt-azimuth", budget("examples/gallery/alt-azimuth.chain", OVER_THE_SKY, "sight")),
    (
        "gallery/arm",
        Budget {
            chain: "examples/gallery/arm.chain",
            path: "theta1=t, theta2=t/2, theta3=t/3",
            observable: "hand",
            sizes: "\"d*\" = \"10 arcsec\"\nda2 = \"0.1 mm\"\nda3 = \"0.1 mm\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/boresight",
        Budget {
            chain: "examples/gallery/boresight.chain",
            path: "theta=t, kappa=0, phi=0, omega=0, rho=50 m",
            observable: "target",
            sizes: "bp = \"10 arcsec\"\nbk = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/camera",
        Budget {
            chain: "examples/gallery/camera.chain",
            path: "depth=2+t, X=0.5 m, Y=0.2 m",
            observable: "seen",
            sizes: "wx = \"10 arcsec\"\nwz = \"10 arcsec\"\nvx = \"0.1 mm\"\n",
            steps: "1",
        },
    ),
    ("gallery/equatorial", budget("examples/gallery/equatorial.chain", "ha=t, dec=t/4", "sight")),
    (
        "gallery/five-axis",
        Budget {
            chain: "examples/gallery/five-axis.chain",
            path: "x=0.1, y=0.05*t, z=0.1, a=t/4, c=t",
            observable: "tip",
            sizes: "aa = \"10 arcsec\"\nbca = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    ("gallery/gimbal", budget("examples/gallery/gimbal.chain", "psi=t, phi=t/3, theta=t/2", "sight")),
    (
        "gallery/hexapod-leg",
        Budget {
            chain: "examples/gallery/hexapod-leg.chain",
            path: "x=0, y=0, z=1, psi=t, theta=0, phi=0",
            observable: "leg",
            sizes: "wx = \"10 arcsec\"\nwy = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/inertial-platform",
        Budget {
            chain: "examples/gallery/inertial-platform.chain",
            path: "heading=t, pitch=t/4, roll=0, fx=1, fy=0, fz=9.81",
            observable: "force",
            sizes: "\"s*\" = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/laser-scanner",
        Budget {
            chain: "examples/gallery/laser-scanner.chain",
            path: "theta=t, alpha=t/4, rho=20 m",
            observable: "target",
            sizes: "b1 = \"10 arcsec\"\nb2 = \"10 arcsec\"\nb3 = \"10 arcsec\"\nb5 = \"10 arcsec\"\nc0 = \"10 arcsec\"\nc1 = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/laser-tracker",
        Budget {
            chain: "examples/gallery/laser-tracker.chain",
            path: "hz=t, v=t/4+0.5, range=10 m",
            observable: "target",
            sizes: "\"ecc_*\" = \"10 arcsec\"\ntransit_tilt = \"10 arcsec\"\nv_index = \"10 arcsec\"\nbeam_tilt = \"10 arcsec\"\ntransit_offset = \"0.1 mm\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/machine-tool",
        Budget {
            chain: "examples/gallery/machine-tool.chain",
            path: "x=0.1*t, y=0.1*t, z=0.1*t",
            observable: "tip",
            sizes: "eax = \"10 arcsec\"\nebx = \"10 arcsec\"\necx = \"10 arcsec\"\nc0y = \"10 arcsec\"\na0z = \"10 arcsec\"\nb0z = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/planar-arm",
        Budget {
            chain: "examples/gallery/planar-arm.chain",
            path: "theta1=t, theta2=t/2",
            observable: "tip",
            sizes: "dtheta1 = \"10 arcsec\"\ndtheta2 = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/radio-antenna",
        Budget {
            chain: "examples/gallery/radio-antenna.chain",
            path: "az=t, el=0.3+t/5",
            observable: "beam",
            sizes: "tilt_n = \"10 arcsec\"\np1 = \"10 arcsec\"\np3 = \"10 arcsec\"\np8 = \"10 arcsec\"\nrefraction = \"10 arcsec\"\np2 = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    (
        "gallery/rate-table",
        Budget {
            chain: "examples/gallery/rate-table.chain",
            path: "alpha=t, beta=t/2, gamma=t/3",
            observable: "vertical",
            sizes: "l_x = \"10 arcsec\"\no_mo = \"10 arcsec\"\no_im = \"10 arcsec\"\ndgamma = \"10 arcsec\"\nm_x = \"10 arcsec\"\nm_y = \"10 arcsec\"\n",
            steps: "1",
        },
    ),
    ("gallery/total-station", budget("examples/gallery/total-station.chain", "hz=t, v=t/4+0.5", "sight")),
    ("language/README", budget(ALT_AZIMUTH, OVER_THE_SKY, "sight")),
    ("quick-start", report(COURSE, "Held-out data")),
];

/// Colours of the report in daylight, and what its pictures are drawn with: a picture that stands alone has the page's paper.
fn alone(picture: &str, page: &str) -> String {
    let style = page.split("<style>").nth(1).and_then(|rest| rest.split("</style>").next()).expect("a style");
    let daylight = style.split("@media").next().expect("colours");
    let from = style.find("svg { display").expect("rules of pictures");
    let rules = style[from..].split("#tip").next().expect("the end of these rules");
    let (tag, rest) = picture.split_once('>').expect("a picture");
    let view = tag.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next()).expect("a view");
    let (width, height) = view.split_once(' ').expect("two sizes");
    let defs = page.split("<defs>").nth(1).and_then(|rest| rest.split("</defs>").next()).expect("patterns");
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\"{}>\n<style>{daylight}\n{rules}</style><defs>{defs}</defs>\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>{rest}\n",
        tag.strip_prefix("<svg").expect("a picture")
    )
}

/// The picture of a report whose words begin so.
fn of_report(page: &str, words: &str) -> String {
    let from = page.find(&format!("aria-label=\"{words}")).unwrap_or_else(|| panic!("no picture {words}"));
    let from = page[..from].rfind("<svg").expect("its beginning");
    let to = page[from..].find("</svg>").expect("its end") + from + "</svg>".len();
    alone(&page[from..to], page)
}

fn drawn(folder: &Folder, by: &Drawn) -> String {
    match by {
        Budget { chain, path, observable, sizes, steps } => {
            let chain = root().join(chain).display().to_string();
            folder.write("box.toml", sizes);
            let run = folder.trueaxis(&[
                "budget",
                &chain,
                "--sizes",
                "box.toml",
                "--path",
                path,
                "--observable",
                observable,
                "--steps",
                steps,
                "--out",
                "figures",
            ]);
            assert_eq!(run.code, 0, "{chain}: {}", run.stderr);
            folder.read(&format!("figures/{observable}.svg"))
        }
        Report { study, words } => {
            let name = study.replace(['/', '.'], "-");
            if !folder.0.join(&name).is_dir() {
                let run = folder.trueaxis(&[
                    "calibrate",
                    &root().join(study).display().to_string(),
                    "--out",
                    &name,
                ]);
                assert_eq!(run.code, 0, "{study}: {}", run.stderr);
            }
            of_report(&folder.read(&format!("{name}/report.html")), words)
        }
    }
}

#[test]
fn pictures_of_pages_are_what_the_commands_draw() {
    let folder = Folder::new("book-pictures");
    let mut stale = Vec::new();
    for (page, by) in &PICTURES {
        let (what, picture) = (root().join("docs/src").join(page), drawn(&folder, by));
        let file = what.with_extension("svg");
        if fs::read_to_string(&file).ok().as_deref() != Some(&picture) {
            stale.push(*page);
            if std::env::var_os("UPDATE_BOOK").is_some() {
                fs::write(&file, &picture).expect("a picture");
            }
        }
        let text = fs::read_to_string(what.with_extension("md")).expect("a page");
        let name = file.file_name().expect("a name").to_string_lossy();
        assert!(text.contains(&format!("]({name})")), "{page} does not show its picture");
        let (Budget { chain: source, .. } | Report { study: source, .. }) = by;
        assert!(text.contains(source), "{page} does not say that its picture is of {source}");
    }
    assert!(
        stale.is_empty() || std::env::var_os("UPDATE_BOOK").is_some(),
        "draw them anew with UPDATE_BOOK=1: {stale:?}"
    );
}

/// Pages without a picture: tables of measurements, answers of other programs, chains without an error.
const WITHOUT: [&str; 7] = [
    "algebra/speed",
    "calibration/growth",
    "codegen/speed",
    "gallery/cylindrical-robot",
    "gallery/peers",
    "gallery/puma",
    "gallery/screw-arm",
];

#[test]
fn every_reference_page_shows_a_picture() {
    let without = super::reference_pages(|page| !page.contains(".svg)"));
    assert_eq!(without, WITHOUT);
}

#[test]
fn every_reference_page_has_an_example_that_runs() {
    // The examples of the Python package are programs in Python.
    let without =
        super::reference_pages(|page| !steps(page).iter().any(|step| matches!(step, Step::Run { .. })));
    assert_eq!(without, ["python/README"]);
}
