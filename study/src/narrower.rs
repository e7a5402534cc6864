//! A study that asks for less than another: of fewer errors, or of other files.

use model_core::SymbolId;

use super::Plan;

impl Plan {
    /// The same with these errors or constants at their nominal values.
    #[must_use]
    pub fn holding(&self, held: &[SymbolId]) -> Self {
        let mut plan = self.clone();
        let nominal = plan.chain.nominal_values();
        plan.fit.estimate.retain(|id| !held.contains(id));
        plan.fit.sizes.retain(|(id, _)| !held.contains(id));
        held.iter().for_each(|id| plan.fit.start[id.index()] = nominal[id.index()]);
        plan
    }

    /// The same of these files alone, with as many sources.
    #[must_use]
    pub fn of_files(&self, paths: &[String]) -> Self {
        let mut plan = self.clone();
        plan.sources.iter_mut().for_each(|source| source.paths = paths.to_vec());
        plan
    }
}
