//! Threads in a process that was forked: those of the process before it stayed there, and who waits for them waits for ever.

use std::process;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use pyo3::PyErr;
use pyo3::exceptions::PyRuntimeError;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// The process that loaded the package.
static LOADED_IN: OnceLock<u32> = OnceLock::new();

/// The threads of a forked process, and which process that is.
static OWN: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Takes note of the process.
pub fn loaded() {
    LOADED_IN.get_or_init(process::id);
}

/// Does some work where threads can be had: in a forked process among new ones, else on this thread.
pub fn with_threads<T: Send>(work: impl FnOnce() -> T + Send) -> Result<T, PyErr> {
    let process = process::id();
    if *LOADED_IN.get_or_init(process::id) == process {
        return Ok(work());
    }
    Ok(of_process(process)?.install(work))
}

fn of_process(process: u32) -> Result<Arc<ThreadPool>, PyErr> {
    let mut own = OWN.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((of, threads)) = own.as_ref()
        && *of == process
    {
        return Ok(Arc::clone(threads));
    }
    let threads = ThreadPoolBuilder::new().build();
    let threads = Arc::new(threads.map_err(|error| PyRuntimeError::new_err(format!("no threads: {error}")))?);
    // Those of a process before this one are not there to be ended.
    std::mem::forget(own.replace((process, Arc::clone(&threads))));
    Ok(threads)
}
