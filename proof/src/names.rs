//! Names in a certificate: those of the declaration wherever Coq lets them stand, otherwise the nearest that it does.

use std::collections::BTreeSet;

use super::LIBRARY;

/// Words of Coq's language (which of them are no names, its parser was asked) and of its libraries that the text of a certificate
/// uses.
const WORDS: &str = "Axiom CoFixpoint Eval Fixpoint Parameter Variable as at cofix do else end exists exists2 fix for forall fun if IF in let match mod Prop return Set SProp \
    then Type using where with by Definition Lemma Theorem Proof Qed Section End Module Variables Hypothesis Ltac From \
    Require Import Print Assumptions R PI sin cos tan atan pow sqrt list nil cons hd tl app length fst snd eq_refl f_equal \
    cos_plus sin_plus cos_neg sin_neg cos_PI2 sin_PI2 cos_PI sin_PI cos_0 sin_0 PI_RGT_0 PI_4 Rmult_1_l Rinv INR IZR \
    X Y Z V x y z t Plus Minus conj symmetry Rot Tr Rx Ry Rz Tx Ty Tz Point Direction S O I True False";

/// Words that the text of a certificate gives a meaning to.
const OWN: &str = "instrument vector printed derived claim holds differs there same_chain is_derived for_all size x_of_formula \
    y_of_formula z_of_formula first_formula second_formula x_differs y_differs z_differs seen is_seen designed within C0 C1 C2 C E H D P Q";
/// Beginnings of such words, before a number or a name.
const OWN_BEGINNINGS: [&str; 12] = [
    "from_", "step_", "cos_of_", "sin_of_", "body_", "at_", "defined_", "angle_", "cosine_", "sine_",
    "printed_", "derived_",
];

/// Which names are taken.
#[derive(Debug, Clone)]
pub(super) struct Names {
    taken: BTreeSet<String>,
}

impl Names {
    /// The names that the library and Coq's language have taken.
    pub(super) fn new() -> Self {
        let mut taken: BTreeSet<String> =
            WORDS.split_whitespace().chain(OWN.split_whitespace()).map(str::to_owned).collect();
        let mut words = LIBRARY.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '\'');
        while let Some(word) = words.next() {
            if matches!(
                word,
                "Lemma" | "Theorem" | "Definition" | "Fixpoint" | "Inductive" | "Record" | "Ltac"
            ) {
                taken.extend(words.next().map(str::to_owned));
            }
        }
        Self { taken }
    }

    /// A name that nothing else has.
    pub(super) fn give(&mut self, wanted: &str) -> String {
        let mut name = identifier(wanted);
        let clashes = |name: &str| OWN_BEGINNINGS.iter().any(|beginning| name.starts_with(beginning));
        while self.taken.contains(&name) || (clashes(&name) && !name.ends_with('\'')) {
            name.push('\'');
        }
        self.taken.insert(name.clone());
        name
    }

    /// A name of our own making, which begins with one of our beginnings.
    pub(super) fn give_own(&mut self, beginning: &str, wanted: &str) -> String {
        let mut name = identifier(&format!("{beginning}{wanted}"));
        while self.taken.contains(&name) {
            name.push('\'');
        }
        self.taken.insert(name.clone());
        name
    }
}

/// A text as one word that Coq reads as a name.
fn identifier(text: &str) -> String {
    let mut name = String::new();
    for c in text.chars() {
        // Coq reads letters of the Latin and Greek alphabets; of others not all.
        let is_read =
            c.is_ascii_alphanumeric() || c == '_' || ('α'..='ω').contains(&c) || ('Α'..='Ω').contains(&c);
        if is_read {
            name.push(c);
        } else if c.is_alphanumeric() {
            name.push_str(&format!("u{:x}", u32::from(c)));
        } else if !name.ends_with('_') {
            name.push('_');
        }
    }
    let name = name.trim_end_matches('_');
    if name.starts_with(|c: char| c.is_alphabetic()) { name.to_owned() } else { format!("n{name}") }
}
