//! The LaTeX that a reader gets, read back by the checker's own reader and evaluated, against the interpreter.
//!
//! Every equation of a file names a value by formulas of values named before it; so reading them in order computes what
//! the file says. Derivatives that it leaves out have to be zero.

use std::collections::HashMap;

use claims::latex::{PrintedSymbols, read_formula};
use codegen::{Form, Interpreter, Language, build};
use model_core::expr::{Expr, Node};

use crate::case::{Case, FORMS};

/// Sines and cosines differ from the interpreter's, and products of printed numbers are exact.
const ULPS: f64 = 8.0;

/// The equations of one form, left and right side, from the file's text between two headings.
fn equations(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.lines().filter_map(|line| line.strip_suffix("\\\\").unwrap_or(line).trim().split_once(" &= "))
}

/// What each output is called on the left side of its equation, for each observable in the order of the program's outputs.
fn names(case: &Case, form: Form) -> Vec<Vec<String>> {
    let names = case.chain.observables.iter().map(|observable| {
        let mut names = Vec::new();
        for label in observable.labels() {
            let label = match label {
                "x" | "y" | "z" => label.to_owned(),
                word => format!("{{\\text{{{}}}}}", word.replace('_', " ")),
            };
            let observed = format!("\\mathrm{{{}}}_{label}", observable.name.replace('_', "\\_"));
            match form {
                Form::ExactValue => names.push(observed),
                Form::ExactError | Form::FirstOrderError => names.push(format!("\\Delta {observed}")),
                Form::Uncertainty => names.push(format!("u({observed})")),
                Form::ExactJacobian | Form::FirstOrderJacobian => {
                    names.extend(case.errors().into_iter().map(|id| {
                        format!("\\partial {observed} / \\partial {}", case.chain.symbol(id).latex)
                    }))
                }
            }
        }
        names
    });
    names.collect()
}

/// Arc tangents of two arguments and roots of amounts, which formulas for errors do not have and their reader does not know:
/// what such a call is of, innermost first, as `(beginning, end, function, arguments)`.
fn call(text: &str) -> Option<(usize, usize, &str, Vec<&str>)> {
    let starts =
        ["\\operatorname{atan2}(", "\\sqrt{"].map(|function| text.rfind(function).map(|at| (at, function)));
    let (begin, function) = starts.into_iter().flatten().max()?;
    let open = begin + function.len();
    let (mut depth, mut commas, mut end) = (1, Vec::new(), open);
    for (at, c) in text[open..].char_indices() {
        // A thin space is no comma.
        let is_space = text[..open + at].ends_with('\\');
        match c {
            '(' | '{' => depth += 1,
            ')' | '}' => depth -= 1,
            ',' if depth == 1 && !is_space => commas.push(open + at),
            _ => {}
        }
        if depth == 0 {
            end = open + at;
            break;
        }
    }
    let mut arguments = Vec::new();
    let mut from = open;
    for to in commas.into_iter().chain([end]) {
        arguments.push(text[from..to].trim());
        from = to + 1;
    }
    Some((begin, end + 1, function, arguments))
}

/// Computes every left side of a form's equations in one pose.
fn evaluate<'a>(case: &Case, text: &'a str, pose: &[f64]) -> HashMap<&'a str, f64> {
    let mut symbols = PrintedSymbols::of_chain(&case.chain);
    let mut values: HashMap<&str, f64> = HashMap::new();
    let mut called: HashMap<String, f64> = HashMap::new();
    for (left, right) in equations(text) {
        let evaluated = |text: &str, symbols: &PrintedSymbols, called: &HashMap<String, f64>| {
            let formula = read_formula(text, symbols)
                .unwrap_or_else(|mistake| panic!("{}: {text}: {}", case.name, mistake.message));
            let resolve = |name: &str| {
                let symbol = case.chain.find_symbol(name).map(|id| pose[id.index()]);
                symbol.or_else(|| values.get(name).copied()).or_else(|| called.get(name).copied())
            };
            formula.eval(&resolve).unwrap_or_else(|| panic!("{}: {text} has no value", case.name))
        };
        let mut right = right.to_owned();
        while let Some((begin, end, function, arguments)) = call(&right) {
            let numbers: Vec<f64> = arguments.iter().map(|text| evaluated(text, &symbols, &called)).collect();
            let value = match (function, numbers.as_slice()) {
                ("\\sqrt{", &[a]) => a.sqrt(),
                (_, &[y, x]) => y.atan2(x),
                _ => panic!("{}: {right}: {function} of {arguments:?}", case.name),
            };
            let name = format!("u_{{{}}}", called.len());
            symbols.define(&name, &Expr { node: Node::Symbol(name.clone()), place: () }).unwrap();
            right.replace_range(begin..end, &name);
            called.insert(name, value);
        }
        let value = evaluated(&right, &symbols, &called);
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
        let mut sections = text.split("\\paragraph{}").skip(1);
        for (form, form_name) in FORMS {
            let program = build(&case.chain, &case.observables, form, &case.errors());
            let section = sections.next().unwrap();
            let names = names(&case, form);
            let mut interpreter = Interpreter::new(&program);
            for pose in &case.poses[..2] {
                let mut expected = vec![0.0; program.outputs().len()];
                interpreter.eval(pose, &mut expected).unwrap();
                let values = evaluate(&case, section, pose);
                let mut rest = expected.as_slice();
                for names in &names {
                    let (same, others) = rest.split_at(names.len());
                    rest = others;
                    let scale = same.iter().fold(0.0_f64, |scale, value| scale.max(value.abs()));
                    for (name, expected_value) in names.iter().zip(same) {
                        let found = values.get(name.as_str()).copied().unwrap_or(0.0);
                        assert!(
                            (found - expected_value).abs() <= ULPS * f64::EPSILON * scale,
                            "{}, {form_name}, {name}: {found:?} is not {expected_value:?}",
                            case.name
                        );
                    }
                }
                assert!(rest.is_empty());
            }
        }
        assert!(sections.next().is_none());
    }
}
