//! Formulas as they stand in papers, against the plain syntax of amounts; and what is refused.

use super::*;
use model_core::chain::Chain;
use model_core::expr::{Function, Node};

/// The expression in full parentheses, so that the structure shows.
pub(super) fn shown(formula: &Expr<Range<usize>>) -> String {
    match &formula.node {
        Node::Number(value) => value.to_string(),
        Node::Measured(value, unit) => format!("{value} {}", unit.name()),
        Node::Pi => "pi".to_owned(),
        Node::Ramp(parts) => format!("ramp{:?}", parts.each_ref().map(shown)),
        Node::Symbol(name) => name.clone(),
        Node::Neg(a) => format!("-{}", shown(a)),
        Node::Add(a, b) => format!("({} + {})", shown(a), shown(b)),
        Node::Mul(a, b) => format!("({}*{})", shown(a), shown(b)),
        Node::Div(a, b) => format!("({}/{})", shown(a), shown(b)),
        Node::Pow(a, n) => format!("{}^{n}", shown(a)),
        Node::Call(function, a) => {
            let name = match function {
                Function::Sin => "sin",
                Function::Cos => "cos",
                Function::Tan => "tan",
                Function::Cot => "cot",
                Function::Sec => "sec",
                Function::Csc => "csc",
            };
            format!("{name}({})", shown(a))
        }
    }
}

/// The components of a vector.
fn vector(text: &str, symbols: &PrintedSymbols) -> Result<Vec<Formula>, Unreadable> {
    read_vector(text, symbols, &[0, 1, 2].map(NameOf::Component)).map(|(components, _)| components)
}

fn symbol(name: &str) -> Expr<()> {
    Expr { node: Node::Symbol(name.to_owned()), place: () }
}

pub(super) fn symbols() -> PrintedSymbols {
    let mut symbols = PrintedSymbols::default();
    let sine_of_beta = Expr { node: Node::Call(Function::Sin, Box::new(symbol("beta"))), place: () };
    for (printed, amount) in [
        (r"\alpha", symbol("alpha")),
        (r"\beta", symbol("beta")),
        (r"\Delta\theta_{y1}^0", symbol("dtheta_y1")),
        (r"\Delta\theta_{x3}^{2}", symbol("dtheta_x3")),
        (r"\delta_{x2}^1", symbol("delta_x2")),
        (r"\Delta\beta_2", symbol("db2")),
        (r"\mathrm{range}", symbol("range")),
        ("x", symbol("x")),
        (r"\hat{x}_1", symbol("xhat")),
        (r"s_\beta", sine_of_beta.clone()),
        (r"S\beta", sine_of_beta),
    ] {
        symbols.define(printed, &amount).unwrap_or_else(|error| panic!("{printed}: {error:?}"));
    }
    symbols
}

