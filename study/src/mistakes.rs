//! Mistakes in a study, gathered: whoever reads a part of it goes on behind a mistake, so that all are told at once.

use std::ops::Range;

use model_core::{Mistake, names};

/// One mistake or more, each with its place in bytes.
#[derive(Debug)]
pub(super) struct Several(pub Vec<Mistake<Range<usize>>>);

/// What could be read, or what is wrong with it.
pub(super) type Outcome<T> = Result<T, Several>;

impl From<Mistake<Range<usize>>> for Several {
    fn from(mistake: Mistake<Range<usize>>) -> Self {
        Self(vec![mistake])
    }
}

/// A mistake with advice.
pub(super) fn mistake(place: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Several {
    Mistake::new(place, message).with_help(help).into()
}

/// A mistake whose message says what to write.
pub(super) fn plain(place: Range<usize>, message: impl Into<String>) -> Several {
    Mistake::new(place, message).into()
}

/// A name that is none of those there are.
pub fn unknown<'a>(
    place: Range<usize>,
    what: &str,
    name: &str,
    candidates: impl Iterator<Item = &'a str> + Clone,
) -> Several {
    let help = names::nearest(name, candidates.clone()).map_or_else(
        || {
            let names = candidates.map(|name| format!("`{name}`")).collect::<Vec<_>>();
            format!("there are {}", names.join(", "))
        },
        |near| format!("did you mean `{near}`?"),
    );
    mistake(place, format!("no {what} is called `{name}`"), help)
}

/// Refuses a number beyond what can be computed with in good time.
pub(super) fn within(
    place: Range<usize>,
    what: &str,
    number: u64,
    allowed: std::ops::RangeInclusive<u64>,
) -> Outcome<()> {
    if allowed.contains(&number) {
        return Ok(());
    }
    let (least, most) = allowed.into_inner();
    Err(mistake(
        place,
        format!("{what} cannot be {number}"),
        format!("write a number from {least} to {most}"),
    ))
}

/// All that could be read, or every mistake.
pub(super) fn every<T>(outcomes: impl IntoIterator<Item = Outcome<T>>) -> Outcome<Vec<T>> {
    let mut gathered = Gathered::default();
    let read: Vec<Option<T>> = outcomes.into_iter().map(|outcome| gathered.take(outcome)).collect();
    gathered.none()?;
    Ok(read.into_iter().flatten().collect())
}

/// Mistakes of parts that are read one after the other.
#[derive(Default)]
pub(super) struct Gathered(Vec<Mistake<Range<usize>>>);

impl Gathered {
    /// What could be read of a part.
    pub fn take<T>(&mut self, outcome: Outcome<T>) -> Option<T> {
        outcome.map_err(|mistakes| self.0.extend(mistakes.0)).ok()
    }

    /// Whether there was none.
    pub fn none(&mut self) -> Outcome<()> {
        if self.0.is_empty() { Ok(()) } else { Err(Several(std::mem::take(&mut self.0))) }
    }
}
