//! What a calibration found, as somebody hands it on: files of errors, instrument files.

use service::{Instrument, Source, errors_file};

use super::{is_seen, mount, text};

/// A file of errors: values, largest sizes, and the ranges that it was found over.
pub fn errors(input: &[u8]) {
    let chain = mount();
    let source = Source::of_text("errors.toml", &text(input));
    let heard = |warning: String| assert!(!warning.is_empty());
    let answers = [
        errors_file::values(&source, &chain, &heard)
            .map(|values| assert_eq!(values.len(), chain.symbols.len())),
        errors_file::largest_sizes(&source, &chain, &heard)
            .map(|sizes| assert!(sizes.iter().all(|&size| size >= 0.0), "a size is none: {sizes:?}")),
        errors_file::found_over(&source, &chain)
            .map(|over| assert!(over.iter().all(|one| one.low <= one.high))),
    ];
    for refusal in answers.into_iter().filter_map(Result::err) {
        is_seen(&refusal.to_string());
    }
}

/// An instrument file.
pub fn instrument(input: &[u8]) {
    let source = Source::of_text("instrument.toml", &text(input));
    match Instrument::of(&source, &|warning: String| assert!(!warning.is_empty())) {
        Ok(instrument) => {
            assert_eq!(instrument.values.len(), instrument.chain.symbols.len());
            assert!(instrument.sizes().iter().all(|&size| size >= 0.0), "a size is none");
            let _ = instrument.expired("2026-11-27");
        }
        Err(refusal) => is_seen(&refusal.to_string()),
    }
}
