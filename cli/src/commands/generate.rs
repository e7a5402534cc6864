//! `trueaxis generate`: evaluators of a chain in another language.

use std::path::{Path, PathBuf};

use codegen::{Calibrated, Covariance, Form, Precision, Unit};
use model_core::remainder::{self, Domain};
use model_core::{Chain, ObservableId, SymbolKind};
use service::apply::region;
use service::formulas::forms_of;
use service::source::observables;
use service::{Instrument, Refusal, errors_file};

use super::Answer;
use crate::expected::{self, Work};
use crate::failure::Failure;
use crate::sizes::SizesArgument;
use crate::source::Declared;
use crate::{date, output, source, terminal};

/// Generate evaluators in another language.
///
/// Writes functions for the value, the exact error, the first-order error and both Jacobians of the observables, for
/// one pose and for arrays of poses; what depends on the errors alone is prepared once. The file needs nothing but
/// its language, and JAX or NumPy where these are asked for. With --sizes it states them, and how far the first order can
/// be off there.
///
/// Of an instrument file it also writes the standard uncertainty of the observables and the last day on which the calibration
/// counts. Another function says whether a pose lies in the measured region.
///
/// Example: trueaxis generate examples/mobile-lidar/mobile-lidar.chain --language rust --observable pointing
/// --out mobile_lidar.rs
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration; or an instrument file, whose errors and constants are written into the file
    chain: PathBuf,
    /// The language to write
    #[arg(long, value_enum)]
    language: Language,
    /// Only this observable (may be given several times); default: every one
    #[arg(long)]
    observable: Vec<String>,
    /// Only this form (may be given several times); default: every one
    #[arg(long, value_enum, value_name = "FORM")]
    only: Vec<FormName>,
    /// Precision of the numbers that the file computes with
    #[arg(long, value_enum, default_value_t = PrecisionName::F64)]
    precision: PrecisionName,
    /// Only functions of one pose, none of many
    #[arg(long)]
    no_rows: bool,
    /// Values of errors and constants that are written into the file, as `calibrate` puts them out; it has no fields for
    /// the errors named there
    #[arg(long, value_name = "ERRORS.toml")]
    values: Option<PathBuf>,
    #[command(flatten)]
    sizes: SizesArgument,
    /// Refuse an instrument file whose last day is over or that names none; default: warn of a day that is over
    #[arg(long)]
    valid: bool,
    /// Where to write; what belongs beside it (a header) goes into the same folder; - is standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// A language of `codegen`, as the command line names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Language {
    /// Rust that needs nothing but core
    Rust,
    /// C99, with its header
    C,
    /// C++17: the source of C, with headers
    Cpp,
    /// Equations, to be included in a document
    Latex,
    /// Python with NumPy
    Numpy,
    /// A JavaScript module
    Javascript,
    /// A function file of MATLAB and Octave
    Matlab,
    /// Python with JAX
    Jax,
}

impl From<Language> for codegen::Language {
    fn from(language: Language) -> Self {
        match language {
            Language::Rust => Self::Rust,
            Language::C => Self::C,
            Language::Cpp => Self::Cpp,
            Language::Latex => Self::Latex,
            Language::Numpy => Self::Numpy,
            Language::Javascript => Self::Javascript,
            Language::Matlab => Self::Matlab,
            Language::Jax => Self::Jax,
        }
    }
}

/// A precision of `codegen`, as the command line names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum PrecisionName {
    /// Double
    F64,
    /// Single, for processors that have no double (Rust, C and C++, functions of one pose)
    F32,
}

impl From<PrecisionName> for Precision {
    fn from(precision: PrecisionName) -> Self {
        match precision {
            PrecisionName::F64 => Self::Double,
            PrecisionName::F32 => Self::Single,
        }
    }
}

/// A form of `codegen`, as the command line names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum FormName {
    /// The observables with errors
    ExactValue,
    /// What the errors add to them
    ExactError,
    /// The part of that which is linear in the errors
    FirstOrderError,
    /// Derivatives by the errors, at the errors given
    ExactJacobian,
    /// Derivatives by the errors, where these are zero
    FirstOrderJacobian,
    /// Standard uncertainty of the observables, by the covariance of an instrument file
    Uncertainty,
}

