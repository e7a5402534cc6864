//! The proof that a formula is the error: the vector and its derivatives after each factor, one line of algebra each.

use std::fmt::Write as _;

use super::expression;
use super::jets;
use super::leaf;
use super::passage::Jet;
use super::section::Section;
use super::{Refusal, motion};
use model_core::algebra::{AngleSum, Poly};
use model_core::chain::{ObservableKind, TransformKind};
use model_core::expr::Expr;

impl Section<'_> {
    /// What angles come to, and that the instrument is the list of factors that the proof goes through.
    pub(super) fn prepare(&mut self) -> Result<(), Refusal> {
        self.out.push_str("\n(* The proof. How sums of angles are taken apart: *)\n");
        let mut lemmas = String::new();
        self.angles.write(&mut lemmas, &|symbol| self.name(symbol))?;
        self.out.push_str(&lemmas);
        self.out.push_str("\n(* The factors, from the last to the first. *)\n");
        let count = self.factors.len();
        let _ = writeln!(self.out, "Definition from_{count} (t : R) : list motion := [].");
        for index in (0..count).rev() {
            let (head, amount) = (self.head(index), self.amount_text(index, true));
            let next = index + 1;
            let _ = writeln!(
                self.out,
                "Definition from_{index} (t : R) : list motion := {head} {amount} :: from_{next} t."
            );
        }
        self.out.push_str("Lemma same_chain : instrument = from_0. Proof. reflexivity. Qed.\n");
        Ok(())
    }

    /// That a formula, in canonical form, is what the steps arrive at.
    pub(super) fn canonical(&mut self, formula: &str) -> Result<(), Refusal> {
        let [x, y, z] = self.total()?;
        let _ = writeln!(self.out, "\n(* The formula in canonical form. *)");
        for (axis, value) in ["x", "y", "z"].into_iter().zip([x, y, z]) {
            let _ = writeln!(
                self.out,
                "Lemma {axis}_of_formula : {axis} {formula} = {value}.\nProof. cbv [{axis} {formula}]; angles; settle. Qed."
            );
        }
        Ok(())
    }

    /// The error in canonical form.
    fn total(&self) -> Result<[String; 3], Refusal> {
        let Some(last) = self.states.last() else { unreachable!("the vector itself is the first state") };
        let sums = last.each_ref().map(|jet| jet.iter().skip(1).fold(Poly::zero(), |sum, part| &sum + part));
        let [x, y, z] = sums.each_ref().map(|sum| self.poly(sum));
        Ok([x?, y?, z?])
    }

    /// The steps, and the theorem that a formula, whose canonical form is proved, is the error.
    pub(super) fn reach(&mut self, formula: &str, theorem: &str, statement: &str) -> Result<(), Refusal> {
        self.write_steps()?;
        let _ = writeln!(
            self.out,
            "\nTheorem {theorem} : {statement}.\nProof.\n  try unfold claim. rewrite same_chain.\n  apply (reached {} _ _ _ _ {formula} \
             step_0); [reflexivity | reflexivity | reflexivity | rewrite x_of_formula | rewrite y_of_formula | rewrite z_of_formula];\n    \
             total.\nQed.",
            self.question.order
        );
        Ok(())
    }

    /// The vector and its derivatives after each factor.
    pub(super) fn write_steps(&mut self) -> Result<(), Refusal> {
        let count = self.factors.len();
        let kind = self.kind_name();
        let orders = self.question.order + 1;
        self.out.push_str("\n(* What the last factors show, with its derivatives: x, y, z, from the last factor to all of them. *)\n");
        for index in (0..=count).rev() {
            let state = &self.states[count - index];
            let mut lists = String::new();
            for jet in state {
                let entries = jets::derivatives(jet)
                    .iter()
                    .map(|part| self.poly(part))
                    .collect::<Result<Vec<_>, _>>()?;
                let _ = write!(lists, "\n  [{}]", entries.join("; "));
            }
            let _ = writeln!(self.out, "Lemma step_{index} : follows {kind} from_{index} vector{lists}.");
            let proof = if index == count {
                format!(
                    "eapply same_follows; [exact (device {kind} vector from_{index} {orders} (fun _ => eq_refl))|..];\n  cbv [vector]; \
                     entries."
                )
            } else {
                self.step(index)?
            };
            let _ = writeln!(self.out, "Proof. {proof} Qed.");
        }
        Ok(())
    }

    /// The proof of the step that one factor makes.
    fn step(&self, index: usize) -> Result<String, Refusal> {
        let factor = &self.factors[index];
        let jet = &factor.jet;
        let before = format!("step_{}", index + 1);
        let amount = format!("(fun t : R => {})", self.amount_text(index, false));
        if factor.kind == TransformKind::Translation && self.kind == ObservableKind::Direction {
            return Ok(format!("exact (translated_direction _ {amount} _ _ _ _ _ {before})."));
        }
        if jet.iter().all(Poly::is_zero) {
            let rule = match factor.kind {
                TransformKind::Rotation => "no_rotation",
                TransformKind::Translation => "no_translation",
            };
            return Ok(format!("refine ({rule} _ _ {amount} _ _ _ _ _ _ {before}); is_polynomial."));
        }
        let coefficients = self.coefficients(index, jet)?;
        let axis = factor.axis;
        Ok(match factor.kind {
            TransformKind::Translation => format!("translate_{axis} {before} {amount} ([{coefficients}])."),
            TransformKind::Rotation => {
                let angle = AngleSum::from_poly(&jet[0])?;
                let (cosine, sine) = angle.cos_sin();
                format!(
                    "rotate_{axis} {before} {amount} ([{coefficients}]) ({}) ({}).",
                    self.poly(&cosine)?,
                    self.poly(&sine)?
                )
            }
        })
    }

    /// An amount by powers of t, the one without t as written.
    fn coefficients(&self, index: usize, jet: &Jet) -> Result<String, Refusal> {
        let highest = jet.iter().rposition(|part| !part.is_zero()).unwrap_or(0);
        let mut texts = Vec::new();
        for (degree, part) in jet.iter().take(highest + 1).enumerate() {
            // An amount either stands by design, and has no errors, or vanishes with them.
            texts.push(if degree == 0 && !part.is_zero() {
                self.amount_text(index, false)
            } else {
                self.poly(part)?
            });
        }
        Ok(texts.join("; "))
    }

    /// `Rx` to `Tz`.
    fn head(&self, index: usize) -> String {
        let factor = &self.factors[index];
        motion(factor.kind, factor.axis)
    }

    /// An amount as written, every error multiplied by t.
    fn amount_text(&self, index: usize, as_argument: bool) -> String {
        let declared = self.certificate.declared;
        let scaled = |symbol| self.scaled(symbol);
        let symbol = |leaf: &Expr<()>| leaf::leaf(declared, leaf, &scaled);
        let written = &self.factors[index].written;
        if as_argument { expression::argument(written, &symbol) } else { expression::write(written, &symbol) }
    }
}
