//! Constants without a value: formulas have them as symbols, numbers are refused.
#![allow(clippy::unwrap_used)]

use model_core::{Chain, forms, print};

const TEXT: &str = "chain Arm {
    const reach: length;
    const lean: angle;
    const ratio;
    body base on ground { position: Rx(lean); motion: Rz(q); motion_error: Rz(e), Rx(ratio*f); }
    body tip on base { position: Tx(reach); motion_error: Ty(d); }
    observe hand: point(0, 0, 0) of tip;
}";

#[test]
fn formulas_have_them_as_symbols() {
    let chain = Chain::symbolic_from_text(TEXT).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let reach = chain.find_symbol("reach").map(|id| chain.symbol(id)).unwrap();
    assert_eq!((reach.value, reach.quantity.unit()), (None, "m"));
    let form = forms::derive(&chain, chain.find_observable("hand").unwrap(), 1).unwrap();
    assert_eq!(print::text(&form.components[0].above, &chain), "-(reach*e + d)*sin(q)");
    assert!(print::text(&form.components[2].above, &chain).contains("sin(lean)"));
    // Whatever is calculated with them is no number, and never a wrong one.
    let id = chain.find_observable("hand").unwrap();
    assert!(model_core::exact::value(&chain, id, &chain.nominal_values()).x.is_nan());
}

#[test]
fn numbers_are_refused_with_the_name_and_what_to_write() {
    let mistakes = Chain::from_text(TEXT).unwrap_err();
    let said = mistakes.to_string();
    for (name, help) in [
        ("reach", "const reach: length = 0.25;"),
        ("lean", "const lean: angle = 0.25;"),
        ("ratio", "const ratio = 0.25;"),
    ] {
        assert!(said.contains(&format!("the constant `{name}` has no value")), "{said}");
        assert!(mistakes.render("arm.chain", TEXT).contains(help), "{said}");
    }
}

#[test]
fn the_declaration_reads_back_and_a_broken_value_is_still_a_mistake() {
    let (declaration, chain) = model_core::validate::read_symbolic(TEXT.parse().unwrap()).unwrap();
    assert_eq!(Chain::symbolic_from_text(&declaration.to_string()).unwrap(), chain);
    for (broken, said) in [
        ("const reach: length =;", "expected"),
        ("const reach: lenght;", "did you mean `length`"),
        ("const reach: length = 2*;", "expected"),
        ("const reach: length 0.25;", "expected `=`"),
    ] {
        let text = TEXT.replace("const reach: length;", broken);
        let mistakes = Chain::symbolic_from_text(&text).unwrap_err();
        let shown = mistakes.render("arm.chain", &text);
        assert!(shown.contains(said), "{broken}: {shown}");
    }
}
