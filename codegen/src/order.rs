//! In which order the nodes of a program come, so that few values wait at a time: compilers and the interpreter keep the
//! order, and have few registers and little nearest cache.
//!
//! A value that one node reads comes just before that node; a value that only comes out comes as soon as what it is made
//! of is there, so that it can be stored and forgotten. All others stay in the order in which they were made, sines beside
//! their cosines.

use crate::program::{NodeId, Op};

/// The evaluated nodes, given in an order in which they can be computed, in the order described above.
pub(crate) fn order(nodes: &[Op], outputs: &[NodeId], evaluated: &[usize]) -> Vec<usize> {
    let mut is_output = vec![false; nodes.len()];
    for output in outputs {
        is_output[output.index()] = true;
    }
    let mut is_evaluated = vec![false; nodes.len()];
    let mut readers = vec![Vec::new(); nodes.len()];
    for &node in evaluated {
        is_evaluated[node] = true;
        for operand in nodes[node].operands() {
            readers[operand.index()].push(node);
        }
    }

    // Nodes that one node reads belong to that one's group, which goes by its last node.
    let mut last_of_group: Vec<usize> = (0..nodes.len()).collect();
    for &node in evaluated.iter().rev() {
        let stays = is_output[node] || matches!(nodes[node], Op::Sin(_) | Op::Cos(_));
        if let (false, &[reader]) = (stays, readers[node].as_slice()) {
            last_of_group[node] = last_of_group[reader];
        }
    }
    // A group that only comes out waits for the latest of what it reads; any other group for its turn.
    let mut waits_for: Vec<Option<usize>> = vec![None; nodes.len()];
    for &node in evaluated {
        let last = last_of_group[node];
        let operands = nodes[node].operands().map(NodeId::index);
        let outside = operands.filter(|&read| is_evaluated[read] && last_of_group[read] != last);
        if readers[last].is_empty() {
            waits_for[last] = waits_for[last].max(outside.max());
        }
    }
    let turn = |node: usize| {
        let last = last_of_group[node];
        let waits_for = waits_for[last];
        (waits_for.unwrap_or(last), waits_for.is_some(), last, node)
    };
    let mut ordered = evaluated.to_vec();
    ordered.sort_by_key(|&node| turn(node));
    ordered
}