impl From<FormName> for Form {
    fn from(form: FormName) -> Self {
        match form {
            FormName::ExactValue => Self::ExactValue,
            FormName::ExactError => Self::ExactError,
            FormName::FirstOrderError => Self::FirstOrderError,
            FormName::ExactJacobian => Self::ExactJacobian,
            FormName::FirstOrderJacobian => Self::FirstOrderJacobian,
            FormName::Uncertainty => Self::Uncertainty,
        }
    }
}

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let Declared { source, chain, instrument } = Declared::read(&arguments.chain)?;
    let waiting = expected::announce(&chain, Work::Generate);
    let chosen = observables(&chain, &arguments.observable)?;
    let sizes = arguments.sizes.given();
    let remarks = match sizes {
        Some(path) => remarks(&chain, &chosen, path)?,
        None => Vec::new(),
    };
    if arguments.valid {
        refuse_invalid(&arguments.chain, instrument.as_ref())?;
    }
    let values = match (&arguments.values, &instrument) {
        (Some(path), _) => errors_file::named_values(&source::read(path)?, &chain, &terminal::warn)?,
        (None, Some(instrument)) => instrument.named.clone(),
        (None, None) => Vec::new(),
    };
    // Other values than the calibration's are as sure as nobody knows.
    let calibration = instrument.as_ref().filter(|_| arguments.values.is_none());
    let region = calibration.map(|instrument| region(instrument, &chosen)).transpose()?.unwrap_or_default();
    let covariance = calibration.and_then(|instrument| instrument.covariance.as_ref());
    let calibrated = Calibrated {
        covariance: covariance.map(|known| Covariance { of: &known.of, rows: &known.rows }),
        region: &region,
        valid_until: calibration.and_then(|instrument| instrument.valid_until.as_deref()),
    };
    let forms = match arguments.only.as_slice() {
        [] => forms_of(&chain, &chosen, covariance.is_some() && arguments.precision == PrecisionName::F64),
        only => only.iter().map(|&form| form.into()).collect(),
    };
    let unit = Unit {
        values: &values,
        rows: !arguments.no_rows,
        precision: arguments.precision.into(),
        remarks: &remarks,
        calibrated,
        ..Unit::new(&chain, &source.text, &chosen, &forms)
    };
    let name = match arguments.out.to_str() {
        Some("-") => codegen::snake_case(&chain.name),
        _ => arguments.out.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
    };
    let files = codegen::generate(&unit, arguments.language.into(), &name).map_err(Refusal::of)?;
    drop(waiting);
    if arguments.out == Path::new("-") && files.len() > 1 {
        let message =
            format!("this language takes {} files; name one with --out, the rest lie beside it", files.len());
        return Err(Failure::Input(message));
    }
    let beside: Vec<PathBuf> =
        files.iter().map(|file| arguments.out.with_extension(file.extension)).collect();
    let same = |beside: &&PathBuf| beside.as_os_str().eq_ignore_ascii_case(&arguments.out);
    if let Some(own) = beside.iter().skip(1).find(same) {
        let message = format!(
            "`{}` is where the header goes: name the source with --out, as `{}`",
            own.display(),
            beside.first().unwrap_or(own).display()
        );
        return Err(Failure::Input(message));
    }
    let mut batch = output::Batch::default();
    for (index, (file, beside)) in files.iter().zip(&beside).enumerate() {
        let path = if index == 0 { &arguments.out } else { beside };
        let read = [Some(arguments.chain.as_path()), arguments.values.as_deref(), sizes];
        output::refuse_to_replace(path, read.into_iter().flatten())?;
        batch.write_text(path, &file.text)?;
    }
    batch.finish()?;
    Ok(Answer::Done)
}

/// Refuses what is no calibration, or none that counts today.
fn refuse_invalid(path: &Path, instrument: Option<&Instrument>) -> Result<(), Failure> {
    let file = path.display();
    let Some(instrument) = instrument else {
        return Err(Failure::Input(format!(
            "--valid asks for an instrument file, and `{file}` is a declaration"
        )));
    };
    if instrument.valid_until.is_none() {
        return Err(Failure::Input(format!(
            "`{file}` does not say until when it is valid: write its last day, as valid-until = 2027-06-30, or leave --valid out"
        )));
    }
    match instrument.expired(&date::today()) {
        Some(why) => Err(Failure::Input(why)),
        None => Ok(()),
    }
}

/// The box of errors that a generated file speaks of, and what is proven of the first order there; nothing for observables
/// without a bound.
fn remarks(chain: &Chain, chosen: &[ObservableId], sizes: &Path) -> Result<Vec<String>, Failure> {
    let by_symbol = errors_file::largest_sizes(&source::read(sizes)?, chain, &terminal::warn)?;
    let mut domain = Domain::new(chain);
    for error in chain.symbols_of(SymbolKind::Error) {
        domain
            .set_size(chain, error, by_symbol[error.index()])
            .map_err(|error| Failure::Input(error.to_string()))?;
    }
    let file = sizes.file_name().unwrap_or(sizes.as_os_str()).display();
    let mut lines = Vec::new();
    for &id in chosen {
        let Ok(bound) = remainder::bound(chain, id, &domain) else { continue };
        let unit = match remainder::unit(&bound, chain) {
            "1" => String::new(),
            unit => format!(" {unit}"),
        };
        let (name, bound) = (&chain.observable(id).name, bound.value);
        lines.push(format!(
            "First order, {name}: off by at most {bound:.3e}{unit} while errors stay within {file}, proven."
        ));
    }
    lines.push(format!("Largest sizes in {file}; all other errors are zero there:"));
    for error in chain.symbols_of(SymbolKind::Error) {
        let (symbol, size) = (chain.symbol(error), by_symbol[error.index()]);
        if size > 0.0 {
            lines.push(format!("    {} {size:e} {}", symbol.name, symbol.quantity.unit()));
        }
    }
    Ok(lines)
}
