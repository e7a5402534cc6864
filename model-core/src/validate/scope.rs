//! What each name of a declaration stands for: joint, error, constant or input, in order of declaration or
//! first use. The joints come in the order of the motions that they drive: an error that depends on a joint further up
//! moves no joint to another place in the answers.
//!
//! The scope is made of any declaration, wrong ones too: it takes the likeliest meaning, and the rules say what
//! is wrong. A misspelt role counts as the nearest one, so that one mistake does not bring on others.

use std::collections::BTreeMap;

use proc_macro2::Span;

use super::words;
use crate::algebra::Poly;
use crate::amount::AngleNumber;
use crate::chain::{Role, TransformKind};
use crate::expr::{Expr, Node};
use crate::ramp::Ramp;
use crate::symbol::{Meaning, Quantity, SymbolId, SymbolKind};
use crate::syntax::Declaration;
use crate::syntax::declaration::{BodyStatement, FactorGroup, FactorTerm, ObserveStatement, Statement};

/// One name of the scope.
pub struct Entry {
    /// The name.
    pub name: String,
    /// What it is for.
    pub kind: SymbolKind,
    /// What it measures, as far as its statement or motion says.
    pub quantity: Option<Quantity>,
    /// What it is, for inputs whose statement says so.
    pub meaning: Option<Meaning>,
    /// Documentation of its statement, else of the factor or list where it is first used.
    pub documentation: String,
    /// The value of a constant that is written as a number where it is used, rad.
    pub value: Option<f64>,
}

/// Every name that amounts may use.
pub struct Scope {
    entries: Vec<Entry>,
    ids: BTreeMap<String, SymbolId>,
    ramps: Vec<Ramp>,
    /// Whether every amount and role could be read, so that a name which is missing here is really missing.
    pub is_complete: bool,
}

impl Scope {
    /// Collects the names of a declaration.
    pub fn collect(declaration: &Declaration) -> Self {
        let mut scope =
            Self { entries: Vec::new(), ids: BTreeMap::new(), ramps: Vec::new(), is_complete: true };
        scope.declare(Entry {
            name: "pi".to_owned(),
            kind: SymbolKind::Pi,
            quantity: Some(Quantity::Number),
            meaning: None,
            documentation: "The ratio of a circle's circumference to its diameter.".to_owned(),
            value: None,
        });
        let fixed = fixed_kinds(declaration);
        for statement in &declaration.statements {
            match statement {
                Statement::Constant(constant) => scope.declare(Entry {
                    name: constant.name.to_string(),
                    kind: SymbolKind::Constant,
                    quantity: Some(words::stated_quantity(constant.quantity.as_ref())),
                    meaning: None,
                    documentation: constant.documentation.clone(),
                    value: None,
                }),
                Statement::Input(input) => {
                    let meaning =
                        input.meaning.as_ref().and_then(|word| words::meaning(&Meaning::WORDS, word));
                    let (kind, quantity, meaning) = match &input.between {
                        Some(_) => (SymbolKind::SightAngle, Quantity::Angle, None),
                        None => {
                            (SymbolKind::Input, meaning.map_or(Quantity::Number, Meaning::quantity), meaning)
                        }
                    };
                    scope.declare(Entry {
                        name: input.name.to_string(),
                        kind,
                        quantity: Some(quantity),
                        meaning,
                        documentation: input.documentation.clone(),
                        value: None,
                    });
                }
                Statement::Body(body) => scope.declare_used(body, &fixed),
                Statement::Observe(observe) => scope.declare_observed(observe, &fixed),
                Statement::Symbol(_) | Statement::Gravity(_) => {}
            }
        }
        for symbol in declaration.printed_symbols().filter(|symbol| !symbol.documentation.is_empty()) {
            if let Some(id) = scope.find(&symbol.name.to_string()) {
                scope.entries[id.index()].documentation.clone_from(&symbol.documentation);
            }
        }
        scope.declare_angles(declaration);
        scope.declare_ramps(declaration);
        scope
    }

