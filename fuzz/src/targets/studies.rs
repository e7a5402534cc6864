//! Studies, and tables that are read as one says.

use service::{Source, Studied};
use study::Study;
use tables::formats;

use super::{is_seen, mount, parts, text};

/// A study, with a chain that its corpus speaks of.
pub fn read(input: &[u8]) {
    let text = text(input);
    match Study::from_text(&text).and_then(|study| study.plan(&mount())) {
        Ok(plan) => assert!(!plan.sources.is_empty()),
        Err(mistakes) => is_seen(&mistakes.render("study.toml", &text)),
    }
}

/// A study and the table below it: columns in their notations, units and signs, times, groups, what is left out.
pub fn with_data(input: &[u8]) {
    let text = text(input);
    let [study, table] = parts(&text);
    let study = Source::of_text("study.toml", study);
    let chain = Source::of_text("mount.chain", super::MOUNT);
    let mut open = |path: &str, options: &formats::Options| {
        // As long as the name does not claim another format.
        formats::open(
            table.as_bytes().to_vec(),
            if path.ends_with(".dat") { "f.dat" } else { "f.csv" },
            options,
        )
    };
    let warn = |said: String| assert!(!said.is_empty());
    if let Err(refusal) = Studied::of(study, chain, &warn).and_then(|studied| studied.load(&mut open, &warn))
    {
        is_seen(&refusal.to_string());
    }
}
