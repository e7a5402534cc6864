//! Mutants as lines of NumPy, MATLAB and C.

use super::bases::{Base, Kind, NAMES, bases};
use super::support;
use super::tree::Tree::{Cos, Letter, Matrix, Minus, Number, Over, Product, Sin, Sum};
use super::tree::{Random, Tree, mutated};

/// Mutants of each true statement in each language.
const EACH: usize = 40;

/// A language: what stands before a function, and what ends a line.
const LANGUAGES: [(&str, &str); 3] = [("np.", ""), ("", ";"), ("std::", ";")];

/// A number as a program has it; `None` for what is no number.
fn program(formula: &Tree, prefix: &str) -> Option<String> {
    let inner = |tree: &Tree| program(tree, prefix);
    let joined = |parts: &[Tree], sign: &str, empty: &str| {
        let parts: Vec<String> = parts.iter().map(inner).collect::<Option<_>>()?;
        Some(if parts.is_empty() { empty.to_owned() } else { format!("({})", parts.join(sign)) })
    };
    match formula {
        Number(value) if *value < 0 => Some(format!("({value})")),
        Number(value) => Some(value.to_string()),
        Letter(letter) => NAMES.iter().find(|(other, _)| other == letter).map(|(_, name)| (*name).to_owned()),
        Sin(angle) => Some(format!("{prefix}sin({})", inner(angle)?)),
        Cos(angle) => Some(format!("{prefix}cos({})", inner(angle)?)),
        Sum(parts) => joined(parts, " + ", "0"),
        Product(parts) => joined(parts, "*", "1"),
        Minus(inside) => Some(format!("(-{})", inner(inside)?)),
        Over(above, below) => Some(format!("({}/{})", inner(above)?, inner(below)?)),
        _ => None,
    }
}

/// The claims file; `None` for what is no column of numbers.
fn file(base: &Base, formula: &Tree, (prefix, end): (&str, &str)) -> Option<String> {
    let Matrix(1, entries) = formula else { return None };
    let lines: Vec<String> = ["dx", "dy", "dz"]
        .iter()
        .zip(entries)
        .map(|(name, entry)| Some(format!("'{name} = {}{end}'", program(entry, prefix)?)))
        .collect::<Option<_>>()?;
    let key = match base.kind {
        Kind::Error => "components",
        Kind::Correction => "correction",
        Kind::Shows(0) => "order = 0\nshows",
        Kind::Shows(1) => "order = 1\nshows",
        _ => return None,
    };
    Some(format!(
        "chain = \"a.chain\"\n[[claim]]\nname = \"a\"\nobservable = \"tip\"\n{key} = [{}]\n",
        lines.join(", ")
    ))
}

#[test]
fn no_line_of_a_program_gets_a_wrong_verdict() {
    let mut random = Random(83);
    let (mut made, mut read, mut falsified) = (0, 0, 0);
    let mut wrong = Vec::new();
    for base in bases() {
        for language in LANGUAGES {
            let Some(right) = file(&base, &base.formula, language) else { continue };
            assert_eq!(support::verdict(base.chain, &right), "holds", "{right}");
            for _ in 0..EACH {
                let mutant = mutated(&base.formula, &mut random, &base.letters);
                let Some(text) = file(&base, &mutant, language) else { continue };
                made += 1;
                let (verdict, truth) = (support::verdict(base.chain, &text), base.is_true(&mutant));
                falsified += usize::from(!truth);
                if !["holds", "differs"].contains(&verdict.as_str()) {
                    continue;
                }
                read += 1;
                if (verdict == "holds") != truth {
                    wrong.push(format!("{truth}, {verdict}: {text}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} of {made}: {wrong:#?}", wrong.len());
    assert!(made >= 300 && read * 10 >= made * 9 && falsified * 10 >= made * 6, "{made} {read} {falsified}");
}
