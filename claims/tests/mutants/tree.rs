//! Formulas as trees of the test's own: their LaTeX, their value, and changes of them.

use std::collections::BTreeMap;

/// A formula.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    Number(i64),
    /// A letter in LaTeX; values are looked up by it.
    Letter(&'static str),
    Sin(Box<Tree>),
    Cos(Box<Tree>),
    Sum(Vec<Tree>),
    Product(Vec<Tree>),
    Minus(Box<Tree>),
    Over(Box<Tree>, Box<Tree>),
    /// Columns, and entries row after row.
    Matrix(usize, Vec<Tree>),
    /// A rotation of vectors about axis 0, 1 or 2.
    Turn(usize, Box<Tree>),
    Transposed(Box<Tree>),
    /// The matrix of the vector product with a vector.
    Skew(Box<Tree>),
    /// An identity of three rows.
    One,
}

use Tree::{Cos, Letter, Matrix, Minus, Number, One, Over, Product, Sin, Skew, Sum, Transposed, Turn};

/// Rows, columns, entries.
#[derive(Debug, Clone, PartialEq)]
pub struct Value(pub usize, pub usize, pub Vec<f64>);

pub fn sum(parts: impl IntoIterator<Item = Tree>) -> Tree {
    Sum(parts.into_iter().collect())
}

pub fn product(parts: impl IntoIterator<Item = Tree>) -> Tree {
    Product(parts.into_iter().collect())
}

pub fn sin(angle: Tree) -> Tree {
    Sin(Box::new(angle))
}

pub fn cos(angle: Tree) -> Tree {
    Cos(Box::new(angle))
}

pub fn minus(inside: Tree) -> Tree {
    Minus(Box::new(inside))
}

pub fn column(entries: impl IntoIterator<Item = Tree>) -> Tree {
    Matrix(1, entries.into_iter().collect())
}

pub fn turn(axis: usize, angle: Tree) -> Tree {
    Turn(axis, Box::new(angle))
}

pub fn skew(vector: Tree) -> Tree {
    Skew(Box::new(vector))
}

pub fn over(above: Tree, below: Tree) -> Tree {
    Over(Box::new(above), Box::new(below))
}

impl Tree {
    pub fn latex(&self) -> String {
        let group = |tree: &Tree| match tree {
            Sum(_) | Minus(_) => format!(r"\left({}\right)", tree.latex()),
            Number(value) if *value < 0 => format!(r"\left({value}\right)"),
            _ => tree.latex(),
        };
        match self {
            Number(value) => value.to_string(),
            Letter(letter) => (*letter).to_owned(),
            Sin(angle) => format!(r"\sin\left({}\right)", angle.latex()),
            Cos(angle) => format!(r"\cos\left({}\right)", angle.latex()),
            Sum(parts) => {
                let mut text = String::new();
                for (at, part) in parts.iter().enumerate() {
                    match part {
                        Minus(inside) => text += &format!(" - {}", group(inside)),
                        part if at == 0 => text += &part.latex(),
                        part => {
                            text += &format!(
                                " + {}",
                                if matches!(part, Number(n) if *n < 0) { group(part) } else { part.latex() }
                            )
                        }
                    }
                }
                if parts.is_empty() { "0".to_owned() } else { text }
            }
            Product(parts) if parts.is_empty() => "1".to_owned(),
            Product(parts) => {
                let written: Vec<String> = parts
                    .iter()
                    .enumerate()
                    .map(|(at, part)| match part {
                        Number(_) if at > 0 => format!(r"\cdot {}", group(part)),
                        _ => group(part),
                    })
                    .collect();
                written.join(" ")
            }
            Minus(inside) => format!("-{}", group(inside)),
            Over(above, below) => format!(r"\frac{{{}}}{{{}}}", above.latex(), below.latex()),
            Matrix(columns, entries) => {
                let rows: Vec<String> = entries
                    .chunks(*columns)
                    .map(|row| row.iter().map(Tree::latex).collect::<Vec<_>>().join(" & "))
                    .collect();
                format!(r"\begin{{bmatrix}}{}\end{{bmatrix}}", rows.join(r" \\ "))
            }
            Turn(axis, angle) => format!(r"R_{}\left({}\right)", ["x", "y", "z"][*axis], angle.latex()),
            Transposed(inside) => format!("{}^T", group(inside)),
            Skew(inside) => format!(r"\left[{}\right]_\times", inside.latex()),
            One => r"\mathbf{I}".to_owned(),
        }
    }

