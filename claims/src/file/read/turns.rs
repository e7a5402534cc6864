//! Claims that print how a body is turned as a matrix: they are as many claims as say all of its entries.

use crate::checker::{Claim, ClosedForm, Order, PrintedTurn};
use crate::latex::Turned;
use model_core::readings::ROTATION;

use super::super::NamedClaim;
use super::super::table::ClaimTable;
use super::{KINDS, Reader, each, span};

impl Reader<'_> {
    /// The claims of a table that prints the matrix of a small rotation for an orientation; `None` for any other table.
    pub(super) fn matrix(&mut self, claim: &ClaimTable) -> Option<Vec<NamedClaim>> {
        let components = claim.components.as_ref()?;
        let texts = each(components);
        let [(text, _)] = texts.as_slice() else { return None };
        if KINDS.iter().filter(|kind| (kind.place)(claim).is_some()).count() > 1 {
            return None;
        }
        let chain = self.chain;
        let observable = match &claim.observable {
            Some(names) => match each(names).as_slice() {
                [(name, _)] => chain.find_observable(name)?,
                _ => return None,
            },
            None => match chain.observables.as_slice() {
                [only] => chain.find_observable(&only.name)?,
                _ => return None,
            },
        };
        if chain.observable(observable).shown != ROTATION {
            return None;
        }
        let symbols = self.symbols.reading(&[text]).into_owned();
        let turn = PrintedTurn::read(chain, &symbols, text)?;
        // The same where rotations about named axes turn the other thing, if nobody said what they turn.
        let otherwise = match &turn {
            Ok(turn) if turn.plain.turned && !self.says_what_turns => {
                PrintedTurn::read(chain, &symbols.turning(Turned::Axes), text).and_then(Result::ok)
            }
            _ => None,
        };
        for place in [span(&claim.component), span(&claim.faces)].into_iter().flatten() {
            self.mistake(place, "this means nothing where a matrix is printed").help =
                Some("leave it out, or claim the three components of the small rotation vector".to_owned());
        }
        let order = self.order(claim);
        let higher = order.is_some_and(|order| order != Order::UpTo(1));
        if let Some(place) = span(&claim.order).filter(|_| higher) {
            self.mistake(place, "a matrix of a small rotation is read to first order").help =
                Some("claim the three components of the small rotation vector".to_owned());
        }
        let kept = self.kept(claim);
        let turn = match turn {
            Ok(turn) => turn,
            Err(mistakes) => {
                self.unreadable(components, mistakes);
                return Some(Vec::new());
            }
        };
        let (Some(order), Some(kept)) = (order, kept) else { return Some(Vec::new()) };
        let named = |entries: &str, read: Claim, otherwise: Option<Claim>| NamedClaim {
            name: format!("{}: {entries}", claim.name.get_ref()),
            place: claim.name.span(),
            claim: read,
            otherwise,
            doubt: None,
            texts: vec![(*text).to_owned()],
            is_plain: false,
        };
        let form = |printed| {
            Claim::ClosedForm(Box::new(ClosedForm {
                observable,
                order,
                only: None,
                faces: None,
                kept: kept.clone(),
                printed,
            }))
        };
        let (plain, negated) = match otherwise {
            Some(turn) => (Some(form(turn.plain)), Some(form(turn.negated))),
            None => (None, None),
        };
        let mut claims = vec![
            named("entries 32, 13, 21", form(turn.plain), plain),
            named("entries 23, 31, 12, their signs turned", form(turn.negated), negated),
        ];
        for (entry, said) in ["entry 11", "entry 22", "entry 33"].into_iter().zip(turn.diagonal) {
            claims.push(named(entry, Claim::Equality(Box::new(said)), None));
        }
        Some(claims)
    }
}
