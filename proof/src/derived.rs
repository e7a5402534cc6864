//! What the chain implies, stated and proved: of a whole vector, wherever it is placed, or as it is placed where that is too
//! much for Coq.

use super::section::{Question, Section};
use super::{Certificate, Refusal, ordinal, vector_to_order};
use model_core::algebra::Poly;
use model_core::chain::ObservableId;
use model_core::expr::Expr;
use model_core::identify::{put_in, special};
use model_core::symbol::SymbolKind;

impl Certificate<'_> {
    /// States and proves the error of an observable up to an order, as [`model_core::print::text`] prints it.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn derived(&mut self, observable: ObservableId, order: u32) -> Result<(), Refusal> {
        let chain = self.declared.chain();
        if !chain.observable(observable).is_vector() {
            return self.derived_readings(observable, order);
        }
        let derived = self.printed(&vector_to_order(chain, observable, order)?)?;
        let question = Question {
            observable: Some(observable),
            order,
            kept: chain.symbols_of(SymbolKind::Error).collect(),
            put_in: Vec::new(),
        };
        let title = format!("The error of {} to {} order", chain.observable(observable).name, ordinal(order));
        let name = self.names.give(&chain.observable(observable).name);
        match self.whole_vector(&question, &name, &title, &derived) {
            Err(Refusal::TooLarge { .. }) => self.smaller(question, &title),
            other => other,
        }
    }

    /// What is too much for Coq at once, with the constants put in that are declared as zero or as quarter turns.
    fn smaller(&mut self, question: Question, title: &str) -> Result<(), Refusal> {
        let chain = self.declared.chain();
        let (observable, order) = (question.observable(), question.order);
        let special = special(chain);
        let put = |component: &Poly| put_in(component, &special);
        let [x, y, z] = vector_to_order(chain, observable, order)?.each_ref().map(put);
        let derived = self.printed(&[x?, y?, z?])?;
        let name = self.names.give(&format!("{}_as_placed", chain.observable(observable).name));
        let title =
            format!("{title}, with the constants put in that are declared as zero or as quarter turns");
        self.whole_vector(&Question { put_in: special, ..question }, &name, &title, &derived)
    }

    /// States that a formula is the error of a vector, and proves it.
    fn whole_vector(
        &mut self,
        question: &Question,
        name: &str,
        title: &str,
        derived: &[Expr<()>; 3],
    ) -> Result<(), Refusal> {
        let mut section = Section::new(self, question, &derived.each_ref())?;
        section.open(name, title)?;
        section.formula("derived", derived);
        section.claim("derived");
        section.prove("derived", "holds", "claim")?;
        let section = section.close_all(name);
        self.finish_section(section, name, "holds");
        Ok(())
    }
}
