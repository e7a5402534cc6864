//! A thousand mutants of true statements of every kind: what a mutant says is computed here in floating point, from a tree of
//! the test's own, and the checker may neither call a false one true nor a true one false.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod bases;
mod numbers;
mod poses;
mod programs;
#[path = "../file/support.rs"]
mod support;
mod tree;
mod truth;

use bases::{Base, bases};
use tree::{Random, mutated};

/// Mutants of each true statement.
const EACH: usize = 80;

#[test]
fn what_is_true_holds() {
    for base in bases() {
        assert!(base.is_true(&base.formula), "{}: the statement is not true", base.name);
        assert_eq!(base.verdict(&base.formula), "holds", "{}: {}", base.name, base.written(&base.formula));
    }
}

#[test]
fn no_mutant_gets_a_wrong_verdict() {
    let mut random = Random(55);
    let (mut made, mut read, mut falsified) = (0, 0, 0);
    let mut wrong = Vec::new();
    for base in bases() {
        let mut own = 0;
        for _ in 0..EACH {
            let mutant = mutated(&base.formula, &mut random, &base.letters);
            made += 1;
            let verdict = base.verdict(&mutant);
            let truth = base.is_true(&mutant);
            falsified += usize::from(!truth);
            match verdict.as_str() {
                "holds" | "differs" => own += 1,
                _ => continue,
            }
            if (verdict == "holds") != truth {
                wrong.push(format!("{} is {truth}, {verdict}: {}", base.name, base.written(&mutant)));
            }
        }
        // No kind is refused for the most part.
        assert!(own * 2 >= EACH, "{}: {own} of {EACH}", base.name);
        read += own;
    }
    assert!(wrong.is_empty(), "{} of {made}: {wrong:#?}", wrong.len());
    // Most mutants are statements at all, and most of those are false.
    assert!(made >= 1000 && read * 10 >= made * 8 && falsified * 10 >= made * 6, "{made} {read} {falsified}");
}

impl Base {
    fn verdict(&self, formula: &tree::Tree) -> String {
        support::verdict(self.chain, &self.file(formula))
    }
}
