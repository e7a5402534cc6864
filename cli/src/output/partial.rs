//! What is being written, under a name of its own until it is complete.
//!
//! The name is random and taken exclusively, and the file is locked while its writer lives: what a run left behind that was killed is
//! told from what another run is writing, and removed. A run that is interrupted removes its own.

use std::fs::{self, File};
use std::hash::{BuildHasher as _, RandomState};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Where this process is writing: what an interrupted run removes.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what this process is writing, which is to end now: while the guard lives nothing is begun, and nothing takes its name.
pub fn remove_unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    let unfinished = unfinished();
    unfinished.iter().for_each(|path| remove(path));
    unfinished
}

/// How often another name is tried when one is taken.
const TRIES: usize = 100;

/// A file or folder that is removed again unless it took its name.
pub struct Partial {
    path: PathBuf,
    /// Held open for its lock.
    lock: Option<File>,
    kept: bool,
}

impl Partial {
    /// A new file beside `target`, so that renaming is one step; with the mode and the owner of what stands there.
    pub fn file(target: &Path) -> io::Result<(Self, File)> {
        remove_stale(target);
        let (partial, file) =
            Self::taken(target, |path| File::options().write(true).create_new(true).open(path))?;
        if let Ok(there) = fs::metadata(target) {
            like(&file, &there)?;
        }
        Ok((partial, file))
    }

    /// A new folder beside `target`.
    pub fn folder(target: &Path) -> io::Result<Self> {
        remove_stale(target);
        Ok(Self::taken(target, |path| fs::create_dir(path))?.0)
    }

    /// A second name for the file that stands at `target`.
    pub fn second_name(target: &Path) -> io::Result<Self> {
        let second =
            |path: &Path| fs::hard_link(target, path).or_else(|_| fs::copy(target, path).map(|_| ()));
        Ok(Self::taken(target, second)?.0)
    }

    /// Where it is being written.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Gives it its name.
    pub fn take_name(&mut self, target: &Path) -> io::Result<()> {
        // Some systems rename nothing that is open.
        self.lock = None;
        let mut unfinished = unfinished();
        fs::rename(&self.path, target)?;
        unfinished.retain(|path| *path != self.path);
        self.kept = true;
        Ok(())
    }

    fn taken<T>(target: &Path, make: impl Fn(&Path) -> io::Result<T>) -> io::Result<(Self, T)> {
        let mut last = io::Error::from(io::ErrorKind::AlreadyExists);
        for _ in 0..TRIES {
            let path =
                target.with_file_name(name(target, &format!("{:016x}", RandomState::new().hash_one(0))));
            let mut unfinished = unfinished();
            match make(&path) {
                Ok(made) => {
                    unfinished.push(path.clone());
                    drop(unfinished);
                    let lock = File::open(&path).ok().filter(|lock| lock.try_lock().is_ok());
                    let partial = Self { path, lock, kept: false };
                    // Another run may have taken it for left behind before it was locked.
                    if fs::symlink_metadata(&partial.path).is_ok() {
                        return Ok((partial, made));
                    }
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => last = error,
                Err(error) => return Err(error),
            }
        }
        Err(last)
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        if !self.kept {
            self.lock = None;
            remove(&self.path);
            unfinished().retain(|path| *path != self.path);
        }
    }
}

/// `.NAME.0123456789abcdef.partial`
fn name(target: &Path, middle: &str) -> std::ffi::OsString {
    let mut name = std::ffi::OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".{middle}.partial"));
    name
}

/// Removes what interrupted runs left beside `target`: nobody holds its lock.
fn remove_stale(target: &Path) {
    let folder = match target.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let Some(of_target) = target.file_name().and_then(|name| name.to_str()) else { return };
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let middle = name.to_str().and_then(|name| {
            name.strip_prefix('.')?.strip_prefix(of_target)?.strip_prefix('.')?.strip_suffix(".partial")
        });
        if middle.is_some_and(|middle| middle.len() == 16 && middle.bytes().all(|b| b.is_ascii_hexdigit())) {
            let path = entry.path();
            if File::open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
                remove(&path);
            }
        }
    }
}

/// Removes a file or a folder; what cannot be removed stays, and hurts nobody.
fn remove(path: &Path) {
    let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
}

/// Gives a new file the mode of the one that it replaces, and its owner where the system allows that.
fn like(file: &File, there: &fs::Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt as _, fchown};
        let own = file.metadata()?;
        if (own.uid(), own.gid()) != (there.uid(), there.gid()) {
            let _ = fchown(file, Some(there.uid()), Some(there.gid()));
        }
    }
    file.set_permissions(there.permissions())
}
