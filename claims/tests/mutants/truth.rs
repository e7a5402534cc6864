//! What statements say as claims files, and whether they are true: the exact form in floating point.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use model_core::{Chain, SymbolKind, exact};

use super::bases::{Base, Kind, NAMES};
use super::tree::{Random, Tree, Value};

impl Base {
    /// The LaTeX of a formula.
    pub fn written(&self, formula: &Tree) -> String {
        formula.latex()
    }

    /// The claims file.
    pub fn file(&self, formula: &Tree) -> String {
        let mut file = String::new();
        if !self.chain.is_empty() {
            file += "chain = \"a.chain\"\nrotations = \"vectors\"\n[symbols]\n";
            for (letter, name) in NAMES {
                if self.chain.contains(&format!("({name}")) || self.chain.contains(&format!(" {name}")) {
                    let _ = writeln!(file, "'{letter}' = \"{name}\"");
                }
            }
            if matches!(self.kind, Kind::Image) {
                file = file.replace("'X'", "'l_1' = \"2\"\n'X'");
            }
        }
        file += "[[claim]]\nname = \"a\"\n";
        let text = formula.latex();
        let of = if self.chain.is_empty() { "" } else { "observable = \"tip\"\n" };
        file += &match self.kind {
            Kind::Error => format!("{of}components = '''{text}'''\n"),
            Kind::Correction => format!("{of}correction = '''{text}'''\n"),
            Kind::Shows(order) => format!("{of}order = {order}\nshows = '''{text}'''\n"),
            Kind::Frame(order, _) => format!("body = \"fore\"\norder = {order}\nframe = '''{text}'''\n"),
            Kind::Jacobian => format!("{of}by = [\"q1\", \"q2\"]\njacobian = '''{text}'''\n"),
            Kind::Image => format!("{of}camera = {{ focal = \"2\" }}\nimage = '''{text}'''\n"),
            Kind::Equal(other) => format!("equal = ['''{text}''', '''{}''']\n", other().latex()),
        };
        file
    }

    /// Whether a formula says what the exact form says, at poses of no meaning.
    pub fn is_true(&self, formula: &Tree) -> bool {
        let mut random = Random(7);
        (0..6).all(|_| self.is_true_at(formula, &mut random))
    }

