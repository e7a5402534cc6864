//! `--sizes BOX.toml`: the largest sizes of the errors, the same in every command that asks for them.

use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::terminal;

/// The file with the largest sizes of the errors.
#[derive(Debug, clap::Args)]
pub struct SizesArgument {
    /// Largest sizes of the errors; default, of an instrument file: what its calibration says of them
    #[arg(long, value_name = "BOX.toml")]
    sizes: Option<PathBuf>,
    /// The same, by its former name
    #[arg(long, value_name = "BOX.toml", hide = true, conflicts_with = "sizes")]
    errors: Option<PathBuf>,
}

impl SizesArgument {
    /// The file, if one is named; its former name comes with a hint.
    pub fn given(&self) -> Option<&Path> {
        if self.errors.is_some() {
            terminal::warn("--errors is called --sizes here: it takes largest sizes, and no values");
        }
        self.sizes.as_deref().or(self.errors.as_deref())
    }

    /// The file.
    ///
    /// # Errors
    /// None is named.
    pub fn needed(&self) -> Result<&Path, Failure> {
        let missing = "how large can the errors be? say --sizes BOX.toml, a file with lines such as \"*\" = \"10 arcsec\"";
        self.given().ok_or_else(|| Failure::Input(missing.to_owned()))
    }
}
