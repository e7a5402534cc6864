//! Pages that ask before they show: small, usable with a keyboard on a narrow screen, and with the numbers that the command computes.

use std::fs;
use std::process::Command;

use crate::interactive::{browse, numbers};
use crate::support::{Folder, root};

/// The pages, and the lesson that links to each.
const PAGES: [(&str, &str); 7] = [
    ("commute", "01-rotations"),
    ("sphere", "04-four-transforms"),
    ("cancel", "07-null-spaces"),
    ("bound", "08-remainder"),
    ("talk", "10-residuals"),
    ("region", "12-judging"),
    ("setups", "12-judging"),
];
/// Bytes of script a page has at most.
const MOST_SCRIPT: u64 = 100_000;

fn read(file: &str) -> String {
    fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

#[test]
fn pages_are_small_linked_and_need_no_network() {
    let overview = read("docs/src/interactive/README.md");
    for (page, lesson) in PAGES {
        let html = read(&format!("docs/src/interactive/{page}.html"));
        let scripts =
            html.split("<script src=\"").skip(1).map(|rest| rest.split('"').next().expect("a name"));
        let bytes: u64 = scripts
            .map(|script| {
                let file = root().join("docs/src/interactive").join(script);
                fs::metadata(&file).unwrap_or_else(|error| panic!("{page}: {script}: {error}")).len()
            })
            .sum();
        assert!((1..=MOST_SCRIPT).contains(&bytes), "{page}: {bytes} bytes of script");
        assert!(!html.contains("://"), "{page}: needs a network");
        assert_eq!(html.matches("data-right").count(), 1, "{page}: one right answer");
        assert!(html.contains("<noscript>"), "{page}: nothing without a script");
        assert!(overview.contains(&format!("({page}.html)")), "{page}: not in the overview");
        let lesson = read(&format!("docs/src/course/{lesson}.md"));
        assert!(lesson.contains(&format!("(../interactive/{page}.html)")), "{page}: not in its lesson");
    }
}

#[test]
fn pages_are_used_by_keyboard_on_a_narrow_screen() {
    let (Some(node), Some(browser)) = (testkit::tool(testkit::NODE), testkit::tool(testkit::BROWSER)) else {
        return;
    };
    let run = Command::new(node)
        .arg(root().join("cli/tests/book/explorables.mjs"))
        .arg(browser)
        .arg(root().join("docs/src/interactive"))
        .args(PAGES.map(|(page, _)| page))
        .output()
        .expect("node runs");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}

/// What `eval` prints of one pose: the observables, from the first to the last.
fn eval(chain: &str, pose: &str, errors: &[(&str, f64, &str)], form: &str) -> Vec<f64> {
    let folder = Folder::new(&format!("book-explorables-{form}-{}", chain.replace(['/', '.'], "-")));
    let lines: String =
        errors.iter().map(|(name, value, unit)| format!("{name} = \"{value} {unit}\"\n")).collect();
    folder.write("errors.toml", lines).write("pose.csv", pose);
    let chain = root().join(chain).display().to_string();
    let run = folder.trueaxis(&[
        "eval",
        &chain,
        "--data",
        "pose.csv",
        "--errors",
        "errors.toml",
        "--form",
        form,
        "--out",
        "-",
    ]);
    let mut lines = run.stdout.lines();
    let columns = pose.lines().next().expect("a header").split(',').count();
    let row = lines.nth(1).unwrap_or_else(|| panic!("{}{}", run.stdout, run.stderr));
    row.split(',').skip(columns).map(|cell| cell.parse().expect("a number")).collect()
}

/// Sums of some tens of terms, in another order.
fn assert_near(shown: &[f64], expected: &[f64], size: f64) {
    assert_eq!(shown.len(), expected.len(), "{shown:?} {expected:?}");
    for (shown, expected) in shown.iter().zip(expected) {
        assert!((shown - expected).abs() <= 64.0 * f64::EPSILON * size, "{shown} {expected}");
    }
}

#[test]
fn numbers_of_the_pages_are_those_of_eval() {
    let Some((page, console)) = browse("commute.html#choice=0&turn_x=50&turn_y=20") else { return };
    assert_eq!(console, "");
    // A value is its error added to the direction without errors.
    let turns = [("turn_x", 50.0, "deg"), ("turn_y", 20.0, "deg")];
    let mut expected = eval("docs/src/interactive/orders.chain", "row\n1\n", &turns, "exact");
    expected[0] += 1.0;
    expected[3] += 1.0;
    assert_near(&numbers(&page, "ends"), &expected, 1.0);

    let errors =
        [("tilt_x", 12.0, "arcsec"), ("collimation", -25.0, "arcsec"), ("azimuth_index", 40.0, "arcsec")];
    let hash: String = errors.iter().map(|(name, value, _)| format!("&{name}={value}")).collect();
    let shown = browse(&format!("sphere.html#choice=2&azimuth=70&elevation=35{hash}"));
    let (page, console) = shown.expect("a browser, as before");
    assert_eq!(console, "");
    let pose = "azimuth [deg],elevation [deg]\n70,35\n";
    for (row, form) in ["exact", "first-order"].into_iter().enumerate() {
        let expected = eval("examples/course/mount.chain", pose, &errors, form);
        assert_near(&numbers(&page, "error")[3 * row..3 * row + 3], &expected, 1e-3);
    }
}

#[test]
fn pages_show_what_they_claim() {
    let Some((page, _)) = browse("cancel.html#choice=0&foundation=-40&azimuth_index=58") else { return };
    assert!(page.contains("All stars fit.") && numbers(&page, "misfit")[0] < 1e-9, "{page}");
    let shown = |address: &str| browse(address).expect("a browser, as before").0;
    assert!(shown("cancel.html#choice=0&foundation=-40&azimuth_index=50").contains("The stars do not fit."));
    for size in ["0", "4", "8"] {
        let page = shown(&format!("bound.html#choice=2&largest={size}&seed=41"));
        assert!(page.contains("0 of 2000 draws are beyond the bound."), "{page}");
        let [proven, found, drawn] = numbers(&page, "numbers")[..] else { panic!("{page}") };
        assert!(drawn < found && found < proven, "{drawn} {found} {proven}");
    }
    // An encoder off centre moves the line of sight sideways only; the mean of cos² of the elevations is in the amplitude.
    let [up, up_twice, side, side_twice] = numbers(&shown("talk.html#choice=1&seed=41"), "waves")[..] else {
        panic!("four waves")
    };
    assert!(
        side > 10.0 && side > 5.0 * up.max(up_twice) && side > 3.0 * side_twice,
        "{up} {side} {side_twice}"
    );
    let page = shown("region.html#choice=2&seed=41");
    let [inside, outside] = numbers(&page, "apart")[..] else { panic!("{page}") };
    assert!(inside < 4.0 && outside > 20.0, "{inside} {outside}");
    let page = shown("setups.html#choice=2&seed=41");
    let [by_rows, _, by_setups, _] = numbers(&page, "numbers")[..] else { panic!("{page}") };
    assert!((0.27..0.40).contains(&by_rows) && (0.93..0.97).contains(&by_setups), "{by_rows} {by_setups}");
}

#[test]
fn an_address_from_a_stranger_spoils_nothing() {
    let evil = "%22%3E%3Cimg%20src%3Dx%20onerror%3D%22document.title%3D1%22%3E";
    // One start of the browser a page: each setting of it is spoiled in another way.
    for (page, settings) in [
        ("cancel", format!("foundation={evil}&pair=99")),
        ("talk", format!("effect={evil}&hidden=toString&seed=1e400")),
        ("bound", format!("largest=99999&seed={evil}")),
    ] {
        let Some((shown, console)) = browse(&format!("{page}.html#choice=0&{settings}")) else { return };
        assert_eq!(console, "", "{page}: {settings}");
        assert!(!shown.contains("<img") && !shown.contains("NaN"), "{page}: {settings}: {shown}");
    }
}
