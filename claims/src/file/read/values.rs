//! Claims that are numbers: values at one pose, and what is small enough to be neglected.

use model_core::algebra::{Poly, Rational};
use model_core::{Quantity, SymbolKind, names, syntax};
use toml::{Spanned, Value};

use super::super::strings::place_in_string;
use super::super::table::ClaimTable;
use super::exactly::exactly;
use super::{Place, Reader, each};
use crate::checker::{Claim, Combined, Exactly, Limits, Size, SizeMeasure, Values, lower};

impl Reader<'_> {
    /// Numbers at one pose, with errors of stated sizes.
    pub(super) fn value(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let table = claim.value.as_ref()?;
        self.numbers(table.span())?;
        let table = table.get_ref();
        let observable = self.observable(claim)?;
        let is_error = match table.of.as_ref().map(|of| of.get_ref().as_str()) {
            None | Some("error") => true,
            Some("shown") => false,
            Some(other) => {
                let place = table.of.as_ref().map_or(claim.name.span(), Spanned::span);
                self.mistake(
                    place,
                    format!("a value is of what is shown or of its error, not of `{other}`"),
                )
                .help = Some("of = \"error\" or of = \"shown\"".to_owned());
                return None;
            }
        };
        let mut values = self.chain.nominal_values();
        let mut exact = Some(Exactly::default());
        for (name, text) in &table.at {
            let chain = self.chain;
            let kinds = [SymbolKind::Joint, SymbolKind::Input, SymbolKind::Constant];
            let Some(id) =
                chain.find_symbol(name.get_ref()).filter(|&id| kinds.contains(&chain.symbol(id).kind))
            else {
                let near =
                    names::nearest(name.get_ref(), chain.symbols.iter().map(|symbol| symbol.name.as_str()));
                let help = near.map(|near| format!("did you mean `{near}`?"));
                let message =
                    format!("chain {} has no joint, input or constant `{}`", chain.name, name.get_ref());
                self.mistake(name.span(), message).help = help;
                return None;
            };
            let quantity = chain.symbol(id).quantity;
            let value = self.number_of(text, quantity)?;
            values[id.index()] = value;
            let number = exactly(chain, text.get_ref(), quantity, value);
            exact = exact.and_then(|exact| exact.giving(id, number, text.get_ref()));
        }
        for (name, size) in &table.errors {
            for error in self.errors_of(name.get_ref(), name.span())? {
                let (chain, quantity) = (self.chain, self.chain.symbol(error).quantity);
                let value = self.signed(size, quantity)?;
                values[error.index()] = value;
                let written = match size.get_ref() {
                    Value::String(text) => text.clone(),
                    other => other.to_string(),
                };
                let number = exactly(chain, &written, quantity, value);
                exact = exact.and_then(|exact| exact.giving(error, number, &written));
            }
        }
        let shown = self.chain.observable(observable);
        let texts = each(&table.equals);
        if texts.len() != shown.shown.len() {
            let message = format!("{} numbers, where {} are shown", texts.len(), shown.shown.len());
            self.mistake(table.equals.span(), message);
            return None;
        }
        let mut claimed = Vec::with_capacity(texts.len());
        for ((text, place), reading) in texts.into_iter().zip(&shown.shown) {
            let quantity = match reading.unit(shown.kind) {
                "rad" => Quantity::Angle,
                "m" => Quantity::Length,
                _ => Quantity::Number,
            };
            let (numbers, rounded) = self.rounded(text, place, quantity, table.within.as_ref())?;
            claimed.push(numbers);
            exact = exact.and_then(|mut exact| {
                exact.claimed.push(rounded?);
                exact.written.push(text.to_owned());
                Some(exact)
            });
        }
        Some(Claim::Values(Values { observable, is_error, values, claimed, exactly: exact }))
    }

    /// A quantity, or an amount of numbers and π.
    fn number_of(&mut self, text: &Spanned<String>, quantity: Quantity) -> Option<f64> {
        let why = match self.edge.quantity(text.get_ref(), quantity) {
            Ok(value) => return Some(value),
            Err(why) => why,
        };
        let amount =
            syntax::parse_amount(text.get_ref()).ok().and_then(|amount| lower(self.chain, &amount).ok());
        let value = amount.map(|amount| amount.eval(&self.chain.nominal_values()[..1]));
        match value.filter(|value| value.is_finite()) {
            Some(value) => Some(value),
            None => {
                self.mistake(text.span(), why).help =
                    Some(format!("write it like {}", self.edge.example(quantity)));
                None
            }
        }
    }

    /// A size with its sign.
    fn signed(&mut self, value: &Spanned<Value>, quantity: Quantity) -> Option<f64> {
        let read = match value.get_ref() {
            Value::String(text) => self.edge.quantity(text, quantity),
            Value::Float(number) => Ok(*number),
            Value::Integer(number) => Ok(*number as f64),
            other => Err(format!("expected a quantity, found {}", other.type_str())),
        };
        match read
            .and_then(|size| if size.is_finite() { Ok(size) } else { Err("this is no size".to_owned()) })
        {
            Ok(size) => Some(size),
            Err(why) => {
                self.mistake(value.span(), why).help =
                    Some(format!("write it like {}", self.edge.example(quantity)));
                None
            }
        }
    }

    /// A printed number in SI, and half of what its last digit stands for; the same exactly.
    fn rounded(
        &mut self,
        text: &str,
        place: Place,
        quantity: Quantity,
        within: Option<&Spanned<String>>,
    ) -> Option<([f64; 2], Option<[Poly; 2]>)> {
        let chain = self.chain;
        let value = match self.edge.quantity(text, quantity) {
            Ok(value) => value,
            Err(why) => {
                let place = place_in_string(self.text, place, 0..text.len());
                self.mistake(place, why).help =
                    Some(format!("write it like {}", self.edge.example(quantity)));
                return None;
            }
        };
        if let Some(within) = within {
            let size = self.number_of(within, quantity)?;
            let exact = exactly(chain, text, quantity, value)
                .zip(exactly(chain, within.get_ref(), quantity, size))
                .map(|(value, half)| [value, if size < 0.0 { -&half } else { half }]);
            return Some(([value, size.abs()], exact));
        }
        // What one of the number's own units is in SI. A number of several parts, 12° 30′, has several.
        let last = last_digit(text).and_then(|(digits, exponent)| {
            let behind = text.get(digits..).filter(|behind| !behind.contains(|c: char| c.is_numeric()))?;
            let one = format!("1{behind}");
            let unit = self.edge.quantity(&one, quantity).ok()?;
            Some((one, unit, exponent))
        });
        let Some((one, unit, exponent)) = last else {
            let message = "how far this number is rounded cannot be seen";
            self.mistake(place, message).help = Some("within = \"0.5 um\"".to_owned());
            return None;
        };
        let half = Rational::parse_decimal(&format!("5e{}", exponent.saturating_sub(1))).ok();
        let exact = exactly(chain, text, quantity, value)
            .zip(exactly(chain, &one, quantity, unit))
            .and_then(|(value, unit)| Some([value, unit.scale(&half?)]));
        Some(([value, 0.5 * 10f64.powi(exponent) * unit.abs()], exact))
    }

    /// That what some errors do stays below a size, whatever else is there.
    pub(super) fn neglected(&mut self, claim: &ClaimTable) -> Option<Claim> {
        let table = claim.neglected.as_ref()?;
        self.numbers(table.span())?;
        let table = table.get_ref();
        let observable = self.observable(claim)?;
        let sizes = self.sizes(&table.errors)?;
        let poses = self.poses(claim)?;
        let limit = self.quantity(&table.at_most, self.measured_in(observable), "a limit")?;
        Some(Claim::Size(Size {
            observable,
            sizes,
            combined: Combined::Sum,
            measure: SizeMeasure::Sup,
            limits: Limits { at_most: Some(limit), at_least: None },
            poses,
        }))
    }
}

/// Where a number ends in a text, and the power of ten of its last digit.
fn last_digit(text: &str) -> Option<(usize, i32)> {
    let start = text.len() - text.trim_start().len();
    let body = text[start..].trim_start_matches(['+', '-', '−']);
    let from = text.len() - body.len();
    let length = body.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(body.len());
    let digits = &body[..length];
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let decimals = i32::try_from(decimals).ok()?;
    let rest = &body[length..];
    let mut end = from + length;
    let mut power = 0;
    if let Some(exponent) = rest.strip_prefix(['e', 'E']) {
        let signed = exponent.trim_start_matches(['+', '-']);
        let count = signed.find(|c: char| !c.is_ascii_digit()).unwrap_or(signed.len());
        if count > 0 {
            let used = exponent.len() - signed.len() + count;
            power = exponent[..used].parse().ok()?;
            end += 1 + used;
        }
    }
    (length > 0).then_some((end, power - decimals))
}
