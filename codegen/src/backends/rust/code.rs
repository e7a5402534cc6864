//! Statements of the tree as Rust.

use model_core::{Chain, SymbolId, SymbolKind};

use crate::backends::names::{Names, Rules};
use crate::backends::notation::{Notation, Scope, angle, waves};
use crate::backends::unit::Precision;
use crate::lower::Pose;
use crate::lower::tree::{Angle, Function, Name, Statement, Target, Wave};

/// Names of a declaration are identifiers of Rust.
pub(super) const RULES: Rules = Rules { words: &[], starts: &[], takes_letters: true, longest: usize::MAX };

/// How Rust writes constants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Constants {
    /// As the numbers that the declaration gives them.
    AsDeclared,
    /// As fields of `constants`.
    Fields,
}

/// Rust in one place of a file.
pub(super) struct Rust<'a> {
    pub(super) chain: &'a Chain,
    pub(super) names: &'a Names,
    pub(super) scope: Scope,
    pub(super) constants: Constants,
    pub(super) precision: Precision,
    /// The path of the functions that ramps are made of: `sine_cosine::`.
    pub(super) kernel: &'a str,
    /// The function that gives sine and cosine of one pose.
    pub(super) sin_cos: &'a str,
}

impl Notation for Rust<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let symbol = self.chain.symbol(id);
        let name = self.names.symbol(id);
        match (symbol.kind, self.scope) {
            (SymbolKind::Constant, _) if self.constants == Constants::Fields => format!("constants.{name}"),
            (SymbolKind::Pi | SymbolKind::Constant, _) => {
                self.number(crate::backends::declared(self.chain, id))
            }
            (SymbolKind::Ramp | SymbolKind::SightAngle, _) => {
                unreachable!("a ramp or angle of a line of sight is computed from what it follows from")
            }
            (SymbolKind::Error, _) => format!("errors.{name}"),
            (SymbolKind::Joint, Scope::Pose) => format!("joints.{name}"),
            (SymbolKind::Input, Scope::Pose) => format!("inputs.{name}"),
            (SymbolKind::Joint | SymbolKind::Input, Scope::Row | Scope::RowWithWaves) => {
                format!("column_{name}[row]")
            }
        }
    }

    fn name(&self, name: Name) -> String {
        self.scope.name(name, self.names)
    }

    fn number(&self, value: f64) -> String {
        number(value, self.precision)
    }

    fn call(&self, function: Function, a: &str) -> String {
        match function {
            Function::Saturate => format!("{}saturate({a})", self.kernel),
            Function::Step => format!("{}step({a})", self.kernel),
            Function::Root => format!("{}root({a})", self.kernel),
        }
    }

    fn arc_tangent(&self, y: &str, x: &str) -> String {
        format!("{}arc_tangent({y}, {x})", self.kernel)
    }

    fn mul_add(&self) -> Option<&'static str> {
        Some("arithmetic.mul_add(")
    }
}

/// A number with as many digits as it needs.
pub(super) fn number(value: f64, precision: Precision) -> String {
    match precision {
        Precision::Double => format!("{value:?}"),
        Precision::Single => format!("{:?}", value as f32),
    }
}

/// The type of numbers.
pub(super) fn real(precision: Precision) -> &'static str {
    match precision {
        Precision::Double => "f64",
        Precision::Single => "f32",
    }
}

impl Rust<'_> {
    /// Statements, each on lines of its own.
    pub(super) fn statements(&self, statements: &[Statement], indent: usize) -> String {
        statements.iter().map(|statement| self.statement(statement, indent)).collect()
    }

    fn statement(&self, statement: &Statement, indent: usize) -> String {
        let space = " ".repeat(indent);
        match statement {
            Statement::Let(name, value) => {
                format!("{space}let {} = {};\n", self.name(*name), self.text(value))
            }
            Statement::SinCos { angle, sine, cosine } => {
                let name = |name: &Option<Name>| name.map_or_else(|| "_".to_owned(), |name| self.name(name));
                let (sine, cosine, angle) = (name(sine), name(cosine), self.text(angle));
                let call = match self.scope {
                    Scope::Pose => format!("{}({angle})", self.sin_cos),
                    Scope::Row | Scope::RowWithWaves => {
                        format!("sine_cosine::sin_cos_in_loop::<A, NARROW>(arithmetic, {angle})")
                    }
                };
                format!("{space}let ({sine}, {cosine}) = {call};\n")
            }
            Statement::Angles(node) => format!("{space}let mut angle_{} = [0.0; ROWS];\n", node.index()),
            Statement::SinCosOfRows(of) => {
                let name = angle(*of, self.names);
                let (sine, cosine) =
                    (waves(Wave::Sine, *of, self.names), waves(Wave::Cosine, *of, self.names));
                let source = match of {
                    Angle::Symbol(_) => format!("column_{name}"),
                    Angle::Node(_) => format!("&angle_{name}"),
                };
                format!(
                    "{space}let mut waves_{name} = sine_cosine::Waves::NEW;\n\
                     {space}let ({sine}, {cosine}) = sine_cosine::sin_cos_rows(arithmetic, {source}, &mut waves_{name});\n"
                )
            }
            Statement::EachRow(body) => {
                format!("{space}for row in 0..ROWS {{\n{}{space}}}\n", self.statements(body, indent + 4))
            }
            Statement::Store(target, value) => {
                let target = match target {
                    Target::Output(output) => format!("out{output}"),
                    Target::Column(place) => format!("out[{place}]"),
                    Target::Angle(node) => format!("angle_{}", node.index()),
                };
                format!("{space}{target}[row] = {};\n", self.text(value))
            }
        }
    }
}

/// The code of one pose, in pieces that a file and the macro `chain!` put together.
pub struct Stages {
    /// What depends on errors and constants alone.
    pub prepared: String,
    /// What of that is kept for poses.
    pub kept: Vec<String>,
    /// What depends on joints and inputs.
    pub evaluated: String,
    /// What comes out, in the order of the program's outputs.
    pub outputs: Vec<String>,
}

impl Rust<'_> {
    pub(super) fn stages(&self, pose: &Pose, indent: usize) -> Stages {
        let texts = |values: &[_]| values.iter().map(|value| self.text(value)).collect();
        Stages {
            prepared: self.statements(&pose.prepared, indent),
            kept: texts(&pose.kept),
            evaluated: self.statements(&pose.evaluated, indent),
            outputs: texts(&pose.outputs),
        }
    }
}
