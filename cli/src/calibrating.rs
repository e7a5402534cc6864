//! A calibration from a study to what is reported of it: what `calibrate` does, whoever asks for it.

use std::fs;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};

use calibration::calibrate::{Calibration, Request, Stage, calibrate_telling};
use observe::Observations;
use study::{Loaded, OpenTable, Plan, Study};
use tables::formats::sha256;

use crate::failure::Failure;
use crate::report::{FileRead, Provenance, Reported, file_names};
use crate::source::{self, Source};
use crate::table_files::Files;
use crate::{date, output, table_files, terminal};

/// A study that was read, with the declaration that it names.
#[derive(Clone)]
pub struct Studied {
    /// The study.
    pub study: Source,
    /// The declaration.
    pub chain: Source,
    /// The declaration's file, as the study names it.
    pub chain_file: String,
    /// What the study means.
    pub plan: Plan,
    /// Its tables, as far as they are files.
    pub files: Files,
}

/// A study with its data.
pub struct Measured {
    /// The study.
    pub studied: Studied,
    /// The data.
    pub loaded: Loaded,
    /// What is doubtful of either.
    warnings: Vec<String>,
}

/// A calibration with everything that is reported of it.
pub struct Calibrated {
    /// What came of it.
    pub calibration: Calibration,
    studied: Studied,
    observations: Observations,
    provenance: Provenance,
}

impl Studied {
    /// Resolves a study with the declaration that it names.
    ///
    /// # Errors
    /// What is wrong with either, each with its place.
    pub fn read(study: Source) -> Result<Self, Failure> {
        let written = study.study()?;
        let chain_file = written.chain.get_ref().clone();
        let chain = study.read_beside(Path::new(&chain_file))?;
        Self::with(study, &written, chain_file, chain)
    }

    /// Resolves a study with a declaration that came from elsewhere than the file that it names.
    ///
    /// # Errors
    /// What is wrong with either, each with its place.
    pub fn of(study: Source, chain: Source) -> Result<Self, Failure> {
        let written = study.study()?;
        Self::with(study, &written, chain.path.display().to_string(), chain)
    }

    fn with(study: Source, written: &Study, chain_file: String, chain: Source) -> Result<Self, Failure> {
        let plan = written.plan(&chain.chain()?).map_err(|mistakes| study.mistakes(&mistakes))?;
        let files = Files::of(study.clone(), plan.data_from.clone());
        Ok(Self { study, chain, chain_file, plan, files })
    }

    /// Every table that the study names, as it names them.
    pub fn tables(&self) -> impl Iterator<Item = &str> {
        let data = self.plan.sources.iter().flat_map(|source| &source.paths);
        data.chain(&self.plan.hold_out.file).map(String::as_str)
    }

    /// Where the tables are, if they are files.
    pub fn table_files(&self) -> Vec<PathBuf> {
        self.tables().map(|path| self.study.beside(Path::new(path))).collect()
    }

    /// Reads the tables; warns of columns whose numbers are hardly in SI.
    ///
    /// # Errors
    /// What is wrong with a table, with its place.
    pub fn load(self, open: &mut OpenTable<'_>) -> Result<Measured, Failure> {
        let loaded = self.plan.load_tables(open).map_err(table_files::failure)?;
        Ok(self.with_data(loaded.without_repeats()))
    }

    /// With data that were read; warns of what is doubtful.
    pub fn with_data(self, loaded: Loaded) -> Measured {
        let Plan { doubts, unstated, unsought, timeless, .. } = &self.plan;
        let mut warnings = texts(doubts);
        warnings.extend([texts(unstated), texts(unsought), texts(timeless)].concat());
        warnings.extend([texts(&loaded.doubtful), texts(&loaded.remarks)].concat());
        warnings.iter().for_each(terminal::warn);
        Measured { studied: self, loaded, warnings }
    }

    /// Refuses to write the files of a calibration over what the study reads.
    ///
    /// # Errors
    /// One of them is a file that the study reads, by whatever names.
    pub fn refuse_to_replace(&self, folder: &Path) -> Result<(), Failure> {
        let tables = self.table_files();
        let read = || tables.iter().chain([&self.study.path, &self.chain.path]).map(PathBuf::as_path);
        file_names(&self.plan).try_for_each(|name| output::refuse_to_replace(&folder.join(name), read()))
    }

    /// The study, the declaration and the data with their checksums. What is no file, a pipe or a table in memory, has been
    /// read already.
    fn files_read(&self) -> Result<Vec<FileRead>, Failure> {
        let study = (self.study.path.display().to_string(), self.study.path.clone());
        let chain = (self.chain_file.clone(), self.chain.path.clone());
        let tables = self.tables().map(str::to_owned).zip(self.table_files());
        let read = |(path, place): (String, PathBuf)| {
            if !fs::metadata(&place).is_ok_and(|metadata| metadata.is_file()) {
                return Ok(FileRead { path, sha256: None });
            }
            let digest = fs::File::open(&place).and_then(sha256::hex);
            let digest = digest.map_err(|error| source::not_readable(&place, &error))?;
            Ok(FileRead { path, sha256: Some(digest) })
        };
        let read: Vec<FileRead> =
            [study, chain].into_iter().chain(tables).map(read).collect::<Result<_, _>>()?;
        // A checksum is that of what was calibrated with.
        self.tables().try_for_each(|path| self.files.check(path)).map_err(table_files::failure)?;
        Ok(read)
    }
}

fn texts<'a, T: ToString + 'a>(doubts: impl IntoIterator<Item = &'a T>) -> Vec<String> {
    doubts.into_iter().map(ToString::to_string).collect()
}

impl Measured {
    /// Runs the loop; `command` says in the report how it was asked for, and `tell` hears of each stage.
    ///
    /// # Errors
    /// The study asks for something that cannot be fitted.
    pub fn calibrate(self, command: String, tell: &(dyn Fn(Stage) + Sync)) -> Result<Calibrated, Failure> {
        let Self { studied, loaded: Loaded { observations, held_out, sample, .. }, warnings } = self;
        let date = date::today();
        let request = Request {
            text: &studied.chain.text,
            plan: &studied.plan,
            observations: &observations,
            sample: Some(&sample),
            second: held_out.as_ref(),
            when: &date,
        };
        let (calibration, files) = std::thread::scope(|scope| {
            // Checksums of large files take as long as some of the loop, which does not use every processor all the time.
            let files = scope.spawn(|| studied.files_read());
            let calibration = calibrate_telling(request, tell);
            (calibration, files.join().unwrap_or_else(|panic| resume_unwind(panic)))
        });
        let calibration = calibration.map_err(|error| Failure::Input(error.to_string()))?;
        let provenance = Provenance {
            version: env!("CARGO_PKG_VERSION"),
            command,
            date,
            study: studied.study.text.clone(),
            files: files?,
            warnings,
        };
        Ok(Calibrated { calibration, studied, observations, provenance })
    }
}

impl Calibrated {
    /// The study that it came of.
    pub fn studied(&self) -> &Studied {
        &self.studied
    }

    /// The data that it was made from.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }

    /// What is reported; `folder` is where the files go to, if they are written.
    #[must_use]
    pub fn reported<'a>(&'a self, folder: Option<&'a str>) -> Reported<'a> {
        Reported {
            calibration: &self.calibration,
            observations: &self.observations,
            plan: &self.studied.plan,
            chain_file: &self.studied.chain_file,
            chain_text: &self.studied.chain.text,
            folder,
            provenance: &self.provenance,
        }
    }
}
