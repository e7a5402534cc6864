//! The answers of the commands as values, for a program that has no command line: the Python package.
//!
//! Texts, names, units and words are those of the commands. What a command would warn of on standard error is returned by
//! [`collecting`]. Answers for programs are JSON, with the keys of `--format json`.

use std::path::Path;

use codegen::Form;
use model_core::expr::Expr;
use model_core::{Chain, ObservableId, SymbolKind, forms, print, syntax};
use serde_json::{Value, json};
use tables::formats::memory::Reader;
use tables::formats::{self, ColumnName, DataError, TableReader, declared_columns};

use crate::claims_file;
use crate::commands::{budget, simulate};
use crate::table_files::{self, Files};
use crate::told::plain;
use crate::{calibrating, report_files, terminal};
use claims::show::{Paint, as_json, as_text};
use service::budget::Measured;
use service::over_memory::{self, has_room};
use service::ranges::{self, Range, RangeArgument};
use service::source::observables;
use service::{errors_file, evaluation, formulas, poses};

pub use crate::calibrating::studied as read_study;
pub use crate::draw::stretches;
pub use crate::failure::Failure;
pub use crate::instruments::{compared, instrument, instrument_toml, ranges_of, values_of, verified};
pub use crate::source::read;
pub use crate::streaming::{Foretold, Rows, Streaming, accumulated, validated};
pub use crate::terminal::collecting;
pub use crate::told::Told;
pub use calibration::calibrate::Stage;
pub use codegen::Loadable;
pub use fit::Validation;
pub use report::Cells;
pub use service::apply::Counted;
pub use service::evaluation::{Exactness, Quantity};
pub use service::over_memory::{Columns, Computed, Held};
pub use service::{Calibrated, Instrument, Source, Studied};
pub use tables::formats::memory::Column;

/// A text read as a declaration for formulas alone: constants need no value.
///
/// # Errors
/// Every other mistake of the declaration, each with its place.
pub fn symbolic_chain(source: &Source) -> Result<Chain, Failure> {
    Ok(source.symbolic_chain(&terminal::warn)?)
}

/// Reads a file of errors, a box of largest sizes, or the same text from elsewhere.
///
/// # Errors
/// As the commands say of `--errors`.
pub fn values(errors: &Source, chain: &Chain) -> Result<Vec<f64>, Failure> {
    Ok(errors_file::values(errors, chain, &terminal::warn)?)
}

/// The observable of a name; without a name, the only one.
///
/// # Errors
/// A name that the chain does not declare, or no name where it declares several.
pub fn observable(chain: &Chain, name: Option<&str>) -> Result<ObservableId, Failure> {
    let chosen = observables(chain, &name.map(str::to_owned).into_iter().collect::<Vec<_>>())?;
    match chosen.as_slice() {
        &[only] => Ok(only),
        several => {
            let names = several.iter().map(|&id| chain.observable(id).name.as_str());
            let names = model_core::names::listed(names);
            Err(Failure::Input(format!("chain {} declares {names}: name one of them", chain.name)))
        }
    }
}

/// The joints and inputs that an observable depends on, in order of the chain.
#[must_use]
pub fn readings_of(chain: &Chain, observable: ObservableId) -> Vec<model_core::SymbolId> {
    evaluation::readings_of(chain, observable)
}

/// Which columns of these names have readings of joints and inputs.
#[must_use]
pub fn are_readings(chain: &Chain, columns: &[String]) -> Vec<bool> {
    let declared = declared_columns(chain);
    let declared: Vec<&str> = declared.iter().map(String::as_str).collect();
    let is_reading =
        |symbol: &&model_core::Symbol| matches!(symbol.kind, SymbolKind::Joint | SymbolKind::Input);
    let readings: Vec<_> = chain.symbols.iter().filter(is_reading).collect();
    let is_one = |name: &String| {
        let column = ColumnName::parse(name);
        readings.iter().any(|reading| column.means(&reading.name, &declared))
    };
    columns.iter().map(is_one).collect()
}

/// What a form is called in code that is generated of it.
#[must_use]
pub fn form_name(form: Form) -> &'static str {
    codegen::form_name(form)
}

/// Evaluators of some observables, or of all, in a language by its name, as `generate` writes them: the text of each file by its
/// ending.
///
/// # Errors
/// As the command says, or another language.
pub fn generated(
    source: &Source,
    chain: &Chain,
    language: &str,
    names: &[String],
) -> Result<Vec<(&'static str, String)>, Failure> {
    let files = formulas::files(source, chain, language, names)?;
    Ok(files.into_iter().map(|file| (file.extension, file.text)).collect())
}

