//! How much memory the search of a study takes, before it is begun.
//!
//! What the search holds are inner products: a square matrix for each fold, as wide as there are columns (a declared error, a
//! function of a candidate), and some more of them while folds are searched side by side.

use model_core::{Chain, ObservableId};

use super::mistakes::{Outcome, mistake};
use super::plan::Search;
use super::written::{SearchTable, Study};
use effects::catalogue::{catalogue, chosen};
use tables::formats::Options;

/// Matrices that are held at most for each fold, and besides; measured at 10, 40 and 100 folds, with a margin of a quarter.
const MATRICES_A_FOLD: f64 = 4.0;
const MATRICES_BESIDES: f64 = 35.0;

const MIB: f64 = (1_u64 << 20) as f64;

impl Study {
    /// Refuses a search that would take more than the memory that the study allows.
    pub(super) fn fits_into_memory(
        &self,
        search: &Search,
        chain: &Chain,
        observables: &[ObservableId],
        estimated: usize,
        format: &Options,
    ) -> Outcome<()> {
        let setting = search.setting(chain, observables);
        // A name that means no effect has been told.
        let Ok(effects) = chosen(&setting, catalogue(&setting), &search.only) else { return Ok(()) };
        let functions: usize = effects.iter().map(|effect| effect.functions.len()).sum();
        let folds = if self.hold_out.file.is_some() { 1 } else { *self.hold_out.folds.get_ref() };
        let width = (estimated + functions + 1) as f64;
        let matrices = MATRICES_A_FOLD * folds as f64 + MATRICES_BESIDES;
        let bytes = width * width * size_of::<f64>() as f64 * matrices;
        if bytes <= format.memory_bytes as f64 {
            return Ok(());
        }
        let usual = SearchTable::default().harmonics;
        let place = if self.search.harmonics.get_ref() > usual.get_ref() {
            self.search.harmonics.span()
        } else {
            self.hold_out.folds.span()
        };
        let (needed, allowed) = ((bytes / MIB).ceil(), format.memory_bytes >> 20);
        let message = format!(
            "a search among {functions} functions in {folds} folds takes about {needed} MiB of memory, and {allowed} MiB \
             are allowed"
        );
        let help = format!(
            "ask for fewer harmonics or folds, name the effects that may be found, or write memory = \"{:.0} GiB\"",
            (needed / 1024.0).ceil()
        );
        Err(mistake(place, message, help))
    }
}
