//! The two ways of writing the parts of a formula.

use super::pieces::{Angle, Function};
use crate::algebra::{Pole, Rational};
use crate::chain::Chain;
use crate::symbol::Symbol;

/// How the parts of a formula are written.
pub(super) trait Notation {
    /// A positive number.
    fn number(&self, value: &Rational) -> String;
    /// A symbol to a power ≥ 1.
    fn power(&self, symbol: &Symbol, power: u32) -> String;
    /// A power of a sine or cosine.
    fn function(&self, chain: &Chain, function: &Function) -> String;
    /// A power of what is abbreviated.
    fn abbreviated(&self, printed: &str, power: u32) -> String;
    /// One over a power of a sine or cosine; `over` puts the other one of the two above it.
    fn pole(&self, symbol: &Symbol, pole: &Pole, over: bool) -> String;
    /// A sum as a factor.
    fn parentheses(&self, sum: &str) -> String;
    /// Factors side by side.
    fn product(&self, factors: &[String]) -> String;
}

/// A number that somebody wrote as a decimal: exact in a few digits, and no plain fraction such as 3/8.
fn decimal(value: &Rational) -> Option<String> {
    /// Halves and their like come from squares of sines, and are fractions.
    const DYADIC: i64 = 64;
    let is_dyadic = (value * &Rational::from(DYADIC)).to_integer().is_some();
    if is_dyadic { None } else { value.to_decimal() }
}

/// The plain syntax of amounts.
pub(super) struct Text;

impl Notation for Text {
    fn number(&self, value: &Rational) -> String {
        decimal(value).unwrap_or_else(|| value.to_string())
    }

    fn power(&self, symbol: &Symbol, power: u32) -> String {
        if power == 1 { symbol.name.clone() } else { format!("{}^{power}", symbol.name) }
    }

    fn function(&self, chain: &Chain, function: &Function) -> String {
        let name = name(function);
        let angle = sum(&function.angle, |id, times| {
            let symbol = &chain.symbol(id).name;
            if times == 1 { symbol.clone() } else { format!("{times}*{symbol}") }
        });
        let power = if function.power == 1 { String::new() } else { format!("^{}", function.power) };
        format!("{name}({angle}){power}")
    }

    fn abbreviated(&self, printed: &str, power: u32) -> String {
        if power == 1 { printed.to_owned() } else { format!("{printed}^{power}") }
    }

    fn pole(&self, symbol: &Symbol, pole: &Pole, over: bool) -> String {
        let name = &symbol.name;
        let (below, above, quotient, reciprocal, power) = match pole.cos_power {
            0 => ("sin", "cos", "cot", "csc", pole.sin_power),
            power => ("cos", "sin", "tan", "sec", power),
        };
        match (over, power) {
            (true, 1) => format!("{quotient}({name})"),
            (false, 1) => format!("{reciprocal}({name})"),
            (true, _) => format!("{above}({name})/{below}({name})^{power}"),
            (false, _) => format!("{reciprocal}({name})^{power}"),
        }
    }

    fn parentheses(&self, sum: &str) -> String {
        format!("({sum})")
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join("*")
    }
}

/// LaTeX, with the symbols' printed forms.
pub(super) struct Latex;

impl Notation for Latex {
    fn number(&self, value: &Rational) -> String {
        match (value.to_integer(), decimal(value)) {
            (Some(whole), _) => whole.to_string(),
            (_, Some(decimal)) => decimal,
            _ => format!("\\frac{{{}}}{{{}}}", value.numerator(), value.denominator()),
        }
    }

    fn power(&self, symbol: &Symbol, power: u32) -> String {
        let latex = &symbol.latex;
        match power {
            1 => latex.clone(),
            _ if latex.contains('^') => format!("\\left({latex}\\right)^{{{power}}}"),
            _ => format!("{latex}^{{{power}}}"),
        }
    }

    fn function(&self, chain: &Chain, function: &Function) -> String {
        let name = name(function);
        let angle = sum(&function.angle, |id, times| {
            let symbol = &chain.symbol(id).latex;
            if times == 1 { symbol.clone() } else { format!("{times} {symbol}") }
        });
        let power = if function.power == 1 { String::new() } else { format!("^{{{}}}", function.power) };
        if function.angle.len() == 1 {
            format!("\\{name}{power} {angle}")
        } else {
            format!("\\{name}{power}\\left({angle}\\right)")
        }
    }

    fn abbreviated(&self, printed: &str, power: u32) -> String {
        match power {
            1 => printed.to_owned(),
            _ if printed.contains('^') => format!("\\left({printed}\\right)^{{{power}}}"),
            _ => format!("{printed}^{{{power}}}"),
        }
    }

    fn pole(&self, symbol: &Symbol, pole: &Pole, over: bool) -> String {
        let angle = &symbol.latex;
        let (below, above, quotient, power) = match pole.cos_power {
            0 => ("sin", "cos", "cot", pole.sin_power),
            power => ("cos", "sin", "tan", power),
        };
        let above = if over { format!("\\{above} {angle}") } else { "1".to_owned() };
        match (over, power) {
            (true, 1) => format!("\\{quotient} {angle}"),
            (_, 1) => format!("\\frac{{{above}}}{{\\{below} {angle}}}"),
            _ => format!("\\frac{{{above}}}{{\\{below}^{{{power}}} {angle}}}"),
        }
    }

    fn parentheses(&self, sum: &str) -> String {
        format!("\\left({sum}\\right)")
    }

    fn product(&self, factors: &[String]) -> String {
        factors.join(" ")
    }
}

fn name(function: &Function) -> &'static str {
    if function.is_sine { "sin" } else { "cos" }
}

/// Multiples of angles, added up.
fn sum(angle: &Angle, times: impl Fn(crate::SymbolId, u32) -> String) -> String {
    let mut text = String::new();
    for (index, &(id, multiple)) in angle.iter().enumerate() {
        text.push_str(match (index, multiple < 0) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        });
        text.push_str(&times(id, multiple.unsigned_abs()));
    }
    text
}
