//! What symbols and observables are called in a language: their own names wherever those mean nothing else there.
//!
//! Names that a language reserves get an underscore, or `v_` in front. Letters that a language's compilers may fold into others (Rust
//! composes letters with their marks, Python also reads `ﬁ` as `fi`) are written by their number, so that names that
//! differ in the declaration differ in every file.

use std::collections::BTreeSet;

use model_core::{Chain, ObservableId, SymbolId};

/// How a language wants its names.
#[derive(Clone, Copy)]
pub(crate) struct Rules {
    /// Words that mean something else: they get an underscore behind.
    pub(crate) words: &'static [&'static str],
    /// Starts of names that mean something else: they get `v_` in front.
    pub(crate) starts: &'static [&'static str],
    /// Whether letters beyond ASCII may stand in a name.
    pub(crate) takes_letters: bool,
    /// Letters of a name at most, with room for underscores.
    pub(crate) longest: usize,
}

/// The names of one chain in one language.
pub(crate) struct Names {
    symbols: Vec<String>,
    observables: Vec<String>,
}

impl Names {
    pub(crate) fn new(chain: &Chain, rules: Rules) -> Self {
        Self {
            symbols: rules.allot(chain.symbols.iter().map(|symbol| symbol.name.as_str())),
            observables: rules.allot(chain.observables.iter().map(|observable| observable.name.as_str())),
        }
    }

    pub(crate) fn symbol(&self, id: SymbolId) -> &str {
        &self.symbols[id.index()]
    }

    pub(crate) fn observable(&self, id: ObservableId) -> &str {
        &self.observables[usize::from(id.0)]
    }
}

impl Rules {
    /// A name as the language takes it, which may be that of another.
    pub(crate) fn spell(self, name: &str) -> String {
        let mut text = self.letters(name);
        if text.len() > self.longest {
            text = text.chars().take(self.longest).collect();
        }
        if self.starts.iter().any(|start| text.starts_with(start)) {
            text.insert_str(0, "v_");
        }
        while self.words.contains(&text.as_str()) {
            text.push('_');
        }
        text
    }

    /// A name in letters that the language takes, to be part of another.
    pub(crate) fn letters(self, name: &str) -> String {
        let mut text = String::new();
        for letter in name.chars() {
            if letter.is_ascii_alphanumeric()
                || letter == '_'
                || (self.takes_letters && stays_as_it_is(letter))
            {
                text.push(letter);
            } else {
                text.push_str(&format!("u{:x}_", u32::from(letter)));
            }
        }
        text
    }

    /// One name for each, no two the same: names that need no change keep theirs.
    fn allot<'a>(self, names: impl Iterator<Item = &'a str>) -> Vec<String> {
        let names: Vec<&str> = names.collect();
        let mut taken: BTreeSet<String> =
            names.iter().filter(|name| self.spell(name) == **name).map(|&name| name.to_owned()).collect();
        names
            .into_iter()
            .map(|name| {
                let mut spelt = self.spell(name);
                if spelt != name {
                    while taken.contains(&spelt) || self.words.contains(&spelt.as_str()) {
                        spelt.push('_');
                    }
                    taken.insert(spelt.clone());
                }
                spelt
            })
            .collect()
    }
}

/// Letters that no normal form of Unicode changes or joins with others: Latin with accents, Greek, Cyrillic.
fn stays_as_it_is(letter: char) -> bool {
    matches!(letter, 'À'..='Ö' | 'Ø'..='ö' | 'ø'..='ÿ' | 'Α'..='Ω' | 'α'..='ω' | 'А'..='я')
}

/// A name in words of another case: `MobileLidar` as `mobile_lidar`, `UR10` as `ur10`.
#[must_use]
pub fn snake_case(name: &str) -> String {
    let mut snake = String::new();
    let mut after_lower = false;
    for letter in name.chars() {
        if letter.is_uppercase() && after_lower {
            snake.push('_');
        }
        after_lower = letter.is_lowercase() || letter.is_ascii_digit();
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// `first_order_error` as `FirstOrderError`.
pub(crate) fn camel_case(name: &str) -> String {
    name.split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            letters.next().map(|first| first.to_uppercase().chain(letters).collect::<String>())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: Rules = Rules { words: &["class"], starts: &["__"], takes_letters: true, longest: 12 };

    #[test]
    fn names_stay_apart() {
        let names = ["class", "class_", "é", "e\u{301}", "eu301_", "ﬁ", "fi", "readout", "__x", "v___x"];
        let spelt = RULES.allot(names.into_iter());
        let expected =
            ["class__", "class_", "é", "eu301__", "eu301_", "ufb01_", "fi", "readout", "v___x_", "v___x"];
        assert_eq!(spelt, expected);
    }

    #[test]
    fn long_names_are_cut_and_stay_apart() {
        let names = ["a_long_name_one", "a_long_name_", "a_long_name_two"];
        assert_eq!(RULES.allot(names.into_iter()), ["a_long_name__", "a_long_name_", "a_long_name___"]);
    }

    #[test]
    fn capitals_start_words_after_small_letters() {
        for (name, snake) in [("MobileLidar", "mobile_lidar"), ("UR10", "ur10"), ("SixDOFArm", "six_dofarm")]
        {
            assert_eq!(snake_case(name), snake);
        }
    }
}
