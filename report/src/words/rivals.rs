//! What explains data better than what was found and is no error of the instrument, in words: it takes the place of causes.

use calibration::diagnose::{Caution, Diagnosis};

/// What is reported of it.
pub(super) struct Rival<'a> {
    /// What happened, in a word or two.
    pub badge: &'static str,
    /// What happened, in a sentence.
    pub happened: &'static str,
    /// What to do next, in a few words and in sentences.
    pub step: [&'static str; 2],
    /// The effects that it explains better.
    pub instead_of: &'a [String],
}

/// That of a diagnosis, where there is one.
pub(super) fn rival(diagnosis: &Diagnosis) -> Option<Rival<'_>> {
    let mut rivals = diagnosis.cautions.iter().filter_map(|caution| match caution {
        Caution::Moved(own) => Some(Rival {
            badge: "Moved while measuring",
            happened: "The instrument likely moved during the measurement. That motion looks like the effects found.",
            step: [
                "Do not correct with it",
                "Fix the instrument firmly and measure again. Measure each target in both faces, one right after the other.",
            ],
            instead_of: &own.instead_of,
        }),
        Caution::LengthsOff(own) => Some(Rival {
            badge: "Lengths are off",
            happened: "The measured lengths likely start at another zero. That offset looks like the effects found.",
            step: [
                "Do not correct with it yet",
                "First correct the lengths as the caution describes.",
            ],
            instead_of: &own.instead_of,
        }),
        _ => None,
    });
    // The last is that which is mended by a word in the study.
    rivals.next_back()
}
