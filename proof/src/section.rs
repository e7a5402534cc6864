//! One statement of a certificate: the way from the ground to an observable, formulas for its error, and proofs.

use std::fmt::Write as _;

use super::angles::Angles;
use super::condition::Condition;
use super::expanded::Expanded;
use super::expression::{self, Level, Term};
use super::jets::{self, VectorJet};
use super::leaf;
use super::passage::{self, Passage};
use super::{Certificate, Refusal};
use model_core::algebra::Poly;
use model_core::chain::{BodyId, ObservableId, ObservableKind, Passed};
use model_core::escape::comments::coq as comment;
use model_core::expr::Expr;
use model_core::identify::put_in;
use model_core::symbol::SymbolId;

/// What a statement is about.
#[derive(Debug, Clone)]
pub(super) struct Question {
    /// `None` where the statement is about numbers alone.
    pub observable: Option<ObservableId>,
    pub order: u32,
    /// The errors that are not zero, in order.
    pub kept: Vec<SymbolId>,
    /// Constants whose values are put in, with these.
    pub put_in: Vec<(SymbolId, Poly)>,
}

impl Question {
    pub(super) fn observable(&self) -> ObservableId {
        match self.observable {
            Some(observable) => observable,
            None => unreachable!("what an instrument shows is only asked for in statements about one"),
        }
    }

    /// What is put in for a symbol.
    fn value(&self, symbol: SymbolId) -> Option<&Poly> {
        self.put_in.iter().find(|(own, _)| *own == symbol).map(|(_, value)| value)
    }
}

/// A statement that is being written.
pub(super) struct Section<'c> {
    pub certificate: &'c Certificate<'c>,
    pub question: &'c Question,
    pub kind: ObservableKind,
    /// The bodies on the way, each with whether it is gone through backwards.
    pub path: Vec<(BodyId, bool)>,
    /// The symbols that the statement is for all values of, in order.
    pub used: Vec<SymbolId>,
    /// Where the statement is defined.
    pub conditions: Vec<Condition>,
    pub angles: Angles,
    /// Every factor on the way.
    pub factors: Vec<Passage>,
    /// The vector by powers of t: of the observable itself, then after each factor from the last to the first.
    pub states: Vec<VectorJet>,
    pub out: String,
}

