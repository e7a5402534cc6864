//! What one error does to an observable: that it does nothing, the same as another, or the same as several together.

use std::fmt::Write as _;

use super::section::{Question, Section};
use super::{Certificate, Refusal, vector_to_order};
use model_core::algebra::Poly;
use model_core::chain::ObservableId;
use model_core::expr::Expr;
use model_core::identify::{Alike, Dependence, Identifiability, Ratio, put_in, special};
use model_core::symbol::{SymbolId, SymbolKind};

/// A theorem on what one error does, the others being zero, to first order.
#[derive(Debug, Clone)]
pub(super) struct Influence {
    observable: ObservableId,
    pub(super) error: SymbolId,
    /// The name of its module.
    pub(super) module: String,
    /// The symbols of its formula, in order.
    pub(super) symbols: Vec<SymbolId>,
    /// What the error does.
    pub(super) formula: [Expr<()>; 3],
    /// The same in canonical form.
    pub(super) components: [Poly; 3],
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
        let chain = self.declared.chain();
        let name = |symbol: SymbolId| chain.symbol(symbol).name.clone();
        let wanted = format!("{}_as_{}_on_{}", name(other), name(first), chain.observable(observable).name);
        let title = format!(
            "{} and {} are one and the same to {}, up to a factor that does not vary",
            name(other),
            name(first),
            chain.observable(observable).name
        );
        self.related(observable, &wanted, &title, other, &[(first, ratio.clone())])
    }

    /// States and proves that what an error does to an observable is a sum of multiples of what others do, to first order.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn dependent(&mut self, observable: ObservableId, dependence: &Dependence) -> Result<(), Refusal> {
        let chain = self.declared.chain();
        let name = |symbol: SymbolId| chain.symbol(symbol).name.as_str();
        let others: Vec<&str> = dependence.others.iter().map(|(other, _)| name(*other)).collect();
        let shown = &chain.observable(observable).name;
        let wanted = format!("{}_by_others_on_{shown}", name(dependence.error));
        let title = format!(
            "To {shown}, {} is a combination of {} that does not vary",
            name(dependence.error),
            others.join(", ")
        );
        self.related(observable, &wanted, &title, dependence.error, &dependence.others)
    }

    /// What an answer says of errors: which have no influence, which are the same as another or as several others, and that the rest
    /// is independent. What Coq cannot be shown is noted with its reason, and the rest is proved.
    pub fn identifiability(&mut self, found: &Identifiability, is_asked: impl Fn(SymbolId) -> bool) {
        let asked: Vec<SymbolId> =
            self.declared.chain().symbols_of(SymbolKind::Error).filter(|error| is_asked(*error)).collect();
        let name = |own: &Self, error: SymbolId| own.declared.chain().symbol(error).name.clone();
        for &observable in &found.observables {
            for &error in found.invisible.iter().filter(|error| is_asked(**error)) {
                let written = self.without_influence(observable, error);
                self.note(&format!("that {} has no influence", name(self, error)), written);
            }
            for (first, other) in pairs(found) {
                let written = self.alike(observable, first.error, other.error, &other.ratio);
                let title =
                    format!("that {} and {} are one", name(self, first.error), name(self, other.error));
                self.note(&title, written);
            }
            for dependence in &found.combinations {
                let written = self.dependent(observable, dependence);
                let title = format!("that {} is a combination of others", name(self, dependence.error));
                self.note(&title, written);
            }
        }
        let is_dependent = |error: &SymbolId| {
            found.invisible.contains(error)
                || pairs(found).any(|(_, other)| other.error == *error)
                || found.combinations.iter().any(|dependence| dependence.error == *error)
        };
        let rest: Vec<SymbolId> = asked.into_iter().filter(|error| !is_dependent(error)).collect();
        if !rest.is_empty() {
            let written = self.independent(&found.observables, &rest, &rest);
            self.note("that the other errors are independent", written);
        }
    }

    /// Notes what was refused.
    fn note(&mut self, title: &str, written: Result<(), Refusal>) {
        if let Err(refusal) = written {
            self.not_certified(title, &refusal.to_string());
        }
    }

    /// That an error is a sum of multiples of others, in one module.
    fn related(
        &mut self,
        observable: ObservableId,
        wanted: &str,
        title: &str,
        error: SymbolId,
        others: &[(SymbolId, Ratio)],
    ) -> Result<(), Refusal> {
        let mut influences = Vec::with_capacity(others.len());
        for (other, _) in others {
            influences.push(self.influence(observable, *other)?);
        }
        let own = self.influence(observable, error)?;
        if self.theorems.iter().any(|theorem| *theorem == format!("{wanted}.holds")) {
            return Ok(());
        }
        let module = self.names.give(wanted);
        let mut kept: Vec<SymbolId> = others.iter().map(|(other, _)| *other).chain([error]).collect();
        kept.sort_unstable();
        let question =
            Question { observable: Some(observable), order: 1, kept, put_in: special(self.declared.chain()) };
        let certificate = &*self;
        // Multiplied by every denominator.
        let without = |skipped: Option<usize>| {
            let mut kept = others.iter().enumerate().filter(|(at, _)| Some(*at) != skipped);
            kept.try_fold(Poly::one(), |product, (_, (_, ratio))| product.checked_mul(&ratio.denominator))
        };
        let mut factors = vec![certificate.as_printed(&without(None)?)?];
        for (at, (_, ratio)) in others.iter().enumerate() {
            factors.push(certificate.as_printed(&ratio.numerator.checked_mul(&without(Some(at))?)?)?);
        }
        let shown = influences.iter().chain([&own]).flat_map(|influence| &influence.formula);
        let references: Vec<&Expr<()>> = factors.iter().chain(shown).collect();
        let mut section = Section::new(certificate, &question, &references)?;
        section.open_plain(&module, title, Some("size"))?;
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
        let factors: Vec<String> = factors.iter().map(|factor| section.written(factor)).collect();
        let statement = |axis: &str| {
            let terms = factors[1..].iter().zip(&influences);
            let terms: Vec<String> =
                terms.map(|(factor, other)| format!("({factor}) * {axis} ({})", influence(other))).collect();
            format!("({}) * {axis} ({}) = {}", factors[0], influence(&own), terms.join(" + "))
        };
        let mut modules: Vec<&str> =
            influences.iter().chain([&own]).map(|influence| influence.module.as_str()).collect();
        modules.dedup();
        let unfolded: Vec<String> = modules.iter().map(|module| format!("{module}.derived")).collect();
        let _ = writeln!(
            section.out,
            "Theorem holds :\n  {} /\\\n  {} /\\\n  {}.\nProof.\n  cbv [x y z {}]; angles; repeat split; settle.\nQed.",
            statement("x"),
            statement("y"),
            statement("z"),
            unfolded.join(" "),
        );
        let section = section.close_all(&module);
        self.finish_section(section, &module, "holds");
        Ok(())
    }

    /// The theorem on what one error does, which is stated and proved if it is not there yet.
    pub(super) fn influence(
        &mut self,
        observable: ObservableId,
        error: SymbolId,
    ) -> Result<Influence, Refusal> {
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
        let influence = Influence { observable, error, module, symbols, formula, components };
        self.influences.push(influence.clone());
        Ok(influence)
    }
}

/// The errors that are the same as the first of their group, each with that one.
fn pairs(found: &Identifiability) -> impl Iterator<Item = (&Alike, &Alike)> {
    found
        .alike
        .iter()
        .filter_map(|group| group.split_first())
        .flat_map(|(first, others)| others.iter().map(move |other| (first, other)))
}