/// The same of one observable in C, for a program that compiles it and loads it while it runs.
///
/// # Errors
/// As `generate` says.
pub fn loadable(source: &Source, chain: &Chain, observable: ObservableId) -> Result<Loadable, Failure> {
    Ok(formulas::loadable(source, chain, observable)?)
}

/// Refuses a form that an observable has not.
///
/// # Errors
/// As `generate` says.
pub fn derivable(chain: &Chain, observable: ObservableId, form: Form) -> Result<(), Failure> {
    codegen::derivable(chain.observable(observable), form).map_err(|error| Failure::Input(error.to_string()))
}

/// The closed form of an observable's error, component by component.
pub struct ClosedForm {
    /// What it is, in words.
    pub title: String,
    /// The names of the components: `pointing_x`, or `sky_azimuth`.
    pub names: Vec<String>,
    /// Every component with its name as `derive` prints it, in the plain syntax of amounts and in LaTeX.
    pub printed: [String; 2],
    /// The components in the plain syntax of amounts.
    pub text: Vec<String>,
    /// The components in LaTeX, in printed symbols.
    pub latex: Vec<String>,
    /// The components as trees, for other algebra systems.
    pub trees: Vec<Expr<std::ops::Range<usize>>>,
}

/// Derives a closed form: `order` 1, 2 or 3 in the errors.
///
/// # Errors
/// Another order, or a form with more terms than can be held.
pub fn closed_form(chain: &Chain, observable: ObservableId, order: u32) -> Result<ClosedForm, Failure> {
    if !(1..=3).contains(&order) {
        return Err(Failure::Input(format!("order {order}: closed forms are of order 1, 2 or 3")));
    }
    let form = forms::derive(chain, observable, order).map_err(|error| Failure::Input(error.to_string()))?;
    let shown =
        |style| form.components.iter().map(|component| component.show(chain, style)).collect::<Vec<_>>();
    let (text, latex) = (shown(print::Style::Text), shown(print::Style::Latex));
    let trees = text.iter().map(|text| {
        syntax::parse_amount(text)
            .map_err(|mistakes| Source::of_text("the closed form", text).mistakes(&mistakes))
    });
    let trees = trees.collect::<Result<_, _>>()?;
    let shown = chain.observable(observable);
    let names = shown.labels().map(|label| format!("{}_{label}", shown.name)).collect();
    let printed = [print::Style::Text, print::Style::Latex].map(|style| print::form(&form, chain, style));
    Ok(ClosedForm { title: formulas::title_of(chain, &form), names, printed, trees, text, latex })
}

/// What no data can tell apart; as `identify`.
///
/// # Errors
/// A name that the chain does not declare, or a candidate that cannot be read.
pub fn identified(chain: &Chain, names: &[String], candidate: Option<&str>) -> Result<Told, Failure> {
    let found = formulas::identified(chain, names, candidate, &terminal::warn)?;
    Ok(Told { text: found.texts.join("\n"), json: json!({ "identifiability": found.answers }) })
}

/// Ranges of joints and inputs by name, each as the command reads it behind the `=`: `-30 deg..60 deg`.
///
/// # Errors
/// As the commands say of `--range`.
pub fn ranges(chain: &Chain, given: &[(String, String)]) -> Result<Vec<Range>, Failure> {
    let arguments = given
        .iter()
        .map(|(name, bounds)| {
            format!("{name}={bounds}")
                .parse()
                .map_err(|why: &str| Failure::Input(format!("--range {name}={bounds}: {why}")))
        })
        .collect::<Result<Vec<RangeArgument>, _>>()?;
    Ok(ranges::of_chain(chain, &arguments, &terminal::warn)?)
}

/// Proven bounds on what the first order leaves out; as `bound`.
///
/// # Errors
/// As the command says.
pub fn bounded(
    chain: &Chain,
    sizes: &Source,
    names: &[String],
    ranges: &[Range],
    seed: u64,
) -> Result<Told, Failure> {
    let sizes = errors_file::largest_sizes(sizes, chain, &terminal::warn)?;
    let answers = formulas::bounds(chain, &sizes, ranges, names, seed, &terminal::warn)?;
    let texts = answers.iter().map(|(bound, found)| model_core::remainder::text(bound, Some(found), chain));
    let json: Vec<Value> =
        answers.iter().map(|(b, found)| formulas::bound_as_json(chain, b, found)).collect();
    Ok(Told { text: texts.collect::<Vec<_>>().join("\n"), json: json!({ "bounds": json }) })
}

