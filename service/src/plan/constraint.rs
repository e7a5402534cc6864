//! Constraints on poses as users write them: `elevation + 0.5*azimuth < 90 deg`.

use model_core::expr::Expr;
use model_core::names::{self, listed};
use model_core::{Chain, SymbolId, SymbolKind, syntax};
use std::ops::Range;

use crate::refusal::Refusal;
use crate::source::Source;

/// Whether a comparison of two numbers holds.
type Holds = fn(f64, f64) -> bool;

/// Comparisons, the longer ones first.
const COMPARISONS: [(&str, Holds); 4] = [
    ("<=", |left, right| left <= right),
    (">=", |left, right| left >= right),
    ("<", |left, right| left < right),
    (">", |left, right| left > right),
];

/// What must hold at a pose.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// As it was written.
    pub text: String,
    left: Expr<Range<usize>>,
    holds: Holds,
    right: Expr<Range<usize>>,
}

impl Constraint {
    /// Reads a comparison of two amounts in joints, inputs and constants.
    ///
    /// # Errors
    /// It is no comparison, a side is no amount, or a name is none of what can be set.
    pub fn parse(chain: &Chain, settable: &[SymbolId], text: &str) -> Result<Self, Refusal> {
        let wrong = |why: String| Refusal::Input(format!("--where \"{text}\": {why}"));
        let usage = || wrong("write one comparison, as in \"elevation + 0.5*azimuth < 90 deg\"".to_owned());
        let Some((sign, holds)) = COMPARISONS.iter().find(|(sign, _)| text.contains(sign)) else {
            return Err(usage());
        };
        let (left, right) = text.split_once(sign).ok_or_else(usage)?;
        if [left, right].iter().any(|side| side.contains(['<', '>', '=']) || side.trim().is_empty()) {
            return Err(usage());
        }
        let side = |side: &str| {
            let amount = syntax::parse_amount(side.trim());
            amount.map_err(|mistakes| Source::of_text("--where", side.trim()).mistakes(&mistakes))
        };
        let own =
            Self { text: text.trim().to_owned(), left: side(left)?, holds: *holds, right: side(right)? };
        let known = || {
            let constants = chain.symbols_of(SymbolKind::Constant);
            settable.iter().copied().chain(constants).map(|id| chain.symbol(id).name.as_str())
        };
        let mut moves = false;
        for (name, _) in own.left.names().into_iter().chain(own.right.names()) {
            if !known().any(|known| known == name) {
                let instead = names::nearest(name, known()).map_or_else(
                    || format!("there are {}", listed(known())),
                    |near| format!("did you mean `{near}`?"),
                );
                return Err(wrong(format!("`{name}` is nothing that can be set here; {instead}")));
            }
            moves |= settable.iter().any(|id| chain.symbol(*id).name == name);
        }
        if !moves {
            return Err(wrong(
                "it names no joint, so that it holds at every pose or at none: name one".to_owned(),
            ));
        }
        Ok(own)
    }

    /// Whether it holds at a pose, by the value of each name; not where a side has no value.
    pub(super) fn holds(&self, value: &impl Fn(&str) -> Option<f64>) -> bool {
        match (self.left.eval(value), self.right.eval(value)) {
            (Some(left), Some(right)) => (self.holds)(left, right),
            _ => false,
        }
    }
}
