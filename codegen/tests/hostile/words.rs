//! Words: documentation, and names of files in remarks.

use codegen::Unit;
use model_core::{Chain, ObservableId};
use proptest::prelude::*;

use super::{FORMS, compiles, folder};

const DECLARATION: &str = "chain Words {
    const size: length = 0.5;
    input range: length;
    body table on ground {
        position_error: Rx(a), Ry(b), Tx(c);
        motion: Rz(turn);
        motion_error: Rx(d), Tz(e*size);
    }
    observe mark: point(size, 0, range) of table;
    observe sight: direction(0, 1, 0) of table;
}";

/// What ends a comment, a line or a text in some language, and what does something once it is outside.
const PIECES: [&str; 42] = [
    "*/",
    "/*",
    "//",
    "\u{2028}",
    "\u{2029}",
    "\r",
    "\n",
    "\r\n",
    "\u{85}",
    "\u{b}",
    "\u{c}",
    "\\",
    "??/",
    "\\ ",
    "\"\"\"",
    "'''",
    "\"",
    "'",
    "#",
    "%",
    "\0",
    "\u{1b}",
    "\u{202e}",
    "\u{2066}",
    "\u{200b}",
    "\u{feff}",
    "]]>",
    "-->",
    "#error injected\n",
    "globalThis.injected = 1;",
    "raise SystemExit('injected')",
    "compile_error!(\"injected\");",
    "\\input{injected}",
    "${injected}",
    "é words ",
    "   ",
    "```\npanic!(\"injected\");\n```\n",
    "\n    panic!(\"injected\");\n",
    "\n-      panic!(\"injected\");\n",
    "> ~~~\n",
    "<img src=x onerror=injected> [injected](x)",
    "`code",
];

fn words() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(PIECES.as_slice()), 0..7).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, max_shrink_iters: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn words_stay_in_comments(words in prop::collection::vec(words(), 14)) {
        let mut chain = Chain::from_text(DECLARATION).unwrap();
        let mut words = words.into_iter();
        let mut next = || words.next().unwrap_or_default();
        chain.documentation = next();
        let (declaration, remarks) = (next(), [next(), next()]);
        for symbol in &mut chain.symbols {
            symbol.documentation = next();
        }
        for observable in &mut chain.observables {
            observable.documentation = next();
        }
        let observables = [ObservableId(0), ObservableId(1)];
        let unit = Unit { remarks: &remarks, ..Unit::new(&chain, &declaration, &observables, &FORMS) };
        compiles(&unit, &folder("words"));
    }
}