impl<'c> Section<'c> {
    /// A statement with these formulas in it, before anything is written.
    pub(super) fn new(
        certificate: &'c Certificate<'c>,
        question: &'c Question,
        formulas: &[&Expr<()>],
    ) -> Result<Self, Refusal> {
        let declared = certificate.declared;
        let chain = declared.chain();
        let observable = chain.observable(question.observable());
        let is_of_sight = |passed: &Passed<'_>| {
            passed.factor.amount.symbols().iter().any(|symbol| chain.sight_angle(*symbol).is_some())
        };
        if observable.bend.is_some() || chain.way(question.observable()).iter().any(is_of_sight) {
            return Err(Refusal::LineOfSight { name: observable.name.clone() });
        }
        let path = passage::bodies(declared, question.observable());
        let mut section = Self {
            certificate,
            question,
            kind: observable.kind,
            path,
            used: Vec::new(),
            conditions: Vec::new(),
            angles: Angles::default(),
            factors: Vec::new(),
            states: Vec::new(),
            out: String::new(),
        };
        let name = |expression: &Expr<()>| section_leaf(certificate, question, expression);
        let lower = |expression: &Expr<()>| lower(certificate, question, expression);
        let mut angles = Angles::default();
        let mut divisors = Vec::new();
        let vector = declared.observable(question.observable());
        for expression in vector.iter().chain(formulas.iter().copied()) {
            section.used.extend(declared.symbols_of(expression));
            angles.add_all(&lower, expression, &name)?;
            expression::divisors(expression, &mut divisors);
        }
        for (body, _) in &section.path {
            let kept = |symbol: &SymbolId| {
                !declared.is_error(*symbol) || question.kept.binary_search(symbol).is_ok()
            };
            section.used.extend(certificate.body_symbols(*body).into_iter().filter(kept));
        }
        for mut factor in passage::factors(declared, &section.path) {
            let is_error = |symbol| declared.is_error(symbol);
            let is_kept = |symbol| section.is_kept(symbol);
            let amount = put_values(question, &factor.amount)?;
            factor.jet = jets::amount(&amount, question.order, is_error, is_kept);
            angles.add_all(&lower, &factor.written, &name)?;
            expression::divisors(&factor.written, &mut divisors);
            let is_nominal = factor.amount.symbols().iter().all(|symbol| !declared.is_error(*symbol));
            if is_nominal && factor.kind == model_core::chain::TransformKind::Rotation {
                angles.add(&lower, &factor.written, &name)?;
            }
            section.factors.push(factor);
        }
        section.used.sort_unstable();
        section.used.dedup();
        section.used.retain(|symbol| question.value(*symbol).is_none());
        section.angles = angles;
        for divisor in divisors {
            section.add_divisor(&divisor)?;
        }
        section.run()?;
        Ok(section)
    }

    /// A statement about these formulas alone.
    pub(super) fn of_numbers(
        certificate: &'c Certificate<'c>,
        question: &'c Question,
        formulas: &[Expr<()>],
    ) -> Result<Self, Refusal> {
        let mut section = Self {
            certificate,
            question,
            kind: ObservableKind::Direction,
            path: Vec::new(),
            used: Vec::new(),
            conditions: Vec::new(),
            angles: Angles::default(),
            factors: Vec::new(),
            states: Vec::new(),
            out: String::new(),
        };
        let name = |expression: &Expr<()>| section_leaf(certificate, question, expression);
        let lower = |expression: &Expr<()>| lower(certificate, question, expression);
        let mut divisors = Vec::new();
        for formula in formulas {
            section.used.extend(certificate.declared.symbols_of(formula));
            section.angles.add_all(&lower, formula, &name)?;
            expression::divisors(formula, &mut divisors);
        }
        section.used.sort_unstable();
        section.used.dedup();
        section.used.retain(|symbol| question.value(*symbol).is_none());
        for divisor in divisors {
            section.add_divisor(&divisor)?;
        }
        Ok(section)
    }

    fn is_kept(&self, symbol: SymbolId) -> bool {
        self.question.kept.binary_search(&symbol).is_ok()
    }

    /// The vector, from the observable itself to the ground.
    fn run(&mut self) -> Result<(), Refusal> {
        let chain = self.certificate.declared.chain();
        let components = &chain.observable(self.question.observable()).components;
        let [x, y, z] = components.each_ref().map(|component| put_values(self.question, component));
        self.states.push([x?, y?, z?].map(|component| jets::constant(&component, self.question.order)));
        for factor in self.factors.iter().rev() {
            let Some(before) = self.states.last() else {
                unreachable!("the vector itself was put there first")
            };
            let after = jets::moved(before, self.kind, factor, &chain.body(factor.body).name)?;
            self.states.push(after);
        }
        Ok(())
    }

    /// What stands for a symbol where a single word is wanted.
    pub(super) fn name(&self, symbol: SymbolId) -> String {
        section_term(self.certificate, self.question, symbol).at(Level::Atom)
    }

    /// A canonical form in Coq's syntax.
    pub(super) fn poly(&self, poly: &Poly) -> Result<String, Refusal> {
        Ok(Expanded::new(poly)?.write(&|symbol| self.name(symbol)))
    }

    /// An expression as written, in the names of the certificate.
    pub(super) fn written(&self, expression: &Expr<()>) -> String {
        expression::write(expression, &|leaf| section_leaf(self.certificate, self.question, leaf))
    }

    /// What an error is where every error is multiplied by t: nothing if it is neglected.
    pub(super) fn scaled(&self, symbol: SymbolId) -> Term {
        let term = section_term(self.certificate, self.question, symbol);
        match (self.certificate.declared.is_error(symbol), self.is_kept(symbol)) {
            (false, _) => term,
            (true, true) => Term::new(format!("t * {}", term.at(Level::Atom)), Level::Product),
            (true, false) => Term::word("0"),
        }
    }

    pub(super) fn kind_name(&self) -> &'static str {
        match self.kind {
            ObservableKind::Direction => "Direction",
            ObservableKind::Point => "Point",
        }
    }

    /// `error_to_order 1 (fun t => shown Direction (instrument t) vector) formula`
    pub(super) fn statement(&self, formula: &str) -> String {
        let (order, kind) = (self.question.order, self.kind_name());
        format!("error_to_order {order} (fun t => shown {kind} (instrument t) vector) {formula}")
    }

    /// The heading, the variables and the instrument.
    pub(super) fn open(&mut self, module: &str, title: &str) -> Result<(), Refusal> {
        let certificate = self.certificate;
        let chain = certificate.declared.chain();
        let observable = chain.observable(self.question.observable());
        let _ = writeln!(self.out, "(* {} *)\nModule {module}.\nSection for_all.", comment(title));
        let names: Vec<String> = self.used.iter().map(|symbol| self.name(*symbol)).collect();
        if !names.is_empty() {
            let _ = writeln!(self.out, "Variables {} : R.", names.join(" "));
        }
        self.write_conditions()?;
        let body = &chain.body(observable.body).name;
        let from = observable
            .frame
            .map_or("the ground".to_owned(), |frame| format!("body {}", chain.body(frame).name));
        let _ = writeln!(
            self.out,
            "(* From {} to body {}, every error multiplied by t; what is neglected is 0. *)\n\
             Definition instrument (t : R) : list motion :=",
            comment(&from),
            comment(body)
        );
        if self.path.is_empty() {
            self.out.push_str("  [].\n");
        }
        for (index, (body, is_reversed)) in self.path.iter().enumerate() {
            let symbols = certificate.body_symbols(*body).into_iter();
            let arguments: Vec<String> =
                symbols.map(|symbol| format!(" {}", self.scaled(symbol).at(Level::Atom))).collect();
            let end = if index + 1 == self.path.len() { "." } else { " ++" };
            let whole = format!("{}{}", certificate.bodies[usize::from(body.0)], arguments.concat());
            let whole = if *is_reversed { format!("back ({whole})") } else { whole };
            let _ = writeln!(self.out, "  {whole}{end}");
        }
        let what = match self.kind {
            ObservableKind::Direction => "direction",
            ObservableKind::Point => "point",
        };
        let _ = writeln!(self.out, "(* {}: a {what} in the frame of that body *)", comment(&observable.name));
        self.formula("vector", certificate.declared.observable(self.question.observable()));
        Ok(())
    }

    /// The heading, the variables and besides them `more`, and the rules of calculation, for a statement about numbers.
    pub(super) fn open_plain(
        &mut self,
        module: &str,
        title: &str,
        more: Option<&str>,
    ) -> Result<(), Refusal> {
        let kept = |symbol: &&SymbolId| !self.is_kept(**symbol);
        let names: Vec<String> = self
            .used
            .iter()
            .filter(kept)
            .map(|symbol| self.name(*symbol))
            .chain(more.map(str::to_owned))
            .collect();
        let _ = writeln!(self.out, "(* {} *)\nModule {module}.\nSection for_all.", comment(title));
        if !names.is_empty() {
            let _ = writeln!(self.out, "Variables {} : R.", names.join(" "));
        }
        self.write_conditions()?;
        let mut lemmas = String::new();
        self.angles.write(&mut lemmas, &|symbol| self.name(symbol))?;
        self.out.push_str(&lemmas);
        Ok(())
    }

    fn write_conditions(&mut self) -> Result<(), Refusal> {
        for (index, condition) in self.conditions.iter().enumerate() {
            let text = self.condition(condition)?;
            let _ = writeln!(self.out, "Hypothesis defined_{index} : {text}.");
        }
        Ok(())
    }

    /// A vector as written.
    pub(super) fn formula(&mut self, name: &str, components: &[Expr<()>; 3]) {
        let [x, y, z] = components.each_ref().map(|component| self.written(component));
        let _ = writeln!(self.out, "Definition {name} : vec := V\n  ({x})\n  ({y})\n  ({z}).");
    }

    /// What a formula says.
    pub(super) fn claim(&mut self, formula: &str) {
        let statement = self.statement(formula);
        let _ = writeln!(self.out, "Definition claim : Prop :=\n  {statement}.");
    }

    /// The whole proof that a formula is the error.
    pub(super) fn prove(&mut self, formula: &str, theorem: &str, statement: &str) -> Result<(), Refusal> {
        self.prepare()?;
        self.canonical(formula)?;
        self.reach(formula, theorem, statement)
    }

    /// The end of the section and of the statement.
    pub(super) fn close_all(mut self, module: &str) -> String {
        self.close_section();
        self.close(module)
    }

    /// The end of the section; what follows is for all values of its variables.
    pub(super) fn close_section(&mut self) {
        self.out.push_str("End for_all.\n");
    }

    /// The whole text of the statement.
    pub(super) fn close(mut self, module: &str) -> String {
        let _ = writeln!(self.out, "End {module}.");
        self.out
    }
}