    /// The angles that are written as numbers, each a constant of its own.
    fn declare_angles(&mut self, declaration: &Declaration) {
        let mut amounts: Vec<&Expr<Span>> = Vec::new();
        for group in declaration.bodies().flat_map(|body| &body.groups) {
            let turns = |factor: &&FactorTerm| {
                words::transform(&factor.axis).is_some_and(|(kind, _)| kind == TransformKind::Rotation)
            };
            if matches!(words::likely_role(&group.role), Some(Role::Position | Role::Motion)) {
                amounts
                    .extend(group.factors.iter().filter(turns).filter_map(|factor| factor.amount.as_ref()));
            }
        }
        declaration.amounts().for_each(|amount| amount.arguments(&mut amounts));
        for amount in amounts {
            let Ok(value) = Poly::from_expr(amount, |name| self.find(name), |_| true) else { continue };
            let Some(number) = AngleNumber::in_amount(&value) else { continue };
            self.declare(Entry {
                name: number.name,
                kind: SymbolKind::Constant,
                quantity: Some(Quantity::Angle),
                meaning: None,
                documentation: "An angle that is written as a number.".to_owned(),
                value: Some(number.value_rad),
            });
        }
    }

    /// The joints that a body's motions and the errors that its factors use first.
    fn declare_used(&mut self, body: &BodyStatement, fixed: &BTreeMap<String, SymbolKind>) {
        for group in &body.groups {
            let role = words::likely_role(&group.role);
            self.is_complete &= role.is_some();
            for factor in &group.factors {
                self.is_complete &= factor.amount.is_some();
                let (Some(role), Some(amount)) = (role, &factor.amount) else {
                    continue;
                };
                for (name, _) in amount.names() {
                    let kind = match fixed.get(name) {
                        Some(SymbolKind::Joint) if role == Role::Motion => SymbolKind::Joint,
                        None if matches!(role, Role::PositionError | Role::MotionError) => SymbolKind::Error,
                        _ => continue,
                    };
                    let documentation = documentation(group, factor);
                    self.declare(Entry {
                        name: name.to_owned(),
                        kind,
                        quantity: None,
                        meaning: None,
                        documentation: documentation.to_owned(),
                        value: None,
                    });
                    if role == Role::Motion {
                        self.moved_by(name, factor, documentation);
                    }
                }
            }
        }
    }

    /// The errors that the numbers of a camera or a bending of a line of sight use first.
    fn declare_observed(&mut self, observe: &ObserveStatement, fixed: &BTreeMap<String, SymbolKind>) {
        let intrinsics = observe.image.iter().flat_map(|image| &image.intrinsics);
        let amounts: Vec<_> = intrinsics.chain(observe.bent.iter().map(|bent| &bent.amount)).collect();
        self.is_complete &= amounts.iter().all(|amount| amount.is_some());
        for (name, _) in amounts.into_iter().flatten().flat_map(|amount| amount.names()) {
            if !fixed.contains_key(name) {
                self.declare(Entry {
                    name: name.to_owned(),
                    kind: SymbolKind::Error,
                    quantity: None,
                    meaning: None,
                    documentation: observe.documentation.clone(),
                    value: None,
                });
            }
        }
    }

    /// The ramps that amounts use, each a symbol of its own. One that is none is left out, and a rule says why.
    fn declare_ramps(&mut self, declaration: &Declaration) {
        let mut written = Vec::new();
        declaration.amounts().for_each(|amount| amount.ramps(&mut written));
        for parts in written {
            let Some((of, [from, to])) = self.ramp_parts(parts) else { continue };
            if self.find_ramp(of, &from, &to).is_some() {
                continue;
            }
            let name = format!("ramp {}", self.ramps.len());
            self.declare(Entry {
                name: name.clone(),
                kind: SymbolKind::Ramp,
                quantity: Some(Quantity::Number),
                meaning: None,
                documentation: String::new(),
                value: None,
            });
            if let Some(symbol) = self.find(&name) {
                self.ramps.push(Ramp { symbol, of, from, to });
            }
        }
    }

    /// The joint or input and the thresholds of a ramp as written.
    pub fn ramp_parts(&self, [of, from, to]: &[Expr<Span>; 3]) -> Option<(SymbolId, [Poly; 2])> {
        let Node::Symbol(name) = &of.node else { return None };
        let of = self.find(name)?;
        let is_movable = matches!(self.entry(of).kind, SymbolKind::Joint | SymbolKind::Input);
        is_movable.then_some((of, [self.threshold(from)?, self.threshold(to)?]))
    }

