//! A run whose memory is limited (`ulimit -v`): where the limit is too low, the command says so and ends as for any bad input.
//!
//! Memory that is refused ends a process at once, and nothing in it can say why. Where a limit is set, the command therefore runs in
//! a process of its own. This one passes on what that process says, and has the last word.

use std::env;
use std::io::{BufRead as _, BufReader, Read};
use std::os::unix::process::{CommandExt as _, ExitStatusExt as _};
use std::process::{Child, Command, ExitCode, ExitStatus, Stdio};

use rustix::process::{Pid, Resource, Signal, getrlimit, kill_process, set_parent_process_death_signal};

use crate::failure::Failure;
use crate::terminal;

/// Set for the process that does the work.
const INSIDE: &str = "TRUEAXIS_WITHIN_LIMIT";

/// Below so many bytes, threads share what they allocate from: otherwise each reserves 64 MB for itself.
const LITTLE: u64 = 1 << 30;

/// How the runtime begins the line in which it says that memory was refused.
const REFUSED: &str = "memory allocation of ";

/// What a panic says for want of memory: of a thread, or of a matrix, whose bytes stand behind `size: `.
const OF_MEMORY: [&str; 4] =
    ["failed to spawn thread", "ThreadPoolBuildError", "Cannot allocate memory", "AllocError"];

/// Exit code of a process that panicked.
const PANICKED: i32 = 101;

/// Runs the command in a process of its own where memory is limited, and returns its exit code; `None` where this process is to do
/// the work.
pub fn run_apart() -> Option<ExitCode> {
    let limit = getrlimit(Resource::As).current?;
    if env::var_os(INSIDE).is_some() {
        // Where nobody would have the last word, nothing is to go on. What cannot be asked for is not needed.
        let _ = set_parent_process_death_signal(Some(Signal::TERM));
        return if has_threads() { None } else { Some(refused(limit, None)) };
    }
    let mut words = env::args_os();
    let mut command = Command::new(env::current_exe().ok()?);
    if let Some(name) = words.next() {
        command.arg0(name);
    }
    command.args(words).env(INSIDE, "1").stderr(Stdio::piped());
    if limit < LITTLE {
        command.env("MALLOC_ARENA_MAX", "1");
    }
    // Where no second process can be had, this one does what it can.
    let mut child = command.spawn().ok()?;
    pass_on_interruptions(&child);
    let mut told = Told::default();
    if let Some(errors) = child.stderr.take() {
        told.pass_on(errors);
    }
    let status = child.wait().ok()?;
    Some(ended(status, &told, limit))
}

/// Takes threads for all processors, or a single one; whether there is memory for that.
fn has_threads() -> bool {
    let all_or_one = [0, 1].map(|count| move || rayon::ThreadPoolBuilder::new().num_threads(count));
    // A pool for everybody is asked for once only, so one that is thrown away is asked for before.
    all_or_one.iter().any(|pool| pool().build().is_ok() && pool().build_global().is_ok())
}

/// Ctrl-C reaches both processes, a request to end only this one: the other one cleans up, and this one waits for it.
fn pass_on_interruptions(child: &Child) {
    let Some(id) = i32::try_from(child.id()).ok().and_then(Pid::from_raw) else { return };
    let _ = ctrlc::set_handler(move || {
        let _ = kill_process(id, Signal::TERM);
    });
}

/// What the working process said of memory.
#[derive(Default)]
struct Told {
    /// Bytes that were refused.
    refused: Option<u64>,
    /// Whether it panicked for want of memory.
    is_of_memory: bool,
    /// What it said from a panic or refused memory on: nobody needs that where memory was too little.
    held: Vec<u8>,
}

impl Told {
    /// Passes on every line before a panic or the runtime's on refused memory.
    fn pass_on(&mut self, errors: impl Read) {
        let mut errors = BufReader::new(errors);
        let mut line = Vec::new();
        while errors.read_until(b'\n', &mut line).is_ok_and(|read| read > 0) {
            let text = String::from_utf8_lossy(&line);
            let is_panic = text.starts_with("thread '") && text.contains(" panicked at ");
            if let Some(bytes) = text.strip_prefix(REFUSED).and_then(first_number) {
                self.refused = Some(bytes);
                self.held.extend_from_slice(&line);
            } else if is_panic || !self.held.is_empty() {
                if OF_MEMORY.iter().any(|part| text.contains(part)) {
                    self.is_of_memory = true;
                    self.refused = text.split_once("size: ").and_then(|(_, rest)| first_number(rest));
                }
                self.held.extend_from_slice(&line);
            } else {
                terminal::pass_on(&line);
            }
            line.clear();
        }
    }
}

