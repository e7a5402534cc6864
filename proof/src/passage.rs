//! The way of a statement: every factor from the frame that an observable is seen in to the body that carries it.

use super::declared::Declared;
use model_core::algebra::Poly;
use model_core::chain::{Axis, BodyId, ObservableId, TransformKind};
use model_core::expr::{Expr, Node};

/// A function of t by its powers, lowest first.
pub(super) type Jet = Vec<Poly>;

/// A factor on the way.
#[derive(Debug, Clone)]
pub(super) struct Passage {
    pub body: BodyId,
    pub kind: TransformKind,
    pub axis: Axis,
    /// Its amount as written, the opposite on the way out of a frame.
    pub written: Expr<()>,
    /// What that says.
    pub amount: Poly,
    /// The same by powers of t.
    pub jet: Jet,
}

/// The bodies on the way, in the order they multiply, each with whether it is gone through backwards.
pub(super) fn bodies(declared: &Declared, observable: ObservableId) -> Vec<(BodyId, bool)> {
    let chain = declared.chain();
    let observable = chain.observable(observable);
    let up = chain.path(observable.body);
    let down = observable.frame.map_or_else(Vec::new, |frame| chain.path(frame));
    let common = up.iter().zip(&down).take_while(|(a, b)| a == b).count();
    let back = down[common..].iter().rev().map(|body| (*body, true));
    back.chain(up[common..].iter().map(|body| (*body, false))).collect()
}

/// The factors of these bodies; powers of t are to be filled in.
pub(super) fn factors(declared: &Declared, bodies: &[(BodyId, bool)]) -> Vec<Passage> {
    let mut passages = Vec::new();
    for &(body, is_reversed) in bodies {
        let straight = declared.body(body).iter().map(|factor| Passage {
            body,
            kind: factor.kind,
            axis: factor.axis,
            written: factor.written.clone(),
            amount: factor.amount.clone(),
            jet: Jet::new(),
        });
        if is_reversed {
            passages.extend(straight.rev().map(|passage| Passage {
                written: Expr { node: Node::Neg(Box::new(passage.written)), place: () },
                amount: -&passage.amount,
                ..passage
            }));
        } else {
            passages.extend(straight);
        }
    }
    passages
}
