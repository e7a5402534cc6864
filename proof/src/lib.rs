//! Certificates: a chain, what is claimed of it and the verdict, as a file that the proof assistant Coq checks.
//!
//! Nothing here has to be believed: a certificate that states something wrong does not check. What a statement means is
//! defined in [`LIBRARY`], over the real numbers of Coq's standard library; what it is proved with are the derivatives of
//! the exact product, factor by factor, written out by `steps` in a form in which Coq decides each line. What cannot
//! be certified is a [`Refusal`].

mod angles;
mod claimed;
mod condition;
mod declared;
mod defined;
mod derived;
mod differs;
mod equality;
mod expanded;
mod expression;
mod independence;
mod influence;
mod jets;
mod leaf;
mod minor;
mod names;
mod passage;
mod readings;
mod refusal;
mod section;
mod shown;
mod steps;
mod values;
mod witness;

use std::fmt::Write as _;

use claims::checker::{ClosedForm, FormVerdict, Order};
use expression::Term;
use influence::Influence;
use model_core::algebra::{Fraction, Poly};
use model_core::chain::{Axis, BodyId, Chain, ObservableId, Role, TransformKind};
use model_core::escape::comments::coq as comment;
use model_core::expr::Expr;
use model_core::forms;
use model_core::print;
use model_core::symbol::{SymbolId, SymbolKind};
use model_core::syntax;
use names::Names;
use section::{Question, Section};

pub use declared::Declared;
pub use refusal::Refusal;

/// What every certificate stands on: the meaning of a chain, and the rules by which a certificate calculates, proved.
pub const LIBRARY: &str = include_str!("../certificates/TrueAxis.v");
/// The name under which a certificate looks for [`LIBRARY`].
pub const LIBRARY_FILE: &str = "TrueAxis.v";

/// A certificate that is being written: statements are added one by one, each with its proof.
#[derive(Debug)]
pub struct Certificate<'a> {
    declared: &'a Declared,
    /// By symbol.
    symbols: Vec<String>,
    /// By body.
    bodies: Vec<String>,
    names: Names,
    sections: Vec<String>,
    notes: Vec<String>,
    theorems: Vec<String>,
    influences: Vec<Influence>,
    /// The print that the next statement is about.
    printing: Vec<String>,
}

impl<'a> Certificate<'a> {
    /// A certificate about a chain that states nothing yet.
    #[must_use]
    pub fn new(declared: &'a Declared) -> Self {
        let mut names = Names::new();
        let chain = declared.chain();
        let symbols = chain
            .symbols
            .iter()
            .map(|symbol| match symbol.kind {
                SymbolKind::Pi => "PI".to_owned(),
                // A ramp is written out, and has no name.
                SymbolKind::Ramp => String::new(),
                _ => names.give(&symbol.name),
            })
            .collect();
        let bodies = chain.bodies.iter().map(|body| names.give_own("body_", &body.name)).collect();
        Self {
            declared,
            symbols,
            bodies,
            names,
            sections: Vec::new(),
            notes: Vec::new(),
            theorems: Vec::new(),
            influences: Vec::new(),
            printing: Vec::new(),
        }
    }

