//! What explains data better than what was found and is no error of the instrument, in words: it stands where causes would.

use calibration::diagnose::{Caution, Diagnosis};

/// What is told of it.
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
    let mut told = diagnosis.cautions.iter().filter_map(|caution| match caution {
        Caution::Moved(own) => Some(Rival {
            badge: "Moved while measuring",
            happened: "The instrument likely moved while it measured: what was found may be that, and no error of it.",
            step: [
                "Do not correct with it",
                "An instrument that moves while it measures looks like errors that it does not have. Let it stand firmly and measure again; \
                 measure each target in both faces at once.",
            ],
            instead_of: &own.instead_of,
        }),
        Caution::LengthsOff(own) => Some(Rival {
            badge: "Lengths are off",
            happened: "The lengths are likely told from another zero: what was found may be that, and no error of the instrument.",
            step: [
                "Do not correct with it yet",
                "Lengths that are all too long, or too short, look like errors that the instrument does not have. What to do stands in the \
                 caution.",
            ],
            instead_of: &own.instead_of,
        }),
        _ => None,
    });
    // The last is that which is mended by a word in the study.
    told.next_back()
}
