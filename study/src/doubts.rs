//! Bare numbers of a study that are hardly in SI: `sigma = 2` is two radians.

use model_core::{Chain, SymbolKind};

use super::plan::SourcePlan;
use super::sigma::quantity;
use super::written::{Sigma, Study};
use tables::units::{Doubt, Plausible};

impl Study {
    /// A remark on each.
    pub(super) fn doubts(&self, chain: &Chain, sources: &[SourcePlan]) -> Vec<Doubt> {
        let mut doubts = Vec::new();
        if let (Some(Sigma::Amount(sigma)), Some(first)) =
            (self.noise.sigma.as_ref().map(|sigma| sigma.get_ref()), sources.first())
        {
            let (noise, number) = (Plausible::noise(chain), sigma.number);
            let meant = |unit: &str| format!("sigma = \"{number} {unit}\"");
            doubts.extend(noise.doubt(
                quantity(first.measure),
                &[*sigma],
                &format!("sigma = {number}"),
                meant,
            ));
        }
        let also = self.also.iter().flat_map(|also| &also.columns);
        for (name, column) in self.columns.iter().chain(also) {
            let Some(Sigma::Amount(sigma)) = column.get_ref().sigma.as_ref().map(|sigma| sigma.get_ref())
            else {
                continue;
            };
            let Some(id) = chain.find_symbol(name.get_ref()) else { continue };
            let (noise, number) = (Plausible::noise(chain), sigma.number);
            let meant = |unit: &str| format!("sigma = \"{number} {unit}\"");
            let written = format!("sigma = {number} of `{}`", name.get_ref());
            doubts.extend(noise.doubt(chain.symbol(id).quantity, &[*sigma], &written, meant));
        }
        for (name, amount) in self.fit.start.iter().chain(&self.fit.fix) {
            let (name, number) = (name.get_ref(), amount.get_ref().number);
            let Some(id) = chain.find_symbol(name) else { continue };
            let symbol = chain.symbol(id);
            let plausible = match symbol.kind {
                SymbolKind::Error => Plausible::errors(chain),
                _ => Plausible::readings(chain, id),
            };
            let meant = |unit: &str| format!("{name} = \"{number} {unit}\"");
            let written = format!("{name} = {number}");
            doubts.extend(plausible.doubt(symbol.quantity, &[*amount.get_ref()], &written, meant));
        }
        for (name, range) in self.next.iter().flat_map(|next| &next.get_ref().range) {
            let (name, [low, high]) = (name.get_ref(), *range.get_ref());
            let Some(id) = chain.find_symbol(name) else { continue };
            let (from, to) = (low.number, high.number);
            let meant = |unit: &str| format!("{name} = [\"{from} {unit}\", \"{to} {unit}\"]");
            let written = format!("{name} = [{from}, {to}]");
            doubts.extend(Plausible::readings(chain, id).doubt(
                chain.symbol(id).quantity,
                &[low, high],
                &written,
                meant,
            ));
        }
        doubts
    }
}