/// Each formula beside what it means.
#[test]
fn formulas_are_read_as_printed() {
    let cases = [
        (r"x", "x"),
        (r"2x", "(2*x)"),
        (r"-x + 2 - x", "((-x + 2) + -x)"),
        (r"-\alpha \beta", "-(alpha*beta)"),
        (r"x \cdot -\beta", "(x*-beta)"),
        (r"\sin\beta", "sin(beta)"),
        (r"\sin^2 \beta", "sin(beta)^2"),
        (r"\sin^{2}\beta\cos\alpha", "(sin(beta)^2*cos(alpha))"),
        (r"\sin(2\beta)", "sin((2*beta))"),
        (r"\sin 2\beta \cos\alpha", "(sin((2*beta))*cos(alpha))"),
        (r"\cos \beta \sin \alpha", "(cos(beta)*sin(alpha))"),
        (r"\cos\left(\alpha - \beta\right)^2", "cos((alpha + -beta))^2"),
        (r"\sin{\beta} x", "(sin(beta)*x)"),
        (r"\sin -\beta", "sin(-beta)"),
        (r"\mathrm{sin}\,\beta", "sin(beta)"),
        (r"\operatorname{cos}\beta", "cos(beta)"),
        (r"\frac{1}{2}\sin\alpha", "((1/2)*sin(alpha))"),
        (r"\frac12 x", "((1/2)*x)"),
        (r"\tfrac{x + 1}{\cos\beta}", "((x + 1)/cos(beta))"),
        (r"x/2", "(x/2)"),
        (r"0.25 x", "(1/4*x)"),
        (r"\Delta\theta_{y1}^0 \cos\beta", "(dtheta_y1*cos(beta))"),
        (r"\Delta \theta^{0}_{y1}", "dtheta_y1"),
        (r"\Delta\theta _{\mathrm{y}1} ^{ 0 }", "dtheta_y1"),
        (r"\delta^1_{x2}", "delta_x2"),
        (r"(\Delta\theta_{y1}^0)^2", "dtheta_y1^2"),
        (r"{\Delta\theta_{y1}^0}^2", "dtheta_y1^2"),
        (r"\Delta\beta_2^2", "db2^2"),
        (r"\Delta\beta_2 \beta", "(db2*beta)"),
        (r"\beta^2", "beta^2"),
        (r"\alpha^{-1}", "alpha^-1"),
        (r"Δβ_2 − x·α", "(db2 + -(x*alpha))"),
        (r"x s_\beta", "(x*sin(beta))"),
        (r"s_{\beta}^2", "sin(beta)^2"),
        (r"S\beta", "sin(beta)"),
        (r"\hat x_{1}", "xhat"),
        (r"\mathrm{range}\pi", "(range*pi)"),
        (r"\cos(\beta - 90^\circ)", "cos((beta + -(90*(pi/180))))"),
        (r"\Bigl[ x + \{ 1 + x \} \Bigr] x % a comment", "((x + (1 + x))*x)"),
        (r"\sin\frac{\alpha}{2} x", "(sin((alpha/2))*x)"),
        (r"\cfrac{x}{2}", "(x/2)"),
        (r"x sin\beta", "(x*sin(beta))"),
        ("cos α · sin²β", "(cos(alpha)*sin(beta)^2)"),
        ("Δθ⁰_{y1} cos 2β", "(dtheta_y1*cos((2*beta)))"),
        ("δ¹ₓ₂ + ½ x", "(delta_x2 + ((1/2)*x))"),
        ("𝑥 − ∆β₂", "(x + -db2)"),
        (r"{\rm sin}\beta + {\rm range}", "(sin(beta) + range)"),
        (r"\sqrt{2} x", "((1*√2)*x)"),
        (r"\frac{\sqrt{12}}{2}", "((2*√3)/2)"),
        (r"\sqrt{\frac{1}{2}}", "(1/2*√2)"),
        (r"\sqrt{4/9}", "2/3"),
        (r"\left( x \right. \\ \left. + 1 \right) x", "((x + 1)*x)"),
        (r"\Delta\beta_2 (x + 1)", "(db2*(x + 1))"),
        (r"2(3) x", "((2*3)*x)"),
    ];
    let symbols = symbols();
    for (text, meaning) in cases {
        let formula = read_formula(text, &symbols).unwrap_or_else(|mistake| panic!("{text}: {mistake:?}"));
        assert_eq!(shown(&formula), meaning, "{text}");
    }
}

#[test]
fn every_node_knows_its_place() {
    let text = r"x - \Delta\theta_{y1}^0 \cos\beta";
    let formula = read_formula(text, &symbols()).unwrap_or_else(|mistake| panic!("{mistake:?}"));
    let Node::Add(left, right) = &formula.node else { panic!("{formula:?}") };
    let Node::Neg(product) = &right.node else { panic!("{right:?}") };
    let Node::Mul(error, cosine) = &product.node else { panic!("{product:?}") };
    let at = |expr: &Expr<Range<usize>>| &text[expr.place.clone()];
    assert_eq!(
        [at(&formula), at(left), at(right), at(product), at(error), at(cosine)],
        [text, "x", &text[2..], &text[4..], r"\Delta\theta_{y1}^0", r"\cos\beta"]
    );
}

