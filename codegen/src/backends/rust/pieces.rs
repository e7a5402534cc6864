//! Pieces of Rust for the macro `chain!`, which puts them into a module of its own.

use model_core::{Chain, SymbolId, SymbolKind};

use super::code::{Constants, RULES, Rust, Stages};
use super::types;
use crate::backends::names::Names;
use crate::backends::notation::Scope;
use crate::backends::unit::{Group, Precision};
use crate::lower::pose;
use crate::program::Program;

/// The pieces of one chain. Constants are fields, so that an instrument can have other ones than declared.
pub struct Pieces<'a> {
    chain: &'a Chain,
    names: Names,
}

impl<'a> Pieces<'a> {
    /// Those of a chain.
    #[must_use]
    pub fn new(chain: &'a Chain) -> Self {
        Self { chain, names: Names::new(chain, RULES) }
    }

    /// What a symbol is called in Rust.
    #[must_use]
    pub fn name(&self, id: SymbolId) -> &str {
        self.names.symbol(id)
    }

    /// The structure of all symbols of a kind, if the chain has any, and for joints and inputs that of many poses.
    #[must_use]
    pub fn structure(&self, kind: SymbolKind) -> String {
        let Some(group) = Group::new(kind, self.chain.symbols_of(kind).collect()) else {
            return String::new();
        };
        let mut text = types::structure(self.chain, &self.names, &group, Precision::Double);
        if matches!(kind, SymbolKind::Joint | SymbolKind::Input) {
            text.push_str(&types::rows(self.chain, &self.names, &group));
        }
        text
    }

    /// The error of methods of many poses.
    #[must_use]
    pub fn lengths_differ(&self) -> &'static str {
        types::LENGTHS_DIFFER
    }

    /// The code of one pose, where `errors`, `constants`, `joints` and `inputs` hold their symbols and `p` is what was
    /// kept; `sin_cos` is the function that gives sine and cosine, `saturate` and `step` are those of ramps, `root` and
    /// `arc_tangent` those of readings.
    #[must_use]
    pub fn stages(&self, program: &Program, sin_cos: &str) -> Stages {
        let (scope, constants) = (Scope::Pose, Constants::Fields);
        let precision = Precision::Double;
        Rust { chain: self.chain, names: &self.names, scope, constants, precision, kernel: "", sin_cos }
            .stages(&pose(program), 0)
    }
}
