//! What an instrument shows, without errors or with these up to an order: that a printed vector is it, or a place at which the two
//! are different numbers. How a body stands is that of its three axes and its origin.

use std::fmt::Write as _;

use super::declared::without_places;
use super::differs::Place;
use super::expanded::Expanded;
use super::section::{Question, Section};
use super::{Certificate, Refusal, ordinal};
use claims::checker::PrintedVector;
use claims::checker::entries::{Entries, EntriesOf, EntriesVerdict};
use model_core::algebra::{Poly, Rational};
use model_core::chain::ObservableId;
use model_core::expr::Expr;
use model_core::symbol::{SymbolId, SymbolKind};

/// What the columns of the matrix of a frame are.
const COLUMNS: [&str; 4] = ["x axis", "y axis", "z axis", "origin"];

impl Certificate<'_> {
    /// States that three printed formulas are what an observable shows, its errors included up to an order, and proves that they
    /// are, or that they are not.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn shown(
        &mut self,
        title: &str,
        (observable, order, kept): (ObservableId, u32, &[SymbolId]),
        printed: &[PrintedVector],
        holds: bool,
    ) -> Result<(), Refusal> {
        let [x, y, z] = printed else { return Err(Refusal::Claim) };
        let vectors = [x, y, z];
        let chain = self.declared.chain();
        if !chain.observable(observable).is_vector() || vectors.iter().any(|vector| !vector.is_plain()) {
            return Err(Refusal::Claim);
        }
        let values = vectors.map(|vector| vector.components[0].value.above.clone());
        let printed = vectors.map(|vector| without_places(&vector.components[0].expression));
        self.only_symbols_of_the_chain(&printed)?;
        let is_error = |symbol: &SymbolId| chain.symbol(*symbol).kind == SymbolKind::Error;
        let kept = if order == 0 { Vec::new() } else { kept.iter().copied().filter(is_error).collect() };
        let question = Question { observable: Some(observable), order, kept, put_in: Vec::new() };
        let name = self.names.give(title);
        let said = if holds { "holds" } else { "differs" };
        let errors = if order == 0 {
            "without errors".to_owned()
        } else {
            format!("with its errors to {} order", ordinal(order))
        };
        let heading =
            format!("{title}: what {} shows {errors}, as printed: {said}", self.observable(observable));
        let derived = Section::new(self, &question, &printed.each_ref())?.arrived();
        let formulas = self.printed(&derived)?;
        let all: Vec<&Expr<()>> = printed.iter().chain(&formulas).collect();
        let mut section = Section::new(self, &question, &all)?;
        section.open(&name, &heading)?;
        section.formula("printed", &printed);
        let statement = section.shown_statement("printed");
        let _ = writeln!(section.out, "Definition claim : Prop :=\n  {statement}.");
        section.prepare()?;
        if holds {
            section.reach_shown("printed", "holds", "claim")?;
            let section = section.close_all(&name);
            self.finish_section(section, &name, said);
            return Ok(());
        }
        section.formula("derived", &formulas);
        let statement = section.shown_statement("derived");
        section.reach_shown("derived", "is_derived", &statement)?;
        section.refute_shown(&values, &derived)?;
        let section = section.close(&name);
        self.finish_section(section, &name, said);
        Ok(())
    }

    /// States how a body stands, each axis and the origin by itself, and proves the verdicts.
    pub(super) fn frame(
        &mut self,
        title: &str,
        order: u32,
        claim: &Entries,
        verdict: &EntriesVerdict,
    ) -> Result<(), Refusal> {
        let EntriesOf::Frame { body, frame, is_homogeneous } = claim.of else { return Err(Refusal::Claim) };
        let columns = self.declared.columns_of(body, frame).ok_or(Refusal::Claim)?;
        let width = if is_homogeneous { 4 } else { 3 };
        let last_row = claim.printed.iter().skip(3 * width).enumerate();
        let is_last = |(column, printed): (usize, &PrintedVector)| {
            let wanted = Poly::constant(Rational::from(i64::from(column + 1 == width)));
            printed.is_plain() && printed.components[0].value.above == wanted
        };
        if !last_row.into_iter().all(is_last) {
            return Err(Refusal::LastRow);
        }
        let texts = std::mem::take(&mut self.printing);
        for (column, (name, observable)) in COLUMNS.into_iter().zip(columns).take(width).enumerate() {
            let at = [0, 1, 2].map(|row| row * width + column);
            let entries = at.map(|at| claim.printed.get(at).cloned()).into_iter().collect::<Option<Vec<_>>>();
            let differs = verdict
                .differences
                .iter()
                .any(|difference| at.iter().any(|&at| claim.labels.get(at) == Some(&difference.label)));
            self.printed_as(&texts);
            let title = format!("{title}, {name}");
            let entries = entries.ok_or(Refusal::Claim)?;
            self.shown(&title, (observable, order, &claim.kept), &entries, !differs)?;
        }
        Ok(())
    }
}

impl Section<'_> {
    /// That a formula is what is shown.
    fn shown_statement(&self, formula: &str) -> String {
        let (order, kind) = (self.question.order, self.kind_name());
        if order == 0 {
            return format!("shown {kind} (instrument 0) vector = {formula}");
        }
        format!("shown_to_order {order} (fun t => shown {kind} (instrument t) vector) {formula}")
    }

    /// What the steps arrive at, the errors included.
    fn arrived(&self) -> [Poly; 3] {
        let Some(last) = self.states.last() else { unreachable!("the vector itself is the first state") };
        last.each_ref().map(|jet| jet.iter().fold(Poly::zero(), |sum, part| &sum + part))
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
        let order = self.question.order;
        let proof = if order == 0 {
            "exact (shown_of _ _ _ _ _ _ _ step_0 x_of_formula y_of_formula z_of_formula).".to_owned()
        } else {
            format!(
                "apply (shown_reached {order} _ _ _ _ _ _ _ {formula} step_0); [reflexivity | reflexivity | reflexivity | \
                 rewrite <- x_of_formula | rewrite <- y_of_formula | rewrite <- z_of_formula];\n    total."
            )
        };
        let _ = writeln!(
            self.out,
            "\nTheorem {theorem} : {statement}.\nProof.\n  try unfold claim. rewrite same_chain.\n  {proof}\nQed."
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
        let same = if self.question.order == 0 {
            "eq_trans (eq_sym C) is_derived"
        } else {
            "one_shown _ _ _ _ C is_derived"
        };
        let _ = writeln!(
            self.out,
            "\n(* Where the two are different numbers: {axis} is {printed} as printed, {derived} as derived. *)\n\
             Lemma there : {premises}~ claim.\nProof.\n  intros {intros} C. unfold claim in C.\n  \
             assert (E : {axis} printed = {printed}) by (cbv [{axis} printed]; {by_value}).\n  \
             assert (D : {axis} derived = {derived}) by (cbv [{axis} derived]; {by_value}).\n  \
             assert (H := f_equal {axis} ({same})). rewrite E, D in H. different H.\nQed."
        );
        self.conclude("So the formula as printed is not what is shown.", &points)
    }
}
