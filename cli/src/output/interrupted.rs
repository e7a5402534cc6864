//! What becomes of unfinished output when somebody interrupts the command: Ctrl-C, or a request to end.

use std::process;
use std::sync::{Mutex, PoisonError};

use super::partial::remove_unfinished;

/// Held while files take their names: they appear together, or not at all.
pub static TAKING_NAMES: Mutex<()> = Mutex::new(());

/// The exit code of what was interrupted, as shells have it for Ctrl-C.
const INTERRUPTED: i32 = 130;

/// From now on an interruption removes what is unfinished, and ends the process. Where the system does not let it, an interrupted run
/// leaves a file that the next one removes.
pub fn clean_up_when_interrupted() {
    let _ = ctrlc::set_handler(|| {
        let _whole = TAKING_NAMES.lock().unwrap_or_else(PoisonError::into_inner);
        let _nothing_more = remove_unfinished();
        process::exit(INTERRUPTED);
    });
}
