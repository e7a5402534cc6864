//! How large rooms are, who knows unknown objects, and who lists kinds of observation: counted, and the last one held.
//!
//! `cargo test --test architecture rooms -- --nocapture` prints the counts.

#![allow(clippy::print_stdout, reason = "counts that somebody asks for")]

use std::collections::BTreeMap;

use crate::sources::{LIBRARIES, SourceFile, below};

/// Where a kind of observation may be named.
const REGISTRY: &str = "observe/src/kinds/";

/// What eliminates and places unknown objects, and what they are.
const OF_OBJECTS: &[&str] = &["network/", "observe/src/kinds/", "observe/src/unknowns/"];

/// Packages that stand below observations, or apart: words of their own are spelled as those of observations.
const WITHOUT_OBSERVATIONS: &[&str] =
    &["model-core/", "claims/", "proof/", "model-macros/", "codegen/", "parallel/", "tables/"];

/// Every source but the measurements and the tests.
fn sources() -> impl Iterator<Item = SourceFile> {
    let packages = LIBRARIES.iter().copied().chain(["cli/src", "python/src"]);
    packages.flat_map(below).filter(|file| !file.path.ends_with("/tests.rs"))
}

fn is_observing(path: &str) -> bool {
    !WITHOUT_OBSERVATIONS.iter().any(|own| path.starts_with(own))
}

/// `calibration/src/search/columns/seen.rs` stands in `calibration/search`, `fit/src/model.rs` in `fit`.
fn room(path: &str) -> String {
    let parts: Vec<&str> = path.split('/').filter(|part| *part != "src").collect();
    let folders = &parts[..parts.len() - 1];
    let depth = if parts[0] == "calibration" || parts[0] == "cli" { 2 } else { 1 };
    let room = folders.iter().take(depth).copied().collect::<Vec<_>>().join("/");
    if room.is_empty() { "trueaxis".to_owned() } else { room }
}

/// Whether code names one of the kinds of observation, or one of what they measure: `Measure::Plane`, but not `Measure::ALL`.
fn names_a_kind(line: &str) -> bool {
    ["Measure::", "Measured::"].iter().any(|path| {
        line.match_indices(path).any(|(at, _)| {
            let is_inside = line[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_');
            let mut name = line[at + path.len()..].chars();
            !is_inside
                && name.next().is_some_and(char::is_uppercase)
                && name.next().is_some_and(char::is_lowercase)
        })
    })
}

#[test]
fn no_file_outside_the_registry_lists_kinds_of_observation() {
    let outside = sources().filter(|file| is_observing(&file.path) && !file.path.starts_with(REGISTRY));
    let listing = outside.filter(|file| file.code().any(|(_, line)| names_a_kind(line)));
    let listing: Vec<String> = listing.map(|file| file.path).collect();
    println!("{} files outside {REGISTRY} list kinds of observation", listing.len());
    assert!(
        listing.is_empty(),
        "{listing:?}: ask the kind for a property; add one to {REGISTRY} if there is none"
    );
}

#[test]
fn rooms_are_counted() {
    let mut lines: BTreeMap<String, usize> = BTreeMap::new();
    let mut of_objects = Vec::new();
    for file in sources() {
        *lines.entry(room(&file.path)).or_default() += file.code().count();
        let knows = |(_, line): (usize, &str)| line.contains("unknowns");
        let is_of_objects = OF_OBJECTS.iter().any(|own| file.path.starts_with(own));
        if is_observing(&file.path) && !is_of_objects && file.code().any(knows) {
            of_objects.push(file.path);
        }
    }
    lines.iter().for_each(|(room, count)| println!("{count:6} {room}"));
    println!("{} files outside {} know unknown objects:", of_objects.len(), OF_OBJECTS.join(", "));
    of_objects.iter().for_each(|path| println!("       {path}"));
    assert!(lines.values().all(|count| *count > 0), "a room without a line");
}

#[test]
fn a_kind_is_seen_by_its_name() {
    for line in
        ["match measure { Measure::Plane => 1 }", "Measured::Length { length_m: 1.0 }", "x(&Measure::Point)"]
    {
        assert!(names_a_kind(line), "{line}");
    }
    for line in ["Measure::ALL", "SizeMeasure::Sup", "Measured::length_m", "fn of(measure: Measure)"] {
        assert!(!names_a_kind(line), "{line}");
    }
    assert_eq!(room("calibration/src/search/columns/seen.rs"), "calibration/search");
    assert_eq!([room("fit/src/noise/space.rs"), room("cli/src/many.rs")], ["fit", "cli"]);
}
