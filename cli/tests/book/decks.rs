//! Decks of the course: sources in `docs/decks`, a page each in the book, one idea a slide with notes for the speaker.
//!
//! A source is Markdown in small: slides apart by `---`, the first line of each `# its title`; paragraphs, lists with `- `, code
//! between fences, pictures, `> ` for what is set large, and `Notes: ` for what the speaker says. Tags of HTML stay as they are.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use super::interactive::browse_file;
use super::support::{Folder, root};

/// Words of a slide at most, code and formulas aside: one idea.
const MOST_WORDS: usize = 45;
/// Words of notes at least: what is said is more than what is shown.
const LEAST_NOTES: usize = 12;

const STYLE: &str = "\
html { color-scheme: light dark; scroll-snap-type: y mandatory; }
body { margin: 0; font: clamp(24px, 2.8vw, 48px)/1.4 system-ui, sans-serif; }
section { min-height: 100vh; box-sizing: border-box; padding: 6vh 6vw; scroll-snap-align: start; position: relative; break-after: page; }
section { display: flex; flex-direction: column; }
h1 { font-size: 1.4em; margin: 0 0 .5em; }
p, ul, pre { margin: 0 0 .6em; }
blockquote { margin: 0 0 .5em; font-size: 1.2em; }
section:not(:has(img)) blockquote { font-size: 1.5em; }
img { flex: 1 1 0; min-height: 30vh; width: 100%; box-sizing: border-box; padding: 1vh 1vw; object-fit: contain; background: #fff; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; }
aside { display: none; border-top: 2px solid; margin-top: 1em; padding-top: .4em; }
.notes aside { display: block; }
.number { position: absolute; right: 4vw; bottom: 2vh; margin: 0; }
@page { size: 297mm 167mm; margin: 0; }
@media print { html { color-scheme: light; } body { font-size: 21pt; } section { min-height: 0; height: 166mm; padding: 9mm 16mm; } img { min-height: 0; } aside { display: none !important; } }
";

const SCRIPT: &str = "\
addEventListener('keydown', (event) => {
  if (event.key === 'n') document.body.classList.toggle('notes');
  const step = { ArrowRight: 1, ArrowDown: 1, PageDown: 1, ' ': 1, ArrowLeft: -1, ArrowUp: -1, PageUp: -1 }[event.key];
  if (!step) return;
  event.preventDefault();
  const slides = [...document.querySelectorAll('section')];
  const now = slides.findIndex((slide) => slide.getBoundingClientRect().bottom > innerHeight / 2);
  slides[Math.min(Math.max(now + step, 0), slides.length - 1)].scrollIntoView();
});
";

/// Points of the smallest letter, pixels of a screen of 1280 by 720.
const SMALLEST_PX: f64 = 24.0;
/// Width of a slide's contents there.
const WIDTH_PX: f64 = 1280.0 * 0.86;

/// Width and height of a picture and its smallest letters, in its own unit.
fn measures(picture: &str) -> [f64; 3] {
    let file = root().join("docs/src/teaching/decks").join(picture);
    let svg = fs::read_to_string(&file).unwrap_or_else(|error| panic!("{picture}: {error}"));
    let number = |text: &str| text.parse::<f64>().unwrap_or_else(|_| panic!("{picture}: {text}"));
    let value = |rest: &str| rest.split('"').next().expect("a value").to_owned();
    let view = value(svg.split("viewBox=\"0 0 ").nth(1).expect("a view box"));
    let (width, height) = view.split_once(' ').expect("width and height");
    let letters = svg.split("font-size=\"").skip(1).map(|rest| number(&value(rest)));
    [number(width), number(height), letters.fold(f64::INFINITY, f64::min)]
}

/// One slide.
struct Slide {
    title: String,
    /// As HTML.
    body: String,
    /// Words that are read on it.
    words: usize,
    notes: String,
}

/// The sources of decks, by name, in order.
pub fn sources() -> Vec<(String, String)> {
    let folder = root().join("docs/decks");
    let mut files: Vec<PathBuf> =
        fs::read_dir(folder).expect("the decks").map(|entry| entry.expect("readable").path()).collect();
    files.sort();
    let named = |file: PathBuf| {
        let name = file.file_stem().expect("a name").to_string_lossy().into_owned();
        (name, fs::read_to_string(file).expect("a deck"))
    };
    files.into_iter().map(named).collect()
}

