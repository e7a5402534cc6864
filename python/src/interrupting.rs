//! Long work that Ctrl-C ends: a thread of its own does it, while the thread that asked hears how far it is and looks for Python's signals;
//! or the thread that asked does it bit by bit.

use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How often somebody looks for signals.
const PAUSE: Duration = Duration::from_millis(50);

/// As much as the thread that asked may have.
const STACK: usize = 8 << 20;

/// Who is told of work, and may end it.
pub struct Listener {
    stop: Arc<AtomicBool>,
    told: Sender<String>,
}

/// What unwinds work that is ended.
struct Stopped;

impl Listener {
    /// Says what is being done; does not come back where the work is to end.
    pub fn tell(&self, text: String) {
        if self.stop.load(Ordering::Relaxed) {
            resume_unwind(Box::new(Stopped));
        }
        // Who does not wait any more hears nothing.
        let _ = self.told.send(text);
    }
}

/// Who does work bit by bit, and looks for signals in between.
pub struct Ears {
    last: Instant,
}

impl Default for Ears {
    fn default() -> Self {
        Self { last: Instant::now() }
    }
}

impl Ears {
    /// Looks for signals, where that was a while ago: the interpreter's lock is somebody else's meanwhile.
    ///
    /// # Errors
    /// What a signal raises.
    pub fn listen(&mut self) -> PyResult<()> {
        if self.last.elapsed() < PAUSE {
            return Ok(());
        }
        self.last = Instant::now();
        Python::attach(|py| py.check_signals())
    }
}

/// Does some work without the interpreter's lock. `hear` is told what it does, on this thread. What it raises, or a signal
/// (`KeyboardInterrupt` for Ctrl-C), comes back at once; nobody waits for the work then, which ends where it tells the next.
pub fn watched<T: Send + 'static>(
    py: Python<'_>,
    hear: &(impl Fn(Python<'_>, String) -> PyResult<()> + Sync),
    work: impl FnOnce(&Listener) -> T + Send + 'static,
) -> PyResult<T> {
    py.detach(|| {
        let stop = Arc::new(AtomicBool::new(false));
        let (told, heard) = channel();
        let listener = Listener { stop: Arc::clone(&stop), told };
        let working = thread::Builder::new().stack_size(STACK).spawn(move || work(&listener));
        let working = working.map_err(|error| PyRuntimeError::new_err(format!("no thread: {error}")))?;
        loop {
            let text = match heard.recv_timeout(PAUSE) {
                Ok(text) => Some(text),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => break,
            };
            let listened = Python::attach(|py| {
                py.check_signals()?;
                text.map_or(Ok(()), |text| hear(py, text))
            });
            if listened.is_err() {
                stop.store(true, Ordering::Relaxed);
                listened?;
            }
        }
        working.join().or_else(|panic| resume_unwind(panic))
    })
}
