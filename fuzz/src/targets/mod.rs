//! What is tried: everything that reads what somebody wrote.

mod declarations;
mod found;
mod handed_in;
mod printed;
mod studies;
mod tabular;

use std::borrow::Cow;

use model_core::Chain;

/// Takes one input; panics if something is wrong with how it is taken.
pub type Target = fn(&[u8]);

/// Every target, by the folder of its corpus.
pub const TARGETS: &[(&str, Target)] = &[
    ("declaration", declarations::read),
    ("amend", declarations::amended),
    ("study", studies::read),
    ("data", studies::with_data),
    ("table", tabular::separated),
    ("observations", tabular::observations),
    ("begun", tabular::begun),
    ("robot", tabular::robot),
    #[cfg(feature = "parquet")]
    ("parquet", tabular::parquet),
    ("errors", found::errors),
    ("instrument", found::instrument),
    ("claims", printed::claims),
    ("paper", printed::papers),
    ("handed-in", handed_in::graded),
];

/// The declaration that the files of the corpora speak of.
const MOUNT: &str = include_str!("../../corpus/declaration/mount.chain");

fn mount() -> Chain {
    let Ok(chain) = Chain::from_text(MOUNT) else { unreachable!("the corpus has no mistake") };
    chain
}

fn text(input: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(input)
}

/// Two files in one input, with a line between them.
fn parts(text: &str) -> [&str; 2] {
    text.split_once("\n----\n").unwrap_or((text, "")).into()
}

/// What is told of a mistake commands no terminal, and is no longer than a person reads.
fn is_seen(told: &str) {
    let acts = |letter: char| letter.is_control() && !"\n\t".contains(letter);
    let turns = |letter| matches!(letter, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{2028}' | '\u{2029}');
    assert!(!told.is_empty() && !told.contains(|letter| acts(letter) || turns(letter)), "{told:?}");
}
