//! The pages to play with: their code is what `generate` writes, and a browser shows the numbers that `eval` computes.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::support::{Folder, root};

const MODEL: &str = "docs/src/interactive/mobile-lidar.js";
const CHAIN: &str = "examples/mobile-lidar/mobile-lidar.chain";

/// The generated module as a plain script, which a page opened from a folder may load.
fn model() -> String {
    let folder = Folder::new("book-interactive-model");
    let chain = root().join(CHAIN).display().to_string();
    let run = folder.trueaxis(&[
        "generate",
        &chain,
        "--language",
        "javascript",
        "--observable",
        "pointing",
        "--observable",
        "position",
        "--out",
        "model.js",
    ]);
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
    format!("(() => {{\n{script}\nwindow.mobileLidar = {{ {} }};\n}})();\n", names.join(", "))
}

#[test]
fn the_pages_run_what_generate_writes() {
    let (path, model) = (root().join(MODEL), model());
    if std::env::var_os("UPDATE_BOOK").is_some() {
        fs::write(&path, &model).expect("the book is ours to write");
    }
    let committed = fs::read_to_string(path).expect("the script of the pages");
    assert!(committed == model, "{MODEL} is not what `generate` writes: run the test with UPDATE_BOOK=1");
}

/// A page as a browser leaves it, and what it wrote to its console; `None` where no browser is.
fn browse(page: &str) -> Option<(String, String)> {
    browse_file(&root().join("docs/src/interactive"), page)
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
fn numbers(page: &str, table: &str) -> Vec<f64> {
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
