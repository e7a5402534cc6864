//! The report in a browser: it renders, says no error, and answers to hover, marking and the choice of before and after.

#[path = "../support/mod.rs"]
mod support;

use std::fs;
use std::path::Path;
use std::process::Command;

use support::{Folder, root, trueaxis};

/// Bytes that the page of a study of 400 rows may have: those of 1,000 rows are at most a megabyte.
const MOST_BYTES: usize = 1_000_000;

/// Does what a person would, and writes what came of it into the page.
const ACTIONS: &str = r##"<script>
addEventListener("load", () => {
  const said = [];
  const say = (name, value) => said.push(`${name}=${value}`);
  try {
    say("wide", document.documentElement.scrollWidth <= innerWidth);
    const svg = document.querySelector("svg.rows");
    svg.scrollIntoView();
    const box = svg.getBoundingClientRect();
    const at = (type, x, y) => svg.dispatchEvent(new PointerEvent(type,
      { clientX: box.left + x * box.width, clientY: box.top + y * box.height, pointerId: 1, bubbles: true }));
    svg.setPointerCapture = () => {};
    const tip = document.getElementById("tip");
    let named = "";
    for (let x = 0.15; x < 0.95 && !named; x += 0.02) for (let y = 0.1; y < 0.85; y += 0.02) {
      at("pointermove", x, y);
      if (!tip.hidden) { named = tip.textContent; break; }
    }
    say("hover", /^Row \d+.*residual/.test(named));
    at("pointerdown", 0.2, 0.1); at("pointermove", 0.5, 0.8); at("pointerup", 0.5, 0.8);
    const drawn = [...document.querySelectorAll("svg.rows .over")];
    say("brushed", drawn.filter((over) => over.querySelector(".marked")).length === drawn.length);
    say("told", /\d+ of \d+ rows marked/.test(document.getElementById("state").textContent));
    const zoom = document.getElementById("zoom"), ticks = () => [...svg.querySelectorAll(".axes text")].map((t) => t.textContent).join();
    const whole = ticks(), dots = () => svg.querySelector(".dot").getAttribute("d").split("M").length, all = dots();
    zoom.click();
    say("zoomed", ticks() !== whole && dots() < all && !/NaN|Infinity|undefined/.test(document.getElementById("residuals").innerHTML));
    zoom.click();
    say("whole", ticks() === whole && dots() === all);
    document.getElementById("show-after").click();
    say("toggle", getComputedStyle(document.querySelector("path.before")).display === "none"
      && getComputedStyle(document.querySelector("path.after")).display !== "none");
    const grow = document.querySelector(".grow"), card = grow.closest(".card"), narrow = card.offsetWidth;
    grow.click();
    say("enlarged", grow.getAttribute("aria-pressed") === "true" && card.offsetWidth >= narrow && !!grow.getAttribute("aria-label"));
    document.getElementById("clear").click();
    say("cleared", !document.querySelector(".over .marked"));
    say("names", [...document.querySelectorAll("svg")].every((s) => s.getAttribute("aria-hidden") || s.getAttribute("aria-label")));
    say("ids", new Set([...document.querySelectorAll("[id]")].map((e) => e.id)).size === document.querySelectorAll("[id]").length);
  } catch (error) { say("error", error); }
  const out = document.createElement("output");
  out.id = "said"; out.textContent = said.join(" ");
  document.body.append(out);
});
</script></body>"##;

/// What the browser makes of a page at a width, and what it says meanwhile.
fn rendered(browser: &Path, folder: &Folder, page: &str, width: u32) -> (String, String) {
    let profile = folder.0.join(format!("profile-{width}"));
    let out = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .args(["--enable-logging=stderr", "--virtual-time-budget=4000", "--dump-dom"])
        .arg(format!("--window-size={width},900"))
        .arg(format!("--user-data-dir={}", profile.display()))
        .arg(folder.0.join(page))
        .output()
        .expect("the browser runs");
    (String::from_utf8_lossy(&out.stdout).into_owned(), String::from_utf8_lossy(&out.stderr).into_owned())
}

/// Pictures of residuals that no fold hides, as a page opens.
fn open_pictures(page: &str) -> usize {
    let (_, behind) = page.split_once("<section id=\"residuals\"").expect("residuals");
    let (pictures, _) = behind.split_once("<section id=\"values\"").expect("values");
    let (mut folds, mut open) = (0, 0);
    for tag in pictures.split('<') {
        folds += usize::from(tag.starts_with("details"));
        folds -= usize::from(tag.starts_with("/details"));
        open += usize::from(folds == 0 && tag.starts_with("section class=\"card"));
    }
    open
}

#[test]
fn long_reports_open_twelve_pictures_and_short_ones_none() {
    let folder = Folder::new("open-pictures");
    let out = folder.0.to_str().expect("UTF-8");
    for study in ["examples/course/study.toml", "examples/encoder/encoder-b.toml"] {
        if study.contains("encoder") && testkit::measured("encoder-b.csv").is_none() {
            continue;
        }
        let run = trueaxis(&["calibrate", study, "--out", out]);
        assert_eq!(run.code, 0, "{run}");
        let page = folder.read("report.html");
        assert!((3..=12).contains(&open_pictures(&page)), "{study}: {}", open_pictures(&page));
        assert!(page.contains("How the residuals are distributed ("), "{study}");
    }
    // Two rows show nothing that their numbers do not.
    folder.copy("examples/course/mount.chain").copy("examples/course/secret.csv");
    let [study, rows] = ["examples/course/study.toml", "examples/course/secret.csv"]
        .map(|file| fs::read_to_string(root().join(file)).expect("an example"));
    folder.write("study.toml", study);
    folder.write("secret.csv", rows.lines().take(3).map(|line| format!("{line}\n")).collect::<String>());
    let run = folder.trueaxis(&["calibrate", "study.toml", "--out", "few"]);
    assert_eq!(run.code, 1, "{run}");
    let page = folder.read("few/report.html");
    assert_eq!(open_pictures(&page), 0);
    assert!(page.contains("2 rows are too few for pictures."), "one sentence");
}

#[test]
fn the_page_answers_to_a_person() {
    let Some(browser) = testkit::tool(testkit::BROWSER) else { return };
    let folder = Folder::new("page-in-a-browser");
    let out = folder.0.to_str().expect("UTF-8");
    let run = trueaxis(&["calibrate", "examples/mobile-lidar/study.toml", "--out", out]);
    assert_eq!(run.code, 0, "{run}");
    let page = folder.read("report.html");
    assert!(page.len() <= MOST_BYTES, "{} bytes", page.len());
    folder.write("acted.html", page.replace("</body>", ACTIONS));
    for width in [1280, 500] {
        let (dom, said) = rendered(&browser, &folder, "acted.html", width);
        let console: Vec<&str> = said.lines().filter(|line| line.contains("CONSOLE")).collect();
        assert!(console.is_empty(), "{width}: {console:?}");
        let (_, answers) =
            dom.split_once("id=\"said\">").unwrap_or_else(|| panic!("{width}: nothing said: {said}"));
        let answers = answers.split('<').next().unwrap_or_default();
        for name in [
            "wide", "hover", "brushed", "told", "zoomed", "whole", "toggle", "enlarged", "cleared", "names",
            "ids",
        ] {
            assert!(answers.contains(&format!("{name}=true")), "{width}: {answers}");
        }
    }
}