    /// The value; `None` if shapes do not fit.
    pub fn value(&self, values: &BTreeMap<&str, f64>) -> Option<Value> {
        let scalar = |tree: &Tree| match tree.value(values)? {
            Value(1, 1, entries) => Some(entries[0]),
            _ => None,
        };
        let one = |value: f64| Some(Value(1, 1, vec![value]));
        match self {
            Number(value) => one(*value as f64),
            Letter(letter) => one(*values.get(letter)?),
            Sin(angle) => one(scalar(angle)?.sin()),
            Cos(angle) => one(scalar(angle)?.cos()),
            Sum(parts) => {
                let mut parts = parts.iter().map(|part| part.value(values));
                let Some(first) = parts.next() else { return one(0.0) };
                parts.try_fold(first?, |Value(rows, columns, sum), part| {
                    let Value(other_rows, other_columns, part) = part?;
                    let fits = (rows, columns) == (other_rows, other_columns);
                    fits.then(|| Value(rows, columns, sum.iter().zip(&part).map(|(a, b)| a + b).collect()))
                })
            }
            Product(parts) => {
                let mut parts = parts.iter().map(|part| part.value(values));
                let Some(first) = parts.next() else { return one(1.0) };
                parts.try_fold(first?, |left, right| times(&left, &right?))
            }
            Minus(inside) => {
                let Value(rows, columns, entries) = inside.value(values)?;
                Some(Value(rows, columns, entries.iter().map(|entry| -entry).collect()))
            }
            Over(above, below) => {
                let below = scalar(below)?;
                let Value(rows, columns, entries) = above.value(values)?;
                Some(Value(rows, columns, entries.iter().map(|entry| entry / below).collect()))
            }
            Matrix(columns, entries) => {
                let entries: Option<Vec<f64>> = entries.iter().map(scalar).collect();
                let entries = entries?;
                Some(Value(entries.len() / columns, *columns, entries))
            }
            Turn(axis, angle) => {
                let (s, c) = scalar(angle)?.sin_cos();
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut entries = vec![0.0; 9];
                entries[axis * 4] = 1.0;
                entries[j * 4] = c;
                entries[k * 4] = c;
                entries[j * 3 + k] = -s;
                entries[k * 3 + j] = s;
                Some(Value(3, 3, entries))
            }
            Transposed(inside) => {
                let Value(rows, columns, entries) = inside.value(values)?;
                let turned = (0..columns).flat_map(|column| (0..rows).map(move |row| row * columns + column));
                Some(Value(columns, rows, turned.map(|at| entries[at]).collect()))
            }
            Skew(inside) => {
                let Value(3, 1, v) = inside.value(values)? else { return None };
                Some(Value(3, 3, vec![0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0]))
            }
            One => Some(Value(3, 3, vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0])),
        }
    }

    fn children(&mut self) -> Vec<&mut Tree> {
        match self {
            Number(_) | Letter(_) | One => Vec::new(),
            Sin(inside)
            | Cos(inside)
            | Minus(inside)
            | Turn(_, inside)
            | Transposed(inside)
            | Skew(inside) => {
                vec![inside]
            }
            Over(above, below) => vec![above, below],
            Sum(parts) | Product(parts) | Matrix(_, parts) => parts.iter_mut().collect(),
        }
    }

    fn nodes(&mut self) -> usize {
        1 + self.children().into_iter().map(Tree::nodes).sum::<usize>()
    }

    /// The node of a number, in the order in which they are written.
    fn at(&mut self, number: usize) -> &mut Tree {
        if number == 0 {
            return self;
        }
        let mut left = number - 1;
        for child in self.children() {
            let size = child.nodes();
            if left < size {
                return child.at(left);
            }
            left -= size;
        }
        unreachable!("a tree has as many nodes as it says")
    }
}

