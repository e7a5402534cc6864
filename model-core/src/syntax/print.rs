//! A declaration as text again: one layout for any way it was written. Comments are not kept; whoever changes a
//! person's text edits that text at the places that the declaration knows.

use std::fmt::{self, Display, Formatter};

use super::ORIENTATION;
use super::amount::{FUNCTIONS, RAMP};
use super::declaration::{
    AxisTerm, BetweenTerm, BodyStatement, ConstantStatement, Declaration, FactorGroup, FactorTerm,
    GravityStatement, ImageTerm, InputStatement, ObserveStatement, ReadingTerm, Statement, SymbolStatement,
};
use crate::expr::{Expr, Node};

/// How tightly a part of an amount holds together; what is looser than its place gets parentheses.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Sign,
    Power,
    Atom,
}

impl Display for Declaration {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        documentation(f, "", &self.documentation)?;
        writeln!(f, "chain {} {{", self.name)?;
        for statement in &self.statements {
            match statement {
                Statement::Body(body) => write_body(f, body)?,
                Statement::Constant(ConstantStatement {
                    documentation: text, name, quantity, value, ..
                }) => {
                    documentation(f, "    ", text)?;
                    write!(f, "    const {name}")?;
                    if let Some(quantity) = quantity {
                        write!(f, ": {quantity}")?;
                    }
                    match value {
                        Some(value) => writeln!(f, " = {};", Written(Some(value)))?,
                        None => writeln!(f, ";")?,
                    }
                }
                Statement::Input(InputStatement { documentation: text, name, meaning, of, between }) => {
                    documentation(f, "    ", text)?;
                    write!(f, "    input {name}")?;
                    if let Some(meaning) = meaning {
                        write!(f, ": {meaning}")?;
                    }
                    if let Some(of) = of {
                        write!(f, " of {of}")?;
                    }
                    if let Some(BetweenTerm { sight, up }) = between {
                        write!(f, " = between({sight}, {up})")?;
                    }
                    writeln!(f, ";")?;
                }
                Statement::Symbol(SymbolStatement { documentation: text, name, latex }) => {
                    documentation(f, "    ", text)?;
                    writeln!(f, "    symbol {name} = {};", proc_macro2::Literal::string(latex))?;
                }
                Statement::Observe(ObserveStatement {
                    documentation: text,
                    name,
                    readings,
                    kind,
                    components,
                    body,
                    frame,
                    image,
                    bent,
                    last: _,
                }) => {
                    documentation(f, "    ", text)?;
                    let [x, y, z] = components.each_ref().map(|component| Written(component.as_ref()));
                    write!(f, "    observe {name}: ")?;
                    write_readings(f, readings)?;
                    if kind == ORIENTATION {
                        write!(f, "{kind} of {body}")?;
                    } else if let Some(image) = image {
                        write!(f, "{kind}({x}, {y}, {z}")?;
                        write_image(f, image)?;
                        write!(f, ") of {body}")?;
                    } else {
                        write!(f, "{kind}({x}, {y}, {z}) of {body}")?;
                    }
                    if let Some(frame) = frame {
                        write!(f, " in {frame}")?;
                    }
                    if let Some(bent) = bent {
                        write!(f, ", bent up by {}", Written(bent.amount.as_ref()))?;
                    }
                    writeln!(f, ";")?;
                }
                Statement::Gravity(GravityStatement { components, .. }) => {
                    let [x, y, z] = components.each_ref().map(|component| Written(component.as_ref()));
                    writeln!(f, "    gravity: ({x}, {y}, {z});")?;
                }
            }
        }
        writeln!(f, "}}")
    }
}

fn documentation(f: &mut Formatter<'_>, indent: &str, text: &str) -> fmt::Result {
    for line in text.lines() {
        writeln!(f, "{indent}/// {line}")?;
    }
    Ok(())
}

fn write_body(f: &mut Formatter<'_>, body: &BodyStatement) -> fmt::Result {
    documentation(f, "    ", &body.documentation)?;
    writeln!(f, "    body {} on {} {{", body.name, body.lower)?;
    for FactorGroup { documentation: text, role, factors, .. } in &body.groups {
        documentation(f, "        ", text)?;
        writeln!(f, "        {role}:")?;
        for (index, FactorTerm { documentation: text, axis, amount, .. }) in factors.iter().enumerate() {
            documentation(f, "            ", text)?;
            let end = if index + 1 == factors.len() { ";" } else { "," };
            writeln!(f, "            {axis}({}){end}", Written(amount.as_ref()))?;
        }
    }
    writeln!(f, "    }}")
}

