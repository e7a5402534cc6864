//! The words of the course: a term stands in bold, with its meaning or an example, where it first stands, and sentences are short.

use std::fs;

use super::decks;
use super::grade::grade;
use super::plain::LONGEST;
use super::support::root;

/// The years of school that a page may ask for, by Flesch and Kincaid.
pub const GRADE: f64 = 9.0;

/// Terms in the order of the lessons that define them. Goals say what comes, and count for no place.
const TERMS: [(usize, &[&str]); 11] = [
    (1, &["chain", "bodies", "declaration", "observable", "error", "noise"]),
    (2, &["remainder"]),
    (3, &["joints", "pose", "encoder", "Jacobian", "lever arm", "calibration", "two faces"]),
    (4, &["azimuth", "elevation", "non-perpendicularity", "collimation"]),
    (5, &["lidar", "perpendicularity", "intersection", "combination"]),
    (6, &["root mean square", "root sum square"]),
    (7, &["null space", "effect", "candidate", "eccentric"]),
    (
        9,
        &[
            "residual",
            "normal equations",
            "standard deviation",
            "covariance",
            "standard uncertainty",
            "degrees of freedom",
            "outliers",
            "RMS",
        ],
    ),
    (10, &["Backlash", "Refraction", "flexure"]),
    (11, &["Set-ups"]),
    (12, &["fold", "held-out data", "false alarm", "certificate"]),
];

/// What a page says: no code, headings, tables, pictures, displayed formulas, sources, addresses and goals; spans of code and formulas are one word.
pub fn prose(page: &str) -> String {
    let (mut said, mut is_code, mut is_formula, mut is_goals) = (String::new(), false, false, false);
    for line in page.lines() {
        let start = line.trim_start();
        let is_heading = start.starts_with('#');
        if is_heading {
            is_goals = start == "## Goals";
        }
        let fences = start.starts_with("```");
        is_code ^= fences;
        let is_display = is_formula || start.starts_with("$$");
        is_formula ^= line.matches("$$").count() % 2 == 1;
        let is_other = ["|", "<", "![", "Source"].iter().any(|sign| start.starts_with(sign));
        if !(is_code || fences || is_display || is_goals || is_heading || is_other) {
            said.push_str(line);
        }
        said.push('\n');
    }
    for (from, to) in [("`", "`"), ("$", "$"), ("](", ")")] {
        said = without(&said, from, to);
    }
    said
}

/// A text with an `x` for what stands between two signs.
fn without(text: &str, from: &str, to: &str) -> String {
    let (mut kept, mut rest) = (String::new(), text);
    while let Some((before, behind)) = rest.split_once(from) {
        let Some((_, after)) = behind.split_once(to) else { break };
        kept.push_str(before);
        kept.push_str(if from == "](" { " " } else { "x" });
        rest = after;
    }
    kept + rest
}

/// Sentences as lists of words of two letters at least, without numbers.
pub fn sentences(prose: &str) -> Vec<Vec<String>> {
    let mut found = vec![Vec::new()];
    for line in prose.lines() {
        let start = line.trim_start();
        if start.is_empty()
            || start.starts_with(['-', '>'])
            || start.starts_with(|c: char| c.is_ascii_digit())
        {
            found.push(Vec::new());
        }
        for word in line.split_whitespace() {
            let letters: String = word.chars().filter(|c| c.is_alphabetic()).collect();
            if !word.contains(|c: char| c.is_ascii_digit() || "_/=+".contains(c))
                && letters.chars().count() > 1
            {
                found.last_mut().expect("one at least").push(letters.to_lowercase());
            }
            if word.trim_end_matches([')', '*', '"']).ends_with(['.', '?', '!', ':']) {
                found.push(Vec::new());
            }
        }
    }
    found.retain(|sentence| !sentence.is_empty());
    found
}

/// The pages of the course, the lessons first.
fn pages() -> Vec<(String, String)> {
    let lessons = decks::sources().into_iter().map(|(name, _)| name);
    let lessons: Vec<String> = lessons.collect();
    let solutions = lessons.iter().map(|name| format!("solutions/{name}"));
    let others = ["phone-lab", "secret"].map(str::to_owned);
    let all = lessons.iter().cloned().chain(solutions).chain(others);
    all.map(|name| {
        let path = root().join(format!("docs/src/course/{name}.md"));
        let page = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
        (name, prose(&page))
    })
    .collect()
}

/// What the notebooks say between their cells of code, in the order of the lessons.
fn notebooks() -> Vec<(String, String)> {
    let lessons = decks::sources().into_iter();
    lessons
        .map(|(name, _)| {
            let path = root().join(format!("docs/src/course/notebooks/{name}.ipynb"));
            let text = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{name}: {error}"));
            let notebook: serde_json::Value =
                serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
            let cells = notebook["cells"].as_array().expect("cells").iter();
            let words = cells.filter(|cell| cell["cell_type"] == "markdown").map(|cell| {
                let lines = cell["source"].as_array().expect("lines").iter();
                lines.map(|line| line.as_str().expect("a line")).collect::<String>()
            });
            (format!("notebook {name}"), prose(&words.collect::<Vec<_>>().join("\n\n")))
        })
        .collect()
}

/// What the decks show and their speakers say, in the order of the lessons.
fn told() -> Vec<(String, String)> {
    let said = |(name, source): (String, String)| {
        (format!("deck {name}"), prose(&source.replace("Notes: ", "\n").replace("\n---\n", "\n\n")))
    };
    decks::sources().into_iter().map(said).collect()
}

#[test]
fn the_course_is_read_by_a_pupil_of_fifteen() {
    for (name, prose) in pages().into_iter().chain(notebooks()).chain(told()) {
        let sentences = sentences(&prose);
        let grade = grade(&sentences);
        assert!(grade <= GRADE, "{name}: grade {grade:.1}");
        let longest = sentences.iter().max_by_key(|sentence| sentence.len()).expect("a page says something");
        assert!(longest.len() <= LONGEST, "{name}: {} words: {}", longest.len(), longest.join(" "));
    }
}

/// Where a term stands as a word of its own.
fn first_place(prose: &str, term: &str) -> Option<usize> {
    let text = prose.to_lowercase().replace('\n', " ");
    let term = term.to_lowercase();
    let is_letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '-' || c == '_');
    let mut places = text.match_indices(&term).map(|(at, _)| at);
    places.find(|&at| {
        !is_letter(text[..at].chars().next_back()) && !is_letter(text[at + term.len()..].chars().next())
    })
}

#[test]
fn a_term_is_defined_where_it_first_stands() {
    let lessons: Vec<(String, String)> = pages().into_iter().take(12).collect();
    let [notebooks, told] = [notebooks(), told()];
    let mut wrong = Vec::new();
    for (lesson, terms) in TERMS {
        for term in terms {
            let own = &lessons[lesson - 1].1;
            let bold = own.replace('\n', " ").to_lowercase().find(&format!("**{}**", term.to_lowercase()));
            let Some(bold) = bold else {
                wrong.push(format!("lesson {lesson} does not define {term}"));
                continue;
            };
            if first_place(own, term).is_some_and(|at| at < bold) {
                wrong.push(format!("lesson {lesson}: {term} stands before it is defined"));
            }
            for (name, before) in [&lessons, &notebooks, &told].into_iter().flat_map(|all| &all[..lesson - 1])
            {
                if first_place(before, term).is_some() {
                    wrong.push(format!("{name}: {term} stands there, and is defined in lesson {lesson}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
