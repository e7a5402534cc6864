//! `trueaxis class grade`: a table of points, and half a page of feedback for each student.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};

use class::{AMENDED, ANSWER, Handed, Key, KeyError, Marked, csv, feedback, full, grade, table};
use serde_json::json;

use crate::commands::Answer;
use crate::failure::Failure;
use crate::output::Folder;
use crate::source;
use crate::terminal;

/// The longest file of a student that is read, bytes: many times what an answer needs.
const LONGEST: u64 = 1 << 20;

/// Grade what students hand in.
///
/// Reads `answer.toml` and `amended.chain` in each student's folder. An answer that is missing, cannot be read or belongs to another
/// sheet gets 0 points and the reason, and the others are graded. The rubric stands in the book, "A class".
///
/// With --out, writes marks.csv and a page of feedback for each student. The pages contain the solutions.
///
/// Example: trueaxis class grade class --key class.key.toml --out marks
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder with the students' folders
    answers: PathBuf,
    /// The key that `class new` wrote
    #[arg(long, value_name = "KEY.toml")]
    key: PathBuf,
    /// How to print the table
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Where to write marks.csv and the feedback
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// How a table of points is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    /// For reading
    Text,
    /// For a spreadsheet
    Csv,
    /// For programs, with every reason
    Json,
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let source = source::read(&arguments.key)?;
    let told = |error: KeyError| Failure::Input(format!("`{}`: {error}", arguments.key.display()));
    let key = Key::of(&source.text).map_err(told)?;
    if !arguments.answers.is_dir() {
        let why = format!(
            "`{}` is no folder; name the one that has the students' folders",
            arguments.answers.display()
        );
        return Err(Failure::Input(why));
    }
    warn_of_others(&arguments.answers, &key);
    let progress = terminal::progress();
    let mut marked = Vec::new();
    for student in &key.students {
        progress.say(&format!("grading {}", student.folder));
        let folder = arguments.answers.join(&student.folder);
        let handed = Handed { answer: handed_in(&folder, ANSWER), declaration: handed_in(&folder, AMENDED) };
        marked.push(grade(&key, student, &handed).map_err(told)?);
    }
    progress.finish_and_clear();
    if let Some(out) = &arguments.out {
        write(out, &marked)?;
    }
    match arguments.format {
        Format::Text => terminal::print(table(&marked))?,
        Format::Csv => terminal::print(csv(&marked))?,
        Format::Json => terminal::print_json(&json!({ "full": full(), "students": marked }))?,
    }
    Ok(Answer::Done)
}

/// A file of a student, or why it cannot be read. Only a file that lies there itself: a link could lead to somebody else's.
fn handed_in(folder: &Path, name: &str) -> Result<String, String> {
    let path = folder.join(name);
    for place in [folder, &path] {
        match fs::symlink_metadata(place) {
            Err(_) => return Err(format!("there is no `{name}`")),
            Ok(own) if own.is_symlink() => {
                return Err(format!("`{name}` is reached by a link, and links are not followed"));
            }
            Ok(_) => {}
        }
    }
    if !path.is_file() {
        return Err(format!("`{name}` is no file"));
    }
    let mut text = String::new();
    match File::open(&path).and_then(|file| file.take(LONGEST + 1).read_to_string(&mut text)) {
        Ok(length) if length as u64 > LONGEST => Err(format!("`{name}` is longer than 1 MiB")),
        Ok(_) => Ok(text),
        Err(_) => Err(format!("`{name}` is no readable UTF-8 text")),
    }
}

/// Folders that no student of the key has: a renamed one would else be missed without a word.
fn warn_of_others(answers: &Path, key: &Key) {
    let Ok(entries) = fs::read_dir(answers) else { return };
    let mut others: Vec<String> = entries
        .filter_map(Result::ok)
        .filter(|entry| entry.path().is_dir())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| key.students.iter().all(|student| student.folder != *name))
        .collect();
    others.sort();
    for name in others {
        terminal::warn(format_args!("the folder {name:?} belongs to no student of the key; it was left out"));
    }
}

fn write(out: &Path, marked: &[Marked]) -> Result<(), Failure> {
    let mut folder = Folder::new(out)?;
    folder.write_text("marks.csv", &csv(marked))?;
    for own in marked {
        folder.write_text(&format!("{}.md", own.folder), &feedback(own))?;
    }
    folder.finish()
}
