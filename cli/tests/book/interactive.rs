//! The pages to play with: their code is what `generate` writes, and a browser shows the numbers that `eval` computes.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::{Folder, root};

const FOLDER: &str = "docs/src/interactive";
const CHAIN: &str = "examples/mobile-lidar/mobile-lidar.chain";
const MOUNT: &str = "examples/course/mount.chain";

/// A generated module of the pages.
struct Model {
    /// The script in [`FOLDER`], without its ending.
    file: &'static str,
    /// What the pages call it.
    name: &'static str,
    chain: &'static str,
    /// What else `generate` is asked.
    arguments: &'static str,
}

/// What the pages with a question ask of a chain.
const ONE_POSE: &str =
    "--no-rows --only exact-value --only exact-error --only first-order-error --only first-order-jacobian";
const MODELS: [Model; 5] = [
    Model {
        file: "mobile-lidar",
        name: "mobileLidar",
        chain: CHAIN,
        arguments: "--observable pointing --observable position",
    },
    Model { file: "mount", name: "mount", chain: MOUNT, arguments: ONE_POSE },
    Model { file: "orders", name: "orders", chain: "docs/src/interactive/orders.chain", arguments: ONE_POSE },
    Model { file: "knobs", name: "knobs", chain: "docs/src/interactive/knobs.chain", arguments: ONE_POSE },
    Model {
        file: "effects",
        name: "effects",
        chain: "docs/src/interactive/effects.chain",
        arguments: ONE_POSE,
    },
];

/// The generated module as a plain script, which a page opened from a folder may load.
fn script(model: &Model) -> String {
    let folder = Folder::new(&format!("book-interactive-{}", model.file));
    let chain = root().join(model.chain).display().to_string();
    let mut arguments = vec!["generate", &chain, "--language", "javascript", "--out", "model.js"];
    arguments.extend(model.arguments.split(' '));
    let run = folder.trueaxis(&arguments);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let generated = folder.read("model.js");
    let names: Vec<&str> = generated
        .lines()
        .filter_map(|line| {
            let rest =
                line.strip_prefix("export const ").or_else(|| line.strip_prefix("export function "))?;
            rest.split([' ', '(']).next()
        })
        .collect();
    let script = generated.lines().map(|line| format!("{}\n", line.strip_prefix("export ").unwrap_or(line)));
    let script: String = script.collect();
    format!("(() => {{\n{script}\nwindow.{} = {{ {} }};\n}})();\n", model.name, names.join(", "))
}

/// What `bound` proves of the mount, and what its search finds, for some sizes of every error.
fn bounds() -> String {
    let folder = Folder::new("book-interactive-bounds");
    let chain = root().join(MOUNT).display().to_string();
    let mut script = "// Largest size of each error of the mount in seconds of arc; what `trueaxis bound` proves of |exact - first order|; \
                      what it found.\nwindow.bounds = [\n"
        .to_owned();
    for arcsec in [1, 3, 10, 30, 60, 180, 600, 1800, 3600] {
        folder.write("box.toml", format!("\"*\" = \"{arcsec} arcsec\"\n"));
        let run = folder.trueaxis(&["bound", &chain, "--sizes", "box.toml"]);
        let last = |words: &str| {
            let line = run.stdout.lines().find(|line| line.contains(words));
            line.and_then(|line| line.split(' ').next_back()).unwrap_or_else(|| panic!("{}", run.stdout))
        };
        let (proven, found) = (last("is never more than"), last("largest found by search"));
        let _ = writeln!(script, "  [{arcsec}, {proven}, {found}],");
    }
    script + "];\n"
}

#[test]
fn the_pages_run_what_the_program_writes() {
    let models = MODELS.iter().map(|model| (model.file, script(model)));
    let mut stale = Vec::new();
    for (file, script) in models.chain([("bounds", bounds())]) {
        let path = root().join(FOLDER).join(file).with_extension("js");
        if std::env::var_os("UPDATE_BOOK").is_some() {
            fs::write(&path, &script).expect("the book is ours to write");
        }
        if fs::read_to_string(path).expect("a script of the pages") != script {
            stale.push(file);
        }
    }
    assert!(stale.is_empty(), "not what the program writes: {stale:?}; run the test with UPDATE_BOOK=1");
}