/// Marks within a line: code, bold, and the few letters that HTML takes for its own.
fn inline(text: &str) -> String {
    let mut out = String::new();
    for (at, piece) in text.split('`').enumerate() {
        if at % 2 == 1 {
            let _ = write!(out, "<code>{}</code>", escaped(piece));
            continue;
        }
        for (at, piece) in piece.split("**").enumerate() {
            let (open, close) = if at % 2 == 1 { ("<strong>", "</strong>") } else { ("", "") };
            let _ = write!(out, "{open}{}{close}", piece.replace(" & ", " &amp; ").replace(" < ", " &lt; "));
        }
    }
    out
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn slide(source: &str) -> Slide {
    let mut slide = Slide { title: String::new(), body: String::new(), words: 0, notes: String::new() };
    let mut lines = source.trim().lines();
    let title = lines.next().and_then(|line| line.strip_prefix("# ")).expect("a slide begins with its title");
    slide.title = inline(title);
    slide.words = title.split_whitespace().count();
    let mut code: Option<String> = None;
    let mut in_list = false;
    for line in lines {
        if line.starts_with("```") {
            match code.take() {
                None => code = Some(String::new()),
                Some(text) => {
                    let _ = writeln!(slide.body, "<pre><code>{}</code></pre>", escaped(&text));
                }
            }
            continue;
        }
        if let Some(text) = &mut code {
            let _ = writeln!(text, "{line}");
            continue;
        }
        let item = line.strip_prefix("- ");
        if item.is_some() != in_list {
            slide.body.push_str(if in_list { "</ul>\n" } else { "<ul>\n" });
            in_list = item.is_some();
        }
        if let Some(notes) = line.strip_prefix("Notes: ") {
            slide.notes = inline(notes);
            continue;
        }
        let picture = line
            .strip_prefix("![")
            .and_then(|rest| rest.strip_suffix(')'))
            .and_then(|rest| rest.split_once("]("));
        let html = match (item, line.strip_prefix("> "), picture) {
            (_, _, Some((alt, file))) => {
                let [width, height, letters] = measures(file);
                assert!(
                    letters * WIDTH_PX / width >= SMALLEST_PX,
                    "{title}: the letters of {file} are small"
                );
                format!(
                    "<img src=\"{file}\" alt=\"{}\" data-measures=\"{width} {height} {letters}\">",
                    escaped(alt)
                )
            }
            (Some(text), ..) => format!("<li>{}</li>", inline(text)),
            (_, Some(text), _) => format!("<blockquote>{}</blockquote>", inline(text)),
            _ if line.trim().is_empty() => continue,
            _ => format!("<p>{}</p>", inline(line)),
        };
        if picture.is_none() {
            slide.words += line.split_whitespace().count();
        }
        let _ = writeln!(slide.body, "{html}");
    }
    if in_list {
        slide.body.push_str("</ul>\n");
    }
    slide
}

fn slides(source: &str) -> Vec<Slide> {
    source.split("\n---\n").map(slide).collect()
}

fn rendered(slides: &[Slide]) -> String {
    let mut page = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width, \
         initial-scale=1\">\n<title>{}</title>\n<style>\n{STYLE}</style></head><body>\n",
        slides[0].title
    );
    for (number, slide) in (1..).zip(slides) {
        let _ = writeln!(
            page,
            "<section aria-label=\"Slide {number}\"><h1>{}</h1>\n{}<aside>{}</aside><p class=\"number\">{number} / {}</p></section>",
            slide.title,
            slide.body,
            slide.notes,
            slides.len()
        );
    }
    page + "<script>\n" + SCRIPT + "</script></body></html>\n"
}

#[test]
fn the_pages_of_the_decks_are_what_their_sources_say() {
    let mut stale = Vec::new();
    for (name, source) in sources() {
        let slides = slides(&source);
        assert!(slides.len() >= 10, "{name}: {} slides", slides.len());
        for slide in &slides {
            assert!(slide.words <= MOST_WORDS, "{name}, {}: {} words", slide.title, slide.words);
            let notes = slide.notes.split_whitespace().count();
            assert!(notes >= LEAST_NOTES, "{name}, {}: {notes} words of notes", slide.title);
        }
        let page = rendered(&slides);
        let folder = root().join("docs/src/teaching/decks");
        assert!(page.contains("<img "), "{name}: no figure");
        let file = folder.join(format!("{name}.html"));
        if fs::read_to_string(&file).ok().as_deref() != Some(&page) {
            if std::env::var_os("UPDATE_BOOK").is_some() {
                fs::create_dir_all(&folder).expect("a folder");
                fs::write(&file, &page).expect("the deck's page");
            } else {
                stale.push(name);
            }
        }
    }
    assert!(stale.is_empty(), "render them anew with UPDATE_BOOK=1: {stale:?}");
}

/// Says in the page which slides are higher than the screen, have something wider than the slide, or text below 18 pt, in a picture
/// or beside it.
const MEASURE: &str = "<script>{
  const isWide = (node) => node.clientWidth && node.scrollWidth > node.clientWidth + 1;
  const isSmall = (node) => node.getClientRects().length && parseFloat(getComputedStyle(node).fontSize) < 24;
  const isFaint = (img) => {
    const [width, height, letters] = img.dataset.measures.split(' ').map(Number), padding = parseFloat(getComputedStyle(img).paddingLeft);
    return letters * Math.min((img.clientWidth - 2 * padding) / width, (img.clientHeight - 2 * padding) / height) < 24;
  };
  const cut = (slide) => slide.offsetHeight > 721 || [...slide.querySelectorAll('pre, table, p, li')].some(isWide) ||
    [...slide.querySelectorAll('h1, p, li, pre, code, td, th, blockquote')].some(isSmall) ||
    [...slide.querySelectorAll('img')].some(isFaint);
  document.body.dataset.cut = [...document.querySelectorAll('section')].filter(cut).map((slide) => slide.innerText.split('\\n')[0]).join('; ');
}</script>";

#[test]
fn a_browser_cuts_nothing_of_a_slide() {
    let decks = root().join("docs/src/teaching/decks");
    for (name, _) in sources() {
        let folder = Folder::new(&format!("book-deck-{name}"));
        let page = fs::read_to_string(decks.join(format!("{name}.html"))).expect("the deck's page");
        let base = format!("<head><base href=\"file://{}/\">", decks.display());
        folder.write(
            "deck.html",
            // What a browser without a window shows is lower than the window that it is asked for.
            page.replace("100vh", "720px").replacen("<head>", &base, 1).replacen(
                "</body>",
                &format!("{MEASURE}</body>"),
                1,
            ),
        );
        let Some((shown, console)) = browse_file(&folder.0, "deck.html") else { return };
        assert_eq!(console, "");
        assert!(shown.contains("data-cut=\"\""), "{name}: cut or small: {shown}");
    }
}
