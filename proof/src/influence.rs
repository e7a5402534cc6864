//! What one error does to an observable: that it does nothing, or the same as another.

use std::fmt::Write as _;

use super::section::{Question, Section};
use super::{Certificate, Refusal, vector_to_order};
use model_core::algebra::Poly;
use model_core::chain::ObservableId;
use model_core::identify::Ratio;
use model_core::identify::{put_in, special};
use model_core::symbol::SymbolId;

/// A theorem on what one error does, the others being zero, to first order.
#[derive(Debug, Clone)]
pub(super) struct Influence {
    observable: ObservableId,
    error: SymbolId,
    /// The name of its module.
    module: String,
    /// The symbols of its formula, in order.
    symbols: Vec<SymbolId>,
}

impl Certificate<'_> {
    /// States and proves that an error has no influence on an observable, to first order.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn without_influence(&mut self, observable: ObservableId, error: SymbolId) -> Result<(), Refusal> {
        self.influence(observable, error).map(|_| ())
    }

    /// States and proves that what an error does to an observable is `ratio` times what the first one does, to first order.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn alike(
        &mut self,
        observable: ObservableId,
        first: SymbolId,
        other: SymbolId,
        ratio: &Ratio,
    ) -> Result<(), Refusal> {
        let first_influence = self.influence(observable, first)?;
        let other_influence = self.influence(observable, other)?;
        let chain = self.declared.chain();
        let name = |symbol: SymbolId| chain.symbol(symbol).name.clone();
        let wanted = format!("{}_as_{}_on_{}", name(other), name(first), chain.observable(observable).name);
        let title = format!(
            "{} and {} are one and the same to {}, up to a factor that does not vary",
            name(other),
            name(first),
            chain.observable(observable).name
        );
        if self.theorems.iter().any(|theorem| *theorem == format!("{wanted}.holds")) {
            return Ok(());
        }
        let module = self.names.give(&wanted);
        let question = Question {
            observable: Some(observable),
            order: 1,
            kept: vec![first, other],
            put_in: special(chain),
        };
        let certificate = &*self;
        let formulas = [&ratio.numerator, &ratio.denominator];
        let numbers = [
            certificate.as_printed(formulas[0])?,
            certificate.as_printed(formulas[1])?,
            certificate.as_printed(&Poly::zero())?,
        ];
        let mut section = Section::new(certificate, &question, &numbers.each_ref())?;
        section.open_plain(&module, &title, Some("size"))?;
        let influence = |influence: &Influence| {
            let arguments = influence.symbols.iter().map(|symbol| {
                if *symbol == influence.error {
                    " size".to_owned()
                } else {
                    format!(" {}", certificate.symbol(*symbol))
                }
            });
            format!("{}.derived{}", influence.module, arguments.collect::<String>())
        };
        let [above, below, _] = numbers.each_ref().map(|number| section.written(number));
        let (a, b) = (influence(&first_influence), influence(&other_influence));
        let statement = |axis: &str| format!("({below}) * {axis} ({b}) = ({above}) * {axis} ({a})");
        let _ = writeln!(
            section.out,
            "Theorem holds :\n  {} /\\\n  {} /\\\n  {}.\nProof.\n  cbv [x y z {}.derived {}.derived]; angles; repeat split; \
             settle.\nQed.",
            statement("x"),
            statement("y"),
            statement("z"),
            first_influence.module,
            other_influence.module,
        );
        let section = section.close_all(&module);
        self.finish_section(section, &module, "holds");
        Ok(())
    }

    /// The theorem on what one error does, which is stated and proved if it is not there yet.
    fn influence(&mut self, observable: ObservableId, error: SymbolId) -> Result<Influence, Refusal> {
        let same = |influence: &&Influence| influence.observable == observable && influence.error == error;
        if let Some(found) = self.influences.iter().find(same) {
            return Ok(found.clone());
        }
        let chain = self.declared.chain();
        let special = special(chain);
        let form = vector_to_order(chain, observable, 1)?;
        let only = |component: &Poly| {
            let others = |symbol: SymbolId| self.declared.is_error(symbol) && symbol != error;
            put_in(&component.graded_part(others, 0), &special).map_err(|_| Refusal::Divisor)
        };
        let [x, y, z] = form.each_ref().map(only);
        let components = [x?, y?, z?];
        let formula = self.printed(&components)?;
        let (name, shown) = (&chain.symbol(error).name, &chain.observable(observable).name);
        let title = if components.iter().all(Poly::is_zero) {
            format!("{name} has no influence on {shown}, to first order")
        } else {
            format!("What {name} alone does to {shown}, to first order")
        };
        let mut symbols: Vec<SymbolId> =
            formula.iter().flat_map(|component| self.declared.symbols_of(component)).collect();
        symbols.sort_unstable();
        symbols.dedup();
        let module = self.names.give(&format!("{name}_on_{shown}"));
        let question =
            Question { observable: Some(observable), order: 1, kept: vec![error], put_in: special };
        let mut section = Section::new(self, &question, &formula.each_ref())?;
        section.open(&module, &title)?;
        section.formula("derived", &formula);
        section.claim("derived");
        section.prove("derived", "holds", "claim")?;
        let section = section.close_all(&module);
        self.finish_section(section, &module, "holds");
        let influence = Influence { observable, error, module, symbols };
        self.influences.push(influence.clone());
        Ok(influence)
    }
}