    /// Whether nothing has been certified.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.sections.is_empty()
    }

    /// States a printed formula and proves the verdict on it: that it holds, or that it differs.
    ///
    /// # Errors
    /// [`Refusal`].
    pub fn closed_form(
        &mut self,
        title: &str,
        claim: &ClosedForm,
        verdict: &FormVerdict,
    ) -> Result<(), Refusal> {
        let Order::UpTo(order) = claim.order else { return Err(Refusal::Claim) };
        if !claim.is_plain() {
            return Err(Refusal::Claim);
        }
        let printed = claim
            .printed
            .components
            .each_ref()
            .map(|component| declared::without_places(&component.expression));
        self.only_symbols_of_the_chain(&printed)?;
        if claim.only.is_some() || !self.declared.chain().observable(claim.observable).is_vector() {
            return self.printed_readings(title, claim, order, verdict);
        }
        if !claim.printed.components.iter().all(|component| component.value.is_whole()) {
            return Err(Refusal::Claim);
        }
        let question = Question {
            observable: Some(claim.observable),
            order,
            kept: claim.kept.clone(),
            put_in: Vec::new(),
        };
        let name = self.names.give(title);
        let title = format!(
            "{title}: the error of {} to {} order, as printed",
            self.observable(claim.observable),
            ordinal(order)
        );
        if verdict.differences.is_empty() {
            let mut section = Section::new(self, &question, &printed.each_ref())?;
            section.open(&name, &format!("{title}: holds"))?;
            section.formula("printed", &printed);
            section.claim("printed");
            section.prove("printed", "holds", "claim")?;
            let section = section.close_all(&name);
            self.finish_section(section, &name, "holds");
        } else {
            let derived = self.printed(&whole(&verdict.derived)?)?;
            let mut section =
                Section::new(self, &question, &[printed.each_ref(), derived.each_ref()].concat())?;
            section.open(&name, &format!("{title}: differs from what the chain implies"))?;
            section.formula("printed", &printed);
            section.claim("printed");
            section.formula("derived", &derived);
            section.refute(claim, verdict)?;
            let section = section.close(&name);
            self.finish_section(section, &name, "differs");
        }
        Ok(())
    }

    /// Says how the next statement is printed, so that a reader sees what the theorem is about.
    pub fn printed_as(&mut self, texts: &[String]) {
        self.printing = texts.to_vec();
    }

    /// Says of a statement that the certificate does not speak of it, and why.
    pub fn not_certified(&mut self, title: &str, why: &str) {
        self.printing.clear();
        self.notes.push(format!("{title}: {why}"));
    }

    /// What the certificate does not speak of, each with the reason.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The whole text. `source` is what the user calls the declaration or the claims.
    #[must_use]
    pub fn finish(self, source: &str) -> String {
        let chain = self.declared.chain();
        let mut out = format!(
            "(* {}: what follows from the declaration of chain {}, with proofs.\n\n   Written by trueaxis; checked by Coq:\n\n     \
             coqc -Q . TrueAxis {LIBRARY_FILE}\n     coqc -Q . TrueAxis THIS_FILE.v\n\n   A line of output for each \
             statement, and no error: everything that stands below as a theorem is true.\n   What its words mean is \
             defined in {LIBRARY_FILE}, parts 1 and 2. *)\n\nFrom TrueAxis Require Import TrueAxis.\n",
            comment(source),
            comment(&chain.name),
        );
        for note in &self.notes {
            let _ = writeln!(out, "\n(* Not certified: {} *)", comment(note));
        }
        out.push_str("\n(* The declaration: for each body its factors, from its lower body to itself. *)\n");
        for (index, body) in (0u16..).zip(&chain.bodies) {
            out.push_str(&self.body(BodyId(index), &body.name));
        }
        for section in &self.sections {
            out.push('\n');
            out.push_str(section);
        }
        out.push_str("\n(* What the proofs rest on: the axioms of Coq's real numbers. *)\n");
        for theorem in &self.theorems {
            let _ = writeln!(out, "Print Assumptions {theorem}.");
        }
        out
    }

    /// The definition of a body: the list of its factors, a function of the symbols in it.
    fn body(&self, id: BodyId, name: &str) -> String {
        let chain = self.declared.chain();
        let lower = chain.body(id).lower.map_or("ground", |lower| chain.body(lower).name.as_str());
        let mut out = format!("\n(* body {} on {} *)\n", comment(name), comment(lower));
        let arguments: Vec<&str> = self.body_symbols(id).iter().map(|symbol| self.symbol(*symbol)).collect();
        let arguments =
            if arguments.is_empty() { String::new() } else { format!(" ({} : R)", arguments.join(" ")) };
        let _ = writeln!(out, "Definition {}{arguments} : list motion :=", self.bodies[usize::from(id.0)]);
        let factors = self.declared.body(id);
        if factors.is_empty() {
            out.push_str("  [].\n");
        }
        for (index, factor) in factors.iter().enumerate() {
            let begin = if index == 0 { "  [ " } else { "    " };
            let end = if index + 1 == factors.len() { " ]." } else { ";" };
            let symbol = |symbol| self.term(symbol);
            let leaf = |expression: &Expr<()>| leaf::leaf(self.declared, expression, &symbol);
            let amount = expression::argument(&factor.written, &leaf);
            let head = motion(factor.kind, factor.axis);
            let _ = writeln!(out, "{begin}{head} {amount}{end} (* {} *)", role(factor.role));
        }
        out
    }

    /// The symbols in the factors of a body, in order.
    fn body_symbols(&self, id: BodyId) -> Vec<SymbolId> {
        let factors = self.declared.body(id).iter();
        let mut symbols: Vec<SymbolId> =
            factors.flat_map(|factor| self.declared.symbols_of(&factor.written)).collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    fn symbol(&self, symbol: SymbolId) -> &str {
        &self.symbols[symbol.index()]
    }

    /// What stands for a symbol: its name, or a ramp written out.
    fn term(&self, symbol: SymbolId) -> Term {
        match self.declared.chain().ramp(symbol) {
            Some(ramp) => leaf::ramp(ramp, &|symbol| self.term(symbol)),
            None => Term::word(self.symbol(symbol)),
        }
    }

    fn observable(&self, observable: ObservableId) -> &str {
        &self.declared.chain().observable(observable).name
    }

    /// A formula as [`print::text`] prints it.
    fn as_printed(&self, poly: &Poly) -> Result<Expr<()>, Refusal> {
        let text = print::text(poly, self.declared.chain());
        let expression = syntax::parse_amount(&text).map_err(|_| Refusal::Unreadable { text })?;
        Ok(declared::without_places(&expression))
    }

    /// The components of an error as [`print::text`] prints them.
    fn printed(&self, components: &[Poly; 3]) -> Result<[Expr<()>; 3], Refusal> {
        let [x, y, z] = components.each_ref().map(|component| self.as_printed(component));
        Ok([x?, y?, z?])
    }

    /// Refuses printed abbreviations: they stand for more than a symbol of the chain.
    fn only_symbols_of_the_chain(&self, printed: &[Expr<()>]) -> Result<(), Refusal> {
        let chain = self.declared.chain();
        let foreign =
            |formula: &Expr<()>| formula.names().iter().any(|(name, ())| chain.find_symbol(name).is_none());
        if printed.iter().any(foreign) { Err(Refusal::Claim) } else { Ok(()) }
    }

    fn finish_section(&mut self, section: String, name: &str, theorem: &str) {
        let mut text = String::new();
        for printed in std::mem::take(&mut self.printing) {
            let _ = writeln!(text, "(* As printed: {} *)", comment(&printed));
        }
        text.push_str(&section);
        self.sections.push(text);
        self.theorems.push(format!("{name}.{theorem}"));
    }
}

/// `Rx` to `Tz`.
fn motion(kind: TransformKind, axis: Axis) -> String {
    let letter = match kind {
        TransformKind::Rotation => 'R',
        TransformKind::Translation => 'T',
    };
    format!("{letter}{axis}")
}

fn role(role: Role) -> &'static str {
    match role {
        Role::Position => "position",
        Role::PositionError => "position_error",
        Role::Motion => "motion",
        Role::MotionError => "motion_error",
    }
}

fn ordinal(order: u32) -> &'static str {
    match order {
        1 => "first",
        2 => "second",
        _ => "third",
    }
}

/// The error of an observable that is a whole vector.
fn vector_to_order(chain: &Chain, id: ObservableId, order: u32) -> Result<[Poly; 3], Refusal> {
    if !chain.observable(id).is_vector() {
        return Err(Refusal::Claim);
    }
    whole(&forms::derive(chain, id, order)?.components)
}

/// Three components that are no quotients.
fn whole(components: &[Fraction]) -> Result<[Poly; 3], Refusal> {
    match components {
        [x, y, z] if components.iter().all(Fraction::is_whole) => {
            Ok([x, y, z].map(|part| part.above.clone()))
        }
        _ => Err(Refusal::Claim),
    }
}