#[test]
fn vectors_are_read_with_and_without_transposition() {
    let symbols = symbols();
    for text in [
        r"[x, -\alpha, 0]^T",
        r"\left[ x , - \alpha , 0 \right]^{\mathrm{T}}",
        r"(x, -\alpha, 0)",
        r"x, -\alpha, 0",
        r"\begin{bmatrix} x \\ -\alpha \\ 0 \end{bmatrix}",
        r"\begin{bmatrix} x & -\alpha & 0 \end{bmatrix}^\top",
        r"\left[\begin{array}{c} x \\ -\alpha \\ 0 \\ \end{array}\right]",
    ] {
        let components = vector(text, &symbols).unwrap_or_else(|mistake| panic!("{text}: {mistake:?}"));
        assert_eq!(components.iter().map(shown).collect::<Vec<_>>(), ["x", "-alpha", "0"], "{text}");
    }
    // Rows, products and sums, and what each component says.
    for (text, said) in [
        (
            r"\Delta x &= x + 1 \\ &\quad - \alpha \\[2pt] \Delta y &= 2, \\ \Delta z &= 0. \tag{7}",
            ["((x + 1) + -alpha)", "2", "0"],
        ),
        (
            r"\left\{\begin{array}{l} e_x = x \\ e_y = 2 \\ e_z = \alpha \end{array}\right.",
            ["x", "2", "alpha"],
        ),
        (r"\[ \begin{aligned} x \\ 2 \\ \alpha \end{aligned} \] (12)", ["x", "2", "alpha"]),
        (r"x \hat{x} + \alpha \, \mathbf{e}_z", ["x", "0", "alpha"]),
        (r"x \begin{bmatrix} 1 \\ 0 \\ 0 \end{bmatrix} - 2 [0, \alpha, x]^T", ["x", "-(2*alpha)", "-(2*x)"]),
        (
            r"\begin{pmatrix} 0 & -1 & 0 \\ 1 & 0 & 0 \\ 0 & 0 & 1 \end{pmatrix} \begin{pmatrix} x \\ 2 \\ \alpha \end{pmatrix}",
            ["(-1*2)", "x", "alpha"],
        ),
        (r"\hat{z} \times [x, 2, \alpha]", ["-2", "x", "0"]),
        (r"([1, x, 0] \cdot [2, 2, 2]) \, [x, 0, 0]", ["((2 + (x*2))*x)", "0", "0"]),
        (r"\frac{[x, 2, \alpha]}{2}", ["(x/2)", "(2/2)", "(alpha/2)"]),
    ] {
        let components = vector(text, &symbols).unwrap_or_else(|mistake| panic!("{text}: {mistake:?}"));
        assert_eq!(components.iter().map(shown).collect::<Vec<_>>(), said, "{text}");
    }
    for (text, place, wanted) in [
        (r"e_y = x \\ e_x = 2 \\ e_z = 0", "e_y", "named as component y"),
        (r"e_x = x \\ 2 \\ 0", "2", "a row without `=`"),
        (r"[x, 2] + [x, 2, 0]", "[x, 2] + [x, 2, 0]", "cannot be added"),
        (r"[x, 2, 0] [x, 2, 0]", "[x, 2, 0] [x, 2, 0]", "cannot be multiplied"),
        (r"x + \hat{x}", r"x + \hat{x}", "cannot be added"),
    ] {
        let Err(mistake) = vector(text, &symbols) else { panic!("{text} was read") };
        assert!(mistake.message.contains(wanted), "{text}: {}", mistake.message);
        assert_eq!(&text[mistake.place.clone()], place, "{text}: {}", mistake.message);
    }
    let components = vector(r"(x + 1) \alpha, x", &symbols).unwrap_or_default();
    assert_eq!(components.iter().map(shown).collect::<Vec<_>>(), ["((x + 1)*alpha)", "x"]);
}

