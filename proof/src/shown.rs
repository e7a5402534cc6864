//! What a perfect instrument shows: that a printed vector is it, or a place at which the two are different numbers.

use std::fmt::Write as _;

use super::declared::without_places;
use super::differs::Place;
use super::expanded::Expanded;
use super::section::{Question, Section};
use super::{Certificate, Refusal};
use claims::checker::PrintedVector;
use model_core::algebra::Poly;
use model_core::chain::ObservableId;

impl Certificate<'_> {
    /// States that three printed formulas are what an observable shows without errors, and proves that they are, or that they are not.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn shown(
        &mut self,
        title: &str,
        observable: ObservableId,
        printed: &[PrintedVector],
        holds: bool,
    ) -> Result<(), Refusal> {
        let [x, y, z] = printed else { return Err(Refusal::Claim) };
        let vectors = [x, y, z];
        if !self.declared.chain().observable(observable).is_vector()
            || vectors.iter().any(|vector| !vector.is_plain())
        {
            return Err(Refusal::Claim);
        }
        let values = vectors.map(|vector| vector.components[0].value.above.clone());
        let printed = vectors.map(|vector| without_places(&vector.components[0].expression));
        self.only_symbols_of_the_chain(&printed)?;
        let question =
            Question { observable: Some(observable), order: 0, kept: Vec::new(), put_in: Vec::new() };
        let name = self.names.give(title);
        let said = if holds { "holds" } else { "differs" };
        let heading =
            format!("{title}: what {} shows without errors, as printed: {said}", self.observable(observable));
        let derived = Section::new(self, &question, &printed.each_ref())?.arrived();
        let formulas = self.printed(&derived)?;
        let mut section =
            Section::new(self, &question, &printed.iter().chain(&formulas).collect::<Vec<_>>())?;
        section.open(&name, &heading)?;
        section.formula("printed", &printed);
        let kind = section.kind_name();
        let statement = |formula: &str| format!("shown {kind} (instrument 0) vector = {formula}");
        let _ = writeln!(section.out, "Definition claim : Prop := {}.", statement("printed"));
        section.prepare()?;
        if holds {
            section.reach_shown("printed", "holds", "claim")?;
            let section = section.close_all(&name);
            self.finish_section(section, &name, said);
            return Ok(());
        }
        section.formula("derived", &formulas);
        section.reach_shown("derived", "is_derived", &statement("derived"))?;
        section.refute_shown(&values, &derived)?;
        let section = section.close(&name);
        self.finish_section(section, &name, said);
        Ok(())
    }
}

impl Section<'_> {
    /// What the steps arrive at, without errors.
    fn arrived(&self) -> [Poly; 3] {
        let Some(last) = self.states.last() else { unreachable!("the vector itself is the first state") };
        last.each_ref().map(|jet| jet[0].clone())
    }

    /// The steps, and the theorem that a formula is what is shown.
    fn reach_shown(&mut self, formula: &str, theorem: &str, statement: &str) -> Result<(), Refusal> {
        let _ = writeln!(self.out, "\n(* The formula in canonical form. *)");
        for (axis, value) in ["x", "y", "z"].into_iter().zip(self.arrived()) {
            let value = self.poly(&value)?;
            let _ = writeln!(
                self.out,
                "Lemma {axis}_of_formula : {value} = {axis} {formula}.\nProof. cbv [{axis} {formula}]; angles; settle. Qed."
            );
        }
        self.write_steps()?;
        let _ = writeln!(
            self.out,
            "\nTheorem {theorem} : {statement}.\nProof.\n  try unfold claim. rewrite same_chain.\n  \
             exact (shown_of _ _ _ _ _ _ _ step_0 x_of_formula y_of_formula z_of_formula).\nQed."
        );
        Ok(())
    }

    /// A place at which printed and derived are different numbers.
    fn refute_shown(&mut self, printed: &[Poly; 3], derived: &[Poly; 3]) -> Result<(), Refusal> {
        let differences = printed.iter().zip(derived).map(|(printed, derived)| printed - derived);
        let (at, difference) = differences
            .enumerate()
            .find(|(_, difference)| !difference.is_zero())
            .ok_or(Refusal::NoWitness)?;
        let axis = ["x", "y", "z"][at];
        let one = Expanded::new(&Poly::one())?;
        let formulas = [[Expanded::new(&printed[at])?, one.clone()], [Expanded::new(&derived[at])?, one]];
        let Place { at: [printed, derived], premises, intros, by_value, points } =
            self.place(Expanded::new(&difference)?, &formulas, &[])?;
        let _ = writeln!(
            self.out,
            "\n(* Where the two are different numbers: {axis} is {printed} as printed, {derived} as derived. *)\n\
             Lemma there : {premises}~ claim.\nProof.\n  intros {intros} C. unfold claim in C.\n  \
             assert (E : {axis} printed = {printed}) by (cbv [{axis} printed]; {by_value}).\n  \
             assert (D : {axis} derived = {derived}) by (cbv [{axis} derived]; {by_value}).\n  \
             assert (H := f_equal {axis} (eq_trans (eq_sym C) is_derived)). rewrite E, D in H. different H.\nQed."
        );
        self.conclude("So the formula as printed is not what is shown.", &points)
    }
}