fn times(Value(rows, inner, a): &Value, Value(other, columns, b): &Value) -> Option<Value> {
    if (*rows, *inner) == (1, 1) || (*other, *columns) == (1, 1) {
        let (factor, Value(rows, columns, entries)) = if (*rows, *inner) == (1, 1) {
            (a[0], Value(*other, *columns, b.clone()))
        } else {
            (b[0], Value(*rows, *inner, a.clone()))
        };
        return Some(Value(rows, columns, entries.iter().map(|entry| entry * factor).collect()));
    }
    if inner != other {
        return None;
    }
    let entry =
        |row: usize, column: usize| (0..*inner).map(|k| a[row * inner + k] * b[k * columns + column]).sum();
    let entries = (0..*rows).flat_map(|row| (0..*columns).map(move |column| entry(row, column)));
    Some(Value(*rows, *columns, entries.collect()))
}

/// A linear congruential generator, enough to choose with.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % count.max(1)
    }
}

/// A formula with one node changed.
pub fn mutated(formula: &Tree, random: &mut Random, letters: &[&'static str]) -> Tree {
    let mut mutant = formula.clone();
    while mutant == *formula {
        let node = random.below(mutant.nodes());
        let choice = random.below(4);
        let other = letters[random.below(letters.len())];
        let node = mutant.at(node);
        let inside = node.clone();
        *node = match inside {
            Number(value) => Number(match choice {
                0 => -value,
                1 => value + 1,
                2 => value - 1,
                _ => 2 * value + 1,
            }),
            Letter(letter) => match choice {
                0 => Product(vec![Number(2), Letter(letter)]),
                1 => Minus(Box::new(Letter(letter))),
                _ => Letter(other),
            },
            Sin(angle) => {
                if choice == 0 {
                    Minus(Box::new(Sin(angle)))
                } else {
                    Cos(angle)
                }
            }
            Cos(angle) => {
                if choice == 0 {
                    Minus(Box::new(Cos(angle)))
                } else {
                    Sin(angle)
                }
            }
            Sum(mut parts) | Product(mut parts) if choice == 0 && parts.len() > 1 => {
                let at = random.below(parts.len());
                parts.remove(at);
                if matches!(formula, Sum(_)) && matches!(node, Sum(_)) {
                    Sum(parts)
                } else {
                    rebuilt(node, parts)
                }
            }
            Sum(mut parts) if !parts.is_empty() => {
                let at = random.below(parts.len());
                parts[at] = match parts[at].clone() {
                    Minus(inside) => *inside,
                    part => Minus(Box::new(part)),
                };
                Sum(parts)
            }
            Product(mut parts) if parts.len() > 1 => {
                let at = random.below(parts.len() - 1);
                parts.swap(at, at + 1);
                Product(parts)
            }
            Minus(inside) => *inside,
            Over(above, below) => {
                if choice == 0 {
                    *above
                } else {
                    Minus(Box::new(Over(above, below)))
                }
            }
            Matrix(columns, mut entries) => {
                let (a, b) = (random.below(entries.len()), random.below(entries.len()));
                if choice == 0 {
                    entries[a] = Minus(Box::new(entries[a].clone()));
                } else {
                    entries.swap(a, b);
                }
                Matrix(columns, entries)
            }
            Turn(axis, angle) => match choice {
                0 => Turn((axis + 1) % 3, angle),
                1 => Turn(axis, Box::new(Minus(angle))),
                _ => Transposed(Box::new(Turn(axis, angle))),
            },
            Transposed(inside) => *inside,
            Skew(inside) => {
                if choice == 0 {
                    Transposed(Box::new(Skew(inside)))
                } else {
                    Minus(Box::new(Skew(inside)))
                }
            }
            One => Minus(Box::new(One)),
            unchanged => unchanged,
        };
    }
    mutant
}

/// The same kind of node with other parts.
fn rebuilt(node: &Tree, parts: Vec<Tree>) -> Tree {
    match node {
        Sum(_) => Sum(parts),
        _ => Product(parts),
    }
}
