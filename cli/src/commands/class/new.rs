//! `trueaxis class new`: a folder for each student, and the teacher's key beside them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use class::{Level, hand_out};
use tables::formats::{self, Cells, Form, Options, Wanted};

use crate::commands::Answer;
use crate::failure::Failure;
use crate::output::{self, Folder};
use crate::source;
use crate::terminal;

/// Shorter seeds can be found by trying.
const LONG_ENOUGH: usize = 12;

/// Rows of the list that are read at a time.
const AT_ONCE: usize = 1024;

/// Write a data set with a secret for each student.
///
/// Each student gets a folder with a sheet, a declaration, data, a study and an empty answer. The key has the solutions. Keep it, and
/// give it to nobody. The same list, seed and level give the same folders.
///
/// Level 1 has one effect that the declaration lacks and low noise; 2 has two effects; 3 has three, of which one has several possible
/// causes; 4 has one effect, and beside it a misread column or a change between two set-ups.
///
/// Example: trueaxis class new --students names.csv --seed "a long phrase" --level 1 --out class
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The list of students: a table with a column `name`
    #[arg(long, value_name = "NAMES.csv")]
    students: PathBuf,
    /// Seed of the secrets: a number or a phrase. Whoever knows it can draw every secret again, so take a long one
    #[arg(long, value_name = "SEED")]
    seed: String,
    /// How difficult: 1 to 4
    #[arg(long, value_name = "1..4", value_parser = level)]
    level: Level,
    /// The folder for the students' folders: a new one
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// The key; default: DIR.key.toml, beside the folder
    #[arg(long, value_name = "KEY.toml")]
    key: Option<PathBuf>,
}

fn level(text: &str) -> Result<Level, String> {
    let number: u8 = text.parse().map_err(|_| "write a number from 1 to 4".to_owned())?;
    Level::try_from(number).map_err(|error| error.to_string())
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let key = arguments.key.clone().unwrap_or_else(|| beside(&arguments.out));
    require_new(&arguments.out, &key)?;
    let names = names(&arguments.students)?;
    if arguments.seed.chars().count() < LONG_ENOUGH {
        terminal::warn(format_args!(
            "the seed has fewer than {LONG_ENOUGH} letters. A student who has this program can find it by trying. Take a phrase"
        ));
    }
    warn_of_twins(&names);
    let (folders, sealed) = hand_out(&names, &arguments.seed, arguments.level)
        .map_err(|error| Failure::Input(format!("`{}`: {error}", arguments.students.display())))?;
    for own in &folders {
        let mut folder = Folder::new(&arguments.out.join(&own.name))?;
        for (name, text) in &own.files {
            folder.write_text(name, text)?;
        }
        folder.finish()?;
    }
    output::write_text(&key, &sealed)?;
    terminal::note(format_args!(
        "Wrote {} folders into `{}`. The key is `{}`. Keep it, and give it to nobody.",
        folders.len(),
        arguments.out.display(),
        key.display()
    ));
    Ok(Answer::Done)
}

/// Two of one name get two folders, and the folders do not show whose is which.
fn warn_of_twins(names: &[String]) {
    let mut rows: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (number, name) in (1..).zip(names) {
        rows.entry(name.trim()).or_default().push(format!("{number:03}"));
    }
    for (name, own) in rows.into_iter().filter(|(_, own)| own.len() > 1) {
        terminal::warn(format_args!(
            "the list has {name:?} {} times. Their folders begin with {}. Tell each of them which is theirs",
            own.len(),
            own.join(", ")
        ));
    }
}

/// The key's place unless somebody says another: beside the folder, so that the folder can be handed out whole.
fn beside(out: &Path) -> PathBuf {
    let mut name = out.file_name().unwrap_or("class".as_ref()).to_owned();
    name.push(".key.toml");
    out.with_file_name(name)
}

/// Folders of another class would lie between these, and a key that is gone cannot grade any more.
fn require_new(out: &Path, key: &Path) -> Result<(), Failure> {
    let is_filled = |folder: &Path| fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some());
    let why = if is_filled(out) {
        format!("`{}` is not empty; name a new folder", out.display())
    } else if key.exists() {
        format!("`{}` is there already; name another key by --key", key.display())
    } else if key.starts_with(out) {
        format!("`{}` would lie among the folders of the students; name a key elsewhere", key.display())
    } else {
        return Ok(());
    };
    Err(Failure::Input(why))
}

/// The names of the list, in its order.
fn names(path: &Path) -> Result<Vec<String>, Failure> {
    let list = source::read(path)?;
    let name = path.display().to_string();
    let told = |error: formats::DataError| Failure::Input(error.to_string());
    let mut reader = formats::open(list.text.as_bytes(), &name, &Options::default()).map_err(told)?;
    let found = reader.header().iter().position(|column| column.full.trim().eq_ignore_ascii_case("name"));
    let column = found.ok_or_else(|| {
        Failure::Input(format!(
            "`{name}` has no column `name`: write `name` into the first line, and a student into each line below"
        ))
    })?;
    let wanted = [Wanted { column, form: Form::Label }];
    let mut names = Vec::new();
    loop {
        let chunk = reader.read(&wanted, AT_ONCE).map_err(told)?;
        if chunk.rows.is_empty() {
            return Ok(names);
        }
        for cells in chunk.columns {
            if let Cells::Labels(labels) = cells {
                names.extend(labels);
            }
        }
    }
}
