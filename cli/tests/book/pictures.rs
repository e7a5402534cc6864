//! Pictures of reference pages, as `budget` and `calibrate` draw them. A page shows its picture and names the command.
//!
//! `UPDATE_BOOK=1` draws them anew.

use std::fs;

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

const fn of_mount(sizes: &'static str, steps: &'static str) -> Drawn {
    Budget { chain: MOUNT, path: OVER_THE_SKY, observable: "pointing", sizes, steps }
}

const fn report(study: &'static str, words: &'static str) -> Drawn {
    Report { study, words }
}

/// Pages, and what draws the picture of each: `docs/src/PAGE.svg`.
const PICTURES: [(&str, Drawn); 29] = [
    ("algebra/canonical-form", budget("examples/turntable/turntable.chain", "azimuth=t", "pointing")),
    ("algebra/exact-difference", of_mount("\"*\" = \"0.000001 arcsec\"\n", "1")),
    ("algebra/first-order", of_mount(SIZES, "5")),
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
    ("algebra/remainder", of_mount("\"*\" = \"40 deg\"\n", "5")),
    ("calibration/fit", report(COURSE, "Lengthwise against sideways residual")),
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
    ("checker/README", of_mount(SIZES, "1")),
    ("checker/kinds", budget("examples/gallery/total-station.chain", "hz=t, v=t/4+0.5", "sight")),
    ("codegen/README", budget(ALT_AZIMUTH, OVER_THE_SKY, "sight")),
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
    ("commands/years", budget(ALT_AZIMUTH, OVER_THE_SKY, "sight")),
    ("diagnosis/README", report(COURSE, "Lengthwise residual over elevation")),
    ("diagnosis/own", report(TARGETS, "Rz of alidade")),
    ("language/README", budget("examples/alt-azimuth/alt-azimuth.chain", OVER_THE_SKY, "sight")),
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

/// Pages that are tables of measurements, or of numbers that decide.
const TABLES: [&str; 7] = [
    "algebra/speed",
    "calibration/growth",
    "calibration/instruments",
    "codegen/speed",
    "diagnosis/blind",
    "diagnosis/evaluation",
    "diagnosis/thresholds",
];

#[test]
fn every_reference_page_shows_a_picture() {
    let rooms = "algebra calibration certificates checker codegen commands diagnosis language macro python";
    let mut without = Vec::new();
    for room in rooms.split(' ') {
        for entry in fs::read_dir(root().join("docs/src").join(room)).expect("a room of the book") {
            let path = entry.expect("readable").path();
            if path.extension().is_some_and(|extension| extension == "md") {
                let page = format!("{room}/{}", path.file_stem().expect("a name").to_string_lossy());
                if !fs::read_to_string(&path).expect("a page").contains(".svg)") {
                    without.push(page);
                }
            }
        }
    }
    without.sort();
    assert_eq!(without, TABLES);
}
