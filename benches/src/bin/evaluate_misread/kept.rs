//! Answers that are kept in a file, one a line, so that a long run can be stopped and taken up again.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::Write as _;
use std::sync::Mutex;

use crate::judge::Failure;

/// What was answered so far, by the name of the run; new answers go to the end of the file.
pub struct Kept {
    answers: BTreeMap<String, String>,
    file: Option<Mutex<fs::File>>,
}

impl Kept {
    /// What a file has; without one nothing is kept.
    pub fn read(path: Option<&str>) -> Result<Self, Failure> {
        let Some(path) = path else { return Ok(Self { answers: BTreeMap::new(), file: None }) };
        let file = OpenOptions::new().create(true).append(true).open(path)?;
        let text = fs::read_to_string(path)?;
        let pair =
            |line: &str| line.split_once('\t').map(|(run, answer)| (run.to_owned(), answer.to_owned()));
        Ok(Self { answers: text.lines().filter_map(pair).collect(), file: Some(Mutex::new(file)) })
    }

    /// The answer of a run: the one that is kept, or else a new one.
    pub fn or_new(
        &self,
        run: &str,
        new: impl FnOnce() -> Result<String, Failure>,
    ) -> Result<String, Failure> {
        if let Some(answer) = self.answers.get(run) {
            return Ok(answer.clone());
        }
        let answer = new()?;
        if let Some(file) = &self.file {
            let mut file = file.lock().map_err(|_| "another run failed")?;
            writeln!(file, "{run}\t{answer}")?;
        }
        Ok(answer)
    }
}
