//! `trueaxis generate`: evaluators of a chain in another language.

use std::path::{Path, PathBuf};

use codegen::{Form, Precision, Unit};
use model_core::remainder::{self, Domain};
use model_core::{Chain, ObservableId, SymbolKind};
use service::formulas::EVERY_FORM;
use service::source::observables;
use service::{Refusal, errors_file};

use super::Answer;
use crate::expected::{self, Work};
use crate::failure::Failure;
use crate::sizes::SizesArgument;
use crate::source::Declared;
use crate::{output, source, terminal};

/// Generate evaluators in another language.
///
/// Writes functions for the value, the exact error, the first-order error and both Jacobians of the observables, for
/// one pose and for arrays of poses; what depends on the errors alone is prepared once. The file needs nothing but
/// its language. With --sizes it states them, and how far the first order can be off there.
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
    /// Equations, to be included in a document
    Latex,
    /// Python with NumPy
    Numpy,
    /// A JavaScript module
    Javascript,
}

impl From<Language> for codegen::Language {
    fn from(language: Language) -> Self {
        match language {
            Language::Rust => Self::Rust,
            Language::C => Self::C,
            Language::Latex => Self::Latex,
            Language::Numpy => Self::Numpy,
            Language::Javascript => Self::Javascript,
        }
    }
}

/// A precision of `codegen`, as the command line names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum PrecisionName {
    /// Double
    F64,
    /// Single, for processors that have no double (Rust and C, functions of one pose)
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
}

impl From<FormName> for Form {
    fn from(form: FormName) -> Self {
        match form {
            FormName::ExactValue => Self::ExactValue,
            FormName::ExactError => Self::ExactError,
            FormName::FirstOrderError => Self::FirstOrderError,
            FormName::ExactJacobian => Self::ExactJacobian,
            FormName::FirstOrderJacobian => Self::FirstOrderJacobian,
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
    let values = match (&arguments.values, instrument) {
        (Some(path), _) => errors_file::named_values(&source::read(path)?, &chain, &terminal::warn)?,
        (None, Some(instrument)) => instrument.named,
        (None, None) => Vec::new(),
    };
    let forms = match arguments.only.as_slice() {
        [] => EVERY_FORM.to_vec(),
        only => only.iter().map(|&form| form.into()).collect(),
    };
    let unit = Unit {
        values: &values,
        rows: !arguments.no_rows,
        precision: arguments.precision.into(),
        remarks: &remarks,
        ..Unit::new(&chain, &source.text, &chosen, &forms)
    };
    let name = arguments.out.file_stem().unwrap_or_default().to_string_lossy();
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