/// Each text beside the part at fault and a piece of the message with its help.
#[test]
fn what_cannot_be_read_is_refused_at_its_place() {
    let cases = [
        ("", "", "the formula ends here"),
        (r"x +", "", "the formula ends here"),
        (r"\Delta\theta_{y2}^0 x", r"\Delta\theta_{y2}^0", r"did you mean `\Delta\theta_{y1}^0`?"),
        // The upper index is part of the name: without it the symbol is another one.
        (r"\Delta\theta_{y1}", r"\Delta\theta_{y1}", r"did you mean `\Delta\theta_{y1}^0`?"),
        (r"\Delta\beta_2^0", r"\Delta\beta_2^0", r"did you mean `\Delta\beta_2`?"),
        (r"\zeta", r"\zeta", "name it under [symbols]"),
        (r"\bta", r"\bta", r"did you mean `\beta`?"),
        (r"x sinn\beta", "s", r"write `\sin`"),
        (r"\sin", "", "the angle of the function"),
        (r"\sin\cos\beta", r"\cos", "put parentheses around the argument"),
        (r"\sin\beta^2", r"\beta^2", r"write `\sin^2 \beta`"),
        (r"\sin^{-1}\beta", r"^{-1}", r"\frac{1}{\sin…}"),
        (r"(x + 1", "", "where `)` should stand"),
        (r"(x + 1]", "]", "where `)` should stand"),
        (r"x)", ")", "no such bracket is open"),
        (r"x + 1 = 2", "x + 1", "the right-hand side alone"),
        (r"1 = x", "1", "the right-hand side alone"),
        (r"x = 2 = 2", "=", "two formulas"),
        (r"x \quad (6) x", r"\quad", "a wide space"),
        (r"x \quad \beta", r"\quad", "a wide space"),
        (r"x (6)", "(6)", "the number of the equation"),
        (r"x 6", "6", "an index"),
        (r"x \\[3m]", r"\\[3m]", "for a distance"),
        (r"x \\ \beta", r"\beta", "go on with `+`"),
        (r"(x \\ \beta)", r"\\", "a line ends within brackets"),
        (r"x & \beta", "&", "between two factors"),
        (r"x(\alpha)", r"x(\alpha)", "or a product?"),
        (r"x/\alpha\beta", r"\alpha\beta", "multiplied?"),
        (r"\sin\beta/2", r"\sin\beta/", "the angle divided"),
        (r"x \pm 2", r"\pm", "one claim for each sign"),
        ("x ± 2", "±", "one claim for each sign"),
        (r"\arctan x", r"\arctan", "inverse function"),
        (r"\arctan\frac{x}{2}", r"\arctan", r"`\frac{…}{…}`"),
        (r"\operatorname{atan2}(x, 2)", r"\operatorname{atan2}", "inverse function"),
        (r"{\rm atan2}(x, 2)", r"{\rm atan2}", "inverse function"),
        (r"\mathrm{Arctan} x", r"\mathrm{Arctan}", "inverse function"),
        (r"\atantwo(x, 2)", r"\atantwo", "inverse function"),
        ("arctan2(x, 2)", "arctan", "inverse function"),
        (r"\tan^{-1} x", "^{-1}", "for the inverse, claim"),
        (r"\sqrt{x}", r"\sqrt{x}", "total error"),
        (r"\sqrt{11}", r"\sqrt{11}", "2, 3, 5 and 7"),
        (r"\sqrt{-2}", r"\sqrt{-2}", "of -2 is not known"),
        (r"\sqrt[3]{2}", "[", "square roots"),
        (r"x < 2", "<", "a bound is a claim"),
        (r"x + \cdots", r"\cdots", "in full"),
        (r"\sum x", r"\sum", "write the sum out"),
        ("x $ x", "$", "without its partner"),
        ("$x$ $x$ x", "$", "between two dollars"),
        (r"\tag x", r"\tag", "without braces"),
        ("1½ x", "½", "a whole number and a fraction"),
        (
            r"\begin{bmatrix} 1 & x \\ 2 \end{bmatrix}",
            r"\begin{bmatrix} 1 & x \\ 2 \end{bmatrix}",
            "equally long",
        ),
        (r"[1, 2, 3]^T", r"[1, 2, 3]", "one amount is wanted"),
        (r"x, x", ",", "one component"),
        (r"2 3", "2 3", r"\cdot"),
        (r"1.2.3", "1.2.3", "no decimal number"),
        (r"x^\alpha", r"x^\alpha", "unknown symbol"),
        (r"x^{1.5}", "x^{1.5}", "unknown symbol"),
        (r"(x)^{1.5}", "{1.", "whole number"),
        (r"x_1_2", "_", "second index"),
        (r"x | 2", "|", "an absolute value"),
        (r"x ! 2", "!", "behind the formula"),
        (r"\frac{1}", "", "a group in braces"),
        (r"x \& 2", r"\&", "no meaning"),
        (r"x_{1", "{", "never closed"),
        ("x\\", "\\", "nothing behind it"),
    ];
    let symbols = symbols();
    for (text, place, wanted) in cases {
        let Err(mistake) = read_formula(text, &symbols) else { panic!("{text} was read") };
        let said = format!("{}; {}", mistake.message, mistake.help.as_deref().unwrap_or_default());
        assert!(said.contains(wanted), "{text}: {said}");
        assert_eq!(&text[mistake.place.clone()], place, "{text}: {said}");
    }
}

#[test]
fn symbols_that_print_alike_have_to_be_told_apart() {
    let deep = format!("{}x{}", "(".repeat(5000), ")".repeat(5000));
    let Err(mistake) = read_formula(&deep, &symbols()) else { panic!("it was read") };
    assert!(mistake.message.contains("groups within each other"), "{mistake:?}");
}

proptest::proptest! {
    /// Any text is read or refused, at a place within it.
    #[test]
    fn no_text_is_a_panic(text in r"([a-zαβΔ \\{}\[\]()^_+*/,.0-9-]|\\sin|\\frac|\\Delta|\\theta|\\begin\{a\}|\\left|\\\\){0,40}") {
        for outcome in [
            read_formula(&text, &symbols()).map(|_| ()),
            vector(&text, &symbols()).map(|_| ()),
        ] {
            if let Err(mistake) = outcome {
                proptest::prop_assert!(text.get(mistake.place.clone()).is_some(), "{:?}", mistake);
            }
        }
    }
}

#[test]
fn letters_of_other_alphabets_are_other_letters() {
    let text = r#"chain C {
        body b on ground { position_error: Rx(refraction + radius); motion: Rz(a); }
        observe o: direction(0, 1, 0) of b;
        symbol refraction = r"\mathcal{R}_0";
        symbol radius = "R_0";
    }"#;
    let chain = Chain::from_text(text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let symbols = PrintedSymbols::of_chain(&chain);
    for (text, meaning) in [
        (r"\mathcal{R}_0 - R_0", "(refraction + -radius)"),
        (r"\mathcal R_0 \cos a", "(refraction*cos(a))"),
        (r"\mathbf{R}_0", "radius"),
    ] {
        let formula = read_formula(text, &symbols).unwrap_or_else(|mistake| panic!("{text}: {mistake:?}"));
        assert_eq!(shown(&formula), meaning, "{text}");
    }
}
