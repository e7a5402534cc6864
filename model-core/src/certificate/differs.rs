//! The proof that a printed formula is not the error: in which terms it differs from the derived one, and values at which
//! the two are different numbers.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::Refusal;
use super::expanded::{Expanded, Part};
use super::section::Section;
use super::witness::{Search, Value, substitute};
use crate::algebra::Poly;
use crate::checker::{ClosedForm, FormVerdict};
use crate::symbol::SymbolId;

impl Section<'_> {
    /// The whole proof; the section is closed.
    pub(super) fn refute(&mut self, claim: &ClosedForm, verdict: &FormVerdict) -> Result<(), Refusal> {
        let printed = claim.printed.components.each_ref().map(|component| component.value.above.clone());
        self.prepare()?;
        self.difference(&printed, &verdict.derived)?;
        self.canonical("derived")?;
        let statement = self.statement("derived");
        self.reach("derived", "is_derived", &statement)?;
        self.witness(&printed, verdict)
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
    fn witness(&mut self, printed: &[Poly; 3], verdict: &FormVerdict) -> Result<(), Refusal> {
        let difference = verdict.differences.first().ok_or(Refusal::NoWitness)?;
        let component = difference.component.index();
        let axis = difference.component.to_string();
        let (printed, derived) =
            (Expanded::new(&printed[component])?, Expanded::new(&verdict.derived[component])?);
        let mut differs = Expanded::new(&claimed(verdict, component))?;
        let circles = self.angles.symbols();
        let numbers: BTreeSet<SymbolId> = printed
            .0
            .keys()
            .chain(derived.0.keys())
            .flatten()
            .filter(|(_, part, _)| *part == Part::Value)
            .map(|(symbol, ..)| *symbol)
            .collect();
        let conditions = self.conditions.clone();
        let search = Search {
            conditions: &conditions,
            is_angle: &|symbol| circles.contains(&symbol),
            is_number: &|symbol| numbers.contains(&symbol),
        };
        // Errors that have no part in the difference are zero.
        let declared = self.certificate.declared;
        let mut values: Vec<(SymbolId, Value)> = Vec::new();
        for &symbol in &self.used {
            if declared.is_error(symbol) && difference.error.iter().all(|(other, _)| *other != symbol) {
                values.push((symbol, Value::whole(0)));
                differs = substitute(&differs, symbol, &Value::whole(0)).ok_or(Refusal::NoWitness)?;
            }
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
        let involved: Vec<SymbolId> = involved.into_iter().collect();
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
        let at = |formula: &Expanded| -> Result<String, Refusal> {
            let mut formula = formula.clone();
            for (symbol, value) in &values {
                formula = substitute(&formula, *symbol, value).ok_or(Refusal::NoWitness)?;
            }
            Ok(formula.write(&|_| "PI".to_owned()))
        };
        let (printed_value, derived_value) = (at(&printed)?, at(&derived)?);
        let equations: Vec<(String, String)> =
            values.iter().flat_map(|(symbol, value)| value.equations(&self.name(*symbol))).collect();
        let premises: Vec<String> =
            equations.iter().map(|(left, right)| format!("{left} = {right} -> ")).collect();
        let names: Vec<String> = (0..equations.len()).map(|index| format!("at_{index}")).collect();
        let rewrites: Vec<String> = names.iter().map(|name| format!("?{name}")).collect();
        let mut points = String::new();
        for (index, [cosine, sine]) in values.iter().filter_map(|(_, value)| value.point()).enumerate() {
            let _ = write!(
                points,
                "destruct (circle ({cosine}) ({sine})) as (angle_{index} & cosine_{index} & sine_{index}); [lra|]. "
            );
        }
        let by_value = format!("angles; rewrite {}; values", rewrites.join(", "));
        let intros = names.join(" ");
        let _ = writeln!(
            self.out,
            "\n(* Where the two are different numbers: {axis} is {printed_value} as printed, {derived_value} as derived. *)\n\
             Lemma there : {}~ claim.\nProof.\n  intros {intros} C.\n  \
             assert (E : {axis} printed = {printed_value}) by (cbv [{axis} printed]; {by_value}).\n  \
             assert (D : {axis} derived = {derived_value}) by (cbv [{axis} derived]; {by_value}).\n  \
             assert (H := f_equal {axis} (one_error _ _ _ _ C is_derived)). rewrite E, D in H. different H.\nQed.",
            premises.concat()
        );
        self.close_section();
        let names: Vec<String> = self.used.iter().map(|symbol| self.name(*symbol)).collect();
        let conditions: Vec<String> =
            self.conditions.iter().map(|condition| format!("{} -> ", self.condition(*condition))).collect();
        let _ = writeln!(
            self.out,
            "(* So the formula as printed is not the error. *)\nTheorem differs : ~ (forall {} : R, {}claim {}).\nProof.\n  intro H. {points}\
             eapply there; try reflexivity; try eassumption; try apply H;\n    \
             repeat match goal with E : _ = _ |- _ => rewrite E; clear E end; values.\nQed.",
            names.join(" "),
            conditions.concat(),
            names.join(" "),
        );
        Ok(())
    }
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
