//! That errors are independent of each other: some numbers for the constants and some poses, at which no sizes of the errors but
//! zero leave what is shown as it is, to first order. One such place is enough for all but special constants.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use super::condition::Condition;
use super::expanded::{Expanded, Part};
use super::influence::Influence;
use super::minor::{self, Asked, Minor, Values};
use super::section::{Question, Section};
use super::witness::{Search, Value, substitute};
use super::{Certificate, Refusal};
use model_core::chain::ObservableId;
use model_core::expr::Expr;
use model_core::identify::special;
use model_core::symbol::{SymbolId, SymbolKind};

/// Unknowns that are solved for at most: with 27 the linear arithmetic of Coq takes ten seconds.
const UNKNOWNS_LIMIT: usize = 30;

/// The parts of the statement that its text is made of.
struct Statement {
    /// The names of the sizes, one for each error.
    sizes: Vec<String>,
    /// For each observable the sizes and symbols that it depends on, by name, in the order of the variables.
    arguments: Vec<Vec<String>>,
    constants: Vec<SymbolId>,
    joints: Vec<SymbolId>,
}

impl Certificate<'_> {
    /// States and proves that what observables show together determines the `wanted` ones of some errors, to first order, whatever
    /// the others of them are.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn independent(
        &mut self,
        observables: &[ObservableId],
        errors: &[SymbolId],
        wanted: &[SymbolId],
    ) -> Result<(), Refusal> {
        if errors.len() > UNKNOWNS_LIMIT {
            return Err(Refusal::ManyUnknowns { unknowns: errors.len(), limit: UNKNOWNS_LIMIT });
        }
        let mut influences: Vec<Vec<Influence>> = Vec::with_capacity(observables.len());
        for &observable in observables {
            let all = errors.iter().map(|&error| self.influence(observable, error));
            influences.push(all.collect::<Result<_, _>>()?);
        }
        let chain = self.declared.chain();
        let name = |symbol: &SymbolId| chain.symbol(*symbol).name.clone();
        let shown: Vec<&str> = observables.iter().map(|id| chain.observable(*id).name.as_str()).collect();
        let list = wanted.iter().map(name).collect::<Vec<_>>().join(", ");
        let others = errors.iter().filter(|error| !wanted.contains(error)).map(name).collect::<Vec<_>>();
        let among =
            if others.is_empty() { String::new() } else { format!(", whatever {} are", others.join(", ")) };
        let title =
            format!("{} determines each of {list} by itself, to first order{among}", shown.join(" and "));
        let wished = format!("independent_on_{}", shown.join("_"));
        let sizes: Vec<String> = errors.iter().map(|error| format!("size_of_{}", name(error))).collect();
        let module = self.names.give(&wished);
        let sizes: Vec<String> = sizes.iter().map(|size| self.names.give(size)).collect();
        let mut kept = errors.to_vec();
        kept.sort_unstable();
        let question = Question { observable: None, order: 1, kept, put_in: special(chain) };
        let formulas: Vec<Expr<()>> =
            influences.iter().flatten().flat_map(|influence| influence.formula.clone()).collect();
        let mut section = Section::of_numbers(self, &question, &formulas)?;
        let wanted: Vec<usize> =
            wanted.iter().filter_map(|error| errors.iter().position(|other| other == error)).collect();
        let minor = section.minor(errors, &wanted, &influences)?;
        section.open_plain(&module, &title, Some(&sizes.join(" ")))?;
        let of_kind = |is_constant: bool| {
            let is_error = |id: &SymbolId| errors.contains(id);
            let own = section.used.iter().filter(|id| !is_error(id));
            own.filter(|id| (chain.symbol(**id).kind == SymbolKind::Constant) == is_constant)
                .copied()
                .collect()
        };
        let mut statement =
            Statement { sizes, arguments: Vec::new(), constants: of_kind(true), joints: of_kind(false) };
        for (at, influences) in influences.iter().enumerate() {
            statement.arguments.push(section.write_sum(at, errors, influences, &statement.sizes));
        }
        for (row, _) in minor.rows.iter().enumerate() {
            section.write_row(row, &minor, &statement)?;
        }
        section.close_section();
        section.write_theorem(&minor, &statement, &wanted)?;
        let section = section.close(&module);
        self.finish_section(section, &module, "holds");
        Ok(())
    }
}

