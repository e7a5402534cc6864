//! A lesson that has a deck has everything: goals, a plan of 90 minutes, exercises in three levels with hints, solutions elsewhere, a quiz
//! with explained answers, a notebook; each exercise is solved by a command or a computed number, and numbers in its solutions are computed.
//!
//! `<!-- number: 3 / 50 * 648000 / pi = 12.4 -->` in a page of solutions says how the number came about: the test computes it, to the
//! digits shown, and looks for it in the line below.

use std::fs;

use super::decks;
use super::support::root;

fn read(file: &str) -> String {
    fs::read_to_string(root().join(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// The part of a page below a heading, up to the next of the same rank.
fn part<'a>(page: &'a str, heading: &str) -> &'a str {
    let rank = heading.split(' ').next().expect("a heading has a rank");
    let from = page.find(&format!("\n{heading}\n")).unwrap_or_else(|| panic!("no {heading}:\n{page}"))
        + heading.len()
        + 2;
    let rest = &page[from..];
    let next = format!("\n{rank} ");
    &rest[..rest.find(&next).unwrap_or(rest.len())]
}

/// Items of a numbered list.
fn numbered(text: &str) -> usize {
    text.lines()
        .filter(|line| line.split_once(". ").is_some_and(|(number, _)| number.parse::<u32>().is_ok()))
        .count()
}

#[test]
fn a_lesson_with_a_deck_has_everything() {
    for (name, _) in decks::sources() {
        let lesson = read(&format!("docs/src/course/{name}.md"));
        assert!(part(&lesson, "## Goals").matches("\n- ").count() >= 3, "{name}: goals");
        let exercises = part(&lesson, "## Exercises");
        for level in ["### Easy", "### Middle", "### Hard"] {
            assert!(numbered(part(exercises, level)) >= 1, "{name}: {level}");
        }
        assert!(exercises.matches("<summary>Hint").count() >= 3, "{name}: hints");
        assert!(!lesson.contains("<summary>Answers"), "{name}: solutions stand in the lesson");
        assert_eq!(numbered(part(&lesson, "## Quiz")), 5, "{name}: the quiz");
        let solutions = read(&format!("docs/src/course/solutions/{name}.md"));
        assert_eq!(numbered(part(&solutions, "## Exercises")), numbered(exercises), "{name}: solutions");
        assert_eq!(numbered(part(&solutions, "## Quiz")), 5, "{name}: answers of the quiz");
        solved(&name, part(&solutions, "## Exercises"));
        assert!(lesson.contains(&format!("(notebooks/{name}.ipynb)")), "{name}: the notebook");
        let plan = read(&format!("docs/src/teaching/{name}.md"));
        let rows = part(&plan, "## 90 minutes").lines().filter_map(|line| {
            let mut cells = line.strip_prefix("| ")?.split(" | ");
            Some((cells.next()?.parse::<u32>().ok()?, cells.next()?.parse::<u32>().ok()?))
        });
        let mut now = 0;
        for (from, minutes) in rows {
            assert_eq!(from, now, "{name}: the plan");
            now += minutes;
        }
        assert_eq!(now, 90, "{name}: the plan");
        assert!(plan.contains(&format!("(decks/{name}.html)")), "{name}: the deck");
    }
}

/// Each solution has a command that the book's test runs, or a number that is computed; or a command above all of them solves several.
fn solved(name: &str, solutions: &str) {
    let is_solved = |text: &str| text.contains("\n```sh\n") || text.contains("<!-- number: ");
    let mut items: Vec<String> = vec![String::new()];
    let mut is_code = false;
    for line in solutions.lines() {
        is_code ^= line.starts_with("```");
        if !is_code && numbered(line) == 1 {
            items.push(String::new());
        }
        let item = items.last_mut().expect("one at least");
        item.push_str(line);
        item.push('\n');
    }
    let shared = items.iter().find(|item| item.contains("in one declaration") || item.contains("at once"));
    let open: Vec<&String> = items[1..].iter().filter(|item| !is_solved(item)).collect();
    assert!(open.is_empty() || shared.is_some_and(|shared| is_solved(shared)), "{name}: {open:?}");
}

/// The cells are run by the Python package's tests; here they are kept free of what a run leaves behind.
#[test]
fn notebooks_are_stored_without_results() {
    for (name, _) in decks::sources() {
        let text = read(&format!("docs/src/course/notebooks/{name}.ipynb"));
        let notebook: serde_json::Value =
            serde_json::from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let cells = notebook["cells"].as_array().expect("cells");
        assert!(cells.len() >= 8, "{name}: {} cells", cells.len());
        for cell in cells.iter().filter(|cell| cell["cell_type"] == "code") {
            assert_eq!(cell["outputs"].as_array().map(Vec::len), Some(0), "{name}: {}", cell["id"]);
            assert!(cell["execution_count"].is_null(), "{name}: {}", cell["id"]);
        }
        assert!(text.contains("**Predict.**") && text.contains("**Your turn.**"), "{name}");
    }
}

#[test]
fn numbers_of_solutions_are_computed() {
    let mut computed = 0;
    let solutions = decks::sources().into_iter().map(|(name, _)| format!("solutions/{name}"));
    for name in solutions.chain(["phone-lab".to_owned()]) {
        let page = read(&format!("docs/src/course/{name}.md"));
        let lines: Vec<&str> = page.lines().collect();
        for (at, line) in lines.iter().enumerate() {
            let Some((_, rest)) = line.split_once("<!-- number: ") else { continue };
            let note = rest.strip_suffix(" -->").expect("the end of the note");
            let (formula, shown) = note.rsplit_once(" = ").expect("a formula and a number");
            let value = Formula { text: formula.as_bytes(), at: 0 }.value();
            let digits = shown.split('.').nth(1).map_or(0, str::len);
            assert_eq!(format!("{value:.digits$}"), shown, "{name}: {formula}");
            let below = lines[at + 1..]
                .iter()
                .take(4)
                .any(|line| line.replace('−', "-").replace(' ', "").contains(shown));
            assert!(below, "{name}: {shown} is not shown below its formula");
            computed += 1;
        }
    }
    assert!(computed > 0);
}

/// A formula of numbers, `pi`, + - * / ^, parentheses and a few functions; angles of sines are in degrees.
struct Formula<'t> {
    text: &'t [u8],
    at: usize,
}

