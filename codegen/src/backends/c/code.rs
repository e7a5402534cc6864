//! Statements of the tree as C.

use model_core::{Chain, SymbolId, SymbolKind};

use crate::backends::names::Names;
use crate::backends::notation::{Notation, Scope, angle, waves};
use crate::backends::unit::Precision;
use crate::lower::tree::{Angle, Function, Name, Statement, Target, Wave};

/// C in one place of a file.
pub(super) struct C<'a> {
    pub(super) chain: &'a Chain,
    pub(super) names: &'a Names,
    pub(super) scope: Scope,
    pub(super) precision: Precision,
    /// The call that gives sine and cosine of one pose, up to the angle.
    pub(super) sin_cos: &'a str,
}

impl Notation for C<'_> {
    fn symbol(&self, id: SymbolId) -> String {
        let name = self.names.symbol(id);
        match (self.chain.symbol(id).kind, self.scope) {
            (SymbolKind::Pi | SymbolKind::Constant, _) => {
                self.number(crate::backends::declared(self.chain, id))
            }
            (SymbolKind::Ramp | SymbolKind::SightAngle, _) => {
                unreachable!("a ramp or angle of a line of sight is computed from what it follows from")
            }
            (SymbolKind::Error, _) => format!("errors->{name}"),
            (SymbolKind::Joint, Scope::Pose) => format!("joints->{name}"),
            (SymbolKind::Input, Scope::Pose) => format!("inputs->{name}"),
            (SymbolKind::Joint | SymbolKind::Input, Scope::Row | Scope::RowWithWaves) => {
                format!("column_{name}[row]")
            }
        }
    }

    fn name(&self, name: Name) -> String {
        self.scope.name(name, self.names)
    }

    fn number(&self, value: f64) -> String {
        match self.precision {
            Precision::Double => format!("{value:?}"),
            Precision::Single => format!("{:?}f", value as f32),
        }
    }

    fn call(&self, function: Function, a: &str) -> String {
        match function {
            Function::Saturate => format!("trueaxis_saturate({a})"),
            Function::Step => format!("trueaxis_step({a})"),
            Function::Root => format!("trueaxis_root({a})"),
        }
    }

    fn arc_tangent(&self, y: &str, x: &str) -> String {
        format!("trueaxis_arc_tangent({y}, {x})")
    }

    fn mul_add(&self) -> Option<&'static str> {
        Some("trueaxis_mul_add(fused, ")
    }
}

/// The type of numbers.
pub(super) fn real(precision: Precision) -> &'static str {
    match precision {
        Precision::Double => "double",
        Precision::Single => "float",
    }
}

impl C<'_> {
    /// Statements, each on lines of its own.
    pub(super) fn statements(&self, statements: &[Statement], indent: usize) -> String {
        statements.iter().map(|statement| self.statement(statement, indent)).collect()
    }

    fn statement(&self, statement: &Statement, indent: usize) -> String {
        let space = " ".repeat(indent);
        let real = real(self.precision);
        match statement {
            Statement::Let(name, value) => {
                format!("{space}const {real} {} = {};\n", self.name(*name), self.text(value))
            }
            Statement::SinCos { angle, sine, cosine } => {
                // What is not wanted gets the name of what is.
                let missing = |name: &Option<Name>, other: &Option<Name>| match (name, other) {
                    (Some(name), _) => self.name(*name),
                    (None, Some(other)) => format!("unread_{}", self.name(*other)),
                    (None, None) => unreachable!("sine or cosine is wanted"),
                };
                let (sine, cosine) = (missing(sine, cosine), missing(cosine, sine));
                let angle = self.text(angle);
                let call = match self.scope {
                    Scope::Pose => self.sin_cos,
                    Scope::Row | Scope::RowWithWaves => "trueaxis_sin_cos_in_loop(fused, narrow, ",
                };
                format!("{space}{real} {sine}, {cosine};\n{space}{call}{angle}, &{sine}, &{cosine});\n")
            }
            Statement::Angles(node) => format!("{space}double angle_{}[TRUEAXIS_ROWS];\n", node.index()),
            Statement::SinCosOfRows(of) => {
                let name = angle(*of, self.names);
                let (sine, cosine) =
                    (waves(Wave::Sine, *of, self.names), waves(Wave::Cosine, *of, self.names));
                let source = match of {
                    Angle::Symbol(_) => format!("column_{name}"),
                    Angle::Node(_) => format!("angle_{name}"),
                };
                format!(
                    "{space}TRUEAXIS_ALIGNED double {sine}[TRUEAXIS_ROWS], {cosine}[TRUEAXIS_ROWS];\n\
                     {space}trueaxis_sin_cos_rows(fused, {source}, {sine}, {cosine});\n"
                )
            }
            Statement::EachRow(body) => format!(
                "{space}for (row = 0; row < TRUEAXIS_ROWS; row++) {{\n{}{space}}}\n",
                self.statements(body, indent + 4)
            ),
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
