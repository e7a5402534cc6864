//! How much each form costs, in snapshots. For the mobile lidar, direction and point, the aims are, beside the six sines
//! and cosines of a pose: first-order error at most 64 operations in one stage and 55 of a pose, exact error 140
//! of a pose, Jacobian 850.

use std::fmt::Write;

use codegen::{Form, build};
use model_core::{Chain, ObservableId};

use crate::support::{CHAINS, errors, read};

const FORMS: [Form; 5] = [
    Form::ExactValue,
    Form::ExactError,
    Form::FirstOrderError,
    Form::ExactJacobian,
    Form::FirstOrderJacobian,
];

fn table(chain: &Chain, observables: &[ObservableId]) -> String {
    FORMS.into_iter().fold(String::new(), |mut table, form| {
        let counts = build(chain, observables, form, &errors(chain)).counts();
        writeln!(table, "{form:?}: {counts}").unwrap();
        table
    })
}

#[test]
fn direction_and_point_of_the_mobile_lidar() {
    let (name, text) = CHAINS[0];
    let chain = read(name, text);
    let observables = ["pointing", "position"].map(|name| chain.find_observable(name).unwrap());
    insta::assert_snapshot!(table(&chain, &observables));
}

#[test]
fn every_chain() {
    let mut tables = String::new();
    for (name, text) in CHAINS {
        let chain = read(name, text);
        let all: Vec<ObservableId> =
            (0..u16::try_from(chain.observables.len()).unwrap()).map(ObservableId).collect();
        writeln!(tables, "{name}\n{}", table(&chain, &all)).unwrap();
    }
    insta::assert_snapshot!(tables);
}
