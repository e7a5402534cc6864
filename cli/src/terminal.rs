//! What goes to the terminal: results to standard output, everything else to standard error, with colours
//! only where a person looks.

use std::cell::RefCell;
use std::fmt::Display;
use std::io::{IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use indicatif::ProgressBar;
use report::style::{BAD, CAREFUL};
use report::{shell_word, wrap};

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
pub fn print_text(text: &str) -> Result<(), Failure> {
    print(&wrap::text(text, width()))
}

/// Writes formulas to standard output: their lines are broken only where a person looks.
///
/// # Errors
/// As [`print`].
pub fn print_formulas(text: &str) -> Result<(), Failure> {
    if std::io::stdout().is_terminal() { print_text(text) } else { print(text) }
}

/// Writes a result to standard output.
///
/// # Errors
/// Standard output cannot be written, a full disk say.
pub fn print(text: &str) -> Result<(), Failure> {
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
        warnings.as_mut().map(|warnings| warnings.push(message.to_string())).is_some()
    });
    if is_collected {
        return;
    }
    say(format_args!("{CAREFUL}warning{CAREFUL:#}: {message}"));
}

/// Says on standard error what the command is doing.
pub fn note(message: impl Display) {
    if !QUIET.load(Ordering::Relaxed) && COLLECTED.with_borrow(Option::is_none) {
        say(message);
    }
}

fn say(message: impl Display) {
    let message = message.to_string();
    let message =
        if std::io::stderr().is_terminal() { wrap::text(&message, width()) } else { message + "\n" };
    // Where standard error is closed there is nobody to tell.
    let _ = anstream::stderr().write_all(message.as_bytes());
}

/// A line on standard error that says where a long run is, where a person looks; drop it to take it away.
pub fn progress() -> ProgressBar {
    if QUIET.load(Ordering::Relaxed) {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}

/// Says on standard error why the command stopped.
pub fn report_failure(failure: &Failure) {
    match failure {
        Failure::Mistakes { rendered, .. } => say(rendered.trim_end()),
        _ => say(format_args!("{BAD}error{BAD:#}: {failure}")),
    }
}

/// The command as it was typed; a letter that is none is shown as such.
pub fn command_line() -> String {
    let words = std::env::args_os().map(|word| shell_word(&word.to_string_lossy()).into_owned());
    words.collect::<Vec<_>>().join(" ")
}
