//! Two printed matrices that are said to be equal.

use super::super::NamedClaim;
use super::super::table::ClaimTable;
use super::{KINDS, Reader, each};
use crate::checker::{Claim, Equality, prints_letters};
use crate::latex::{PrintedSymbols, Turned};

impl Reader<'_> {
    /// Two matrices that are said to be equal: a claim for each entry.
    pub(super) fn equal_matrices(&mut self, claim: &ClaimTable) -> Option<Vec<NamedClaim>> {
        let formulas = claim.equal.as_ref()?;
        let texts: Vec<&str> = each(formulas).into_iter().map(|(text, _)| text).collect();
        let &[first, second] = texts.as_slice() else { return None };
        let is_latex = |text: &str| text.contains(['\\', '{']) || prints_letters(text, &self.symbols);
        if KINDS.iter().filter(|kind| (kind.place)(claim).is_some()).count() > 1
            || !(is_latex(first) || is_latex(second))
        {
            return None;
        }
        let read = |symbols: &PrintedSymbols| Equality::read_entries(self.chain, symbols, [first, second]);
        let entries = match read(&self.symbols)? {
            Ok(entries) => entries,
            Err(mistakes) => {
                self.unreadable(formulas, mistakes);
                return Some(Vec::new());
            }
        };
        // The same where rotations about named axes turn the other thing, if nobody said what they turn.
        let is_turned = entries.iter().any(|(_, equality)| equality.is_turned());
        let axes = (is_turned && !self.says_what_turns).then(|| self.symbols.clone().turning(Turned::Axes));
        let mut otherwise = axes.and_then(|axes| read(&axes)?.ok()).unwrap_or_default().into_iter();
        let named = |(entry, equality)| NamedClaim {
            name: format!("{}: {entry}", claim.name.get_ref()),
            place: claim.name.span(),
            claim: Claim::Equality(Box::new(equality)),
            otherwise: otherwise.next().map(|(_, equality)| Claim::Equality(Box::new(equality))),
            doubt: None,
            texts: texts.iter().map(|text| (*text).to_owned()).collect(),
            is_plain: false,
        };
        Some(entries.into_iter().map(named).collect())
    }
}
