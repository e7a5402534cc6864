//! Characters as they are typed or pasted from a page: Greek letters, mathematical alphabets, raised and lowered
//! digits and letters, signs. Each becomes what LaTeX would have in its place.

/// Characters that may be typed in place of a control word.
pub(super) const TYPED: [(char, &str); 36] = [
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "varepsilon"),
    ('ϵ', "epsilon"),
    ('ζ', "zeta"),
    ('η', "eta"),
    ('θ', "theta"),
    ('ϑ', "vartheta"),
    ('ι', "iota"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('υ', "upsilon"),
    ('φ', "varphi"),
    ('ϕ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('Γ', "Gamma"),
    ('Δ', "Delta"),
    ('Θ', "Theta"),
    ('Λ', "Lambda"),
    ('Ξ', "Xi"),
    ('Φ', "Phi"),
    ('Ψ', "Psi"),
    ('Ω', "Omega"),
    ('°', "degree"),
    ('√', "sqrt"),
];

/// Raised characters and what stands above the line.
const RAISED: [(char, &str); 18] = [
    ('⁰', "0"),
    ('¹', "1"),
    ('²', "2"),
    ('³', "3"),
    ('⁴', "4"),
    ('⁵', "5"),
    ('⁶', "6"),
    ('⁷', "7"),
    ('⁸', "8"),
    ('⁹', "9"),
    ('⁻', "-"),
    ('ⁱ', "i"),
    ('ⁿ', "n"),
    ('ᵀ', "T"),
    ('ˣ', "x"),
    ('ʸ', "y"),
    ('ᶻ', "z"),
    ('ʳ', "r"),
];

/// Lowered characters and what stands below the line.
const LOWERED: [(char, &str); 32] = [
    ('₀', "0"),
    ('₁', "1"),
    ('₂', "2"),
    ('₃', "3"),
    ('₄', "4"),
    ('₅', "5"),
    ('₆', "6"),
    ('₇', "7"),
    ('₈', "8"),
    ('₉', "9"),
    ('ₐ', "a"),
    ('ₑ', "e"),
    ('ₒ', "o"),
    ('ₓ', "x"),
    ('ₕ', "h"),
    ('ₖ', "k"),
    ('ₗ', "l"),
    ('ₘ', "m"),
    ('ₙ', "n"),
    ('ₚ', "p"),
    ('ₛ', "s"),
    ('ₜ', "t"),
    ('ᵢ', "i"),
    ('ⱼ', "j"),
    ('ᵣ', "r"),
    ('ᵤ', "u"),
    ('ᵥ', "v"),
    ('ᵦ', "β"),
    ('ᵧ', "γ"),
    ('ᵨ', "ρ"),
    ('ᵩ', "φ"),
    ('ᵪ', "χ"),
];

/// Fractions typed as one character.
const FRACTIONS: [(char, char, char); 9] = [
    ('½', '1', '2'),
    ('⅓', '1', '3'),
    ('⅔', '2', '3'),
    ('¼', '1', '4'),
    ('¾', '3', '4'),
    ('⅕', '1', '5'),
    ('⅖', '2', '5'),
    ('⅙', '1', '6'),
    ('⅛', '1', '8'),
];

/// What stands above the line.
pub(super) fn raised(c: char) -> Option<&'static str> {
    RAISED.iter().find(|(typed, _)| *typed == c).map(|(_, meant)| *meant)
}

/// What stands below the line.
pub(super) fn lowered(c: char) -> Option<&'static str> {
    LOWERED.iter().find(|(typed, _)| *typed == c).map(|(_, meant)| *meant)
}

/// Numerator and denominator.
pub(super) fn fraction(c: char) -> Option<(char, char)> {
    FRACTIONS.iter().find(|(typed, ..)| *typed == c).map(|&(_, above, below)| (above, below))
}

/// The control word of a typed character.
pub(super) fn command(c: char) -> Option<&'static str> {
    TYPED.iter().find(|(typed, _)| *typed == c).map(|(_, command)| *command)
}

/// Whether a character takes no ink at all.
pub(super) fn is_invisible(c: char) -> bool {
    c.is_whitespace()
        || matches!(c, '\u{200b}'..='\u{200f}' | '\u{2060}' | '\u{2061}' | '\u{feff}' | '\u{ad}')
}

/// The plain letter or sign of a look-alike: mathematical alphabets (𝛼, 𝑥, 𝟐), ∆, µ, the many dashes and dots.
pub(super) fn normal(c: char) -> char {
    let code = u32::from(c);
    let letter = |first: char, offset: u32| char::from_u32(u32::from(first) + offset).unwrap_or(c);
    match c {
        '∆' => 'Δ',
        'µ' => 'μ',
        '\u{2126}' => 'Ω',
        'ϴ' => 'Θ',
        'ℎ' => 'h',
        '−' | '–' | '‐' | '‑' | '﹣' | '－' => '-',
        '＋' => '+',
        '·' | '⋅' | '∙' | '•' | '∗' | '\u{2062}' => '*',
        '∕' | '⁄' | '÷' => '/',
        '′' => '\'',
        '≈' | '≃' | '≅' | '≡' | '≐' | '≜' | '＝' => '=',
        // Thirteen Latin alphabets of 52 letters, five Greek ones of 58 signs, five sets of digits.
        '\u{1d400}'..='\u{1d6a3}' => match (code - 0x1d400) % 52 {
            upper @ 0..26 => letter('A', upper),
            lower => letter('a', lower - 26),
        },
        '\u{1d6a8}'..='\u{1d7c9}' => match (code - 0x1d6a8) % 58 {
            17 => 'Θ',
            upper @ 0..=24 => letter('Α', upper),
            lower @ 26..=50 => letter('α', lower - 26),
            52 => 'ϵ',
            53 => 'ϑ',
            55 => 'ϕ',
            _ => c,
        },
        '\u{1d7ce}'..='\u{1d7ff}' => letter('0', (code - 0x1d7ce) % 10),
        _ => c,
    }
}
