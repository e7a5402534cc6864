//! What print sets around a formula leaves its reading as it is, whatever the formula.

use proptest::prelude::*;

use super::tests::{shown, symbols};
use super::*;
use model_core::Chain;

fn reading(text: &str) -> Result<String, String> {
    read_formula(text, &symbols())
        .map(|formula| shown(&formula))
        .map_err(|mistake| format!("{text}: {mistake:?}"))
}

/// A factor, as LaTeX and as it may be typed or pasted.
fn factor() -> impl Strategy<Value = (String, String)> {
    prop_oneof![
        Just((r"\Delta\theta_{y1}^0", "Δθ⁰_{y1}")),
        Just((r"\delta_{x2}^1", "δ¹ₓ₂")),
        Just((r"\cos \alpha", "cos α")),
        Just((r"\sin^2 \beta", "sin² β")),
        Just((r"\sin 2\beta", r"{\rm sin} 2β")),
        Just((r"\cos(\alpha - \beta)", r"\operatorname{cos}\bigl(α − β\bigr)")),
        Just((r"\frac{1}{2}", r"\tfrac12")),
        Just((r"\frac{x}{\cos\beta}", r"\cfrac{x}{cos β}")),
        Just((r"(x + \alpha)", r"\left( 𝑥 \right. \\ \left. + α \right)")),
        Just((r"\sqrt{2}", "√2")),
        Just(("x", r"\mathit{x}")),
    ]
    .prop_map(|(latex, typed)| (latex.to_owned(), typed.to_owned()))
}

/// A formula in LaTeX; the same typed; and with its lines broken before operators.
fn formula() -> impl Strategy<Value = [String; 3]> {
    let term = (any::<bool>(), proptest::collection::vec(factor(), 1..4));
    proptest::collection::vec(term, 1..5).prop_map(|terms| {
        let mut texts = [String::new(), String::new(), String::new()];
        for (index, (negative, factors)) in terms.into_iter().enumerate() {
            let sign = match (index, negative) {
                (0, false) => "",
                (_, false) => " + ",
                (_, true) => " - ",
            };
            let latex: Vec<&str> = factors.iter().map(|(latex, _)| latex.as_str()).collect();
            let typed: Vec<&str> = factors.iter().map(|(_, typed)| typed.as_str()).collect();
            let breaks = if index == 0 { "" } else { "\\\\[2pt]\n&\\quad" };
            texts[0] += &format!("{sign}{}", latex.join(" "));
            texts[1] += &format!("{sign}{}", typed.join(r"\,"));
            texts[2] += &format!("{breaks}{sign}{}", latex.join("~"));
        }
        texts
    })
}

const AROUND: [(&str, &str); 22] = [
    ("", "."),
    ("", " ,"),
    ("", ";"),
    ("", r"\quad (6)"),
    ("", r" , \qquad (A.12b)"),
    ("", r"\hfill (3-1)"),
    ("", r"\tag{6}"),
    ("", r"\tag*{$\ast$} \label{eq:six}"),
    ("", r"\notag"),
    ("", r"\nonumber \\"),
    ("", r" \\[-2pt]"),
    ("", r" \\*[1.5ex]"),
    ("$", "$"),
    ("$$ ", ". $$ (6)"),
    (r"\[", r"\]"),
    (r"\(", r"\)."),
    (r"\begin{equation} ", r" \label{six} \end{equation}"),
    (r"\begin{align*} \Delta x &= ", r" . \end{align*}"),
    (r"e_{x} = ", ""),
    (r"\Delta r(\alpha, \beta) \approx ", ""),
    ("% as printed\n\u{200b}", "\u{a0}\n"),
    (r"\displaystyle \boxed{", "}"),
];