fn first_number(text: &str) -> Option<u64> {
    text.split(|letter: char| !letter.is_ascii_digit()).next()?.parse().ok()
}

fn ended(status: ExitStatus, told: &Told, limit: u64) -> ExitCode {
    let code = match (status.code(), status.signal()) {
        (Some(PANICKED), _) if told.is_of_memory => None,
        (Some(code), _) => Some(code),
        // Nothing but refused memory ends a run of ours like this.
        (None, Some(signal))
            if [Signal::ABORT, Signal::SEGV, Signal::BUS].map(Signal::as_raw).contains(&signal) =>
        {
            None
        }
        // As shells have it.
        (None, signal) => Some(128 + signal.unwrap_or_default()),
    };
    match code {
        Some(code) => {
            terminal::pass_on(&told.held);
            ExitCode::from(u8::try_from(code).unwrap_or(2))
        }
        None => refused(limit, told.refused),
    }
}

/// Says that the limit is too low.
fn refused(limit: u64, bytes: Option<u64>) -> ExitCode {
    terminal::report_failure(&Failure::Input(too_little(limit, bytes)));
    ExitCode::from(2)
}

/// `the limit of 300 MB is too low: the command wanted 25 MB beyond …`
fn too_little(limit: u64, refused: Option<u64>) -> String {
    let limit_mb = limit / 1_000_000;
    let wanted = match refused {
        Some(bytes) if bytes >= 1_000_000 => format!("another {} MB were refused", bytes.div_ceil(1_000_000)),
        Some(bytes) => format!("another {bytes} bytes were refused"),
        None => "the system refused more".to_owned(),
    };
    format!(
        "a limit of {limit_mb} MB of memory is too low for this command: {wanted}. Raise the limit (`ulimit -v`), or ask for \
         less: fewer rows, errors or observables"
    )
}

#[cfg(test)]
mod tests {
    use std::os::unix::process::ExitStatusExt as _;
    use std::process::ExitStatus;

    use super::*;

    fn told(text: &str) -> Told {
        let mut told = Told::default();
        told.pass_on(text.as_bytes());
        told
    }

    #[test]
    fn what_the_runtime_says_of_memory_is_read() {
        assert_eq!(told("memory allocation of 400000 bytes failed\n").refused, Some(400_000));
        assert_eq!(told("").refused, None);
        let panic = "thread 'main' (7) panicked at a.rs:1:2:\n";
        let of_thread = told(&format!("{panic}called `Result::unwrap()`: failed to spawn thread: Os\n"));
        assert!(of_thread.is_of_memory && of_thread.refused.is_none());
        let of_matrix =
            told(&format!("{panic}AllocError {{ layout: Layout {{ size: 5011200, align: 64 }} }}\n"));
        assert_eq!((of_matrix.is_of_memory, of_matrix.refused), (true, Some(5_011_200)));
        let other = told(&format!("{panic}index out of bounds\n"));
        assert!(!other.is_of_memory && !other.held.is_empty());
    }

    #[test]
    fn exit_codes_stay_what_they_were() {
        let code = |raw, told: &Told| format!("{:?}", ended(ExitStatus::from_raw(raw), told, 1 << 28));
        let nothing = Told::default();
        let of = |code: u8| format!("{:?}", ExitCode::from(code));
        assert_eq!(code(0, &nothing), of(0));
        assert_eq!(code(1 << 8, &nothing), of(1));
        assert_eq!(code(130 << 8, &nothing), of(130));
        assert_eq!(code(101 << 8, &nothing), of(101));
        assert_eq!(code(101 << 8, &Told { is_of_memory: true, ..Told::default() }), of(2));
        assert_eq!(code(9, &nothing), of(137));
        assert_eq!(code(6, &nothing), of(2));
    }

    #[test]
    fn the_sentence_says_how_much_was_wanted() {
        assert!(
            too_little(300_000_000, Some(24_500_000))
                .contains("300 MB of memory is too low for this command: another 25 MB")
        );
        assert!(too_little(300_000_000, Some(100)).contains("another 100 bytes"));
    }
}