/// A page as a browser leaves it, and what it wrote to its console; `None` where no browser is.
pub fn browse(page: &str) -> Option<(String, String)> {
    browse_file(&root().join(FOLDER), page)
}

/// The same of a page of any folder.
pub fn browse_file(folder: &Path, page: &str) -> Option<(String, String)> {
    let browser = testkit::tool(testkit::BROWSER)?;
    let profile = Folder::new(&format!("book-browser-{}", page.replace(|c: char| !c.is_alphanumeric(), "-")));
    let address = format!("file://{}/{page}", folder.display());
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--window-size=1280,720",
            "--no-first-run",
            "--disable-background-networking",
        ])
        .args([
            "--disable-component-update",
            "--disable-sync",
            "--disable-quic",
            "--enable-logging=stderr",
            "--dump-dom",
        ])
        .arg(format!("--user-data-dir={}", profile.0.display()))
        .arg(address)
        .output()
        .expect("the browser runs");
    let said = String::from_utf8_lossy(&output.stderr);
    let console: Vec<&str> = said.lines().filter(|line| line.contains("CONSOLE")).collect();
    Some((String::from_utf8(output.stdout).expect("UTF-8"), console.join("\n")))
}

/// The numbers of a table of the page, row by row.
pub fn numbers(page: &str, table: &str) -> Vec<f64> {
    let body = page.split(&format!("<tbody id=\"{table}\">")).nth(1).expect("the table");
    let body = body.split("</tbody>").next().expect("its end");
    body.split("data-value=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().expect("a value").parse().expect("a number"))
        .collect()
}

#[test]
fn a_browser_shows_what_eval_computes() {
    let folder = Folder::new("book-interactive-eval");
    let set = [
        ("dtheta_y1", 12.0, "arcsec"),
        ("da1", -30.0, "arcsec"),
        ("db2", 7.0, "arcsec"),
        ("dx4", 0.3, "mm"),
        ("da4", 25.0, "arcsec"),
    ];
    let hash: String = set.iter().map(|(name, value, _)| format!("&{name}={value}")).collect();
    let Some((page, console)) = browse(&format!("scanner.html#alpha=-100&beta=65&gamma=20{hash}")) else {
        return;
    };
    assert_eq!(console, "");
    let errors: String =
        set.iter().map(|(name, value, unit)| format!("{name} = \"{value} {unit}\"\n")).collect();
    folder.write("errors.toml", errors).write("pose.csv", "alpha [deg],beta [deg],gamma [deg]\n-100,65,20\n");
    let chain = root().join(CHAIN).display().to_string();
    for (observable, size) in [("pointing", 1e-4), ("position", 3e-4)] {
        for (row, form) in ["exact", "first-order"].into_iter().enumerate() {
            let run = folder.trueaxis(&[
                "eval",
                &chain,
                "--data",
                "pose.csv",
                "--errors",
                "errors.toml",
                "--observable",
                observable,
                "--form",
                form,
                "--out",
                "-",
            ]);
            let last =
                run.stdout.lines().nth(1).unwrap_or_else(|| panic!("a row\n{}{}", run.stdout, run.stderr));
            let expected: Vec<f64> =
                last.split(',').skip(3).map(|cell| cell.parse().expect("a number")).collect();
            let shown = &numbers(&page, observable)[4 * row..4 * row + 3];
            for (shown, expected) in shown.iter().zip(&expected) {
                // Sums of tens of terms of at most `size`, in another order.
                assert!(
                    (shown - expected).abs() <= 64.0 * f64::EPSILON * size,
                    "{observable} {form}: {shown} {expected}"
                );
            }
        }
    }
}

#[test]
fn the_search_of_the_page_finds_what_is_hidden_and_nothing_else() {
    let Some((page, console)) = browse("search.html#effect=9&size=6&noise=3&rows=120&seed=3") else { return };
    assert_eq!(console, "");
    assert!(page.contains("That is what you hid."), "{page}");
    let Some((page, _)) = browse("search.html#effect=9&size=0&noise=3&rows=120&seed=3") else { return };
    assert!(page.contains("Right: nothing was hidden."), "{page}");
}
