//! What data can and cannot show: the sentences of a sheet, one of which is right.

use crate::misread::Reading;
use crate::task::Task;

/// The sentences, numbered from 1.
pub const SENTENCES: [&str; 6] = [
    "Nothing is missing. The declared errors explain these data.",
    "Of the causes on this sheet, the data allow one alone for each thing that I added.",
    "The correction is sure, and its cause is not. For one thing that I added, the data allow two or more causes on this sheet.",
    "One column was not what its heading says. Read rightly, the data allow one cause alone for each thing that I added.",
    "The two set-ups differ. With that declared, the data allow one cause alone for each thing that I added.",
    "The noise hides everything. These data cannot show what is missing.",
];

/// The number of the right sentence.
#[must_use]
pub fn right(task: &Task) -> usize {
    if task.reading != Reading::AsLabelled {
        4
    } else if task.effects.iter().any(|effect| effect.cause.is_of_set_ups()) {
        5
    } else if task.effects.iter().any(|effect| effect.possible.len() > 1) {
        3
    } else {
        2
    }
}