/// What stands for a symbol: its value where that is put in.
fn section_term(certificate: &Certificate<'_>, question: &Question, symbol: SymbolId) -> Term {
    if let Some(value) = question.value(symbol) {
        return leaf::value(value, &|symbol| certificate.term(symbol));
    }
    match certificate.declared.chain().ramp(symbol) {
        Some(ramp) => leaf::ramp(ramp, &|symbol| section_term(certificate, question, symbol)),
        None => certificate.term(symbol),
    }
}

/// What stands for a name, a number with a unit, or a ramp.
fn section_leaf(certificate: &Certificate<'_>, question: &Question, expression: &Expr<()>) -> Term {
    leaf::leaf(certificate.declared, expression, &|symbol| section_term(certificate, question, symbol))
}

/// What an expression says, with the values that are put in.
pub(super) fn lower(
    certificate: &Certificate<'_>,
    question: &Question,
    expression: &Expr<()>,
) -> Result<Poly, Refusal> {
    put_values(question, &certificate.declared.lower(expression).ok_or(Refusal::Divisor)?)
}

/// A formula with the values that are put in.
fn put_values(question: &Question, formula: &Poly) -> Result<Poly, Refusal> {
    put_in(formula, &question.put_in).map_err(|_| Refusal::Divisor)
}
