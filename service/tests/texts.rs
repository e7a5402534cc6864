//! A calibration with no file, no clock and no terminal: texts in, reports out.
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

use std::cell::RefCell;

use service::{Calibrated, Instrument, Made, Refusal, Source, Studied, errors_file};

const CHAIN: &str = include_str!("../../examples/turntable/turntable.chain");
const STUDY: &str = include_str!("../../examples/turntable/turntable.toml");
const DATA: &[u8] = include_bytes!("../../examples/turntable/measured.csv");

fn studied(study: &str, chain: &str) -> Result<Studied, Refusal> {
    let chain = |_: &Source, _: &std::path::Path| Ok(Source::of_text("turntable.chain", chain));
    Studied::read(Source::of_text("study.toml", study), &|_| (), chain)
}

fn calibrated(tables: &[(&str, &[u8])]) -> Result<Calibrated, Refusal> {
    calibrated_of(CHAIN, tables)
}

fn calibrated_of(chain: &str, tables: &[(&str, &[u8])]) -> Result<Calibrated, Refusal> {
    let made = Made { version: "1.2.3", command: "a page".to_owned(), date: "2026-11-27".to_owned() };
    studied(STUDY, chain)?.calibrate_texts(tables, made, &|_| (), &|_| ())
}

#[test]
fn texts_become_a_page_a_report_and_errors() {
    let calibrated = calibrated(&[("measured.csv", DATA)]).unwrap();
    let reported = calibrated.reported(None);
    let page = report::page(&reported);
    let json = report::json(&reported).unwrap();
    let errors = errors_file::errors(&reported).unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("trueaxis 1.2.3, 2026-11-27"));
    assert!(errors.contains("calibrated on 2026-11-27"), "{errors}");
    // Source: sha256sum examples/turntable/measured.csv
    for part in
        ["\"command\": \"a page\"", "27690a61a5ce0fd49871c8af2e10ee98f146746c33fe40207916390f12daf48e"]
    {
        assert!(json.contains(part), "{part}: {json}");
    }
    let mut table = Vec::new();
    let rows = report::rows_written(&reported, true);
    report::write_csv(&report::table(&reported, &rows), &mut table).unwrap();
    let lines = String::from_utf8(table).unwrap().lines().count();
    assert_eq!(lines, 1 + reported.observations.rows());
}

#[test]
fn what_was_found_is_read_again() {
    let calibrated = calibrated(&[("measured.csv", DATA)]).unwrap();
    let reported = calibrated.reported(None);
    let warned = RefCell::new(Vec::new());
    let warn = |warning| warned.borrow_mut().push(warning);
    let amended = Source::of_text("amended.chain", reported.calibration.amended.as_ref().unwrap());
    let chain = amended.chain(&warn).unwrap();
    let errors = Source::of_text("errors.toml", &errors_file::errors(&reported).unwrap());
    let values = errors_file::values(&errors, &chain, &warn).unwrap();
    assert!(chain.symbols_of(model_core::SymbolKind::Error).any(|error| values[error.index()] != 0.0));
    assert_eq!(warned.into_inner(), Vec::<String>::new());
}

/// An instrument file has the numbers of the calibration to the last bit, whatever its declaration has in its comments.
#[test]
fn an_instrument_file_says_what_was_found() {
    let quoted = CHAIN.replacen('{', "{ // a comment with ''' in it and a \\ and \"\"\"\n", 1);
    for chain in [CHAIN, &quoted] {
        let calibrated = calibrated_of(chain, &[("measured.csv", DATA)]).unwrap();
        let found = &calibrated.calibration;
        let text = calibrated.instrument(Some("2027-06-30")).unwrap();
        let source = Source::of_text("instrument.toml", &text);
        let instrument = Instrument::of(&source, &|warning| panic!("{warning}"))
            .unwrap_or_else(|why| panic!("{why}\n{text}"));
        assert_eq!(Some(&instrument.declaration.text), found.amended.as_ref());
        // An angle of sight follows from what is read: it has no number.
        let has_number = |symbol: &&model_core::Symbol| symbol.kind != model_core::SymbolKind::SightAngle;
        for symbol in found.chain.symbols.iter().filter(has_number) {
            let [of_file, own] =
                [&instrument.chain, &found.chain].map(|chain| chain.find_symbol(&symbol.name).unwrap());
            assert_eq!(
                instrument.values[of_file.index()],
                found.after.values[own.index()],
                "{}",
                symbol.name
            );
        }
        let covariance = instrument.covariance.as_ref().unwrap();
        assert_eq!(covariance.of.len(), found.after.parameters.len());
        for (row, numbers) in covariance.rows.iter().enumerate() {
            let id = found.after.parameters[row];
            let own = found.after.standard_uncertainty(id).unwrap();
            assert!((numbers[row].sqrt() / own - 1.0).abs() < 1e-12, "{}", found.chain.symbol(id).name);
        }
        assert_eq!(instrument.expired("2027-06-30"), None);
        assert!(instrument.expired("2027-07-01").is_some_and(|why| why.contains("2027-06-30")));
        // The headings of the data, whose unit stands in their header.
        let headings = instrument.headings.as_ref().unwrap();
        assert_eq!(headings.sources.len(), 1);
        assert_eq!(instrument.corrected[0]["y"].text, "pointing_y");
    }
}

#[test]
fn a_table_that_was_not_given_is_named() {
    let refused = calibrated(&[("other.csv", DATA)]).err().unwrap().to_string();
    assert!(refused.contains("`measured.csv`, which was not given"), "{refused}");
    let refused = calibrated(&[("measured.csv", b"")]).err().unwrap().to_string();
    assert!(refused.contains("measured.csv"), "{refused}");
}

#[test]
fn a_mistake_is_shown_where_it_stands() {
    let Err(Refusal::Mistakes { rendered, .. }) = studied("chain = 1\n", CHAIN) else { panic!("no mistake") };
    assert!(rendered.contains("study.toml:1"), "{rendered}");
}