/// `azimuth(x, -y), elevation of `, and nothing without readings.
fn write_readings(f: &mut Formatter<'_>, readings: &[ReadingTerm]) -> fmt::Result {
    for (index, ReadingTerm { word, axes }) in readings.iter().enumerate() {
        write!(f, "{}{word}", if index > 0 { ", " } else { "" })?;
        if let Some(axes) = axes {
            let sign = |axis: &AxisTerm| if axis.is_negative { "-" } else { "" };
            let axes: Vec<String> = axes.iter().map(|axis| format!("{}{}", sign(axis), axis.axis)).collect();
            write!(f, "({})", axes.join(", "))?;
        }
    }
    if readings.is_empty() { Ok(()) } else { write!(f, " of ") }
}

/// ` of flange; fx, fy, cx, cy, k1, k2, p1, p2`
fn write_image(f: &mut Formatter<'_>, image: &ImageTerm) -> fmt::Result {
    if let Some(target) = &image.target {
        write!(f, " of {target}")?;
    }
    for (index, number) in image.intrinsics.iter().enumerate() {
        write!(f, "{}{}", if index > 0 { ", " } else { "; " }, Written(number.as_ref()))?;
    }
    Ok(())
}

/// An amount, or nothing where it could not be read.
struct Written<'a, S>(Option<&'a Expr<S>>);

impl<S> Display for Written<'_, S> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |amount| write_amount(f, amount, Binding::Sum))
    }
}

fn write_amount<S>(f: &mut Formatter<'_>, amount: &Expr<S>, place: Binding) -> fmt::Result {
    let binding = binding(amount);
    if binding < place {
        write!(f, "(")?;
    }
    match &amount.node {
        Node::Number(value) => write!(f, "{value}")?,
        Node::Measured(value, unit) if value.to_integer().is_some() => write!(f, "{value} {}", unit.name())?,
        Node::Measured(value, unit) => {
            write!(f, "{} {}/{}", value.numerator(), unit.name(), value.denominator())?;
        }
        Node::Pi => write!(f, "pi")?,
        Node::Ramp(parts) => {
            write!(f, "{RAMP}(")?;
            for (index, part) in parts.iter().enumerate() {
                write!(f, "{}", if index > 0 { ", " } else { "" })?;
                write_amount(f, part, Binding::Sum)?;
            }
            write!(f, ")")?;
        }
        Node::Symbol(name) => write!(f, "{name}")?,
        Node::Neg(inner) => {
            write!(f, "-")?;
            write_amount(f, inner, Binding::Power)?;
        }
        Node::Add(left, right) => {
            write_amount(f, left, Binding::Sum)?;
            match &right.node {
                Node::Neg(inner) => {
                    write!(f, " - ")?;
                    write_amount(f, inner, Binding::Product)?;
                }
                _ => {
                    write!(f, " + ")?;
                    write_amount(f, right, Binding::Sum)?;
                }
            }
        }
        Node::Mul(left, right) => {
            write_amount(f, left, factor(left))?;
            write!(f, "*")?;
            write_amount(f, right, factor(right))?;
        }
        Node::Div(left, right) => {
            write_amount(f, left, factor(left))?;
            write!(f, "/")?;
            write_amount(f, right, Binding::Sign)?;
        }
        Node::Pow(base, power) => {
            write_amount(f, base, Binding::Atom)?;
            write!(f, "^{power}")?;
        }
        Node::Call(function, argument) => {
            let name = FUNCTIONS.iter().find(|(_, known)| known == function).map_or("", |(name, _)| name);
            write!(f, "{name}(")?;
            write_amount(f, argument, Binding::Sum)?;
            write!(f, ")")?;
        }
    }
    if binding < place {
        write!(f, ")")?;
    }
    Ok(())
}

/// A product within a product needs no parentheses, a quotient does: `a/b*c` reads as `(a*c)/b`.
fn factor<S>(amount: &Expr<S>) -> Binding {
    if matches!(amount.node, Node::Mul(..)) { Binding::Product } else { Binding::Sign }
}

fn binding<S>(amount: &Expr<S>) -> Binding {
    match &amount.node {
        Node::Add(..) => Binding::Sum,
        Node::Mul(..) | Node::Div(..) => Binding::Product,
        // A fraction is printed as a quotient.
        Node::Number(value) if value.to_string().contains('/') => Binding::Product,
        Node::Neg(_) => Binding::Sign,
        Node::Pow(..) => Binding::Power,
        Node::Measured(value, _) if value.to_integer().is_none() => Binding::Product,
        Node::Number(_)
        | Node::Measured(..)
        | Node::Pi
        | Node::Symbol(_)
        | Node::Call(..)
        | Node::Ramp(_) => Binding::Atom,
    }
}
