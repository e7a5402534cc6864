//! Claims that are printed formulas: closed forms of the error, over one face or two, and its length.

use crate::checker::{
    Claim, ClosedForm, Combination, Equality, Faces, Order, PrintedVector, Radicand, TextPlace, Total, lower,
};
use model_core::algebra::AngleSum;
use model_core::names::{self, listed};
use model_core::{Axis, Mistake, Observable, SymbolKind, syntax};
use toml::{Spanned, Value};

use super::super::strings::place_in_string;
use super::super::table::{ClaimTable, Texts};
use super::{Place, Reader, each};

impl Reader<'_> {
    pub(super) fn closed_form(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let faces = self.faces(claim)?;
        self.form(claim, claim.components.as_ref()?, faces)
    }

    /// What has to be added to a reading so that its error goes, to first order.
    pub(super) fn correction(&mut self, claim: &ClaimTable) -> Option<Claim> {
        if let Some(order) = claim.order.as_ref().filter(|order| *order.get_ref() != Value::Integer(1)) {
            self.mistake(order.span(), "a correction is the error with its sign turned to first order only");
            return None;
        }
        let faces = Faces { second: Vec::new(), combined: Combination::Correction };
        self.form(claim, claim.correction.as_ref()?, Some(faces))
    }

    fn form(
        &mut self,
        claim: &ClaimTable,
        components: &Spanned<Texts>,
        faces: Option<Faces>,
    ) -> Option<Claim> {
        let observable = self.observable(claim)?;
        let order = self.order(claim);
        let kept = self.kept(claim);
        let shown = self.chain.observable(observable);
        let only = self.component(claim, shown)?;
        let texts = each(components);
        let plain: Vec<&str> = texts.iter().map(|(text, _)| *text).collect();
        let read = match (only, plain.as_slice()) {
            (Some(axis), [text]) => {
                PrintedVector::read_one(self.chain, &self.symbols, text, shown, axis, order?)
            }
            (Some(_), _) => {
                self.mistake(components.span(), "one component is claimed, and several formulas are given");
                return None;
            }
            (None, texts) => PrintedVector::read_shown(self.chain, &self.symbols, shown, texts, order?),
        };
        match read {
            Ok(printed) => Some(Claim::ClosedForm(Box::new(ClosedForm {
                observable,
                order: order?,
                only,
                faces,
                kept: kept?,
                printed,
            }))),
            Err(mistakes) => {
                self.unreadable(components, mistakes);
                None
            }
        }
    }

    /// Notes what cannot be read in formulas of the file.
    pub(super) fn unreadable(&mut self, formulas: &Spanned<Texts>, mistakes: Vec<Mistake<TextPlace>>) {
        let texts = each(formulas);
        for mistake in mistakes {
            // A symbol that is unknown in one formula is unknown in all.
            let known = |earlier: &Mistake<Place>| earlier.message == mistake.message;
            if mistake.message.starts_with("unknown ") && self.mistakes.iter().any(known) {
                continue;
            }
            let string = texts.get(mistake.place.text_index).map(|(_, place)| place.clone());
            let place = string
                .map_or(formulas.span(), |string| place_in_string(self.text, string, mistake.place.bytes));
            self.mistake(place, mistake.message).help = mistake.help;
        }
    }

    pub(super) fn equality(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let formulas = claim.equal.as_ref()?;
        let texts = each(formulas);
        let [(first, _), (second, _)] = texts.as_slice() else {
            let message = format!(
                "an equality is of two formulas; {} given",
                if texts.len() == 1 { "one is".to_owned() } else { format!("{} are", texts.len()) }
            );
            self.mistake(formulas.span(), message).help = Some("equal = ['…', '…']".to_owned());
            return None;
        };
        match Equality::read(self.chain, &self.symbols, [first, second]) {
            Ok(equality) => Some(Claim::Equality(Box::new(equality))),
            Err(mistakes) => {
                self.unreadable(formulas, mistakes);
                None
            }
        }
    }

    pub(super) fn order(&mut self, claim: &ClaimTable) -> Option<Order> {
        let Some(order) = &claim.order else { return Some(Order::UpTo(1)) };
        match order.get_ref() {
            Value::Integer(1) => Some(Order::UpTo(1)),
            Value::Integer(2) => Some(Order::UpTo(2)),
            Value::Integer(3) => Some(Order::UpTo(3)),
            Value::String(text) if text == "exact" => Some(Order::Exact),
            other => {
                let message = format!("order {other} is none of 1, 2, 3 and \"exact\"");
                self.mistake(order.span(), message);
                None
            }
        }
    }

    pub(super) fn total(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let text = claim.total.as_ref()?;
        let observable = self.observable(claim)?;
        let kept = self.kept(claim)?;
        match Radicand::read(self.chain, &self.symbols, text.get_ref()) {
            Ok(radicand) => Some(Claim::Total(Box::new(Total { observable, kept, radicand }))),
            Err(Mistake { place, message, help }) => {
                let place = place_in_string(self.text, text.span(), place);
                self.mistake(place, message).help = help;
                None
            }
        }
    }

    /// The one component that is claimed, if it is one; `None` for a mistake.
    pub(super) fn component(&mut self, claim: &ClaimTable, shown: &Observable) -> Option<Option<Axis>> {
        let Some(component) = &claim.component else { return Some(None) };
        let wanted = component.get_ref().as_str();
        let found =
            [Axis::X, Axis::Y, Axis::Z].into_iter().zip(shown.labels()).find(|(_, label)| *label == wanted);
        if let Some((place, _)) = found {
            return Some(Some(place));
        }
        let labels = listed(shown.labels());
        let message = if shown.is_vector() {
            format!("component `{wanted}` is none of x, y and z")
        } else {
            format!("`{}` shows no `{wanted}`, it shows {labels}", shown.name)
        };
        self.mistake(component.span(), message).help =
            names::nearest(wanted, shown.labels()).map(|near| format!("did you mean `{near}`?"));
        None
    }

    /// The second face, if there is one; `None` for a mistake.
    fn faces(&mut self, claim: &ClaimTable) -> Option<Option<Faces>> {
        let Some(table) = &claim.faces else { return Some(None) };
        let table = table.get_ref();
        let combined = match table.take.get_ref().as_str() {
            "mean" => Combination::Mean,
            "difference" => Combination::Difference,
            "half difference" => Combination::HalfDifference,
            other => {
                self.mistake(table.take.span(), format!("`{other}` is nothing to take of two faces")).help =
                    Some("\"mean\", \"difference\" (first minus second) or \"half difference\"".to_owned());
                return None;
            }
        };
        let mut second = Vec::new();
        for (joint, amount) in &table.second {
            let chain = self.chain;
            let Some(id) = chain
                .find_symbol(joint.get_ref())
                .filter(|id| matches!(chain.symbol(*id).kind, SymbolKind::Joint | SymbolKind::Input))
            else {
                let message = format!("chain {} has no joint or input `{}`", chain.name, joint.get_ref());
                self.mistake(joint.span(), message);
                return None;
            };
            let read = syntax::parse_amount(amount.get_ref()).map_err(|mistakes| {
                let first = mistakes.iter().next();
                let place = first.map_or(0..0, |first| first.place.bytes.clone());
                Mistake::new(place, first.map_or("an amount is missing", |first| first.message.as_str()))
            });
            let value = read.and_then(|amount| lower(chain, &amount)).and_then(|value| {
                let own = |symbol| symbol == id || !matches!(chain.symbol(symbol).kind, SymbolKind::Joint | SymbolKind::Input | SymbolKind::Error);
                let fits = AngleSum::from_poly(&value).is_ok() && value.symbols().into_iter().all(own);
                let whole: Place = 0..amount.get_ref().len();
                if fits { Ok(value) } else { Err(Mistake::new(whole, "a joint of the second face is its own whole multiple, plus constants and quarter turns").with_help(format!("`{0} + pi`, `-{0}`", joint.get_ref()))) }
            });
            match value {
                Ok(value) => second.push((id, value)),
                Err(Mistake { place, message, help }) => {
                    let place = place_in_string(self.text, amount.span(), place);
                    self.mistake(place, message).help = help;
                    return None;
                }
            }
        }
        Some(Some(Faces { second, combined }))
    }
}