proptest! {
    #[test]
    fn decoration_leaves_the_reading_as_it_is([latex, typed, broken] in formula(), outer in 0..AROUND.len(), inner in 0..12usize) {
        let plain = reading(&latex).map_err(TestCaseError::fail)?;
        let (before, after) = AROUND[outer];
        // What stands behind a formula may stand within what stands around it.
        let behind = AROUND[inner].1;
        for text in [&latex, &typed, &broken] {
            let mut decorated = vec![format!("{before}{text}{after}")];
            if before.starts_with(r"\begin") || before == "$" {
                decorated.push(format!("{before}{text}{behind}{after}"));
            }
            for decorated in decorated {
                let found = reading(&decorated).map_err(TestCaseError::fail)?;
                // A box, and brackets around a broken sum, are groups; groups do not show.
                prop_assert_eq!(&found, &plain, "{}", decorated);
            }
        }
    }

    /// A mark that no formula has makes any formula unreadable, wherever it stands.
    #[test]
    fn what_is_not_understood_is_an_error([latex, ..] in formula(), at in 0.0..1.0f64, mark in 0..12usize) {
        let mark = [r"\pm", r"\cdots", r"\arctan", "!", "?", "|", "<", r"\sum", r"\foo", r"\\[3m]", "@", r"\ln"][mark];
        // Between two factors or behind an operator: at a blank outside of commands and braces.
        let blanks: Vec<usize> = latex
            .match_indices(' ')
            .map(|(at, _)| at)
            .filter(|&at| latex[..at].matches(['{', '(']).count() == latex[..at].matches(['}', ')']).count())
            .collect();
        let place = blanks.get((at * blanks.len() as f64) as usize).copied().unwrap_or(latex.len());
        let text = format!("{} {mark} {}", &latex[..place], &latex[place..]);
        prop_assert!(read_formula(&text, &symbols()).is_err(), "{}", text);
    }
}

/// Errors of a machine tool, each a function of its own axis.
#[test]
fn an_error_is_read_with_its_joint_behind_it() {
    let chain = Chain::from_text(
        "chain Machine {
            body table on ground { motion: Tx(x); motion_error: Tx(exx), Ty(eyx), Rz(ecx); }
            body ram on table { position_error: Rz(square); motion: Ty(y); motion_error: Tx(exy); }
            body tool on ram { position_error: Tx(mount); }
            const arm: length = 1;
            observe tip: point(0, arm, 0) of tool;
            symbol exx = r\"\\delta_x(x)\";
            symbol exy = r\"\\delta_x(y)\";
            symbol eyx = r\"\\delta_y\";
        }",
    )
    .unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let symbols = PrintedSymbols::of_chain(&chain);
    for (text, said) in [
        (r"\delta_x(x) + \delta_{x}\left(y\right)", "(exx + exy)"),
        (r"\delta_y(x) \, y", "(eyx*y)"),
        (r"\delta_y y", "(eyx*y)"),
        (r"\mathrm{square}(y)", "square"),
        (r"\mathrm{mount}(y) \delta_y(x)", "(mount*eyx)"),
        (r"y\,(x + \mathrm{arm})", "(y*(x + arm))"),
        (r"\delta_y(\mathrm{arm})", "(eyx*arm)"),
    ] {
        let found = read_formula(text, &symbols).map(|formula| shown(&formula));
        assert_eq!(found.map_err(|mistake| mistake.message), Ok(said.to_owned()), "{text}");
    }
    for (text, wanted) in [
        (r"\delta_y(y)", "`eyx` is no function of y: its body is moved by x"),
        (r"\delta_x(z)", r"unknown symbol `\delta_x(z)`"),
        (r"\delta_x", "unknown symbol"),
        (r"y(x)", "`y` as a function, or a product?"),
        (r"\mathrm{arm}(x)", "`arm` as a function, or a product?"),
        ("arm y", "in LaTeX the letters of `arm` are symbols of their own"),
    ] {
        let Err(mistake) = read_formula(text, &symbols) else { panic!("{text} was read") };
        assert!(mistake.message.contains(wanted), "{text}: {}", mistake.message);
    }
}
