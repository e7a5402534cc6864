//! Printed symbols in plain letters, for pictures: `\Delta\theta_{y1}^0` as `Δθ_y1⁰`.

/// Greek letters that symbols are printed with.
const GREEK: [(&str, char); 31] = [
    ("alpha", 'α'),
    ("beta", 'β'),
    ("gamma", 'γ'),
    ("delta", 'δ'),
    ("epsilon", 'ε'),
    ("varepsilon", 'ε'),
    ("zeta", 'ζ'),
    ("eta", 'η'),
    ("theta", 'θ'),
    ("iota", 'ι'),
    ("kappa", 'κ'),
    ("lambda", 'λ'),
    ("mu", 'μ'),
    ("nu", 'ν'),
    ("xi", 'ξ'),
    ("rho", 'ρ'),
    ("sigma", 'σ'),
    ("tau", 'τ'),
    ("phi", 'φ'),
    ("varphi", 'φ'),
    ("chi", 'χ'),
    ("psi", 'ψ'),
    ("omega", 'ω'),
    ("Gamma", 'Γ'),
    ("Delta", 'Δ'),
    ("Theta", 'Θ'),
    ("Lambda", 'Λ'),
    ("Sigma", 'Σ'),
    ("Phi", 'Φ'),
    ("Psi", 'Ψ'),
    ("Omega", 'Ω'),
];
const LOWERED: [char; 10] = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// The letters of a symbol in LaTeX. Indices of digits alone are lowered or raised; others stay behind `_` or `^`.
#[must_use]
pub fn plain(latex: &str) -> String {
    let mut text = String::new();
    let mut rest = latex;
    while let Some(first) = rest.chars().next() {
        rest = &rest[first.len_utf8()..];
        match first {
            '\\' => {
                let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
                let (word, behind) = rest.split_at(end);
                match GREEK.iter().find(|(name, _)| *name == word) {
                    Some((_, letter)) => text.push(*letter),
                    // `\mathrm{tilt}` is `tilt`, and so is `\text{tilt}`.
                    None if behind.starts_with('{') => {}
                    None => text.push_str(word),
                }
                rest = behind;
            }
            '_' | '^' => {
                let (index, behind) = group(rest);
                rest = behind;
                let index = plain(index);
                let digits: Option<Vec<u32>> = index.chars().map(|c| c.to_digit(10)).collect();
                let letters = if first == '_' { LOWERED } else { RAISED };
                match digits {
                    Some(digits) => text.extend(digits.into_iter().map(|digit| letters[digit as usize])),
                    None => {
                        text.push(first);
                        text.push_str(&index);
                    }
                }
            }
            '{' | '}' => {}
            c if c.is_whitespace() => {}
            c => text.push(c),
        }
    }
    text
}

/// What stands first, in braces or as one letter, and what is behind it.
fn group(text: &str) -> (&str, &str) {
    let Some(inside) = text.strip_prefix('{') else {
        return text.split_at(text.chars().next().map_or(0, char::len_utf8));
    };
    let mut depth = 1;
    for (at, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return (&inside[..at], &inside[at + 1..]);
        }
    }
    (inside, "")
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn symbols_are_letters() {
        for (latex, letters) in [
            (r"\Delta\theta_{y1}^0", "Δθ_y1⁰"),
            (r"\Delta\beta_2", "Δβ₂"),
            (r"\delta_{x2}^1", "δ_x2¹"),
            (r"\mathrm{tilt}_{\mathrm{north}}", "tilt_north"),
            (r"\text{e_1}", "e₁"),
            ("P_{12}", "P₁₂"),
            (r"\foo x", "foox"),
            ("a_", "a"),
            ("a_{b", "a_b"),
            ("日_{é}", "日_é"),
        ] {
            assert_eq!(plain(latex), letters, "{latex}");
        }
    }
}