/// What each error does over a path, or over ranges; as `budget`.
///
/// # Errors
/// As the command says.
pub fn budgeted(
    chain: &Chain,
    sizes: &Source,
    names: &[String],
    path: Option<&str>,
    ranges: &[Range],
) -> Result<Told, Failure> {
    use model_core::budget::Poses;
    let sizes = errors_file::largest_sizes(sizes, chain, &terminal::warn)?;
    let poses = match path {
        Some(text) => Poses::Path(
            poses::path(chain, text, &terminal::warn)
                .map_err(|mistake| Source::of_text("--path", text).mistake(mistake))?,
        ),
        None => Poses::Ranges(poses::joint_ranges(ranges)),
    };
    let budgets = budget::measured(chain, &sizes, &poses, names)?.into_iter();
    let budgets: Vec<Measured> =
        budgets.map(|budget| Measured { budget, designed: None, curves: None }).collect();
    let texts = budgets.iter().map(|one| plain(&service::budget::as_text(chain, one))).collect::<Vec<_>>();
    let json: Vec<Value> = budgets.iter().map(|one| service::budget::as_json(chain, one, &poses)).collect();
    Ok(Told { text: texts.join("\n"), json: json!({ "observables": json }) })
}

/// The verdicts on the claims of a file; as `check`.
///
/// # Errors
/// As the command says.
pub fn checked(claims: &Path) -> Result<Told, Failure> {
    let file = claims_file::read(claims)?;
    let checked = file.checked()?;
    let json: Vec<Value> = checked.iter().map(|checked| as_json(&file.said, checked)).collect();
    Ok(Told {
        text: plain(&as_text(&file.said, &checked, &Paint::default())),
        json: json!({ "claims": json }),
    })
}

/// Measured data that are made up; as `simulate`: names of columns, and the columns in SI.
///
/// # Errors
/// As the command says.
pub fn simulated(
    chain: &Chain,
    errors: &Source,
    noise: &[String],
    names: &[String],
    ranges: &[Range],
    (poses, seed): (usize, u64),
) -> Result<Vec<(String, Vec<f64>)>, Failure> {
    let values = errors_file::values(errors, chain, &terminal::warn)?;
    let mut simulation = simulate::Simulation::new(chain, &values, noise, names, ranges, seed)?;
    if !poses.checked_mul(simulation.header.len()).is_some_and(has_room) {
        return Err(Failure::Input(format!(
            "poses={poses}: so many rows of {} columns do not fit into memory: ask for fewer, or write them into a file with \
             `trueaxis simulate`",
            simulation.header.len()
        )));
    }
    let columns = simulation.rows(poses)?;
    Ok(simulation.header.into_iter().zip(columns).collect())
}

/// A study with a declaration that came from elsewhere than the file that it names.
///
/// # Errors
/// What is wrong with either, each with its place.
pub fn studied(study: Source, chain: Source) -> Result<Studied, Failure> {
    Ok(Studied::of(study, chain, &terminal::warn)?)
}

/// The observables over a table of readings, as `eval` computes them.
///
/// # Errors
/// As the command says of `--data` and `--observable`.
pub fn evaluated(
    chain: &Chain,
    errors: &Source,
    table: Held<'_>,
    names: &[String],
    quantity: (Exactness, Quantity),
) -> Result<Computed, Failure> {
    Ok(over_memory::evaluated(chain, errors, table, names, quantity, &terminal::warn)?)
}

/// The observables with their errors over a table of readings, as `apply` computes them, and how many rows are outside of what the
/// errors were found over.
///
/// # Errors
/// As the command says of `--data` and `--observable`.
pub fn applied(
    chain: &Chain,
    errors: &Source,
    table: Held<'_>,
    names: &[String],
) -> Result<(Computed, Counted), Failure> {
    Ok(over_memory::applied(chain, errors, table, names, &terminal::warn)?)
}

/// Warns as `apply` does of rows outside of what the errors were found over, which were counted table by table.
///
/// # Errors
/// As the command says of `--errors`.
pub fn warn_of_outside(chain: &Chain, errors: &Source, counted: &[Counted]) -> Result<(), Failure> {
    over_memory::outside_of_found(chain, errors, counted)?.iter().for_each(terminal::warn);
    Ok(())
}

