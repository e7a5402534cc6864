//! A calibration from texts to what is reported of it: a study, its declaration and its tables in; reports out.

use std::io;
use std::path::Path;

use calibration::calibrate::{Calibration, Request, Stage, calibrate_telling};
use observe::Observations;
use report::{FileRead, Provenance, Reported};
use study::{Loaded, OpenTable, Plan, Study, WrittenColumn};
use tables::formats::{self, sha256};

use crate::instrument;
use crate::refusal::Refusal;
use crate::source::Source;
use crate::warn::Warn;

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

/// What a calibration is made with, beside the study and its data: what no text says.
#[derive(Debug, Clone)]
pub struct Made {
    /// Version of the program.
    pub version: &'static str,
    /// How it was asked for, as the report has it.
    pub command: String,
    /// The date, as `2026-11-21`.
    pub date: String,
}

/// A calibration with everything that is reported of it.
pub struct Calibrated {
    /// What came of it.
    pub calibration: Calibration,
    studied: Studied,
    observations: Observations,
    /// How each source writes what was observed.
    observed: Vec<Vec<WrittenColumn>>,
    provenance: Provenance,
}

impl Studied {
    /// Resolves a study with the declaration that it names; `read` gives the text of a file that the study names.
    ///
    /// # Errors
    /// What is wrong with either, each with its place; or the file cannot be had.
    pub fn read<E: From<Refusal>>(
        study: Source,
        warn: Warn<'_>,
        read: impl FnOnce(&Source, &Path) -> Result<Source, E>,
    ) -> Result<Self, E> {
        let written = study.study()?;
        let chain_file = written.chain.get_ref().clone();
        let chain = read(&study, Path::new(&chain_file))?;
        Ok(Self::with(study, &written, chain_file, chain, warn)?)
    }

    /// Resolves a study with a declaration that came from elsewhere than the file that it names.
    ///
    /// # Errors
    /// What is wrong with either, each with its place.
    pub fn of(study: Source, chain: Source, warn: Warn<'_>) -> Result<Self, Refusal> {
        let written = study.study()?;
        Self::with(study, &written, chain.path.display().to_string(), chain, warn)
    }

    fn with(
        study: Source,
        written: &Study,
        chain_file: String,
        chain: Source,
        warn: Warn<'_>,
    ) -> Result<Self, Refusal> {
        let plan = written.plan(&chain.chain(warn)?).map_err(|mistakes| study.mistakes(&mistakes))?;
        Ok(Self { study, chain, chain_file, plan })
    }

    /// Every table that the study names, as it names them.
    pub fn tables(&self) -> impl Iterator<Item = &str> {
        let data = self.plan.sources.iter().flat_map(|source| &source.paths);
        let trajectory = self.plan.trajectory.as_ref().map(|own| &own.path);
        data.chain(&self.plan.hold_out.file).chain(trajectory).map(String::as_str)
    }

    /// Reads the tables; warns of columns whose numbers are hardly in SI.
    ///
    /// # Errors
    /// What is wrong with a table, with its place.
    pub fn load(self, open: &mut OpenTable<'_>, warn: Warn<'_>) -> Result<Measured, Refusal> {
        let loaded = self.plan.load_tables(open).map_err(Refusal::of)?;
        Ok(self.with_data(loaded.without_repeats(), warn))
    }

    /// With data that were read; warns of what is doubtful.
    #[must_use]
    pub fn with_data(self, loaded: Loaded, warn: Warn<'_>) -> Measured {
        let Plan { doubts, unstated, unsought, timeless, .. } = &self.plan;
        let mut warnings = texts(doubts);
        warnings.extend([texts(unstated), texts(unsought), texts(timeless)].concat());
        warnings.extend([texts(&loaded.doubtful), texts(&loaded.remarks), loaded.of_files.clone()].concat());
        warnings.iter().cloned().for_each(warn);
        Measured { studied: self, loaded, warnings }
    }

