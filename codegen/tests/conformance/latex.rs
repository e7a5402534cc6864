//! The LaTeX that a reader gets, read back by the checker's own reader and evaluated, against the interpreter.
//!
//! Every equation of a file names a value by formulas of values named before it; so reading them in order computes what
//! the file says. Derivatives that it leaves out have to be zero.

use std::collections::HashMap;

use codegen::{Form, Interpreter, Language, build};
use model_core::expr::{Expr, Node};
use model_core::latex::{PrintedSymbols, read_formula};

use crate::case::{Case, FORMS};

/// Sines and cosines differ from the interpreter's, and products of printed numbers are exact.
const ULPS: f64 = 8.0;

/// The equations of one form, left and right side, from the file's text between two headings.
fn equations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.lines().filter_map(|line| line.strip_suffix("\\\\").unwrap_or(line).trim().split_once(" &= "))
}

/// What each output is called on the left side of its equation, in the order of the program's outputs.
fn names(case: &Case, form: Form) -> Vec<String> {
    let mut names = Vec::new();
    for observable in &case.chain.observables {
        for component in ["x", "y", "z"] {
            let observed = format!("\\mathrm{{{}}}_{component}", observable.name.replace('_', "\\_"));
            match form {
                Form::ExactValue => names.push(observed),
                Form::ExactError | Form::FirstOrderError => names.push(format!("\\Delta {observed}")),
                Form::ExactJacobian | Form::FirstOrderJacobian => {
                    names.extend(case.errors().into_iter().map(|id| {
                        format!("\\partial {observed} / \\partial {}", case.chain.symbol(id).latex)
                    }))
                }
            }
        }
    }
    names
}

/// Computes every left side of a form's equations in one pose.
fn evaluate<'a>(case: &Case, text: &'a str, pose: &[f64]) -> HashMap<&'a str, f64> {
    let mut symbols = PrintedSymbols::of_chain(&case.chain);
    let mut values: HashMap<&str, f64> = HashMap::new();
    for (left, right) in equations(text) {
        let formula = read_formula(right, &symbols)
            .unwrap_or_else(|mistake| panic!("{}: {right}: {}", case.name, mistake.message));
        let resolve = |name: &str| {
            let symbol = case.chain.find_symbol(name).map(|id| pose[id.index()]);
            symbol.or_else(|| values.get(name).copied())
        };
        let value = formula.eval(&resolve).unwrap_or_else(|| panic!("{}: {right} has no value", case.name));
        if left.starts_with("t_{") || left.starts_with("p_{") {
            symbols.define(left, &Expr { node: Node::Symbol(left.to_owned()), place: () }).unwrap();
        }
        values.insert(left, value);
    }
    values
}

/// Every `\begin` has its `\end`, every brace its partner.
fn is_well_formed(text: &str) {
    let mut open = Vec::new();
    for line in text.lines().filter(|line| !line.starts_with('%')) {
        if let Some(name) = line.strip_prefix("\\begin{") {
            open.push(name);
        } else if let Some(name) = line.strip_prefix("\\end{") {
            assert_eq!(open.pop(), Some(name));
        }
        let depth = line.chars().fold(0_i32, |depth, c| depth + i32::from(c == '{') - i32::from(c == '}'));
        assert_eq!(depth, 0, "{line}");
    }
    assert!(open.is_empty(), "{open:?} are not closed");
}

#[test]
fn latex() {
    for case in Case::all() {
        let text = case.generate(Language::Latex).remove(0).text;
        is_well_formed(&text);
        if case.name == "words" {
            // It has an error called `sin`, which no reader of the page could tell from the function.
            continue;
        }
        if case.name == "readings" {
            // The reader of printed formulas knows no arc tangent of two arguments.
            continue;
        }
        let mut sections = text.split("\\paragraph{}").skip(1);
        for (form, form_name) in FORMS {
            let program = build(&case.chain, &case.observables, form, &case.errors());
            let section = sections.next().unwrap();
            let names = names(&case, form);
            let per_observable = names.len() / case.observables.len();
            let mut interpreter = Interpreter::new(&program);
            for pose in &case.poses[..2] {
                let mut expected = vec![0.0; program.outputs().len()];
                interpreter.eval(pose, &mut expected).unwrap();
                let values = evaluate(&case, section, pose);
                for (output, (name, expected_value)) in names.iter().zip(&expected).enumerate() {
                    let found = values.get(name.as_str()).copied().unwrap_or(0.0);
                    let start = output / per_observable * per_observable;
                    let same = &expected[start..start + per_observable];
                    let scale = same.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
                    assert!(
                        (found - expected_value).abs() <= ULPS * f64::EPSILON * scale,
                        "{}, {form_name}, {name}: {found:?} is not {expected_value:?}",
                        case.name
                    );
                }
            }
        }
        assert!(sections.next().is_none());
    }
}
