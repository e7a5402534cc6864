//! Against SymPy, exactly: `tests/reference/make_columns.py`.

use super::chain;
use model_core::algebra::Poly;
use model_core::{SymbolKind, forms, syntax};
use std::collections::BTreeMap;

/// Error, axis and expression.
type Entry<'a> = (&'a str, usize, &'a str);

#[test]
fn validate_every_first_order_column() {
    let mut reference: BTreeMap<(&str, &str), Vec<Entry>> = BTreeMap::new();
    for line in include_str!("../reference/columns.txt").lines() {
        let (place, expression) = line.split_once(" = ").unwrap();
        let [chain, observable, error, axis] = place.split(' ').collect::<Vec<_>>().try_into().unwrap();
        let axis = ["x", "y", "z"].iter().position(|name| *name == axis).unwrap();
        reference.entry((chain, observable)).or_default().push((error, axis, expression));
    }
    assert_eq!(reference.len(), 6);
    for ((name, observable), entries) in reference {
        let chain = chain(name);
        let form = forms::derive(&chain, chain.find_observable(observable).unwrap(), 1).unwrap();
        let mut columns = form.columns(&chain);
        for (error, axis, expression) in entries {
            let expected = Poly::from_expr(
                &syntax::parse_amount(expression).unwrap(),
                |name| chain.find_symbol(name),
                |id| chain.symbol(id).kind != SymbolKind::Error,
            )
            .unwrap();
            let error_id = chain.find_symbol(error).unwrap();
            let column = columns.iter_mut().find(|(id, _)| *id == error_id).unwrap();
            assert_eq!(std::mem::take(&mut column.1[axis]), expected, "{name} {observable} {error} {axis}");
        }
        // What the reference does not list is zero.
        assert!(columns.iter().all(|(_, column)| column.iter().all(Poly::is_zero)), "{name} {observable}");
    }
}
