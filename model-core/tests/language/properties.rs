//! Properties of the language: no text makes the reader panic; what is printed reads back as the same chain.
#![allow(clippy::unwrap_used)]

use model_core::syntax::{self, Declaration};
use model_core::{Chain, Mistakes};
use proptest::prelude::*;

/// Pieces that texts are made of: words and marks of the language, and what is none.
const PIECES: [&str; 48] = [
    "chain",
    "body",
    "on",
    "ground",
    "const",
    "input",
    "symbol",
    "observe",
    "gravity",
    "of",
    "position",
    "position_error",
    "motion",
    "motion_error",
    "Rx",
    "Tz",
    "Rw",
    "direction",
    "point",
    "angle",
    "length",
    "pi",
    "sin",
    "tan",
    "alpha",
    "a",
    "b",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    ":",
    ";",
    ",",
    "=",
    "+",
    "-",
    "*",
    "/",
    "^",
    "2",
    "0.25",
    "1e308",
    "\"x\"",
    "/// doc\n",
    "é'\u{feff}",
];

fn words() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(PIECES.to_vec()), 0..60).prop_map(|pieces| pieces.join(" "))
}

/// Mistakes have places in the text, in order.
fn are_in_order(mistakes: &Mistakes, text: &str) -> bool {
    let starts: Vec<usize> = mistakes.iter().map(|mistake| mistake.place.bytes.start).collect();
    !starts.is_empty()
        && starts.is_sorted()
        && mistakes.iter().all(|mistake| mistake.place.bytes.end <= text.len())
}

/// Amounts of error factors: sums of an error times something.
fn amount() -> impl Strategy<Value = String> {
    let cofactor = prop_oneof![
        Just("1".to_owned()),
        Just("pi/3".to_owned()),
        Just("alpha^2".to_owned()),
        (1..5_i32, -3..4_i32).prop_map(|(k, quarters)| format!("cos({k}*alpha - beta + {quarters}*pi/2)")),
        (1..9_i32, 1..9_i32).prop_map(|(a, b)| format!("(0.{a} - {b}*sin(beta))/7")),
        Just("-tan(beta)*temperature".to_owned()),
        Just("-(arm - 2)^3/csc(alpha)".to_owned()),
    ];
    let term = (prop::sample::select(vec!["e1", "e2", "e3"]), prop::collection::vec(cofactor, 0..4))
        .prop_map(|(error, cofactors)| {
            cofactors.into_iter().fold(error.to_owned(), |product, factor| format!("{product}*{factor}"))
        });
    prop::collection::vec((term, any::<bool>()), 1..5).prop_map(|terms| {
        terms.into_iter().fold(String::new(), |sum, (term, is_negative)| {
            let sign = if is_negative { " - " } else { " + " };
            if sum.is_empty() { term } else { format!("{sum}{sign}{term}") }
        })
    })
}

fn declaration() -> impl Strategy<Value = String> {
    (prop::collection::vec(amount(), 1..4), "[ -~]{0,20}").prop_map(|(amounts, documentation)| {
        let factors: Vec<String> = amounts.iter().map(|amount| format!("Rx({amount})")).collect();
        format!(
            "/// {documentation}\nchain Mount {{ const arm: length = 1/4; input temperature; body fork on ground {{
             position: Tz(arm*0.5), Rx(-pi/2); motion: Rz(alpha), Rx(2*beta - pi); /// {documentation}\n motion_error: {}; }}
             symbol alpha = \"\\\\epsilon_1\"; gravity: (0, -1, arm); observe lens: point(arm/3, -arm*1.5, 1) of fork; }}",
            factors.join(", ")
        )
    })
}

proptest! {
    #[test]
    fn no_text_makes_the_reader_panic(text in prop_oneof![words(), any::<String>()]) {
        if let Err(mistakes) = Chain::from_text(&text) {
            prop_assert!(are_in_order(&mistakes, &text), "{mistakes}");
            prop_assert!(mistakes.render("a.chain", &text).contains("error: "));
        }
        if let Err(mistakes) = syntax::parse_amount(&text) {
            prop_assert!(are_in_order(&mistakes, &text), "{mistakes}");
        }
    }

    #[test]
    fn a_wrong_word_in_a_right_text_is_no_panic(text in declaration(), at in any::<prop::sample::Index>(), word in prop::sample::select(PIECES.to_vec())) {
        let cut = at.index(text.len());
        prop_assume!(text.is_char_boundary(cut));
        let broken = format!("{} {word} {}", &text[..cut], &text[cut..]);
        if let Err(mistakes) = Chain::from_text(&broken) {
            prop_assert!(are_in_order(&mistakes, &broken), "{mistakes}");
        }
    }

    #[test]
    fn what_is_printed_reads_back(text in declaration()) {
        let chain = Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("a.chain", &text)));
        let printed = Declaration::from_text(&text).unwrap().to_string();
        let again = Chain::from_text(&printed).unwrap_or_else(|mistakes| panic!("{}", mistakes.render("a.chain", &printed)));
        prop_assert_eq!(chain, again);
        prop_assert_eq!(&Declaration::from_text(&printed).unwrap().to_string(), &printed);
    }
}

#[test]
fn extreme_texts_are_refused_or_read() {
    let deep = format!("{}a{}", "(".repeat(100_000), ")".repeat(100_000));
    let signs = format!("{}a", "-".repeat(100_001));
    let sum = vec!["a"; 20_000].join(" + ");
    let product = vec!["a"; 500].join("*");
    let tower = "((((a + b)^32)^32)^32)^32";
    let number = "9".repeat(100_000);
    for (amount, is_read) in [
        (deep.as_str(), false),
        (&signs, true),
        (&sum, true),
        (&product, true),
        (tower, true),
        (&number, false),
    ] {
        assert_eq!(syntax::parse_amount(amount).is_ok(), is_read);
        let text = format!("chain Mount {{ body fork on ground {{ motion_error: Tx({amount}); }} }}");
        if let Err(mistakes) = Chain::from_text(&text) {
            assert!(are_in_order(&mistakes, &text));
        }
    }
    let bodies: String = (0..2000).map(|index| format!("body b{index} on b{} {{}}\n", index + 1)).collect();
    let chain = Chain::from_text(&format!("chain Tower {{ {bodies} body b2000 on ground {{}} }}")).unwrap();
    assert_eq!(chain.bodies.len(), 2001);
    assert!(chain.bodies.iter().zip(0..).all(|(body, index)| body.lower.is_none_or(|lower| lower.0 < index)));
}

#[test]
fn the_examples_read_back() {
    for path in ["mobile-lidar/mobile-lidar", "alt-azimuth/alt-azimuth", "six-joint-arm/six-joint-arm"] {
        let file = format!("{}/../examples/{path}.chain", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(file).unwrap();
        let printed = Declaration::from_text(&text).unwrap().to_string();
        assert_eq!(Chain::from_text(&printed).unwrap(), Chain::from_text(&text).unwrap());
    }
}

#[test]
fn a_byte_order_mark_and_carriage_returns_do_not_move_places() {
    let text =
        "\u{feff}chain Mount {\r\n    body fork on ground {\r\n        motion: Rw(alpha);\r\n    }\r\n}\r\n";
    let mistakes = Chain::from_text(text).unwrap_err();
    let places: Vec<(usize, usize, &str)> = mistakes
        .iter()
        .map(|mistake| (mistake.place.line, mistake.place.column, &text[mistake.place.bytes.clone()]))
        .collect();
    assert_eq!(places, [(3, 17, "Rw")]);
}