    /// Calibrates with tables in memory, each by the name that the study has for it, as bytes of a file. Nothing else is read.
    ///
    /// # Errors
    /// A table that is not there, or what is wrong with one; the study asks for something that cannot be fitted.
    pub fn calibrate_texts(
        self,
        tables: &[(&str, &[u8])],
        made: Made,
        warn: Warn<'_>,
        tell: &(dyn Fn(Stage) + Sync),
    ) -> Result<Calibrated, Refusal> {
        let bytes_of = |name: &str| tables.iter().find(|(other, _)| *other == name).map(|(_, bytes)| *bytes);
        let missing = self.tables().find(|name| bytes_of(name).is_none());
        if let Some(name) = missing {
            let name = name.to_owned();
            return Err(Refusal::Input(format!(
                "the study names the table `{name}`, which was not given: give it, or mend `data` in the study"
            )));
        }
        let digest = |path: String, bytes: &[u8]| {
            let sha256 = sha256::hex(bytes).map_err(|error: io::Error| Refusal::Input(error.to_string()))?;
            Ok(FileRead { path, sha256: Some(sha256) })
        };
        let own = [
            (self.study.path.display().to_string(), self.study.text.as_bytes()),
            (self.chain_file.clone(), self.chain.text.as_bytes()),
        ];
        let named = self.tables().filter_map(|name| Some((name.to_owned(), bytes_of(name)?)));
        let read = own.into_iter().chain(named).map(|(path, bytes)| digest(path, bytes));
        let read: Vec<FileRead> = read.collect::<Result<_, Refusal>>()?;
        let mut open = |path: &str, options: &formats::Options| {
            let bytes = bytes_of(path).unwrap_or_else(|| unreachable!("every table was found above: {path}"));
            formats::open(bytes.to_vec(), path, options)
        };
        let mut calibrated = self.load(&mut open, warn)?.calibrate(made, tell)?;
        calibrated.was_read_from(read);
        Ok(calibrated)
    }
}

fn texts<'a, T: ToString + 'a>(doubts: impl IntoIterator<Item = &'a T>) -> Vec<String> {
    doubts.into_iter().map(ToString::to_string).collect()
}

impl Measured {
    /// Runs the loop; `tell` hears of each stage. Of the files that the texts came from nothing is known yet:
    /// [`Calibrated::was_read_from`].
    ///
    /// # Errors
    /// The study asks for something that cannot be fitted.
    pub fn calibrate(self, made: Made, tell: &(dyn Fn(Stage) + Sync)) -> Result<Calibrated, Refusal> {
        let Self { studied, loaded: Loaded { observations, held_out, sample, .. }, warnings } = self;
        let request = Request {
            text: &studied.chain.text,
            plan: &studied.plan,
            observations: &observations,
            sample: Some(&sample),
            second: held_out.as_ref(),
            when: &made.date,
        };
        let calibration = calibrate_telling(request, tell).map_err(Refusal::of)?;
        let Made { version, command, date } = made;
        let study = studied.study.text.clone();
        let provenance = Provenance { version, command, date, study, files: Vec::new(), warnings };
        let observed = sample.observed();
        Ok(Calibrated { calibration, studied, observations, observed, provenance })
    }
}

impl Calibrated {
    /// Takes up which files the texts came from, for the report.
    pub fn was_read_from(&mut self, files: Vec<FileRead>) {
        self.provenance.files = files;
    }

    /// The study that it came of.
    #[must_use]
    pub fn studied(&self) -> &Studied {
        &self.studied
    }

    /// The data that it was made from.
    #[must_use]
    pub fn observations(&self) -> &Observations {
        &self.observations
    }

    /// The instrument file, where a usable model came out; `valid_until` is the last day on which it is to count, as `2027-06-30`.
    #[must_use]
    pub fn instrument(&self, valid_until: Option<&str>) -> Option<String> {
        instrument::instrument(&self.reported(None), &self.observed, valid_until)
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