impl Formula<'_> {
    fn value(&mut self) -> f64 {
        let value = self.sum();
        assert_eq!(self.peek(), None, "{}", String::from_utf8_lossy(self.text));
        value
    }

    fn peek(&mut self) -> Option<u8> {
        while self.text.get(self.at) == Some(&b' ') {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }

    fn takes(&mut self, byte: u8) -> bool {
        let is = self.peek() == Some(byte);
        self.at += usize::from(is);
        is
    }

    fn sum(&mut self) -> f64 {
        let mut value = self.product();
        loop {
            if self.takes(b'+') {
                value += self.product();
            } else if self.takes(b'-') {
                value -= self.product();
            } else {
                return value;
            }
        }
    }

    fn product(&mut self) -> f64 {
        let mut value = self.power();
        loop {
            if self.takes(b'*') {
                value *= self.power();
            } else if self.takes(b'/') {
                value /= self.power();
            } else {
                return value;
            }
        }
    }

    fn power(&mut self) -> f64 {
        if self.takes(b'-') {
            return -self.power();
        }
        let base = self.atom();
        if self.takes(b'^') { base.powf(self.power()) } else { base }
    }

    fn atom(&mut self) -> f64 {
        if self.takes(b'(') {
            let value = self.sum();
            assert!(self.takes(b')'), "{}", String::from_utf8_lossy(self.text));
            return value;
        }
        self.peek();
        let start = self.at;
        while self.text.get(self.at).is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'.') {
            self.at += 1;
        }
        let word = String::from_utf8_lossy(&self.text[start..self.at]).into_owned();
        match word.as_str() {
            "pi" => std::f64::consts::PI,
            "sqrt" => self.atom().sqrt(),
            "sin" => self.atom().to_radians().sin(),
            "cos" => self.atom().to_radians().cos(),
            "tan" => self.atom().to_radians().tan(),
            "atan" => self.atom().atan().to_degrees(),
            number => number.parse().unwrap_or_else(|_| panic!("`{number}` is no number")),
        }
    }
}
