//! That two printed formulas are one, or a place at which they are different numbers.

use std::fmt::Write as _;

use super::declared::without_places;
use super::expanded::Expanded;
use super::section::{Question, Section};
use super::{Certificate, Refusal};
use claims::checker::{Equality, EqualityVerdict};
use model_core::algebra::Poly;

impl Certificate<'_> {
    /// States that two printed formulas are one at all values of their symbols, and proves the verdict on it.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn equality(
        &mut self,
        title: &str,
        claim: &Equality,
        verdict: &EqualityVerdict,
    ) -> Result<(), Refusal> {
        if !claim.is_plain() {
            return Err(Refusal::Claim);
        }
        let printed = claim.formulas().map(|formula| without_places(&formula.expression));
        self.only_symbols_of_the_chain(&printed)?;
        let question = Question { observable: None, order: 1, kept: Vec::new(), put_in: Vec::new() };
        let holds = verdict.difference.is_zero();
        let name = self.names.give(title);
        let said = if holds { "holds" } else { "differs" };
        let mut section = Section::of_numbers(self, &question, &printed)?;
        section.open_plain(
            &name,
            &format!("{title}: the equality of two formulas, as printed: {said}"),
            None,
        )?;
        for (which, formula) in ["first_formula", "second_formula"].into_iter().zip(&printed) {
            let formula = section.written(formula);
            let _ = writeln!(section.out, "Definition {which} : R :=\n  {formula}.");
        }
        section.out.push_str("Definition claim : Prop := first_formula = second_formula.\n");
        if holds {
            section.out.push_str(
                "Theorem holds : claim.\nProof. cbv [claim first_formula second_formula]; angles; settle. Qed.\n",
            );
            section.close_section();
        } else {
            let one = Expanded::new(&Poly::one())?;
            let [first, second] = claim.formulas().map(|formula| Expanded::new(&formula.value.above));
            let quotients = [[first?, one.clone()], [second?, one]];
            let place = section.place(Expanded::new(&verdict.difference.above)?, &quotients, &[])?;
            let [first, second] = &place.at;
            let by_value = &place.by_value;
            let _ = writeln!(
                section.out,
                "(* Where the two are different numbers: {first} and {second}. *)\nLemma there : {}~ claim.\nProof.\n  \
                 intros {} C. unfold claim in C.\n  \
                 assert (E : first_formula = {first}) by (cbv [first_formula]; {by_value}).\n  \
                 assert (D : second_formula = {second}) by (cbv [second_formula]; {by_value}).\n  \
                 rewrite E, D in C. different C.\nQed.",
                place.premises, place.intros,
            );
            section.conclude("So the two are not the same.", &place.points)?;
        }
        let section = section.close(&name);
        self.finish_section(section, &name, said);
        Ok(())
    }
}
