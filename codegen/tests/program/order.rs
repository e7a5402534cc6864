//! The order of a program's nodes: few values wait at a time.

use codegen::{Form, NodeId, Op, Program, Stage, build};
use model_core::ObservableId;

use crate::support::{CHAINS, errors, read};

const FORMS: [Form; 4] =
    [Form::ExactError, Form::FirstOrderError, Form::ExactJacobian, Form::FirstOrderJacobian];

/// For each evaluated node, the last node of its group: itself, or that of the only node that reads it.
struct Groups {
    last: Vec<usize>,
    is_read: Vec<bool>,
}

fn groups(program: &Program) -> Groups {
    let count = program.nodes().len();
    let mut readers: Vec<Vec<NodeId>> = vec![Vec::new(); count];
    for (node, op) in program.stage(Stage::Evaluated) {
        op.operands().for_each(|operand| readers[operand.index()].push(node));
    }
    let mut last: Vec<usize> = (0..count).collect();
    let evaluated: Vec<_> = program.stage(Stage::Evaluated).collect();
    for &(node, op) in evaluated.iter().rev() {
        let stays = program.outputs().contains(&node) || matches!(op, Op::Sin(_) | Op::Cos(_));
        if let (false, &[reader]) = (stays, readers[node.index()].as_slice()) {
            last[node.index()] = last[reader.index()];
        }
    }
    Groups { last, is_read: readers.iter().map(|readers| !readers.is_empty()).collect() }
}

fn each_program(check: impl Fn(&str, &Program)) {
    for (name, text) in CHAINS {
        let chain = read(name, text);
        let observables: Vec<ObservableId> =
            (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId).collect();
        for form in FORMS {
            check(name, &build(&chain, &observables, form, &errors(&chain)));
        }
    }
}

#[test]
fn what_one_node_reads_comes_just_before_it() {
    each_program(|name, program| {
        let Groups { last, .. } = groups(program);
        for (node, _) in program.stage(Stage::Evaluated) {
            let group = last[node.index()];
            assert!((node.index()..=group).all(|other| last[other] == group), "{name}, {node:?}");
        }
    });
}

#[test]
fn what_only_comes_out_comes_as_soon_as_it_can() {
    each_program(|name, program| {
        let Groups { last, is_read } = groups(program);
        for (node, _) in program.stage(Stage::Evaluated) {
            let group = last[node.index()];
            if is_read[group] {
                continue;
            }
            // Between what it reads and itself, there is nothing that a later node waits for.
            let members = (0..=group).filter(|&other| last[other] == group);
            let latest = members
                .flat_map(|member| program.nodes()[member].operands())
                .filter(|&read| program.stage_of(read) == Stage::Evaluated && last[read.index()] != group)
                .max();
            let Some(latest) = latest else { continue };
            assert!((latest.index() + 1..group).all(|other| !is_read[last[other]]), "{name}, {node:?}");
        }
    });
}
