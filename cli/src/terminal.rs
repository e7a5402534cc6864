//! What goes to the terminal: results to standard output, everything else to standard error, with colours
//! only where a person looks.
//!
//! Nothing else writes there. A [`Screen`] shows every letter that would command a terminal, and a message is one line, so that
//! what a file holds can neither act nor pass for a message.

use std::cell::RefCell;
use std::fmt::{Display, Write as _};
use std::io::{IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};
use model_core::escape::{self, Screen};
use report::style::{BAD, CAREFUL};
use report::{shell_word, wrap};
use serde_json::Value;

use crate::failure::Failure;

/// Letters that a line of text has: as many as the variable `COLUMNS` says, or the terminal has, within reason.
#[must_use]
pub fn width() -> usize {
    let said = std::env::var("COLUMNS").ok().and_then(|columns| columns.parse::<usize>().ok());
    let seen = || terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    said.or_else(seen).unwrap_or(WITHOUT_TERMINAL).clamp(NARROWEST, WIDEST)
}

/// Letters of a line where nobody says.
const WITHOUT_TERMINAL: usize = 100;
/// Letters of a line that a table still fits in.
const NARROWEST: usize = 40;
/// Letters of a line that reads well.
const WIDEST: usize = 100;

/// Writes a text for reading to standard output, its long lines broken at the width of the terminal.
///
/// # Errors
/// As [`print`].
pub fn print_text(text: impl Into<Screen>) -> Result<(), Failure> {
    write(&text.into().laid_out(|text| wrap::text(text, width())))
}

/// Writes formulas to standard output: their lines are broken only where a person looks.
///
/// # Errors
/// As [`print`].
pub fn print_formulas(text: impl Into<Screen>) -> Result<(), Failure> {
    if std::io::stdout().is_terminal() { print_text(text) } else { print(text) }
}

/// Writes an answer for programs to standard output.
///
/// # Errors
/// As [`print`].
pub fn print_json(value: &Value) -> Result<(), Failure> {
    print(escape::json(&format!("{value:#}\n")))
}

/// Writes a result to standard output.
///
/// # Errors
/// Standard output cannot be written, a full disk say.
pub fn print(text: impl Into<Screen>) -> Result<(), Failure> {
    write(text.into().as_str())
}

fn write(text: &str) -> Result<(), Failure> {
    let mut out = anstream::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(|error| Failure::write("standard output".as_ref(), &error))
}

/// Whether what the command is doing goes unsaid.
static QUIET: AtomicBool = AtomicBool::new(false);

/// From here on, only results, warnings and errors are told.
pub fn be_quiet() {
    QUIET.store(true, Ordering::Relaxed);
}

thread_local! {
    /// The warnings of a library's caller, which no terminal shows.
    static COLLECTED: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
}

/// Does some work on this thread, and returns what it would have warned of instead of saying it; nor does it say what it is
/// doing.
pub fn collecting<T>(work: impl FnOnce() -> T) -> (T, Vec<String>) {
    let before = COLLECTED.replace(Some(Vec::new()));
    let done = work();
    (done, COLLECTED.replace(before).unwrap_or_default())
}

/// Says on standard error what the user should know although the command goes on.
pub fn warn(message: impl Display) {
    let is_collected = COLLECTED.with_borrow_mut(|warnings| {
        let message = message.to_string();
        warnings.as_mut().map(|warnings| warnings.push(escape::message(&message).into_owned())).is_some()
    });
    if is_collected {
        return;
    }
    say_styled(CAREFUL, "warning", &escape::message(&message.to_string()));
}

/// Says on standard error what the command is doing.
pub fn note(message: impl Display) {
    if !QUIET.load(Ordering::Relaxed) && COLLECTED.with_borrow(Option::is_none) {
        say(&escape::message(&message.to_string()).as_ref().into());
    }
}

/// Says on a terminal how to begin the next command where a shell does not find `trueaxis`: what was printed begins with this name.
pub fn note_how_to_begin() {
    if !std::io::stderr().is_terminal() {
        return;
    }
    let name = format!("trueaxis{}", std::env::consts::EXE_SUFFIX);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let is_found = std::env::split_paths(&path).any(|folder| folder.join(&name).is_file());
    if is_found {
        return;
    }
    let typed = std::env::args_os().next().unwrap_or_default();
    note(format_args!(
        "`trueaxis` is not on your path: type {} in its place, or install it with `cargo install --path cli`",
        shell_word(&typed.to_string_lossy())
    ));
}

/// A message behind the word that says what it is.
fn say_styled(style: impl Display, word: &str, message: &str) {
    let mut said = Screen::default();
    said.styled([&style, &format_args!("{style:#}")], word);
    let _ = write!(said, ": {message}");
    say(&said);
}

fn say(message: &Screen) {
    let message = if std::io::stderr().is_terminal() {
        message.laid_out(|text| wrap::text(text, width()))
    } else {
        format!("{}\n", message.as_str())
    };
    // Where standard error is closed there is nobody to tell.
    let _ = anstream::stderr().write_all(message.as_bytes());
}

/// Passes on what a process of this command has said on standard error, which has been through [`say`] there.
pub fn pass_on(said: &[u8]) {
    // Where standard error is closed there is nobody to tell.
    let _ = std::io::stderr().write_all(said);
}

/// A line on standard error that says where a long run is, where a person looks; drop it to take it away.
pub fn progress() -> Progress {
    if QUIET.load(Ordering::Relaxed) {
        return Progress(ProgressBar::hidden());
    }
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(100));
    Progress(bar)
}

/// A line that says where a long run is.
#[derive(Clone)]
pub struct Progress(ProgressBar);

impl Progress {
    /// What is being done now.
    pub fn say(&self, message: &str) {
        self.0.set_message(escape::message(message).into_owned());
    }

    /// The same line with how long it has taken so far.
    #[must_use]
    pub fn with_elapsed(self, expected: &str) -> Self {
        match ProgressStyle::with_template("{spinner} {elapsed} of some {msg}") {
            Ok(style) => Self(self.0.with_style(style).with_message(escape::message(expected).into_owned())),
            Err(_) => self,
        }
    }

    /// Takes the line away.
    pub fn finish_and_clear(&self) {
        self.0.finish_and_clear();
    }
}

/// Says on standard error why the command stopped.
pub fn report_failure(failure: &Failure) {
    match failure {
        Failure::Mistakes { rendered, .. } => say(&rendered.trim_end().into()),
        _ => say_styled(BAD, "error", &failure.to_string()),
    }
}

/// The command as it was typed; a letter that is none is shown as such.
pub fn command_line() -> String {
    let words = std::env::args_os().map(|word| shell_word(&word.to_string_lossy()).into_owned());
    words.collect::<Vec<_>>().join(" ")
}
