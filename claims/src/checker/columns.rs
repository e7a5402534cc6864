//! A Jacobian as closed forms: each of its columns is what one variable alone does, to first order.

use super::entries::{Entries, EntriesOf};
use super::formula::PrintedVector;
use super::{ClosedForm, Order};
use crate::latex::Notes;
use model_core::chain::{Chain, ObservableId};
use model_core::expr::{Expr, Node};
use model_core::symbol::SymbolId;

/// A column of a Jacobian, and what it belongs to.
#[derive(Debug, Clone)]
pub struct Column {
    /// Of what.
    pub observable: ObservableId,
    /// By which symbol.
    pub by: SymbolId,
    /// That the column, times the variable, is what the variable alone does.
    pub form: ClosedForm,
}

impl Entries {
    /// The columns of a Jacobian of whole vectors, where `standing` names the error of this chain that stands for each variable.
    /// `None` for entries of another kind, and where a variable has no error that stands for it.
    #[must_use]
    pub fn columns(
        &self,
        chain: &Chain,
        standing: impl Fn(SymbolId) -> Option<SymbolId>,
    ) -> Option<Vec<Column>> {
        let (EntriesOf::Jacobian { observables, by }, None) = (&self.of, self.only) else { return None };
        let mut columns = Vec::with_capacity(observables.len() * by.len());
        for (block, &observable) in observables.iter().enumerate() {
            let shown = chain.observable(observable);
            if !shown.is_vector() || shown.is_orientation() {
                return None;
            }
            for (column, &variable) in by.iter().enumerate() {
                let error = standing(variable)?;
                let entry = |row: usize| {
                    let printed = self.printed.get((3 * block + row) * by.len() + column)?;
                    let entry = printed.components[0].expression.clone();
                    let place = entry.place.clone();
                    let name = Node::Symbol(chain.symbol(error).name.clone());
                    let factor = Expr { node: name, place: place.clone() };
                    Some(Expr { node: Node::Mul(Box::new(entry), Box::new(factor)), place })
                };
                let entries = [entry(0)?, entry(1)?, entry(2)?];
                let printed = PrintedVector::of_expressions(chain, entries, Notes::default()).ok()?;
                columns.push(Column {
                    observable,
                    by: variable,
                    form: ClosedForm {
                        observable,
                        order: Order::UpTo(1),
                        only: None,
                        faces: None,
                        kept: vec![error],
                        printed,
                    },
                });
            }
        }
        Some(columns)
    }
}
