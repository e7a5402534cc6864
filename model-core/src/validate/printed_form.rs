//! The printed form that a name has without a `symbol` statement.

/// The Greek letters that have a command in LaTeX.
const GREEK: [&str; 24] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu",
    "nu", "xi", "omicron", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega",
];

/// The LaTeX of a name: `delta_x2` is `\delta_{x2}`, `dtheta_y1` is `\Delta\theta_{y1}`, `dx1` is `\Delta x_{1}`,
/// `sag` is `\mathrm{sag}`.
///
/// The part before the first underscore is the letter; its digits and what follows the underscore are the
/// subscript. A leading `d` before a Greek letter, or before one letter with digits, is a small difference Δ.
pub fn latex(name: &str) -> String {
    let (head, tail) = name.split_once('_').unwrap_or((name, ""));
    let letters = head.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &head[letters.len()..];
    let subscript = [digits, tail].concat().replace('_', ",");
    let base = match letters.strip_prefix('d') {
        Some(rest) if is_greek(rest) => format!("\\Delta{}", letter(rest)),
        Some(rest) if rest.chars().count() == 1 && !subscript.is_empty() => format!("\\Delta {rest}"),
        _ => letter(letters),
    };
    if subscript.is_empty() { base } else { format!("{base}_{{{subscript}}}") }
}

fn is_greek(letters: &str) -> bool {
    GREEK.contains(&letters.to_ascii_lowercase().as_str())
}

/// One letter as it is, a Greek one by its command, a word upright.
fn letter(letters: &str) -> String {
    match letters {
        // LaTeX has no command for this letter, which looks like a Latin o.
        "omicron" => "o".to_owned(),
        _ if GREEK.contains(&letters) => format!("\\{letters}"),
        _ if letters.chars().count() == 1 => letters.to_owned(),
        _ => format!("\\mathrm{{{letters}}}"),
    }
}

#[cfg(test)]
mod tests {
    use super::latex;

    #[test]
    fn names_print_as_a_paper_would() {
        for (name, printed) in [
            ("delta_x2", r"\delta_{x2}"),
            ("dtheta_y1", r"\Delta\theta_{y1}"),
            ("dx1", r"\Delta x_{1}"),
            ("alpha", r"\alpha"),
            ("alpha2", r"\alpha_{2}"),
            ("a2", "a_{2}"),
            ("sag", r"\mathrm{sag}"),
            ("d", "d"),
            ("dx", r"\mathrm{dx}"),
            ("tube_sag_el", r"\mathrm{tube}_{sag,el}"),
        ] {
            assert_eq!(latex(name), printed);
        }
    }
}
