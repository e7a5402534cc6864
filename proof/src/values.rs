//! Printed numbers: that the exact value is the printed one as far as this is rounded, or that it is not.

use std::fmt::Write as _;

use super::expanded::Expanded;
use super::expression;
use super::leaf;
use super::passage;
use super::{Certificate, Refusal};
use claims::checker::{Exactly, Values, exact_leeway};
use model_core::algebra::Poly;
use model_core::chain::{ObservableId, ObservableKind};
use model_core::escape::comments::coq as comment;
use model_core::expr::Expr;
use model_core::symbol::{SymbolId, SymbolKind};

impl Certificate<'_> {
    /// States that what an observable shows at numbers, or what the errors add to that, rounds to the printed numbers, and proves the
    /// verdict on it: Coq encloses every sine, cosine and product between two numbers.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn values(&mut self, title: &str, claim: &Values, holds: bool) -> Result<(), Refusal> {
        let exactly = self.decidable(claim)?;
        let declared = self.declared;
        let chain = declared.chain();
        let observable = chain.observable(claim.observable);
        let path = passage::bodies(declared, claim.observable);
        let vector = declared.observable(claim.observable);
        let mut used: Vec<SymbolId> = path.iter().flat_map(|(body, _)| self.body_symbols(*body)).collect();
        used.extend(vector.iter().flat_map(|component| declared.symbols_of(component)));
        used.sort_unstable();
        used.dedup();
        let module = self.names.give(title);
        let what = if claim.is_error { "what the errors add to" } else { "the numbers of" };
        let said = if holds { "holds" } else { "differs" };
        let mut out = format!(
            "(* {}: {what} {} at these values, as printed: {said} *)\nModule {module}.\n",
            comment(title),
            comment(&observable.name)
        );
        let mut words = Vec::new();
        for &symbol in &used {
            let (value, written) = self.value_of(exactly, symbol)?;
            let name = self.symbol(symbol);
            let written = written.map_or(String::new(), |text| format!(" (* {} *)", comment(text)));
            let _ = writeln!(out, "Definition {name} : R := {}.{written}", number(&value)?);
            words.push(name.to_owned());
        }
        for (which, has_errors) in [("instrument", true), ("designed", false)] {
            if !has_errors && !claim.is_error {
                continue;
            }
            let bodies: Vec<String> = path
                .iter()
                .map(|&(body, is_reversed)| {
                    let symbols = self.body_symbols(body).into_iter();
                    let arguments: String = symbols
                        .map(|symbol| {
                            let is_zero = declared.is_error(symbol) && !has_errors;
                            format!(" {}", if is_zero { "0" } else { self.symbol(symbol) })
                        })
                        .collect();
                    let whole = format!("{}{arguments}", self.bodies[usize::from(body.0)]);
                    if is_reversed { format!("back ({whole})") } else { whole }
                })
                .collect();
            let bodies = if bodies.is_empty() { "[]".to_owned() } else { bodies.join(" ++ ") };
            let _ = writeln!(out, "Definition {which} : list motion :=\n  {bodies}.");
        }
        words.extend(path.iter().map(|(body, _)| self.bodies[usize::from(body.0)].clone()));
        let leaf = |expression: &Expr<()>| leaf::leaf(declared, expression, &|symbol| self.term(symbol));
        let written = vector.each_ref().map(|component| expression::write(component, &leaf));
        vector_of(&mut out, "vector", &written);
        let printed: Vec<String> =
            exactly.claimed.iter().map(|[value, _]| number(value)).collect::<Result<_, _>>()?;
        let within: Vec<String> = exactly
            .claimed
            .iter()
            .map(|claimed| number(&exact_leeway(claimed).ok_or(Refusal::Claim)?))
            .collect::<Result<_, _>>()?;
        let _ = writeln!(out, "(* As printed: {} *)", comment(&exactly.written.join(", ")));
        vector_of(&mut out, "printed", &printed);
        out.push_str(
            "(* How far off the rounded print may be, and a billionth of that; a trillionth of the number. *)\n",
        );
        vector_of(&mut out, "within", &within);
        let kind = match observable.kind {
            ObservableKind::Direction => "Direction",
            ObservableKind::Point => "Point",
        };
        let shown = format!("shown {kind} instrument vector");
        let (shown, designed) = if claim.is_error {
            (format!("less ({shown}) (shown {kind} designed vector)"), " designed")
        } else {
            (shown, "")
        };
        words.dedup();
        let (negation, words) = (if holds { "" } else { "~ " }, words.join(" "));
        let _ = writeln!(
            out,
            "Definition claim : Prop := rounded_to ({shown}) printed within.\nTheorem {said} : {negation}claim.\n\
             Proof. cbv [claim instrument{designed} vector printed within {words}]; by_numbers. Qed.\nEnd {module}."
        );
        self.finish_section(out, &module, said);
        Ok(())
    }

    /// The exact numbers of a claim that Coq can decide.
    fn decidable<'v>(&self, claim: &'v Values) -> Result<&'v Exactly, Refusal> {
        let chain = self.declared.chain();
        let observable = chain.observable(claim.observable);
        if !observable.is_vector() {
            let reading = observable.shown.iter().find(|reading| reading.component().is_none());
            return Err(match reading.or(observable.shown.first()) {
                Some(reading) => Refusal::ValueOf { reading: reading.words() },
                None => Refusal::Claim,
            });
        }
        self.without_special_symbols(claim.observable)?;
        claim
            .exactly
            .as_ref()
            .ok_or_else(|| Refusal::NoExactValue { what: "one of the numbers of the claim".to_owned() })
    }

    /// Refuses ramps, and lines of sight that are bent or have an angle from up.
    fn without_special_symbols(&self, id: ObservableId) -> Result<(), Refusal> {
        let chain = self.declared.chain();
        let observable = chain.observable(id);
        let way = chain.way(id);
        let amounts = way.iter().map(|passed| &passed.factor.amount).chain(&observable.components);
        let symbols: Vec<SymbolId> = amounts.flat_map(Poly::symbols).collect();
        if observable.bend.is_some() || symbols.iter().any(|symbol| chain.sight_angle(*symbol).is_some()) {
            return Err(Refusal::LineOfSight { name: observable.name.clone() });
        }
        // The vector stands once in the statement, for the instrument with errors and without.
        if observable.components.iter().flat_map(Poly::symbols).any(|symbol| self.declared.is_error(symbol)) {
            return Err(Refusal::Claim);
        }
        if symbols.iter().any(|symbol| chain.ramp(*symbol).is_some()) {
            return Err(Refusal::RampValue);
        }
        Ok(())
    }

    /// What a symbol is: what the file gives, with its text, what is declared, or zero.
    fn value_of<'e>(
        &self,
        exactly: &'e Exactly,
        symbol: SymbolId,
    ) -> Result<(Poly, Option<&'e str>), Refusal> {
        if let Some(given) = exactly.given.iter().find(|given| given.symbol == symbol) {
            return Ok((given.value.clone(), Some(&given.written)));
        }
        let own = self.declared.chain().symbol(symbol);
        match (own.kind, self.declared.constant(symbol)) {
            (SymbolKind::Constant, Some(value)) => Ok((value.clone(), None)),
            (SymbolKind::Constant, None) => {
                Err(Refusal::NoExactValue { what: format!("the constant `{}`", own.name) })
            }
            _ => Ok((Poly::zero(), None)),
        }
    }
}

/// A number in Coq's syntax.
fn number(value: &Poly) -> Result<String, Refusal> {
    Ok(Expanded::new(value)?.write(&|_| "PI".to_owned()))
}

/// `Definition vector : vec := V (0) (1) (0).`
fn vector_of(out: &mut String, name: &str, components: &[String]) {
    let components: String = components.iter().map(|component| format!("\n  ({component})")).collect();
    let _ = writeln!(out, "Definition {name} : vec := V{components}.");
}
