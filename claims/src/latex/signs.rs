//! What control words look like: the characters of letters, relations and operators, and the accents.

use super::typed::TYPED;

/// Letters that nobody types, and signs.
const SIGNS: [(&str, &str); 76] = [
    ("varphi", "φ"),
    ("phi", "ϕ"),
    ("varrho", "ϱ"),
    ("varsigma", "ς"),
    ("varpi", "ϖ"),
    ("Sigma", "Σ"),
    ("Pi", "Π"),
    ("Upsilon", "Υ"),
    ("ell", "ℓ"),
    ("hbar", "ℏ"),
    ("imath", "ı"),
    ("jmath", "ȷ"),
    ("Re", "ℜ"),
    ("Im", "ℑ"),
    ("infty", "∞"),
    ("partial", "∂"),
    ("nabla", "∇"),
    ("prime", "′"),
    ("circ", "∘"),
    ("degree", "°"),
    ("textdegree", "°"),
    ("top", "⊤"),
    ("intercal", "⊺"),
    ("bot", "⊥"),
    ("perp", "⊥"),
    ("parallel", "∥"),
    ("angle", "∠"),
    ("star", "⋆"),
    ("ast", "∗"),
    ("dagger", "†"),
    ("cdot", "·"),
    ("bullet", "∙"),
    ("times", "×"),
    ("div", "÷"),
    ("odot", "⊙"),
    ("oplus", "⊕"),
    ("otimes", "⊗"),
    ("wedge", "∧"),
    ("vee", "∨"),
    ("pm", "±"),
    ("mp", "∓"),
    ("approx", "≈"),
    ("simeq", "≃"),
    ("cong", "≅"),
    ("equiv", "≡"),
    ("doteq", "≐"),
    ("triangleq", "≜"),
    ("eqsim", "≂"),
    ("coloneqq", "≔"),
    ("approxeq", "≊"),
    ("sim", "∼"),
    ("propto", "∝"),
    ("le", "≤"),
    ("leq", "≤"),
    ("leqslant", "⩽"),
    ("ge", "≥"),
    ("geq", "≥"),
    ("geqslant", "⩾"),
    ("ll", "≪"),
    ("gg", "≫"),
    ("lt", "<"),
    ("gt", ">"),
    ("lesssim", "≲"),
    ("gtrsim", "≳"),
    ("ne", "≠"),
    ("neq", "≠"),
    ("in", "∈"),
    ("to", "→"),
    ("rightarrow", "→"),
    ("Rightarrow", "⇒"),
    ("cdots", "⋯"),
    ("ldots", "…"),
    ("dots", "…"),
    ("vdots", "⋮"),
    ("ddots", "⋱"),
    ("mid", "∣"),
];

/// Accents: what stands above the letter.
const ACCENTS: [(&str, &str); 11] = [
    ("hat", "^"),
    ("widehat", "^"),
    ("bar", "¯"),
    ("overline", "¯"),
    ("tilde", "~"),
    ("widetilde", "~"),
    ("dot", "˙"),
    ("ddot", "¨"),
    ("vec", "→"),
    ("check", "ˇ"),
    ("breve", "˘"),
];

fn find(table: &'static [(&str, &str)], command: &str) -> Option<&'static str> {
    table.iter().find(|(name, _)| *name == command).map(|(_, sign)| *sign)
}

/// The character of a control word that is a letter or a sign, and whether it is a letter.
pub(super) fn sign(command: &str) -> Option<(String, bool)> {
    if let Some(sign) = find(&SIGNS, command) {
        return Some((sign.to_owned(), sign.chars().all(char::is_alphabetic)));
    }
    let typed = TYPED.iter().find(|(letter, name)| *name == command && letter.is_alphabetic());
    typed.map(|(letter, _)| (letter.to_string(), true))
}

/// What an accent sets above its letter.
pub(super) fn accent(command: &str) -> Option<&'static str> {
    find(&ACCENTS, command)
}

/// Where the bold letters of an alphabet begin, for its first letter: Latin and Greek, capital and small.
const BOLD: [(char, char, u32); 4] =
    [('A', 'Z', 0x1D400), ('a', 'z', 0x1D41A), ('Α', 'Ω', 0x1D6A8), ('α', 'ω', 0x1D6C2)];

/// A letter in bold type.
pub(super) fn bold(letter: char) -> char {
    let alphabet = BOLD.iter().find(|(first, last, _)| (*first..=*last).contains(&letter));
    let moved = alphabet.map(|(first, _, start)| start + (letter as u32 - *first as u32));
    moved.and_then(char::from_u32).unwrap_or(letter)
}
