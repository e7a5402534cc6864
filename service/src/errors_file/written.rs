//! Estimates as an errors file, which `apply`, `eval` and `calibrate` read again.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use calibration::diagnose::ErrorFound;
use model_core::{Chain, Quantity, SymbolKind};
use observe::Observations;
use report::Reported;
use report::words::numbers;

use super::{FOUND_OVER, FoundOver};

/// `errors.toml`, where a usable model came out.
#[must_use]
pub fn errors(reported: &Reported<'_>) -> Option<String> {
    let calibration = reported.calibration;
    let date = &reported.provenance.date;
    let values = &calibration.after.values;
    let over = found_over(reported)?;
    Some(errors_toml(&calibration.diagnosis.errors, &calibration.chain, values, date, &over))
}

/// The ranges of the readings that an amended declaration was found over, if a usable model came out.
#[must_use]
pub fn found_over(reported: &Reported<'_>) -> Option<Vec<FoundOver>> {
    let calibration = reported.calibration;
    let amended = Chain::from_text(calibration.amended.as_ref()?).unwrap_or_else(|mistakes| {
        unreachable!("an amended text is read before it is given out: {mistakes}")
    });
    let mut over = ranges_of(&calibration.chain, reported.observations, &calibration.after.residuals.weight);
    // A side quantity that no effect needed is none of the amended chain's.
    over.retain(|range| amended.find_symbol(&calibration.chain.symbol(range.symbol).name).is_some());
    Some(over)
}

/// Every value of a calibrated model that differs from what its declaration says, each with a remark for people; and the
/// ranges of the readings that it was found from.
fn errors_toml(
    found: &[ErrorFound],
    chain: &Chain,
    values: &[f64],
    date: &str,
    over: &[FoundOver],
) -> String {
    let title = format!(
        "# Errors of {}, calibrated on {date}; for `trueaxis eval`, `trueaxis apply` and amended.chain.\n",
        chain.name
    );
    let lines = lines(found, chain, values).into_iter().map(|(_, line)| line);
    std::iter::once(title).chain(lines).collect::<String>() + &ranges_of_readings(chain, over)
}

/// The lines of a usable model, each with what its symbol is.
pub(crate) fn lines_of(reported: &Reported<'_>) -> Vec<(SymbolKind, String)> {
    let calibration = reported.calibration;
    lines(&calibration.diagnosis.errors, &calibration.chain, &calibration.after.values)
}

fn lines(found: &[ErrorFound], chain: &Chain, values: &[f64]) -> Vec<(SymbolKind, String)> {
    let width = found.iter().map(|error| key(&error.name).chars().count()).max().unwrap_or_default();
    let mut lines = Vec::new();
    // In the order of the declaration, whatever a report tells first.
    let mut found: Vec<&ErrorFound> = found.iter().collect();
    found.sort_by_key(|error| chain.find_symbol(&error.name));
    for error in found.iter().copied() {
        let symbol = chain.find_symbol(&error.name).map(|id| chain.symbol(id));
        // The unit is that of the language's quantity, which is what reads the file again.
        let quantity = symbol.map_or(Quantity::Number, |symbol| symbol.quantity);
        let value = written_value(error.value, quantity);
        let line = format!("{:width$} = {value:32} # {}\n", key(&error.name), remark(error));
        lines.push((symbol.map_or(SymbolKind::Error, |symbol| symbol.kind), line));
    }
    // Errors that were held at a value belong to the model as much as those that were estimated.
    for (symbol, &value) in chain.symbols.iter().zip(values) {
        let estimated = found.iter().any(|error| error.name == symbol.name);
        if symbol.kind == SymbolKind::Error && value != 0.0 && !estimated {
            let value = written_value(value, symbol.quantity);
            let line = format!("{:width$} = {value:32} # held at this value\n", key(&symbol.name));
            lines.push((symbol.kind, line));
        }
    }
    lines
}

/// The table of the ranges of the readings; empty where there are none.
pub(crate) fn ranges_of_readings(chain: &Chain, over: &[FoundOver]) -> String {
    let mut text = String::new();
    if !over.is_empty() {
        let _ = writeln!(
            text,
            "\n# The readings that this was found from; `trueaxis apply` says which rows are outside.\n[{FOUND_OVER}]"
        );
    }
    for range in over {
        let symbol = chain.symbol(range.symbol);
        let [low, high] = [range.low, range.high].map(|bound| written_value(bound, symbol.quantity));
        let _ = writeln!(text, "{} = [{low}, {high}]", key(&symbol.name));
    }
    text
}

/// The ranges of the readings of the rows that count, SI; nothing of a column without a finite number.
fn ranges_of(chain: &Chain, observations: &Observations, weight: &[f64]) -> Vec<FoundOver> {
    let mut ranges = Vec::new();
    for (symbol, column) in &observations.poses.columns {
        let counted = column.iter().zip(weight).filter(|(value, weight)| value.is_finite() && **weight > 0.0);
        let mut values: Vec<f64> = counted.map(|(value, _)| *value).collect();
        values.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else { continue };
        let declared = chain.symbol(*symbol);
        let is_joint = declared.kind == SymbolKind::Joint && declared.quantity == Quantity::Angle;
        let high = if is_joint && is_round(&values) { low + TAU } else { high };
        ranges.push(FoundOver { symbol: *symbol, low, high });
    }
    ranges
}

/// Whether readings, sorted, rad, go round the circle: what lies between the last and the first is no more than between two others.
fn is_round(values: &[f64]) -> bool {
    let widest = values.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    let (Some(low), Some(high)) = (values.first(), values.last()) else { return false };
    let left = TAU - (high - low);
    left > 0.0 && left <= widest
}