/// A table of a name in memory.
///
/// # Errors
/// No columns, a name twice, or columns of different lengths.
pub fn table<'a>(
    name: &str,
    columns: &[(&'a str, Column<'a>)],
) -> Result<Box<dyn TableReader + 'a>, Failure> {
    Ok(Box::new(Reader::new(name, columns.iter().copied()).map_err(table_files::failure)?))
}

/// Reads a study's tables, from memory where `in_memory` has one of that name and else from the files, and calibrates.
/// `command` says in the report how it was asked for, and `tell` hears of each stage.
///
/// # Errors
/// As `calibrate` says.
pub fn calibrated(
    studied: Studied,
    in_memory: &[(&str, Vec<(&str, Column<'_>)>)],
    command: String,
    tell: &(dyn Fn(Stage) + Sync),
) -> Result<Calibrated, Failure> {
    let files = Files::of(&studied);
    let mut open = |path: &str, options: &formats::Options| -> Result<Box<dyn TableReader + '_>, DataError> {
        match in_memory.iter().find(|(name, _)| *name == path) {
            Some((name, columns)) => Ok(Box::new(Reader::new(name, columns.iter().copied())?)),
            None => files.open(path, options),
        }
    };
    let measured = studied.load(&mut open, &terminal::warn)?;
    calibrating::calibrate(measured, &files, command, tell)
}

/// A calibration as the terminal shows it, without its colours.
#[must_use]
pub fn text(calibrated: &Calibrated, is_verbose: bool) -> String {
    let layout = report::Layout { width: 100, verbose: is_verbose };
    plain(&report::as_text(&calibrated.reported(None), layout))
}

/// `report.json`.
///
/// # Errors
/// A number in it is none.
pub fn report_json(calibrated: &Calibrated) -> Result<String, Failure> {
    Ok(report::json(&calibrated.reported(None))?)
}

/// `errors.toml`, if a usable model came out.
#[must_use]
pub fn errors_toml(calibrated: &Calibrated) -> Option<String> {
    errors_file::errors(&calibrated.reported(None))
}

/// The values of every error of the amended chain, and of constants that were fitted, in SI with its unit, if a usable model came out.
#[must_use]
pub fn estimates(calibrated: &Calibrated) -> Option<Vec<(String, f64, &'static str)>> {
    let calibration = &calibrated.calibration;
    calibration.amended.as_ref()?;
    let chain = &calibration.chain;
    let nominal = chain.nominal_values();
    let values = chain.symbols.iter().zip(&calibration.after.values).zip(nominal);
    let told = values.filter(|((symbol, value), nominal)| match symbol.kind {
        SymbolKind::Error => true,
        SymbolKind::Constant => *value != nominal,
        _ => false,
    });
    Some(told.map(|((symbol, &value), _)| (symbol.name.clone(), value, symbol.quantity.unit())).collect())
}

/// The ranges of the readings that a calibration was found over, SI, if a usable model came out: `[found-over]` of `errors.toml`.
#[must_use]
pub fn found_over(calibrated: &Calibrated) -> Option<Vec<(String, f64, f64)>> {
    let over = errors_file::found_over_of(&calibrated.reported(None))?;
    let name = |id| calibrated.calibration.chain.symbol(id).name.clone();
    Some(over.iter().map(|range| (name(range.symbol), range.low, range.high)).collect())
}

/// `report.html`; or only its first screen and its pictures.
#[must_use]
pub fn report_html(calibrated: &Calibrated, is_whole: bool) -> String {
    let reported = calibrated.reported(None);
    if is_whole { report::page(&reported) } else { report::excerpt(&reported) }
}

/// `residuals.csv` of every row, as columns that `visit` sees.
pub fn residuals<T>(calibrated: &Calibrated, visit: impl FnOnce(Vec<(String, Cells<'_>)>) -> T) -> T {
    let reported = calibrated.reported(None);
    visit(report::table(&reported, &report::rows_written(&reported, true)))
}

/// Writes every file of a calibration into a folder; they appear together, or not at all. Of very many rows `residuals.csv` has a part,
/// unless all residuals are asked for.
///
/// # Errors
/// The folder or a file cannot be written, or is one that the study reads.
pub fn write(calibrated: &Calibrated, folder: &Path, all_residuals: bool) -> Result<(), Failure> {
    calibrating::refuse_to_replace(calibrated.studied(), folder)?;
    let name = folder.display().to_string();
    let reported = calibrated.reported(Some(&name));
    let instrument = calibrated.instrument(None);
    report_files::write_all(&reported, &report::rows_written(&reported, all_residuals), instrument, folder)
}
