//! Files with texts that the user wrote, read whole.

use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use model_core::{Chain, Quantity, SymbolId, SymbolKind, names};
use service::ranges::{self, Range, RangeArgument};
use service::{Instrument, Source, errors_file};

use crate::failure::Failure;
use crate::sizes::SizesArgument;
use crate::{date, terminal};

/// Reads a file; `-` is standard input.
///
/// # Errors
/// The file cannot be read or is not UTF-8; a name that is not there comes with the nearest that is.
pub fn read(path: &Path) -> Result<Source, Failure> {
    let text =
        if path == Path::new("-") { limited(io::stdin().lock()) } else { File::open(path).and_then(limited) };
    match text {
        Ok(text) => Ok(Source::of_text(path, &text)),
        Err(error) => Err(not_readable(path, &error)),
    }
}

/// Reads a file that another file names: relative to that one's folder.
///
/// # Errors
/// As [`read`].
pub fn read_beside(source: &Source, path: &Path) -> Result<Source, Failure> {
    read(&source.beside(path))
}

/// Reads a declaration; warns of what is doubtful of it.
///
/// # Errors
/// As [`read`]; and every mistake of the declaration, each with its place.
pub fn chain(path: &Path) -> Result<Chain, Failure> {
    Ok(read(path)?.chain(&terminal::warn)?)
}

/// Reads an instrument file, and nothing else; a date behind which it does not count is no matter here.
///
/// # Errors
/// As [`read`]; another kind of file; and the mistakes of the file, each with its place.
pub fn instrument(path: &Path) -> Result<Instrument, Failure> {
    instrument_of(&read(path)?)
}

/// The same of a text that was read.
///
/// # Errors
/// Another kind of file; and the mistakes of the file, each with its place.
pub fn instrument_of(source: &Source) -> Result<Instrument, Failure> {
    if !source.is_instrument() {
        return Err(Failure::Input(format!(
            "`{}` is no instrument file: give the `instrument.toml` that `trueaxis calibrate` writes",
            source.path.display()
        )));
    }
    Ok(Instrument::of(source, &terminal::warn)?)
}

/// A declaration, or an instrument file in its place.
pub struct Declared {
    /// The text of the declaration.
    pub source: Source,
    /// The declaration; of an instrument with the constants of its calibration.
    pub chain: Chain,
    /// The instrument, if its file was given.
    pub instrument: Option<Instrument>,
}

impl Declared {
    /// Reads it; warns of what is doubtful of it, and of an instrument whose date is over.
    ///
    /// # Errors
    /// As [`read`]; and the mistakes of the file, each with its place.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let source = read(path)?;
        if !source.is_instrument() {
            let chain = source.chain(&terminal::warn)?;
            return Ok(Self { source, chain, instrument: None });
        }
        let instrument = Instrument::of(&source, &terminal::warn)?;
        instrument.expired(&date::today()).iter().for_each(terminal::warn);
        let (source, chain) = (instrument.declaration.clone(), instrument.chain.clone());
        Ok(Self { source, chain, instrument: Some(instrument) })
    }

    /// The largest sizes of its errors, SI: those of the file that is named, or what an instrument knows of them.
    ///
    /// # Errors
    /// The file cannot be read or has a mistake; none is named beside a declaration.
    pub fn sizes(&self, argument: &SizesArgument) -> Result<Vec<f64>, Failure> {
        let named = argument.given();
        let (None, Some(instrument)) = (named, &self.instrument) else {
            let file = read(named.map_or_else(|| argument.needed(), Ok)?)?;
            return Ok(errors_file::largest_sizes(&file, &self.chain, &terminal::warn)?);
        };
        let uncertain = instrument.covariance.as_ref();
        let is_alone = |id: &SymbolId| uncertain.and_then(|own| own.standard_uncertainty(*id)).is_none();
        let of_alone = match self.chain.symbols_of(SymbolKind::Error).filter(is_alone).count() {
            0 => String::new(),
            1 => "; the value alone of 1 error that the data do not determine by itself".to_owned(),
            count => format!("; the value alone of {count} errors that the data do not determine one by one"),
        };
        terminal::note(format_args!(
            "sizes of errors: the value plus two standard uncertainties{of_alone}. Give others with --sizes BOX.toml"
        ));
        Ok(instrument.sizes())
    }

    /// The ranges of its joints and inputs that were typed; what has no full turn takes that which an instrument was measured over.
    ///
    /// # Errors
    /// As [`ranges::of_chain`].
    pub fn ranges(&self, arguments: &[RangeArgument]) -> Result<Vec<Range>, Failure> {
        let mut all = ranges::of_chain(&self.chain, arguments, &terminal::warn)?;
        for found in self.instrument.iter().flat_map(|instrument| &instrument.found) {
            let symbol = self.chain.symbol(found.symbol);
            let turns = symbol.kind == SymbolKind::Joint && symbol.quantity == Quantity::Angle;
            if !turns && !all.iter().any(|range| range.symbol == found.symbol) {
                all.push(Range { symbol: found.symbol, low: found.low, high: found.high });
            }
        }
        Ok(all)
    }
}

/// The longest declaration, claims, errors or study file, in bytes: beyond any that a person writes.
const LONGEST_TEXT: u64 = 16 << 20;

/// The whole of a text, if it is no longer than texts are.
fn limited(file: impl io::Read) -> io::Result<String> {
    let mut text = String::new();
    file.take(LONGEST_TEXT + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LONGEST_TEXT {
        return Err(io::Error::other("it is longer than 16 MiB; is it the right file?"));
    }
    Ok(text)
}

/// Why a file cannot be read, with the nearest name in its folder if it is not there.
pub fn not_readable(path: &Path, error: &io::Error) -> Failure {
    let mut failure = Failure::read(path, error);
    if let Failure::Read { why, .. } = &mut failure
        && error.kind() == io::ErrorKind::NotFound
    {
        *why = nearest_file(path).map_or_else(
            || format!("{why}; check its name and its folder"),
            |near| format!("{why}; did you mean `{}`?", near.display()),
        );
    }
    failure
}

/// The file in the same folder whose name is nearest to the one asked for.
fn nearest_file(path: &Path) -> Option<PathBuf> {
    let folder = match path.parent()? {
        parent if parent == Path::new("") => Path::new("."),
        parent => parent,
    };
    let mut there: Vec<String> =
        fs::read_dir(folder).ok()?.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    there.sort();
    let near = names::nearest(path.file_name()?.to_str()?, there.iter().map(String::as_str))?;
    Some(path.with_file_name(near))
}