    fn is_true_at(&self, formula: &Tree, random: &mut Random) -> bool {
        let mut number = || 0.3 + random.below(1000) as f64 / 800.0;
        let mut values: BTreeMap<&str, f64> = NAMES.iter().map(|(letter, _)| (*letter, number())).collect();
        if let Kind::Equal(other) = self.kind {
            let value = |tree: &Tree| tree.value(&values);
            return same(value(formula), value(&other()));
        }
        let chain = Chain::from_text(self.chain).unwrap();
        if matches!(self.kind, Kind::Image) {
            values.insert("l_1", 2.0);
        } else {
            values.extend([("l_1", 0.5), ("l_2", 0.3)]);
        }
        let is_error =
            |name: &str| chain.find_symbol(name).is_some_and(|id| chain.symbol(id).kind == SymbolKind::Error);
        // Errors scaled by s, in the formula and in the chain.
        let scaled = |s: f64| {
            let letters: BTreeMap<&str, f64> = NAMES
                .iter()
                .map(|(letter, name)| {
                    (*letter, if is_error(name) { s * values[letter] } else { values[letter] })
                })
                .collect();
            let mut numbers = chain.nominal_values();
            for (letter, name) in NAMES {
                if let Some(id) = chain.find_symbol(name)
                    && chain.symbol(id).kind != SymbolKind::Constant
                {
                    numbers[id.index()] = letters[letter];
                }
            }
            (letters, numbers)
        };
        let shown = |observable: &str, numbers: &[f64]| {
            exact::Path::new(&chain, chain.find_observable(observable).unwrap()).shown(numbers)
        };
        let printed = |s: f64| formula.value(&scaled(s).0);
        const STEP: f64 = 1e-4;
        // Value and slope at no errors: a formula to first order has both right.
        let first = |f: &dyn Fn(f64) -> Option<Value>| -> Option<(Value, Value)> {
            let (Value(rows, columns, up), Value(_, _, down), at) = (f(STEP)?, f(-STEP)?, f(0.0)?);
            let slope = up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * STEP)).collect();
            Some((at, Value(rows, columns, slope)))
        };
        let tip = |s: f64| Some(Value(3, 1, shown("tip", &scaled(s).1)));
        let frame = |s: f64, is_homogeneous: bool| {
            let numbers = scaled(s).1;
            let mut columns: Vec<Vec<f64>> =
                ["ex", "ey", "ez"].iter().map(|name| shown(name, &numbers)).collect();
            if is_homogeneous {
                columns.push(shown("tip", &numbers));
            }
            let width = columns.len();
            let mut entries: Vec<f64> =
                (0..3).flat_map(|row| columns.iter().map(move |column| column[row])).collect();
            if is_homogeneous {
                entries.extend([0.0, 0.0, 0.0, 1.0]);
            }
            Some(Value(width, width, entries))
        };
        let both = |f: &dyn Fn(f64) -> Option<Value>, order: u32| {
            let (Some((at, slope)), Some((said, said_slope))) = (first(f), first(&printed)) else {
                return false;
            };
            same(Some(at), Some(said))
                && (order == 0 && same(Some(Value(1, 1, vec![0.0])), Some(flat(&said_slope)))
                    || order > 0 && same(Some(slope), Some(said_slope)))
        };
        match self.kind {
            Kind::Error | Kind::Correction => {
                let sign = if matches!(self.kind, Kind::Error) { 1.0 } else { -1.0 };
                let nominal = tip(0.0).unwrap();
                let error = |s: f64| {
                    let Value(rows, columns, entries) = tip(s)?;
                    let entries = entries.iter().zip(&nominal.2).map(|(a, b)| sign * (a - b)).collect();
                    Some(Value(rows, columns, entries))
                };
                both(&error, 1) && self.has_no_second_order(formula, &printed)
            }
            Kind::Shows(order) => {
                both(&tip, order) && (order == 0 || self.has_no_second_order(formula, &printed))
            }
            Kind::Frame(order, is_homogeneous) => {
                both(&|s| frame(s, is_homogeneous), order)
                    && (order == 0 || self.has_no_second_order(formula, &printed))
            }
            Kind::Jacobian => {
                let numbers = scaled(0.0).1;
                let slope = |joint: &str| {
                    let id = chain.find_symbol(joint).unwrap().index();
                    let at = |step: f64| {
                        let mut moved = numbers.clone();
                        moved[id] += step;
                        shown("tip", &moved)
                    };
                    let (up, down) = (at(STEP), at(-STEP));
                    up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * STEP)).collect::<Vec<f64>>()
                };
                let (a, b) = (slope("q1"), slope("q2"));
                let entries = (0..3).flat_map(|row| [a[row], b[row]]).collect();
                same(Some(Value(3, 2, entries)), printed(0.0)) && same(printed(1.0), printed(0.0))
            }
            Kind::Image => {
                let point = shown("tip", &scaled(0.0).1);
                let seen = Value(2, 1, vec![2.0 * point[0] / point[2], 2.0 * point[1] / point[2]]);
                same(Some(seen), printed(0.0)) && same(printed(1.0), printed(0.0))
            }
            Kind::Equal(_) => unreachable!("decided above"),
        }
    }

    /// A closed form that is multiplied out claims that there is nothing beyond its order; a product of matrices does not.
    fn has_no_second_order(&self, formula: &Tree, printed: &dyn Fn(f64) -> Option<Value>) -> bool {
        if formula.latex().contains(r"_\times") {
            return true;
        }
        let (Some(up), Some(at), Some(down)) = (printed(1.0), printed(0.0), printed(-1.0)) else {
            return false;
        };
        let parts = up.2.iter().zip(&at.2).zip(&down.2);
        let curved = parts.map(|((up, at), down)| (up - 2.0 * at + down).abs()).fold(0.0, f64::max);
        let (Some(far), Some(near)) = (printed(2.0), printed(1.0)) else { return false };
        let slope =
            far.2.iter().zip(&near.2).zip(&at.2).map(|((far, near), at)| (far - 2.0 * near + at).abs());
        curved < 1e-9 && slope.fold(0.0, f64::max) < 1e-9
    }
}

/// Whether two values are the same up to what differences of exact forms leave.
fn same(a: Option<Value>, b: Option<Value>) -> bool {
    let (Some(Value(rows, columns, a)), Some(Value(other_rows, other_columns, b))) = (a, b) else {
        return false;
    };
    (rows, columns) == (other_rows, other_columns)
        && a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-6 * (1.0 + a.abs()))
}

/// The largest entry.
fn flat(Value(_, _, entries): &Value) -> Value {
    Value(1, 1, vec![entries.iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()))])
}
