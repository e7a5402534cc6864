//! The teacher's key: who got which data set, what its secret is, and a seal that shows whether anybody changed it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::folder::{data, files, folder_name};
use crate::level::Level;
use crate::misread::Reading;
use crate::policy::ARCSEC_RAD;
use crate::seed::{Seed, digest};
use crate::sentence;
use crate::task::{Task, Unsolvable};

/// The form of keys that this version writes and reads.
const FORMAT: u32 = 1;

/// Students of one class, as many as the number of a folder has digits for.
const MOST: usize = 999;

/// What one student got.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Student {
    /// As the list of names has it.
    pub name: String,
    /// How many students of that name stand above.
    again: usize,
    /// The folder.
    pub folder: String,
    /// The mark of the sheet.
    pub mark: String,
    /// The SHA-256 of the data.
    data: String,
    /// The secret, for people.
    pub secret: Vec<String>,
}

/// A key that was read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Key {
    format: u32,
    level: Level,
    seed: String,
    /// In the order of the list of names.
    #[serde(rename = "student")]
    pub students: Vec<Student>,
}

/// Why a key cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum KeyError {
    /// It is no key.
    #[error("this is no key of `trueaxis class new`: {0}")]
    NoKey(String),
    /// Its seal is broken.
    #[error(
        "the key was changed after it was written: its seal does not fit. Take the file that `trueaxis class new` wrote"
    )]
    Broken,
    /// It was written by another version.
    #[error(
        "the key is of another version of trueaxis, whose data sets are others: grade with the version that wrote it"
    )]
    OtherVersion,
}

/// Why a class gets no data sets.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NewError {
    /// No names.
    #[error("the list has no names")]
    NoNames,
    /// A row without a name.
    #[error("row {0} of the list has no name")]
    NoName(usize),
    /// More than a folder's number counts.
    #[error("the list has {0} names, and a class has at most {MOST}")]
    TooMany(usize),
    /// Chance failed.
    #[error(transparent)]
    Unsolvable(#[from] Unsolvable),
}

/// The folder of one student, with its files.
#[derive(Debug, Clone, PartialEq)]
pub struct Folder {
    /// Its name.
    pub name: String,
    /// Its files: name and text.
    pub files: Vec<(&'static str, String)>,
}

/// Draws a data set for each name.
///
/// The folders are for the students, the text is the sealed key. The same names, seed and level give the same.
///
/// # Errors
/// No names, a name that is empty, too many names.
pub fn hand_out(names: &[String], seed: &str, level: Level) -> Result<(Vec<Folder>, String), NewError> {
    if names.is_empty() {
        return Err(NewError::NoNames);
    }
    if names.len() > MOST {
        return Err(NewError::TooMany(names.len()));
    }
    if let Some(row) = names.iter().position(|name| name.trim().is_empty()) {
        return Err(NewError::NoName(row + 1));
    }
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    let (mut folders, mut students) = (Vec::new(), Vec::new());
    for (number, name) in (1..).zip(names) {
        let name = name.trim();
        let again = seen.entry(name).or_default();
        let own = Seed::new(seed, name, *again, level.into());
        let (task, mark, folder) = (Task::draw(&own, level)?, own.mark(), folder_name(number, name));
        folders.push(Folder { name: folder.clone(), files: files(&task, name, &mark) });
        let (data, secret) = (digest(&data(&task)), secret(&task));
        students.push(Student { name: name.to_owned(), again: *again, folder, mark, data, secret });
        *again += 1;
    }
    let key = Key { format: FORMAT, level, seed: seed.to_owned(), students };
    let body =
        toml::to_string(&key).unwrap_or_else(|error| unreachable!("texts and numbers are TOML: {error}"));
    Ok((folders, format!("seal = \"{}\"\n{body}", digest(&body))))
}

impl Key {
    /// Reads a key and looks at its seal.
    ///
    /// # Errors
    /// It is no key, was changed, or is of another version.
    pub fn of(text: &str) -> Result<Self, KeyError> {
        let text = text.replace("\r\n", "\n");
        let no_key = |why: &str| KeyError::NoKey(why.to_owned());
        let (first, body) = text.split_once('\n').ok_or_else(|| no_key("it has one line"))?;
        let seal = first.strip_prefix("seal = \"").and_then(|rest| rest.strip_suffix('"'));
        let seal = seal.ok_or_else(|| no_key("its first line is no `seal = \"…\"`"))?;
        if digest(body) != seal {
            return Err(KeyError::Broken);
        }
        let key: Self = toml::from_str(body).map_err(|error| KeyError::NoKey(error.message().to_owned()))?;
        if key.format == FORMAT { Ok(key) } else { Err(KeyError::OtherVersion) }
    }

    /// The data set of a student, drawn again.
    ///
    /// # Errors
    /// Another version drew it.
    pub fn task(&self, student: &Student) -> Result<Task, KeyError> {
        let seed = Seed::new(&self.seed, &student.name, student.again, self.level.into());
        let task = Task::draw(&seed, self.level).map_err(|_| KeyError::OtherVersion)?;
        let is_same = digest(&data(&task)) == student.data && seed.mark() == student.mark;
        if is_same { Ok(task) } else { Err(KeyError::OtherVersion) }
    }
}

/// The secret of a data set, a sentence each.
fn secret(task: &Task) -> Vec<String> {
    let mut out = Vec::new();
    for effect in &task.effects {
        let words: Vec<&str> = effect.possible.iter().map(|cause| cause.word()).collect();
        let additions = effect.cause.additions(&task.instrument);
        let factors: Vec<String> = additions
            .iter()
            .map(|own| format!("`{}` of `{}`", own.factor(&task.instrument), own.body))
            .collect();
        out.push(format!(
            "{}: {}. Its size is {:.1}″",
            words.join(" or "),
            factors.join(" and "),
            effect.size_arcsec
        ));
    }
    if task.reading != Reading::AsLabelled {
        out.push(format!("{}: {}", task.reading.word(), task.reading.words(&task.instrument)));
    }
    for (name, number) in ["size", task.asked_error, "prediction"].into_iter().zip(task.numbers) {
        out.push(format!(
            "{name}: {:.2}″. The data allow ± {:.2}″",
            number.truth_arcsec, number.uncertainty_arcsec
        ));
    }
    let declared = task.declared.iter().map(|(name, value)| format!("{name} {:.1}″", value / ARCSEC_RAD));
    out.push(format!("declared errors: {}", declared.collect::<Vec<_>>().join(", ")));
    out.push(format!("right sentence: {}", sentence::right(task)));
    out
}