impl Section<'_> {
    /// Numbers at which what is shown determines the wanted errors, by their places among the errors.
    fn minor(
        &self,
        errors: &[SymbolId],
        wanted: &[usize],
        influences: &[Vec<Influence>],
    ) -> Result<Minor, Refusal> {
        let mut shown = Vec::new();
        for influences in influences {
            for axis in 0..3 {
                let of = |influence: &Influence| {
                    let formula = Expanded::new(&influence.components[axis])?;
                    substitute(&formula, influence.error, &Value::whole(1)).ok_or(Refusal::NoMinor)
                };
                shown.push(influences.iter().map(of).collect::<Result<Vec<_>, _>>()?);
            }
        }
        let chain = self.certificate.declared.chain();
        let circles = self.angles.symbols();
        let keys = || shown.iter().flatten().flat_map(|formula: &Expanded| formula.0.keys().flatten());
        let numbers: BTreeSet<SymbolId> =
            keys().filter(|(_, part, _)| *part == Part::Value).map(|(symbol, ..)| *symbol).collect();
        if keys().any(|(symbol, ..)| chain.ramp(*symbol).is_some()) {
            return Err(Refusal::Ramp);
        }
        let search = Search {
            conditions: &self.conditions,
            is_angle: &|symbol| circles.contains(&symbol),
            is_number: &|symbol| numbers.contains(&symbol),
        };
        let free = self.used.iter().filter(|id| !errors.contains(id) && **id != SymbolId::PI);
        // What is no multiple of a quarter turn as a number has no rational sine.
        let (constants, joints): (Vec<_>, Vec<_>) = free
            .map(|id| (*id, search.values(*id)))
            .partition(|(id, _)| chain.symbol(*id).kind == SymbolKind::Constant);
        let is_defined = |values: &[(SymbolId, Value)]| {
            self.conditions.iter().all(|condition| condition.is_satisfied(values))
        };
        let asked =
            Asked { shown: &shown, wanted, constants: &constants, joints: &joints, is_defined: &is_defined };
        minor::find(&asked).ok_or(Refusal::NoMinor)
    }

    /// What all the errors do together to one observable; the names that it depends on.
    fn write_sum(
        &mut self,
        at: usize,
        errors: &[SymbolId],
        influences: &[Influence],
        sizes: &[String],
    ) -> Vec<String> {
        let size = |symbol: SymbolId| errors.iter().position(|error| *error == symbol).map(|at| &sizes[at]);
        let call = |influence: &Influence| {
            let word = |symbol: &SymbolId| match size(*symbol) {
                Some(size) => format!(" {size}"),
                None => format!(" {}", self.name(*symbol)),
            };
            format!(
                "({}.derived{})",
                influence.module,
                influence.symbols.iter().map(word).collect::<String>()
            )
        };
        let sum = |axis: &str| {
            let parts: Vec<String> =
                influences.iter().map(|influence| format!("{axis} {}", call(influence))).collect();
            format!("({})", parts.join(" + "))
        };
        let text =
            format!("Definition together_{at} : vec := V\n  {}\n  {}\n  {}.\n", sum("x"), sum("y"), sum("z"));
        let modules: Vec<String> =
            influences.iter().map(|influence| format!("{}.derived", influence.module)).collect();
        let needed: BTreeSet<SymbolId> =
            influences.iter().flat_map(|influence| influence.symbols.iter().copied()).collect();
        let plain = self.used.iter().filter(|id| !errors.contains(id) && needed.contains(id));
        let mut arguments: Vec<String> = plain.map(|id| self.name(*id)).collect();
        arguments.extend(
            errors.iter().zip(sizes).filter(|(id, _)| needed.contains(id)).map(|(_, size)| size.clone()),
        );
        self.out.push_str(&text);
        let _ = writeln!(self.out, "Ltac unfold_{at} := cbv [x y z together_{at} {}].", modules.join(" "));
        arguments
    }

    /// One equation between the sizes, at numbers.
    fn write_row(&mut self, row: usize, minor: &Minor, statement: &Statement) -> Result<(), Refusal> {
        let (pose, coordinate, numbers) = &minor.rows[row];
        let (observable, axis) = (coordinate / 3, ["x", "y", "z"][coordinate % 3]);
        let arguments = &statement.arguments[observable];
        let premises: Vec<(String, String)> = minor
            .constants
            .iter()
            .chain(&minor.poses[*pose])
            .filter(|(symbol, _)| arguments.contains(&self.name(*symbol)))
            .flat_map(|(symbol, value)| value.equations(&self.name(*symbol)))
            .collect();
        let names: Vec<String> = (0..premises.len()).map(|at| format!("at_{at}")).collect();
        let rewrites: Vec<String> = names.iter().map(|name| format!("?{name}")).collect();
        let rewrites =
            if rewrites.is_empty() { String::new() } else { format!("rewrite {}; ", rewrites.join(", ")) };
        let premises: String = premises.iter().map(|(left, right)| format!("{left} = {right} -> ")).collect();
        let sum = linear(numbers, &statement.sizes);
        let _ = writeln!(
            self.out,
            "Lemma row_{row} : {premises}together_{observable} = V 0 0 0 -> {sum} = 0.\nProof.\n  intros {} E. \
             transitivity ({axis} together_{observable}); [unfold_{observable}; angles; {rewrites}numbers | now rewrite E].\nQed.",
            names.join(" "),
        );
        Ok(())
    }

    /// The statement for constants as they were chosen, for all sizes.
    fn write_theorem(
        &mut self,
        minor: &Minor,
        statement: &Statement,
        wanted: &[usize],
    ) -> Result<(), Refusal> {
        let names =
            |symbols: &[SymbolId]| -> Vec<String> { symbols.iter().map(|id| self.name(*id)).collect() };
        let (constants, joints) = (names(&statement.constants), names(&statement.joints));
        let bound = |word: &str, names: &[String]| {
            if names.is_empty() { String::new() } else { format!("{word} {} : R, ", names.join(" ")) }
        };
        let conditions = self
            .conditions
            .iter()
            .map(|condition: &Condition| Ok(format!("{} -> ", self.condition(condition)?)))
            .collect::<Result<Vec<_>, Refusal>>()?
            .concat();
        let seen: Vec<String> = statement
            .arguments
            .iter()
            .enumerate()
            .map(|(at, arguments)| {
                let call =
                    [format!("together_{at}")].iter().chain(arguments).cloned().collect::<Vec<_>>().join(" ");
                format!("({}{conditions}{call} = V 0 0 0) ->\n  ", bound("forall", &joints))
            })
            .collect();
        let zeros: Vec<String> = wanted.iter().map(|at| format!("{} = 0", statement.sizes[*at])).collect();
        let mut proof = String::new();
        let constant_words = given(&mut proof, "constant", &minor.constants);
        let exists: Vec<String> = constant_words.iter().map(|word| format!("exists {word}. ")).collect();
        let _ = write!(proof, "{}\n  intros {}", exists.concat(), statement.sizes.join(" "));
        let hypotheses: Vec<String> = (0..seen.len()).map(|at| format!("shown_{at}")).collect();
        let _ = writeln!(proof, " {}.", hypotheses.join(" "));
        let mut poses = Vec::new();
        for (at, values) in minor.poses.iter().enumerate() {
            proof.push_str("  ");
            poses.push(given(&mut proof, &format!("pose_{at}"), values));
            proof.push('\n');
        }
        for (row, (pose, coordinate, numbers)) in minor.rows.iter().enumerate() {
            let observable = coordinate / 3;
            let word = |argument: &String| {
                let at = |names: &[String]| names.iter().position(|name| name == argument);
                match (at(&constants), at(&joints)) {
                    (Some(at), _) => constant_words[at].clone(),
                    (_, Some(at)) => poses[*pose][at].clone(),
                    _ => argument.clone(),
                }
            };
            let call: String = statement.arguments[observable]
                .iter()
                .map(|argument| format!(" {}", word(argument)))
                .collect();
            let there: String = poses[*pose].iter().map(|word| format!(" {word}")).collect();
            let sum = linear(numbers, &statement.sizes);
            let _ = writeln!(
                proof,
                "  assert (E_{row} : {sum} = 0) by (apply (row_{row}{call}); premise (shown_{observable}{there}))."
            );
        }
        let _ = writeln!(
            self.out,
            "(* For some constants, and so for all but special ones: sizes that never show are zero. *)\nTheorem holds : {}{}\n  \
             {}{}.\nProof.\n  {proof}  repeat split; lra.\nQed.",
            bound("exists", &constants),
            bound("forall", &statement.sizes),
            seen.concat(),
            zeros.join(" /\\ "),
        );
        Ok(())
    }
}

/// Words for values: numbers, or names of angles of which cosine and sine are given.
fn given(proof: &mut String, stem: &str, values: &Values) -> Vec<String> {
    let mut words = Vec::with_capacity(values.len());
    for (at, (_, value)) in values.iter().enumerate() {
        match (&value.text, value.point()) {
            (None, Some([cosine, sine])) => {
                let _ = write!(
                    proof,
                    "destruct (circle ({cosine}) ({sine})) as ({stem}_{at} & cosine_{stem}_{at} & sine_{stem}_{at}); [lra|]. "
                );
                words.push(format!("{stem}_{at}"));
            }
            (text, _) => words.push(format!("({})", text.as_deref().unwrap_or("0"))),
        }
    }
    words
}

/// A sum of multiples of the sizes.
fn linear(numbers: &[model_core::algebra::Rational], sizes: &[String]) -> String {
    let terms = numbers.iter().zip(sizes).filter(|(number, _)| !number.is_zero());
    let terms: Vec<String> = terms
        .map(|(number, size)| {
            format!("({}) * {size}", number.to_string().replace('-', "- ").replace('/', " / "))
        })
        .collect();
    if terms.is_empty() { "0".to_owned() } else { terms.join(" + ") }
}
