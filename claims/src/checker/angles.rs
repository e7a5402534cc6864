//! Slips in the angle of a sine or cosine: which angles are easily taken for another.

use std::ops::Range;

use model_core::chain::Chain;
use model_core::expr::{Expr, Node};
use model_core::symbol::SymbolKind;

/// The angles that are easily taken for this one: of another joint, with a joint more, and of a sum with another sign, with
/// an angle less or with another in its place.
pub(super) fn taken_for(chain: &Chain, angle: &Expr<Range<usize>>) -> Vec<Expr<Range<usize>>> {
    let make = |node| Expr { node, place: angle.place.clone() };
    let joints: Vec<Expr<Range<usize>>> = chain
        .symbols_of(SymbolKind::Joint)
        .map(|joint| make(Node::Symbol(chain.symbol(joint).name.clone())))
        .collect();
    let mut addends = Vec::new();
    flatten(angle, false, &mut addends);
    let sum = |addends: &[(bool, Expr<Range<usize>>)]| {
        let signed = addends.iter().map(|(negative, addend)| match negative {
            true => make(Node::Neg(Box::new(addend.clone()))),
            false => addend.clone(),
        });
        signed.reduce(|sum, addend| make(Node::Add(Box::new(sum), Box::new(addend))))
    };
    let mut others: Vec<Expr<Range<usize>>> = joints.clone();
    if addends.len() > 1 {
        for at in 0..addends.len() {
            let mut changed = addends.clone();
            changed[at].0 = !changed[at].0;
            others.extend(sum(&changed));
        }
        for at in 0..addends.len() {
            let mut changed = addends.clone();
            changed.remove(at);
            others.extend(sum(&changed));
        }
        for at in 0..addends.len() {
            for joint in &joints {
                let mut changed = addends.clone();
                changed[at].1 = joint.clone();
                others.extend(sum(&changed));
            }
        }
    }
    for joint in &joints {
        for negative in [false, true] {
            others.extend(sum(&[addends.as_slice(), &[(negative, joint.clone())]].concat()));
        }
    }
    others
}

/// The addends of a sum of angles, each with whether it is subtracted.
fn flatten(angle: &Expr<Range<usize>>, negative: bool, addends: &mut Vec<(bool, Expr<Range<usize>>)>) {
    match &angle.node {
        Node::Add(a, b) => {
            flatten(a, negative, addends);
            flatten(b, negative, addends);
        }
        Node::Neg(inner) => flatten(inner, !negative, addends),
        _ => addends.push((negative, angle.clone())),
    }
}
