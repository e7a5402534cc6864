//! Whatever stands in a print or in a paper's source is read or refused, never a panic.

use claims::latex::{NameOf, PrintedSymbols, mathml, program, read_matrix, read_vector, symbols_in};
use claims::paper::{Kind, draft};
use model_core::Chain;
use proptest::prelude::*;

const PIECES: [&str; 87] = [
    r"\begin{bmatrix}",
    r"\end{bmatrix}",
    "&",
    r"\\",
    "{",
    "}",
    "{}",
    "^",
    "_",
    "(",
    ")",
    "[",
    "]",
    "+",
    "-",
    "=",
    "*",
    "/",
    ",",
    ";",
    ".",
    "1",
    "2",
    "0",
    r"\omega",
    r"\vec{\omega}",
    r"\mathbf{R}",
    r"\boldsymbol{\omega}",
    r"\hat",
    r"\times",
    r"\cdot",
    "^T",
    "^{-1}",
    r"_\times",
    r"\sum",
    "_{k=1}^{3}",
    "k",
    "e",
    "e^",
    "q",
    r"\sin",
    r"\cos ",
    r"\frac",
    r"\sqrt",
    "I",
    "R_z(q)",
    "S(",
    "c_1",
    "s_{12}",
    r"\mathrm{Rot}",
    r"\exp",
    r"\prescript",
    "+ O(e^2)",
    "$$",
    "$",
    "```math",
    "```",
    r"\text{a}",
    r"\bf",
    "%",
    "'",
    "np.",
    "np.array([",
    "**",
    "@",
    ".*",
    "...",
    "\n",
    " ",
    "é",
    "\u{2207}",
    r"\newcommand{\x}[1]{#1}",
    "|",
    r"\|",
    r"\lVert ",
    r"\rVert ",
    r"\Delta x",
    r"\partial ",
    r"\ ",
    "<",
    "\u{202e}",
    r"\over ",
    r"\det ",
    r"\boxed",
    "p[0] = ",
    "c_{2+3}",
    r"\begin{vmatrix}",
];

fn chain() -> Chain {
    let text = "chain C { body a on ground { motion: Rz(q); motion_error: Rz(e); } observe p: point(1, 0, 0) of a; }";
    Chain::from_text(text).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_read_or_refused(pieces in proptest::collection::vec(0..PIECES.len(), 0..14)) {
        let text: String = pieces.into_iter().map(|at| PIECES[at]).collect();
        let chain = chain();
        let mut symbols = PrintedSymbols::of_chain(&chain);
        let entry = model_core::syntax::parse_amount("e").unwrap();
        symbols.define_matrix(r"\vec{\omega}", 1, &[entry.clone(), entry.clone(), entry]).unwrap();
        let symbols = symbols.reading(&[&text]);
        let _ = read_vector(&text, &symbols, &[NameOf::Component(0), NameOf::Formula, NameOf::Sideways]);
        let _ = read_matrix(&text, &symbols);
        let _ = program::read_vector(&text, &symbols, &[]);
        let _ = program::read_matrix(&text, &symbols);
        let _ = symbols_in(&text);
        if let Some(page) = mathml(&text) {
            assert!(crate::mathml::is_well_formed(&page), "{text}: {page}");
        }
        for kind in [Kind::Tex, Kind::Markdown] {
            let paper = format!("\\begin{{equation}}{text}\\end{{equation}} $x$ is {text}");
            let _ = draft(&paper, kind, &chain, "p", "c");
        }
    }
}
