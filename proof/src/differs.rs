//! The proof that a printed formula is not the error: in which terms it differs from the derived one, and values at which
//! the two are different numbers.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::Refusal;
use super::condition::Condition;
use super::expanded::{Expanded, Part};
use super::section::Section;
use super::witness::{Search, Value, substitute};
use claims::checker::{ClosedForm, FormVerdict};
use model_core::algebra::Poly;
use model_core::symbol::SymbolId;

impl Section<'_> {
    /// The whole proof; the section is closed.
    pub(super) fn refute(&mut self, claim: &ClosedForm, verdict: &FormVerdict) -> Result<(), Refusal> {
        let printed = claim.printed.components.each_ref().map(|component| component.value.above.clone());
        self.prepare()?;
        let derived = super::whole(&verdict.derived)?;
        self.difference(&printed, &derived)?;
        self.canonical("derived")?;
        let statement = self.statement("derived");
        self.reach("derived", "is_derived", &statement)?;
        self.witness(&printed, &derived, verdict)
    }

    /// What is printed, less what is derived.
    fn difference(&mut self, printed: &[Poly; 3], derived: &[Poly; 3]) -> Result<(), Refusal> {
        self.out.push_str("\n(* What is printed is what is derived, and this besides. *)\n");
        for (axis, (printed, derived)) in ["x", "y", "z"].into_iter().zip(printed.iter().zip(derived)) {
            let besides = self.poly(&(printed - derived))?;
            let _ = writeln!(
                self.out,
                "Lemma {axis}_differs : {axis} printed = {axis} derived + ({besides}).\nProof. cbv [{axis} printed derived]; angles; \
                 settle. Qed."
            );
        }
        Ok(())
    }

    /// The values at which the two differ, and that the claim is therefore false.
    fn witness(
        &mut self,
        printed: &[Poly; 3],
        derived: &[Poly; 3],
        verdict: &FormVerdict,
    ) -> Result<(), Refusal> {
        let difference = verdict.differences.first().ok_or(Refusal::NoWitness)?;
        let component = difference.component.index();
        let axis = difference.component.to_string();
        let one = Expanded::new(&Poly::one())?;
        let formulas =
            [[Expanded::new(&printed[component])?, one.clone()], [Expanded::new(&derived[component])?, one]];
        // Errors that have no part in the difference are zero.
        let declared = self.certificate.declared;
        let without_part = |symbol: &SymbolId| {
            declared.is_error(*symbol) && difference.error.iter().all(|(other, _)| other != symbol)
        };
        let zeros: Vec<SymbolId> = self.used.iter().copied().filter(without_part).collect();
        let differs = Expanded::new(&claimed(verdict, component))?;
        let Place { at: [printed, derived], premises, intros, by_value, points } =
            self.place(differs, &formulas, &zeros)?;
        let _ = writeln!(
            self.out,
            "\n(* Where the two are different numbers: {axis} is {printed} as printed, {derived} as derived. *)\n\
             Lemma there : {premises}~ claim.\nProof.\n  intros {intros} C.\n  \
             assert (E : {axis} printed = {printed}) by (cbv [{axis} printed]; {by_value}).\n  \
             assert (D : {axis} derived = {derived}) by (cbv [{axis} derived]; {by_value}).\n  \
             assert (H := f_equal {axis} (one_error _ _ _ _ C is_derived)). rewrite E, D in H. different H.\nQed."
        );
        self.conclude("So the formula as printed is not the error.", &points)
    }

    /// Values at which two formulas, each what stands above and below its stroke, are different numbers, `differs` being what the one has and the other has not.
    pub(super) fn place(
        &self,
        mut differs: Expanded,
        formulas: &[[Expanded; 2]; 2],
        zeros: &[SymbolId],
    ) -> Result<Place, Refusal> {
        let circles = self.angles.symbols();
        let numbers: BTreeSet<SymbolId> = formulas
            .iter()
            .flatten()
            .flat_map(|formula| formula.0.keys().flatten())
            .filter(|(_, part, _)| *part == Part::Value)
            .map(|(symbol, ..)| *symbol)
            .collect();
        let search = Search {
            conditions: &self.conditions,
            is_angle: &|symbol| circles.contains(&symbol),
            is_number: &|symbol| numbers.contains(&symbol),
        };
        let declared = self.certificate.declared;
        let mut values: Vec<(SymbolId, Value)> = Vec::new();
        for &symbol in zeros {
            values.push((symbol, Value::whole(0)));
            differs = substitute(&differs, symbol, &Value::whole(0)).ok_or(Refusal::NoWitness)?;
        }
        let involved: BTreeSet<SymbolId> = differs
            .0
            .keys()
            .flatten()
            .map(|(symbol, ..)| *symbol)
            .filter(|symbol| *symbol != SymbolId::PI)
            .collect();
        if involved.iter().any(|symbol| declared.chain().ramp(*symbol).is_some()) {
            return Err(Refusal::Ramp);
        }
        let bounded = self.conditions.iter().flat_map(|condition| match condition {
            Condition::Wave(..) => Vec::new(),
            Condition::NonZero(amount) | Condition::Positive(amount) => amount.symbols(),
        });
        let mut involved: Vec<SymbolId> = involved.into_iter().collect();
        for symbol in bounded {
            if symbol != SymbolId::PI && !involved.contains(&symbol) {
                involved.push(symbol);
            }
        }
        values.extend(search.find(&differs, &involved).ok_or(Refusal::NoWitness)?);
        for &symbol in &self.used {
            if values.iter().all(|(other, _)| *other != symbol) {
                let zero = Value::whole(0);
                let mut allowed = search.values(symbol);
                let value = if allowed.contains(&zero) {
                    zero
                } else {
                    allowed.drain(..).next().ok_or(Refusal::NoWitness)?
                };
                values.push((symbol, value));
            }
        }
        values.sort_by_key(|(symbol, _)| *symbol);
        let there = |formula: &Expanded| {
            let all = values
                .iter()
                .try_fold(formula.clone(), |formula, (symbol, value)| substitute(&formula, *symbol, value));
            all.ok_or(Refusal::NoWitness)
        };
        let at = |[above, below]: &[Expanded; 2]| -> Result<String, Refusal> {
            let inverse = there(below)?.as_constant().and_then(|below| below.recip());
            let value = there(above)?.scale(&inverse.ok_or(Refusal::NoWitness)?);
            Ok(value.write(&|_| "PI".to_owned()))
        };
        let equations: Vec<(String, String)> =
            values.iter().flat_map(|(symbol, value)| value.equations(&self.name(*symbol))).collect();
        let names: Vec<String> = (0..equations.len()).map(|index| format!("at_{index}")).collect();
        let rewrites: Vec<String> = names.iter().map(|name| format!("?{name}")).collect();
        let rewrites =
            if rewrites.is_empty() { String::new() } else { format!("rewrite {}; ", rewrites.join(", ")) };
        let mut points = String::new();
        for (index, [cosine, sine]) in values.iter().filter_map(|(_, value)| value.point()).enumerate() {
            let _ = write!(
                points,
                "destruct (circle ({cosine}) ({sine})) as (angle_{index} & cosine_{index} & sine_{index}); [lra|]. "
            );
        }
        let [first, second] = formulas;
        Ok(Place {
            at: [at(first)?, at(second)?],
            premises: equations.iter().map(|(left, right)| format!("{left} = {right} -> ")).collect(),
            intros: names.join(" "),
            by_value: format!("angles; {rewrites}values"),
            points,
        })
    }

    /// From one place at which the claim is wrong: it is not true of all values. The section is closed.
    pub(super) fn conclude(&mut self, said: &str, points: &str) -> Result<(), Refusal> {
        self.close_section();
        let names: Vec<String> = self.used.iter().map(|symbol| self.name(*symbol)).collect();
        let conditions = self
            .conditions
            .iter()
            .map(|condition| Ok(format!("{} -> ", self.condition(condition)?)))
            .collect::<Result<Vec<String>, Refusal>>()?;
        let (all, names) = match names.join(" ") {
            none if none.is_empty() => (String::new(), String::new()),
            names => (format!("forall {names} : R, "), format!(" {names}")),
        };
        let _ = writeln!(
            self.out,
            "(* {said} *)\nTheorem differs : ~ ({all}{}claim{names}).\nProof.\n  intro H. {points}\
             eapply there; try reflexivity; try eassumption; try apply H;\n    \
             repeat match goal with E : _ = _ |- _ => rewrite E; clear E end; values.\nQed.",
            conditions.concat(),
        );
        Ok(())
    }
}

/// A place at which two formulas are different numbers, in Coq's syntax.
pub(super) struct Place {
    /// The two numbers.
    pub at: [String; 2],
    /// `alpha = 0 -> beta = PI / 2 -> `
    pub premises: String,
    /// Names for these premises.
    pub intros: String,
    /// What calculates a formula there.
    pub by_value: String,
    /// Angles of which only cosine and sine are given: that there are such.
    pub points: String,
}

/// What is printed less what is derived in a component, from the differences.
fn claimed(verdict: &FormVerdict, component: usize) -> Poly {
    verdict.differences.iter().filter(|difference| difference.component.index() == component).fold(
        Poly::zero(),
        |sum, difference| {
            &sum + &(&difference.error_product() * &(&difference.printed.above - &difference.derived.above))
        },
    )
}