    /// A threshold of a ramp: a polynomial in numbers and constants.
    pub fn threshold(&self, written: &Expr<Span>) -> Option<Poly> {
        let value = Poly::from_expr(written, |name| self.find(name), |_| false).ok()?;
        let is_fixed = |id: &SymbolId| matches!(self.entry(*id).kind, SymbolKind::Pi | SymbolKind::Constant);
        value.symbols().iter().all(is_fixed).then_some(value)
    }

    /// The symbol of a ramp.
    pub fn find_ramp(&self, of: SymbolId, from: &Poly, to: &Poly) -> Option<SymbolId> {
        let same = |ramp: &&Ramp| ramp.of == of && ramp.from == *from && ramp.to == *to;
        self.ramps.iter().find(same).map(|ramp| ramp.symbol)
    }

    /// The ramps of the declaration.
    pub fn ramps(&self) -> &[Ramp] {
        &self.ramps
    }

    /// A joint's quantity and documentation come from the first motion that it drives.
    fn moved_by(&mut self, name: &str, factor: &FactorTerm, documentation: &str) {
        let Some(id) = self.find(name) else { return };
        let entry = &mut self.entries[id.index()];
        if entry.kind == SymbolKind::Joint && entry.quantity.is_none() {
            entry.quantity = words::transform(&factor.axis).map(|(kind, _)| words::quantity_moved(kind));
            documentation.clone_into(&mut entry.documentation);
        }
    }

    /// Adds a name, unless it is there already.
    fn declare(&mut self, entry: Entry) {
        if self.ids.contains_key(&entry.name) {
            return;
        }
        match u16::try_from(self.entries.len()) {
            Ok(index) => {
                self.ids.insert(entry.name.clone(), SymbolId(index));
                self.entries.push(entry);
            }
            Err(_) => self.is_complete = false,
        }
    }

    /// The id of a name.
    pub fn find(&self, name: &str) -> Option<SymbolId> {
        self.ids.get(name).copied()
    }

    /// The entry behind an id of this scope.
    pub fn entry(&self, id: SymbolId) -> &Entry {
        &self.entries[id.index()]
    }

    /// The entry of a name.
    pub fn lookup(&self, name: &str) -> Option<&Entry> {
        self.find(name).map(|id| self.entry(id))
    }

    /// Every entry, by id.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    /// Whether an id is an error's.
    pub fn is_error(&self, id: SymbolId) -> bool {
        self.entry(id).kind == SymbolKind::Error
    }

    /// Whether sines and cosines may be taken of it.
    pub fn is_angle(&self, id: SymbolId) -> bool {
        let entry = self.entry(id);
        entry.kind != SymbolKind::Error && entry.quantity == Some(Quantity::Angle)
    }
}

/// The documentation of a factor: its own, else that of its list.
pub fn documentation<'a>(group: &'a FactorGroup, factor: &'a FactorTerm) -> &'a str {
    if factor.documentation.is_empty() { &group.documentation } else { &factor.documentation }
}

/// The kinds that do not depend on the order of statements: constants and inputs by their statements, joints by
/// the motions that they drive.
fn fixed_kinds(declaration: &Declaration) -> BTreeMap<String, SymbolKind> {
    let mut kinds = BTreeMap::new();
    for constant in declaration.constants() {
        kinds.entry(constant.name.to_string()).or_insert(SymbolKind::Constant);
    }
    for input in declaration.inputs() {
        let kind = if input.between.is_some() { SymbolKind::SightAngle } else { SymbolKind::Input };
        kinds.entry(input.name.to_string()).or_insert(kind);
    }
    let motions = declaration
        .bodies()
        .flat_map(|body| &body.groups)
        .filter(|group| words::likely_role(&group.role) == Some(Role::Motion));
    for amount in motions.flat_map(|group| &group.factors).filter_map(|factor| factor.amount.as_ref()) {
        for (name, _) in amount.names() {
            kinds.entry(name.to_owned()).or_insert(SymbolKind::Joint);
        }
    }
    kinds
}
