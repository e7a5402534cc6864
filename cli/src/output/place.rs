//! Where a path leads: a file that can be replaced, a stream that can only be written to, or standard output.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// Links that are followed from one name, as many as systems follow.
const LINKS: usize = 40;

/// What a path leads to.
pub enum Place {
    /// The stream that results are printed to.
    StandardOutput,
    /// A pipe, a device or a descriptor: it has no name to take over.
    Stream(PathBuf),
    /// A file, there or not; where links lead.
    File(PathBuf),
}

impl Place {
    /// Follows the links of a path.
    ///
    /// # Errors
    /// A folder, a file that is read-only, links that lead in a circle.
    pub fn of(path: &Path) -> io::Result<Self> {
        if path == Path::new("-") {
            return Ok(Self::StandardOutput);
        }
        let mut at = path.to_owned();
        for _ in 0..LINKS {
            if let Some(descriptor) = descriptor(&at) {
                return Ok(if descriptor == "1" { Self::StandardOutput } else { Self::Stream(at) });
            }
            match fs::symlink_metadata(&at) {
                Ok(place) if place.is_symlink() => {
                    let to = fs::read_link(&at)?;
                    at = at.parent().unwrap_or(Path::new("")).join(to);
                }
                Ok(place) if place.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
                Ok(place) if !place.is_file() => return Ok(Self::Stream(at)),
                Ok(place) if place.permissions().readonly() => {
                    return Err(io::ErrorKind::ReadOnlyFilesystem.into());
                }
                Ok(_) => return Ok(Self::File(at)),
                Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Self::File(at)),
                Err(error) => return Err(error),
            }
        }
        Err(io::Error::other("its links lead in a circle"))
    }
}

/// The number of an open file of this process, where a path names one: `/dev/stdout`, `/dev/fd/1`, `/proc/self/fd/1`.
fn descriptor(path: &Path) -> Option<String> {
    if path == Path::new("/dev/stdout") {
        return Some("1".to_owned());
    }
    let number = path.file_name()?.to_str()?;
    let folder = fs::canonicalize(path.parent()?).ok()?;
    let own = [Path::new("/proc/self/fd"), Path::new("/dev/fd")];
    let is_own = own.iter().any(|own| fs::canonicalize(own).is_ok_and(|own| own == folder));
    (is_own && number.bytes().all(|byte| byte.is_ascii_digit())).then(|| number.to_owned())
}

/// Refuses to write over a file that the command reads.
///
/// # Errors
/// `out` is the same file as one of `read`, by whatever names.
pub fn refuse_to_replace<'a>(out: &Path, read: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    let same = |read: &&Path| *read != Path::new("-") && is_same_file(out, read);
    match read.into_iter().find(same) {
        None => Ok(()),
        Some(read) => Err(Failure::Input(format!(
            "`{}` would be written over `{}`, which this command reads; write somewhere else",
            out.display(),
            read.display()
        ))),
    }
}

#[cfg(unix)]
fn is_same_file(one: &Path, other: &Path) -> bool {
    use std::os::unix::fs::MetadataExt as _;
    let file = |path: &Path| fs::metadata(path).ok().filter(fs::Metadata::is_file);
    matches!((file(one), file(other)), (Some(one), Some(other)) if one.dev() == other.dev() && one.ino() == other.ino())
}

#[cfg(not(unix))]
fn is_same_file(one: &Path, other: &Path) -> bool {
    matches!((fs::canonicalize(one), fs::canonicalize(other)), (Ok(one), Ok(other)) if one == other)
}
