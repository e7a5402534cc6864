//! `--certificate`: where a certificate and the library that it stands on are written.

use std::path::PathBuf;

use proof::{LIBRARY, LIBRARY_FILE};

use crate::failure::Failure;
use crate::output;

/// The arguments of every command that writes certificates.
#[derive(Debug, clap::Args)]
pub struct CertificateArguments {
    /// Write what is said, with a proof that the proof assistant Coq checks; TrueAxis.v, which it needs, is written beside it
    #[arg(long, value_name = "OUT.v")]
    certificate: Option<PathBuf>,
    /// Write TrueAxis.v, the library that certificates need, to this place instead
    #[arg(long, value_name = "TrueAxis.v")]
    certificate_library: Option<PathBuf>,
}

impl CertificateArguments {
    /// Whether a certificate is wanted.
    ///
    /// # Errors
    /// Coq would not read a file of that name.
    pub fn is_wanted(&self) -> Result<bool, Failure> {
        let Some(path) = &self.certificate else { return Ok(false) };
        let is_word = |name: &str| {
            name.starts_with(|c: char| c.is_ascii_alphabetic())
                && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        };
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        if path.extension().is_none_or(|extension| extension != "v") || !is_word(stem) {
            return Err(Failure::Input(format!(
                "--certificate `{}`: Coq reads files whose names are a word of letters, digits and underscores, and end in .v",
                path.display()
            )));
        }
        if path.file_name().is_some_and(|name| name == LIBRARY_FILE) {
            return Err(Failure::Input(format!(
                "--certificate `{}`: {LIBRARY_FILE} is the library that certificates need; name the certificate otherwise",
                path.display()
            )));
        }
        Ok(true)
    }

    /// Writes a certificate, if there is one, and the library, if that or a certificate is wanted.
    ///
    /// # Errors
    /// A place cannot be written, or something else lies where the library belongs; then there is no certificate either.
    pub fn write(&self, certificate: Option<&str>) -> Result<(), Failure> {
        self.write_library()?;
        match (&self.certificate, certificate) {
            (Some(path), Some(text)) => output::write_text(path, text),
            _ => Ok(()),
        }
    }

    fn write_library(&self) -> Result<(), Failure> {
        let path = match (&self.certificate_library, &self.certificate) {
            (Some(path), _) => path.clone(),
            (None, Some(certificate)) => certificate.with_file_name(LIBRARY_FILE),
            (None, None) => return Ok(()),
        };
        // A library of another version is replaced; a file that is no library of ours stays.
        let first_words = LIBRARY.split_once(':').map_or(LIBRARY, |(first, _)| first);
        match std::fs::read_to_string(&path) {
            Ok(text) if text == LIBRARY => Ok(()),
            Ok(text) if !text.starts_with(first_words) => Err(Failure::Input(format!(
                "`{}` is in the way of the library that certificates need; name another place with --certificate-library",
                path.display()
            ))),
            _ => output::write_text(&path, LIBRARY),
        }
    }
}
