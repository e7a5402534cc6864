//! Classes as a teacher and hostile students would make them.
#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

mod answers;

use std::collections::BTreeSet;

use crate::cause::Cause;
use crate::grade::{Grade, Handed, Marked, grade};
use crate::instruments::INSTRUMENTS;
use crate::key::{Folder, Key, KeyError, NewError, Student, hand_out};
use crate::level::Level;
use crate::misread::Reading;
use crate::model::Model;
use crate::policy::ARCSEC_RAD;
use crate::report::{csv, feedback, table};
use crate::rubric::{Item, full};
use crate::seed::digest;
use crate::sentence;
use crate::task::{Task, declaration};

const SEED: &str = "the long phrase of a test";
const NAMES: [&str; 6] = ["Ada", "Bo", "Cy", "Di", "Eve", "Flo"];

fn level(number: u8) -> Level {
    Level::try_from(number).unwrap()
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

fn class(names: &[&str], number: u8) -> (Vec<Folder>, Key, String) {
    let (folders, sealed) = hand_out(&owned(names), SEED, level(number)).unwrap();
    let key = Key::of(&sealed).unwrap();
    (folders, key, sealed)
}

fn words(causes: &[Cause]) -> String {
    causes.iter().map(|own| own.word()).collect::<Vec<_>>().join(" or ")
}

/// The answer of somebody who knows everything.
fn perfect(task: &Task, mark: &str) -> String {
    let causes: Vec<String> =
        task.effects.iter().map(|effect| format!("\"{}\"", words(&effect.possible))).collect();
    let mut text = format!(
        "mark = \"{mark}\"\ncauses = [{}]\nreading = \"{}\"\nsentence = {}\n",
        causes.join(", "),
        task.reading.word(),
        sentence::right(task)
    );
    for (name, asked) in ["size", "error", "prediction"].into_iter().zip(task.numbers) {
        let (value, uncertainty) = (asked.truth_arcsec, asked.uncertainty_arcsec);
        text += &format!("{name} = {{ value = {value}, uncertainty = {uncertainty} }}\n");
    }
    text
}

/// The declaration that does what the instrument does.
fn true_one(task: &Task) -> String {
    declaration(&task.instrument, task.effects.iter().map(|effect| effect.cause))
}

fn graded(key: &Key, student: &Student, answer: &str, declaration: &str) -> Marked {
    let handed = Handed { answer: Ok(answer.to_owned()), declaration: Ok(declaration.to_owned()) };
    grade(key, student, &handed).unwrap()
}

fn of(marked: &Marked, item: Item) -> &Grade {
    marked.grades.iter().find(|grade| grade.item == item).unwrap()
}

#[test]
fn the_perfect_answer_has_all_points_at_every_level() {
    for number in 1..=4 {
        let (_, key, _) = class(&NAMES, number);
        for student in &key.students {
            let task = key.task(student).unwrap();
            let marked = graded(&key, student, &perfect(&task, &student.mark), &true_one(&task));
            assert_eq!(marked.points, full(), "level {number}: {marked:#?}");
        }
    }
}

#[test]
fn whoever_finds_nothing_gets_few_points() {
    for number in 1..=4 {
        let (_, key, _) = class(&["Ada", "Bo"], number);
        for student in &key.students {
            let task = key.task(student).unwrap();
            let error = task.numbers[1];
            // The one number that may be right without any finding.
            let answer = format!(
                "mark = \"{}\"\ncauses = []\nsentence = 1\nerror = {{ value = {}, uncertainty = {} }}\n\
                 size = {{ value = 0, uncertainty = 1000 }}\nprediction = {{ value = 0, uncertainty = 1000 }}\n",
                student.mark, error.truth_arcsec, error.uncertainty_arcsec
            );
            let marked = graded(&key, student, &answer, task.instrument.declaration);
            assert_eq!(marked.points, 2.0, "level {number}: {marked:#?}");
        }
    }
}

#[test]
fn a_wrong_place_and_cause_cost_a_part() {
    let (_, key, _) = class(&NAMES, 2);
    let mut tried = 0;
    for student in &key.students {
        let task = key.task(student).unwrap();
        let used: Vec<Cause> = task.effects.iter().map(|effect| effect.cause).collect();
        let places =
            |cause: Cause| cause.additions(&task.instrument).into_iter().map(|own| (own.body, own.moves));
        let is_elsewhere = |cause: &Cause| {
            used.iter().all(|&own| places(own).all(|one| places(*cause).all(|other| other != one)))
        };
        let Some(wrong) = Cause::ALL.into_iter().find(is_elsewhere) else { continue };
        tried += 1;
        let amended = declaration(&task.instrument, [used[0], wrong]);
        let (last, other) = (format!("\"{}\"]", used[1].word()), format!("\"{}\"]", wrong.word()));
        let answer = perfect(&task, &student.mark).replace(&last, &other);
        let marked = graded(&key, student, &answer, &amended);
        for item in [Item::Place, Item::Cause] {
            let grade = of(&marked, item);
            assert!(grade.points > 0.0 && grade.points < grade.of, "{grade:?}");
        }
        assert!(of(&marked, Item::Unseen).points < 3.0, "{marked:#?}");
        assert!(marked.points < 0.85 * full() && marked.points > 0.3 * full(), "{}", marked.points);
    }
    assert!(tried > 0);
}

/// Behind the motion of one body and before anything of the next is one place.
#[test]
fn a_declaration_that_does_the_same_elsewhere_has_the_place() {
    let names: Vec<String> = (0..12).map(|number| format!("student {number}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (_, key, _) = class(&names, 1);
    let mut tried = 0;
    for student in &key.students {
        let task = key.task(student).unwrap();
        let (instrument, cause) = (task.instrument, task.effects[0].cause);
        if !matches!(cause, Cause::FirstOffCentre | Cause::FirstOval) {
            continue;
        }
        tried += 1;
        let factor = cause.additions(&instrument)[0].factor(&instrument);
        let above = ["Ry(nonperpendicularity)", "Rx(nonperpendicularity)", "Ry(trunnion)"];
        let above = above.into_iter().find(|own| instrument.declaration.contains(own)).unwrap();
        let amended = instrument.declaration.replace(above, &format!("{factor}, {above}"));
        let marked = graded(&key, student, &perfect(&task, &student.mark), &amended);
        assert_eq!(marked.points, full(), "{marked:#?}");
    }
    assert!(tried > 0);
}

#[test]
fn naming_one_of_a_set_and_claiming_certainty_costs_points() {
    let (_, key, _) = class(&["Ada"], 3);
    let student = &key.students[0];
    let task = key.task(student).unwrap();
    let set = task.effects.iter().find(|effect| effect.possible.len() > 1).unwrap();
    let answer = perfect(&task, &student.mark)
        .replace(&words(&set.possible), set.possible[0].word())
        .replace("sentence = 3", "sentence = 2");
    let marked = graded(&key, student, &answer, &true_one(&task));
    assert_eq!(of(&marked, Item::Cause).points, 3.5);
    assert_eq!(of(&marked, Item::Honesty).points, 0.0);
    assert_eq!(marked.points, full() - 3.5);
}

#[test]
fn every_cause_of_the_list_at_once_is_no_answer() {
    let (_, key, _) = class(&["Ada"], 2);
    let student = &key.students[0];
    let task = key.task(student).unwrap();
    let all = words(&Cause::ALL);
    let separate: Vec<String> = Cause::ALL.iter().map(|cause| format!("\"{}\"", cause.word())).collect();
    for (causes, most) in [(format!("\"{all}\", \"{all}\""), 2.0), (separate.join(", "), 1.0)] {
        let answer = format!("mark = \"{}\"\ncauses = [{causes}]\n", student.mark);
        let marked = graded(&key, student, &answer, &true_one(&task));
        assert_eq!(of(&marked, Item::Cause).points, most, "{marked:#?}");
    }
    // Everything added everywhere predicts well, and says nothing of the place.
    let amended = declaration(&task.instrument, Cause::ALL);
    let marked = graded(&key, student, &perfect(&task, &student.mark), &amended);
    assert!(of(&marked, Item::Place).points < 4.0, "{marked:#?}");
}

#[test]
fn a_reading_that_is_wrong_spoils_the_prediction() {
    let names: Vec<String> = (0..12).map(|number| format!("student {number}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let (_, key, _) = class(&names, 4);
    let mut misread = 0;
    for student in &key.students {
        let task = key.task(student).unwrap();
        if task.reading == Reading::AsLabelled {
            continue;
        }
        misread += 1;
        let answer = perfect(&task, &student.mark).replace(task.reading.word(), "as_labelled");
        let marked = graded(&key, student, &answer, &true_one(&task));
        assert_eq!(of(&marked, Item::Unseen).points, 0.0, "{marked:#?}");
        assert_eq!(of(&marked, Item::Place).points, 2.5);
    }
    assert!(misread > 0 && misread < key.students.len());
}

/// A turn of the first axis by a quarter can imitate another reading; the errors that a sheet allows cannot.
#[test]
fn one_reading_alone_needs_no_large_error() {
    let (_, key, _) = class(&NAMES, 4);
    for student in &key.students {
        let task = key.task(student).unwrap();
        let model = Model::of(task.instrument.declaration, &task.instrument).unwrap();
        for reading in Reading::ALL {
            let (poses, measured): (Vec<_>, Vec<_>) = task.rows.iter().map(|row| reading.read(*row)).unzip();
            let nominal = model.pointing(&task.instrument, &poses, &model.chain.nominal_values());
            let off = nominal
                .iter()
                .zip(&measured)
                .map(|(a, b)| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>());
            let rms_arcsec = (off.sum::<f64>() / measured.len() as f64).sqrt() / ARCSEC_RAD;
            assert_eq!(rms_arcsec < 500.0, reading == task.reading, "{reading:?}: {rms_arcsec}");
        }
    }
}

#[test]
fn an_answer_to_another_sheet_is_noticed() {
    let (_, key, _) = class(&["Ada", "Bo"], 1);
    let [ada, bo] = &key.students[..] else { unreachable!("two names, two students") };
    let task = key.task(bo).unwrap();
    let marked = graded(&key, ada, &perfect(&task, &bo.mark), &true_one(&task));
    assert_eq!(marked.points, 0.0);
    assert_eq!(marked.not_graded.unwrap(), "the answer carries the mark of the sheet of Bo (002-bo)");
    let marked = graded(&key, ada, &perfect(&task, "00000-00000"), &true_one(&task));
    assert_eq!(marked.not_graded.unwrap(), "the answer carries the mark of no sheet of this class");
}

#[test]
fn hostile_names_are_harmless() {
    let long = "x".repeat(200);
    let hostile = [
        "../x",
        "..",
        "=cmd()",
        "Zoë 李",
        "李",
        "Ada",
        "Ada",
        "a/b\\c:d*?",
        "<script>",
        "| a `b`\n# c",
        &long,
        "CON",
    ];
    let (folders, key, sealed) = class(&hostile, 1);
    let names: BTreeSet<&str> = folders.iter().map(|folder| folder.name.as_str()).collect();
    assert_eq!(names.len(), hostile.len());
    for folder in &folders {
        let is_plain = |byte: u8| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-';
        assert!(folder.name.bytes().all(is_plain), "{}", folder.name);
        assert!(folder.name.len() <= 41 && folder.name.starts_with(|first: char| first.is_ascii_digit()));
        assert!(!folder.files[0].1.contains("<script>"), "{}", folder.files[0].1);
    }
    assert_eq!(Key::of(&sealed).unwrap().students[2].name, "=cmd()");
    assert_eq!((folders[3].name.as_str(), folders[4].name.as_str()), ("004-zoe", "005"));
    let missing = || Err("there is no `answer.toml`".to_owned());
    let nothing = Handed { answer: missing(), declaration: missing() };
    let marked: Vec<Marked> =
        key.students.iter().map(|student| grade(&key, student, &nothing).unwrap()).collect();
    assert!(marked.iter().all(|own| own.points == 0.0 && own.not_graded.is_some()));
    assert!(csv(&marked).contains("\n'=cmd(),003-cmd,"), "{}", csv(&marked));
    assert_eq!(table(&marked).lines().count(), 1 + hostile.len());
    assert!(!feedback(&marked[8]).contains("<script>"), "{}", feedback(&marked[8]));
    // Two of one name have two secrets.
    assert_ne!(folders[5].files, folders[6].files);
    for empty in ["", " \t "] {
        assert_eq!(hand_out(&owned(&["Ada", empty]), SEED, level(1)).unwrap_err(), NewError::NoName(2));
    }
    assert_eq!(hand_out(&[], SEED, level(1)).unwrap_err(), NewError::NoNames);
    assert_eq!(hand_out(&vec!["x".to_owned(); 1000], SEED, level(1)).unwrap_err(), NewError::TooMany(1000));
}

#[test]
fn a_secret_is_the_students_own_and_not_in_the_folder() {
    let (folders, key, _) = class(&["Ada", "Bo"], 3);
    // The number of the folder is the list's; the data are the name's.
    let (others, ..) = class(&["Zed", "Bo", "Ada"], 3);
    assert_eq!(folders[0].files, others[2].files);
    let (again, ..) = class(&["Ada", "Bo"], 3);
    assert_eq!(folders, again);
    let (other_seed, _) = hand_out(&owned(&["Ada"]), "another long phrase", level(3)).unwrap();
    assert_ne!(folders[0].files[2], other_seed[0].files[2]);
    for (folder, student) in folders.iter().zip(&key.students) {
        let task = key.task(student).unwrap();
        let text: String = folder.files.iter().map(|(_, text)| text.as_str()).collect();
        assert!(text.contains(&student.mark) && !text.contains(SEED));
        let added = task.effects.iter().flat_map(|effect| effect.cause.additions(&task.instrument));
        for (name, _) in added.flat_map(|addition| addition.terms) {
            assert!(!text.contains(name), "{name}: {text}");
        }
    }
}

#[test]
fn a_key_that_was_changed_is_refused() {
    let (_, _, sealed) = class(&["Ada"], 1);
    assert!(Key::of(&sealed.replace('\n', "\r\n")).is_ok());
    assert_eq!(Key::of(&sealed.replace("Ada", "Eva")).unwrap_err(), KeyError::Broken);
    for text in ["", "seal", "seal = \"\"\n", "name\nAda\n", &sealed[5..]] {
        assert!(Key::of(text).is_err(), "{text}");
    }
    let body = sealed.split_once('\n').unwrap().1.replace("seed = \"the", "seed = \"a");
    let key = Key::of(&format!("seal = \"{}\"\n{body}", digest(&body))).unwrap();
    assert_eq!(key.task(&key.students[0]).unwrap_err(), KeyError::OtherVersion);
}

#[test]
fn every_declaration_takes_what_every_cause_adds() {
    for instrument in INSTRUMENTS {
        assert_eq!(Model::of(instrument.declaration, &instrument).unwrap().errors().len(), 6);
        for addition in Cause::ALL.into_iter().flat_map(|cause| cause.additions(&instrument)) {
            assert_eq!(instrument.declaration.matches(addition.behind).count(), 1, "{}", addition.behind);
            let text = instrument.with([(addition.behind, addition.factor(&instrument))]);
            let model = Model::of(&text, &instrument).unwrap();
            let added = addition.terms.iter().map(|(name, _)| model.chain.find_symbol(name).unwrap());
            assert!(added.into_iter().all(|id| model.errors().contains(&id)), "{text}");
        }
    }
}