/// A name as a key of TOML: quoted where it has letters that a bare key cannot have.
pub(crate) fn key(name: &str) -> String {
    if name.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_') {
        name.to_owned()
    } else {
        format!("\"{name}\"")
    }
}

/// A value as TOML has it: a number, or a string with a unit.
pub(crate) fn written_value(value: f64, quantity: Quantity) -> String {
    match quantity {
        Quantity::Number => format!("{value:?}"),
        quantity => format!("\"{value:?} {}\"", quantity.unit()),
    }
}

fn remark(error: &ErrorFound) -> String {
    match (error.standard_uncertainty, error.shown) {
        (Some(sigma), _) => match error.moves_by_cause {
            Some(moves) => numbers::by_cause(error.value, sigma, moves, error.unit),
            None => numbers::estimate(error.value, sigma, error.unit),
        },
        (None, true) => {
            format!("{}, determined only together with others", numbers::told(error.value, error.unit))
        }
        (None, false) => "not shown by the data".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    #[test]
    fn readings_all_round_leave_no_gap_where_the_circle_is_cut() {
        let round: Vec<f64> = (-179..180).step_by(2).map(|degrees| f64::from(degrees).to_radians()).collect();
        assert!(is_round(&round));
        assert!(!is_round(&round[..round.len() - 4]));
        assert!(!is_round(&[]) && !is_round(&[0.1]));
    }

    use calibration::amend::{Addition, amend, with_quantities_of};
    use effects::candidate::Setting;
    use effects::catalogue::catalogue;
    use model_core::SymbolId;
    use observe::SiUnit;
    use proptest::prelude::*;

    use super::*;
    use crate::errors_file;
    use crate::source::Source;

    /// Declarations that have side quantities beside their joints.
    const CHAINS: [(&str, &str); 5] = [
        (include_str!("../../../examples/mobile-lidar/mobile-lidar.chain"), "pointing"),
        (include_str!("../../../examples/mobile-lidar/mobile-lidar.chain"), "target"),
        (include_str!("../../../examples/alt-azimuth/alt-azimuth.chain"), "sight"),
        (include_str!("../../../examples/equatorial/equatorial.chain"), "sight"),
        (include_str!("../../../examples/turntable/turntable.chain"), "pointing"),
    ];

    proptest! {
        #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]
        /// Whatever effect was added, and whatever its coefficients, the file is read to the last bit.
        #[test]
        fn what_is_written_is_read_again(
            which in 0..CHAINS.len(),
            picks in proptest::collection::vec(any::<prop::sample::Index>(), 1..4),
            values in proptest::collection::vec(-1e9_f64..1e9, 8),
            scale in -20_i32..3,
        ) {
            let (text, observable) = CHAINS[which];
            let text = text.replacen('{', "{ input temperature; input elapsed; input night_2; input δ; ", 1);
            let chain = Chain::from_text(&text).unwrap();
            let observables = [chain.find_observable(observable).unwrap()];
            let inputs: Vec<SymbolId> = chain.symbols_of(SymbolKind::Input).collect();
            let setting = Setting {
                chain: &chain,
                observables: &observables,
                inputs: &inputs,
                harmonics: 3,
                lines: &[],
                own: &[],
            };
            let catalogue = catalogue(&setting);
            let mut amended = chain.clone();
            let mut additions = Vec::new();
            for pick in picks {
                let effect = &catalogue[pick.index(catalogue.len())];
                let (with, errors) = effect.add_to(&amended).unwrap();
                amended = with;
                additions.extend(effect.texts(&amended, &errors).into_iter().map(|(spot, text)| {
                    Addition { spot, text, documentation: Vec::new() }
                }));
            }
            let text = amend(&text, &amended, &additions, &[]).unwrap();
            let amended = with_quantities_of(amended, &text).unwrap();
            let found: Vec<ErrorFound> = amended
                .symbols_of(SymbolKind::Error)
                .zip(values.iter().cycle())
                .map(|(id, value)| ErrorFound {
                    name: amended.symbol(id).name.clone(),
                    value: value * 10_f64.powi(scale),
                    standard_uncertainty: Some(1e-6),
                    moves_by_cause: None,
                    degrees_of_freedom: None,
                    over_noise: 0.0,
                    unit: SiUnit::RAD.per(SiUnit::KELVIN),
                    separable: true,
                    shown: true,
                })
                .collect();
            let nominal = amended.nominal_values();
            let over: Vec<FoundOver> = inputs
                .iter()
                .map(|&symbol| FoundOver { symbol, low: -values[0].abs(), high: values[1].abs() })
                .collect();
            let written = errors_toml(&found, &amended, &nominal, "2026-11-21", &over);
            let read = Chain::from_text(&text).unwrap();
            let source = Source::of_text("errors.toml", &written);
            let values = errors_file::values(&source, &read, &|_| ()).map_err(|error| TestCaseError::fail(format!("{error}\n{written}")))?;
            let again = errors_file::found_over(&source, &read).map_err(|error| TestCaseError::fail(format!("{error}\n{written}")))?;
            prop_assert_eq!(again.len(), over.len());
            for range in &over {
                let name = &amended.symbol(range.symbol).name;
                let symbol = read.find_symbol(name).unwrap();
                prop_assert!(again.contains(&FoundOver { symbol, ..*range }), "{}", name);
            }
            for error in &found {
                let id = read.find_symbol(&error.name).unwrap();
                prop_assert_eq!(values[id.index()], error.value, "{}", error.name);
            }
        }
    }
}
