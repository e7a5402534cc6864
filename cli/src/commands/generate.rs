//! `trueaxis generate`: evaluators of a chain in another language.

use std::path::{Path, PathBuf};

use codegen::{Form, Unit};
use model_core::remainder::{self, Domain};
use model_core::{Chain, ObservableId, ObservableKind, SymbolKind};

use super::Answer;
use crate::errors_file;
use crate::failure::Failure;
use crate::output;
use crate::source::{Source, observables};

/// Generate evaluators in another language.
///
/// Writes functions for the value, the exact error, the first-order error and both Jacobians of the observables, for
/// one pose and for arrays of poses; what depends on the errors alone is prepared once. The file needs nothing but
/// its language.
///
/// Example: trueaxis generate examples/mobile-lidar/mobile-lidar.chain --language rust --observable pointing
/// --out mobile_lidar.rs
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The declaration
    chain: PathBuf,
    /// The language to write
    #[arg(long, value_enum)]
    language: Language,
    /// Only this observable (may be given several times); default: every one
    #[arg(long)]
    observable: Vec<String>,
    /// Largest sizes of the errors: the file then states how far the first order can be off
    #[arg(long, value_name = "BOX.toml")]
    errors: Option<PathBuf>,
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

/// What is computed of the observables, a function each.
const FORMS: [Form; 5] = [
    Form::ExactValue,
    Form::ExactError,
    Form::FirstOrderError,
    Form::ExactJacobian,
    Form::FirstOrderJacobian,
];

/// Runs the command.
pub fn run(arguments: &Arguments) -> Result<Answer, Failure> {
    let source = Source::read(&arguments.chain)?;
    let chain = source.chain()?;
    let chosen = observables(&chain, &arguments.observable)?;
    let remainders = match &arguments.errors {
        Some(path) => remainders(&chain, &chosen, path)?,
        None => Vec::new(),
    };
    let unit = Unit {
        chain: &chain,
        declaration: &source.text,
        observables: &chosen,
        forms: &FORMS,
        remainders: &remainders,
    };
    let name = arguments.out.file_stem().unwrap_or_default().to_string_lossy();
    let files = codegen::generate(&unit, arguments.language.into(), &name);
    if arguments.out == Path::new("-") && files.len() > 1 {
        let message =
            format!("this language takes {} files; name one with --out, the rest lie beside it", files.len());
        return Err(Failure::Input(message));
    }
    let mut batch = output::Batch::default();
    for (index, file) in files.iter().enumerate() {
        let beside = arguments.out.with_extension(file.extension);
        if index > 0 && beside.as_os_str().eq_ignore_ascii_case(&arguments.out) {
            let message = format!(
                "`{}` is the name of the file that belongs beside it; give --out another ending",
                arguments.out.display()
            );
            return Err(Failure::Input(message));
        }
        let path = if index == 0 { &arguments.out } else { &beside };
        let read = [Some(&arguments.chain), arguments.errors.as_ref()];
        output::refuse_to_replace(path, read.into_iter().flatten().map(PathBuf::as_path))?;
        batch.write_text(path, &file.text)?;
    }
    batch.finish()?;
    Ok(Answer::Done)
}

/// What is proven of the first order, in words for the generated file; nothing for observables without a bound.
fn remainders(
    chain: &Chain,
    chosen: &[ObservableId],
    sizes: &Path,
) -> Result<Vec<(ObservableId, String)>, Failure> {
    let by_symbol = errors_file::largest_sizes(&Source::read(sizes)?, chain)?;
    let mut domain = Domain::new(chain);
    for error in chain.symbols_of(SymbolKind::Error) {
        domain
            .set_size(chain, error, by_symbol[error.index()])
            .map_err(|error| Failure::Input(error.to_string()))?;
    }
    let in_words = |id: ObservableId| {
        let bound = remainder::bound(chain, id, &domain).ok()?;
        let unit = match chain.observable(id).kind {
            ObservableKind::Direction => "",
            ObservableKind::Point => " m",
        };
        let sizes = sizes.file_name().unwrap_or(sizes.as_os_str()).display();
        Some((id, format!("off by at most {:.3e}{unit} while errors stay within {sizes}", bound.value)))
    };
    Ok(chosen.iter().copied().filter_map(in_words).collect())
}
