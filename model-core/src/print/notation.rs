//! The two ways of writing the parts of a formula.

use crate::algebra::{Pole, Rational, Wave, WaveFactor};
use crate::symbol::Symbol;

/// How the parts of a formula are written.
pub(super) trait Notation {
    /// A positive number.
    fn number(&self, value: &Rational) -> String;
    /// A symbol to a power ≥ 1.
    fn power(&self, symbol: &Symbol, power: u32) -> String;
    /// A sine or cosine.
    fn wave(&self, symbol: &Symbol, wave: &WaveFactor) -> String;
    /// One over a power of a sine or cosine; `over` puts the other one of the two above it.
    fn pole(&self, symbol: &Symbol, pole: &Pole, over: bool) -> String;
    /// A sum as a factor.
    fn parentheses(&self, sum: &str) -> String;
    /// Factors side by side.
    fn product(&self, factors: &[String]) -> String;
}

/// The plain syntax of amounts.
pub(super) struct Text;

impl Notation for Text {
    fn number(&self, value: &Rational) -> String {
        value.to_string()
    }

    fn power(&self, symbol: &Symbol, power: u32) -> String {
        if power == 1 { symbol.name.clone() } else { format!("{}^{power}", symbol.name) }
    }

    fn wave(&self, symbol: &Symbol, wave: &WaveFactor) -> String {
        let function = function(wave.wave);
        match wave.harmonic {
            1 => format!("{function}({})", symbol.name),
            harmonic => format!("{function}({harmonic}*{})", symbol.name),
        }
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
        match value.to_integer() {
            Some(whole) => whole.to_string(),
            None => format!("\\frac{{{}}}{{{}}}", value.numerator(), value.denominator()),
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

    fn wave(&self, symbol: &Symbol, wave: &WaveFactor) -> String {
        let function = function(wave.wave);
        match wave.harmonic {
            1 => format!("\\{function} {}", symbol.latex),
            harmonic => format!("\\{function} {harmonic} {}", symbol.latex),
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

fn function(wave: Wave) -> &'static str {
    match wave {
        Wave::Cos => "cos",
        Wave::Sin => "sin",
    }
}
