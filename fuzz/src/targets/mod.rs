//! What is tried: everything that reads what somebody wrote.

use std::borrow::Cow;

use calibration::amend::{Addition, NewInput, amend};
use model_core::{BodyId, Chain, Role, syntax};
use study::Study;
use tables::formats::{self, ColumnName, Form, Kept, Options, Wanted, write_row};
use tables::units::Amount;

/// Takes one input; panics if something is wrong with how it is taken.
pub type Target = fn(&[u8]);

/// Every target, by the folder of its corpus.
pub const TARGETS: [(&str, Target); 5] = [
    ("declaration", declaration),
    ("study", study),
    ("table", table),
    ("observations", observations),
    ("amend", amended),
];

/// Rows that are read of one table.
const ROWS: usize = 10_000;

fn text(input: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(input)
}

/// What is told of a mistake commands no terminal, and is no longer than a person reads.
fn is_seen(told: &str) {
    let acts = |letter: char| letter.is_control() && !"\n\t".contains(letter);
    let turns = |letter| matches!(letter, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{2028}' | '\u{2029}');
    assert!(!told.is_empty() && !told.contains(|letter| acts(letter) || turns(letter)), "{told:?}");
}

/// A declaration, and its pieces: an amount, a printed formula, a quantity.
fn declaration(input: &[u8]) {
    let text = text(input);
    if let Err(mistakes) = Chain::from_text(&text) {
        assert!(mistakes.iter().next().is_some(), "refused without a mistake");
        is_seen(&mistakes.render("f.chain", &text));
    }
    let line = text.lines().next().unwrap_or_default();
    let _ = syntax::parse_amount(line);
    let _ = Amount::parse(line);
}

/// A study, with a chain that its corpus speaks of.
fn study(input: &[u8]) {
    const MOUNT: &str = include_str!("../corpus/declaration/mount.chain");
    let text = text(input);
    let Ok(chain) = Chain::from_text(MOUNT) else { unreachable!("the corpus has no mistake") };
    match Study::from_text(&text).and_then(|study| study.plan(&chain)) {
        Ok(plan) => assert!(!plan.sources.is_empty()),
        Err(mistakes) => is_seen(&mistakes.render("study.toml", &text)),
    }
}

/// Separated values: what is read is written, and read again it is the same.
fn table(input: &[u8]) {
    let Ok(mut reader) = formats::open(input, "f.csv", &Options::default()) else { return };
    let names: Vec<String> = reader.header().iter().map(|name| name.full.clone()).collect();
    let wanted: Vec<Wanted> = (0..names.len()).map(|column| Wanted { column, form: Form::Kept }).collect();
    let Ok(chunk) = reader.read(&wanted, ROWS) else { return };
    let columns: Vec<Vec<String>> = chunk.columns.iter().map(texts).collect();
    let mut file = Vec::new();
    let mut write = |cells: &[&str]| {
        assert!(write_row(&mut file, cells.iter().copied()).is_ok(), "a vector takes all");
    };
    write(&names.iter().map(String::as_str).collect::<Vec<_>>());
    for row in 0..chunk.rows.len() {
        write(&columns.iter().map(|column| column[row].as_str()).collect::<Vec<_>>());
    }
    let again = formats::open(file.as_slice(), "f.csv", &Options::default());
    let Ok(mut again) = again else { unreachable!("what was written has a header") };
    let header: Vec<String> = again.header().iter().map(|name: &ColumnName| name.full.clone()).collect();
    assert_eq!(header, names, "the header is read again");
    let Ok(chunk) = again.read(&wanted, ROWS) else { unreachable!("what was written can be read") };
    assert_eq!(chunk.columns.iter().map(texts).collect::<Vec<_>>(), columns, "the rows are read again");
}

fn texts(cells: &formats::Cells) -> Vec<String> {
    let formats::Cells::Kept(kept) = cells else { unreachable!("what was wanted") };
    let Ok(texts) = Kept::texts(kept) else { unreachable!("texts are texts") };
    texts.iter().map(str::to_owned).collect()
}

/// A file of telescope observations, with numbers wanted of every column.
fn observations(input: &[u8]) {
    for file in ["f.dat", "f.csv"] {
        let Ok(mut reader) = formats::open(input, file, &Options::default()) else { continue };
        let number = |column| Wanted { column, form: Form::Number(2.0) };
        let wanted: Vec<Wanted> = (0..reader.header().len()).map(number).collect();
        let _ = reader.read(&wanted, ROWS).map_err(|error| error.to_string());
    }
}

/// A declaration that is amended, with the input's first line as the name of what was found: refused, or said once more.
fn amended(input: &[u8]) {
    let text = text(input);
    let (name, declaration) = text.split_once('\n').unwrap_or(("", &text));
    let Ok(chain) = Chain::from_text(declaration) else { return };
    if chain.bodies.is_empty() {
        return;
    }
    let addition = Addition {
        body: BodyId(0),
        role: Role::MotionError,
        factor: "Rx(found_by_fuzzing)".to_owned(),
        documentation: vec![name.to_owned()],
    };
    let input = NewInput { name: "fuzzed_input".to_owned(), meaning: None, documentation: name.to_owned() };
    let Ok(amended) = amend(declaration, &chain, &[addition], &[input]) else {
        unreachable!("what is well meant can be added:\n{text}")
    };
    let Ok(read) = Chain::from_text(&amended) else { unreachable!("it has been read already") };
    assert_eq!(read.bodies[0].factors.len(), chain.bodies[0].factors.len() + 1);
    assert_eq!(read.observables.len(), chain.observables.len());
}
